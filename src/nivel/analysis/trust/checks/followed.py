"""Drivers of kinematics and inverse dynamics: whether the positions that were found are those that the drivers' functions of time ask for.

The functions are evaluated here once more, as the machine file has them, and compared with the joint coordinates of the result.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import polynomial

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Actuated, Positions, Scales
from nivel.machine.joints.driver import Driver
from nivel.machine.laws.table import Table
from nivel.machine.units.expression import Expression
from nivel.machine.units.tree import ExpressionError
from nivel.results.trust import Item, Verdict, number
from nivel.system.laws.integrated import integrated
from nivel.system.system import Array

# [lengths of the machine, rad] by which a driver may be missed: green, and no worse than amber
GREEN, AMBER = 1e-9, 1e-7


@dataclass(frozen=True)
class Followed:
    """The driver that is followed worst, by how much it is missed [m or rad], when [s]; how many are compared, of how many."""

    driver: str
    coordinate: str
    units: str
    missed: float
    time: float
    compared: int
    drivers: int
    scales: Scales


def look(subject: Positions | Actuated) -> Followed | None:
    """The largest distance of a joint coordinate from its driver; None where no driver of a joint coordinate can be compared."""
    return farthest(subject, subject.drivers)


def farthest(subject: Positions | Actuated, drivers: Sequence[Driver]) -> Followed | None:
    """The same of these drivers."""
    time, result = subject.result.time, subject.result
    known = subject.joint_coordinates
    found = []
    for driver in drivers:
        wanted = wanted_values(driver, time)
        name = _coordinate(driver, list(known))
        if wanted is None or name is None:
            continue
        value = result.array("joint_coordinate")[:, list(known).index(name)]
        missed = np.abs(value - wanted)
        if driver.from_start or driver.value is None:
            missed = np.abs(value - value[0] - (wanted - wanted[0]))
        share = missed / (subject.scales.size if known[name] == "m" else 1.0)
        worst = int(np.argmax(share))
        found.append((float(share[worst]), driver.name, name, known[name], float(missed[worst]), float(time[worst])))
    if not found:
        return None
    _, driver_name, name, units, most, when = max(found)
    return Followed(driver_name, name, units, most, when, len(found), len(drivers), subject.scales)


def not_compared(subject: Positions | Actuated) -> list[str]:
    """Drivers of which `look` cannot compare what they prescribe: those of markers, and functions in Python."""
    names, start = list(subject.joint_coordinates), subject.result.time[:2]
    return [
        driver.name
        for driver in subject.drivers
        if wanted_values(driver, start) is None or _coordinate(driver, names) is None
    ]


def wanted_values(driver: Driver, time: Array) -> Array | None:
    """(T,) [m or rad] what a driver of a coordinate asks for, by its own function of time; None of functions in Python."""
    value = driver.value
    if driver.coordinate is None:
        return None
    if value is None:
        return _way(driver, time)
    if isinstance(value, Table | Expression):
        try:
            return np.array([value(float(t)) for t in time])
        except ExpressionError:
            return None
    return np.full(len(time), float(value)) if isinstance(value, int | float) else None


def _way(driver: Driver, time: Array) -> Array | None:
    """(T,) [m or rad] from where it begins, of a driver by a speed or an acceleration; None of functions in Python."""
    end = float(time[-1]) or 1.0
    if driver.speed is not None:
        points, pieces = integrated(driver.speed, 1, end)
    elif driver.acceleration is not None:
        points, pieces = integrated(driver.acceleration, 2, end, driver.start_speed)
    else:
        return None
    place = np.clip(np.searchsorted(points, time, side="right") - 1, 0, len(pieces) - 1)
    return np.asarray(polynomial.polyval(time - points[place], pieces[place].T, tensor=False), dtype=np.float64)


def _coordinate(driver: Driver, names: list[str]) -> str | None:
    """The joint coordinate of a driver in the result, also where its joint alone is named."""
    reference = str(driver.coordinate)
    if reference in names:
        return reference
    own = [name for name in names if name.startswith(f"{reference}.")]
    return own[0] if len(own) == 1 else None


def say(found: Followed) -> Item:
    """Whether drivers are followed."""
    length = found.units == "m"
    share = found.missed / (found.scales.size if length else 1.0)
    some = "" if found.compared == found.drivers else f"; {found.compared} of {found.drivers} drivers are compared"
    limits = f"(green up to {GREEN:g}, amber up to {AMBER:g} of the {found.scales.size_kind}, or rad)"
    if share <= GREEN:
        return Item("followed", "green", f"Drivers: followed to round-off or {number(GREEN)}{some} {limits}")
    said = f"Drivers: {found.coordinate} misses what {found.driver} prescribes by {number(found.missed)} {found.units}"
    verdict: Verdict = "amber" if share <= AMBER else "red"
    return Item("followed", verdict, f"{said} at t = {found.time:.6g} s{some} {limits}", time=found.time)


def look_at_replaced(subject: Actuated) -> Followed | None:
    """What another motion than that of the drivers is off from these."""
    found = farthest(subject, subject.replaced)
    return found if found is not None and found.missed > AMBER else None


def say_replaced(found: Followed) -> Item:
    """That efforts are those of the motion, not of the driver. It is what was asked for."""
    said = f"Drivers: the motion is not that which {found.driver} prescribes: {found.coordinate} is off by up to"
    text = f"{said} {number(found.missed)} {found.units} at t = {found.time:.6g} s (said, always green)"
    return Item("replaced", "green", text, time=found.time)


CHECKS = (
    Check("followed", (Positions, Actuated), look, say, place=25, needs=(FRAMES,), title="Drivers followed"),
    Check("replaced", Actuated, look_at_replaced, say_replaced, place=26, needs=(FRAMES,), title="Drivers replaced"),
)
