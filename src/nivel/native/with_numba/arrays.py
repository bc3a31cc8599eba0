"""Array structures of Numba made of addresses and sizes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from llvmlite import ir
from numba import types

from nivel.native.with_numba import known_parts

WORD = ir.IntType(64)


def array_of(
    context: Any, builder: Any, kind: types.Array, data: Any, shape: Sequence[Any], strides: Sequence[Any]
) -> Any:
    """The array of this kind whose items begin at the pointer `data`; strides in bytes."""
    size = ir.Constant(WORD, item_size(context, kind))
    return known_parts.array_of(context, builder, kind, data, shape, strides, itemsize=size)


def item_size(context: Any, kind: types.Array) -> int:
    """Bytes of an item."""
    return context.get_abi_sizeof(context.get_data_type(kind.dtype))


def item_pointer(context: Any, kind: types.Array) -> Any:
    """The type of a pointer to an item."""
    return context.get_data_type(kind.dtype).as_pointer()
