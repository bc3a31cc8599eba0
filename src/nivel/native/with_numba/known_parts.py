"""Array structures whose parts are at hand while code is written.

Numba puts the structure of an array into memory whenever an item is read, and reads its parts back: forty instructions for each access,
which are written, read and optimised away again. Here parts are taken from the structure itself, and where it was put together in the
same function they are those that went into it. The machine code is the same.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.np import arrayobj

_WORD = ir.IntType(64)


def install() -> None:
    """Change Numba, once a process."""
    arrayobj.make_array = _make_array(arrayobj.make_array)
    arrayobj.make_view = _make_view
    arrayobj.fix_integer_index = _fix_integer_index(arrayobj.fix_integer_index)
    cgutils.unpack_tuple = _unpack_tuple(cgutils.unpack_tuple)
    cgutils.get_item_pointer2 = _item_pointer(cgutils.get_item_pointer2)
    proxy: Any = cgutils.ValueStructProxy
    proxy.__init__, proxy.__getitem__ = _given(proxy.__init__), _part(proxy.__getitem__)
    proxy.__getattr__, proxy._getvalue = _place(proxy.__getattr__), _whole(proxy._getvalue)


class Known:
    """An array structure that was given, read part by part; what changes it goes on with Numba's own, in memory."""

    def __init__(
        self, context: Any, builder: Any, kind: types.Array, value: Any, in_memory: Callable[..., Any]
    ) -> None:
        self.__dict__.update(
            _context=context,
            _builder=builder,
            _datamodel=context.data_model_manager[kind],
            _fe_type=kind,
            _value=value,
            _in_memory=in_memory,
            _changed=None,
            _position=_position(builder),
        )

    def __getattr__(self, part: str) -> Any:
        if part.startswith("_"):
            raise AttributeError(part)
        if self._changed is not None:
            return getattr(self._changed, part)
        parts = getattr(self._value, "known_parts", None)
        if parts is not None:
            return parts[part]
        return self._builder.extract_value(self._value, self._datamodel.get_field_position(part))

    def __setattr__(self, part: str, value: Any) -> None:
        setattr(self._memory(), part, value)

    def _memory(self) -> Any:
        if self._changed is None:
            changed = self._in_memory(self._context, self._builder, value=self._value)
            changed._position = self._position
            self.__dict__["_changed"] = changed
        return self._changed

    def _getvalue(self) -> Any:
        return self._value if self._changed is None else self._changed._getvalue()

    def _getpointer(self) -> Any:
        return self._memory()._getpointer()

    def _get_ptr_by_name(self, name: str) -> Any:
        return self._memory()._get_ptr_by_name(name)


def array_of(
    context: Any, builder: Any, kind: types.Array, data: Any, shape: Sequence[Any], strides: Sequence[Any], **rest: Any
) -> Any:
    """The structure of an array of this kind whose items begin at the pointer `data`; strides in bytes. rest : other parts."""
    model = context.data_model_manager[kind]
    size = shape[0] if shape else _WORD(1)
    for count in shape[1:]:
        size = builder.mul(size, count, flags=["nsw"])
    nothing = {name: ir.Constant(context.get_value_type(model.get_type(name)), None) for name in ("meminfo", "parent")}
    parts = {
        "data": data,
        "shape": packed(builder, shape),
        "strides": packed(builder, strides),
        "nitems": size,
        **nothing,
        **rest,
    }
    value: Any = ir.Constant(model.get_value_type(), ir.Undefined)
    for name in model._fields:
        value = builder.insert_value(value, parts[name], model.get_field_position(name))
    value.known_parts = parts
    return value


def packed(builder: Any, items: Sequence[Any]) -> Any:
    """A structure of words."""
    value: Any = ir.Constant(ir.ArrayType(_WORD, len(items)), ir.Undefined)
    for k, item in enumerate(items):
        value = builder.insert_value(value, item, k)
    value.known_items = [*items]
    return value


def _make_array(make_array: Callable[..., Any]) -> Callable[..., Any]:
    def make(kind: Any) -> Any:
        made = make_array(kind)
        if type(kind) is not types.Array:
            return made

        def array(context: Any, builder: Any, value: Any = None, ref: Any = None) -> Any:
            if value is None or ref is not None:
                return made(context, builder, value=value, ref=ref)
            return Known(context, builder, kind, value, made)

        return array

    return make


