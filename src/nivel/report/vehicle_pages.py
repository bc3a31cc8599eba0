"""Pages of a vehicle. *Handling*: histories of a manoeuvre in the axes of the level vehicle, numbers of all manoeuvres. *K&C* of a
suspension: curves of its wheels on a rig, numbers at the drawn height.

Toe is positive where wheels point inwards in front, camber where they lean outwards. The contact lies below the centre of a wheel, by the
radius of its tyre; wheels do not spin. Slopes are those of the polynomials through equilibria at Chebyshev's nodes.
"""

from collections.abc import Mapping
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebfit, chebval

from nivel.lazy import Struct
from nivel.looks.viewpoint import rotation
from nivel.machine.core.vectors import Array
from nivel.report.page import page
from nivel.report.plots import Line, curves, path_drawing
from nivel.results.result import Result

Numbers = dict[str, tuple[float, str]]  # value and unit by name
G = 9.80665
SETTLED = 0.02  # change of a state in half a second, up to which it is steady
NOTE = "x forwards, y to the left; accelerations without gravity, of the origin of the body."


class Manoeuvre(Struct):
    """(n,) time, steering angle, speeds and accelerations along and across, yaw, its rate, roll, place; SI. `name` of the manoeuvre."""

    name: str
    time: Array
    steering: Array
    vx: Array
    vy: Array
    ax: Array
    ay: Array
    yaw: Array
    yaw_rate: Array
    roll: Array
    x: Array
    y: Array

    @classmethod
    def of(cls, name: str, run: Result, body: int, driver: str) -> "Manoeuvre":
        """Of a run, the body of this number and the block that drives."""
        p, v, a = (run.array(each)[:, body] for each in ("position", "velocity", "acceleration"))
        e0, e1, e2, e3 = run.array("orientation")[:, body].T
        yaw = np.unwrap(np.arctan2(2.0 * (e0 * e3 + e1 * e2), 1.0 - 2.0 * (e2**2 + e3**2)))
        roll = np.arctan2(2.0 * (e0 * e1 + e2 * e3), 1.0 - 2.0 * (e1**2 + e2**2))
        c, s = np.cos(yaw), np.sin(yaw)
        vx, ax = (each[:, 0] * c + each[:, 1] * s for each in (v, a))
        vy, ay = (each[:, 1] * c - each[:, 0] * s for each in (v, a))
        rate = run.array("angular_velocity")[:, body, 2]
        return cls(name, run.time, run.array(f"control.{driver}"), vx, vy, ax, ay, yaw, rate, roll, p[:, 0], p[:, 1])


def circle_numbers(m: Manoeuvre, wheelbase: float, held: tuple[float, float]) -> Numbers:
    """Gradients by lateral acceleration v r at one speed (ISO 4138), of steering less L r/v, side slip and roll.

    They are slopes at straight ahead: differences of two steady states, a little to the left and to the right, at the times `held`.
    """
    lateral = m.vx * m.yaw_rate
    of = {
        "understeer gradient": m.steering - wheelbase * m.yaw_rate / m.vx,
        "side slip gradient": np.arctan2(m.vy, m.vx),
        "roll gradient": m.roll,
    }
    left, right = np.interp(held, m.time, lateral)
    out: Numbers = {}
    if left > right:
        slopes = {name: float(-np.diff(np.interp(held, m.time, each))[0] / (left - right)) for name, each in of.items()}
        out = {name: (float(np.degrees(slope)) * G, "°/g") for name, slope in slopes.items()}
        k = slopes["understeer gradient"]
        if k != 0.0:
            out["characteristic speed" if k > 0 else "critical speed"] = float(np.sqrt(wheelbase / abs(k))), "m/s"
        change = np.abs(np.interp(np.array(held) - 0.5, m.time, lateral) - (left, right))
        out |= _unsteady(float(np.max(change) / (left - right)))
    return {**out, "greatest lateral acceleration": (float(np.max(np.abs(m.ay))), "m/s²")}


def _unsteady(change: float) -> Numbers:
    """Said of a state that changes yet: by this share in half a second."""
    return {"not yet steady: change in the last half second": (100.0 * change, "%")} if change > SETTLED else {}


