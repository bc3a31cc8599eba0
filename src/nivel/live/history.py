"""The last seconds of a live run: its frames at equal times, whoever looks at them and how often."""

from __future__ import annotations

import threading
from collections import deque
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.live.preparation import Pace

Array = NDArray[np.float64]
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
