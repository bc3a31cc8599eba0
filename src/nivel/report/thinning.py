"""Fewer points for curves that have more than a screen can show, without losing a peak."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Thinning:
    """The same few times for every curve: each stretch of frames keeps its least and its largest value, in their order.

    time : (n,) [s]. limit : points that are kept at most; where n is not larger, everything is kept.
    """

    def __init__(self, time: Array, limit: int) -> None:
        self._starts: NDArray[np.intp] | None = None
        self.time = time
        self.frames = 1  # frames of a stretch
        if len(time) <= limit:
            return
        self._starts = np.linspace(0, len(time), limit // 2, endpoint=False).astype(np.intp)
        ends = np.append(self._starts[1:], len(time)) - 1
        self.frames = int(np.ceil(len(time) / len(self._starts)))
        self.time = np.stack([time[self._starts], 0.5 * (time[self._starts] + time[ends])], axis=-1).ravel()
        self.time[-1] = time[-1]

    def __call__(self, values: Array) -> Array:
        """(n,) → (points,). A stretch with a NaN keeps the NaN."""
        starts = self._starts
        if starts is None:
            return values
        least, largest = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
        first_is_least = _first_place(values, least, starts) <= _first_place(values, largest, starts)
        pairs = np.where(first_is_least, [least, largest], [largest, least])
        return pairs.T.ravel()


def _first_place(values: Array, wanted: Array, starts: NDArray[np.intp]) -> NDArray[np.intp]:
    """Index of the first frame of each stretch that has the wanted value."""
    lengths = np.diff(np.append(starts, len(values)))
    places = np.where(values == np.repeat(wanted, lengths), np.arange(len(values)), len(values))
    return np.minimum.reduceat(places, starts)
