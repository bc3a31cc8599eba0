"""Numbers of the records of a prepared machine, all behind each other, to compare and to overwrite them."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.preparation.roles import Leaf, Role, leaves

Array = NDArray[np.float64]

AGREES: Final = 1e-11  # share of its scale by which numbers of machines that are the same may differ


class UnlikeError(Exception):
    """Machines that differ in more than numbers. name : an array. kind : `count` of its numbers, or `whole` numbers."""

    def __init__(self, name: str, kind: str) -> None:
        super().__init__(name, kind)
        self.name, self.kind = name, kind


class MachineMemory:
    """The arrays of records, and all their real numbers behind each other, n of them."""

    def __init__(self, *records: Any, **named: Any) -> None:
        """named : records whose names their arrays have before their own."""
        given = [*(("", record) for record in records), *named.items()]
        self.leaves: list[Leaf] = [leaf for name, record in given for leaf in leaves(record, name)]
        self.real = [leaf for leaf in self.leaves if leaf.array.dtype == np.float64]
        self._starts = np.cumsum([0, *(leaf.array.size for leaf in self.real)])

    @property
    def numbers(self) -> Array:
        """(n,) all real numbers."""
        return np.concatenate([np.zeros(0), *(leaf.array.ravel() for leaf in self.real)])

    @cached_property
    def workspace(self) -> NDArray[np.bool_]:
        """(n,) whether a number is that."""
        return np.concatenate([np.zeros(0, dtype=bool), *(leaf.workspace.ravel() for leaf in self.real)])

    def has(self, role: Role) -> NDArray[np.bool_]:
        """(n,) whether a number stands in an array with this role."""
        return np.repeat([leaf.role is role for leaf in self.real], [leaf.array.size for leaf in self.real])

    @cached_property
    def left(self) -> NDArray[np.bool_]:
        """(n,) whether a number has no part in what follows from parameters."""
        return self.workspace | self.has(Role.BEGUN)

    @cached_property
    def scales(self) -> Array:
        """(n,) what round-off of each number is measured by: the largest of its row, or itself."""
        out = [np.zeros(0)]
        for leaf in self.real:
            size = np.abs(np.where(np.isfinite(leaf.array), leaf.array, 0.0))
            if leaf.scale is not None:
                size = np.maximum(size, leaf.scale)
            elif leaf.role is Role.STATE and not leaf.mixed:
                size = np.full_like(size, size.max(initial=0.0))
            elif size.ndim > 1 and size.size and not leaf.mixed:
                rows = size.reshape(len(size), -1)
                size = np.broadcast_to(rows.max(axis=1, keepdims=True), rows.shape)
            out.append(size.ravel())
        return np.concatenate(out)

    def name_of(self, place: int) -> str:
        """The array in which a number stands."""
        return self.real[int(np.searchsorted(self._starts, place, side="right")) - 1].name

    def arrays_of(self, numbers: Array) -> list[Array]:
        """Numbers (n,) in the form of the arrays, zeros of those that have none."""
        parts = iter(np.split(numbers, self._starts[1:-1]))
        forms = [leaf.array.shape for leaf in self.leaves]
        is_real = [leaf.array.dtype == np.float64 for leaf in self.leaves]
        return [
            next(parts).reshape(form) if real else np.zeros(form) for form, real in zip(forms, is_real, strict=True)
        ]

    def put(self, places: NDArray[np.intp], values: Array) -> None:
        """Overwrite some numbers."""
        numbers = self.numbers
        numbers[places] = values
        for leaf, part in zip(self.leaves, self.arrays_of(numbers), strict=True):
            if leaf.array.dtype == np.float64:
                leaf.array[...] = part

    @property
    def addresses(self) -> NDArray[np.int64]:
        """(n,) where each number stands."""
        spans = [leaf.array.ctypes.data + 8 * np.arange(leaf.array.size) for leaf in self.real]
        return np.concatenate([np.zeros(0, dtype=np.int64), *spans])

    def refuse_unlike(self, other: MachineMemory) -> None:
        """Raise UnlikeError where another machine differs in more than real numbers."""
        for mine, theirs in zip(self.leaves, other.leaves, strict=True):
            if mine.array.shape != theirs.array.shape:
                raise UnlikeError(mine.name, "count")
            if mine.array.dtype.kind in "fc" or mine.name.endswith("newton.address"):  # of records
                continue
            if (mine.array != theirs.array)[~mine.workspace].any():
                raise UnlikeError(mine.name, "whole")

    def differences(self, numbers: Array, other: MachineMemory) -> list[str]:
        """Arrays in which given numbers and states `numbers` (n,) are not those of another machine. Raises UnlikeError."""
        self.refuse_unlike(other)
        wanted, scale = other.numbers, np.maximum(self.scales, other.scales)
        both = np.isfinite(numbers) & np.isfinite(wanted)
        apart = np.abs(np.where(both, numbers, 0.0) - np.where(both, wanted, 0.0)) > AGREES * scale
        same = np.where(both, ~apart, (numbers == wanted) | (np.isnan(numbers) & np.isnan(wanted)))
        return list(dict.fromkeys(self.name_of(int(place)) for place in np.flatnonzero(~same & ~self.left)))
