"""Runs of variants in lanes: as many at once as the processor has, where each step is the same code for all of them."""

from collections.abc import Sequence
from time import thread_time
from typing import Final

import numpy as np

from nivel.analysis.plan.compilation import build
from nivel.analysis.preparation.memory import Array
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.lanes import LaneLoop, unfit
from nivel.analysis.sweep.patched import BUDGET_OF_ALL, PatchedRuns, UnsuitedError
from nivel.integrate.loop.run import BUDGET, FRAMES, STOPPED
from nivel.kernels.core.status import DONE
from nivel.native.library import missing
from nivel.native.processor import lane_count
from nivel.native.workers import CompilationError
from nivel.results.result import Result

# Machine code for lanes is compiled where single runs of all variants would take so long [s]: about twice what it takes
WORTH_COMPILING: Final = 120.0
# so many variants are tried before lanes are given up where most of them leave
TRIED: Final = 32


class LaneRuns:
    """Runs of variants in lanes. loop_seconds : of each of those that ran last. tried, kept : how many of all so far."""

    def __init__(self, runs: PatchedRuns, seconds: float, listener: Listener) -> None:
        """seconds : what single runs of all variants take, by which machine code may be worth compiling. Raises UnsuitedError."""
        blank = runs.blank
        if why := unfit(blank.prepared, blank.plan.settings, blank.run):
            raise UnsuitedError(why)
        entries = runs.blank.loop.entries_on("packed")
        if seconds < WORTH_COMPILING and missing(entries):
            raise UnsuitedError("so few or short runs are not worth compiling its machine code for lanes")
        try:
            build(entries, listener)
        except CompilationError as problem:
            raise UnsuitedError(f"there is no machine code for lanes: {problem}") from None
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
        run.counter[BUDGET] = BUDGET_OF_ALL
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
