"""A part that is placed moves as its image: mirrored, turned and moved, with every kind of joint and force."""

import numpy as np
import pytest

from nivel.api import Machine
from nivel.files import parse_machine
from nivel.files.assembly import placed
from nivel.files.placement import Placement
from nivel.machine.core.orientation import Orientation
from nivel.machine.uses.references import SECTIONS

pytestmark = pytest.mark.covering

TURNED = Orientation(euler=(0.3, 0.7, -1.0), sequence="zxz")
PLACEMENTS = {
    "x": Placement.of((0, 0, 0), None, "x"),
    "y": Placement.of((0.5, 0, 0), None, "y"),
    "z": Placement.of((0, 0, 0), None, "z"),
    "turned": Placement.of((0.5, -0.3, 0.2), TURNED, "none"),
    "y turned": Placement.of((0.5, -0.3, 0.2), TURNED, "y"),
}

BODIES = """\
format: 1
bodies:
  a:
    position: [0.3, 0.1, -0.2]
    orientation: {euler: [0.3, 0.5, -0.2], sequence: zxz}
    mass: 2
    centre_of_mass: [0.05, -0.02, 0.03]
    inertia: {xx: 0.02, yy: 0.03, zz: 0.025, xy: 0.003, xz: 0.001, yz: -0.002}
  b:
    position: [0.7, 0.2, -0.3]
    orientation: {axis: [1, 2, 3], angle: 0.7}
    mass: 1
    centre_of_mass: [0.01, 0.02, -0.03]
    inertia: {xx: 0.01, yy: 0.012, zz: 0.015, xy: -0.001, yz: 0.002}
    shape: {type: sphere, radius: 5 cm, centre: [0.02, 0.01, 0]}
  c: {shape: {type: box, from: [0.9, 0.1, 0], to: [1.2, 0.3, 0.2], width: 4 cm, height: 7 cm}, density: 3000}
  d: {position: [1.5, 0, 0], mass: 1, inertia: [0.01, 0.02, 0.015]}
markers:
  am: {body: a, position: [0.1, 0.02, 0.01], axis: [1, 2, 0.5]}
  bm: {body: b, position: [-0.1, 0, 0.05], axis: [0.3, 1, 0.5], x_axis: [1, 0, 0]}
  g: {body: ground, position: [0.1, 0.2, 0.3], axis: [0.3, 1, 0.5], x_axis: [1, 0, 0]}
  floor: {body: ground, position: [0, 0, -0.45], axis: [0.1, 0.2, 1]}
simulation: {duration: 0.2, step: 1 ms}
"""
FREE = "  on_a: {type: torque, body: a, vector: [0.3, 0.5*sin(5*time), -0.2], axes: body}\n"
PUSHED = FREE + (
    "  on_b: {type: force, marker: bm, vector: [1, {times: [0, 0.1], values: [0, 20]}, 3*time], axes: body}\n"
    "  on_c: {type: force, body: c, vector: [-1, 5, 9 - 10*time]}\n"
    "  on_d: {type: torque, body: d, vector: [0.1, 0.2*cos(9*time), 0.3]}\n"
)
JOINTS = """\
joints:
  first: {type: spherical, bodies: [ground, a], point: [0.1, 0.05, 0]}
"""

