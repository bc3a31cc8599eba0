"""Motion in time: advance in chunks, feed the sinks, say how it ended."""

from __future__ import annotations

import time as clock_of_python
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from types import ModuleType

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.analysis.history import start_history
from nivel.analysis.interrupt import interruptible
from nivel.analysis.listener import Progress
from nivel.analysis.lockup import Jam, can_be_asked, find_jam
from nivel.analysis.outcome import failure
from nivel.analysis.penalties import feedback
from nivel.analysis.preparation import Prepared
from nivel.analysis.settings import RunSettings
from nivel.integrate.loop import advance
from nivel.integrate.run import (
    ACCEPTED,
    BUDGET,
    CONSERVE,
    DONE_STEPS,
    EVALUATIONS,
    EVENTS,
    FACTORISATIONS,
    FRAMES,
    ITERATIONS,
    OPEN_LIMIT,
    REJECTED,
    SHOWN,
    STEP,
    STOPPED,
    TIME,
    UNCONSERVED,
    Run,
)
from nivel.integrate.sink import Sink
from nivel.integrate.stabilise.catalogue import STABILISATIONS
from nivel.kernels.handle import Handle
from nivel.kernels.observe import observe
from nivel.kernels.status import (
    BUDGET_SPENT,
    BUFFER_FULL,
    CONTRADICTION,
    DONE,
    MULTIPLIERS_NOT_FOUND,
    NOT_CLOSED,
    NOT_CONVERGED,
    NOT_FINITE,
    OPEN,
    SINGULAR,
    STEP_TOO_SMALL,
)
from nivel.results.occurrence import Occurrence
from nivel.system.system import System

# A chunk of the loop lasts about this long [s]; between chunks frames are written and Ctrl-C is looked at.
CHUNK = 0.05
GOES_ON = (BUDGET_SPENT, BUFFER_FULL)
# What a method may end with near a position that its machine cannot pass.
BEFORE_A_JAM = (SINGULAR, NOT_CLOSED, OPEN, NOT_CONVERGED, NOT_FINITE, STEP_TOO_SMALL, MULTIPLIERS_NOT_FOUND)


@dataclass
class RunOutcome:
    """How a run ended. outcome: done, interrupted or failed; failure: (message, advice, time [s]).

    events : in the order of time. stopped_by : name of the event that ended the run. asked_to_stop : Ctrl-C came; also while the last
    steps were made, so that the run itself is done.
    """

    outcome: str
    events: list[Occurrence] = field(default_factory=list)
    stopped_by: str = ""
    asked_to_stop: bool = False
    timing: dict[str, float] = field(default_factory=dict)
    failure: tuple[str, str, float] | None = None


def march(
    prepared: Prepared,
    settings: RunSettings,
    sinks: Sequence[Sink],
    *,
    progress: Progress | None = None,
    chunk_steps: int | None = None,
) -> RunOutcome:
    """Run `prepared` and give every frame to all `sinks` (already begun).

    progress : called with the time reached [s] after every chunk. chunk_steps : steps a chunk, instead of as many as fit into 50 ms;
    the result does not depend on it.
    """
    system, stabilisation = prepared.motion.system, STABILISATIONS[settings.stabilisation]
    _feed_back(system, settings, stabilisation)
    run = start_history(prepared, settings, prepared.integrator)
    run.counter[CONSERVE] = int(stabilisation.CONSERVES)
    advance = _compiled_loop(prepared, run, stabilisation)
    finished = RunOutcome("done")
    wall = clock_of_python.perf_counter()
    status, loop_seconds, jam = BUDGET_SPENT, 0.0, None
    while status in GOES_ON and finished.outcome == "done":
        status, spent = _march_in_chunks(advance, system, run, sinks, finished, progress, chunk_steps)
        loop_seconds += spent
        if status in BEFORE_A_JAM:
            jam = _jam(prepared, settings, run)
        if status == OPEN and jam is None and can_be_asked(prepared):
            _accept_open(prepared.motion, run)
            status = BUDGET_SPENT
    if run.counter[STOPPED]:
        finished.stopped_by = system.events[run.counter[STOPPED] - 1]
    if status not in (*GOES_ON, DONE):
        finished.outcome = "failed"
        finished.failure = _failure(prepared, settings, run, status, jam)
        if status != CONTRADICTION:
            _keep_last(prepared.motion, run, sinks)
    finished.timing = {
        **_counts(system, run),
        "loop_seconds": loop_seconds,
        "wall_seconds": clock_of_python.perf_counter() - wall,
    }
    return finished


def _feed_back(system: System, settings: RunSettings, stabilisation: ModuleType) -> None:
    """Set what the stabilisation, or a penalty method, adds to the accelerations of the constraints, and what it leaves open."""
    stabilise = system.record.control.stabilise
    stabilise[:] = stabilisation.coefficients(settings.step, *(settings.baumgarte or (None, None)))
    if settings.penalty is not None:
        stabilise[:2] = feedback(settings.penalty, settings.step, stabilisation.CORRECTS)


def _compiled_loop(prepared: Prepared, run: Run, stabilisation: ModuleType) -> Callable[[], int]:
    """The compiled loop of the run: goes on for the budget of steps in its counter, and returns a status."""
    kernels, facts = prepared.motion.kernels, prepared.integrator
    correct = import_module(prepared.path.correction).correct if stabilisation.CORRECTS else kernels.normalise_state
    step = getattr(import_module(facts.module), facts.function)
    machine, history = prepared.motion.handle, Handle(run)
    evaluate, correct, step = kernels.evaluate.address, correct.address, step.address
    return lambda: advance(evaluate, correct, step, machine.address, history.address)


