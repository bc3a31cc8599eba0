"""Facts of a prepared machine beside the memory of its records: what its trust report reads, and no patch reaches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any, Final

import numpy as np

from nivel.analysis.preparation.preparation import Prepared

# what a variant has of its own: the memory, and the machine as it is written
OWN: Final = ("record", "machine", "beams", "kernels", "twin")


def other_fact(a: Prepared, b: Prepared) -> str:
    """The first fact in which two machines differ, as `assembly.y`; empty where they do so in their memory alone, and in how they are
    written."""
    return _other(a, b, "")


def _other(a: Any, b: Any, name: str) -> str:
    if a is b:
        return ""
    if is_dataclass(a) and type(a) is type(b):
        own = (each.name for each in fields(a) if each.name not in OWN)
        return next(filter(None, (_other(getattr(a, each), getattr(b, each), f"{name}.{each}") for each in own)), "")
    return "" if _same(a, b) else name.removeprefix(".")


def _same(a: Any, b: Any) -> bool:
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return bool(np.array_equal(a, b, equal_nan=a.dtype.kind == "f"))
    if isinstance(a, Mapping):
        return a.keys() == b.keys() and all(_same(value, b[key]) for key, value in a.items())
    if isinstance(a, tuple | list):
        return len(a) == len(b) and all(map(_same, a, b))
    return not _other(a, b, "it") if is_dataclass(a) else bool(a == b)
