"""Numba's types of what entries take and return, and of records."""

from __future__ import annotations

from typing import Annotated, Any, get_args, get_origin, get_type_hints

from numba import types

from nivel.native.signature import Signature
from nivel.native.with_numba.duals import DUAL
from nivel.native.with_numba.packs import PACK

# The address of a record whose work is dual numbers: a type of its own, so that kernels compile for it, and never take one for the other.
TWIN = types.UniTuple(types.uint64, 1)
# and that of a record of which all numbers are dual
WHOLE = types.UniTuple(types.uint64, 2)
# and that of a record of which all numbers are packs
PACKED = types.UniTuple(types.uint64, 3)
ROW, DUALS, PACKS = (types.Array(each, 1, "C", aligned=each == types.float64) for each in (types.float64, DUAL, PACK))
ARGUMENTS: dict[str, types.Type] = {
    "machine": types.uint64,
    "twin": TWIN,
    "whole": WHOLE,
    "packed": PACKED,
    "entry": types.uint64,
    "number": types.float64,
    "dual": DUAL,
    "pack": PACK,
    "complex": types.complex128,
    "count": types.int64,
    "vector": ROW,
    "duals": DUALS,
    "packs": PACKS,
}
RESULTS: dict[str, types.Type] = {
    "status": types.int64,
    "number": types.float64,
    "dual": DUAL,
    "pack": PACK,
    "nothing": types.void,
}
SCALARS: dict[str, types.Type] = {
    "plain": types.float64,
    "complex": types.complex128,
    "index": types.uint32,
    "count": types.int64,
    "address": types.uint64,
}


def arguments_of(signature: Signature) -> tuple[types.Type, ...]:
    """Types of the arguments."""
    return tuple(ARGUMENTS[kind] for kind in signature.arguments)


def record_type(record_class: type, work: types.Type = types.float64, real: types.Type = types.float64) -> Any:
    """Numba's type of a record class; `work` is the type of what an evaluation leaves, `real` that of all other numbers (dual numbers for
    exact derivatives, packs for several machines at once)."""
    hints = get_type_hints(record_class, include_extras=True)
    return types.BaseTuple.from_types([_field(hint, work, real) for hint in hints.values()], record_class)


def _field(hint: Any, work: types.Type, real: types.Type) -> types.Type:
    if get_origin(hint) is Annotated:
        _, dimensions, kind = get_args(hint)
        number = {"work": work, "real": real}.get(kind) or SCALARS[kind]
        return types.Array(number, dimensions, "C", aligned=number not in (DUAL, PACK))
    return record_type(hint, work, real)