def step_numbers(m: Manoeuvre) -> Numbers:
    """Of a step of steering (ISO 7401): gain, time from half of the steering to 90 % of the yaw rate, its peak and overshoot."""
    end = float(m.yaw_rate[-1])
    half = float(np.interp(0.5, m.steering / m.steering[-1], m.time))
    shares = m.yaw_rate / end
    peak = int(np.argmax(shares))
    first = int(np.argmax(shares > 0.9))
    rise = float(np.interp(0.9, shares[first - 1 : first + 1], m.time[first - 1 : first + 1])) - half
    swing = float(np.ptp(m.yaw_rate[m.time > m.time[-1] - 0.5])) / abs(end)
    out = {"yaw rate gain": (end / float(m.steering[-1]), "1/s"), "response time of the yaw rate": (rise, "s"),
           "peak response time": (float(m.time[peak]) - half, "s"), "overshoot of the yaw rate": (100.0 * (float(shares[peak]) - 1.0), "%"),
           "lateral acceleration": (float(m.ay[-1]), "m/s²")}  # fmt: skip
    return out | _unsteady(swing)


def lane_numbers(m: Manoeuvre, gates: list[tuple[float, float, float, float]], width: float) -> Numbers:
    """Of a lane change between gates (begin, end, right, left): what passes the middle of the vehicle by, with half of its width."""
    beyond = [
        np.maximum(right - (m.y - 0.5 * width), m.y + 0.5 * width - left)[(m.x >= begin) & (m.x <= end)]
        for begin, end, right, left in gates
    ]
    worst = max((float(np.max(each)) for each in beyond if len(each)), default=float("nan"))
    speed, turns = np.hypot(m.vx, m.vy), np.degrees(float(np.max(np.abs(m.yaw_rate))))
    passed = "beyond the gates" if worst > 0.0 else "room left in the gates"
    return {passed: (abs(worst), "m"), "speed at the first gate": (float(np.interp(gates[0][0], m.x, speed)), "m/s"),
            "speed at the last gate": (float(np.interp(gates[-1][1], m.x, speed)), "m/s"),
            "greatest lateral acceleration": (float(np.max(np.abs(m.ay))), "m/s²"), "greatest yaw rate": (turns, "°/s"),
            "greatest steering": (np.degrees(float(np.max(np.abs(m.steering)))), "°")}  # fmt: skip


def braking_numbers(m: Manoeuvre, begin: float) -> Numbers:
    """Of braking from a time on, in a turn or on split grip: way, deceleration, and what yaw and side slip do."""
    during = (m.time >= begin) & (m.vx > 1.0)
    before = m.time < begin
    k, last = int(np.argmax(during)), int(len(m.time) - 1 - np.argmax(during[::-1]))
    turned = m.yaw[during] - m.yaw[k] - m.yaw_rate[k] * (m.time[during] - m.time[k])
    mean = (float(m.vx[k]) - float(m.vx[last])) / max(float(m.time[last] - m.time[k]), 1e-9)
    out = {"speed": (float(m.vx[k]), "m/s"), "mean deceleration": (mean, "m/s²"),
           "way": (float(np.sum(np.hypot(np.diff(m.x[k:]), np.diff(m.y[k:])))), "m"),
           "greatest yaw rate": (np.degrees(float(np.max(np.abs(m.yaw_rate[during])))), "°/s"),
           "greatest side slip": (np.degrees(float(np.max(np.abs(np.arctan2(m.vy, m.vx)[during])))), "°"),
           "yaw beyond that of the turn before": (np.degrees(float(turned[np.argmax(np.abs(turned))])), "°")}  # fmt: skip
    return {"lateral acceleration before": (float(m.ay[before][-1]), "m/s²"), **out}


def slope_numbers(m: Manoeuvre) -> Numbers:
    """Of a start on a slope along x: how far it rolls back, and how soon it has gone five metres."""
    gone = m.x - m.x[0]
    there = np.argmax(gone > 5.0)
    out: Numbers = {"rolls back": (max(-float(np.min(gone)), 0.0), "m"), "speed at the end": (float(m.vx[-1]), "m/s")}
    return out | (
        {"time to 5 m": (float(m.time[there]), "s")} if gone[-1] > 5.0 else {"gone at the end": (float(gone[-1]), "m")}
    )


