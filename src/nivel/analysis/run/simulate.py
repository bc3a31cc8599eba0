"""A whole run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from os import PathLike

from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes, settings_in_json
from nivel.analysis.progress.log import Listener, Progress
from nivel.analysis.progress.pacing import terminable
from nivel.analysis.run.attempt import Options, attempt, header_of
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.preparation import prepare
from nivel.analysis.run.second_choice import second_choice
from nivel.errors import SolveError
from nivel.integrate.loop.run import ITERATED, MOST_ITERATED, STEPPED
from nivel.integrate.loop.sink import Header
from nivel.judge.after.other_elements import with_elements
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Run, run_of
from nivel.results.curve import PROBED
from nivel.results.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.frames.summary import ATTRIBUTE as ITERATIONS
from nivel.results.frames.summary import iterations_in_json, to_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.results.trust import Trust


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
    after it for `verify_limit` [s] at most, by default for three times the work of the first.
    judge : a trust report is made; without one the result is that of a run of which nobody knows how exact it is.
    A machine that names no integrator has a second choice where the first one fails, or its trust report is not green for what other steps
    can cure: `nivel.analysis.run.second_choice`.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails, SystemExit where SIGTERM
    came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory(plan.settings.frames + 1) if out is None else Store(out, force)  # a failure adds one
    begin = time.perf_counter()
    listener.say("preparing")
    prepared = prepare(plan.methods)
    prepare_seconds = time.perf_counter() - begin
    options = Options(source, verify, verify_limit, listener)
    with terminable():
        first = attempt(plan, sink, options, prepared)
        best, trust = second_choice(first, options, judge=judge)
        if best is not first:
            sink.discard()
            sink = Memory(best.plan.settings.frames + 1) if out is None else Store(out, force)
            sink.begin(header_of(best.plan, best.prepared, source))
            sink.take(best.frames)
        seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
        return close_run(sink, best.run, seconds, judge=judge, trust=trust)


def close_run(
    sink: Memory | Store,
    run: Run,
    timing: dict[str, float],
    *,
    judge: bool = True,
    trust: Trust | None = None,
) -> Result:
    """Close the sink of a run with its trust report, where it is to be judged, and all that is known of how it ended.

    timing : seconds besides the loop's. trust : the report, where it is made already.
    Raises SolveError, with the result, where the run failed.
    """
    plan, finished, estimate = run.plan, run.finished, run.estimate
    message, advice, at = finished.failure or ("", "", 0.0)
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json(finished.events),
        "stopped_by": finished.stopped_by,
        "timing": json.dumps({**finished.timing, **timing}),
        PROBED: json.dumps(finished.between_frames),
    }
    if finished.pace is not None:
        steps, total, most = finished.pace[[STEPPED, ITERATED, MOST_ITERATED]]
        if iterated := iterations_in_json(steps, total, most, plan.settings.duration):
            attributes[ITERATIONS] = iterated
    if finished.went_on is not None:
        attributes["settings"] = settings_in_json(plan.settings, plan.reason, finished.went_on)
    if judge:
        attributes["trust"] = (trust or assess(run)).to_json()
    if estimate is not None and run.elements is not None and run.elements.errors is not None:
        estimate = with_elements(estimate, run.elements.errors)
    if estimate is not None:
        attributes[ESTIMATES] = estimate.to_json()
    closed = sink.close(attributes)
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=closed)
    return closed


def run_in_memory(plan: Plan, progress: Progress | None = None) -> Run:
    """Prepare and run; what its trust report would look at.

    The result holds the frames and what is known before the first of them, no trust report. Raises ModelError before anything is
    computed, KeyboardInterrupt where Ctrl-C came.
    """
    sink = Memory()
    prepared = prepare(plan.methods)
    sink.begin(Header(prepared.motion.system.layout, run_attributes(plan.machine, "", prepared, plan.settings)))
    finished = march(prepared, plan.settings, [sink], progress=progress)
    if finished.asked_to_stop:
        raise KeyboardInterrupt
    return run_of(plan, prepared, finished, sink.result())