def _march_in_chunks(
    advance: Callable[[], int],
    system: System,
    run: Run,
    sinks: Sequence[Sink],
    finished: RunOutcome,
    progress: Progress | None,
    chunk_steps: int | None,
) -> tuple[int, float]:
    """The last status, and the time [s] spent in the compiled loop. Events, and an interruption, are noted in `finished`."""
    budget, loop_seconds, status = chunk_steps or 1, 0.0, BUDGET_SPENT
    with interruptible() as interrupted:
        while status in GOES_ON:
            run.counter[BUDGET] = budget
            begin = clock_of_python.process_time()
            status = advance()
            spent = clock_of_python.process_time() - begin
            loop_seconds += spent
            _give(run, sinks)
            finished.events += _taken_events(run, system.events)
            if progress is not None:
                progress(float(run.clock[TIME]))
            if chunk_steps is None and status == BUDGET_SPENT:
                budget = _next_budget(budget, spent)
            if status in GOES_ON and interrupted():
                finished.outcome = "interrupted"
                break
        finished.asked_to_stop = interrupted()
    return status, loop_seconds


def _next_budget(budget: int, spent: float) -> int:
    """Steps of the next chunk, after one of `budget` steps took `spent` [s]: as many as last for CHUNK, at most twice as many."""
    if spent < CHUNK:
        return max(1, min(2 * budget, int(budget * CHUNK / max(spent, 1e-9))))
    return max(1, budget // 2)


def _jam(prepared: Prepared, settings: RunSettings, run: Run) -> Jam | None:
    """The jam in or beside the step after the last accepted state."""
    time = float(run.clock[ACCEPTED])
    step = max(float(run.clock[STEP]), float(run.clock[TIME]) - time)
    return find_jam(prepared, time, step, settings.step, settings.duration, run.previous)


def _accept_open(motion: MotionEquations, run: Run) -> None:
    """Let the run go on with joints that are open, as they can be closed: they have drifted. Looked at again when that has doubled."""
    motion.evaluate(float(run.clock[TIME]), run.y)
    constraints = motion.system.record.constraints
    share = float(np.max(np.abs(constraints.C) / constraints.scale))
    run.clock[OPEN_LIMIT] = 2.0 * max(share, run.clock[OPEN_LIMIT]) if np.isfinite(share) else np.inf


def _failure(
    prepared: Prepared, settings: RunSettings, run: Run, status: int, jam: Jam | None
) -> tuple[str, str, float]:
    """(message, advice, time [s]) of a run that failed."""
    facts, time = prepared.integrator, float(run.clock[ACCEPTED])
    if jam is not None:
        return f"stopped at t = {time:.6g} s: {jam.message}", jam.advice, time
    explicit = settings.steps > 0 and not (facts.implicit or facts.residual)
    message, advice = failure(
        prepared.motion,
        status,
        time,
        float(run.clock[STEP]),
        run.previous,
        chosen_by=settings.integrator if settings.steps == 0 else "",
        beams=prepared.beams if explicit else (),
    )
    return message, advice, time


def _counts(system: System, run: Run) -> dict[str, float]:
    """What the run did how often; of partitions, how often independent coordinates were chosen anew."""
    return {
        "steps": int(run.counter[DONE_STEPS]),
        "evaluations": int(run.counter[EVALUATIONS]),
        "iterations": int(run.counter[ITERATIONS]) + int(system.record.control.iterations[1]),
        "factorisations": int(run.counter[FACTORISATIONS]),
        "rejected": int(run.counter[REJECTED]),
        "unconserved": int(run.counter[UNCONSERVED]),
        "guarded": int(system.record.circuit.guard[0]),
        "pressure_difference": float(system.record.circuit.guard[1]),
        "partitions": max(0, int(system.record.partition.choices.sum()) - 1),
    }


def _keep_last(motion: MotionEquations, run: Run, sinks: Sequence[Sink]) -> None:
    """Give the last accepted state before a failure, where it lies after the last frame and its accelerations are numbers."""
    t, feedback = float(run.clock[ACCEPTED]), motion.system.record.control.stabilise[:2]
    if not t > run.clock[SHOWN] or not np.isfinite(run.previous).all():
        return
    kept = feedback.copy()
    # as in all frames, accelerations are those without Baumgarte's feedback
    feedback[:] = 0.0
    if motion.holds(t, run.previous):
        frame = np.zeros((1, motion.system.layout.width))
        frame[0, 0] = t
        observe(motion.handle.address, t, run.previous, frame[0])
        if np.isfinite(frame).all():
            for sink in sinks:
                sink.take(frame)
    feedback[:] = kept


def _give(run: Run, sinks: Sequence[Sink]) -> None:
    filled = int(run.counter[FRAMES])
    if filled:
        for sink in sinks:
            sink.take(run.frames[:filled])
        run.counter[FRAMES] = 0


def _taken_events(run: Run, names: tuple[str, ...]) -> list[Occurrence]:
    """Events of the buffer, which is empty then."""
    filled = int(run.counter[EVENTS])
    run.counter[EVENTS] = 0
    return [
        Occurrence(names[int(number)], float(time), "rising" if direction > 0.0 else "falling")
        for time, number, direction in run.events[:filled]
    ]