def handling_html(machine: str, found: Mapping[str, tuple[Manoeuvre, Numbers, str]]) -> str:
    """The page as text: numbers of each manoeuvre with the verdict on its run, understeer plot, g-g diagram, histories."""
    plots, told = [], {name: (numbers, trust) for name, (_, numbers, trust) in found.items()}
    for name, (m, _, _) in found.items():
        if name == "circle":
            angles = {"steering": m.steering, "side slip": np.arctan2(m.vy, m.vx), "roll": m.roll}
            lines = [Line(of, m.vx * m.yaw_rate / G, np.degrees(angle)) for of, angle in angles.items()]
            plots.append(("Understeer", curves(lines, "lateral acceleration [g]", "angle [°]")))
        else:
            rate = [
                Line("yaw rate [°/s]", m.time, np.degrees(m.yaw_rate)),
                Line("steering [°]", m.time, np.degrees(m.steering)),
            ]
            plots.append((f"{name}: yaw rate", curves(rate, "time [s]", "yaw rate [°/s], steering [°]")))
        plots.append((f"{name}: way", path_drawing(m.x, m.y, "x [m]", "y [m]")))
    all_of = [Line(name, m.ay / G, m.ax / G) for name, (m, _, _) in found.items()]
    plots.insert(0, ("g-g diagram", curves(all_of, "lateral acceleration [g]", "longitudinal acceleration [g]")))
    return plots_page(f"{machine}: handling", told, plots, NOTE)


def plots_page(name: str, told: Mapping[str, tuple[Numbers, str]], plots: list[tuple[str, str]], note: str) -> str:
    """A page of numbers, a column each with its verdict, and of plots with their titles."""
    units = {what: unit for numbers, _ in told.values() for what, (_, unit) in numbers.items()}
    columns = [{what: f"{value:.4g}" for what, (value, _) in numbers.items()} for numbers, _ in told.values()]
    rows = [(f"{what} [{unit}]", [column.get(what, "") for column in columns]) for what, unit in units.items()]
    rows.append(("trust", [trust for _, trust in told.values()]))
    styles = ("reduction.css", "plots.css")
    return page("plots.html.j2", styles, name=name, heads=[*told], rows=rows, plots=plots, note=note)


NODES, RISE = 16, 6  # intervals of a way from one end to the other, and of that up to the first end
ENDS: Final = np.cos(np.pi * np.arange(NODES + 1) / NODES)
# shares of a case, one after the other
WAY: Final = np.concatenate([np.sin(0.5 * np.pi * np.arange(RISE) / RISE), ENDS])
FINE: Final = np.linspace(-1.0, 1.0, 101)  # of curves
MIDDLE, DEGREE = NODES // 2, float(np.degrees(1.0))
SAME: Final = 1e-6  # [m] of wheels on one axle, along x
LEVEL: Final = 1e-9  # what counts as no slope
X_TITLES: Final = {
    "bump": "height of the wheels [mm]",
    "roll": "height of the wheel [mm]",
    "longitudinal": "force to the front [kN]",
    "lateral": "force to the left [kN]",
    "aligning": "moment to the left [kN m]",
}
RIG_NOTE = "Toe: inwards in front; camber: outwards at the top. Forces act at the ground. Heights and loads are those of the rig."


class Wheel(Struct):
    """A wheel: name of its tyre, body, centre and outward axle in its frame, side (1: left, -1: right) and radius [m]."""

    name: str
    body: str
    point: Array
    axle: Array
    side: float
    radius: float


def slopes(values: Array) -> Array:
    """Derivatives (n, …) by the share of the case of values at ENDS."""
    flat = values.reshape(len(ENDS), -1)
    return np.asarray(chebval(ENDS, chebder(chebfit(ENDS, flat, NODES))).T.reshape(values.shape), dtype=float)


