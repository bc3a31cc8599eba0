"""Signatures of entries: what they take and return, and the same in C.

machine   the address of a record              uint64_t
twin      the same, its work dual numbers      uint64_t
whole     the same, all its numbers dual       uint64_t
entry     the address of another entry         uint64_t
packed    the same, all its numbers packs      uint64_t
number    a real number                        double
dual      a dual number, see `nivel.native.duals`   double *
pack      a pack, see `nivel.native.packs`     double *
complex   a complex number                     double, double
count     an integer                           int64_t
vector    a row of real numbers                double *, int64_t
duals     a row of dual numbers                double *, int64_t
packs     a row of packs                       double *, int64_t
status    of `nivel.kernels.core.status`            int64_t
nothing   0, for Python nothing                int64_t
"""

from __future__ import annotations

import ctypes
from typing import Any, Final, NamedTuple

import numpy as np

from nivel.native.duals import DUAL

IN_C: dict[str, tuple[Any, ...]] = {
    "machine": (ctypes.c_uint64,),
    "twin": (ctypes.c_uint64,),
    "whole": (ctypes.c_uint64,),
    "packed": (ctypes.c_uint64,),
    "entry": (ctypes.c_uint64,),
    "number": (ctypes.c_double,),
    "dual": (ctypes.c_void_p,),
    "pack": (ctypes.c_void_p,),
    "complex": (ctypes.c_double, ctypes.c_double),
    "count": (ctypes.c_int64,),
    "vector": (ctypes.c_void_p, ctypes.c_int64),
    "duals": (ctypes.c_void_p, ctypes.c_int64),
    "packs": (ctypes.c_void_p, ctypes.c_int64),
}
ROWS: Final = {"vector": np.dtype(np.float64), "duals": DUAL}
# what stands for the address of a record, a real number and a row of these where the same code runs on other numbers
ON: Final = {
    "twin": {"machine": "twin", "number": "dual", "vector": "duals"},
    "whole": {"machine": "whole", "number": "dual", "vector": "duals"},
    "packed": {"machine": "packed", "number": "pack", "vector": "packs"},
}
RESULT_IN_C: dict[str, Any] = {"status": ctypes.c_int64, "number": ctypes.c_double, "nothing": ctypes.c_int64}
# status of an entry in which something was raised, which kernels must not do; a number is then none
BROKEN = -1


class Signature(NamedTuple):
    """Kinds of the result and of the arguments."""

    result: str
    arguments: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.result}({', '.join(self.arguments)})"

    def on(self, numbers: str) -> Signature:
        """That of the same code on other numbers, for records that are a `twin`, `whole` or `packed`."""
        result, *arguments = (ON[numbers].get(kind, kind) for kind in (self.result, *self.arguments))
        return Signature(result, tuple(arguments))

    def function_at(self, address: int) -> Any:
        """The entry at this address as a function of Python; it runs without the interpreter's lock."""
        kinds = [kind for argument in self.arguments for kind in IN_C[argument]]
        function = ctypes.CFUNCTYPE(RESULT_IN_C[self.result], *kinds)(address)

        def call(*arguments: Any) -> Any:
            if len(arguments) != len(self.arguments):
                raise TypeError(f"{len(self.arguments)} arguments are needed, {len(arguments)} given")
            values = zip(self.arguments, arguments, strict=True)
            result = function(*(part for kind, value in values for part in _parts(kind, value)))
            if self.result != "number" and result == BROKEN:
                raise RuntimeError(
                    "a kernel has raised an exception, which it must not do: a fault of nivel or of a law"
                )
            return None if self.result == "nothing" else result

        return call


def _parts(kind: str, value: Any) -> tuple[Any, ...]:
    """An argument as C takes it."""
    if kind in ROWS:
        if value.dtype != ROWS[kind] or value.ndim != 1 or not value.flags.c_contiguous:
            raise TypeError(f"a {kind} is a contiguous row of {ROWS[kind].name}")
        return value.ctypes.data, value.size
    if kind == "dual":
        if value.dtype != DUAL or value.size != 1:
            raise TypeError("a dual is an array of one dual number")
        return (value.ctypes.data,)
    if kind == "complex":
        value = complex(value)
        return value.real, value.imag
    return (float(value),) if kind == "number" else (int(value),)


# the code of laws and expressions, of all that they depend on
LAW = Signature("number", ("vector",))
