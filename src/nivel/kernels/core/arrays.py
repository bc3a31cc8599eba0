"""The kinds of arrays in a record.

A record is a NamedTuple of C-contiguous arrays and further records. Its array kinds never depend on the machine, so the
compiled code does not either. Indices are uint32: signed ones cost a wrap-around test at every access.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Annotated, Any, Final, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from nivel.native.duals import LANES, duals

F1 = Annotated[NDArray[np.float64], 1, "real"]
F2 = Annotated[NDArray[np.float64], 2, "real"]
F3 = Annotated[NDArray[np.float64], 3, "real"]
# real numbers everywhere: what has no slopes, as the factors of a matrix that only makes an iteration contract
P2 = Annotated[NDArray[np.float64], 2, "plain"]
# what an evaluation leaves: dual numbers where it runs on these, for exact derivatives
W1 = Annotated[NDArray[np.float64], 1, "work"]
W2 = Annotated[NDArray[np.float64], 2, "work"]
W3 = Annotated[NDArray[np.float64], 3, "work"]
# complex numbers everywhere
C1 = Annotated[NDArray[np.complex128], 1, "complex"]
C2 = Annotated[NDArray[np.complex128], 2, "complex"]
U1 = Annotated[NDArray[np.uint32], 1, "index"]
U2 = Annotated[NDArray[np.uint32], 2, "index"]
I1 = Annotated[NDArray[np.int64], 1, "count"]
A1 = Annotated[NDArray[np.uint64], 1, "address"]
# kinds that may be other numbers
NUMBERS: Final = ("real", "work")


def changed(record: Any, change: Callable[[str, Any], Any]) -> Any:
    """The record with change(kind, array) in place of each array."""
    kinds = zip(_kinds(type(record)), record, strict=True)
    return type(record)(*(changed(x, change) if kind == "record" else change(kind, x) for kind, x in kinds))


def dual_twin(record: Any) -> Any:
    """The record with dual numbers for what an evaluation leaves, without slopes yet; everything else is shared."""
    return changed(record, lambda kind, array: duals(array) if kind == "work" else array)


def whole_twin(record: Any) -> Any:
    """The record with dual numbers for all its numbers, without slopes yet; what are the same arrays in it, are the same in the twin."""
    known: dict[tuple[Any, ...], Any] = {}

    def twin(kind: str, value: Any) -> Any:
        if kind not in NUMBERS:
            return known.setdefault((id(value),), value.copy())
        place = (value.ctypes.data, value.shape) if value.size else (id(value),)
        return known.setdefault(place, duals(value))

    return changed(record, twin)


def lanes_of(twin: Any) -> Any:
    """A twin with its dual numbers as lanes (…, 1 + LANES) of the same memory, for Python."""
    return changed(twin, lambda kind, array: _lanes(array) if kind == "work" else array)


def copied(record: Any) -> Any:
    """The record with arrays of its own; what are the same arrays in it, are the same in the copy."""
    return _copied(record, {})


def _copied(record: Any, known: dict[int, NDArray[Any]]) -> Any:
    fields = (
        _copied(field, known) if isinstance(field, tuple) else known.setdefault(id(field), field.copy())
        for field in record
    )
    return type(record)(*fields)


@cache
def _kinds(record_class: type) -> tuple[str, ...]:
    """What each field of a record is: its kind of array, or `record`."""
    hints = get_type_hints(record_class, include_extras=True)
    return tuple(
        get_args(hints[name])[2] if get_origin(hints[name]) is Annotated else "record"
        for name in record_class._fields  # type: ignore[attr-defined]
    )


def _lanes(array: Any) -> Any:
    return array.view(np.float64).reshape(*array.shape, 1 + LANES)
