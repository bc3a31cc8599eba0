"""One address for a record.

A record passed by value copies the descriptors of all its arrays at every call, about a microsecond for a whole machine. Instead its
descriptors are written once into a block of memory, and kernels hold the address of the block: a `View`, of which they read just the
arrays that they name. So a call costs a nanosecond, a part of a record is an address as well, and the compiler never sees the rest.

The block does not change as long as it lives, and the compiler is told so: it keeps what it has read over any number of stores.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.datamodel.models import PrimitiveModel
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, lower_getattr_generic, register_model

address_type = types.uint64
# The address of a record whose work is complex: a type of its own, so that kernels compile for it, and never take one for the other.
complex_address_type = types.UniTuple(types.uint64, 1)
WORD = 8
# words of an array structure before its shape: owner, parent, items, item size, data
HEAD = 5


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


def _words(kind: Any) -> int:
    """Words in the block of an array or of a record."""
    return HEAD + 2 * kind.ndim if isinstance(kind, types.Array) else sum(_words(each) for each in kind.types)


class View(types.Type):
    """Numba's type of a record, or of a part of one, at an address. kind : Numba's type of the NamedTuple."""

    def __init__(self, kind: Any, variant: str) -> None:
        self.kind, self.variant = kind, variant
        record_class = kind.instance_class
        super().__init__(f"View({record_class.__module__}.{record_class.__qualname__}{variant})")

    def place(self, name: str) -> tuple[types.Type, int] | None:
        """Type of a field and its first byte in the block."""
        if name not in self.kind.fields:
            return None
        number = self.kind.fields.index(name)
        field = self.kind.types[number]
        first = WORD * sum(_words(each) for each in self.kind.types[:number])
        return field if isinstance(field, types.Array) else View(field, self.variant), first


@register_model(View)
class ViewModel(PrimitiveModel):
    """An address."""

    def __init__(self, manager: Any, kind: View) -> None:
        super().__init__(manager, kind, ir.IntType(64))


@infer_getattr
class ViewFields(AttributeTemplate):
    """Types of the fields."""

    key = View

    def generic_resolve(self, view: View, name: str) -> types.Type | None:
        place = view.place(name)
        return None if place is None else place[0]


@lower_getattr_generic(View)
def read_field(context: Any, builder: Any, view: View, address: Any, name: str) -> Any:
    """The array structure of a field, or the address of a part."""
    place = view.place(name)
    assert place is not None
    field, first = place
    start = builder.add(address, ir.Constant(ir.IntType(64), first))
    return _array_at(context, builder, field, start) if isinstance(field, types.Array) else start


def _array_at(context: Any, builder: Any, kind: types.Array, start: Any) -> Any:
    """The array whose structure begins at this address."""
    word = ir.IntType(64)
    unchanging = builder.module.add_metadata([])
    base = builder.inttoptr(start, word.as_pointer())

    def read(number: int) -> Any:
        value = builder.load(builder.gep(base, [ir.Constant(word, number)], inbounds=True))
        value.set_metadata("invariant.load", unchanging)
        return value

    array = context.make_array(kind)(context, builder)
    data = builder.inttoptr(read(HEAD - 1), array.data.type)
    context.populate_array(
        array,
        data=data,
        shape=[read(HEAD + k) for k in range(kind.ndim)],
        strides=[read(HEAD + kind.ndim + k) for k in range(kind.ndim)],
        itemsize=ir.Constant(word, context.get_abi_sizeof(context.get_data_type(kind.dtype))),
        meminfo=None,
    )
    return array._getvalue()


def reader(record_type: Any, complex_type: Any = None) -> Any:
    """An intrinsic that gives kernels a view of the record of `record_type` at an address, or of `complex_type` at a complex one."""
    views = View(record_type, ""), None if complex_type is None else View(complex_type, " on complex numbers")

    @intrinsic
    def record_at(typingctx: Any, address: Any) -> Any:
        is_complex = address == complex_address_type

        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return builder.extract_value(args[0], 0) if is_complex else args[0]

        return views[is_complex](complex_address_type if is_complex else address_type), generate

    return record_at
