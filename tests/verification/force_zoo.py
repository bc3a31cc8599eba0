"""Every kind of force, coupling and driver once, and more than once where it has branches, on machines in motion."""

from dataclasses import dataclass, field

import linked
from simulating import G, hinge, slide, solid

LAW = """
import math

import numpy as np

LIMIT = 0.4


def tension(length, rate, stiffness):
    \"\"\"Progressive, with a softer damper on the way in.\"\"\"
    stretch = length - 0.3
    force = stiffness*stretch + 30.0*stretch**3
    if rate < 0.0:
        return force + 2.0*rate
    return force + 5.0*math.tanh(rate) + 0.1*abs(stretch)


def pull(angle, rate, time):
    total = 0.0
    for k in range(1, 4):
        total += math.sin(k*angle)/k
    return -2.0*total - bounded(rate) + math.exp(-time)*np.cos(angle)


def bounded(x):
    return max(min(0.3*x, LIMIT), -LIMIT)
"""


def law(function, *arguments):
    return {"source": LAW, "function": function, "arguments": list(arguments)}


# faster controllers are stiffer than differences of 5e-11 can tell
MOTOR = {
    "type": "synchronous-motor", "coordinate": "axle.angle", "effort": "2*sin(3*time)", "torque_constant": 0.3, "resistance": 0.5,
    "inductance": 0.02, "inductance_d": 0.01, "current_limit": 2, "current_d": -0.5, "bandwidth": 0.5, "dc_voltage": 100,
    "inverter_drop": 0.5, "friction_torque": 0.1,
}  # fmt: skip
# slower windings too; the flux grows from almost nothing
INDUCTION = {
    "type": "induction-motor", "coordinate": "axle.angle", "resistance": 0.1, "rotor_resistance": 0.1, "inductance": 0.2,
    "stator_leakage": 0.05, "rotor_leakage": 0.05,
}  # fmt: skip
INVERTER = {"effort": "2*sin(3*time)", "current_limit": 2, "current_d": 0.5, "bandwidth": 0.1, "dc_voltage": 100}


@dataclass(frozen=True)
class Case:
    """A force by its words on the machine `bed`, with further sections.

    place : body that is put at an offset [m] from another one, or from the origin, before the state is looked at: the body, the other, the
    offset. touches : surfaces overlap there, or (False) are apart.
    """

    force: dict
    place: tuple | None = None
    touches: bool | None = None
    more: dict = field(default_factory=dict)


def bed(case):
    """Two bodies that tumble, a cylindrical joint between them; a third one alone, a wheel on the ground."""
    bodies = {
        "a": solid(1.3, (0.05, 0.08, 0.06), position=[0.0, 0.1, 0.5], centre_of_mass=[0.03, 0.02, -0.01]),
        "b": solid(0.9, (0.03, 0.04, 0.02), position=[0.6, 0.2, 0.7], orientation={"axis": [1, 2, 0], "angle": 0.4}),
        "c": solid(0.7, (0.02, 0.02, 0.03), position=[-0.5, 0.9, 0.4], orientation={"axis": [0, 1, 1], "angle": 1.1}),
        "wheel": solid(0.6, (0.01, 0.01, 0.02), position=[1.0, -0.5, 0.2]),
    }
    markers = {
        "tip": {"body": "a", "position": [0.1, 0.05, 0.02], "orientation": {"axis": [0, 0, 1], "angle": 0.3}},
        "eye": {"body": "b", "position": [-0.05, 0.1, 0.03], "axis": [0.3, 0.2, 1]},
        "far": {"body": "c", "position": [0.05, -0.1, 0.1], "axis": [1, 0.2, 0.4]},
        "floor": {"body": "ground", "position": [0, 0, 0.0], "axis": [0.05, -0.1, 1]},
    }
    joints = {
        "j": {"type": "cylindrical", "bodies": ["a", "b"], "point": [0.3, 0.1, 0.6], "axis": [1, 0.3, 0.2]},
        "axle": hinge("ground", "wheel", (1.0, -0.5, 0.0)),
    }
    sections = {"gravity": [1.0, 2.0, -G], "bodies": bodies, "markers": markers, "joints": joints}
    for name, more in case.more.items():
        sections[name] = {**sections.get(name, {}), **more}
    return linked.record({**sections, "forces": {"f": case.force}})


def shape(body, kind, **size):
    """`body` of the bed with a shape, in place of its inertia."""
    return {"bodies": {body: {"shape": {"type": kind, **size}, "mass": 0.8, "position": [-0.5, 0.9, 3.0],
                              "orientation": {"axis": [1, 1, 0.2], "angle": 0.5}}}}  # fmt: skip


