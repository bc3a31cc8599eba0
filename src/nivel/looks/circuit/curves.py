"""Curves of a valve, and the laws of flow and opening that they are drawn by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BAR, LITRE_PER_MINUTE = 1e5, 1e-3 / 60.0
POINTS: Final = 121


@dataclass(frozen=True)
class Curve:
    """x as its axis says, y [L/min]."""

    label: str
    x: Array
    y: Array


@dataclass(frozen=True)
class Chart:
    """The curves of one valve. across : what x is, with its unit."""

    name: str
    type: str
    across: str
    curves: tuple[Curve, ...]


def root(difference: Array | float, corner: float) -> Any:
    """Δp (Δp² + c²)^(-1/4)."""
    return difference * (np.asarray(difference) ** 2 + corner**2) ** -0.25


def step(t: Array) -> Array:
    """3 t² - 2 t³, from 0 to 1."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def constant(value: object) -> float | None:
    """A setting that does not vary."""
    return float(value) if isinstance(value, float | int) else None
