"""Panel of plots in the report: groups of curves of one unit, of which the reader chooses one, and curves with fewer points."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

GROUPS = 24  # elements of a panel that can be chosen; more stand in the result file
TOGETHER = 8  # curves that can be told apart in one plot
MOST = 2 * TOGETHER  # curves in a plot: those after the first TOGETHER are dashed


class Curve(Struct):
    """One curve (n,); `tone` is the place of its colour, "x", "y", "z" or a number."""

    label: str
    values: Array
    tone: str


class Group(Struct):
    """Curves of one unit.

    limits : (value, colour word) of lines that the curves are held against.
    floor : a change of the curves, in their unit, below which they are round-off and drawn flat.
    """

    label: str
    unit: str
    curves: tuple[Curve, ...]
    limits: tuple[tuple[float, str], ...] = ()
    floor: float = 0.0


class Panel(Struct):
    """A plot; with several groups the reader chooses one."""

    title: str
    groups: tuple[Group, ...]
    log: bool = False
    note: str = ""


def left_out(count: int, shown: int = GROUPS) -> str:
    """The note of a panel that shows only some."""
    return f"{count - shown} more in the result file" if count > shown else ""


def components(values: Array) -> Iterator[Curve]:
    """x, y, z of a vector (n, 3)."""
    for k, name in enumerate("xyz"):
        yield Curve(name, values[:, k], name)


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
