"""Lanes: machines that differ in their numbers alone are moved together by each step, one in each lane of the processor's vectors.

Runs of variants in lanes: as many at once as the processor has, where each step is the same code for all of them.
"""

from collections.abc import Sequence
from time import thread_time
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.compilation import build
from nivel.analysis.preparation.memory import Array
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import Loop, LoopOnNumbers
from nivel.analysis.sweep.patched import BUDGET_OF_ALL, PatchedRuns, UnsuitedError
from nivel.integrate.loop.run import BUDGET, FRAMES, STOPPED
from nivel.kernels.core.arrays import NUMBERS, changed
from nivel.kernels.core.status import DONE
from nivel.kernels.record.hook import FAMILIES
from nivel.native.library import missing
from nivel.native.packs import HAS_LANES, lanes_watched, pack_type
from nivel.native.processor import lane_count
from nivel.native.workers import CompilationError
from nivel.results.result import Result

# Machine code for lanes is compiled where single runs of all variants would take so long [s]: about twice what it takes
WORTH_COMPILING: Final = 120.0
# so many variants are tried before lanes are given up where most of them leave
TRIED: Final = 32


Piece = NDArray[np.uint8]


class LaneMemory:
    """A piece of memory for several machines: each of its words in every lane, and whole numbers once for all lanes."""

    def __init__(self, piece: Piece) -> None:
        self._piece, self._words, size = piece, piece.view(np.float64), pack_type().itemsize
        room = np.zeros((len(self._words) + 1) * size, dtype=np.uint8)
        self._packs = room[-room.ctypes.data % size :][: len(self._words) * size].view(pack_type())
        self._lanes = self._packs.view(np.float64).reshape(-1, lane_count())
        self._wholes = piece.copy()

    def on_lanes(self, kind: str, array: NDArray[Any]) -> NDArray[Any] | None:
        """An array of the piece for all machines; None of one that stands elsewhere."""
        first = array.ctypes.data - self._piece.ctypes.data
        if not array.size or not 0 <= first < self._piece.nbytes:
            return None
        if kind in NUMBERS:
            return self._packs[first // 8 : first // 8 + array.size].reshape(array.shape)
        return self._wholes[first : first + array.nbytes].view(array.dtype).reshape(array.shape)

    def take(self, lane: int) -> None:
        """The piece, as it is, into a lane."""
        self._lanes[:, lane] = self._words
        self._wholes[:] = self._piece


class LaneLoop(LoopOnNumbers):
    """The loop of machines in lanes, all of them with the structure of that of `loop`, whose records stand in `pieces`."""

    def __init__(self, loop: Loop, pieces: Sequence[Piece]) -> None:
        self._memories = [LaneMemory(piece) for piece in pieces]

        def on_lanes(kind: str, array: NDArray[Any]) -> NDArray[Any]:
            elsewhere = np.zeros(array.shape, pack_type()) if kind in NUMBERS else array.copy()
            return next((x for each in self._memories if (x := each.on_lanes(kind, array)) is not None), elsewhere)

        machine, run = (changed(each.record, on_lanes) for each in (loop.machine, loop.history))
        laws = [FAMILIES[int(each)].packed.address if each else 0 for each in loop.machine.record.functions.address]
        super().__init__(loop, "packed", machine, run, laws)

    def take(self, lane: int) -> None:
        """The machine and the run that stand in the pieces, into a lane."""
        for each in self._memories:
            each.take(lane)

    def go(self) -> tuple[int, int]:
        """Go on for the budget of steps in the counter of the run. Returns a status, and a bit for each lane that has not left."""
        with lanes_watched() as left:
            return self.advance(), int(left.value)


class LaneRuns:
    """Runs of variants in lanes. loop_seconds : of each of those that ran last. tried, kept : how many of all so far."""

    def __init__(self, runs: PatchedRuns, seconds: float, listener: Listener) -> None:
        """seconds : what single runs of all variants take, by which machine code may be worth compiling. Raises UnsuitedError."""
        if why := unfit(runs):
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
            self._loop.take(lane)
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


def unfit(runs: PatchedRuns) -> str:
    """Why runs cannot go in lanes, in words; empty where they can."""
    if not HAS_LANES:
        return "lanes are for Linux alone"
    prepared, settings, run = runs.blank.prepared, runs.blank.plan.settings, runs.blank.run
    record = prepared.motion.system.record
    if settings.steps == 0:
        return "its steps are chosen"
    if prepared.integrator.kind != "explicit":
        return f"`{settings.integrator}` is not explicit"
    if prepared.path.module != "nivel.motion.relative":
        return "its coordinates are not relative"
    if len(run.ends):
        return "its functions have narrow features"
    if not all(int(each) in FAMILIES for each in record.functions.address if each):
        return "it has laws in Python"
    return ""
