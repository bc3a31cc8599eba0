"""Records whose arrays lie one behind the other in one piece of memory, so that a moment of them is kept and brought back by one copy."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

ALIGNED: Final = 64  # bytes: a line of the cache


def in_one_piece(record: Any) -> tuple[Any, NDArray[np.uint8]]:
    """The record with all its arrays but addresses of machine code in one piece of memory, and that piece (bytes). What are the same
    arrays in it stay the same."""
    arrays: dict[int, NDArray[Any]] = {}
    _collect(record, arrays)
    places, size = {}, 0
    for key, array in arrays.items():
        places[key], size = size, size + -(-array.nbytes // ALIGNED) * ALIGNED
    piece = np.zeros(size + ALIGNED, np.uint8)
    piece = piece[-piece.ctypes.data % ALIGNED :][:size]
    own = {}
    for key, array in arrays.items():
        own[key] = piece[places[key] : places[key] + array.nbytes].view(array.dtype).reshape(array.shape)
        own[key][...] = array
    return _with(record, own), piece


def _collect(record: Any, arrays: dict[int, NDArray[Any]]) -> None:
    for field in record:
        if isinstance(field, tuple):
            _collect(field, arrays)
        elif field.size and field.dtype != np.uint64:
            arrays.setdefault(id(field), field)


def _with(record: Any, own: dict[int, NDArray[Any]]) -> Any:
    fields = (_with(field, own) if isinstance(field, tuple) else own.get(id(field), field) for field in record)
    return type(record)(*fields)
