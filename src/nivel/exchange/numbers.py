"""Numbers of a machine file that were computed: to fifteen digits, without what round-off leaves of a zero."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.orientation import euler_parameters_from_matrix

TINY: Final = 1e-16


def number(value: float) -> float:
    """A number to fifteen digits."""
    return 0.0 if abs(value) < TINY else float(f"{value:.15g}")


def triple(values: Iterable[float]) -> list[float]:
    """Three numbers; those that round-off leaves beside larger ones are zero."""
    given = [float(each) for each in values]
    scale = max(map(abs, given), default=0.0)
    return [0.0 if abs(each) < TINY * max(scale, 1.0) else number(each) for each in given]


def turn(axes: NDArray[np.float64]) -> dict[str, Any]:
    """`orientation` for axes (3, 3) of a frame, nothing where they are not turned."""
    if np.abs(axes - np.eye(3)).max() < TINY:
        return {}
    parameters = euler_parameters_from_matrix(axes).tolist()
    return {"orientation": {"euler_parameters": [0.0 if abs(each) < TINY else each for each in parameters]}}
