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


@leaf
def norm(x):
    """Euclidean length √(xᵀx) of a vector, without conjugation."""
    total = x[0] * x[0]
    for i in range(1, x.shape[0]):
        total += x[i] * x[i]
    return np.sqrt(total)
