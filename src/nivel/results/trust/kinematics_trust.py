"""Trust in a kinematic result: closed joints, fitting velocities, uniqueness of reactions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from nivel.results.scales import Readable, largest_speed, machine_size
from nivel.results.trust.statements import number, redundancy_item, violation_item
from nivel.results.trust.trust import worst_row
from nivel.results.trust.verdicts import Item, Trust, Verdict, worst

OUTCOMES: dict[str, tuple[Verdict, str]] = {
    "done": ("green", "Outcome: every position was found"),
    "interrupted": ("amber", "Outcome: interrupted; the result has the positions up to there"),
    "failed": ("red", "Outcome: the machine cannot move any further; the result has the positions up to there"),
}
# shares of the largest speed by which rates of constraints may be violated
GREEN, AMBER = 1e-9, 1e-6
# share of the least singular value at the start below which a position is near a singular one; names and times in a sentence
NEAR, SHOWN = 1e-3, 4


@dataclass(frozen=True)
class KinematicsFacts:
    """What only the analysis itself knows. halved : steps that were shortened on the way.

    passed : pairs of times [s] between which a singular position was passed. nearest : least singular value of the constraints, as a share
    of that at the start, and its time [s]; None where there are no constraints. split : joints that depend on each other most there.
    held : first-order states, which keep their values of the start.
    """

    outcome: str
    failure: str = ""
    drivers: int = 0
    redundant_rows: tuple[str, ...] = ()
    non_unique_joints: tuple[str, ...] = ()
    halved: int = 0
    passed: tuple[tuple[float, float], ...] = ()
    nearest: tuple[float, float] | None = None
    split: tuple[str, ...] = ()
    held: tuple[str, ...] = ()


@np.errstate(over="ignore", invalid="ignore")
def assess_kinematics(result: Readable, facts: KinematicsFacts) -> Trust:
    """The trust report of a kinematic analysis."""
    size, size_kind = machine_size(result)
    speed = max(largest_speed(result), 1e-300)
    violation, units = worst_row(result, "constraint_violation", {"m": 1.0 / size, "1": 1.0})
    rate, rate_units = worst_row(result, "constraint_rate_violation", {"m": 1.0 / speed, "1": size / speed})
    trust = Trust(
        verdict="green",
        outcome=facts.outcome,
        energy_error_max=0.0,
        energy_error_time=0.0,
        energy_scale=0.0,
        energy_scale_kind="",
        size=size,
        speed=speed,
        constraint_violation_max=violation.value,
        constraint_violation_row=violation.row,
        constraint_violation_time=violation.time,
        constraint_violation_units=units,
        constraint_rate_violation_max=rate.value,
        constraint_rate_violation_row=rate.row,
        constraint_rate_violation_time=rate.time,
        constraint_rate_violation_units=f"{rate_units}/s",
        degrees_of_freedom=0,
        drivers=facts.drivers,
        redundant_rows=facts.redundant_rows,
        non_unique_joints=facts.non_unique_joints,
        size_kind=size_kind,
    )
    items = tuple(_items(trust, facts, rate.value * (1.0 if rate_units == "m" else size) / speed))
    return replace(trust, items=items, verdict=worst(items))


def _items(trust: Trust, facts: KinematicsFacts, rate: float) -> Iterator[Item]:
    verdict, text = OUTCOMES.get(facts.outcome, ("red", f"Outcome: {facts.outcome}"))
    yield Item("outcome", verdict, f"{text}: {facts.failure}" if facts.failure else text)
    if trust.constraint_violation_row:
        yield violation_item(trust)
    said = f"Velocities: rates of constraints are violated by at most {number(rate)} of the largest speed"
    tone: Verdict = "green" if rate <= GREEN else "amber" if rate <= AMBER else "red"
    yield Item("velocities", tone, f"{said} (green up to {GREEN:g})", time=trust.constraint_rate_violation_time)
    if facts.halved:
        said = f"Steps: {facts.halved} were shortened, because the machine moves fast or comes near a singular position"
        yield Item("steps", "green", f"{said} (said, always green)")
    if facts.nearest is not None:
        yield _singular(facts, facts.nearest)
    if facts.held:
        some = ", ".join(facts.held[:SHOWN]) + (
            f" and {len(facts.held) - SHOWN} more" if len(facts.held) > SHOWN else ""
        )
        said = f"States: {some} have a history, which kinematics does not compute: they keep their initial values"
        more = "efforts and reactions that depend on them are wrong"
        yield Item("states", "amber", f"{said}, and {more} (green if there are none)")
    yield redundancy_item(trust)


def _singular(facts: KinematicsFacts, nearest: tuple[float, float]) -> Item:
    """Whether the positions are the only ones to which the drivers lead."""
    share, time = nearest
    among = f" (among {', '.join(facts.split[:SHOWN])})" if facts.split else ""
    if facts.passed:
        some = ", ".join(f"{a:.6g} and {b:.6g} s" for a, b in facts.passed[:SHOWN])
        more = f" and {len(facts.passed) - SHOWN} times more" if len(facts.passed) > SHOWN else ""
        said = f"Branches: a singular position is passed between {some}{more}{among}: the positions beyond it are one of several branches"
        return Item(
            "branches", "amber", f"{said} that fit the drivers (amber if any is passed)", time=facts.passed[0][1]
        )
    if share < NEAR:
        said = f"Branches: the machine comes near a singular position at t = {time:.6g} s{among}, where branches of positions meet"
        return Item("branches", "amber", f"{said} (amber below {NEAR:g} of the distance at the start)", time=time)
    said = f"Branches: the positions stay on one branch; the distance from singular ones is at least {number(share)} of that at the start"
    return Item("branches", "green", f"{said} (green from {NEAR:g} on)", time=time)
