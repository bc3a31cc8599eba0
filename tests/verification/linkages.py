"""Linkages with positions in which their motion branches, and Jansen's leg, which has none."""

import numpy as np

HINGE = {"type": "revolute", "axis": [0, 0, 1]}


def bar(p, q):
    """A bar of steel from p to q (2,) [m]."""
    ends = {"from": [*map(float, p), 0.0], "to": [*map(float, q), 0.0]}
    return {"shape": {"type": "box", **ends, "width": 0.05, "height": 0.05}, "density": 1000}


def hinge(first, second, point, **given):
    return {**HINGE, "bodies": [first, second], "point": [*map(float, point), 0.0], **given}


def apex(p, q, to_p, to_q, side):
    """The corner of a triangle above (side 1) or below the line from p to q, at these distances from them."""
    p, q = np.array(p, float), np.array(q, float)
    length = np.linalg.norm(q - p)
    along, across = (q - p) / length, np.array([p[1] - q[1], q[0] - p[0]]) / length
    x = (to_p**2 - to_q**2 + length**2) / (2 * length)
    return p + x * along + side * np.sqrt(to_p**2 - x**2) * across


def four_bar(ground, crank, coupler, rocker, *, angle, speed, prefix="", at=(0.0, 0.0)):
    """Bodies and joints of a four-bar without redundant constraints, its crank at `angle` [rad] turning at `speed` [rad/s]."""
    at = np.array(at, float)
    o = at + np.array([ground, 0.0])
    tip = at + crank * np.array([np.cos(angle), np.sin(angle)])
    far = apex(tip, o, coupler, rocker, 1.0)
    names = {name: prefix + name for name in ("crank", "coupler", "rocker")}
    bodies = {names["crank"]: bar(at, tip), names["coupler"]: bar(tip, far), names["rocker"]: bar(far, o)}
    joints = {
        "left": hinge("ground", names["crank"], at, start_rates={"angle": speed}),
        "near": {**hinge(names["crank"], names["coupler"], tip), "type": "spherical"},
        "far": {**hinge(names["coupler"], names["rocker"], far), "type": "cylindrical"},
        "right": hinge("ground", names["rocker"], o),
    }
    del joints["near"]["axis"]
    return {"bodies": bodies, "joints": {prefix + name: joint for name, joint in joints.items()}}


def change_point(speed=2.0):
    """1 + 4 = 3.5 + 1.5: all bars are in line where the crank points away from the rocker's pin, at π."""
    return four_bar(4.0, 1.0, 3.5, 1.5, angle=0.5, speed=speed)


def folded_slider_crank(speed=2.0):
    """Crank and rod are 1 m long: with the crank upright, at π/2, they fold, and the rod may turn about the pin with the crank."""
    tip = np.array([np.cos(0.5), np.sin(0.5)])
    end = np.array([2 * np.cos(0.5), 0.0])
    slider = {"position": [*end, 0.0], "mass": 1, "inertia": [0.1, 0.1, 0.1]}
    joints = {
        "left": hinge("ground", "crank", (0, 0), start_rates={"angle": speed}),
        "near": {**hinge("crank", "rod", tip), "type": "spherical"},
        "far": {**hinge("rod", "slider", end), "type": "cylindrical"},
        "rail": {**hinge("ground", "slider", end), "type": "translational", "axis": [1, 0, 0]},
    }
    del joints["near"]["axis"]
    return {"bodies": {"crank": bar((0, 0), tip), "rod": bar(tip, end), "slider": slider}, "joints": joints}


def jansen_leg(speed=6.0):
    """Of the eleven numbers that Jansen gives, in decimetres: its crank turns for ever, and no position of it is singular."""
    main, base = np.zeros(2), np.array([-0.38, -0.078])
    crank = 0.15 * np.array([np.cos(0.3), np.sin(0.3)])
    upper = apex(crank, base, 0.50, 0.415, -1)
    back = apex(upper, base, 0.558, 0.401, -1)
    low = apex(crank, base, 0.619, 0.393, 1)
    shin = apex(back, low, 0.394, 0.367, -1)
    foot = apex(shin, low, 0.657, 0.49, -1)

    def plate(*corners):
        return {"position": [*np.mean(corners, axis=0).tolist(), 0.0], "mass": 0.3, "inertia": [0.002, 0.002, 0.004]}

    bodies = {
        "crank": bar(main, crank),
        "high": bar(crank, upper),
        "deep": bar(crank, low),
        "knee": plate(base, upper, back),
        "tie": bar(back, shin),
        "strut": bar(base, low),
        "leg": plate(shin, low, foot),
    }
    pairs = [
        ("ground", "crank", main),
        ("crank", "high", crank),
        ("crank", "deep", crank),
        ("high", "knee", upper),
        ("ground", "knee", base),
        ("ground", "strut", base),
        ("knee", "tie", back),
        ("tie", "leg", shin),
        ("deep", "strut", low),
        ("strut", "leg", low),
    ]
    joints = {f"{first}-{second}": hinge(first, second, point) for first, second, point in pairs}
    joints["ground-crank"]["start_rates"] = {"angle": speed}
    return {"bodies": bodies, "joints": joints}
