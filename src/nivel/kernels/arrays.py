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
U1 = Annotated[NDArray[np.uint32], 1, "index"]
U2 = Annotated[NDArray[np.uint32], 2, "index"]
I1 = Annotated[NDArray[np.int64], 1, "count"]
A1 = Annotated[NDArray[np.uint64], 1, "address"]

SCALARS = {"real": types.float64, "index": types.uint32, "count": types.int64, "address": types.uint64}


def numba_type(record_class: type, real: types.Type = types.float64) -> Any:
    """Numba type of a record class; `real` replaces the dtype of its real arrays (complex128 for exact tangents)."""
    hints = get_type_hints(record_class, include_extras=True)
    return types.BaseTuple.from_types([_field(hint, real) for hint in hints.values()], record_class)


def _field(hint: Any, real: types.Type) -> types.Type:
    if get_origin(hint) is Annotated:
        _, dimensions, kind = get_args(hint)
        return types.Array(real if kind == "real" else SCALARS[kind], dimensions, "C")
    return numba_type(hint, real)
