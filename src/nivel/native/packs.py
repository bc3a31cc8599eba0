"""Packs: numbers of several machines, one in each lane of a vector of the processor, which the same code of kernels carries along.

Whole numbers, branches and indices are the same for all lanes. Where a comparison or an index of one lane is another one than that of most,
its lane *leaves*: what it holds from there on means nothing, and its machine has to be run singly. The others go on.
"""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from typing import Any, Final

import numpy as np

from nivel.native.library import VARIABLES
from nivel.native.processor import lane_count

# what compiled code knows the key by under which a thread keeps the lanes that have not left
KEY: Final = "nivel_lanes_left"
# elsewhere, compiled code may not find the functions of threads, or keys are of another size
HAS_LANES: Final = sys.platform == "linux"


@cache
def pack_type() -> np.dtype[Any]:
    """Packs as items of arrays of Python."""
    return np.dtype([("lanes", np.float64, (lane_count(),))])


@cache
def _key() -> tuple[Any, Any]:
    """The library of C, and the key, made once a process."""
    library, key = ctypes.CDLL(None), ctypes.c_uint32(0)
    if library.pthread_key_create(ctypes.byref(key), None):
        raise MemoryError("there is no key left for what threads keep of their own")
    return library, key


if HAS_LANES:
    VARIABLES[KEY] = ctypes.addressof(_key()[1])


class LanesWatched:
    """While it lasts, as a context, calls of this thread note which lanes have not left: a bit for each, the first one lowest.

    lanes : those that are in use, all by default.
    """

    def __init__(self, lanes: int = -1) -> None:
        self._library, self._key = _key()
        self._left = ctypes.c_uint64(lanes & ((1 << lane_count()) - 1))

    def __enter__(self) -> ctypes.c_uint64:
        self._library.pthread_setspecific(self._key, ctypes.byref(self._left))
        return self._left

    def __exit__(self, *_: object) -> None:
        self._library.pthread_setspecific(self._key, None)