BETWEEN = {"markers": ["tip", "eye"]}
RUBBING = {"type": "friction", "coordinate": "j.displacement", "coefficient": 0.3, "static_coefficient": 0.45,
           "stribeck_speed": 1.0}  # fmt: skip
CONTACT = {
    "type": "contact",
    "stiffness": 3e3,
    "restitution": 0.6,
    "friction": 0.3,
    "friction_model": "coulomb",
    "friction_transition_speed": 0.8,
}
STICKING = {"type": "contact", "stiffness": 3e3, "restitution": 0.6, "friction": 0.3}
ON_FLOOR_STICKING = {**STICKING, "body": "c", "plane": "floor"}
PRISM = [[-0.3, -0.35], [0.3, -0.35], [0.35, 0.3], [-0.2, 0.35]]
ON = ("c", "", [-0.5, 0.9, 0.4])
ON_FLOOR = {**CONTACT, "body": "c", "plane": "floor"}
MOUNT = {"type": "bushing", **BETWEEN, "stiffness": [4, 6, 8, 0.5, 0.8, 0.6], "damping": [1, 2, 1, 0.1, 0.2, 0.1]}

OTHERS = {
    "box": {"type": "box", "size": [0.6, 0.5, 0.4]},
    "cylinder": {"type": "cylinder", "radius": 0.3, "length": 0.5},
    "capsule": {"type": "capsule", "radius": 0.3, "length": 0.5},
    "prism": {"type": "extrusion", "outline": PRISM, "length": 0.5},
}


# within the reach of a wheel at x = -0.5
KERB = {"size": [6, 6], "function": "0.15 + 0.12*step(x, -0.3, 0, -0.2, 1)", "points": [61, 61]}
HILLS = {"size": [6, 6], "function": "0.25 + 0.1*sin(2*x) + 0.07*cos(3*y)", "points": [13, 15]}
EGG = {"type": "ellipsoid", "semi_axes": [0.4, 0.3, 0.25]}


def round_pair(first, second, apart, contact=CONTACT):
    """Body c, with the first shape, and a block with the second one, which touch."""
    more = {
        **shape("c", first["type"], **{k: v for k, v in first.items() if k != "type"})["bodies"],
        "block": {"shape": second, "mass": 0.5, "position": [-0.4, 0.6, 1.9]},
    }
    return Case({**contact, "bodies": ["c", "block"]}, ("c", "block", apart), True, {"bodies": more})


MAGIC = {"version": "6.1", "coefficients": {
    "FNOMIN": 60, "UNLOADED_RADIUS": 0.3, "PCX1": 1.6, "PDX1": 1.1, "PDX2": -0.1, "PEX1": 0.2, "PKX1": 20, "PHX1": 1e-3,
    "PCY1": 1.3, "PDY1": 1, "PKY1": -18, "PKY2": 1.7, "PKY6": -0.9, "PHY1": 2e-3, "PVY1": 0.01, "RBX1": 10, "RBX2": -9, "RCX1": 1,
    "RBY1": 9, "RBY2": 7, "RCY1": 1, "QBZ1": 10, "QCZ1": 1.1, "QDZ1": 0.1, "QDZ6": 0.01, "QBZ9": 10, "QSX1": 0.01, "QSX2": 0.8,
    "QSX3": 0.05, "QSY1": 0.01, "SSZ2": 0.02}}  # fmt: skip
TYRE = {"type": "tyre", "wheel": {"body": "c", "axis": [0.1, 1, 0.2]}, "plane": "floor", "radius": 0.3, "width": 0.2, "nominal_load": 60,
        "stiffness": 900, "damping": 3, "along": {"stiffness": 700, "damping": 4}, "across": {"stiffness": 500, "damping": 4}}  # fmt: skip
SOIL = {"plane": "floor", "heights": {"size": [6, 6], "function": "0.1*x + 0.07*y", "points": [61, 61]},
        "soil": {"density": 4, "cohesion": 3, "modulus": 2e3, "unloading": 5e4}}  # fmt: skip
BELT = {"type": "track", "radius": 0.3, "width": 0.2, "sprocket": {"body": "a", "axis": [0.1, 1, 0.2]},
        "contact": [{"body": "c", "position": [0.19, -0.22, 0.28], "axis": [-0.67, 0.17, 0.73]},
                    {"body": "c", "position": [-0.19, 0.22, -0.28]}]}  # fmt: skip
