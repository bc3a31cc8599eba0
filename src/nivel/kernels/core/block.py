"""One address for a record.

A record passed by value copies the descriptors of all its arrays at every call, about a microsecond for a whole machine. Instead its
descriptors are written once into a block of memory, and kernels hold the address of the block: a `View`, of which they read just the
arrays that they name. So a call costs a nanosecond, a part of a record is an address as well, and the compiler never sees the rest.
"""

from __future__ import annotations

from ctypes import addressof, c_char
from typing import Any

import numpy as np


class Handle:
    """The address of a record; keeps the record's arrays alive and in place."""

    def __init__(self, record: Any) -> None:
        self.record = record
        self._block = np.array(_descriptors(record, []), dtype=np.int64)
        self.address = np.uint64(self._block.ctypes.data)

    def become(self, record: Any) -> None:
        """Another record of the same kind stands at this address from now on."""
        self.record = record
        self._block[:] = _descriptors(record, [])


def _descriptors(record: Any, words: list[int]) -> list[int]:
    """The words of Numba's array structures, field by field: owner and parent (none), items, item size, data, shape, strides."""
    for field in record:
        if isinstance(field, tuple):
            _descriptors(field, words)
        else:
            if not field.flags.c_contiguous:
                raise TypeError("arrays of a record must be C-contiguous")
            words += (0, 0, field.size, field.itemsize, _data(field), *field.shape, *field.strides)
    return words


def _data(array: Any) -> int:
    """Where the first entry of an array is; of an empty one nothing is read."""
    if not array.size:
        return 0
    # a fifth of the time of `ctypes.data`, which takes arrays that cannot be written to as well
    return addressof(c_char.from_buffer(array)) if array.flags.writeable else array.ctypes.data
