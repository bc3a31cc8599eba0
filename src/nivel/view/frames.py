"""One moment as one packed array: positions and Euler parameters of all bodies, modal coordinates, vectors."""

import struct
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import Array
from nivel.view.records import FRAME, MOVES, SAMPLES, Layout

HEAD: Final = struct.Struct("<IId")  # what follows, number of the frame, its time
SAMPLES_HEAD: Final = struct.Struct("<II")  # what follows, floats of a sample
MOVES_HEAD: Final = struct.Struct("<IIII")  # what follows, number of the terrain, numbers of loads and moves


def layout(bodies: int, modes: int = 0, vectors: int = 0) -> Layout:
    """Places in the frames of a machine with so many bodies, modal coordinates and vectors."""
    return Layout(bodies, modes, vectors, 7 * bodies + modes + 3 * vectors)


def rows(position: Array, orientation: Array, modal: Array | None = None, vectors: Array | None = None) -> Array:
    """(n, width) frames of position (n, B, 3), orientation (n, B, 4), modal coordinates (n, M), vectors (n, V, 3)."""
    n = len(position)
    parts = [np.concatenate([position, orientation], axis=-1).reshape(n, -1)]
    parts += [] if modal is None else [modal.reshape(n, -1)]
    parts += [] if vectors is None else [vectors.reshape(n, -1)]
    return np.hstack(parts)


def message(number: int, time: float, frame: Array) -> bytes:
    """The binary message of a frame (width,)."""
    with np.errstate(over="ignore"):  # beyond 32 bits: not drawn
        return HEAD.pack(FRAME, number & 0xFFFFFFFF, time) + frame.astype("<f4").tobytes()


def samples_message(samples: Array) -> bytes:
    """The binary message of samples (n, width)."""
    return SAMPLES_HEAD.pack(SAMPLES, samples.shape[1]) + samples.astype("<f8").tobytes()


def moves_message(terrain: int, nodes: NDArray[Any], moves: NDArray[Any], carried: Array) -> bytes:
    """The binary message on a terrain: which vertices move by how many steps, and volumes that are carried [m³]."""
    head = MOVES_HEAD.pack(MOVES, terrain, len(carried), len(nodes))
    return head + carried.astype("<f4").tobytes() + nodes.astype("<u4").tobytes() + moves.astype("<i2").tobytes()