# slips at which this one rolls
ROLLS = {way: {**TYRE[way], "peak_slip": [4, 4.5], "sliding_slip": [20, 22]} for way in ("along", "across")}
LEVER = {"range": [-1, 1], "signal": {"times": [0, 1], "values": [0.1, 0.5]}}
CASES = {
    "spring": Case({"type": "spring-damper", **BETWEEN, "stiffness": 80, "free_length": 0.3, "damping": 2, "preload": 5}),
    "spring table": Case({"type": "spring-damper", **BETWEEN, "free_length": 0.4,
                          "table": {"deflections": [-0.3, 0.0, 0.3, 0.8], "forces": [-60, -4, 7, 90]}}),
    "spring expression": Case({"type": "spring-damper", **BETWEEN, "law": "50*(length - 0.3) + 30*(length - 2)^3 + 0.5*rate^2"}),
    "functions": Case({"type": "force", "body": "a", "position": [0.1, 0.2, 0.3], "vector": [
        "5*sin(2*atan2(tip.vx, tip.y)) + min(tip.z, 2, tip.vx^2) - max(tip.vx, -tip.vx/2, 0.1) + abs(tip.vy)^1.5",
        "sqrt(abs(tip.z) + 1)*exp(-tip.vx) + log(abs(tip.z) + 3) + cos(asin(0.2*tan(0.1*tip.vx)) - acos(0.3*sin(tip.vy)) + atan(tip.vy/3))",
        "cos(tip.vx)^3 - 2^tip.vy + (abs(tip.x) + 1)^tip.vx + (tip.vx - 9)^2 + (tip.vx - tip.x - 9)^-3 + 3*(tip.y - 9)^1",
    ]}),
    "spring python": Case({"type": "spring-damper", **BETWEEN, "law": law("tension", "length", "rate", 60.0)}),
    "spring of equal points": Case({"type": "spring-damper", "stiffness": 30, "free_length": 0.3,
                                    "markers": [{"body": "ground"}, {"body": "wheel", "position": [-1.0, 0.5, -0.2]}]}),
    "torsional": Case({"type": "torsional-spring-damper", "stiffness": 3, "damping": 0.4, "free_angle": 0.2,
                       "markers": [{"body": "ground", "axis": [0, 0, 1]}, {"body": "wheel"}]}),
    "joint spring": Case({"type": "joint-spring-damper", "coordinate": "j.displacement", "stiffness": 90, "damping": 3}),
    "joint spring, angle": Case({"type": "joint-spring-damper", "coordinate": "j.angle", "stiffness": 4, "damping": 0.3}),
    "joint law": Case({"type": "joint-spring-damper", "coordinate": "j.angle", "law": "4*value + 2*value^2 + 0.1*rate*abs(rate)"}),
    "joint python": Case({"type": "joint-spring-damper", "coordinate": "j.angle", "law": law("pull", "value", "rate", "time")}),
    "stop": Case({"type": "stop", "coordinate": "j.angle", "lower": -0.001, "upper": 0.001, "stiffness": 50, "restitution": 0.5},
                 touches=True),
    "stop, power": Case({"type": "stop", "coordinate": "j.displacement", "lower": -0.001, "upper": 0.001, "stiffness": 500,
                         "restitution": 0.8, "exponent": 1.5}, touches=True),
    "stop, apart": Case({"type": "stop", "coordinate": "j.angle", "lower": -2, "upper": 2, "stiffness": 50, "restitution": 0.5},
                        touches=False),
    "motor": Case({"type": "motor", "coordinate": "axle", "speed": "3 + sin(time)", "gain": 0.2}),
    "motor, limited": Case({"type": "motor", "coordinate": "axle", "speed": 300, "gain": 0.2, "limit": 0.1}),
    "motor, effort": Case({"type": "motor", "coordinate": "j.angle", "effort": "-0.4*j.angle_rate - 3*axle.angle*j.angle"}),
    "synchronous motor": Case(MOTOR),
    "synchronous motor, at its voltage": Case({**MOTOR, "dc_voltage": 1}),
    "induction motor": Case({**INDUCTION, **INVERTER}),
    "induction motor, at a grid": Case({**INDUCTION, "voltage": 1, "frequency": 0.5}),
    "servo": Case({"type": "servo", "coordinate": "j.displacement", "target": "0.2*sin(2*time)", "stiffness": 40, "damping": 3}),
    "servo, integral": Case({"type": "servo", "coordinate": "axle", "target": 0.3, "stiffness": 4, "damping": 0.3, "integral": 6}),
    "servo, limited": Case({"type": "servo", "coordinate": "axle", "target": 90, "stiffness": 4, "damping": 0.3, "limit": 0.2}),
    "curves and choices": Case({"type": "force", "body": "a", "position": [0.1, 0.2, 0.3], "vector": [
        "lookup(tip.vx, quintic, -20, 0, 0, 3, 20, -5) + lookup(tip.y, monotone, -20, 0, 0, 3, 20, -5) + tanh(tip.vy)",
        "if(tip.vx > tip.vx - 1 and not(tip.x <= tip.x - 1), tip.vx^2, sqrt(-1 - tip.vx^2)) + floor(0.5 + 0*tip.vx)*tip.vy",
        "step(tip.vx, -20, 0, 20, 7) + ramp(tip.vy, -30, 1, 30, 4) + mod(tip.vy - 40, 200) + sign(tip.vx^2 + 1)*tip.y",
    ]}),
    "bushing": Case(MOUNT),
    "bushing, large turn": Case({**MOUNT, "markers": ["tip", {"body": "b", "orientation": {"axis": [1, -1, 0.5], "angle": 2.9}}]}),
    "bushing, other turn": Case({**MOUNT, "markers": ["tip", {"body": "b", "orientation": {"axis": [-0.2, 1, 0.3], "angle": -2.4}}]}),
    "bushing, full matrix": Case({**MOUNT, "stiffness": [[9 - abs(i - k) if i == k else 0.3 for k in range(6)] for i in range(6)]}),
    "three axes": Case({"type": "three-axis-spring", **BETWEEN, "stiffness": [40, 60, 80], "damping": [1, 2, 0.5],
                        "free_displacement": [0.1, -0.2, 0.05], "preload": [1, -2, 3]}),
    "law of contact": Case({"type": "contact", "body": "c", "plane": "floor", "law": "2e3*depth^1.5 + 30*depth*max(0, rate)",
                            "friction": 0.3, "friction_model": "coulomb",
                            "friction_transition_speed": 0.8}, ON, True, shape("c", "sphere", radius=0.4)),
    "sphere": Case(ON_FLOOR, ON, True, shape("c", "sphere", radius=0.4)),
    "belt": Case({**ON_FLOOR, "surface_velocity": ["0.3 + 0.2*time", -0.4, 0.1], "surface_spin": 0.7}, ON, True,
                 shape("c", "sphere", radius=0.4)),
    "belt, sticks": Case({**ON_FLOOR_STICKING, "surface_velocity": ["0.3 + 0.2*time", -0.4, 0.1], "surface_spin": "0.7*time"},
                         ("c", "", [-0.5, 0.9, 0.25]), True, shape("c", "box", size=[0.5, 0.6, 0.7])),
    "sphere, linear": Case({**ON_FLOOR, "exponent": 1}, ON, True, shape("c", "sphere", radius=0.4)),
    "sphere, apart": Case(ON_FLOOR, None, False, shape("c", "sphere", radius=0.4)),
    "box": Case(ON_FLOOR, ("c", "", [-0.5, 0.9, 0.25]), True, shape("c", "box", size=[0.5, 0.6, 0.7])),
    "cylinder": Case(ON_FLOOR, ("c", "", [-0.5, 0.9, 0.3]), True, shape("c", "cylinder", radius=0.3, length=0.8)),
    "prism": Case(ON_FLOOR, ("c", "", [-0.5, 0.9, 0.25]), True,
                  shape("c", "extrusion", outline=PRISM, length=0.5)),
    "moving floor": Case({**ON_FLOOR, "plane": "eye"}, ("c", "b", [0.05, 0.02, 0.05]), True, shape("c", "sphere", radius=0.6)),
    "spheres": Case({**CONTACT, "bodies": ["c", "ball"]}, ("c", "ball", [0.3, 0.4, 0.3]), True,
                    {"bodies": {**shape("c", "sphere", radius=0.4)["bodies"],
                                "ball": {"shape": {"type": "sphere", "radius": 0.5}, "mass": 0.5, "position": [-0.4, 0.6, 1.9]}}}),
    "contacts": Case({"type": "contacts", "between": ["c", "ball"], "planes": ["floor"], "stiffness": 3e3, "restitution": 0.6,
                      "friction": 0.3, "friction_transition_speed": 0.8, "friction_work": True},
                     ("c", "ball", [0.3, 0.4, 0.3]), True,
                     {"bodies": {**shape("c", "sphere", radius=0.4)["bodies"],
                                 "ball": {"shape": {"type": "sphere", "radius": 0.5}, "mass": 0.5, "position": [-0.4, 0.6, 1.9]}}}),
    "capsule": Case(ON_FLOOR, ON, True, shape("c", "capsule", radius=0.25, length=0.5)),
    "capsule, sticks": Case(ON_FLOOR_STICKING, ON, True, shape("c", "capsule", radius=0.25, length=0.5)),
    **{f"sphere and {name}": round_pair({"type": "sphere", "radius": 0.35}, other, [-0.5, -0.3, 0.1])
       for name, other in OTHERS.items()},
    **{f"capsule and {name}": round_pair({"type": "capsule", "radius": 0.2, "length": 0.5}, other, [-0.45, -0.25, 0.15])
       for name, other in OTHERS.items()},
    "box and capsule, stick": round_pair({"type": "box", "size": [0.5, 0.6, 0.4]}, {"type": "capsule", "radius": 0.25, "length": 0.6},
                                         [-0.4, -0.25, 0.2], STICKING),
    "ellipsoid": Case(ON_FLOOR, ON, True, shape("c", "ellipsoid", semi_axes=[0.5, 0.35, 0.25])),
    "ellipsoid, sticks": Case(ON_FLOOR_STICKING, ON, True, shape("c", "ellipsoid", semi_axes=[0.5, 0.35, 0.25])),
    "ellipsoid and box": round_pair(EGG, OTHERS["box"], [-0.5, -0.25, 0.15]),
    "box and ellipsoid, stick": round_pair(OTHERS["box"], EGG, [-0.45, -0.2, 0.15], STICKING),
    "ellipsoid and capsule": round_pair(EGG, OTHERS["capsule"], [-0.55, -0.25, 0.15]),
    "ellipsoids": round_pair(EGG, {"type": "ellipsoid", "semi_axes": [0.3, 0.45, 0.35]}, [-0.55, -0.25, 0.15]),
    "sphere on heights": Case({**ON_FLOOR, "heights": HILLS}, ON, True, shape("c", "sphere", radius=0.3)),
    "box on heights, sticks": Case({**ON_FLOOR_STICKING, "heights": HILLS}, ON, True, shape("c", "box", size=[0.6, 0.5, 0.4])),
    "cylinder on heights": Case({**ON_FLOOR, "heights": HILLS}, ON, True, shape("c", "cylinder", radius=0.3, length=0.5)),
    "hulls": Case({"type": "contact", "foundation_modulus": 3e4, "damping": 0.6, "friction": 0.3,
                   "friction_model": "coulomb", "friction_transition_speed": 0.8,
                   "bodies": ["c", "block"]}, ("c", "block", [-0.38, -0.25, 0.1]), True,
                  {"bodies": {**shape("c", "extrusion", outline=PRISM, length=0.5)["bodies"],
                              "block": {"shape": {"type": "box", "size": [0.6, 0.5, 0.4]}, "mass": 0.5,
                                        "position": [-0.4, 0.6, 1.9]}}}),
    "belt of a hull": Case({"type": "contact", "foundation_modulus": 3e4, "damping": 0.6, "friction": 0.3,
                            "friction_model": "coulomb", "friction_transition_speed": 0.8,
                            "bodies": ["c", "block"], "surface_velocity": [0.5, "0.2*time", -0.3]},
                           ("c", "block", [-0.38, -0.25, 0.1]), True,
                           {"bodies": {**shape("c", "extrusion", outline=PRISM, length=0.5)["bodies"],
                                       "block": {"shape": {"type": "box", "size": [0.6, 0.5, 0.4]}, "mass": 0.5,
                                                 "position": [-0.4, 0.6, 1.9]}}}),
    "sphere, sticks": Case({**ON_FLOOR_STICKING, "friction_work": True}, ON, True, shape("c", "sphere", radius=0.4)),
    "sphere, rolls and spins": Case({**ON_FLOOR_STICKING, "rolling_resistance": 0.02, "patch_radius": 0.1},
                                    ON, True, shape("c", "sphere", radius=0.4)),
    "sphere that sticks, apart": Case(ON_FLOOR_STICKING, None, False, shape("c", "sphere", radius=0.4)),
    "box, sticks": Case(ON_FLOOR_STICKING, ("c", "", [-0.5, 0.9, 0.25]), True, shape("c", "box", size=[0.5, 0.6, 0.7])),
    "cylinder, sticks": Case(ON_FLOOR_STICKING, ("c", "", [-0.5, 0.9, 0.3]), True, shape("c", "cylinder", radius=0.3, length=0.8)),
    "spheres, stick": Case({**STICKING, "bodies": ["c", "ball"]}, ("c", "ball", [0.3, 0.4, 0.3]), True,
                           {"bodies": {**shape("c", "sphere", radius=0.4)["bodies"],
                                       "ball": {"shape": {"type": "sphere", "radius": 0.5}, "mass": 0.5, "position": [-0.4, 0.6, 1.9]}}}),
    "hulls, stick": Case({"type": "contact", "foundation_modulus": 3e4, "damping": 0.6, "friction": 0.3,
                          "bodies": ["c", "block"]}, ("c", "block", [-0.38, -0.25, 0.1]), True,
                         {"bodies": {**shape("c", "extrusion", outline=PRISM, length=0.5)["bodies"],
                                     "block": {"shape": {"type": "box", "size": [0.6, 0.5, 0.4]}, "mass": 0.5,
                                               "position": [-0.4, 0.6, 1.9]}}}),
    "follower": Case({"type": "force", "body": "a", "position": [0.1, 0.2, 0.3], "vector": [3, -2, 5], "axes": "body"}),
    "global force": Case({"type": "force", "body": "a", "position": [0.1, 0.2, 0.3], "vector": [3, "-2*cos(5*time)", 5]}),
    "torque": Case({"type": "torque", "body": "a", "vector": [1, 2, -1], "axes": "body"}),
    "law of far bodies": Case({"type": "force", "body": "wheel", "position": [0.1, 0.2, 0.0], "axes": "body",
                               "vector": ["3*sin(j.angle) - far.vx", "-2*a.wz + eye.y", "0.5*c.x + 0.1*j.displacement_rate*far.z"]}),
    "pair force": Case({"type": "pair-force", **BETWEEN, "magnitude": "-3/length + 2*sin(4*time) - rate*far.x"}),
    "springs in series": Case({"type": "spring-series", **BETWEEN, "stiffness": [60, 80, 0, 30], "damping": [0, 3, 5, 0],
                               "free_length": [0.2, 0.1, 0.3, 0.1]}),
    "springs in series, all damped": Case({"type": "spring-series", **BETWEEN, "stiffness": [60, 0], "damping": [2, 3],
                                           "free_length": [0.2, 0.3]}),
    "springs in series, slack": Case({"type": "spring-series", **BETWEEN, "stiffness": [60, 80], "free_length": [5.0, 6.0],
                                      "only_pulls": True}),
    "spring node": Case({"type": "spring-node", "node": [0.3, 0.2, 0.1], "markers": ["tip", "floor", "eye", "far"],
                         "stiffness": [60, 40, 80, 30], "free_length": [0.1, 0.3, 0.2, 0.1]}),
    "spring node, slack": Case({"type": "spring-node", "node": [0.3, 0.2, 0.1], "markers": ["tip", "floor", "eye"],
                                "stiffness": [60, 40, 80], "free_length": [0.1, 9.0, 0.2], "only_pulls": True}),
    "spring node, all slack": Case({"type": "spring-node", "node": [0.3, 0.2, 0.1], "markers": ["tip", "floor", "eye"],
                                    "stiffness": [60, 40, 80], "free_length": [9.0, 9.0, 9.0], "only_pulls": True}),
    "rope": Case({"type": "rope", "markers": ["tip", "floor", "eye"], "stiffness": 60, "damping": 2, "length": 1.0}),
    "rope, slack": Case({"type": "rope", "markers": ["tip", "eye"], "stiffness": 60, "damping": 2, "length": 9.0}),
    "winch": Case({"type": "rope", "markers": ["tip", "eye"], "stiffness": 60, "damping": 1, "length": 0.3,
                   "speed": "0.3*lever.value + 0.1*sin(time)"}, more={"inputs": {"lever": LEVER}}),
    "rope around wheels": Case({"type": "rope", "markers": [{"body": "wheel"}, "far", "eye"], "radii": [0.05, -0.08, 0],
                                "wound": [1.3, 0], "stiffness": 60, "damping": 2, "length": 0.8}),
    "rope around wheels, between drums": Case({"type": "rope", "markers": [{"body": "wheel"}, "far", {"body": "a"}],
                                               "radii": [-0.05, 0.08, 0.06], "wound": [2.2, 0.7], "stiffness": 60, "length": 0.8,
                                               "speed": "0.3*lever.value"}, more={"inputs": {"lever": LEVER}}),
    # not on a winch: states of the zoo are next to zero, and so would be the mass of the rope
    "heavy rope": Case({"type": "rope", "markers": [{"body": "wheel"}, "far", "eye"], "radii": [0.05, -0.08, 0], "wound": [1.3, 0],
                        "stiffness": 60, "damping": 2, "length": 0.8, "mass_per_length": 0.7, "start_speed": 0.3}),
    "heavy rope, two drums": Case({"type": "rope", "markers": [{"body": "wheel"}, {"body": "a"}], "radii": [-0.05, 0.06],
                                   "wound": [2.2, 0.7], "stiffness": 60, "length": 0.8, "mass_per_length": 0.7}),
    "shaft": Case({"type": "shaft", "coordinate": "j.angle", "against": "axle", "ratio": 0.7, "stiffness": 4, "damping": 0.3,
                   "free_value": 0.1}),
    "shaft, play": Case({"type": "shaft", "coordinate": "j.angle", "against": "axle", "ratio": -0.4, "stiffness": 40, "damping": 0.3,
                         "backlash": 0.002}, touches=True),
    "shaft, apart": Case({"type": "shaft", "coordinate": "j.displacement", "against": "axle", "stiffness": 40,
                          "backlash": 40}, touches=False),
    "belt drive": Case({"type": "belt-drive", "coordinate": "j.angle", "against": "axle", "radii": [0.2, 0.3], "stiffness": 40,
                        "damping": 2, "pretension": 9}),
    "chain": Case({"type": "belt-drive", "coordinate": "j.angle", "against": "axle", "radii": [0.2, 0.3], "crossed": True, "stiffness": 40,
                   "slack": 0.001}),
    "belt drive, slips": Case({"type": "belt-drive", "coordinate": "j.angle", "against": "axle", "radii": [0.2, 0.3], "stiffness": 4e3,
                               "damping": 2, "pretension": 0.9, "friction": 0.2}),
    "freewheel, elastic": Case({"type": "freewheel", "coordinate": "j.angle", "against": "axle", "stiffness": 5, "damping": 0.3}),
    "rope with friction": Case({"type": "rope", "markers": [{"body": "wheel"}, "far", "eye"], "radii": [0.05, -0.08, 0], "wound": [1.3, 0],
                                "stiffness": 60, "damping": 2, "length": 0.8, "friction": 0.3}),
    "rope with friction, winch": Case({"type": "rope", "markers": ["tip", {"body": "wheel"}, "far", "eye"], "radii": [0, 0.05, -0.08, 0],
                                       "stiffness": 60, "damping": 2, "length": 0.8, "speed": "0.3*lever.value", "friction": 0.02},
                                      more={"inputs": {"lever": LEVER}}),
    "tyre": Case({**TYRE, **ROLLS}, ("c", "", [-0.5, 0.9, 0.1]), True),
    "tyre of a file": Case({**TYRE, "magic": MAGIC}, ("c", "", [-0.5, 0.9, 0.1]), True),
    "tyre on a body": Case({**TYRE, "plane": "eye", "grip": 0.5}, ("c", "b", [0.05, 0.02, 0.15]), True),
    "tyre before a kerb": Case({**TYRE, "heights": KERB}, ("c", "", [-0.5, 0.9, 0.4]), True),
    "tyre on heights": Case({**TYRE, "heights": HILLS, "grip": "0.6 + 0.3*sin(x + 2*y + time)"}, ("c", "", [-0.5, 0.9, 0.4]), True),
    "tyre, off the ground": Case(TYRE, ("c", "", [-0.5, 0.9, 1.4]), False),
    "wheel on soil": Case({"type": "soil-wheel", "wheel": {"body": "c", "axis": [0.1, 1, 0.2]}, "radius": 0.3, "width": 0.2, **SOIL},
                          ("c", "", [-0.5, 0.9, 0.1]), True),
    "blade": Case({"type": "blade", "edge": [{"body": "c", "position": [0.1, 0.3, 0]}, {"body": "c", "position": [0.1, -0.3, 0]}], **SOIL},
                  ("c", "", [-0.5, 0.9, -0.2]), True),
    "track": Case({**BELT, "plane": "floor", "stiffness": 900, "patches": 4}, ("c", "", [-0.5, 0.9, 0.02]), True),
    "track on a body": Case({**BELT, "plane": "eye", "stiffness": 900, "grip": 0.5, "patches": 3}, ("c", "b", [0.05, 0.02, 0.05])),
    "track on heights": Case({**BELT, "plane": "floor", "heights": HILLS, "stiffness": 900, "grip": "0.6 + 0.3*sin(x + 2*y + time)",
                              "patches": 4}, ("c", "", [-0.5, 0.9, 0.4])),
    "track on soil": Case({**BELT, "patches": 4, **SOIL}, ("c", "", [-0.5, 0.9, -0.05])),
    "hand": Case({"type": "hand", "pull": "0.8 + 0.1*time", "body_number": 1, "point": [0.1, -0.2, 0.3], "towards": ["time", 1, "tip.x"]}),
    "coulomb": Case({**RUBBING, "model": "coulomb", "transition_speed": 0.5, "viscous": 0.1}),
    "coulomb, given load": Case({**RUBBING, "model": "coulomb", "transition_speed": 0.5, "normal_load": 20}),
    "coulomb, turning": Case({**RUBBING, "coordinate": "axle.angle", "model": "coulomb", "transition_speed": 0.05, "radius": 0.04,
                              "collar_radius": 0.05, "bearing_length": 0.1}),
    "lugre": Case({**RUBBING, "model": "lugre", "bristle_stiffness": 500, "viscous": 0.1}),
    "lugre, given load": Case({**RUBBING, "model": "lugre", "bristle_stiffness": 500, "normal_load": 20}),
}  # fmt: skip


