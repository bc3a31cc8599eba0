"""The three ways a function of nivel is compiled.

leaf     small arithmetic; LLVM decides about inlining.
stage    a part of one evaluation; always inlined, because a call would copy the descriptors of every array of the record.
entry    what Python or another entry calls: an explicit signature, cached on disk, without the interpreter lock.

An entry is compiled (or loaded from the cache) when its module is imported, so a module is imported by the path that needs it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import njit, types

leaf: Callable[..., Any] = njit(error_model="numpy", _nrt=False)
stage: Callable[..., Any] = njit(error_model="numpy", forceinline=True, _nrt=False)


def entry(signature: types.abstract.Type | Any) -> Callable[..., Any]:
    """Decorator: compile now for `signature`, keep the machine code in the cache."""
    return njit(signature, error_model="numpy", nogil=True, cache=True, _nrt=False)
