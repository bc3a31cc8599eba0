"""The kinds of arrays in a record, and the Numba type of a record class.

A record is a NamedTuple of C-contiguous arrays and further records. Its array kinds never depend on the machine, so the
compiled code does not either. Indices are uint32: signed ones cost a wrap-around test at every access.
"""

from __future__ import annotations

from typing import Annotated, Any, get_args, get_origin, get_type_hints

import numpy as np
from numba import types
from numpy.typing import NDArray

F1 = Annotated[NDArray[np.float64], 1, "real"]
F2 = Annotated[NDArray[np.float64], 2, "real"]
F3 = Annotated[NDArray[np.float64], 3, "real"]
# what an evaluation leaves: complex where it runs on complex numbers, for exact derivatives
W1 = Annotated[NDArray[np.float64], 1, "work"]
W2 = Annotated[NDArray[np.float64], 2, "work"]
W3 = Annotated[NDArray[np.float64], 3, "work"]
# complex in the record of real numbers too
C1 = Annotated[NDArray[np.complex128], 1, "complex"]
C2 = Annotated[NDArray[np.complex128], 2, "complex"]
U1 = Annotated[NDArray[np.uint32], 1, "index"]
U2 = Annotated[NDArray[np.uint32], 2, "index"]
I1 = Annotated[NDArray[np.int64], 1, "count"]
A1 = Annotated[NDArray[np.uint64], 1, "address"]

SCALARS = {
    "real": types.float64,
    "complex": types.complex128,
    "index": types.uint32,
    "count": types.int64,
    "address": types.uint64,
}


def numba_type(record_class: type, work: types.Type = types.float64) -> Any:
    """Numba type of a record class; `work` is the type of what an evaluation leaves (complex128 for exact derivatives)."""
    hints = get_type_hints(record_class, include_extras=True)
    return types.BaseTuple.from_types([_field(hint, work) for hint in hints.values()], record_class)


def _field(hint: Any, work: types.Type) -> types.Type:
    if get_origin(hint) is Annotated:
        _, dimensions, kind = get_args(hint)
        return types.Array(work if kind == "work" else SCALARS[kind], dimensions, "C")
    return numba_type(hint, work)


def complex_twin(record: Any) -> Any:
    """The record with complex copies of what an evaluation leaves; everything else is shared."""
    hints = get_type_hints(type(record), include_extras=True)
    fields = {}
    for name, hint in hints.items():
        value = getattr(record, name)
        if get_origin(hint) is not Annotated:
            fields[name] = complex_twin(value)
        else:
            fields[name] = value.astype(np.complex128) if get_args(hint)[2] == "work" else value
    return type(record)(**fields)
