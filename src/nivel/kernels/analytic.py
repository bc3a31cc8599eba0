"""Functions that stay analytic when a kernel runs on complex numbers (exact tangents by complex step).

Comparison, `abs` and `norm` of complex numbers either fail in Numba or drop the derivative; these branch on real parts.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf


@leaf
def real(x):
    """Real part: what a branch may look at."""
    return np.real(x)
