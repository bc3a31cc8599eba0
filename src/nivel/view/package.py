"""A package: records as JSON and their arrays, in one block of bytes.

=======  ==================================================
bytes    content
=======  ==================================================
0–3      ``NVL1``
4–7      length of the JSON, little-endian
8–       JSON in UTF-8, then spaces up to a multiple of 8
then     arrays, each from a multiple of 8 on
=======  ==================================================

One moment is one packed array: positions and Euler parameters of all bodies, modal coordinates, vectors.
"""

import base64
import json
import struct
import zlib
from dataclasses import asdict
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import Array
from nivel.view.records import FRAME, MOVES, SAMPLES, Layout, Package, Packed, Steps

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


MAGIC: Final = b"NVL1"
LEVEL: Final = 9  # of compression: it is done once
KINDS: Final[dict[str, str]] = {"f4": "<f4", "f8": "<f8", "u4": "<u4", "u2": "<u2"}
Kind = Literal["f4", "f8", "u4", "u2"]
STEPS: Final = 65535  # of a number that is sent as one of 16 bits


class Block:
    """Arrays that are packed one after the other."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self.size = 0

    def add(self, values: NDArray[Any], kind: Kind = "f4") -> Packed:
        """Put an array to the end; what is too large for 32 bits becomes infinite and is not drawn."""
        with np.errstate(over="ignore"):
            numbers = np.ascontiguousarray(values, dtype=KINDS[kind])
        content = numbers.view(np.uint8).reshape(-1, numbers.itemsize).T.tobytes() if numbers.size else b""
        packed = Packed(kind, list(numbers.shape), self.size)
        self._parts.append(content + bytes(-len(content) % 8))
        self.size += len(self._parts[-1])
        return packed

    def add_steps(self, values: NDArray[Any]) -> Steps:
        """Put an array to the end with 16 bits a number, each part of its first axis from its smallest to its largest number.

        What is not finite becomes the smallest.
        """
        flat = np.asarray(values, dtype=float).reshape(len(values), -1)
        known = np.isfinite(flat)
        low = np.min(flat, axis=1, initial=np.inf, where=known)
        high = np.max(flat, axis=1, initial=-np.inf, where=known)
        low = np.where(np.isfinite(low), low, 0.0)
        step = np.maximum(high - low, 0.0) / STEPS
        whole = (np.where(known, flat, low[:, None]) - low[:, None]) / np.where(step > 0.0, step, 1.0)[:, None]
        numbers = self.add(np.rint(whole).reshape(np.shape(values)), "u2")
        return Steps(numbers, low.tolist(), step.tolist())

    def content(self) -> bytes:
        """All of it."""
        return b"".join(self._parts)


def to_bytes(package: Package, block: Block) -> bytes:
    """The package in the form above."""
    text = json.dumps(asdict(package), separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 8)
    return MAGIC + struct.pack("<I", len(text)) + text + block.content()


def compressed_text(content: bytes) -> str:
    """Bytes as text for a page: deflated, then base64."""
    return base64.b64encode(zlib.compress(content, LEVEL)).decode()
