"""Keeps a live run while it goes on: the inputs of all its ticks and its frames, on the disk."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from weakref import finalize

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.paced import DONE, SHOWN, Live
from nivel.live.preparation import Pace
from nivel.live.recording import Part, Take

Array = NDArray[np.float64]


@dataclass
class _Piece:
    """A part: rows of the files of ticks and of frames."""

    before: int
    ticks: int
    rows: slice
    shown: slice
    whole: bool = True


class Rows:
    """Rows of numbers in a file that goes with the program: an hour of them takes disk, no memory."""

    def __init__(self, folder: Path, width: int) -> None:
        self._file = TemporaryFile(dir=folder)  # noqa: SIM115, it lives as long as these rows
        finalize(self, self._file.close)
        self._width = width
        self.count = 0

    def append(self, rows: Array) -> None:
        """Raises OSError where the disk is full."""
        self._file.write(rows.tobytes())
        self.count += len(rows)

    def __getitem__(self, rows: slice) -> Array:
        self._file.flush()
        shape = rows.stop - rows.start, self._width
        if not shape[0]:
            return np.zeros(shape)
        return np.memmap(self._file, np.float64, "r", rows.start * self._width * 8, shape)


class Recorder:
    """Takes ticks and frames out of the shared memory as long as they are there; keeps them in a folder, if there is one.

    problem : why no more is kept, or empty.
    """

    def __init__(self, live: Live, pace: Pace, folder: Path | None) -> None:
        self._live, self._pace = live, pace
        self._ticks, self._shown = 0, int(live.control[SHOWN])
        self._time = -1.0  # of the last frame that was kept
        self._keeps = folder is not None
        self.problem = ""
        if folder is not None:
            self._tape, self._frames = Rows(folder, live.tape.shape[1]), Rows(folder, live.frames.shape[1])
        self._pieces = [_Piece(-1, 0, slice(0, 0), slice(0, 0))]
        self._saved: tuple[int, int] | None = None

    def gather(self) -> Array:
        """New ticks and frames; returns these frames (n, width)."""
        live, part = self._live, self._pieces[-1]
        frames = self._new_frames()  # before the ticks, which are counted after them
        done, rows = int(live.control[DONE]), len(live.tape)
        if self._keeps and part.whole:
            try:
                if done - self._ticks > rows - 1024:
                    part.whole = False
                elif done > self._ticks:
                    self._tape.append(live.tape[np.arange(self._ticks, done) % rows])
                    self._keep_frames(frames, done)
            except OSError as error:
                part.whole, self._keeps = False, False
                self.problem = f"nothing is recorded any more: {(error.strerror or str(error)).lower()}"
            part.rows, part.shown = (
                slice(part.rows.start, self._tape.count),
                slice(part.shown.start, self._frames.count),
            )
        self._ticks = max(done, self._ticks)
        return frames

    def _new_frames(self) -> Array:
        shown, ring = int(self._live.control[SHOWN]), len(self._live.frames)
        first = self._shown if shown - self._shown <= ring - 4 else shown - 1
        self._shown = shown
        return self._live.frames[np.arange(first, shown) % ring]

    def _keep_frames(self, frames: Array, done: int) -> None:
        """Keep those that the run made by itself, until the last tick: others were asked for, to be seen while nothing moves."""
        at = frames[:, 0]
        number = at / (self._pace.every * self._pace.tick)
        regular = (np.abs(number - np.round(number)) < 1e-6) & (at <= done * self._pace.tick * (1.0 + 1e-9))
        # of several at the same time the last one
        last = np.append(at[1:] != at[:-1], True)[: len(at)]
        kept = frames[regular & last & (at > self._time)]
        if len(kept):
            self._frames.append(kept)
            self._time = float(kept[-1, 0])

    def detach(self, live: Live) -> None:
        """Look at a copy of the memory, which goes."""
        self._live = live

    def save(self, ticks: int) -> None:
        """The state after so many ticks may be returned to."""
        self._saved = len(self._pieces) - 1, ticks

    def begin_again(self, *, at_start: bool) -> None:
        """The machine is back at its start, or at what was saved."""
        before, ticks = (-1, 0) if at_start or self._saved is None else self._saved
        if self._keeps:
            rows, shown = self._tape.count, self._frames.count
            self._pieces.append(_Piece(before, ticks, slice(rows, rows), slice(shown, shown)))
        self._ticks, self._shown = ticks, int(self._live.control[SHOWN]) - 1
        self._time = ticks * self._pace.tick * (1.0 + 1e-12) if ticks else -1.0

    @property
    def parts(self) -> list[Part]:
        """What was kept until now."""
        if not self._keeps and not self.problem:
            return []
        return [
            Part(each.before, each.ticks, Take(self._tape[each.rows], self._frames[each.shown], each.whole))
            for each in self._pieces
        ]
