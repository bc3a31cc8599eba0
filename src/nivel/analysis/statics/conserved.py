"""Conserved combinations of states in an equilibrium: fluid that is shut in.

Rates ẋ = g(q, v, x) of states whose equations depend on each other do not fix these. With u from the left null space of the derivatives
of g at rest, uᵀ ẋ depends on velocities alone, so

    uᵀ (x - x₀) = uᵀ ∂g/∂v (q - q₀)

holds on every way that the machine may have come: Σ m of volumes behind closed valves stays, or goes from one side of a motor to the other
as it turns. This takes the place of uᵀ g = 0.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import svd

from nivel.analysis.statics.equations import Sparse
from nivel.system.system import Array

# Singular values of derivatives, with rows of the size one, that are none.
DEPENDENT = 1e-11
# More states than this are looked at one by one only: those whose own row is zero.
MOST = 400


def kept_combinations(rates: Sparse) -> Array:
    """(S, k) orthonormal combinations of the rates that depend on nothing at rest. rates : derivatives (S, ·), rows of the size one."""
    count = rates.shape[0]
    if not 0 < count <= MOST:
        return np.zeros((count, 0))
    left, values, _ = svd(rates.toarray())
    rank = int(np.sum(values > DEPENDENT * values.max(initial=0.0)))
    return left[:, rank:]
