"""Joints: how far they are open, and how fast their parts move against each other."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Motion, Positions, Recorded, Scales
from nivel.results.peaks import worst_row
from nivel.results.trust import Item, Threshold, Verdict, number

CLOSED = 1e-12  # of the size, or of the speed: violations below it are round-off
THRESHOLD = Threshold(
    1e-6,
    1e-4,
    "For a machine of one metre, 1e-6 is a micrometre, less than the play of a good bearing. 1e-4 is a tenth of a millimetre, the play "
    "of a worn bearing: above it the joint is visibly open.",
)
RATES = Threshold(
    1e-5,
    1e-3,
    "If the parts of a joint move apart at 1e-3 of the machine's speed, the energy error has the same order. At 1e-5 it is below the "
    "green limit of the energy balance.",
)
# shares of the largest speed by which rates of constraints may be violated in kinematics
GREEN, AMBER = 1e-9, 1e-6
VELOCITIES = "Velocities fit the joints"


@dataclass(frozen=True)
class Violation:
    """The constraint row that is violated most, when [s], and by how much, in the units m, rad or 1 (of rates per second)."""

    value: float
    row: str
    time: float
    units: str
    scales: Scales


def look(subject: Recorded) -> Violation:
    """The joint that is open most."""
    worst, units = subject.opening
    return Violation(worst.value, worst.row, worst.time, units, subject.scales)


def look_at_rates(subject: Motion | Positions) -> Violation:
    """The same at velocity level."""
    size, speed = subject.scales.size, subject.scales.speed
    worst, units = worst_row(subject.result, "constraint_rate_violation", {"m": 1.0 / speed, "1": size / speed})
    return Violation(worst.value, worst.row, worst.time, f"{units}/s", subject.scales)


def say(found: Violation) -> Item | None:
    """How far joints are open; nothing of machines without any."""
    if not found.row:
        return None
    length, size = found.units == "m", found.scales.size
    fraction = found.value / (size if length else 1.0)
    if found.value == 0.0:
        return THRESHOLD.item("violation", "Joints: closed exactly", fraction)
    if fraction < CLOSED:
        return THRESHOLD.item("violation", "Joints: closed to round-off", fraction, found.time, found.row)
    value = f"{number(found.value)} m, " if length else ""
    angle = " rad" if found.units == "rad" else " as a cosine"
    scale = f" of the {found.scales.size_kind} {number(size)} m" if length else angle
    said = f"Joints: open by at most {value}{number(fraction)}{scale}, row {found.row} at t = {found.time:.6g} s"
    return THRESHOLD.item("violation", said, fraction, found.time, found.row)


def say_rates(found: Violation) -> Item | None:
    """How fast the parts of joints move against each other."""
    if not found.row:
        return None
    length, at_rest = found.units == "m/s", found.scales.at_rest
    scale = found.scales.speed if length else found.scales.speed / found.scales.size
    fraction = found.value / scale
    if fraction < CLOSED:
        said = "Joint rates: exact to round-off" + ("; the machine is at rest" if at_rest else "")
        return RATES.item("rate_violation", said, fraction, found.time, found.row)
    against = f"the largest speed {'' if length else 'over size '}{number(scale)} {found.units}"
    if at_rest:
        against = f"{number(scale)} {found.units}, the lower limit: the machine is at rest"
    said = f"Joint rates: off by at most {number(found.value)} {found.units}, {number(fraction)} of {against}"
    where = f"row {found.row} at t = {found.time:.6g} s"
    return RATES.item("rate_violation", f"{said}, {where}", fraction, found.time, found.row)


def say_velocities(found: Violation) -> Item:
    """Whether the velocities of kinematics fit the joints."""
    rate = found.value * (1.0 if found.units == "m/s" else found.scales.size) / found.scales.speed
    said = f"Velocities: rates of constraints are violated by at most {number(rate)} of the largest speed"
    verdict: Verdict = "green" if rate <= GREEN else "amber" if rate <= AMBER else "red"
    return Item("velocities", verdict, f"{said} (green up to {GREEN:g})", time=found.time)


CHECKS = (
    Check("violation", Recorded, look, say, 20, (), "Joints closed", THRESHOLD),
    Check("rate_violation", Motion, look_at_rates, say_rates, 30, (), "Joint rates", RATES),
    Check("rate_violation", Positions, look_at_rates, say_velocities, 30, (), VELOCITIES, line="velocities"),
)
