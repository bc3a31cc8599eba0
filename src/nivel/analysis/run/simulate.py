"""A whole run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from os import PathLike
from typing import Final

import numpy as np

from nivel.analysis.curves.step_limits import rounding_of_times
from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.interrupt import terminable
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.dynamics import RunOutcome, march
from nivel.analysis.run.fastest import too_long
from nivel.analysis.run.findings import find
from nivel.analysis.run.held_friction import resting_frictions
from nivel.analysis.run.preparation import prepare
from nivel.analysis.run.second_run import SecondRun, Verified
from nivel.errors import SolveError
from nivel.integrate.loop.run import MOVING
from nivel.integrate.loop.sink import Header
from nivel.machine.machine_record import MachineRecord
from nivel.results.frames.occurrence import to_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.results.trust.accuracy import error_from_finer, factor
from nivel.results.trust.circuits import Guard
from nivel.results.trust.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.trust.estimate import estimate_errors
from nivel.results.trust.findings import finding_items, steps_item
from nivel.results.trust.indeterminate_friction import Held, Sticking, loads_held_together, shared_loads
from nivel.results.trust.neglected import Neglected, cost
from nivel.results.trust.trust import Facts, Peak, SmallState, assess, peak
from nivel.results.trust.verdicts import CHECKS, Trust
from nivel.system.flexible import bending_bodies

WHOLE: Final = 0.999  # share of the frames after the first
LEAST: Final = 5  # frames of which something can be said


def saturated_blocks(machine: MachineRecord, result: Result) -> tuple[str, ...]:
    """Names of the blocks whose value was a limit in all frames but the first."""
    out = []
    for block in machine.control:
        limits = getattr(block, "limits", None)
        name = f"control.{block.name}"
        if limits is None or name not in result.variables or len(result.time) <= LEAST:
            continue
        values = result.array(name)[1:]
        if np.mean((values <= limits[0]) | (values >= limits[1])) >= WHOLE:
            out.append(block.name)
    return tuple(out)


# A state whose values stay below this share of its scale is not followed to the tolerance.
SMALL = 0.01


def simulate(
    plan: Plan,
    *,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    verify: bool = False,
    verify_limit: float | None = None,
    listener: Listener | None = None,
    compile_seconds: float = 0.0,
) -> Result:
    """Run as planned; the result is in memory, or streamed to the file `out`.

    compile_seconds : what was spent on compiling before, for the result's timing.
    verify : a second run goes beside this one, with finer steps on other times, and its distance tells how exact this one is; it goes on
    after it for `verify_limit` [s] at most, by default as long again as it took.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails, SystemExit where SIGTERM
    came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory(plan.settings.frames + 1) if out is None else Store(out, force)  # a failure adds one
    begin = time.perf_counter()
    listener.say("preparing")
    prepared = prepare(plan.methods)
    second = SecondRun(plan, verify_limit) if verify else None
    try:
        with terminable():
            return _run(plan, prepared, sink, second, source, listener, begin, compile_seconds)
    finally:
        if second is not None:
            second.cancel()


def _run(
    plan: Plan,
    prepared: Prepared,
    sink: Memory | Store,
    second: SecondRun | None,
    source: str,
    listener: Listener,
    begin: float,
    compile_seconds: float,
) -> Result:
    """The run, with the second one beside it."""
    machine, settings = plan.machine, plan.settings
    sink.begin(Header(prepared.motion.system.layout, run_attributes(machine, source, prepared, settings)))
    resting = resting_frictions(machine, prepared.absolute, prepared.assembly.y)
    prepare_seconds = time.perf_counter() - begin
    listener.say("running", settings.duration)
    finished = march(
        prepared, settings, [sink], progress=listener.progress, pacing=second.leader if second is not None else None
    )
    verified = None
    if second is not None and finished.outcome == "done" and not finished.asked_to_stop:
        verified = second.wait(listener)
    seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
    return close_run(sink, plan, prepared, finished, verified, resting, seconds)


