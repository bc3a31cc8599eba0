"""Dual numbers: a value and its slopes along LANES directions, which the same code of kernels carries along.

Branches and indices follow the value alone. Compiled code has them as one vector of doubles (`nivel.native.with_numba.duals`), arrays of
Python as items of the type DUAL.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

LANES = 7
DUAL = np.dtype([("value", np.float64), ("slopes", np.float64, (LANES,))])


def duals(values: Any) -> NDArray[Any]:
    """An array of dual numbers with these values and no slopes; each is a line of the processor's cache."""
    values = np.asarray(values, dtype=np.float64)
    room = np.zeros((values.size + 1) * DUAL.itemsize, dtype=np.uint8)
    first = -room.ctypes.data % DUAL.itemsize
    out = room[first : first + values.size * DUAL.itemsize].view(DUAL).reshape(values.shape)
    out["value"] = values
    return out
