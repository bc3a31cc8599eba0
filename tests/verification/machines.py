"""Machines for the tests: pairs of bodies with one joint, report 44's machines, chains and loops; written in Python."""

import numpy as np
from scipy.spatial.transform import Rotation

from nivel import Body, Joint, MachineRecord, Marker, PointForce, SimulationSettings, Torque
from nivel.elements.joints import JOINTS
from nivel.elements.joints.constraints import generic

GRAVITY = (0.0, -9.81, 0.0)


def random_body(name, rng, *, centre=True):
    """A body anywhere, with its frame away from the centre of mass, moving."""
    edges = rng.uniform(0.2, 1.0, 3)
    principal = np.array([edges[1] ** 2 + edges[2] ** 2, edges[0] ** 2 + edges[2] ** 2, edges[0] ** 2 + edges[1] ** 2])
    axes = Rotation.random(rng=rng).as_matrix()
    return Body(
        name=name,
        mass=rng.uniform(1, 5),
        centre_of_mass=tuple(rng.uniform(-0.4, 0.4, 3)) if centre else (0, 0, 0),
        inertia=(axes @ np.diag(principal) @ axes.T).tolist(),
        position=tuple(rng.uniform(-1, 1, 3)),
        orientation={"euler_parameters": Rotation.random(rng=rng).as_quat(scalar_first=True).tolist()},
        velocity=tuple(rng.uniform(-1, 1, 3)),
        angular_velocity_body=tuple(rng.uniform(-3, 3, 3)),
    )


PARALLEL_LINK = "revolute-cylindrical, parallel"
BETWEEN_BODIES = tuple(kind for kind in JOINTS if not JOINTS[kind].rail)
LOCKED = ("rx", "ry")  # of the generic joint
KINDS = (*BETWEEN_BODIES, PARALLEL_LINK)


def composition(kind):
    """What a joint of `kind` is made of."""
    if kind == "generic":
        return generic(LOCKED)
    if kind == PARALLEL_LINK:
        return JOINTS["revolute-cylindrical"].composition.when_parallel
    return JOINTS[kind].composition


def joint_at(name, kind, first, second, rng, point=None):
    """A joint of `kind` between two bodies at random points and directions."""
    joint_type = "revolute-cylindrical" if kind == PARALLEL_LINK else kind
    facts = JOINTS[joint_type]
    point = tuple(rng.uniform(-1, 1, 3)) if point is None else point
    z = rng.standard_normal(3)
    x = np.cross(z, rng.standard_normal(3))
    options = {"point": point}
    if "points" in facts.place:
        options = {"points": (point, tuple(point + rng.uniform(0.3, 1, 3)))}
    if "axes" in facts.place:
        skew = z if kind == PARALLEL_LINK else rng.standard_normal(3)
        options["axes"] = (tuple(z), tuple(skew if joint_type in ("revolute-cylindrical", "rolling") else x))
    if "axis" in facts.place:
        options["axis"] = tuple(np.cross(z, x) if "axes" in facts.place else z)
    if joint_type == "rolling":
        options |= wheel(options["points"], options["axes"])
    if "locked" in facts.size:
        options["locked"] = LOCKED
    if "x_axis" in facts.may:
        options["x_axis"] = tuple(x)
    if "pitch" in facts.size:
        options["pitch"] = 0.7
    return Joint(name=name, type=joint_type, bodies=(first, second), **options)


def wheel(points, axes):
    """A wheel with these points and axes that touches the plane: which side of it is outside, and the radii."""
    n, a = (np.array(axis) / np.linalg.norm(axis) for axis in axes)
    height = n @ (np.array(points[1]) - points[0])
    radius = abs(height) / (0.7 * np.sqrt(1 - (a @ n) ** 2) + 0.3)
    return {"axes": (tuple(np.sign(height) * n), tuple(a)), "radius": radius, "rim_radius": 0.3 * radius}


def pair(kind, rng, *, ground=False):
    """Two bodies (or one and the ground) with one joint, loads, gravity."""
    bodies = [random_body("a", rng)] if ground else [random_body("a", rng), random_body("b", rng)]
    second = "ground" if ground else "b"
    loads = (
        PointForce(name="push", body="a", position=(0.1, 0.2, 0.3), vector=(3, -2, 5), axes="body"),
        Torque(name="twist", body="a", vector=(1, 2, -1)),
    )
    return MachineRecord(
        name=kind, bodies=tuple(bodies), joints=(joint_at("j", kind, "a", second, rng),), forces=loads, gravity=GRAVITY
    )


def tree(rng):
    """A chain of many joint kinds from the ground, its bodies off their centres of mass."""
    kinds = ("spherical", "universal", "revolute", "cylindrical", "translational", "fixed", "planar", "screw")
    names = [f"b{k}" for k in range(len(kinds))]
    bodies = tuple(random_body(name, rng) for name in names)
    joints = tuple(
        joint_at(f"j{k}", kind, "ground" if k == 0 else names[k - 1], names[k], rng) for k, kind in enumerate(kinds)
    )
    return MachineRecord(name="tree", bodies=bodies, joints=joints, gravity=GRAVITY)