def two_shafts(sections):
    """Wheels and a slider on a moving base, coupled or driven."""
    bodies = {
        "base": solid(
            3.0, (0.3, 0.4, 0.5), centre_of_mass=[0.05, 0.1, -0.02], orientation={"axis": [1, 2, 3], "angle": 0.2}
        ),
        "one": solid(0.5, (0.02, 0.02, 0.03), position=[0.4, 0.0, 0.1]),
        "two": solid(0.7, (0.03, 0.03, 0.05), position=[-0.3, 0.1, 0.1], centre_of_mass=[0.0, 0.05, 0.0]),
        "bar": solid(0.8, (0.02, 0.02, 0.03), position=[0.0, 0.4, 0.0]),
    }
    joints = {
        "foot": {"type": "spherical", "bodies": ["base", "ground"], "point": [0, -0.5, 0]},
        "p": hinge("base", "one", (0.4, 0, 0.1)),
        "q": {"type": "revolute", "bodies": ["two", "base"], "point": [-0.3, 0.1, 0.1], "axis": [0.2, 0.3, 1]},
        "s": slide("base", "bar", (0.1, 1, 0.2)),
    }
    markers = {"knob": {"body": "two", "position": [0.1, 0.02, 0.05]}, "pen": {"body": "base", "axis": [0.2, 0.1, 1]}}
    return linked.record(
        {"gravity": [1.0, -G, 2.0], "bodies": bodies, "joints": joints, "markers": markers, **sections}
    )


