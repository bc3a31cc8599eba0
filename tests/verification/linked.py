"""Machines for relative coordinates: joints between markers turned any way, loops of many kinds, every element on one machine."""

import math

import numpy as np
from scipy.spatial.transform import Rotation

from machines import GRAVITY, random_body
from nivel import Joint, MachineRecord, Marker, PointForce
from nivel.elements.joints import JOINTS
from nivel.system.elimination.topology import carries
from simulating import G, hinge, machine, slide, solid

CARRIERS = tuple(kind for kind in JOINTS if carries(kind))
PITCH = -0.6


def joint_motion(kind, rng, *, half=False):
    """(Q, d): turn and displacement of the second marker in the first one's axes that a joint of `kind` allows.

    half : the x axes of translational and fixed joints half a turn apart.
    """
    angle, about_x = rng.uniform(-3, 3), Rotation.from_euler("z", np.pi if half else 0.0)
    match kind:
        case "revolute":
            return Rotation.from_euler("z", angle), np.zeros(3)
        case "cylindrical" | "screw":
            return Rotation.from_euler("z", angle), np.array([0, 0, rng.uniform(-1, 1)])
        case "translational":
            return about_x, np.array([0, 0, rng.uniform(-1, 1)])
        case "fixed":
            return about_x, np.zeros(3)
        case "planar":
            return Rotation.from_euler("z", angle), np.append(rng.uniform(-1, 1, 2), 0.0)
        case "spherical":
            return Rotation.random(rng=rng), np.zeros(3)
    # universal: z axes perpendicular, turned about the first and the second of them
    return Rotation.from_euler("ZXZ", [angle, np.pi / 2, rng.uniform(-3, 3)]), np.zeros(3)


def marked_joint(name, kind, first, second, rng, *, turned=False, half=False):
    """(joint, second body moved to where the joint is closed) between random markers of two bodies; first may be "ground".

    turned : the joint is written from the second body to the first.
    """
    places = [rng.uniform(-0.5, 0.5, 3), rng.uniform(-0.5, 0.5, 3)]
    frames = [Rotation.random(rng=rng), Rotation.random(rng=rng)]
    Q, d = joint_motion(kind, rng, half=half)
    A, R = (Rotation.identity(), np.zeros(3)) if first == "ground" else pose(first)
    A_second = A * frames[0] * Q * frames[1].inv()
    R_second = R + A.apply(places[0] + frames[0].apply(d)) - A_second.apply(places[1])
    second = second.replace(
        position=tuple(R_second), orientation={"euler_parameters": A_second.as_quat(scalar_first=True).tolist()}
    )
    names = ["ground" if first == "ground" else first.name, second.name]
    ends = [
        Marker(
            body=body,
            position=tuple(place),
            orientation={"euler_parameters": frame.as_quat(scalar_first=True).tolist()},
        )
        for body, place, frame in zip(names, places, frames, strict=True)
    ]
    options = {"pitch": PITCH} if kind == "screw" else {}
    return Joint(name=name, type=kind, markers=tuple(ends[:: -1 if turned else 1]), **options), second


def pose(body):
    """(turn, position) of a body given with Euler parameters."""
    return Rotation.from_quat(body.orientation.euler_parameters, scalar_first=True), np.array(body.position)


def marked_pair(kind, rng, *, ground=False, turned=False, half=False):
    """Two bodies (or one and the ground) with one joint between random markers, a follower force, gravity."""
    first = "ground" if ground else random_body("a", rng)
    joint, second = marked_joint("j", kind, first, random_body("b", rng), rng, turned=turned, half=half)
    push = PointForce(name="push", body="b", position=(0.1, 0.2, 0.3), vector=(3, -2, 5), axes="body")
    bodies = (second,) if ground else (first, second)
    return MachineRecord(name=kind, bodies=bodies, joints=(joint,), forces=(push,), gravity=GRAVITY)


def marked_tree(rng, *, free=False, branches=2):
    """Branches in which every kind of joint stands once, in random order, each written one way or the other; `free`: of the ground."""
    bodies, joints = [], []
    root = "ground"
    if free:
        root = random_body("root", rng)
        bodies.append(root)
    for k in range(branches):
        at = root
        for kind in rng.permutation([*CARRIERS]):
            name = f"{kind}{k}"
            joint, at = marked_joint(
                name,
                str(kind),
                at,
                random_body(f"b_{name}", rng),
                rng,
                turned=rng.random() < 0.5,
                half=rng.random() < 0.5,
            )
            bodies.append(at)
            joints.append(joint)
    return MachineRecord(name="marked-tree", bodies=tuple(bodies), joints=tuple(joints), gravity=GRAVITY)


