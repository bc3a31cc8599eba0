"""Lanes: machines that differ in their numbers alone are moved together by each step, one in each lane of the processor's vectors.

Copies that are stepped from Python stay in their lanes between calls. A copy whose lane cannot do a call, as an event ends it or its
contact begins in another step than those of the others, does that call singly, from where it was; after some more it is taken in again.
"""

from collections.abc import Iterable, Mapping, Sequence
from ctypes import c_uint64
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.memory import Role, arrays_of, leaves
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import Loop, LoopOnNumbers, occurrences, on_numbers
from nivel.analysis.run.prepared_state import BoundEntry
from nivel.analysis.run.stepping import Simulation
from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import Run
from nivel.kernels.core.arrays import NUMBERS, changed
from nivel.kernels.core.status import BUDGET_SPENT, OK
from nivel.kernels.output.observe import observe
from nivel.kernels.record.function import CONSTANT
from nivel.kernels.record.hook import FAMILIES
from nivel.native.packs import HAS_LANES, LanesWatched, pack_type
from nivel.native.processor import lane_count

Piece = NDArray[np.uint8]
Inputs = Mapping[str, NDArray[np.float64]]
# a step in lanes takes about as long as two single ones
FEWEST: Final = 2
# calls that a copy does singly after its lane could not do one: twice as many every time, this many at most
LONGEST_WAIT: Final = 1024
# what a run remembers between two calls beside its state; where the values of inputs stand
OF_RUN: Final = ("rate", "event_values")
OF_INPUTS: Final = ("functions.kind", "functions.value")
# counters that copies in lanes share, though they were at other steps, and that say nothing of what comes
COUNTS: Final = [
    of_run.DONE_STEPS, of_run.FRAMES, of_run.LAST_FRAME, of_run.BUDGET, of_run.EVALUATIONS, of_run.ITERATIONS, of_run.RESTART,
    of_run.UNCONSERVED, of_run.COUNTED, of_run.DENSE, of_run.POWERS,
]  # fmt: skip


