"""K&C of a suspension: curves of its wheels on a rig, numbers at the drawn height, and the page.

Toe is positive where wheels point inwards in front, camber where they lean outwards. The contact lies below the centre of a wheel, by the
radius of its tyre; wheels do not spin. Slopes are those of the polynomials through equilibria at Chebyshev's nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebfit, chebval

from nivel.lazy import Struct
from nivel.looks.poses import rotation
from nivel.machine.core.vectors import Array
from nivel.report.handling_page import Numbers, plots_page
from nivel.report.plots import Line, curves
from nivel.results.result import Result

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
NOTE = "Toe: inwards in front; camber: outwards at the top. Forces act at the ground. Heights and loads are those of the rig."


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
    def of(cls, run: Result, wheels: list[Wheel], size: float) -> Curves:
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
    return plots_page(f"{machine}: K&C", told, plots, f"{NOTE} Trust: {trust}.")