def chain(count, kinds, *, ends="ground", point=(0.0, 0.0, 0.0), step=(0.3, 0.1, 0.0)):
    """`count` bars end to end from `point`, joints of `kinds` between them in turn; ends: on the "ground", or "free"."""
    bodies, joints = {}, {}
    points = [
        np.array(point) + k * np.array(step) + 0.05 * np.array([0, math.sin(k), math.cos(2 * k)])
        for k in range(count + 1)
    ]
    for k in range(count):
        bodies[f"b{k}"] = solid(
            1.0 + 0.1 * k, (0.02, 0.03, 0.04), position=(points[k] + 0.4 * (points[k + 1] - points[k])).tolist()
        )
        first = "ground" if k == 0 else f"b{k - 1}"
        if k > 0 or ends == "ground":
            joints[f"j{k}"] = placed(kinds[k % len(kinds)], first, f"b{k}", points[k], k)
    return bodies, joints, points


def placed(kind, first, second, point, k=0):
    """A joint at a global point, its axis depending on k."""
    axis = [math.sin(1.3 * k), math.cos(2.1 * k), 0.5]
    joint = {"type": kind, "bodies": [first, second], "point": [float(x) for x in point]}
    if kind == "universal":
        return {**joint, "axes": [axis, [axis[1], -axis[0], 0.0]]}
    return joint if kind in ("spherical", "fixed") else {**joint, "axis": axis}


def loops():
    """Two loops that share bars, on the ground at two places: twelve bars, joints of five kinds."""
    bodies, joints, points = chain(8, ("revolute", "spherical", "universal", "cylindrical"))
    joints["end"] = placed("spherical", "ground", "b7", points[8])
    for k, (first, second) in enumerate((("b2", "c0"), ("c0", "c1"), ("c1", "b6"))):
        point = points[3] + np.array([0.2 * k, 0.3 if k else 0.0, 0.0])
        joints[f"c{k}"] = placed(("spherical", "universal", "spherical")[k], first, second, point, k)
    for k in range(2):
        bodies[f"c{k}"] = solid(0.7, (0.01, 0.02, 0.02), position=(points[3] + [0.1 + 0.2 * k, 0.2, 0.0]).tolist())
    return {"gravity": [0, -G, 0], "bodies": bodies, "joints": joints}


def free_ring():
    """A ring of seven bars that hangs on nothing, turning."""
    bodies, joints, points = chain(7, ("spherical", "universal", "spherical", "cylindrical"), ends="free")
    joints["closing"] = placed("spherical", "b6", "b0", 0.5 * (points[0] + points[7]), 3)
    bodies["b3"]["angular_velocity"] = [0.3, 1.0, -0.5]
    bodies["b0"]["velocity"] = [0.1, 0.2, 0.3]
    return {"bodies": bodies, "joints": joints}


