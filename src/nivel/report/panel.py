"""Panel of plots in the report: a panel has groups of curves of one unit, of which the reader chooses one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GROUPS = 24  # elements of a panel that can be chosen; more stand in the result file
TOGETHER = 8  # curves that can be told apart in one plot


@dataclass(frozen=True)
class Curve:
    """One curve (n,); `tone` is the place of its colour, "x", "y", "z" or a number."""

    label: str
    values: Array
    tone: str


@dataclass(frozen=True)
class Group:
    """Curves of one unit.

    limits : (value, colour word) of lines that the curves are held against.
    floor : a change of the curves, in their unit, below which they are round-off and drawn flat.
    """

    label: str
    unit: str
    curves: tuple[Curve, ...]
    limits: tuple[tuple[float, str], ...] = ()
    floor: float = 0.0


@dataclass(frozen=True)
class Panel:
    """A plot; with several groups the reader chooses one."""

    title: str
    groups: tuple[Group, ...]
    log: bool = False
    note: str = ""


def left_out(count: int, shown: int = GROUPS) -> str:
    """The note of a panel that shows only some."""
    return f"{count - shown} more in the result file" if count > shown else ""


def components(values: Array) -> Iterator[Curve]:
    """x, y, z of a vector (n, 3)."""
    for k, name in enumerate("xyz"):
        yield Curve(name, values[:, k], name)