MOTION = """
import math


def wave(time, size):
    return size*math.sin(3.0*time), 3.0*size*math.cos(3.0*time), -9.0*size*math.sin(3.0*time)
"""
COUPLED = {
    "gear": {"type": "gear", "joints": ["p", "q"], "teeth": [17, 51]},
    "internal gear": {"type": "gear", "joints": ["p", "q"], "ratio": 3, "internal": True},
    "belt": {"type": "belt", "joints": ["p", "q"], "radii": [0.04, 0.1]},
    "rack": {"type": "rack", "joints": ["p", "s"], "radius": 0.05},
    "linear": {"type": "linear", "coordinates": ["p.angle", "q.angle", "s.displacement"], "factors": [1.0, -2.0, 5.0]},
    "function": {"type": "function", "coordinate": "p", "from_start": True,
                 "value": "0.5*sin(q.angle) + 2*s.displacement*q.angle + s.displacement^2"},
    "cubic table": {"type": "function", "coordinate": "p", "from_start": True, "value": {
        "of": "q.angle", "points": [-0.5, -0.1, 0.2, 0.6], "values": [0.1, -0.2, 0.3, 0.4], "interpolation": "cubic"}},
}  # fmt: skip
DRIVEN = {
    "angle": {"coordinate": "p.angle", "value": "0.3*sin(4*time)"},
    "displacement": {"coordinate": "s", "value": "0.05*time + 0.1*time^2"},
    "table": {"coordinate": "p.angle", "value": {"times": [0, 0.01, 0.03, 0.5, 2], "values": [0, 0.02, 0.03, 0.1, 0.0],
                                                 "interpolation": "cubic"}},
    "python": {"coordinate": "p.angle", "value": {"source": MOTION, "function": "wave", "arguments": ["time", 0.2]}},
    "marker along": {"marker": "knob", "along": "y", "relative_to": "pen", "value": "0.27 + 0.1*sin(2*time)"},
    "marker about": {"marker": "knob", "about": "z", "relative_to": "pen", "value": "-0.1*sin(2*time)"},
    "orientation by turns": {"marker": "pen", "orientation": {"euler": ["0.2*sin(4*time)", "0.1 + time^2", "0.3*time"],
                                                              "sequence": "zyx"}},
    "orientation by Euler parameters": {"marker": "pen", "orientation": {
        "euler_parameters": ["1", "0.1*sin(5*time)", "0.2*time", "0.1"]}},
    "marker of the ground": {"marker": "knob", "along": "x", "value": "-0.1 + 0.2*sin(2*time)"},
}  # fmt: skip
ELEMENTS = {
    **{name: (lambda case=case: bed(case)) for name, case in CASES.items()},
    **{f"coupling, {name}": (lambda one=one: two_shafts({"couplings": {"e": one}})) for name, one in COUPLED.items()},
    **{f"driver, {name}": (lambda one=one: two_shafts({"drivers": {"e": one}})) for name, one in DRIVEN.items()},
}
