"""Records at addresses: see `nivel.kernels.core.block` for the block of memory that is read here.

The block does not change as long as it lives, and the compiler is told so: it keeps what it has read over any number of stores.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core.datamodel.models import PrimitiveModel
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, lower_getattr_generic, register_model

from nivel.native.with_numba.arrays import WORD, array_of, item_pointer
from nivel.native.with_numba.duals import DUAL
from nivel.native.with_numba.kinds import PACKED, TWIN, WHOLE, record_type
from nivel.native.with_numba.packs import PACK

BYTES = 8
# words of an array structure before its shape: owner, parent, items, item size, data
HEAD = 5


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
        first = BYTES * sum(_words(each) for each in self.kind.types[:number])
        return field if isinstance(field, types.Array) else View(field, self.variant), first


@register_model(View)
class ViewModel(PrimitiveModel):
    """An address."""

    def __init__(self, manager: Any, kind: View) -> None:
        super().__init__(manager, kind, WORD)


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
    start = builder.add(address, ir.Constant(WORD, first))
    return _array_at(context, builder, field, start) if isinstance(field, types.Array) else start


def _array_at(context: Any, builder: Any, kind: types.Array, start: Any) -> Any:
    """The array whose structure begins at this address."""
    unchanging = builder.module.add_metadata([])
    base = builder.inttoptr(start, WORD.as_pointer())

    def read(number: int) -> Any:
        value = builder.load(builder.gep(base, [ir.Constant(WORD, number)], inbounds=True))
        value.set_metadata("invariant.load", unchanging)
        return value

    data = builder.inttoptr(read(HEAD - 1), item_pointer(context, kind))
    shape = [read(HEAD + k) for k in range(kind.ndim)]
    strides = [read(HEAD + kind.ndim + k) for k in range(kind.ndim)]
    return array_of(context, builder, kind, data, shape, strides)


def reader(record_class: type) -> Any:
    """An intrinsic that gives kernels a view of the record of this class at an address, or of its twin at the address of one."""
    views: dict[types.Type, View] = {
        types.uint64: View(record_type(record_class), ""),
        TWIN: View(record_type(record_class, DUAL), " on dual numbers"),
        WHOLE: View(record_type(record_class, DUAL, DUAL), " wholly on dual numbers"),
        PACKED: View(record_type(record_class, PACK, PACK), " on packs"),
    }

    @intrinsic
    def record_at(typingctx: Any, address: Any) -> Any:
        kind = address if address in views else types.uint64

        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return args[0] if kind == types.uint64 else builder.extract_value(args[0], 0)

        return views[kind](kind), generate

    return record_at


@intrinsic
def is_whole(typingctx: Any, address: Any) -> Any:
    """Whether this is the address of a record of which all numbers are dual: a constant of the compiled code."""
    found = address == WHOLE
    return types.boolean(address), lambda context, builder, signature, args: ir.Constant(ir.IntType(1), int(found))
