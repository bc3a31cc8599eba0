"""The memory that the solver's process shares with the server of the page: the arrays of `Live`, one after the other."""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.preparation.memory import arrays_of
from nivel.integrate.loop.paced import BINS, CLOCKS, CONTROLS, Live
from nivel.machine.core.vectors import Array

TAPE_ROWS: Final = 1 << 16  # a minute of ticks of 1 ms: what the recorder may be late by
FRAME_ROWS: Final = 256  # four seconds of frames: what the server may be late by
# commands in `Live.control[COMMAND]`; a command is done when the solver has put 0 there
RUN, PAUSE, STEP, RESET, SAVE, RESTORE, QUIT = 1, 2, 3, 4, 5, 6, 7
# values of `Live.control[MODE]`
STARTING, RUNNING, PAUSED, ENDED, FAILED, GONE = 0, 1, 2, 3, 4, 5


Ground = tuple[Array, int, float]  # of a soil before the run: heights [m], forces on it, side of its cells [m]


class Sizes(NamedTuple):
    """Numbers of inputs of the machine and of columns of a frame, rows of the rings, heights of soils and volumes that are carried."""

    inputs: int
    width: int
    tape_rows: int = TAPE_ROWS
    frame_rows: int = FRAME_ROWS
    soil: int = 0


def _shapes(sizes: Sizes) -> dict[str, tuple[Any, tuple[int, ...]]]:
    n = sizes.inputs
    return {
        "clock": (np.float64, (CLOCKS,)),
        "control": (np.int64, (CONTROLS,)),
        "function": (np.uint32, (n,)),
        "limit": (np.float64, (n, 4)),
        "target": (np.float64, (n,)),
        "value": (np.float64, (n,)),
        "tape": (np.float64, (sizes.tape_rows, n)),
        "frames": (np.float64, (sizes.frame_rows, sizes.width)),
        "histogram": (np.int64, (2 * BINS,)),
        "address": (np.uint64, (4,)),
        "now": (np.int64, (2,)),
        "deadline": (np.int64, (2,)),
    }


def bytes_of(sizes: Sizes) -> int:
    """Room that the arrays need."""
    return sum(_room(kind, shape) for kind, shape in _shapes(sizes).values()) + 8 * sizes.soil


def _room(kind: Any, shape: tuple[int, ...]) -> int:
    """Bytes of an array, up to the next multiple of 64: a line of the cache belongs to one array."""
    return -(-int(np.prod(shape)) * np.dtype(kind).itemsize // 64) * 64 + 64


def live_in(memory: Any, sizes: Sizes) -> Live:
    """The arrays in a block of memory of this size."""
    arrays, place = {}, 0
    for name, (kind, shape) in _shapes(sizes).items():
        arrays[name] = np.ndarray(shape, kind, buffer=memory, offset=place)
        place += _room(kind, shape)
    return Live(**arrays)


def soils_in(memory: Any, sizes: Sizes, grounds: Sequence[Ground]) -> list[tuple[Array, Array]]:
    """Heights [m] of soils and volumes that are carried of them [m³], behind the rest of the memory."""
    numbers, out = np.frombuffer(memory, np.float64, sizes.soil, bytes_of(sizes) - 8 * sizes.soil), []
    for start, forces, _ in grounds:
        heights, carried, numbers = np.split(numbers, [start.size, start.size + forces])
        out.append((heights.reshape(start.shape), carried))
    return out


def copy_of(live: Live) -> Live:
    """The same numbers in memory of this process."""
    arrays: dict[str, Any] = {name: array.copy() for name, array in live._asdict().items()}
    return Live(**arrays)


class Snapshot(NamedTuple):
    """A state. ticks : done until then."""

    ticks: int
    arrays: list[NDArray[Any]]


def arrays_in(records: Sequence[Any]) -> list[NDArray[Any]]:
    """All arrays of nested records, each once."""
    found = {id(array): array for record in records for array in arrays_of(record)}
    return [each for each in found.values() if each.size]


def taken(arrays: Sequence[NDArray[Any]], ticks: int) -> Snapshot:
    """A copy of the arrays."""
    return Snapshot(ticks, [array.copy() for array in arrays])


def put_back(arrays: Sequence[NDArray[Any]], snapshot: Snapshot) -> None:
    """Let the arrays be what they were."""
    for array, kept in zip(arrays, snapshot.arrays, strict=True):
        np.copyto(array, kept)