def close_run(
    sink: Memory | Store,
    plan: Plan,
    prepared: Prepared,
    finished: RunOutcome,
    verified: Verified | None,
    resting: tuple[tuple[Held, ...], tuple[Sticking, ...]],
    timing: dict[str, float],
) -> Result:
    """Close the sink of a run with its trust report and all that is known of how it ended.

    verified : the second run, or None. resting : of `resting_frictions`. timing : seconds besides the loop's.
    Raises SolveError, with the result, where the run failed.
    """
    redundancy, machine = prepared.redundancy, plan.machine
    message, advice, at = finished.failure or ("", "", 0.0)
    left = verified.refinement.left if verified is not None else 0.0
    result = sink.result()
    estimate = estimate_errors(result, verified.result, factor(left)) if verified is not None else None
    findings = find(plan, prepared, finished, result, verified, estimate)
    facts = Facts(
        outcome=finished.outcome,
        degrees_of_freedom=redundancy.degrees_of_freedom,
        position_freedoms=redundancy.position_freedoms,
        kinetic_energy=float(finished.pace[MOVING].max()) if finished.pace is not None else 0.0,
        modes=len(prepared.motion.system.modes),
        drivers=prepared.drivers,
        redundant_rows=redundancy.redundant_rows,
        non_unique_joints=redundancy.non_unique_joints,
        accuracy=_accuracy(plan, result, verified) if verified is not None else None,
        refinement=verified.refinement.words if verified is not None else "",
        verified_until=verified.until if verified is not None and verified.ended else None,
        verification_ended=verified.ended if verified is not None else "",
        failure=message,
        stopped_by=finished.stopped_by,
        neglected=cost(result, _neglected(machine)),
        further=tuple(finding_items(findings)),
        small_states=_small_states(result, prepared, machine),
        saturated=saturated_blocks(machine, result),
        guard=_guard(finished, prepared),
        shared=(*shared_loads(result, resting[0]), *loads_held_together(result, resting[1])),
    )
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json(finished.events),
        "stopped_by": finished.stopped_by,
        "trust": _judged(result, facts, plan, prepared, finished).to_json(),
        "timing": json.dumps({**finished.timing, **timing}),
    }
    if estimate is not None:
        attributes[ESTIMATES] = estimate.to_json()
    closed = sink.close(attributes)
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=closed)
    return closed


def _accuracy(plan: Plan, result: Result, verified: Verified) -> Peak:
    """The headline: what two runs are apart by, and what both may have wrong by the rounding of times."""
    rounded = rounding_of_times(plan.machine, float(result.time[-1]))
    return error_from_finer(result, verified.result, verified.refinement.left, rounded)


def _judged(result: Result, facts: Facts, plan: Plan, prepared: Prepared, finished: RunOutcome) -> Trust:
    """The trust report; of a red run with the part that is too fast for its steps, where there is one."""
    trust = assess(result, facts)
    if trust.verdict != "red" or finished.outcome == "failed":  # its advice has told
        return trust
    fast = too_long(prepared, plan.settings, finished.last)
    if fast is None or fast.step * fast.rate < CHECKS["steps"].green:
        return trust
    return assess(result, replace(facts, further=(*facts.further, steps_item(fast))))


def guards_circuits(prepared: Prepared) -> bool:
    """Whether the steps of a run guard the pressures of circuits."""
    return bool(prepared.integrator.guarded and prepared.motion.system.nodes)


def _guard(finished: RunOutcome, prepared: Prepared) -> Guard | None:
    """What the guard of steps over circuits did; None where there is none."""
    if not guards_circuits(prepared):
        return None
    timing = finished.timing
    return Guard(int(timing["steps"]), int(timing["rejected"]), int(timing["guarded"]), timing["pressure_difference"])


def _small_states(result: Result, prepared: Prepared, machine: MachineRecord) -> tuple[SmallState, ...]:
    """The states that stayed far below the scale by which their errors are measured."""
    if not (prepared.integrator.chooses_steps or prepared.integrator.optional_control or prepared.integrator.residual):
        return ()
    out, components = [], {component.name for component in machine.hydraulics}
    for fact in prepared.motion.system.states:
        if fact.integral or fact.name.partition(".")[0] in components:
            continue  # their scales are those of their components
        largest = peak(result, fact.result).value
        if not fact.sampled and 0.0 < largest < SMALL * fact.scale:
            out.append(SmallState(fact.name, largest, fact.scale))
    return tuple(out)


def _neglected(machine: MachineRecord) -> tuple[Neglected, ...]:
    """The flexible bodies that move without some inertia invariants."""
    out, first = [], 0
    for each in bending_bodies(machine) if machine.is_flexible else ():
        last = first + len(each.reduced.eigenvalues)
        if each.neglected:
            name = machine.bodies[each.body].name
            out.append(Neglected(name, first, last, each.reduced.invariants, each.neglected))
        first = last
    return tuple(out)
