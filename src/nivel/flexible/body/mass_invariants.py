"""Inertia invariants of a finite-element model and the next modes of a finer basis, from its mass. They need SciPy; reading does not."""

import numpy as np
import scipy.linalg as la

from nivel.flexible.body.body import LeftOut
from nivel.flexible.body.invariants import Invariants, of_points, tilde
from nivel.flexible.model.model import Mass, MatrixMass, PointMass, at_nodes, rigid_modes, scalar_part
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody
from nivel.machine.core.vectors import Array


def invariants(mass: Mass, modes: Array) -> Invariants:
    """The invariants of `modes`, (N, n) in the freedoms of the model."""
    if isinstance(mass, PointMass):
        return of_points(mass.position, (mass.shape @ modes).reshape(len(mass.position), 3, -1), mass.weight)
    return _of_matrix(mass, modes)


def _of_matrix(mass: MatrixMass, modes: Array) -> Invariants:
    """I1 … I4, I6, I7 and the antisymmetric part of I8 from the whole matrix by its rigid motions (exact for any matrix);
    I5, I9 and the symmetric part of I8, which turn the deformation with the body, from the mean translational mass.

    The antisymmetric part of I8 follows from I8_j - I8_jᵀ = -(I4_j)~, without which no energy would be kept.
    """
    full = modes if mass.transformation is None else mass.transformation @ modes
    points = of_points(
        mass.position,
        (at_nodes(mass.freedoms, mass.full.shape[0]) @ full).reshape(len(mass.position), 3, -1),
        scalar_part(mass),
    )
    R = rigid_modes(mass.position, mass.freedoms, mass.full.shape[0])
    rigid, coupling = R.T @ (mass.full @ R), R.T @ (mass.full @ full)
    first = rigid[:3, 3:]  # of a body: -(I2)~
    symmetric = 0.5 * (points.I8 + points.I8.transpose(0, 2, 1))
    return Invariants(
        I1=float(np.trace(rigid[:3, :3])) / 3.0,
        I2=0.5 * np.array([first[1, 2] - first[2, 1], first[2, 0] - first[0, 2], first[0, 1] - first[1, 0]]),
        I3=coupling[:3],
        I4=coupling[3:],
        I5=points.I5,
        I6=full.T @ (mass.full @ full),
        I7=rigid[3:, 3:],
        I8=symmetric - 0.5 * tilde(coupling[3:].T),
        I9=points.I9,
    )


BESIDE_OTHERS = 1e-8  # share of the mass of a vector that is left beside kept modes, below which it is one of them


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
    return unit[:, np.einsum("ij,ij->j", unit, body.M @ unit) > BESIDE_OTHERS]


def _diagonal(body: FreeBody, vectors: Array) -> tuple[Array, Array]:
    """Modes (N, k) of unit modal mass in the span of `vectors`, and their eigenvalues."""
    mass = vectors.T @ (body.M @ vectors)
    values, turned = la.eigh(0.5 * (mass + mass.T)) if vectors.shape[1] else (np.zeros(0), np.zeros((0, 0)))
    keep = values > BESIDE_OTHERS * values.max(initial=0.0)
    spanned = vectors @ (turned[:, keep] / np.sqrt(values[keep]))
    stiffness = spanned.T @ (body.K @ spanned)
    if not spanned.shape[1]:
        return spanned, np.zeros(0)
    eigenvalues, turned = la.eigh(0.5 * (stiffness + stiffness.T))
    return spanned @ turned, eigenvalues
