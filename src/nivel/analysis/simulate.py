"""A whole run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from os import PathLike

from nivel.analysis.attributes import run_attributes
from nivel.analysis.dynamics import RunOutcome, march
from nivel.analysis.held_friction import resting_frictions
from nivel.analysis.history import SECANT
from nivel.analysis.listener import Listener
from nivel.analysis.plan import Plan
from nivel.analysis.preparation import Prepared, prepare
from nivel.analysis.settings import RunSettings
from nivel.errors import SolveError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.sink import Header
from nivel.machine.machine_record import MachineRecord
from nivel.results.accuracy import error_from_finer
from nivel.results.circuits import Guard
from nivel.results.held import Held, shared_loads
from nivel.results.held_together import Sticking, loads_held_together
from nivel.results.memory import Memory
from nivel.results.neglected import Neglected, cost
from nivel.results.occurrence import to_json
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.results.trust import Facts, Peak, SmallState, assess, peak
from nivel.system.flexible import bending_bodies

# A state whose values stay below this share of its scale is not followed to the tolerance.
SMALL = 0.01


def simulate(
    plan: Plan,
    *,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    verify: bool = False,
    listener: Listener | None = None,
    compile_seconds: float = 0.0,
) -> Result:
    """Run as planned; the result is in memory, or streamed to the file `out`.

    compile_seconds : what was spent on compiling before, for the result's timing.
    verify : run again with half the step, or a tenth of the tolerance, and estimate the accuracy from the difference.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails.
    """
    listener = listener or Listener()
    machine, settings = plan.machine, plan.settings
    sink = Memory() if out is None else Store(out, force)
    begin = time.perf_counter()
    listener.say("preparing")
    prepared = prepare(plan.methods)
    sink.begin(Header(prepared.motion.system.layout, run_attributes(machine, source, prepared, settings)))
    resting = resting_frictions(machine, prepared.absolute, prepared.assembly.y)
    prepare_seconds = time.perf_counter() - begin
    listener.say("running", settings.duration)
    finished = march(prepared, settings, [sink], progress=listener.progress)
    accuracy = None
    if verify and finished.outcome == "done" and not finished.asked_to_stop:
        listener.say(f"verifying with {_finer(settings)[1]}", settings.duration)
        accuracy = _estimate(plan, sink.result(), listener)
    seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
    return _close(sink, machine, prepared, finished, accuracy, _finer(settings)[1], resting, seconds)


def _close(
    sink: Memory | Store,
    machine: MachineRecord,
    prepared: Prepared,
    finished: RunOutcome,
    accuracy: Peak | None,
    refinement: str,
    resting: tuple[tuple[Held, ...], tuple[Sticking, ...]],
    timing: dict[str, float],
) -> Result:
    redundancy = prepared.redundancy
    message, advice, at = finished.failure or ("", "", 0.0)
    facts = Facts(
        outcome=finished.outcome,
        degrees_of_freedom=redundancy.degrees_of_freedom,
        modes=len(prepared.motion.system.modes),
        drivers=prepared.drivers,
        redundant_rows=redundancy.redundant_rows,
        non_unique_joints=redundancy.non_unique_joints,
        accuracy=accuracy,
        refinement=refinement,
        failure=message,
        stopped_by=finished.stopped_by,
        neglected=cost(sink.result(), _neglected(machine)),
        small_states=_small_states(sink.result(), prepared, machine),
        guard=_guard(finished, prepared),
        shared=(*shared_loads(sink.result(), resting[0]), *loads_held_together(sink.result(), resting[1])),
    )
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json(finished.events),
        "stopped_by": finished.stopped_by,
        "trust": assess(sink.result(), facts).to_json(),
        "timing": json.dumps({**finished.timing, **timing}),
    }
    result = sink.close(attributes)
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=result)
    return result


def _guard(finished: RunOutcome, prepared: Prepared) -> Guard | None:
    """What the guard of steps over circuits did; None where there is none."""
    if prepared.integrator is not INTEGRATORS[SECANT] or not prepared.motion.system.nodes:
        return None
    timing = finished.timing
    return Guard(int(timing["steps"]), int(timing["guarded"]), timing["pressure_difference"])


def _small_states(result: Result, prepared: Prepared, machine: MachineRecord) -> tuple[SmallState, ...]:
    """The states that stayed far below the scale by which their errors are measured."""
    if not (prepared.integrator.chooses_steps or prepared.integrator.optional_control or prepared.integrator.residual):
        return ()
    out, components = [], {component.name for component in machine.hydraulics}
    for fact in prepared.motion.system.states:
        if fact.integral or fact.name.partition(".")[0] in components:
            continue  # their scales are those of their components
        largest = peak(result, f"state.{fact.name}").value
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


def _finer(settings: RunSettings) -> tuple[RunSettings, str, float]:
    """A finer run with frames at the same times, what is finer in words, and the share of the error that is left in it.

    Where steps are chosen, half the first one would change nothing: errors follow the tolerance.
    """
    if settings.tolerance is not None:
        return replace(settings, tolerance=0.1 * settings.tolerance), "a tenth of the tolerance", 0.1
    halved = replace(settings, step=settings.step / 2, every=2 * settings.every, steps=2 * settings.steps)
    return halved, "half the step", 0.5 ** INTEGRATORS[settings.integrator].order


def _estimate(plan: Plan, coarse: Result, listener: Listener) -> Peak | None:
    """Estimated error of `coarse`, from its largest difference from a finer run; None where that was broken off."""
    finer, _, left = _finer(plan.settings)
    sink = Memory()
    prepared = prepare(plan.methods)
    sink.begin(Header(prepared.motion.system.layout, {}))
    if march(prepared, finer, [sink], progress=listener.progress).asked_to_stop:
        return None
    return error_from_finer(coarse, sink.result(), left)