MACHINES = {
    "pendulum": (
        "  second: {type: universal, bodies: [a, b], point: [0.5, 0.15, -0.25], axes: [[0, 1, 0.2], [1, 0, 0]]}\n"
        "  third: {type: cylindrical, bodies: [b, c], point: [0.9, 0.1, 0], axis: [0.2, 1, 0.3]}\n"
        "  fourth: {type: translational, bodies: [c, d], point: [1.2, 0.1, 0], axis: [1, 0.3, 0.3]}\n",
        PUSHED,
    ),
    "compound joints": (
        "  second: {type: screw, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2], pitch: 20 cm}\n"
        "  third: {type: planar, bodies: [b, c], point: [0.9, 0.1, 0], axis: [0.2, 1, 0.3]}\n"
        "  fourth: {type: revolute-translational, bodies: [c, d], point: [1.2, 0.1, 0], axes: [[1, 0.3, 0.3], [0, 1, 0]]}\n",
        PUSHED,
    ),
    "links": (
        "  second: {type: distance, bodies: [a, b], points: [[0.5, 0.15, -0.25], [0.6, 0.3, -0.2]]}\n"
        "  third: {type: revolute-spherical, bodies: [b, c], points: [[0.9, 0.1, 0], [1, 0.3, 0.1]], axis: [0.2, 1, 0.3]}\n"
        "  fourth: {type: revolute-cylindrical, bodies: [c, d], points: [[1.2, 0.1, 0], [1.3, 0, 0.2]], "
        "axes: [[1, 0.3, 0.3], [0, 1, 0]]}\n",
        PUSHED,
    ),
    "guides": (
        "  second: {type: point-on-line, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n"
        "  third: {type: point-on-plane, bodies: [b, c], point: [0.9, 0.1, 0], axis: [0.2, 1, 0.3]}\n"
        "  fourth: {type: fixed, bodies: [c, d], point: [1.2, 0.1, 0]}\n",
        PUSHED,
    ),
    "springs": (
        "  second: {type: cylindrical, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n",
        PUSHED + "  s: {type: spring-damper, markers: [g, bm], stiffness: 50, damping: 2, free_length: 0.3}\n"
        "  t: {type: torsional-spring-damper, markers: [am, bm], stiffness: 1, damping: 0.02, free_angle: 1}\n"
        "  v: {type: joint-spring-damper, coordinate: second.displacement, stiffness: 80, free_value: 0.05, preload: 2}\n"
        "  w: {type: joint-spring-damper, coordinate: second.angle, law: 3*value + 0.2*rate}\n"
        "  n: {type: joint-spring-damper, coordinate: second.displacement, table: {deflections: [-0.1, 0, 0.1], efforts: [-9, 0, 2]}}\n"
        "  p: {type: pair-force, bodies: [a, c], points: [[0.3, 0, 0], [1, 0.2, 0.1]], vector: [1, 2, 3], axes: first}\n"
        "  q: {type: pair-force, markers: [am, bm], magnitude: 3*length + rate}\n",
    ),
    "bushing": (
        "",
        FREE + "  m:\n    type: bushing\n    bodies: [a, b]\n    points: [[0.5, 0.15, -0.25], [0.52, 0.1, -0.2]]\n"
        "    stiffness:\n      - [200, 10, 20, 1, 0, 2]\n      - [10, 300, 30, 0, 1, 0]\n      - [20, 30, 250, 3, 0, 1]\n"
        "      - [1, 0, 3, 9, 1, 2]\n      - [0, 1, 0, 1, 8, 1]\n      - [2, 0, 1, 2, 1, 7]\n    damping: [1, 2, 3, 0.1, 0.2, 0.3]\n",
    ),
    "signals": (
        "  second: {type: cylindrical, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n",
        FREE + "  e: {type: motor, coordinate: second.displacement, effort: 3 - 10*second.displacement_rate + am.x}\n"
        "  f: {type: motor, coordinate: second.angle, effort: {of: second.displacement, points: [-0.1, 0.3], values: [1, 2]}}\n"
        "  h: {type: force, body: b, vector: [bm.x, -3*bm.vy, 2*b.wz]}\n",
    ),
    "limits": (
        "  second: {type: cylindrical, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n",
        FREE + "  e: {type: motor, coordinate: second.displacement, speed: 2, gain: 30, limit: 20}\n"
        "  k: {type: stop, coordinate: second.displacement, lower: -1, upper: 2 cm, stiffness: 2e3, restitution: 0.8}\n"
        "  r: {type: friction, coordinate: second.displacement, model: coulomb, coefficient: 0.2, transition_speed: 1 cm/s}\n"
        "  u: {type: contact, body: b, plane: floor, stiffness: 1e4, restitution: 0.5, friction: 0.3, friction_transition_speed: 0.1}\n"
        "  x: {type: force, body: b, vector: [0, 0, -40]}\n",
    ),
    "drivers": (
        "  second: {type: cylindrical, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n"
        "drivers:\n"
        "  i: {coordinate: second.displacement, value: time^2}\n"
        "  j: {marker: am, along: z, value: PLACE + 0.5*time^2}\n",
        PUSHED,
    ),
    "couplings": (
        "  second: {type: cylindrical, bodies: [a, b], point: [0.5, 0.15, -0.25], axis: [0, 1, 0.2]}\n"
        "  third: {type: cylindrical, bodies: [b, c], point: [0.9, 0.1, 0], axis: [0.2, 1, 0.3]}\n"
        "couplings:\n"
        "  i: {type: gear, joints: [second.angle, third.angle], teeth: [20, 30]}\n"
        "  j: {type: linear, coordinates: [second.displacement, third.angle], factors: [1, 0.2]}\n",
        PUSHED,
    ),
}


def machine_of(name):
    joints, forces = MACHINES[name]
    text = f"{BODIES}{JOINTS}{joints}forces:\n{forces}"
    if "PLACE" in text:  # where the marker is as placed, so that nothing has to be assembled
        scene = parse_machine(text.replace("PLACE", "0"))
        text = text.replace("PLACE", repr(height(scene)))
    return parse_machine(text)


def height(machine):
    from nivel.machine.core.orientation import matrix_from_euler_parameters
    from nivel.machine.core.placement import placement

    position, parameters = placement(machine.bodies[0])
    return float((position + matrix_from_euler_parameters(parameters) @ machine.markers[0].position)[2])


@pytest.fixture(scope="module")
def moved():
    """Simulates each machine once."""
    done = {}

    def run(name):
        if name not in done:
            found = machine_of(name)
            # steps of both fall together
            machine = found.with_simulation(found.simulation.replace(integrator="rk4"))
            done[name] = (machine, Machine.from_record(machine).simulate())
        return done[name]

    return run


@pytest.mark.parametrize("placing", PLACEMENTS.values(), ids=PLACEMENTS.keys())
@pytest.mark.parametrize("name", MACHINES)
def test_the_image_moves_as_an_image(name, placing, moved):
    machine, result = moved(name)
    elements = {section: getattr(machine, section) for section in SECTIONS}
    image = Machine.from_record(machine.replace(**placed(elements, placing))).simulate()
    was, now = result.dataset, image.dataset
    positions = was["position"].values
    assert np.ptp(positions, axis=0).max() > 0.01
    assert np.allclose(now["position"], positions @ placing.polar.T + placing.translation, atol=1e-10, rtol=0)
    turning = was["angular_velocity"].values @ placing.axial.T
    assert np.allclose(now["angular_velocity"], turning, atol=1e-9, rtol=0)
    types = {joint.name: joint.type for joint in machine.joints}
    measured = (
        was["joint_coordinate"].coords[was["joint_coordinate"].dims[1]].values if "joint_coordinate" in was else ()
    )
    for at, coordinate in enumerate(measured):
        joint, _, kind = str(coordinate).partition(".")
        opposite = placing.mirrored and types[joint] in ("cylindrical", "screw") and kind == "displacement"
        values = was["joint_coordinate"].values[:, at]
        assert np.allclose(now["joint_coordinate"][:, at], -values if opposite else values, atol=1e-9, rtol=0)