class Curves(Struct):
    """What wheels do in a case, by name and at ENDS: toe and camber [°], centre (n, 3) [m], slope of the contact by the share of the case
    (n, 3) [m], vertical load of the rig [N]; lengths of springs [m]. size : of the case [m, N or N m]."""

    size: float
    angles: dict[str, dict[str, Array]]
    centre: dict[str, Array]
    way: dict[str, Array]
    load: dict[str, Array]
    springs: dict[str, Array]
    trust: str

    @classmethod
    def of(cls, run: Result, wheels: list[Wheel], size: float) -> "Curves":
        """Of equilibria along WAY."""
        kept = np.searchsorted(run.time, np.arange(RISE, RISE + NODES + 1) - LEVEL)
        lengths = [each for each in run.names if each.startswith("force.") and each.endswith(".length")]
        springs = {each.split(".")[1]: run.array(each)[kept] for each in lengths}
        out = cls(size, {"toe": {}, "camber": {}}, {}, {}, {}, springs, run.trust.verdict)
        for each in wheels:
            b, name = run.coordinates["body"].index(each.body), each.name
            A = np.array([rotation(q) for q in run.array("orientation")[kept, b]])
            out.centre[name], (x, y, z) = run.array("position")[kept, b] + A @ each.point, (A @ each.axle).T
            out.angles["toe"][name] = DEGREE * np.arctan2(x, np.abs(y))
            out.angles["camber"][name] = -DEGREE * np.arcsin(z)
            turn = np.einsum("nij,nkj->nik", slopes(A), A)  # dA Aᵀ, the matrix of the turn
            out.way[name] = slopes(out.centre[name]) - each.radius * turn[:, :, 2]
            out.load[name] = run.array(f"driver.kc_{name}.effort")[kept]
        return out


def axles(wheels: list[Wheel], bump: Curves) -> list[tuple[Wheel, Wheel | None]]:
    """Wheels of each axle, the left one first; a wheel without another one has None."""
    x = {each.name: float(bump.centre[each.name][MIDDLE, 0]) for each in wheels}
    ordered = sorted(wheels, key=lambda each: (-round(x[each.name] / SAME), -each.side))
    pairs = [(a, b) for a, b in pairwise(ordered) if a.side > b.side and abs(x[a.name] - x[b.name]) < 2.0 * SAME]
    return [*pairs, *((each, None) for each in ordered if all(each not in pair for pair in pairs))]


def roll_centre(of: Curves, left: Wheel, right: Wheel | None) -> Array:
    """(n, 2) [m] across, and above the ground: where the lines from contacts to instant centres meet in the front view.

    A wheel without another one meets its image in the plane y = 0.
    """
    (_, y, z), (_, across, up) = of.centre[left.name].T, of.way[left.name].T
    a = across / up  # the line falls by so much outwards
    if right is None:
        return np.stack([0.0 * y, a * y], axis=1)
    (_, v, w), (_, across, up) = of.centre[right.name].T, of.way[right.name].T
    b, w = across / up, w + left.radius - right.radius
    meets = (z - w + a * y - b * v) / np.where(np.abs(a - b) > LEVEL, a - b, np.nan)
    meets = np.where(np.isnan(meets), 0.5 * (y + v), meets)  # level lines meet everywhere
    return np.stack([meets, 0.5 * (a * (y - meets) + b * (v - meets))], axis=1)


