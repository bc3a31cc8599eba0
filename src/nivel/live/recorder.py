"""The recorder of a live run: the inputs of all its ticks and its frames go to the disk while it goes on."""

import threading
from collections import deque
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import SolveError
from nivel.integrate.loop.paced import DONE, SHOWN, Live
from nivel.live.preparation import Pace
from nivel.live.recording import FRAMES, GAP, PART, TICKS, Journal, Part, complete, parts_in
from nivel.machine.core.vectors import Array

MARGIN = 1024  # rows of the ring that the loop may write while they are read


class Recorder:
    """Takes ticks and frames out of the shared memory as long as they are there; keeps them in a journal, if there is one.

    problem : why no more is kept, or empty.
    """

    def __init__(self, live: Live, pace: Pace, journal: Journal | None) -> None:
        self._live, self._pace, self._journal = live, pace, journal
        self._ticks, self._shown = 0, int(live.control[SHOWN])
        self._time = -1.0  # of the last frame that was kept
        self._part, self._whole = 0, True  # number of the part that goes on, and whether all its ticks are kept
        self._saved: tuple[int, int] | None = None
        self.problem = ""
        self._append(PART, np.array([[-1.0, 0.0]]))

    def _append(self, kind: int, rows: Array) -> None:
        """To the journal, as long as its disk has room."""
        if self._journal is None or self.problem:
            return
        try:
            self._journal.append(kind, rows)
        except OSError as error:
            self._whole = False
            self.problem = f"nothing is recorded any more: {(error.strerror or str(error)).lower()}"

    def gather(self) -> Array:
        """New ticks and frames; returns these frames (n, width)."""
        live = self._live
        frames = self._new_frames()  # before the ticks, which are counted after them
        done, rows = int(live.control[DONE]), len(live.tape)
        if self._whole and done - self._ticks > rows - MARGIN:
            self._append(GAP, np.zeros((0, 1)))
            self._whole = False
        elif self._whole and done > self._ticks:
            self._append(TICKS, live.tape[np.arange(self._ticks, done) % rows])
            self._keep_frames(frames, done)
        self._ticks = max(done, self._ticks)
        return frames

    def _new_frames(self) -> Array:
        shown, ring = int(self._live.control[SHOWN]), len(self._live.frames)
        first = self._shown if shown - self._shown <= ring - 4 else shown - 1
        self._shown = shown
        return self._live.frames[np.arange(first, shown) % ring]

    def _keep_frames(self, frames: Array, done: int) -> None:
        """Keep those that the run made by itself, until the last tick."""
        at = frames[:, 0]
        regular = is_regular(at, self._pace) & (at <= done * self._pace.tick * (1.0 + 1e-9))
        # of several at the same time the last one
        last = np.append(at[1:] != at[:-1], True)[: len(at)]
        kept = frames[regular & last & (at > self._time)]
        if len(kept):
            self._append(FRAMES, kept)
            self._time = float(kept[-1, 0])

    def save(self, ticks: int) -> None:
        """The state after so many ticks may be returned to."""
        self._saved = self._part, ticks

    def detach(self, live: Live) -> None:
        """Look at a copy of the memory, which goes."""
        self._live = live

    def begin_again(self, *, at_start: bool) -> None:
        """The machine is back at its start, or at what was saved."""
        before, ticks = (-1, 0) if at_start or self._saved is None else self._saved
        self._append(PART, np.array([[before, ticks]], float))
        self._part, self._whole = self._part + 1, not self.problem
        self._ticks, self._shown = ticks, int(self._live.control[SHOWN]) - 1
        self._time = ticks * self._pace.tick * (1.0 + 1e-12) if ticks else -1.0

    @property
    def parts(self) -> list[Part]:
        """What was kept until now."""
        return [] if self._journal is None else parts_in(self._journal.file, last_whole=self._whole)

    def discard(self) -> None:
        """Keep nothing of what was recorded, nor of what follows."""
        if self._journal is not None:
            self._journal.discard()
            self._journal = None

    def complete(self, target: Path) -> None:
        """Write the recording `target`, in the place of the journal. Raises SolveError; then the journal stays, and can be replayed."""
        journal = self._journal
        if journal is None:
            return
        try:
            complete(journal, target, last_whole=self._whole)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise SolveError(
                f"the recording {target} cannot be written: {reason}",
                time=self._ticks * self._pace.tick,
                advice=f"What was recorded is in {journal.path}: `nivel replay {journal.path}` plays it.",
            ) from None


SPAN: Final = 25.0  # s of simulated time
ROUND_OFF: Final = 1e-6  # of the time between two frames


def is_regular(time: Array, pace: Pace) -> NDArray[np.bool_]:
    """Which of frames at `time` [s] the run made by itself: others were asked for, to be seen while nothing moves."""
    number = time / (pace.every * pace.tick)
    return np.abs(number - np.round(number)) < ROUND_OFF


class History:
    """Keeps regular frames, numbered from 1. Where the time goes back, those before it are forgotten."""

    def __init__(self, pace: Pace) -> None:
        self._pace = pace
        self._frames: deque[Array] = deque(maxlen=max(int(SPAN / (pace.every * pace.tick)), 1))
        self._last = 0  # number of the last frame
        self._lock = threading.Lock()

    def add(self, frames: Array) -> None:
        """Further frames (n, width), of which the first number is the time [s]."""
        with self._lock:
            for frame, regular in zip(frames, is_regular(frames[:, 0], self._pace), strict=True):
                if self._frames and frame[0] < self._frames[-1][0]:
                    self._frames.clear()
                if regular and not (self._frames and frame[0] == self._frames[-1][0]):
                    self._frames.append(frame.copy())
                    self._last += 1

    def after(self, number: int) -> tuple[int, list[Array]]:
        """The number of the last frame, and those that follow a number, as far as they are known."""
        with self._lock:
            count = min(max(self._last - number, 0), len(self._frames))
            return self._last, [self._frames[k] for k in range(len(self._frames) - count, len(self._frames))]
