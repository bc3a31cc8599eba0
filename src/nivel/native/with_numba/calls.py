"""Calling convention of entries, seen from both sides: calls at addresses, and the functions that stand there."""

from __future__ import annotations

import ctypes
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from nivel.native.signature import IN_C, RESULT_IN_C, Signature
from nivel.native.with_numba.arrays import WORD, array_of, item_pointer, item_size
from nivel.native.with_numba.duals import DUAL
from nivel.native.with_numba.kinds import ARGUMENTS, PACKED, PACKS, RESULTS, TWIN, WHOLE, arguments_of

_DOUBLE = ir.DoubleType()
# of what C takes
_IN_LLVM = {
    ctypes.c_uint64: WORD,
    ctypes.c_int64: WORD,
    ctypes.c_double: _DOUBLE,
    ctypes.c_void_p: _DOUBLE.as_pointer(),
}
# numbers that are vectors, handed over by their addresses
VECTORS = ("dual", "pack")
_ROWS = ("vector", "duals", "packs")
# words of the address of a record, as Numba has it
_COPIES = {"twin": 1, "whole": 2, "packed": 3}
# bytes; vectors that C hands over may stand anywhere a double may
ALIGNMENT = 8


def function_type(signature: Signature) -> Any:
    """The type of the C function of an entry. A result that is a vector is written to an address that goes before the arguments."""
    arguments = [_IN_LLVM[part] for kind in signature.arguments for part in IN_C[kind]]
    if signature.result in VECTORS:
        return ir.FunctionType(ir.VoidType(), [_DOUBLE.as_pointer(), *arguments])
    return ir.FunctionType(_IN_LLVM[RESULT_IN_C[signature.result]], arguments)


def to_c(context: Any, builder: Any, kind: str, value: Any) -> list[Any]:
    """An argument as C takes it."""
    if kind in _COPIES:
        return [builder.extract_value(value, 0)]
    if kind in VECTORS:
        return [builder.bitcast(cgutils.alloca_once_value(builder, value), _DOUBLE.as_pointer())]
    if kind == "complex":
        return [builder.extract_value(value, 0), builder.extract_value(value, 1)]
    if kind in _ROWS:
        array = context.make_array(ARGUMENTS[kind])(context, builder, value)
        return [builder.bitcast(array.data, _DOUBLE.as_pointer()), builder.extract_value(array.shape, 0)]
    return [value]


def from_c(context: Any, builder: Any, kind: str, parts: list[Any]) -> Any:
    """An argument as Numba has it."""
    if kind in _COPIES:
        count = _COPIES[kind]
        value: Any = ir.Constant(ir.ArrayType(WORD, count), ir.Undefined)
        for k in range(count):
            value = builder.insert_value(value, parts[0], k)
        return value
    if kind in VECTORS:
        vector = context.get_value_type(ARGUMENTS[kind])
        return builder.load(builder.bitcast(parts[0], vector.as_pointer()), align=ALIGNMENT)
    if kind == "complex":
        pair = context.make_complex(builder, types.complex128)
        pair.real, pair.imag = parts
        return pair._getvalue()
    if kind in _ROWS:
        array: Any = ARGUMENTS[kind]
        data = builder.bitcast(parts[0], item_pointer(context, array))
        return array_of(context, builder, array, data, [parts[1]], [ir.Constant(WORD, item_size(context, array))])
    return parts[0]


def _for(arguments: tuple[Any, ...], plain: Signature) -> Signature:
    """The signature of the code for these arguments: that on dual numbers or packs where a record or a row is of these."""
    if WHOLE in arguments:
        return plain.on("whole")
    if PACKED in arguments or PACKS in arguments:
        return plain.on("packed")
    of_duals = any(kind == TWIN or getattr(kind, "dtype", None) == DUAL for kind in arguments)
    return plain.on("twin") if of_duals else plain


def caller(plain: Signature) -> Any:
    """An intrinsic `call(address, ...)` for the entry of this signature at an address, or of its code on dual numbers or packs where its
    arguments are of these."""

    def call(arguments: tuple[Any, ...]) -> tuple[Any, Any]:
        signature = _for(arguments, plain)
        kinds = arguments_of(signature)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            parts = []
            for kind, value, given, wanted in zip(signature.arguments, args[1:], sig.args[1:], kinds, strict=True):
                parts += to_c(context, builder, kind, context.cast(builder, value, given, wanted))
            function = builder.inttoptr(args[0], function_type(signature).as_pointer())
            if signature.result in VECTORS:
                place = cgutils.alloca_once(builder, context.get_value_type(RESULTS[signature.result]))
                builder.call(function, [builder.bitcast(place, _DOUBLE.as_pointer()), *parts])
                return builder.load(place)
            result = builder.call(function, parts)
            return context.get_dummy_value() if signature.result == "nothing" else result

        return RESULTS[signature.result](types.uint64, *arguments), generate

    # Numba reads off the function how many arguments there are
    names = ", ".join(f"argument_{k}" for k in range(len(plain.arguments)))
    function = eval(f"lambda typingctx, address, {names}: call(({names},))", {"call": call})
    function.__name__ = function.__qualname__ = f"call_{plain.result}"
    return intrinsic(function)