def numbers_of(
    wheels: list[Wheel], found: Mapping[str, Curves], vehicle: tuple[float, float, float] | None = None
) -> dict[str, Numbers]:
    """Of each wheel and axle, at the drawn height. vehicle : wheelbase, height of its centre of mass [m], share of the front brakes."""
    bump, roll, out = found["bump"], found.get("roll"), dict[str, Numbers]()
    front = max(float(each[MIDDLE, 0]) for each in bump.centre.values())
    for wheel in wheels:
        name, rise = wheel.name, bump.way[wheel.name][MIDDLE, 2]
        along, across, _ = bump.way[name][MIDDLE] / rise
        of: Numbers = {"load": (bump.load[name][MIDDLE], "N")}
        of |= {what: (angle[name][MIDDLE], "°") for what, angle in bump.angles.items()}
        of |= {f"{what} by bump": (slopes(angle[name])[MIDDLE] / rise, "°/m") for what, angle in bump.angles.items()}
        of["contact outwards by bump"] = 1e3 * wheel.side * across, "mm/m"
        of["contact to the front by bump"] = 1e3 * along, "mm/m"
        of["wheel rate"] = 1e-3 * slopes(bump.load[name])[MIDDLE] / rise, "N/mm"
        if vehicle is not None:
            wheelbase, height, share = vehicle
            ahead = bump.centre[name][MIDDLE, 0] > front - 0.5 * wheelbase
            part = share if ahead else share - 1.0
            of["anti-dive" if ahead else "anti-lift"] = 100.0 * part * along * wheelbase / height, "%"
        for spring, against in roll.springs.items() if roll is not None else ():
            # half of what all wheels do together and what they do against each other is what this one does alone
            ratio = 0.5 * (slopes(bump.springs[spring]) + wheel.side * slopes(against))[MIDDLE] / bump.size
            if abs(ratio) > LEVEL:
                of[f"motion ratio of {spring}"] = ratio, "m/m"
        for case, each in found.items():
            if case not in ("bump", "roll"):
                by, unit, scale = f"by {case} load", "kN m" if case == "aligning" else "kN", 1e3 / each.size
                x, y, _ = 1e3 * scale * slopes(each.centre[name])[MIDDLE]
                angles = {what: scale * slopes(angle[name])[MIDDLE] for what, angle in each.angles.items()}
                of |= {f"{what} {by}": (angle, f"°/{unit}") for what, angle in angles.items()}
                of |= {f"centre to the front {by}": (x, f"mm/{unit}"), f"centre to the left {by}": (y, f"mm/{unit}")}
        out[name] = of
    for left, right in axles(wheels, bump):
        of = {"roll centre above the ground": (roll_centre(bump, left, right)[MIDDLE, 1], "m")}
        if right is not None and roll is not None:
            track = float(bump.centre[left.name][MIDDLE, 1] - bump.centre[right.name][MIDDLE, 1])
            angle = slopes((roll.centre[left.name] - roll.centre[right.name])[:, 2] / track)
            moment = slopes(0.5 * track * (roll.load[left.name] - roll.load[right.name]))
            of |= {"track": (track, "m"), "roll stiffness": ((moment / angle)[MIDDLE] / DEGREE, "N m/°")}
        owner = " and ".join(each.name for each in (left, right) if each)
        out[owner] = out.get(owner, {}) | of
    return {owner: {what: (float(value), unit) for what, (value, unit) in of.items()} for owner, of in out.items()}


def kc_html(
    machine: str, wheels: list[Wheel], found: Mapping[str, Curves], told: Mapping[str, tuple[Numbers, str]]
) -> str:
    """The page as text: numbers as they are `told`, curves over bump and roll, and over the loads."""
    bump, plots = found["bump"], list[tuple[str, str]]()

    def plot(case: str, title: str, unit: str, of: Mapping[str, Array]) -> None:
        x = (1e3 if case in ("bump", "roll") else 1e-3) * found[case].size * FINE
        side = {each.name: each.side if case == "roll" else 1.0 for each in wheels}
        fine = {name: np.asarray(chebval(FINE, chebfit(ENDS, y, NODES)), dtype=float) for name, y in of.items()}
        lines = [Line(name, side[name] * x, y) for name, y in fine.items()]
        plots.append((f"{title} by {case}", curves(lines, X_TITLES[case], f"{title} [{unit}]")))

    for case, each in found.items():
        for title, angle in each.angles.items():
            plot(case, title, "°", angle)
        if case in ("bump", "roll"):
            plot(case, "vertical load", "kN", {name: 1e-3 * load for name, load in each.load.items()})
    place = {each.name: 1e3 * (bump.centre[each.name] - bump.centre[each.name][MIDDLE]) for each in wheels}
    plot("bump", "centre to the front", "mm", {name: each[:, 0] for name, each in place.items()})
    plot("bump", "centre outwards", "mm", {each.name: each.side * place[each.name][:, 1] for each in wheels})
    plot("bump", "roll centre", "mm", {a.name: 1e3 * roll_centre(bump, a, b)[:, 1] for a, b in axles(wheels, bump)})
    trust = ", ".join(f"{case} {each.trust}" for case, each in found.items())
    return plots_page(f"{machine}: K&C", told, plots, f"{RIG_NOTE} Trust: {trust}.")
