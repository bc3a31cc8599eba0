"""Trust in a statics result: equilibrium, closed joints, and how stable what was found is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from nivel.results.scales import Readable, machine_size
from nivel.results.trust.statements import freedom_item, number, numeric, redundancy_item, violation_item
from nivel.results.trust.trust import peak, worst_row
from nivel.results.trust.verdicts import RESIDUAL, Item, Trust, Verdict, worst

SHOWN = 6

OUTCOMES: dict[str, tuple[Verdict, str]] = {
    "done": ("green", "Outcome: every state of equilibrium was found"),
    "interrupted": ("amber", "Outcome: interrupted; the result has the states up to there"),
    "failed": ("red", "Outcome: the computation failed; the result has the states up to there"),
}


@dataclass(frozen=True)
class StaticsFacts:
    """What only the run itself knows; see `nivel.results.trust.trust.Facts`.

    critical : (kind, t [s], None or the times [s] between which it is where it was not found) of limit and bifurcation points, along the
    path. at_rest : sentences on what makes no force at rest.
    rigid : vibrations of no frequency. without_potential : some force has none, as one that follows a body.
    """

    outcome: str
    failure: str = ""
    degrees_of_freedom: int | None = None
    drivers: int = 0
    redundant_rows: tuple[str, ...] = ()
    non_unique_joints: tuple[str, ...] = ()
    critical: tuple[tuple[str, float, tuple[float, float] | None], ...] = ()
    at_rest: tuple[str, ...] = ()
    rigid: int = 0
    without_potential: bool = False


@np.errstate(over="ignore", invalid="ignore")
def assess_statics(result: Readable, facts: StaticsFacts) -> Trust:
    """The trust report of a statics run."""
    size, size_kind = machine_size(result)
    violation, units = worst_row(result, "constraint_violation", {"m": 1.0 / size, "1": 1.0})
    trust = Trust(
        verdict="green",
        outcome=facts.outcome,
        energy_error_max=0.0,
        energy_error_time=0.0,
        energy_scale=0.0,
        energy_scale_kind="",
        size=size,
        speed=1.0,
        constraint_violation_max=violation.value,
        constraint_violation_row=violation.row,
        constraint_violation_time=violation.time,
        constraint_violation_units=units,
        degrees_of_freedom=facts.degrees_of_freedom,
        drivers=facts.drivers,
        redundant_rows=tuple(facts.redundant_rows),
        non_unique_joints=tuple(facts.non_unique_joints),
        size_kind=size_kind,
        at_rest=True,
    )
    items = tuple(_items(result, trust, facts))
    return replace(trust, items=items, verdict=worst(items))


def _items(result: Readable, trust: Trust, facts: StaticsFacts) -> Iterator[Item]:
    verdict, text = OUTCOMES.get(facts.outcome, ("red", f"Outcome: {facts.outcome}"))
    yield Item("outcome", verdict, f"{text}: {facts.failure}" if facts.failure else text)
    if len(result.time):
        yield _residual(result)
    if trust.constraint_violation_row:
        yield violation_item(trust)
    if len(result.time):
        yield _stability(result)
    if facts.critical:
        yield _critical(facts)
    if facts.without_potential:
        said = "Potential: some loads have no potential (follower forces, or torques about a fixed axis): flutter is not examined"
        yield Item("potential", "amber", f"{said} (green if all loads have one)")
    if facts.rigid:
        said = f"Vibrations: {facts.rigid} with frequency zero: rigid-body motions of the machine"
        yield Item("vibrations", "amber", f"{said} (green if none)")
    if facts.at_rest:
        yield Item("at_rest", "green", f"At rest: {'; '.join(facts.at_rest)} (said, always green)")
    if trust.degrees_of_freedom is not None:
        yield freedom_item(trust)
    yield redundancy_item(trust)


def _residual(result: Readable) -> Item:
    """Forces left over; those that round-off explains are as good as none."""
    left = peak(result, "residual")
    values, rounded = result.array("residual"), result.array("residual_round_off")
    said = (
        f"Equilibrium: unbalanced forces are at most {number(left.value)} of the largest load, at t = {left.time:.6g} s"
    )
    if RESIDUAL.verdict(left.value) != "green" and np.all(values <= np.maximum(rounded, RESIDUAL.green)):
        said += "; round-off of the positions makes as much of them, with parts so stiff"
        return replace(numeric("residual", said, left.value, left.time, threshold=RESIDUAL), verdict="green")
    return numeric("residual", said, left.value, left.time, threshold=RESIDUAL)


def _stability(result: Readable) -> Item:
    counts, time = result.array("unstable_directions"), result.time
    unstable = np.flatnonzero(counts > 0)
    if np.any(counts < 0):
        text = (
            "Stability: not determined, because it depends on sampled blocks; a run from this state shows whether the machine "
            "stays there (amber)"
        )
        return Item("stability", "amber", text)
    if not len(unstable):
        return Item(
            "stability", "green", "Stability: every state is stable: no direction of negative stiffness (green)"
        )
    first, total = int(unstable[0]), len(counts)
    most = int(counts.max())
    directions = "1 direction" if most == 1 else f"up to {most} directions"
    text = (
        f"Stability: {len(unstable)} of {total} states are unstable, in {directions}, the first at t = {time[first]:.6g} s: left alone, a "
        f"machine does not stay there (amber)"
    )
    return Item("stability", "amber", text, time=float(time[first]))


def _critical(facts: StaticsFacts) -> Item:
    named = [
        f"{kind} at t = {t:.9g} s"
        if between is None
        else f"{kind} between the states of t = {between[0]:.9g} s and {between[1]:.9g} s"
        for kind, t, between in facts.critical
    ]
    more = f" and {len(named) - SHOWN} more" if len(named) > SHOWN else ""
    return Item("critical", "amber", f"Critical points: {', '.join(named[:SHOWN])}{more} (amber if there are any)")
