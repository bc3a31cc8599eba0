"""The numbers of a trust report said to a machine designer, each with its thresholds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from nivel.results.trust.indeterminate_friction import Shared, in_words
from nivel.results.trust.unresolved import Unresolved
from nivel.results.trust.verdicts import (
    CLOSED,
    ROUND_OFF,
    THRESHOLDS,
    Item,
    Threshold,
    Trust,
    Verdict,
    number,
    quantity,
)

OUTCOMES: dict[str, tuple[Verdict, str]] = {
    "done": ("green", "Outcome: the run reached its end"),
    "interrupted": ("amber", "Outcome: interrupted; the result ends there"),
    "failed": ("red", "Outcome: the computation failed; the result ends there"),
    "running": ("amber", "Outcome: the file was not closed: the run is still going on, or it was killed"),
}


def statements(
    trust: Trust,
    failure: str,
    stopped_by: str = "",
    shared: Sequence[Shared] = (),
    unresolved: Unresolved | None = None,
    *,
    blind: str = "",
) -> Iterator[Item]:
    """The items of the report; `failure` says what stopped the run, `stopped_by` which event ended it, `shared` which frictions share
    a load in no certain way, `unresolved` the force that the energy error comes from, `blind` why a second run may be wrong as the first.
    """
    verdict, text = OUTCOMES.get(trust.outcome, ("red", f"Outcome: {trust.outcome}"))
    if stopped_by:
        text = f"Outcome: the event {stopped_by} ended the run, as intended"
    yield Item("outcome", verdict, f"{text}: {failure}" if failure else text)
    yield _energy_item(trust, unresolved)
    if trust.constraint_violation_row:
        yield violation_item(trust)
        yield _rate_item(trust)
    if trust.degrees_of_freedom is not None:
        yield freedom_item(trust)
    yield redundancy_item(trust)
    if shared:
        yield _shared_item(shared)
    if trust.accuracy_estimate is not None:
        yield _accuracy_item(trust, trust.accuracy_estimate, blind)
        if trust.verified_until is not None:
            yield _partly_verified_item(trust, trust.verified_until)
    if trust.neglected_share is not None:
        yield _neglected_item(trust, trust.neglected_share)


def _energy_item(trust: Trust, unresolved: Unresolved | None) -> Item:
    error, scale = trust.energy_error_max, trust.energy_scale
    fraction = error / scale if scale > 0.0 else 0.0 if error == 0.0 else math.nan if math.isnan(error) else math.inf
    if not math.isfinite(error):
        said = f"the energy is not a number from t = {trust.energy_error_time:.6g} s on"
    elif scale > 0.0:
        said = f"error {THRESHOLDS['energy'].shown(fraction)} of the {trust.energy_scale_kind} {quantity(scale, 'J')}"
    elif not trust.energy_scale_kind:
        said = "nothing was computed"
    else:
        said = (
            "no energy anywhere, and no error"
            if error == 0.0
            else f"error {quantity(error, 'J')} where there is no energy"
        )
    cause = _unresolved_words(unresolved) if unresolved else ""
    row = unresolved.force if unresolved else ""
    return numeric("energy", f"Energy: {said}{cause}", fraction, trust.energy_error_time, row)


def _unresolved_words(unresolved: Unresolved) -> str:
    """Which force is too fast for the step, by what that is seen, and what to do."""
    its = unresolved
    share = (
        f"{number(its.work / its.energy)} times all other energy of the run" if its.energy else "and there is no energy"
    )
    return (
        f"; {its.force} does {quantity(its.work, 'J')} in one step of {number(its.step)} s at t = {its.time:.6g} s, {share}: its effect "
        f"decays or vibrates within a step, so its work is not known. Use a shorter step, or an integrator that chooses "
        f"its steps (radau)"
    )


def violation_item(trust: Trust) -> Item:
    """How far joints are open."""
    length = trust.constraint_violation_units == "m"
    fraction = trust.constraint_violation_max / (trust.size if length else 1.0)
    value = f"{number(trust.constraint_violation_max)} m, " if length else ""
    angle = " rad" if trust.constraint_violation_units == "rad" else " as a cosine"
    scale = f" of the {_size(trust)}" if length else angle
    said = f"Joints: open by at most {value}{number(fraction)}{scale}"
    if trust.constraint_violation_max == 0.0:
        return numeric("violation", "Joints: closed exactly", fraction, None, "")
    if fraction < CLOSED:
        said = "Joints: closed to round-off"
        return numeric("violation", said, fraction, trust.constraint_violation_time, trust.constraint_violation_row)
    row, time = trust.constraint_violation_row, trust.constraint_violation_time
    return numeric("violation", f"{said}, row {row} at t = {time:.6g} s", fraction, time, row)


def _rate_item(trust: Trust) -> Item:
    length = trust.constraint_rate_violation_units == "m/s"
    scale = trust.speed if length else trust.speed / trust.size
    fraction = trust.constraint_rate_violation_max / scale
    said_scale = f"{number(scale)} {trust.constraint_rate_violation_units}"
    against = f"the largest speed {'' if length else 'over size '}{said_scale}"
    if trust.at_rest:
        against = f"{said_scale}, the lower limit: the machine is at rest"
    units = trust.constraint_rate_violation_units
    value = number(trust.constraint_rate_violation_max)
    if fraction < CLOSED:
        said = "Joint rates: exact to round-off" + ("; the machine is at rest" if trust.at_rest else "")
        return numeric(
            "rate_violation", said, fraction, trust.constraint_rate_violation_time, trust.constraint_rate_violation_row
        )
    said = f"Joint rates: off by at most {value} {units}, {number(fraction)} of {against}"
    row, time = trust.constraint_rate_violation_row, trust.constraint_rate_violation_time
    return numeric("rate_violation", f"{said}, row {row} at t = {time:.6g} s", fraction, time, row)


def _accuracy_item(trust: Trust, estimate: float, blind: str) -> Item:
    fraction = estimate / trust.size
    if blind:
        agrees = f"a second run with {trust.accuracy_refinement} agrees within {number(estimate)} m"
        said = f"Accuracy: {agrees}, but both may have the same error: {blind}"
        return numeric("accuracy", said, fraction, trust.accuracy_time, trust.accuracy_body)
    if fraction < ROUND_OFF:
        said = f"Accuracy: exact for this model, except for round-off, by a second run with {trust.accuracy_refinement}"
        return numeric("accuracy", said, fraction, trust.accuracy_time, trust.accuracy_body)
    until = f" up to t = {trust.verified_until:.6g} s" if trust.verified_until is not None else ""
    within = f"within {number(estimate)} m of the exact motion of this model{until}, {number(fraction)} of the {_size(trust)}"
    where = f"; largest at {trust.accuracy_body}" if trust.accuracy_body else ""
    when = f", t = {trust.accuracy_time:.6g} s" if trust.accuracy_time is not None else ""
    said = f"Accuracy: {within}, by a second run with {trust.accuracy_refinement}{where}{when}"
    return numeric("accuracy", said, fraction, trust.accuracy_time, trust.accuracy_body)


def _partly_verified_item(trust: Trust, until: float) -> Item:
    text = f"Verified: up to t = {until:.6g} s only, not verified beyond: {trust.verification_ended}"
    return Item("verified", "amber", f"{text} (green if verified to the end, amber otherwise)", time=until)


def _neglected_item(trust: Trust, share: float) -> Item:
    """What flexible bodies lack that move without some inertia invariants."""
    names = " and ".join(trust.neglected_names)
    lacks = f"without {names} the mass matrix of {trust.neglected_body} lacks at most {number(share)} for the deflections of this run"
    when = f", at t = {trust.neglected_time:.6g} s" if trust.neglected_time is not None else ""
    return numeric("neglected", f"Neglected: {lacks}{when}", share, trust.neglected_time, trust.neglected_body)


def freedom_item(trust: Trust) -> Item:
    """Degrees of freedom."""
    count = trust.degrees_of_freedom or 0
    if count < 1 and trust.drivers:
        prescribed = "the driver prescribes" if trust.drivers == 1 else f"{trust.drivers} drivers prescribe"
        return Item("degrees_of_freedom", "green", f"Freedom: 0 degrees of freedom, {prescribed} every motion (green)")
    if count < 1:
        return Item(
            "degrees_of_freedom", "amber", "Freedom: 0 degrees of freedom: nothing can move (green with 1 or more)"
        )
    degrees = "1 degree of freedom" if count == 1 else f"{count} degrees of freedom"
    if trust.position_freedoms is not None and trust.position_freedoms > count:
        degrees += f" of velocities, {trust.position_freedoms} of positions, as wheels roll without slip"
    modes = f", with {trust.modes} modes of flexible bodies" if trust.modes else ""
    return Item("degrees_of_freedom", "green", f"Freedom: {degrees}{modes} (green with 1 or more)")


def redundancy_item(trust: Trust) -> Item:
    """Constraints that repeat others."""
    if not trust.redundant_rows:
        return Item(
            "redundancy",
            "green",
            "Redundancy: no redundant constraints, every reaction is unique (green if none)",
        )
    rows = ", ".join(trust.redundant_rows)
    count = len(trust.redundant_rows)
    repeats = "1 constraint row repeats others" if count == 1 else f"{count} constraint rows repeat others"
    unsure = (
        f"how {', '.join(trust.non_unique_joints)} share the load is not unique: `nivel check` lists the unique components, and the range "
        "of the others"
        if trust.non_unique_joints
        else "the reactions are unique"
    )
    text = f"Redundancy: {repeats} ({rows}). They do not change the motion; {unsure} (green if none, amber otherwise)"
    return Item("redundancy", "amber", text)


def _shared_item(shared: Sequence[Shared]) -> Item:
    """Frictions that hold a joint at rest together with what prescribes its motion, or with other frictions."""
    text = (
        f"Friction: {'; '.join(map(in_words, shared))}. The motion does not depend on how they share the load, which is not unique "
        f"(green if none, amber otherwise)"
    )
    return Item("shared_friction", "amber", text, time=min(each.spans[0][0] for each in shared))


def _size(trust: Trust) -> str:
    return f"{trust.size_kind} {number(trust.size)} m"


def numeric(
    name: str, text: str, fraction: float, time: float | None, row: str = "", threshold: Threshold | None = None
) -> Item:
    """An item held against its threshold."""
    threshold = threshold or THRESHOLDS[name]
    return Item(
        name,
        threshold.verdict(fraction),
        f"{text} ({threshold})",
        fraction,
        threshold.green,
        threshold.amber,
        row,
        time,
    )
