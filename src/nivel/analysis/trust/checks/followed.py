"""Drivers of a kinematic analysis: whether the positions that were found are those that the drivers' functions of time ask for.

The functions are evaluated here once more, as the machine file has them, and compared with the joint coordinates of the result.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Positions, Scales
from nivel.machine.joints.driver import Driver
from nivel.machine.laws.table import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.expression import Expression
from nivel.machine.units.tree import ExpressionError
from nivel.results.trust import Item, Verdict, number
from nivel.system.system import Array, System

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


def look(subject: Positions) -> Followed | None:
    """The largest distance of a joint coordinate from its driver; None where no driver of a joint coordinate can be compared."""
    time, result = subject.result.time, subject.result
    names = list(subject.prepared.motion.system.layout.coordinates["joint_coordinate"])
    found = []
    for driver in subject.machine.drivers:
        wanted = wanted_values(driver, time)
        name = _coordinate(driver, names)
        if wanted is None or name is None:
            continue
        units = subject.prepared.motion.system.coordinate_units[names.index(name)]
        value = result.array("joint_coordinate")[:, names.index(name)]
        missed = np.abs(value - wanted)
        if driver.from_start:
            missed = np.abs(value - value[0] - (wanted - wanted[0]))
        share = missed / (subject.scales.size if units == "m" else 1.0)
        worst = int(np.argmax(share))
        found.append((float(share[worst]), driver.name, name, units, float(missed[worst]), float(time[worst])))
    if not found:
        return None
    _, driver_name, name, units, most, when = max(found)
    return Followed(driver_name, name, units, most, when, len(found), len(subject.machine.drivers), subject.scales)


def not_compared(machine: MachineRecord, system: System) -> list[str]:
    """Drivers of which `look` cannot compare what they prescribe: those of markers, and functions in Python."""
    names, start = list(system.layout.coordinates["joint_coordinate"]), np.zeros(1)
    return [
        driver.name
        for driver in machine.drivers
        if wanted_values(driver, start) is None or _coordinate(driver, names) is None
    ]


def wanted_values(driver: Driver, time: Array) -> Array | None:
    """(T,) [m or rad] what a driver of a coordinate asks for, by its own function of time; None of functions in Python."""
    value = driver.value
    if driver.coordinate is None or value is None:
        return None
    if isinstance(value, Table | Expression):
        try:
            return np.array([value(float(t)) for t in time])
        except ExpressionError:
            return None
    return np.full(len(time), float(value)) if isinstance(value, int | float) else None


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


CHECKS = (Check("followed", (Positions,), look, say, place=25, needs=(FRAMES,), title="Drivers followed"),)
