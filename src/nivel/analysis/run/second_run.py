"""A second run beside the first, in a thread of its own, with finer steps that fall on other times: what they are apart by is the error."""

from __future__ import annotations

import threading
import time as clock_of_python
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import ceil

from nivel.analysis.plan.plan import Plan
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.progress.interrupt import interruptible
from nivel.analysis.progress.listener import Listener
from nivel.analysis.progress.pacing import Follower, Leader
from nivel.analysis.run.dynamics import RunOutcome, march
from nivel.analysis.run.preparation import prepare
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop.sink import Header
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.wording import seconds

# Steps of fixed size are this much shorter in the second run: about 5/3, where one in three steps of the first ends with one of it.
FINER, LEAST_STEPS = 1.6, 3
# of the tolerance, where steps are chosen
TENTH = 0.1
# A second run may go on after the first one for as long as that took, and at least for so long [s].
LEAST_LIMIT = 10.0
# [s] between two looks at a run that is waited for
LOOK = 0.02


@dataclass(frozen=True)
class Refinement:
    """What a second run does otherwise.

    settings : its own, with frames at times of those of the first run. words : what it is. left : the share of the error of the first run
    that it still has.
    """

    settings: RunSettings
    words: str
    left: float


@dataclass(frozen=True)
class Verified:
    """A second run as far as it came. until : its last frame [s]. ended : why it came to no end; empty where it did."""

    result: Result
    refinement: Refinement
    until: float
    ended: str


def refine(settings: RunSettings, *, sampled: bool = False) -> Refinement:
    """How a second run is to differ from one with these settings. sampled : states change at given times, which steps have to meet.

    Half the step would look at loads where the first run does. Steps of three fifths meet the first run's in one of three, where frames
    can be compared, and what repeats itself within a step of the first run does not within one of these.
    """
    if settings.tolerance is not None:
        # the step still says how fast stiction stops a joint
        finer = replace(settings, tolerance=TENTH * settings.tolerance, step=0.5 * settings.step)
        return Refinement(finer, f"a tolerance of {finer.tolerance:.3g} and other, irregular steps", TENTH)
    frames = ceil(LEAST_STEPS / settings.every)
    coarse = frames * settings.every
    fine = 2 * coarse if sampled else ceil(FINER * coarse)
    step = settings.step * coarse / fine
    steps = max(1, ceil(settings.duration / step * (1.0 - 1e-12)))
    finer = replace(settings, step=step, every=fine, steps=steps, output_interval=fine * step)
    return Refinement(finer, f"steps of {seconds(step)}", (coarse / fine) ** INTEGRATORS[settings.integrator].order)


class SecondRun:
    """A second run of a plan in a thread; it waits for the first one to begin.

    limit [s] : how long it may go on after the first; None: as long as that took, and at least LEAST_LIMIT.
    """

    def __init__(self, plan: Plan, limit: float | None) -> None:
        self.refinement = refine(plan.settings, sampled=any(state.every for state in plan.machine.states))
        self.leader = Leader()
        self._plan, self._limit = plan, limit
        self._sink = Memory()
        self._finished: RunOutcome | None = None
        self._fault: Exception | None = None
        self._stopped = threading.Event()
        self._reached = 0.0
        self._begin = clock_of_python.perf_counter()
        self._thread = threading.Thread(target=self._run, name="second run", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        self.leader.begun.wait()
        if self._stopped.is_set():
            return
        try:
            settings = self.refinement.settings
            prepared = prepare(self._plan.methods)
            self._sink.begin(Header(prepared.motion.system.layout, {}))
            chosen = settings.steps == 0
            follower = Follower(self.leader if chosen else None, settings.duration, self._stopped.is_set)
            self._finished = march(prepared, settings, [self._sink], progress=self._reach, pacing=follower)
        except Exception as fault:  # raised where the run is waited for
            self._fault = fault

    def _reach(self, time: float) -> None:
        self._reached = time

    def cancel(self) -> None:
        """End it; nothing is asked of it any more."""
        self._stopped.set()
        self.leader.end()
        self._thread.join()

    def wait(self, listener: Listener) -> Verified | None:
        """What it found, when it is over, its time is spent or Ctrl-C came. None where it has no frame."""
        self.leader.end()
        spent = clock_of_python.perf_counter() - self._begin
        limit = max(LEAST_LIMIT, spent) if self._limit is None else self._limit
        listener.say(f"verifying with {self.refinement.words}", self.refinement.settings.duration)
        ended = self._watch(limit, listener.progress)
        self._stopped.set()
        self._thread.join()
        if self._fault is not None:
            raise self._fault
        finished = self._finished
        if finished is None:
            return None
        if finished.outcome == "failed" and finished.failure is not None:
            ended = f"the second run {finished.failure[0]}"
        result = self._sink.result()
        if not len(result.time):
            return None
        return Verified(result, self.refinement, float(result.time[-1]), "" if finished.outcome == "done" else ended)

    def _watch(self, limit: float, progress: Callable[[float], None] | None) -> str:
        """Wait for the thread; why it has to end before its time, where it has to."""
        begin = clock_of_python.perf_counter()
        with interruptible() as interrupted:
            while self._thread.is_alive():
                self._thread.join(LOOK)
                if progress is not None:
                    progress(self._reached)
                if interrupted():
                    return "verification was interrupted"
                if clock_of_python.perf_counter() - begin > limit:
                    return f"the time for verification was spent ({limit:.3g} s after the run)"
        return ""
