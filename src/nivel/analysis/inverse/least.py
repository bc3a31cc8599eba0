"""Efforts that do what is asked with the least weighted norm, within limits."""

from __future__ import annotations

import numpy as np
from scipy.optimize import nnls

from nivel.lazy import dataclass
from nivel.system.system import Array

# singular values below this share of the largest are zero
RANK = 1e-9
# what limits leave undone below this share of what is asked is round-off
DONE = 1e-9


@dataclass(frozen=True)
class Least:
    """efforts (m,). missing (f,) : what of the generalised forces no efforts give. rank : of the matrix. limited : whether limits hold some
    back from doing what is asked."""

    efforts: Array
    missing: Array
    rank: int
    limited: bool


def least_efforts(A: Array, b: Array, weights: Array, low: Array, high: Array, reach: Array) -> Least:
    """τ with A τ = b (A (f, m)), or as near as can be, of least Σ (w τ)², low ≤ τ ≤ high (infinite where there is none).

    reach (m,) : size of the columns of A if nothing were held; what is left of one below RANK of it is nothing.
    Without limits by the singular value decomposition; with limits as a least-distance problem (Lawson, Hanson 1974, ch. 23).
    """
    U, size, Vt = np.linalg.svd(A / weights, full_matrices=True)
    least = RANK * max(float(np.max(reach / weights, initial=0.0)), float(np.max(size, initial=0.0)), 1e-300)
    rank = int(np.sum(size > least))
    part = Vt[:rank].T @ ((U[:, :rank].T @ b) / size[:rank])
    free = Vt[rank:].T
    tau = part / weights
    if np.any(tau < low) or np.any(tau > high):
        tau = _within(part, free, weights, low, high)
    missing = b - A @ tau
    outside = b - U[:, :rank] @ (U[:, :rank].T @ b)
    scale = max(float(np.abs(b).max(initial=0.0)), 1e-300)
    limited = bool(np.abs(missing - outside).max(initial=0.0) > DONE * scale)
    return Least(tau, missing, rank, limited)


def _within(part: Array, free: Array, weights: Array, low: Array, high: Array) -> Array:
    """Efforts part + free y (weighted) of least norm within the limits; cut off where no y keeps them."""
    rows, right = [], []
    for sign, bound in ((1.0, low), (-1.0, high)):
        for k in np.flatnonzero(np.isfinite(bound)):
            scale = weights[k]
            rows.append(sign * free[k] / scale)
            right.append(sign * (bound[k] - part[k] / scale))
    y = _least_distance(np.array(rows), np.array(right)) if free.shape[1] else None
    tau = (part + free @ y if y is not None else part) / weights
    return np.clip(tau, low, high)


def _least_distance(G: Array, h: Array) -> Array | None:
    """y of least norm with G y ≥ h; None where there is none."""
    size = np.maximum(np.linalg.norm(np.column_stack([G, h]), axis=1), 1e-300)
    E = np.vstack([(G / size[:, None]).T, h / size])
    f = np.zeros(len(E))
    f[-1] = 1.0
    u, _ = nnls(E, f)
    r = E @ u - f
    return None if np.linalg.norm(r) < 1e-10 else -r[:-1] / r[-1]
