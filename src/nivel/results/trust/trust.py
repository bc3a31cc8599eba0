"""Measure how far a run can be trusted."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from nivel.results.scales import (
    Readable,
    blocks,
    kinetic_energy_of_rest,
    largest_energy,
    largest_speed,
    machine_size,
    speed_of_rest,
)
from nivel.results.trust.circuits import Guard, circuit_items, guard_items
from nivel.results.trust.indeterminate_friction import Shared
from nivel.results.trust.neglected import Cost
from nivel.results.trust.rolling import rolling_items
from nivel.results.trust.statements import number, statements
from nivel.results.trust.unresolved import unresolved_force
from nivel.results.trust.verdicts import THRESHOLDS, Item, Trust, blindness, worst

__all__ = ["Facts", "Peak", "Trust", "assess", "peak", "worst_row"]


@dataclass(frozen=True)
class Peak:
    """The largest number of a history: its value, the name it belongs to, and the time in seconds."""

    value: float
    row: str = ""
    time: float = 0.0


@dataclass(frozen=True)
class SmallState:
    """A first-order state whose `largest` magnitude stayed far below its `scale`, by which its errors were measured."""

    name: str
    largest: float
    scale: float


@dataclass(frozen=True)
class Facts:
    """What only the run itself knows.

    outcome : done, interrupted, failed or running.
    degrees_of_freedom : of velocities, None where unknown; position_freedoms : of positions. modes : of flexible bodies. drivers : motions
    that are prescribed.
    non_unique_joints : joints whose reactions depend on which of the redundant rows are kept.
    accuracy : estimated largest error of a position [m], from `nivel.results.trust.accuracy`, and by what `refinement` of the run it was
    found;
    verified_until : the time [s] up to which, None: to the end; verification_ended : why not further.
    neglected : what it cost that flexible bodies moved without some of their inertia invariants. shared : frictions at rest on motions
    that are prescribed, or that others hold too.
    further : lines of checks that only tell what is not green, see `nivel.results.trust.findings`.
    small_states : those whose errors were hardly controlled. saturated : blocks of the control at a limit all the time.
    guard : what was not extrapolated of steps over circuits.
    kinetic_energy : the largest one that its steps had [J]; frames may all meet a vibration where it is slow.
    failure : what stopped the run, in a sentence. stopped_by : name of the event that ended it as it was to do.
    """

    outcome: str
    degrees_of_freedom: int | None = None
    redundant_rows: tuple[str, ...] = ()
    non_unique_joints: tuple[str, ...] = ()
    accuracy: Peak | None = None
    refinement: str = "half the step"
    verified_until: float | None = None
    verification_ended: str = ""
    failure: str = ""
    drivers: int = 0
    stopped_by: str = ""
    modes: int = 0
    neglected: Cost | None = None
    shared: tuple[Shared, ...] = ()
    small_states: tuple[SmallState, ...] = ()
    further: tuple[Item, ...] = ()
    saturated: tuple[str, ...] = ()
    guard: Guard | None = None
    position_freedoms: int | None = None
    kinetic_energy: float = 0.0


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def assess(result: Readable, facts: Facts) -> Trust:
    """The trust report of a run: what its histories show, the facts, and the verdicts."""
    size, size_kind = machine_size(result)
    speed, slowest = largest_speed(result), speed_of_rest(result, size)
    at_rest = speed < slowest
    speed = max(speed, slowest)
    energy = peak(result, "energy_error")
    violation, violation_units = worst_row(result, "constraint_violation", {"m": 1.0 / size, "1": 1.0})
    opening = violation.value / size if violation_units == "m" else violation.value
    energy_scale, energy_scale_kind = largest_energy(result, size, opening, at_rest)
    if facts.kinetic_energy > max(energy_scale, kinetic_energy_of_rest(result, slowest)):
        energy_scale, energy_scale_kind = facts.kinetic_energy, "largest kinetic energy"
    rate, rate_units = worst_row(result, "constraint_rate_violation", {"m": 1.0 / speed, "1": size / speed})
    lacking = facts.neglected
    is_green = energy.value < THRESHOLDS["energy"].green * energy_scale
    unresolved = None if is_green else unresolved_force(result, energy.value)
    trust = Trust(
        verdict="green",
        outcome=facts.outcome,
        energy_error_max=energy.value,
        energy_error_time=energy.time,
        energy_scale=energy_scale,
        energy_scale_kind=energy_scale_kind,
        size=size,
        speed=speed,
        constraint_violation_max=violation.value,
        constraint_violation_row=violation.row,
        constraint_violation_time=violation.time,
        constraint_violation_units=violation_units,
        constraint_rate_violation_max=rate.value,
        constraint_rate_violation_row=rate.row,
        constraint_rate_violation_time=rate.time,
        constraint_rate_violation_units=f"{rate_units}/s",
        degrees_of_freedom=facts.degrees_of_freedom,
        position_freedoms=facts.position_freedoms,
        modes=facts.modes,
        drivers=facts.drivers,
        redundant_rows=tuple(facts.redundant_rows),
        non_unique_joints=tuple(facts.non_unique_joints),
        accuracy_estimate=facts.accuracy.value if facts.accuracy else None,
        accuracy_body=facts.accuracy.row if facts.accuracy else "",
        accuracy_time=facts.accuracy.time if facts.accuracy else None,
        accuracy_refinement=facts.refinement,
        verified_until=facts.verified_until,
        verification_ended=facts.verification_ended,
        size_kind=size_kind,
        at_rest=at_rest,
        neglected_share=lacking.share if lacking else None,
        neglected_body=lacking.body if lacking else "",
        neglected_names=lacking.names if lacking else (),
        neglected_time=lacking.time if lacking else None,
        undetermined_efforts=tuple(dict.fromkeys(name for each in facts.shared for name in each.efforts)),
        unresolved_force=unresolved.force if unresolved else "",
        unresolved_work=unresolved.work if unresolved else 0.0,
        unresolved_time=unresolved.time if unresolved else 0.0,
    )
    items = (
        *statements(
            trust,
            facts.failure,
            facts.stopped_by,
            facts.shared,
            unresolved,
            blind=blindness(facts.further),
        ),
        *facts.further,
        *(_small_state(each) for each in facts.small_states),
        *(_saturated(name) for name in facts.saturated),
        *rolling_items(result),
        *circuit_items(result),
        *guard_items(facts.guard),
    )
    return replace(trust, items=items, verdict=worst(items))


def _small_state(state: SmallState) -> Item:
    """A state of which the tolerance says little."""
    said = f"the largest value of {state.name} is {number(state.largest)}, its scale is {number(state.scale)}: the tolerance hardly held"
    section, name = ("states", state.name)
    if state.name.startswith("control."):
        section, name = state.name.split(".")[:2]
    advice = f"write `{section}: {{{name}: {{scale: {state.largest:.1g}}}}}`"
    return Item("states", "amber", f"States: {said} it; {advice}", row=state.name)


def _saturated(name: str) -> Item:
    """A block whose gains did nothing."""
    said = f"{name} stood at its limits for the whole run, so its gains did nothing"
    return Item(
        "control", "amber", f"Control: {said}; check the signs of its inputs, its gains and its limits", row=name
    )


def peak(result: Readable, name: str) -> Peak:
    """The largest magnitude of a history without rows; the first NaN counts as the largest."""
    if name not in result.variables or not len(result.time):
        return Peak(0.0)
    values = np.abs(result.array(name))
    k = int(np.argmax(values))
    return Peak(float(values[k]), "", float(result.time[k]))


def worst_row(result: Readable, name: str, fraction_of: Mapping[str, float]) -> tuple[Peak, str]:
    """The row of `name` (time, row) that is largest as a fraction, and its units: m, rad or 1.

    fraction_of : factor that turns a value into a fraction: of lengths ("m"), of all others ("1").
    """
    if name not in result.variables:
        return Peak(0.0), "m"
    rows = result.coordinates[result.variables[name].dims[1]]
    units = row_units(result, rows)
    factors = np.array([fraction_of["m" if each == "m" else "1"] for each in units])
    best, largest = (0, 0), -1.0
    for frames in blocks(result):
        block = np.abs(result.array(name, frames)) * factors
        if not block.size:
            continue
        k, row = np.unravel_index(int(np.argmax(block)), block.shape)
        if not block[k, row] <= largest:  # also when it is NaN
            best, largest = (frames.start + int(k), int(row)), float(block[k, row])
        if math.isnan(largest):
            break
    if largest < 0.0:
        return Peak(0.0), "m"
    k, row = best
    value = float(abs(result.array(name, slice(k, k + 1))[0, row]))
    return Peak(value, rows[row], float(result.time[k])), units[row]


def row_units(result: Readable, rows: tuple[str, ...]) -> tuple[str, ...]:
    """Units of the constraint rows at position level, m, rad or 1; rows without a stated unit count as lengths.

    They are stated by the attribute `constraint_units` (JSON: row → units).
    """
    stated = json.loads(str(result.attributes.get("constraint_units", "{}")))
    return tuple(stated.get(row, "m") or "1" for row in rows)
