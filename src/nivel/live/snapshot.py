"""Whole states of a run: copies of all arrays that its kernels read or write, put back exactly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Snapshot(NamedTuple):
    """A state. ticks : done until then."""

    ticks: int
    arrays: list[NDArray[Any]]


def arrays_of(records: Sequence[Any]) -> list[NDArray[Any]]:
    """All arrays of nested records, each once."""
    found: dict[int, NDArray[Any]] = {}
    for record in records:
        for array in _leaves(record):
            found.setdefault(id(array), array)
    return [each for each in found.values() if each.size]


def _leaves(record: Any) -> Iterator[NDArray[Any]]:
    for field in record:
        if isinstance(field, tuple):
            yield from _leaves(field)
        else:
            yield field


def taken(arrays: Sequence[NDArray[Any]], ticks: int) -> Snapshot:
    """A copy of the arrays."""
    return Snapshot(ticks, [array.copy() for array in arrays])


def put_back(arrays: Sequence[NDArray[Any]], snapshot: Snapshot) -> None:
    """Let the arrays be what they were."""
    for array, kept in zip(arrays, snapshot.arrays, strict=True):
        np.copyto(array, kept)
