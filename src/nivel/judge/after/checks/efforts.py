"""Efforts of inverse dynamics, and drivers: whether positions and efforts are those that the functions of time ask for.

The functions of drivers are evaluated here once more, as the machine file has them, and compared with the joint coordinates of the
result.
"""

from collections.abc import Sequence

import numpy as np
from numpy.polynomial import polynomial

from nivel.judge.after.checks.joints import OPENING
from nivel.judge.after.checks.positions import Histories, Opening
from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Actuated, Positions, Scales
from nivel.known import Driver
from nivel.lazy import Struct
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.units.tree import ExpressionError
from nivel.results.trust import Item, Verdict, number
from nivel.system.laws.integrated import integrated
from nivel.system.system import Array
from nivel.words.wording import first_of

# [lengths of the machine, rad] by which a driver may be missed: green, and no worse than amber
GREEN, AMBER = 1e-9, 1e-7


class Followed(Struct):
    """The driver that is followed worst, by how much it is missed [m or rad], when [s]; how many are compared, of how many."""

    driver: str
    coordinate: str
    units: str
    missed: float
    time: float
    compared: int
    drivers: int
    scales: Scales


def look_at_drivers(subject: Positions | Actuated) -> Followed | None:
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


def say_drivers(found: Followed) -> Item:
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


def _look_at_replaced(subject: Actuated) -> Followed | None:
    found = farthest(subject, subject.replaced)
    return found if found is not None and found.missed > AMBER else None


def _say_replaced(found: Followed) -> Item:
    """That efforts are those of the motion, not of the driver. It is what was asked for."""
    said = f"Drivers: the motion is not that which {found.driver} prescribes: {found.coordinate} is off by up to"
    text = f"{said} {number(found.missed)} {found.units} at t = {found.time:.6g} s (said, always green)"
    return Item("replaced", "green", text, time=found.time)


SHOWN = 4  # states in a sentence


class OfMotion(Struct):
    """The verdict on the motion, and its headline."""

    verdict: Verdict
    headline: str


class Missing(Struct):
    """The largest share of the generalised forces that no effort gives, when [s], as which effort on which coordinate (empty: on none
    alone), and whether limits hold efforts back."""

    share: float
    time: float
    effort: float
    coordinate: str
    limited: bool


class Surplus(Struct):
    """How many actuators more than needed there are."""

    actuators: int


def _look_at_motion(subject: Actuated) -> OfMotion | None:
    """What the trust report of the motion says; None where nothing is against it."""
    trust = subject.result.trust
    return OfMotion(trust.verdict, trust.headline) if trust.verdict != "green" else None


def _say_motion(found: OfMotion) -> Item:
    said = f"Motion: its own trust report is {found.verdict}, {found.headline}"
    return Item("motion", found.verdict, f"{said} (the colour is that of the motion)")


def _look_at_joints(subject: Actuated) -> Opening | None:
    """The joint of this machine that the motion opens most; None where they are closed."""
    share = subject.efforts.violation
    return None if share < OPENING.green else Opening(share)


def _say_joints(found: Opening) -> Item:
    said = f"Joints: the motion has joints open by {found.share:.3g} of their scales, so it is not quite one of this machine"
    return OPENING.item("violation", f"{said}: is it of another one?", found.share)


def _look_at_states(subject: Actuated) -> Histories | None:
    return Histories(subject.efforts.held) if subject.efforts.held else None


def _say_states(found: Histories) -> Item:
    said = f"States: the motion has no history of {first_of(found.states, SHOWN)}: they keep their initial values"
    wrong = "and what forces make of them is not that of the motion; give the result of a run"
    return Item("states", "amber", f"{said}, {wrong} (green if there are none)")


def _look_at_missing(subject: Actuated) -> Missing | None:
    """What the efforts do not give; None where they make the whole motion."""
    efforts = subject.efforts
    if efforts.complete:
        return None
    k = int(np.argmax(efforts.missing_share))
    share, effort, time = float(efforts.missing_share[k]), float(efforts.missing[k]), float(efforts.time[k])
    return Missing(share, time, effort, efforts.missing_at, efforts.limited)


def _say_missing(found: Missing) -> Item:
    where = f", most of it as {found.effort:.4g} on {found.coordinate}" if found.coordinate else ""
    why = "limits hold the actuators back" if found.limited else "no actuator gives it"
    said = (
        f"Efforts: they do not make this motion: {100.0 * found.share:.3g} % of the generalised forces are missing at "
        f"t = {found.time:.6g} s{where}; {why}"
    )
    return Item("missing", "amber", f"{said} (green if none are)", found.share, time=found.time)


def _look_at_surplus(subject: Actuated) -> Surplus | None:
    efforts = subject.efforts
    return None if efforts.unique else Surplus(len(efforts.actuators) - efforts.rank)


def _say_surplus(found: Surplus) -> Item:
    several = f"{found.actuators} more actuator{'s' * (found.actuators > 1)} than needed"
    said = f"Efforts: {several}: these are those of least weighted norm, others do as well"
    return Item("unique", "green", f"{said} (said, always green)")


CHECKS = (
    Check("followed", (Positions, Actuated), look_at_drivers, say_drivers, 25, (FRAMES,), "Drivers followed"),
    Check("replaced", Actuated, _look_at_replaced, _say_replaced, 26, (FRAMES,), "Drivers replaced"),
    Check("motion", Actuated, _look_at_motion, _say_motion, 12, (), "Motion"),
    Check("open_joints", Actuated, _look_at_joints, _say_joints, 20, line="violation"),
    Check("held_states", Actuated, _look_at_states, _say_states, 38, line="states"),
    Check("missing", Actuated, _look_at_missing, _say_missing, 40, (), "Efforts"),
    Check("surplus", Actuated, _look_at_surplus, _say_surplus, 42, (), "Efforts", line="unique"),
)