class LaneMemory:
    """Pieces of memory, behind each other, for several machines: each word in every lane, and whole numbers once for all lanes.

    lanes : (words, lanes) numbers. wholes : (words,) what stands in the words that are no numbers.
    """

    def __init__(self, pieces: Sequence[Piece]) -> None:
        sizes, size = [len(piece) // 8 for piece in pieces], pack_type().itemsize
        firsts = np.cumsum([0, *sizes[:-1]]).tolist()
        self._pieces = [(each.ctypes.data, each.nbytes, first) for each, first in zip(pieces, firsts, strict=True)]
        room = np.zeros((sum(sizes) + 1) * size, dtype=np.uint8)
        self._packs = room[-room.ctypes.data % size :][: sum(sizes) * size].view(pack_type())
        self.lanes = self._packs.view(np.float64).reshape(-1, lane_count())
        self.wholes = words_of(pieces)

    def place(self, array: NDArray[Any]) -> int | None:
        """The first word of an array; None of one that is empty or stands elsewhere."""
        at = array.ctypes.data if array.size else -1
        return next(((at - start) // 8 + n for start, size, n in self._pieces if 0 <= at - start < size), None)

    def on_lanes(self, kind: str, array: NDArray[Any]) -> NDArray[Any]:
        """An array for all machines; what stands elsewhere begins with zeros."""
        first = self.place(array)
        if first is None:
            return np.zeros(array.shape, pack_type()) if kind in NUMBERS else array.copy()
        if kind in NUMBERS:
            return self._packs[first : first + array.size].reshape(array.shape)
        return self.wholes.view(np.uint8)[8 * first :][: array.nbytes].view(array.dtype).reshape(array.shape)

    def take(self, lane: int, pieces: Sequence[Piece], *, wholes: bool = True) -> None:
        """The machine and the run that stand in the pieces, into a lane; with the whole numbers of all lanes."""
        words = words_of(pieces)
        self.lanes[:, lane] = words.view(np.float64)
        if wholes:
            self.wholes[:] = words

    def words(self, arrays: Iterable[NDArray[Any]]) -> NDArray[np.intp]:
        """Where arrays stand, but those that do elsewhere."""
        known = (first + np.arange(-(-x.nbytes // 8)) for x in arrays if (first := self.place(x)) is not None)
        return np.concatenate([np.zeros(0, np.intp), *known])


def words_of(pieces: Sequence[Piece]) -> NDArray[np.int64]:
    """Pieces of memory behind each other."""
    return np.concatenate([each.view(np.int64) for each in pieces])


class LaneLoop(LoopOnNumbers):
    """The loop of machines in lanes, all of them with the structure of that of `loop`, whose records stand in `pieces`."""

    def __init__(self, loop: Loop, pieces: Sequence[Piece]) -> None:
        self.memory = LaneMemory(pieces)
        machine, run = (changed(each.record, self.memory.on_lanes) for each in (loop.machine, loop.history))
        used = loop.machine.record
        laws = [FAMILIES[int(each)].packed.address if each else 0 for each in used.functions.address]
        super().__init__(loop, "packed", on_numbers(used, "packed", machine, laws), run)

    def go(self) -> tuple[int, int]:
        """Go on for the budget of steps in the counter of the run. Returns a status, and a bit for each lane that has not left."""
        with LanesWatched() as left:
            return self.advance(), int(left.value)


def unfit(prepared: Prepared, settings: RunSettings, run: Run) -> str:
    """Why a machine cannot go in lanes, in words; empty where it can."""
    if not HAS_LANES:
        return "lanes are for Linux alone"
    if settings.steps == 0:
        return "its steps are chosen"
    if prepared.integrator.kind != "explicit":
        return f"`{settings.integrator}` is not explicit"
    if prepared.path.module != "nivel.motion.relative":
        return "its coordinates are not relative"
    if len(run.ends):
        return "its functions have narrow features"
    if not all(int(each) in FAMILIES for each in prepared.motion.system.record.functions.address if each):
        return "it has laws in Python"
    return ""


def unfit_in_steps(sim: Simulation) -> str:
    """The same of a simulation."""
    if why := unfit(sim.prepared, sim.settings, sim.loop.history.record):
        return why
    if sim.pieces is None or sim.prepared.motion.system.units:
        return "it has memory of its own"
    return f"`{sim.settings.integrator}` remembers earlier steps" if sim.prepared.integrator.multistep else ""


class Lanes:
    """Copies of a machine, no more than there are lanes. inside : (n,) whether each is in its lane, where its motion is then;
    time : (n,) [s] of those.

    Elsewhere, and where it was brought there, the motion is that of the simulation.
    """

    def __init__(self, sims: list[Simulation], inside: NDArray[np.bool_]) -> None:
        self._sims, self.inside, self._first = sims, inside, (first := sims[0])
        record, run = first.prepared.motion.system.record, first.loop.history.record
        self._loop = LaneLoop(first.loop, first.pieces or ())
        self._memory = memory = self._loop.memory
        self._fit = np.array([_fits(each, first) for each in sims])
        every = [*leaves(record), *leaves(run)]
        own = [x for x in every if x.role in (Role.STATE, Role.BEGUN) or x.name in (*OF_RUN, *OF_INPUTS)]
        # what copies are is kept from call to call: words that are numbers, and others
        self._numbers = memory.words(x.array for x in own if x.array.dtype == float)
        self._others = memory.words(x.array for x in own if x.array.dtype != float)
        self._kept = np.zeros((len(self._numbers), lane_count())), np.zeros(len(self._others), dtype=np.int64)
        wholes = memory.words(x.array for x in every if x.array.dtype.kind in "ui" and x.role is not Role.WORKSPACE)
        self._same = np.setdiff1d(wholes, memory.words(run.counter[each : each + 1] for each in COUNTS))
        record, run = self._loop.machine, self._loop.run
        self._clock, self._counter = self._of(run.clock), run.counter
        self.time = self._clock[of_run.TIME, : len(sims)]
        self._kinds, self._values = record.functions.kind, self._of(record.functions.value)
        self._y, self._previous = self._of(run.y), self._of(run.previous)
        self._feedback = self._of(record.control.stabilise)
        self._feeds_back, self._places = bool(self._feedback[:2].any()), first.places_of_inputs
        self._packs = np.zeros(first.prepared.motion.system.layout.width, dtype=pack_type())
        self._frame = self._of(self._packs)
        machine, at = int(self._loop.handle.address), run.clock[of_run.TIME :]
        evaluate = first.loop.evaluate.packed
        self._advance = BoundEntry(advance.packed, self._loop.addresses, keep=self._loop)
        self._evaluate = BoundEntry(evaluate, (machine, at, run.y, run.rate), keep=self._loop)
        self._evaluate_aside = BoundEntry(evaluate, (machine, at, run.y, run.scratch), keep=self._loop)
        self._observe = BoundEntry(observe.packed, (machine, at, run.y, self._packs), keep=self._loop)
        self._observed = False
        self._note()
        # of each copy: steps more than those of the counter, calls until it may come in, and how many there were the last time
        self._more, self._waits, self._patience = (np.zeros(len(sims), dtype=int) for _ in range(3))

    @staticmethod
    def _of(packs: NDArray[Any]) -> NDArray[np.float64]:
        """Packs as numbers (…, lanes)."""
        return packs.view(np.float64).reshape(*packs.shape, lane_count())

    def go(self, steps: int, inputs: Inputs, alive: NDArray[np.bool_], left: c_uint64) -> NDArray[np.bool_]:
        """So many steps of the copies in lanes, after `inputs` (n,) are set; those of simulations are set already. Returns (n,) which
        have done them; others are where they were, as simulations. left : of `LanesWatched`."""
        if alive.tobytes() != self._as_bytes or not self._bits:
            self._come_in(alive)
        if not self._bits:
            return self.inside
        self._keep()
        left.value, self._observed = self._bits, False
        status = self._set_inputs(inputs)
        if status == OK:
            self._counter[of_run.BUDGET] = steps
            status = self._advance()
        stays = left.value if status == BUDGET_SPENT else 0
        done = self.inside.copy()
        if stays != self._bits:
            done &= (stays >> np.arange(len(done)) & 1).astype(bool)
            for lane in np.flatnonzero(self.inside & ~done):
                self._leave(int(lane))
        if self._counter[of_run.EVENTS]:
            self._hand_out(done)
        return done

    def _note(self) -> None:
        """Note which copies are inside, in forms that are quick to compare: as bytes, and as bits of a number."""
        self._as_bytes = self.inside.tobytes()
        self._bits = int.from_bytes(np.packbits(self.inside, bitorder="little").tobytes(), "little")

    def leave(self, lanes: Sequence[int], *, for_good: bool = False) -> None:
        """Let copies go on as simulations, from where they are. They may come in again at the next call; where others stay inside after
        that one, as a first step, which has none before it to look back at, is another one than theirs."""
        out = np.isin(np.arange(len(self._sims)), lanes)
        self.bring(self.inside & out)
        self.inside[out] = False
        self._note()
        self._waits[out], self._patience[out] = int(self.inside.any()), 0
        self._fit[out] &= not for_good

    def replace(self, lane: int, sim: Simulation) -> None:
        """Have another simulation in place of a copy."""
        self.inside[lane] = False
        self.leave([lane])
        self._sims[lane], self._fit[lane] = sim, _fits(sim, self._first)

    def bring(self, which: NDArray[np.bool_]) -> None:
        """Let the simulations of these copies, which are inside, be where the copies are."""
        if which.any():
            self._keep()
        for lane in np.flatnonzero(which):
            self._give(int(lane))

    def _come_in(self, alive: NDArray[np.bool_]) -> None:
        """Take in copies that wait for nothing, where there are enough of them; else let all of them be simulations."""
        waits = alive & ~self.inside & self._fit
        ready = waits & (self._waits == 0)
        self._waits[waits & ~ready] -= 1
        stays = self.inside & alive
        if np.count_nonzero(stays | ready) < FEWEST:
            stays = ready = np.zeros_like(stays)
        if (self.inside & ~stays).any():
            self.leave(np.flatnonzero(self.inside & ~stays).tolist())
        for lane in np.flatnonzero(ready):
            self._take(int(lane))

    def _take(self, lane: int) -> None:
        """Into its lane, where its whole numbers are those of the others."""
        sim = self._sims[lane]
        pieces, run = sim.pieces or (), sim.loop.history.record
        empty = not self.inside.any()
        if not empty and (words_of(pieces)[self._same] != self._memory.wholes[self._same]).any():
            return
        # lanes that nobody is in do what another one does: their branches are no others
        for each in range(lane_count()) if empty else (lane,):
            self._memory.take(each, pieces, wholes=empty)
        self._more[lane] = int(run.counter[of_run.DONE_STEPS] - self._counter[of_run.DONE_STEPS])
        self._clock[of_run.START, lane] += self._more[lane] * sim.step_size
        self.inside[lane] = True
        self._note()

    def _set_inputs(self, inputs: Inputs) -> int:
        """Give inputs and states their values, and evaluate again. Returns a status."""
        changes, count = False, len(self._sims)
        for name, given in inputs.items():
            is_state, place = self._places[name]
            row = (self._y if is_state else self._values)[place, :count]
            if (is_state or self._kinds[place] == CONSTANT) and row.tobytes() == given.tobytes():
                continue
            row[:], changes = given, True
            if is_state:
                self._previous[place, :count] = given
            else:
                self._kinds[place] = CONSTANT
        return self._evaluate() if changes else OK

    def _keep(self) -> None:
        """Keep what copies are now, so that they may go on singly from here."""
        # `clip` as others take twice as long
        self._memory.lanes.take(self._numbers, axis=0, out=self._kept[0], mode="clip")
        self._memory.wholes.take(self._others, out=self._kept[1], mode="clip")

    def _give(self, lane: int) -> None:
        """What was kept of a copy, to its simulation."""
        sim = self._sims[lane]
        run, first = sim.loop.history.record, 0
        start, words = float(run.clock[of_run.START]), words_of(sim.pieces or ())
        words.view(np.float64)[self._numbers] = self._kept[0][:, lane]
        words[self._others] = self._kept[1]
        for piece in sim.pieces or ():
            piece.view(np.int64)[:] = words[first : first + len(piece) // 8]
            first += len(piece) // 8
        run.clock[of_run.START] = start
        run.counter[of_run.DONE_STEPS] += self._more[lane]
        sim.moved()

    def _leave(self, lane: int) -> None:
        """Out of a lane that could not do a call."""
        self._give(lane)
        self.inside[lane] = False
        self._waits[lane] = self._patience[lane] = min(LONGEST_WAIT, 2 * self._patience[lane] + 1)
        self._note()
        if self.inside.any():
            self._memory.lanes[:, lane] = self._memory.lanes[:, int(np.argmax(self.inside))]

    def _hand_out(self, done: NDArray[np.bool_]) -> None:
        """Events of the copies, which are the same ones at other times."""
        events = self._of(self._loop.run.events[: int(self._counter[of_run.EVENTS])])
        self._counter[of_run.EVENTS] = 0
        for lane in np.flatnonzero(done).tolist():
            sim = self._sims[lane]
            sim.noted(occurrences(events[..., lane], sim.prepared.motion.system.events))

    def frames(self) -> NDArray[np.float64] | None:
        """(lanes, width) the frame of each copy inside, as it is now; loads of redundant joints are not shared. None where copies would be
        observed by different code."""
        if not self._bits:
            return None
        if not self._observed:
            with LanesWatched(self._bits) as left:
                if self._feeds_back:
                    kept = self._feedback.copy()
                    self._feedback[:2] = 0.0
                    self._evaluate_aside()
                    self._feedback[:] = kept
                self._observe()
            self._observed = left.value == self._bits
            self._frame[0] = self._clock[of_run.TIME]
        return self._frame.T if self._observed else None


def _fits(sim: Simulation, first: Simulation) -> bool:
    """Whether a copy has arrays and machine code like the first."""
    arrays = ([*arrays_of(each.loop.machine.record), *arrays_of(each.loop.history.record)] for each in (first, sim))
    return all(a.shape == b.shape and (a.dtype != np.uint64 or (a == b).all()) for a, b in zip(*arrays, strict=True))