def _make_view(
    context: Any, builder: Any, kind: Any, array: Any, result: Any, data: Any, shapes: Any, strides: Any
) -> Any:
    rest = {name: getattr(array, name) for name in ("itemsize", "meminfo", "parent")}
    value = array_of(context, builder, result, data, shapes, strides, **rest)
    return arrayobj.make_array(result)(context, builder, value=value)


def _unpack_tuple(unpack: Callable[..., Any]) -> Callable[..., Any]:
    def items(builder: Any, value: Any, count: int | None = None) -> Any:
        known = getattr(value, "known_items", None)
        return unpack(builder, value, count) if known is None else [*known]

    return items


def _fix_integer_index(fix: Callable[..., Any]) -> Callable[..., Any]:
    """Indices count from the end where they are less than zero, which constants tell."""

    def fixed(context: Any, builder: Any, kind: Any, index: Any, size: Any) -> Any:
        if isinstance(index, ir.Constant) and index.type == _WORD and index.constant >= 0:
            return index
        return fix(context, builder, kind, index, size)

    return fixed


def _item_pointer(pointer: Callable[..., Any]) -> Callable[..., Any]:
    """Pointers into contiguous rows, without products by one and sums with zero."""

    def item_pointer(
        context: Any, builder: Any, data: Any, shape: Any, strides: Any, layout: str, inds: Any, **checks: bool
    ) -> Any:
        if layout != "C" or not inds or any(checks.values()):
            return pointer(context, builder, data, shape, strides, layout, inds, **checks)
        behind = [shape[k + 1 :] for k in range(len(inds))]
        places = [
            builder.mul(index, reduce(builder.mul, sizes)) if sizes else index
            for index, sizes in zip(inds, behind, strict=True)
        ]
        return builder.gep(data, [reduce(builder.add, places)])

    return item_pointer


def _given(initialise: Callable[..., Any]) -> Callable[..., Any]:
    """Structures that are given have no place in memory as long as nobody asks for it."""

    def initialise_given(self: Any, context: Any, builder: Any, value: Any = None, ref: Any = None) -> None:
        is_wrapped = isinstance(self._fe_type, types.Array) and type(self._fe_type) is not types.Array
        if value is None or ref is not None or is_wrapped:
            initialise(self, context, builder, value, ref)
            return
        self._context, self._builder, self._whole_value = context, builder, value
        self._position = _position(builder)
        self._datamodel = context.data_model_manager[self._fe_type]
        self._be_type = self._get_be_type(self._datamodel)

    return initialise_given


def _place(get: Callable[..., Any]) -> Callable[..., Any]:
    def part_or_place(self: Any, name: str) -> Any:
        if name in ("_value", "_outer_ref") and "_whole_value" in self.__dict__:
            self._value = self._outer_ref = cgutils.alloca_once(self._builder, self._be_type)
            _store_at(self._builder, self._position, self.__dict__.pop("_whole_value"), self._value)
            return self._value
        return get(self, name)

    return part_or_place


def _position(builder: Any) -> tuple[Any, Any]:
    """Where code is being written: a block, and the instruction before."""
    block, number = builder.basic_block, builder._anchor
    return block, block.instructions[number - 1] if number else None


def _store_at(builder: Any, position: tuple[Any, Any], value: Any, pointer: Any) -> None:
    """Store a value at a position before the present one: whatever way leads here finds it."""
    block, before = position
    present, number, size = builder.basic_block, builder._anchor, len(builder.basic_block.instructions)
    if before is None:
        builder.position_at_start(block)
    else:
        builder.position_after(before)
    builder.store(value, pointer)
    builder._block, builder._anchor = present, number + len(present.instructions) - size


def _part(get: Callable[..., Any]) -> Callable[..., Any]:
    def part(self: Any, number: int) -> Any:
        if (whole := self.__dict__.get("_whole_value")) is None:
            return get(self, number)
        return self._cast_member_to_value(number, self._builder.extract_value(whole, number))

    return part


def _whole(get: Callable[..., Any]) -> Callable[..., Any]:
    def whole(self: Any) -> Any:
        value = self.__dict__.get("_whole_value")
        return get(self) if value is None else value

    return whole
