"""Machines with flexible bodies for relative coordinates: chains, loops, bodies that fly, joints at interfaces on both sides."""

from math import radians, sin

from models import STEEL, reduced
from nivel import Body, Driver, Joint, MachineRecord, Marker, PointForce, Sensor, SpringDamper
from nivel.flexible.body.body_file import write_body

GRAVITY = (0.3, -9.81, 0.5)
LENGTH = 1.0
# interfaces of `beam`, m along it
INTERFACES = {"root": 0.0, "middle": 0.5, "tip": LENGTH}


def write_beams(folder, modulus=210):
    """`beam`: 1 m of steel, 20 × 30 mm, with geometric stiffening and three interfaces; `soft`: without stiffening, 8 × 10 mm."""
    for name, width, height, reduction in (
        ("beam", 0.02, 0.03, "modes: 4, stiffening: true"),
        ("soft", 0.008, 0.01, "modes: 4"),
    ):
        halves = ", ".join(
            f"{half}: {{nodes: [{half}], section: bar, material: steel, elements: 4}}"
            for half in ("root, middle", "middle, tip")
        )
        halves = halves.replace("root, middle: {", "inner: {").replace("middle, tip: {", "outer: {")
        text = f"""
format: 1
name: {name}
materials: {{{STEEL}}}
sections: {{bar: {{type: rectangle, width: {width}, height: {height}}}}}
frame:
  nodes: {{root: [0, 0, 0], middle: [{INTERFACES["middle"]}, 0, 0], tip: [{LENGTH}, 0, 0]}}
  beams: {{{halves}}}
interfaces: {{root: {{node: root}}, middle: {{node: middle}}, tip: {{node: tip}}}}
reduction: {{{reduction}}}
"""
        body, _ = reduced(text.replace("210 GPa", f"{modulus} GPa"))
        write_body(body, folder / f"{name}.nc")
    return folder


def beam(folder, name, position, *, file="beam", modes=5, **more):
    """A flexible body along x."""
    flexible = {"file": str(folder / f"{file}.nc"), "modes": modes, "damping_ratio": 0.01}
    return Body(name=name, flexible=flexible, position=position, **more)


def block(name, position):
    """A rigid body."""
    return Body(name=name, mass=0.7, inertia=(0.01, 0.02, 0.015), centre_of_mass=(0.02, -0.01, 0.03), position=position)


def hinge(name, first, second, x, axis=(0, 0.6, 0.8), kind="revolute"):
    return Joint(name=name, type=kind, bodies=(first, second), point=(x, 0, 0), axis=axis)


def machine(name, bodies, joints, **more):
    return MachineRecord(name=name, gravity=GRAVITY, bodies=tuple(bodies), joints=tuple(joints), **more)


def pendulum(folder):
    return machine("pendulum", [beam(folder, "a", (0, 0, 0))], [hinge("root", "ground", "a", 0.0)])


def chain(folder):
    """Three flexible bodies and a rigid one: hung by their roots, by a tip, at a middle; first and second bodies of joints exchanged."""
    bodies = [
        beam(folder, "a", (0, 0, 0)),
        beam(folder, "b", (1, 0, 0), file="soft", modes=3),
        beam(folder, "c", (0.5, 0, 0)),
        block("d", (1.5, 0, 0)),
    ]
    joints = [
        Joint(name="foot", type="universal", bodies=("ground", "a"), point=(0, 0, 0), axes=((0, 0, 1), (0, 1, 0))),
        hinge("elbow", "b", "a", 1.0),
        # the third hangs on the middle of the first by its own root, and carries a block by its tip
        Joint(name="ball", type="spherical", bodies=("c", "a"), point=(0.5, 0, 0)),
        hinge("grip", "c", "d", 1.5, axis=(1, 0, 0), kind="cylindrical"),
    ]
    forces = (
        SpringDamper(
            name="rope", bodies=("b", "d"), points=((2, 0, 0), (1.5, 0, 0)), stiffness=300, free_length=0.3, damping=2
        ),
        PointForce(name="push", body="b", position=(0.5, 0, 0), vector=(1.0, 2.0, -3.0)),
    )
    sensors = (Sensor(name="end", marker="end", quantity="acceleration"),)
    return machine(
        "chain",
        bodies,
        joints,
        forces=forces,
        markers=(Marker(name="end", body="b", position=(1, 0, 0)),),
        sensors=sensors,
    )


def flying(folder):
    """A flexible body that hangs on nothing carries one by a fixed joint, this one a rigid one, and another by its tip."""
    bodies = [
        beam(folder, "a", (0, 0, 0), angular_velocity=(0.0, 1.0, 2.0)),
        beam(folder, "b", (1, 0, 0), file="soft", modes=3),
        block("c", (2, 0, 0)),
        beam(folder, "d", (-1, 0, 0)),
    ]
    joints = [
        Joint(name="weld", type="fixed", bodies=("a", "b"), point=(1, 0, 0)),
        hinge("slide", "b", "c", 2.0, axis=(0, 1, 0), kind="translational"),
        hinge("tail", "a", "d", 0.0),
    ]
    return machine("flying", bodies, joints)


def loop(folder):
    """A closed loop of two flexible bodies at 60° and a rigid slider."""
    bodies = [
        beam(folder, "crank", (0, 0, 0), orientation={"axis": (0, 0, 1), "angle": radians(60)}),
        beam(folder, "rod", (0.5, sin(radians(60)), 0), orientation={"axis": (0, 0, 1), "angle": -radians(60)}),
        block("slider", (1, 0, 0)),
    ]
    joints = [
        hinge("shaft", "ground", "crank", 0.0, axis=(0, 0, 1)),
        Joint(name="big", type="spherical", bodies=("crank", "rod"), point=(0.5, sin(radians(60)), 0)),
        Joint(name="small", type="universal", bodies=("rod", "slider"), point=(1, 0, 0), axes=((0, 1, 0), (0, 0, 1))),
        hinge("guide", "ground", "slider", 1.0, axis=(1, 0, 0), kind="translational"),
    ]
    return machine("loop", bodies, joints)


def spinning(folder):
    """A blade on a hub that a driver turns."""
    bodies = [block("hub", (0, 0, 0)), beam(folder, "blade", (0.1, 0, 0), file="soft", modes=4)]
    joints = [
        Joint(name="shaft", type="revolute", bodies=("ground", "hub"), point=(0, 0, 0), axis=(0, 0, 1)),
        Joint(name="root", type="fixed", bodies=("hub", "blade"), point=(0.1, 0, 0)),
    ]
    return machine("spinning", bodies, joints, drivers=(Driver(name="motor", coordinate="shaft", value="20*time^2"),))


MACHINES = {"pendulum": pendulum, "chain": chain, "flying": flying, "loop": loop, "spinning": spinning}
