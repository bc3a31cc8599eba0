"""A whole run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from os import PathLike

from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.interrupt import terminable
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.dynamics import RunOutcome, march
from nivel.analysis.run.elements_run import ElementsRun, Found
from nivel.analysis.run.fitting import FasterError, fitted, implicit, refuse_faster
from nivel.analysis.run.preparation import prepare
from nivel.analysis.run.second_run import SecondRun, Verified
from nivel.analysis.trust.checks.accuracy import factor
from nivel.analysis.trust.other_elements import with_elements
from nivel.analysis.trust.report import assess
from nivel.analysis.trust.subject import run_of
from nivel.errors import SolveError
from nivel.integrate.loop.run import ITERATED, MOST_ITERATED, STEPPED
from nivel.integrate.loop.sink import Header
from nivel.results.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.estimate import estimate_errors
from nivel.results.frames.occurrence import to_json
from nivel.results.iterations import ATTRIBUTE as ITERATIONS
from nivel.results.iterations import iterations_in_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store


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
    judge: bool = True,
) -> Result:
    """Run as planned; the result is in memory, or streamed to the file `out`.

    compile_seconds : what was spent on compiling before, for the result's timing.
    verify : a second run goes beside this one, with finer steps on other times, and its distance tells how exact this one is; it goes on
    after it for `verify_limit` [s] at most, by default as long again as it took.
    judge : a trust report is made; without one the result is that of a run of which nobody knows how exact it is.
    A machine that names no integrator, and becomes too fast for the one that it has, begins anew with another.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails, SystemExit where SIGTERM
    came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory(plan.settings.frames + 1) if out is None else Store(out, force)  # a failure adds one
    begin = time.perf_counter()
    listener.say("preparing")
    plan, prepared = fitted(plan, prepare(plan.methods), listener=listener)
    while True:
        second = SecondRun(plan, verify_limit, prepared=prepared.again()) if verify else None
        elements = ElementsRun.beside(second, plan, verify_limit) if second is not None else None
        try:
            with terminable():
                return _run(
                    plan, prepared, sink, second, elements, source, listener, begin, compile_seconds, judge=judge
                )
        except FasterError as faster:
            listener.say(f"beginning anew, because {faster.found.what} became fast")
            sink.discard()
            sink = Memory(plan.settings.frames + 1) if out is None else Store(out, force)
            plan, prepared = implicit(replace(plan, is_open=False), prepared, faster.found, listener=listener)
        finally:
            if second is not None:
                second.cancel()
            if elements is not None:
                elements.run.cancel()


def _run(
    plan: Plan,
    prepared: Prepared,
    sink: Memory | Store,
    second: SecondRun | None,
    elements: ElementsRun | None,
    source: str,
    listener: Listener,
    begin: float,
    compile_seconds: float,
    *,
    judge: bool = True,
) -> Result:
    """The run, with the second one beside it, and one with other elements of its beams."""
    machine, settings = plan.machine, plan.settings
    sink.begin(Header(prepared.motion.system.layout, run_attributes(machine, source, prepared, settings, plan.reason)))
    prepare_seconds = time.perf_counter() - begin
    listener.say("running", settings.duration)
    finished = march(
        prepared, settings, [sink], progress=listener.progress, pacing=second.leader if second is not None else None
    )
    if plan.is_open:
        refuse_faster(plan, prepared, finished)
    verified = None
    if second is not None and finished.outcome == "done" and not finished.asked_to_stop:
        verified = second.wait(listener)
    found = elements.wait(listener) if elements is not None and verified is not None else None
    seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
    return close_run(sink, plan, prepared, finished, verified, seconds, found, judge=judge)


def close_run(
    sink: Memory | Store,
    plan: Plan,
    prepared: Prepared,
    finished: RunOutcome,
    verified: Verified | None,
    timing: dict[str, float],
    found: Found | None = None,
    *,
    judge: bool = True,
) -> Result:
    """Close the sink of a run with its trust report, where it is to be judged, and all that is known of how it ended.

    verified : the second run, or None. found : the run with other elements, or None. timing : seconds besides the loop's.
    Raises SolveError, with the result, where the run failed.
    """
    result, estimate = sink.result(), None
    if verified is not None:
        estimate = estimate_errors(result, verified.result, factor(verified.refinement.left))
    run = replace(run_of(plan, prepared, finished, result), second=verified, estimate=estimate)
    if found is not None:
        run = replace(run, elements=found.compared(result))
    message, advice, at = finished.failure or ("", "", 0.0)
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json(finished.events),
        "stopped_by": finished.stopped_by,
        "timing": json.dumps({**finished.timing, **timing}),
    }
    if finished.pace is not None:
        steps, total, most = finished.pace[[STEPPED, ITERATED, MOST_ITERATED]]
        if iterated := iterations_in_json(steps, total, most, plan.settings.duration):
            attributes[ITERATIONS] = iterated
    if judge:
        attributes["trust"] = assess(run).to_json()
    if estimate is not None and run.elements is not None and run.elements.errors is not None:
        estimate = with_elements(estimate, run.elements.errors)
    if estimate is not None:
        attributes[ESTIMATES] = estimate.to_json()
    closed = sink.close(attributes)
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=closed)
    return closed