def slider_crank(**settings):
    """The spatial slider-crank of report 44."""
    return MachineRecord(
        name="slider-crank",
        gravity=GRAVITY,
        bodies=(
            Body(
                name="crank",
                mass=21,
                inertia=(2.2e-2, 0.513, 0.526),
                position=(0, 0, -0.25),
                orientation={"euler": [np.pi / 2, np.pi / 2, -np.pi / 2], "sequence": "zxz"},
            ),
            Body(name="rod", mass=71.7, inertia=(7.5e-2, 20.22, 20.27), position=(0.9, 0, -0.5)),
            Body(name="slider", mass=7.8, inertia=(1.3e-2,) * 3, position=(1.8, 0, -0.5)),
        ),
        joints=(
            Joint(name="hinge", type="revolute", bodies=("crank", "ground"), point=(0, 0, 0), axis=(1, 0, 0)),
            Joint(
                name="pin",
                type="spherical",
                markers=(Marker(body="crank", position=(0.25, 0, 0)), Marker(body="rod", position=(-0.9, 0, 0))),
            ),
            Joint(
                name="knee",
                type="universal",
                bodies=("rod", "slider"),
                point=(1.8, 0, -0.5),
                axes=((0, 1, 0), (0, 0, 1)),
            ),
            Joint(
                name="slide", type="translational", bodies=("slider", "ground"), point=(1.8, 0, -0.5), axis=(1, 0, 0)
            ),
        ),
        forces=(Torque(name="drive", body="crank", vector=(-50, 0, 0)),),
        simulation=SimulationSettings(**({"duration": 8.0} | settings)),
    )


def four_bar(third="cylindrical", second="spherical", **settings):
    """The planar four-bar of report 44; `second` and `third` are its coupler's joints."""

    def at(body, x):
        return Marker(body=body, position=(x, 0, 0))

    bars = (
        ("crank", 78.1, (8.14e-2, 26.1, 26.0), (0.5, 0.866025403784, 0), 1.047197551197),
        ("coupler", 156.2, (0.163, 208.4, 208.3), (2.823521413620, 2.553494447797, 0), 0.423245598298),
        ("rocker", 156.2, (0.163, 208.4, 208.3), (3.573521413620, 1.687469044012, 0), 1.004203159591),
    )
    return MachineRecord(
        name="four-bar",
        gravity=GRAVITY,
        bodies=tuple(
            Body(name=n, mass=m, inertia=J, position=r, orientation={"axis": [0, 0, 1], "angle": a})
            for n, m, J, r, a in bars
        ),
        joints=(
            Joint(name="hinge", type="revolute", markers=(Marker(body="ground"), at("crank", -1))),
            Joint(name="pin", type=second, markers=(at("crank", 1), at("coupler", -2))),
            Joint(name="sleeve", type=third, markers=(at("coupler", 2), at("rocker", 2))),
            Joint(
                name="pivot", type="revolute", markers=(at("rocker", -2), Marker(body="ground", position=(2.5, 0, 0)))
            ),
        ),
        forces=(Torque(name="drive", body="crank", vector=(0, 0, -1200)),),
        simulation=SimulationSettings(**({"duration": 4.0} | settings)),
    )


def heavy_top(**settings):
    """Heavy top of Arnold and Brüls: frame at the fixed point, centre of mass on the body y axis."""
    return MachineRecord(
        name="heavy-top",
        gravity=(0, 0, -9.81),
        bodies=(
            Body(
                name="top",
                mass=15,
                centre_of_mass=(0, 1, 0),
                inertia=(0.234375, 0.46875, 0.234375),
                angular_velocity_body=(0, 150, -4.61538),
            ),
        ),
        joints=(Joint(name="tip", type="spherical", bodies=("ground", "top"), point=(0, 0, 0)),),
        simulation=SimulationSettings(**({"duration": 2.0} | settings)),
    )


def bennett():
    """Bennett's spatial linkage (1903): four skew hinges that turn although Grübler counts -2 freedoms.

    Links a, b, a, b with twists α, β, α, β and a/sin α = b/sin β; at every position
    tan(θ1/2) tan(θ2/2) = sin((β + α)/2)/sin((β - α)/2), opposite angles add up to a full turn.
    """
    a, twist_a, twist_b, first = 1.0, 0.7, 1.3, 1.1
    b = a * np.sin(twist_b) / np.sin(twist_a)
    ratio = np.sin((twist_b + twist_a) / 2) / np.sin((twist_b - twist_a) / 2)
    second = 2 * np.arctan(ratio / np.tan(first / 2))
    frame = np.eye(4)
    hinges = []
    for length, twist, angle in (
        (a, twist_a, first),
        (b, twist_b, second),
        (a, twist_a, -first),
        (b, twist_b, -second),
    ):
        hinges.append(frame.copy())
        turn, slide = np.eye(4), np.eye(4)
        turn[:3, :3] = Rotation.from_rotvec([0, 0, angle]).as_matrix()
        slide[:3, :3] = Rotation.from_rotvec([twist, 0, 0]).as_matrix()
        slide[0, 3] = length
        frame = frame @ turn @ slide
    np.testing.assert_allclose(frame, np.eye(4), atol=1e-12)
    names = ("ground", "one", "two", "three")
    centres = [(hinges[k][:3, 3] + hinges[(k + 1) % 4][:3, 3]) / 2 for k in range(4)]
    bodies = tuple(
        Body(name=names[k], mass=2, inertia=(0.1, 0.15, 0.2), position=tuple(centres[k - 1])) for k in range(1, 4)
    )
    joints = tuple(
        Joint(
            name=f"h{k}",
            type="revolute",
            bodies=(names[k], names[(k + 1) % 4]),
            point=tuple(hinges[k][:3, 3]),
            axis=tuple(hinges[k][:3, 2]),
        )
        for k in range(4)
    )
    return MachineRecord(name="bennett", gravity=(0, 0, -9.81), bodies=bodies, joints=joints)
