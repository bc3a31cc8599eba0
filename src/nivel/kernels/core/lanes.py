"""Slopes of dual numbers, for kernels that seed and read them.

unit(k, size) is the dual number 0 with this slope along direction k, slope(x, k) the slope of x along it.
"""

from __future__ import annotations

from typing import Any

from nivel.native.function import Intrinsic


def _unit() -> Any:
    from nivel.native.with_numba.duals import unit

    return unit


def _slope() -> Any:
    from nivel.native.with_numba.duals import slope

    return slope


unit, slope = Intrinsic(_unit), Intrinsic(_slope)
