"""The kinds of arrays in a record.

A record is a NamedTuple of C-contiguous arrays and further records. Its array kinds never depend on the machine, so the
compiled code does not either. Indices are uint32: signed ones cost a wrap-around test at every access.
"""

from __future__ import annotations

from typing import Annotated, Any, get_args, get_origin, get_type_hints

import numpy as np
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
