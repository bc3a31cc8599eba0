"""The next modes of a finer basis, which a reduction leaves out, from the finite-element model; see `LeftOut`."""

from __future__ import annotations

import numpy as np
import scipy.linalg as la
from numpy.typing import NDArray

from nivel.flexible.body.mass_invariants import invariants
from nivel.flexible.body.truncated_modes import LeftOut
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody

Array = NDArray[np.float64]
DEPENDENT = 1e-8  # share of the mass of a vector that is left beside kept modes, below which it is one of them


def left_out(body: FreeBody, modes: Array, candidates: Array, nodes: Whole) -> LeftOut:
    """The modes that `candidates` (N, c) add to the `modes` (N, n) of a body; nodes : of its interfaces."""
    Z, eigenvalues = _diagonal(body, candidates)
    phi = np.nan_to_num(body.model.node_motion(Z)[nodes])
    its = invariants(body.model.mass, Z)
    return LeftOut(eigenvalues, phi, Z.T @ (body.M @ modes), Z.T @ (body.K @ modes), its.I3, its.I4, its.I8)


def beside_kept(body: FreeBody, kept: Array, candidates: Array) -> Array:
    """(N, c) what `candidates` move beside rigid motions and the orthonormal modes `kept` (N, n); those that are nothing else left out."""
    spanned = np.hstack([body.rigid, kept])
    weight = np.einsum("ij,ij->j", candidates, body.M @ candidates)
    unit = candidates[:, weight > 0.0] / np.sqrt(weight[weight > 0.0])
    for _ in range(2):  # twice is enough (Parlett, Kahan)
        unit = unit - spanned @ (spanned.T @ (body.M @ unit))
    return unit[:, np.einsum("ij,ij->j", unit, body.M @ unit) > DEPENDENT]


def _diagonal(body: FreeBody, vectors: Array) -> tuple[Array, Array]:
    """Modes (N, k) of unit modal mass in the span of `vectors`, and their eigenvalues."""
    mass = vectors.T @ (body.M @ vectors)
    values, turned = la.eigh(0.5 * (mass + mass.T)) if vectors.shape[1] else (np.zeros(0), np.zeros((0, 0)))
    keep = values > DEPENDENT * values.max(initial=0.0)
    spanned = vectors @ (turned[:, keep] / np.sqrt(values[keep]))
    stiffness = spanned.T @ (body.K @ spanned)
    if not spanned.shape[1]:
        return spanned, np.zeros(0)
    eigenvalues, turned = la.eigh(0.5 * (stiffness + stiffness.T))
    return spanned @ turned, eigenvalues
