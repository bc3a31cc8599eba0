"""An entry with its arguments, prepared once: a call of it from Python takes half a microsecond."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.native.entry import Entry
from nivel.native.signature import BROKEN, IN_C, RESULT_IN_C


class BoundEntry:
    """A function that calls an entry with the same addresses and arrays every time, and returns its status.

    arguments : addresses, and arrays where the entry takes vectors, or a dual number. `number` is what it takes as a number; at first 0.
    keep : what the addresses are of, kept alive with it.
    """

    def __init__(self, entry: Entry, arguments: Sequence[int | NDArray[Any]], keep: object = None) -> None:
        self._keep = keep, arguments
        self.number = ctypes.c_double(0.0)
        given, parts, kinds = iter(arguments), [], []
        for word in entry.signature.arguments:
            kinds += IN_C[word]
            if word == "number":
                parts.append(self.number)
            elif isinstance(value := next(given), np.ndarray):
                parts += [ctypes.c_void_p(value.ctypes.data), ctypes.c_int64(value.size)][: len(IN_C[word])]
            else:
                parts.append(IN_C[word][0](int(value)))
        function = ctypes.CFUNCTYPE(RESULT_IN_C[entry.signature.result], *kinds)(entry.address)
        self._call: Any = partial(function, *parts)

    def __call__(self) -> int:
        status: int = self._call()
        if status == BROKEN:
            raise RuntimeError("a kernel has raised an exception, which it must not do: a fault of nivel or of a law")
        return status
