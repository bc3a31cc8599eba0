"""One address for a record.

A record passed by value copies the descriptors of all its arrays at every call, about a microsecond for a whole machine. Instead its
descriptors are written once into a block of memory, entries take the address of the block (uint64), and load only the arrays they
use: a call costs a nanosecond and the interface of an entry stays small.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numba import types
from numba.extending import intrinsic

address_type = types.uint64
# The address of a record whose work is complex: a type of its own, so that kernels compile for it, and never take one for the other.
complex_address_type = types.UniTuple(types.uint64, 1)


class Handle:
    """The address of a record; keeps the record's arrays alive and in place."""

    def __init__(self, record: Any) -> None:
        self.record = record
        self._block = np.array(list(_descriptors(record)), dtype=np.int64)
        self.address = np.uint64(self._block.ctypes.data)


def _descriptors(record: Any) -> Iterator[int]:
    """The words of Numba's array structures, field by field: owner and parent (none), items, item size, data, shape, strides."""
    for field in record:
        if isinstance(field, tuple):
            yield from _descriptors(field)
        else:
            if not field.flags.c_contiguous:
                raise TypeError("arrays of a record must be C-contiguous")
            yield from (0, 0, field.size, field.itemsize, field.ctypes.data, *field.shape, *field.strides)


def reader(record_type: Any, complex_type: Any = None) -> Any:
    """An intrinsic that gives kernels the record of `record_type` at an address, or of `complex_type` at a complex one."""

    @intrinsic
    def record_at(typingctx: Any, address: Any) -> Any:
        is_complex = address == complex_address_type
        kind = complex_type if is_complex else record_type

        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            model = context.data_model_manager[kind]
            word = builder.extract_value(args[0], 0) if is_complex else args[0]
            return model.load_from_data_pointer(builder, builder.inttoptr(word, model.get_data_type().as_pointer()))

        return kind(complex_address_type if is_complex else address_type), generate

    return record_at
