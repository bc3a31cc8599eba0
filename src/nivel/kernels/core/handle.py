"""One address for a record.

A record passed by value copies the descriptors of all its arrays at every call, about a microsecond for a whole machine. Instead its
descriptors are written once into a block of memory, and kernels hold the address of the block: a `View`, of which they read just the
arrays that they name. So a call costs a nanosecond, a part of a record is an address as well, and the compiler never sees the rest.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.native.function import Intrinsic


class Handle:
    """The address of a record; keeps the record's arrays alive and in place."""

    def __init__(self, record: Any) -> None:
        self.record = record
        self._block = np.array(_descriptors(record, []), dtype=np.int64)
        self.address = np.uint64(self._block.ctypes.data)


def _descriptors(record: Any, words: list[int]) -> list[int]:
    """The words of Numba's array structures, field by field: owner and parent (none), items, item size, data, shape, strides."""
    for field in record:
        if isinstance(field, tuple):
            _descriptors(field, words)
        else:
            if not field.flags.c_contiguous:
                raise TypeError("arrays of a record must be C-contiguous")
            data = field.ctypes.data if field.size else 0  # of an empty array nothing is read
            words += (0, 0, field.size, field.itemsize, data, *field.shape, *field.strides)
    return words


def reader(record_class: type) -> Intrinsic:
    """What gives kernels a view of the record of this class at an address, or of its twin at the address of one."""

    def make() -> Any:
        from nivel.native.with_numba.views import reader

        return reader(record_class)

    return Intrinsic(make)
