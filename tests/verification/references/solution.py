"""Solution of y' = f(t, y) by DOP853 that goes on as far as it is asked for and is kept, so that many tests share one."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853, OdeSolution

Array = NDArray[np.float64]


class Solution:
    """y(t) from `start` at t = `begin`; its steps do not depend on the times that it is asked for.

    Between its steps DOP853 interpolates at seventh order.
    """

    def __init__(self, slope: Callable[[float, Array], Any], begin: float, start: Any, *, rtol: float, atol: float):
        self._solver = DOP853(slope, begin, np.asarray(start, dtype=float), np.inf, rtol=rtol, atol=atol)
        self._ends, self._pieces = [begin], []

    def __call__(self, times: Array) -> Array:
        """(size of y, n) at `times` (n,). Raises RuntimeError where a step fails."""
        while self._ends[-1] < times.max() or not self._pieces:
            message = self._solver.step()
            if self._solver.status == "failed":
                raise RuntimeError(message)
            self._ends.append(self._solver.t)
            self._pieces.append(self._solver.dense_output())
        return OdeSolution(self._ends, self._pieces)(times)
