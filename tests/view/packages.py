"""Packages as the page reads them, and a source of frames that a program hands over."""

import json
import struct
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import Array
from nivel.view import package, records
from nivel.view.package import KINDS, MAGIC, Block, to_bytes
from nivel.view.sources import Source


def from_bytes(content: bytes) -> tuple[dict[str, Any], bytes]:
    """The JSON and the arrays of a package."""
    if content[:4] != MAGIC:
        raise ValueError("not a package")
    (length,) = struct.unpack_from("<I", content, 4)
    return json.loads(content[8 : 8 + length]), content[8 + length :]


def unpacked(packed: dict[str, Any], arrays: bytes) -> NDArray[Any]:
    """An array of a package, whose `Packed` is given as in its JSON."""
    kind = np.dtype(KINDS[packed["kind"]])
    count = int(np.prod(packed["shape"]))
    raw = np.frombuffer(arrays, np.uint8, count * kind.itemsize, packed["start"])
    return np.ascontiguousarray(raw.reshape(kind.itemsize, count).T).view(kind).reshape(packed["shape"])


class Live(Source):
    """Frames that a program hands over while it runs: `show` keeps the newest, and is never waited for."""

    def __init__(self, stage: records.Stage, block: Block) -> None:
        super().__init__()
        self._package = to_bytes(records.Package(records.PROTOCOL, "live", [stage]), block)
        self._lock = Lock()
        self._newest: tuple[float, Array] | None = None

    def package(self) -> bytes:
        return self._package

    def show(
        self, time: float, position: Array, orientation: Array, modal: Array | None = None, vectors: Array | None = None
    ) -> None:
        """A new moment: position (B, 3), orientation (B, 4), modal coordinates (M,), vectors (V, 3)."""
        row = package.rows(
            position[None],
            orientation[None],
            None if modal is None else modal[None],
            None if vectors is None else vectors[None],
        )[0]
        with self._lock:
            self._newest = (time, row)
        self.on_change()

    def frame(self) -> tuple[float, Array] | None:
        with self._lock:
            return self._newest
