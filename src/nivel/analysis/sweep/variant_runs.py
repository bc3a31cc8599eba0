"""Runs of variants without trust reports: patched where their numbers follow from the parameters by formulas, else each prepared; in lanes,
as many at once as the processor has, where each step is the same code for all of them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import nan
from time import thread_time
from typing import Any, Final

import numpy as np

from nivel.analysis.plan.compilation import build
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.preparation.memory import Array
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.attempt import header_of
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.lanes import LaneLoop, unfit
from nivel.analysis.run.simulate import close_run, simulate
from nivel.analysis.sweep import patched
from nivel.analysis.sweep.outputs import Found
from nivel.errors import ModelError, NivelError, SolveError, refuse
from nivel.integrate.loop.run import BUDGET, FRAMES, STOPPED
from nivel.judge.after.subject import run_of
from nivel.judge.before.refusals import deep_starts
from nivel.kernels.core.status import DONE
from nivel.lazy import Struct, replace
from nivel.model import Model
from nivel.native.library import missing
from nivel.native.processor import lane_count
from nivel.native.workers import CompilationError
from nivel.results.memory import Memory
from nivel.results.result import Result

# Machine code for lanes is compiled where single runs of all variants would take so long [s]: about twice what it takes
WORTH_COMPILING: Final = 120.0
# so many variants are tried before lanes are given up where most of them leave
TRIED: Final = 32


class LaneRuns:
    """Runs of variants in lanes. loop_seconds : of each of those that ran last. tried, kept : how many of all so far."""

    def __init__(self, runs: patched.PatchedRuns, seconds: float, listener: Listener) -> None:
        """seconds : what single runs of all variants take, by which machine code may be worth compiling. Raises UnsuitedError."""
        blank = runs.blank
        if why := unfit(blank.prepared, blank.plan.settings, blank.run):
            raise patched.UnsuitedError(why)
        entries = runs.blank.loop.entries_on("packed")
        if seconds < WORTH_COMPILING and missing(entries):
            raise patched.UnsuitedError("so few or short runs are not worth compiling its machine code for lanes")
        try:
            build(entries, listener)
        except CompilationError as problem:
            raise patched.UnsuitedError(f"there is no machine code for lanes: {problem}") from None
        self._runs, self._loop = runs, LaneLoop(runs.blank.loop, runs.blank.pieces)
        self.loop_seconds, self.tried, self.kept = 0.0, 0, 0

    @property
    def serves(self) -> bool:
        """Whether most variants so far stayed in their lanes."""
        return self.tried < TRIED or 2 * self.kept > self.tried

    def run(self, xs: Sequence[Array]) -> list[Result | None]:
        """Results of the variants with parameters `xs`, no more than there are lanes; None of those that have to be run singly: what their
        lane did means nothing."""
        found: list[Result | None] = [None] * len(xs)
        inside = [k for k, x in enumerate(xs) if self._runs.found.has(x)]
        self.tried += len(xs)
        if not inside:
            return found
        for lane in range(lane_count()):
            if lane < len(inside):
                self._runs.begin(xs[inside[lane]])
            self._loop.memory.take(lane, self._runs.blank.pieces)
        run, begin = self._loop.run, thread_time()
        run.counter[BUDGET] = patched.BUDGET_OF_ALL
        status, left = self._loop.go()
        self.loop_seconds = (thread_time() - begin) / len(inside)
        frames = run.frames[: run.counter[FRAMES]].view(np.float64).reshape(-1, run.frames.shape[1], lane_count())
        for lane, k in enumerate(inside if status == DONE and not run.counter[STOPPED] else ()):
            if left >> lane & 1:
                own = np.ascontiguousarray(frames[..., lane])
                if self._runs.shares:
                    self._runs.begin(xs[k])
                    self._runs.share(own)
                found[k] = self._runs.result(own)
                self.kept += 1
        return found


Values = Mapping[str, Any]

TIMED_OUT: Final = "timed out"


class Ran(Struct):
    """A variant, computed. outcome, reason : as of a `VariantRun`. loop_seconds : in the compiled loop.

    result : what was computed, of the kind that the analysis has, valid until the next of the same `VariantRuns`; None where nothing was.
    in_lanes : together with others. end_time [s] : where it failed without a result.
    """

    outcome: str
    reason: str = ""
    result: Any = None
    loop_seconds: float = 0.0
    in_lanes: bool = False
    end_time: float = nan


def tried(compute: Callable[[], Found]) -> Ran:
    """What is computed, with its faults and failures, which are not raised."""
    try:
        found = compute()
    except SolveError as error:
        result = error.result if isinstance(error.result, Result) else None
        return Ran("failed", str(error), result, end_time=error.time)
    except ModelError as error:
        return Ran("refused", str(error))
    except NivelError as error:
        return Ran("failed", str(error))
    if not isinstance(found, Result):
        return Ran("done", "", found)
    if found.outcome == "interrupted":
        return Ran("not run")
    outcome, reason = ("stopped", f"event {found.stopped_by}") if found.stopped_by else ("done", "")
    return Ran(outcome, reason, found, float(found.timing.get("loop_seconds", 0.0)))


class VariantRuns:
    """Runs variants of a machine: patched where formulas are known, else each prepared. Every thread needs its own.

    not_in_lanes : why they are run singly, in words.
    time_limit [s] : of the processor time of each; what takes longer is `timed out`.
    """

    def __init__(self, base: Model, patches: patched.Patches | None = None, time_limit: float | None = None) -> None:
        self._base, self._limit = base, time_limit
        self._patched = None if patches is None else patched.PatchedRuns(patches)
        self._lanes: LaneRuns | None = None
        self.not_in_lanes = "each is prepared" if patches is None else "there is a time limit"

    def look_for_lanes(self, seconds: float, listener: Listener) -> None:
        """Use lanes from now on, where they can be. seconds : what single runs of all variants take."""
        if self._patched is None or self._limit is not None or self._lanes is not None:
            return
        try:
            self._lanes, self.not_in_lanes = LaneRuns(self._patched, seconds, listener), ""
        except patched.UnsuitedError as problem:
            self.not_in_lanes = str(problem)

    def run_all(self, rows: Sequence[Values]) -> Iterator[Ran]:
        """Variants with these values, no more than there are lanes, one after the other as of `run`."""
        self.look_for_lanes(0.0, Listener())  # there may be machine code now
        if self._lanes is None or not self._lanes.serves or len(rows) == 1:
            yield from map(self.run, rows)
            return
        for row, result in zip(rows, self._lanes.run([patched.read_values(row) for row in rows]), strict=True):
            done = None if result is None else Ran("done", "", result, self._lanes.loop_seconds, in_lanes=True)
            yield done or self.run(row)

    def run(self, values: Values) -> Ran:
        """The machine with these values, run by its own settings, without a second run and a trust report."""
        try:
            return self._run(values)
        except patched.TooLongError as late:
            return Ran(TIMED_OUT, str(late))

    def _run(self, values: Values) -> Ran:
        """Raises TooLongError."""
        if self._patched is not None:
            frames = self._patched.run(patched.read_values(values), self._limit)
            if frames is not None:
                event = self._patched.stopped_by
                outcome, reason = ("stopped", f"event {event}") if event else ("done", "")
                return Ran(outcome, reason, self._patched.result(frames), self._patched.loop_seconds)
        return tried(lambda: self._prepared(values))

    def _prepared(self, values: Values) -> Result:
        watched = None if self._limit is None else Listener(progress=patched.watch(self._limit))
        machine = self._base.with_values(values) if values else self._base
        plan = plan_run(machine.record, machine.origin.settings_outside)
        return simulate(plan, judge=False, listener=watched)


class AnalysedVariants:
    """Variants of a machine, each by an analysis other than a run, without estimates by other elements of beams. settings : of it."""

    def __init__(self, base: Model, analysis: str, settings: Mapping[str, Any]) -> None:
        self._base = base
        self._analysis = analysis
        self._settings = {**({"verify": False} if analysis in ("statics", "linearise") else {}), **settings}

    def run(self, values: Values) -> Ran:
        """The machine with these values."""
        ran = tried(lambda: analysed(self._base.with_values(values), self._analysis, self._settings))
        return replace(ran, reason=ran.reason or getattr(ran.result, "no_modes", ""))


def analysed(machine: Model, analysis: str, settings: Mapping[str, Any]) -> Any:
    """What an analysis of `nivel.Machine` other than a run computes. Raises NivelError."""
    return getattr(machine, analysis)(**settings)


def formulas_for(base: Model, rows: Sequence[Values], *, judged: bool = False) -> tuple[patched.Patches | None, str]:
    """Formulas for these variants, or why there are none, in words. judged : as of `learn`."""
    try:
        patches = patched.learn(base, rows, judged=judged)
        patched.PatchedRuns(patches)
    except patched.UnsuitedError as problem:
        return None, str(problem)
    return patches, ""


class JudgedRuns:
    """Runs of variants in memory of their own, one after the other. What is no number of the memory is the same in all of them."""

    def __init__(self, found: patched.Patches) -> None:
        """Raises UnsuitedError where the memory cannot be copied."""
        self._runs = patched.PatchedRuns(found)

    def run(self, machine: Model, values: Mapping[str, Any]) -> Result | None:
        """The run of the machine, which has these values, with its trust report; None where it has to be prepared: it needs another method
        or has another structure, or did not come to its end as it should. Raises ModelError as preparing does."""
        found, blank = self._runs.found, self._runs.blank
        plan, x = plan_run(machine.record, machine.origin.settings_outside), patched.read_values(values)
        if not found.has(x):
            return None
        self._runs.begin(x)
        methods = plan.methods
        prepared = replace(blank.prepared, machine=methods.machine, beams=methods.machine.beams)
        refuse(deep_starts(methods.machine, prepared.absolute, prepared.assembly.y))
        if plan.settings != blank.plan.settings:
            return None
        self._runs.begin(x)
        sink = Memory(plan.settings.frames + 1)
        sink.begin(header_of(plan, prepared, ""))
        finished = march(prepared, plan.settings, [sink], loop=blank.loop)
        if finished.outcome == "failed":
            return None
        return close_run(sink, run_of(plan, prepared, finished, sink.result()), {})
