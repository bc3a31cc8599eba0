"""Linear systems: from transfer functions to states, and exact values after a sample."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class LinearSystem(NamedTuple):
    """ẋ = A x + B u, y = C x + D u: A (n, n), B (n, m), C (p, n), D (p, m)."""

    A: Array
    B: Array
    C: Array
    D: Array


def of_transfer_function(numerator: tuple[float, ...], denominator: tuple[float, ...]) -> LinearSystem:
    """States of b(s)/a(s), coefficients of falling powers of s, the numerator of no higher degree; a(s) begins with no zero.

    Controllable canonical form in s/w, w the size of the poles, so that all states are of the size of the input (Kailath 1980, §2.1).
    """
    a = np.array(denominator, dtype=float)
    n = len(a) - 1
    b = np.concatenate([np.zeros(n + 1 - len(numerator)), numerator]) / a[0]
    a = a / a[0]
    w = max((abs(a[i]) ** (1.0 / i) for i in range(1, n + 1)), default=1.0) or 1.0
    powers = w ** np.arange(n + 1)
    a, b = a / powers, b / powers
    A = np.zeros((n, n))
    A[:1] = -a[1:]
    A[1:, :-1] = np.eye(max(n - 1, 0))
    B = np.zeros((n, 1))
    B[:1] = 1.0
    return LinearSystem(w * A, w * B, (b[1:] - b[0] * a[1:]).reshape(1, n), b[:1].reshape(1, 1))


def sampled(system: LinearSystem, period: float) -> LinearSystem:
    """The exact system after a period [s] in which u holds: [A_d B_d; 0 1] = exp([A B; 0 0] T)."""
    from scipy.linalg import expm

    n, m = system.B.shape
    block = np.zeros((n + m, n + m))
    block[:n, :n], block[:n, n:] = system.A * period, system.B * period
    exact = np.asarray(expm(block), dtype=np.float64)
    return LinearSystem(exact[:n, :n], exact[:n, n:], system.C, system.D)


def steady_state(system: LinearSystem, value: float) -> Array | None:
    """(n,) the smallest steady state, with some constant input, in which the first output has this value; None where there is none."""
    n = len(system.A)
    matrix = np.block([[system.A, system.B], [system.C[:1], system.D[:1]]])
    right = np.append(np.zeros(n), value)
    solution = np.asarray(np.linalg.lstsq(matrix, right, rcond=None)[0], dtype=np.float64)
    if not np.allclose(matrix @ solution, right, rtol=1e-9, atol=1e-9 * abs(value)):
        return None
    return solution[:n]
