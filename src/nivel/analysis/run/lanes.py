"""Lanes: machines that differ in their numbers alone are moved together by each step, one in each lane of the processor's vectors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.run.dynamics import Loop, LoopOnNumbers
from nivel.kernels.core.arrays import NUMBERS, changed
from nivel.kernels.record.hook import FAMILIES
from nivel.native.packs import lanes_watched, pack_type
from nivel.native.processor import lane_count

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