def every_element(carried_friction="coulomb"):
    """Arms, a slider and a ball on a moving base with everything that acts on machines: laws of joints, markers and bodies, couplings,
    a driver, frictions of given and of their own load, bushing, contacts, springs, stop, motor, a point mass, sensors."""
    gravity = [1.0, -G, 2.0]
    bodies = {
        "base": solid(
            4.0, (0.3, 0.4, 0.5), centre_of_mass=[0.05, 0.1, -0.02], orientation={"axis": [1, 2, 3], "angle": 0.7}
        ),
        "arm": solid(1.0, (0.02, 0.03, 0.035), position=[0.4, 0.1, 0.1], centre_of_mass=[0.1, 0, 0.05]),
        "hand": solid(
            0.5, (0.01, 0.012, 0.015), position=[0.8, 0.1, 0.2], orientation={"axis": [0, 1, 1], "angle": -0.4}
        ),
        "slider": solid(0.8, (0.02, 0.02, 0.03), position=[-0.4, 0.3, 0], centre_of_mass=[0, 0.05, 0]),
        "wheel": solid(0.6, (0.01, 0.01, 0.02), position=[-0.4, 0.5, 0.1]),
        "ball": {"shape": {"type": "sphere", "radius": 0.2}, "mass": 1.0, "position": [0.2, -0.81, 0.3]},
        "bead": {"mass": 0.3, "point_mass": True, "position": [1.0, 0.4, 0.3]},
        "crate": {"shape": {"type": "box", "size": [0.2, 0.3, 0.4]}, "mass": 1.0, "position": [2.0, -0.86, 0.0]},
    }
    joints = {
        "foot": {
            "type": "universal",
            "bodies": ["base", "ground"],
            "point": [0, -0.5, 0],
            "axes": [[1, 0, 0], [0, 0, 1]],
        },
        "shoulder": hinge("arm", "base", (0.2, 0.1, 0.0)),
        "wrist": {"type": "cylindrical", "bodies": ["arm", "hand"], "point": [0.7, 0.1, 0.1], "axis": [1, 0.3, 0]},
        "guide": slide("base", "slider", (0.2, 1.0, 0.1), point=[-0.3, 0.3, 0]),
        "axle": {"type": "revolute", "bodies": ["wheel", "slider"], "point": [-0.4, 0.5, 0.1], "axis": [0.1, 0, 1]},
        "string": {"type": "distance", "bodies": ["hand", "bead"], "points": [[0.9, 0.1, 0.2], [1.0, 0.4, 0.3]]},
        "tether": {"type": "spherical", "bodies": ["ball", "crate"], "point": [1.0, -0.8, 0.1]},
    }
    markers = {
        "tip": {"body": "hand", "position": [0.1, 0.0, 0.02], "orientation": {"axis": [0, 0, 1], "angle": 0.3}},
        "eye": {"body": "slider", "position": [0.0, 0.1, 0.0], "axis": [0.3, 0.2, 1]},
        "floor": {"body": "ground", "position": [0, -1.0, 0], "axis": [0.05, 1, 0]},
    }
    forces = {
        "law": {"type": "force", "body": "hand", "position": [0.1, 0, 0], "axes": "body",
                "vector": ["3*sin(shoulder.angle) - tip.vx", "-2*arm.wz + eye.y", "0.5*hand.x + 0.1*guide.displacement_rate"]},
        "twist": {"type": "torque", "body": "base", "vector": ["0.3*base.wx", "-0.5*foot.angle_1", "0.2*foot.angle_2_rate"]},
        "coil": {"type": "joint-spring-damper", "coordinate": "shoulder", "stiffness": 4.0, "damping": 0.05},
        "rail": {"type": "joint-spring-damper", "coordinate": "wrist.displacement", "stiffness": 90.0, "damping": 0.5},
        "stop": {"type": "stop", "coordinate": "wrist.angle", "lower": -0.01, "upper": 0.01, "stiffness": 50.0, "restitution": 0.5},
        "motor": {"type": "motor", "coordinate": "axle", "speed": 3.0, "gain": 0.2, "limit": 0.4},
        "mount": {"type": "bushing", "markers": ["tip", "eye"], "stiffness": [4, 6, 8, 0.5, 0.8, 0.6], "damping": [1, 2, 1, 0.1, 0.2, 0.1]},
        "cord": {"type": "spring-damper", "markers": ["tip", "floor"], "law": "50*(length - 0.3) + 0.5*rate"},
        "pull": {"type": "pair-force", "markers": ["eye", "tip"], "magnitude": "-3/length + 2*sin(4*time)"},
        "ground": {"type": "contact", "body": "ball", "plane": "floor", "stiffness": 1e4, "restitution": 0.5, "friction": 0.3,
                   "friction_model": "stiction" if carried_friction == "stiction" else "coulomb", "friction_transition_speed": 0.01},
        "corner": {"type": "contact", "body": "crate", "plane": "floor", "stiffness": 1e4, "exponent": 1.5, "restitution": 0.7},
        "own": {"type": "friction", "model": carried_friction, "coordinate": "foot.angle_1", "normal_load": 20.0, "radius": 0.03,
                **_friction(carried_friction)},
        "pressed": {"type": "friction", "model": "coulomb", "coordinate": "guide", "coefficient": 0.2, "transition_speed": 0.01},
    }  # fmt: skip
    sensors = {
        **{f"tip_{q}": {"marker": "tip", "quantity": q} for q in QUANTITIES},
        **{f"seen_{q}": {"marker": "tip", "relative_to": "eye", "quantity": q} for q in QUANTITIES},
        **{f"angle_{q}": {"coordinate": "shoulder.angle", "quantity": q} for q in ("value", "rate", "acceleration")},
        "gap": {"distance": ["tip", "eye"]},
        "tilt": {"angle": ["tip", "floor"]},
        "sum": {"value": "0.5*shoulder.angle_rate^2 + gap.distance*5 + hand.wy + eye.vz", "units": "J"},
    }
    return {
        "gravity": gravity,
        "bodies": bodies,
        "markers": markers,
        "joints": joints,
        "couplings": {"gear": {"type": "linear", "coordinates": ["axle.angle", "wrist.angle"], "factors": [1, 2]}},
        "drivers": {"lift": {"coordinate": "foot.angle_2", "value": "0.3*sin(4*time)"}},
        "forces": forces,
        "sensors": sensors,
    }


QUANTITIES = ("position", "velocity", "acceleration", "angular_velocity", "angular_acceleration")


def _friction(model):
    more = {"coulomb": {"transition_speed": 0.01}, "stiction": {}, "lugre": {"bristle_stiffness": 500.0}}
    return {"coefficient": 0.3, **more[model]}


def record(sections):
    """The machine record of `sections`."""
    return machine(sections).record
