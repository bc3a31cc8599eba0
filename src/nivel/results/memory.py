"""A sink that keeps the frames in memory, for runs without a file."""

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.sink import Header
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result

GROWTH = 2  # a full buffer doubles: each frame is copied at most twice on average
MOST_AT_FIRST = 16_384  # frames: more than that are made room for when they come


class Memory:
    """Sink without a file: `begin`, `take` …, then `close` gives the result. expected : frames, as far as they are known before."""

    def __init__(self, expected: float = 256) -> None:
        self._first = int(min(expected, MOST_AT_FIRST))
        self._header: Header | None = None
        self._buffer = np.empty((0, 0))
        self._count = 0

    def begin(self, header: Header) -> None:
        self._header = header
        self._buffer = np.empty((self._first, header.layout.width))
        self._count = 0

    def take(self, frames: NDArray[np.float64]) -> None:
        end = self._count + len(frames)
        if end > len(self._buffer):
            grown = np.empty((max(end, GROWTH * len(self._buffer)), self._buffer.shape[1]))
            grown[: self._count] = self._buffer[: self._count]
            self._buffer = grown
        self._buffer[self._count : end] = frames
        self._count = end

    @property
    def frames(self) -> NDArray[np.float64]:
        """(n, width) what was taken."""
        return self._buffer[: self._count]

    def discard(self) -> None:
        """Give up what was taken."""
        self._header, self._count = None, 0

    def forget_after(self, time: float) -> None:
        """Drop the frames after `time` [s]. Results that were given keep them."""
        self._buffer = self._buffer.copy()
        self._count = int(np.searchsorted(self._buffer[: self._count, 0], time, side="right"))

    def result(self) -> Result:
        """What was taken so far, with the attributes of the header."""
        return self._as_result({})

    def close(self, attributes: dict[str, str | float | int]) -> Result:
        """The result; `attributes` (`outcome`, `trust`, `timing`, …) replace those of the header."""
        return self._as_result(attributes)

    def _as_result(self, attributes: dict[str, str | float | int]) -> Result:
        if self._header is None:
            raise RuntimeError("a sink must begin before it gives a result")
        # what was taken is never written again, and a result only reads
        return Result(
            MemoryContents(self._header, self._buffer[: self._count], {**self._header.attributes, **attributes})
        )
