"""Records as one block of memory that can be put anywhere: its words, and which of them are addresses."""

import ctypes
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from nivel.analysis.preparation.memory import arrays_of
from nivel.kernels.core.block import Handle

WORD = 8
LINE = 64  # bytes: arrays begin at lines of the cache


class UnknownAddressError(Exception):
    """An address in a record belongs to code that has no name: of a Python law."""


class Image:
    """The memory of the records of these handles.

    words : (·,) uint64, addresses among them 0. inner : place of a word → byte of the memory whose address belongs there. outer : place of
    a word → the symbol whose address belongs there. Memory stands in the order in which the records name it, so the image of a machine is
    the same in every process.
    """

    def __init__(self, handles: Sequence[Handle], symbols: Mapping[int, str]) -> None:
        self._segments = _segments(handles)
        self._starts = [begin for begin, _ in self._segments]
        self._places, size = [0] * len(self._segments), 0
        for k in dict.fromkeys(bisect_right(self._starts, begin) - 1 for begin, _ in _pieces(handles)):
            begin, end = self._segments[k]
            self._places[k] = size
            size += -(-(end - begin) // LINE) * LINE
        self.words = np.zeros(size // WORD, dtype=np.uint64)
        memory = self.words.view(np.uint8)
        for (begin, end), place in zip(self._segments, self._places, strict=True):
            memory[place : place + end - begin] = np.frombuffer(ctypes.string_at(begin, end - begin), dtype=np.uint8)
        self.inner: dict[int, int] = {}
        self.outer: dict[int, str] = {}
        for handle in handles:
            self._relocate(handle, symbols)
        self.words[[*self.inner, *self.outer]] = 0

    def byte_of(self, address: int) -> int:
        """Where in the image stands what is at this address now."""
        found = bisect_right(self._starts, address) - 1
        if found < 0 or address >= self._segments[found][1]:
            raise UnknownAddressError(hex(address))
        return self._places[found] + address - self._starts[found]

    def _relocate(self, handle: Handle, symbols: Mapping[int, str]) -> None:
        word = self.byte_of(int(handle.address)) // WORD
        for array in arrays_of(handle.record):
            if array.nbytes:
                self.inner[word + 4] = self.byte_of(array.ctypes.data)  # behind owner, parent, items, item size
            word += _words(array)
            if array.dtype == np.uint64 and array.nbytes:
                self._relocate_addresses(array, symbols)

    def _relocate_addresses(self, array: Any, symbols: Mapping[int, str]) -> None:
        first = self.byte_of(array.ctypes.data) // WORD
        for k, address in enumerate(int(each) for each in array.ravel()):
            if address in symbols:
                self.outer[first + k] = symbols[address]
            elif address:
                self.inner[first + k] = self.byte_of(address)


def _words(array: Any) -> int:
    """Words of the descriptor of an array, see `nivel.kernels.core.block`."""
    return 5 + 2 * array.ndim


def _pieces(handles: Sequence[Handle]) -> Iterator[tuple[int, int]]:
    """First and last address of every block of descriptors and every array, in the order of the records."""
    for handle in handles:
        arrays = [*arrays_of(handle.record)]
        yield int(handle.address), int(handle.address) + WORD * sum(map(_words, arrays))
        yield from ((array.ctypes.data, array.ctypes.data + array.nbytes) for array in arrays if array.nbytes)


def _segments(handles: Sequence[Handle]) -> list[tuple[int, int]]:
    """First and last address of every stretch of memory in use, in the order of addresses; arrays may be parts of others."""
    out: list[tuple[int, int]] = []
    for begin, end in sorted(_pieces(handles)):
        if out and begin < out[-1][1]:
            out[-1] = (out[-1][0], max(end, out[-1][1]))
        else:
            out.append((begin, end))
    return out
