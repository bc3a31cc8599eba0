"""The inertia invariants I1 … I9 of a flexible body, and what they are computed from.

Rantalainen 2007, eqs (3.59)–(3.67), of mass points p with undeformed position x_p in the body frame and displacement
φ_jp by mode j. Where the mass is not at points but spread over pairs of them (consistent mass of solids), each sum
Σ m_p f_p g_p is the double sum Σ_pq m_pq f_p g_q: the kinetic energy of a velocity field that is interpolated from its
values at the nodes, which is exact, since the interpolation of solid elements commutes with rotations.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg as la

from nivel.flexible.body.body import LeftOut
from nivel.flexible.model.model import Mass, MatrixMass, PointMass, at_nodes, rigid_modes, scalar_part
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody
from nivel.lazy import dataclass, fields
from nivel.machine.core.vectors import Array

LEVI_CIVITA = np.zeros((3, 3, 3))
for _a, _b, _c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    LEVI_CIVITA[_a, _b, _c], LEVI_CIVITA[_a, _c, _b] = 1.0, -1.0


@dataclass(frozen=True)
class Invariants:
    """Inertia invariants of n modes, components in the body frame, about its origin; a tilde is the cross-product matrix.

    I1 : ()  [kg] Σ m
    I2 : (3,)  [kg m] Σ m x
    I3 : (3, n)  [kg^½] Σ m φ_j in column j                 (modes of unit modal mass have the unit kg^-½)
    I4 : (3, n)  [kg^½ m] Σ m x̃ φ_j
    I5 : (n, 3, n)  [-] I5[j] = Σ m φ̃_j Φ; antisymmetric in j and its last index
    I6 : (n, n)  [-] Σ m Φᵀ Φ
    I7 : (3, 3)  [kg m²] Σ m x̃ᵀ x̃
    I8 : (n, 3, 3)  [kg^½ m] Σ m x̃ᵀ φ̃_j
    I9 : (n, n, 3, 3)  [-] I9[j, k] = Σ m φ̃_jᵀ φ̃_k
    """

    I1: float
    I2: Array
    I3: Array
    I4: Array
    I5: Array
    I6: Array
    I7: Array
    I8: Array
    I9: Array

    def of_modes(self, change: Array) -> Invariants:
        """The invariants of the modes Φ `change`, (n, k)."""
        C = change
        return Invariants(
            self.I1,
            self.I2,
            self.I3 @ C,
            self.I4 @ C,
            np.einsum("jak,jl,km->lam", self.I5, C, C, optimize=True),
            C.T @ self.I6 @ C,
            self.I7,
            np.einsum("jab,jl->lab", self.I8, C),
            np.einsum("jkab,jl,km->lmab", self.I9, C, C, optimize=True),
        )


UNITS = {
    "I1": "kg",
    "I2": "kg m",
    "I3": "kg^0.5",
    "I4": "kg^0.5 m",
    "I5": "1",
    "I6": "1",
    "I7": "kg m^2",
    "I8": "kg^0.5 m",
    "I9": "1",
}
assert set(UNITS) == {field.name for field in fields(Invariants)}


def tilde(v: Array) -> Array:
    """(…, 3, 3) cross-product matrix: tilde(v) @ w = v × w."""
    return -np.einsum("abc,...c->...ab", LEVI_CIVITA, v)


def of_points(position: Array, displacement: Array, weight) -> Invariants:
    """The invariants of points at (p, 3) [m] that modes displace by (p, 3, n), with masses (p, p) sparse, or (p,)."""
    if getattr(weight, "ndim", 2) == 1:
        weighed = [weight[:, None] * displacement[:, a] for a in range(3)]
        mx = weight[:, None] * position
        total = float(weight.sum())
    else:
        weighed = [weight @ np.ascontiguousarray(displacement[:, a]) for a in range(3)]
        mx = weight @ position
        total = float(weight.sum())
    xx = position.T @ mx
    phi = np.stack([each.sum(axis=0) for each in weighed])
    xphi = np.stack([position.T @ each for each in weighed], axis=1)  # [a, b, j] Σ m x_a φ_bj
    # [a, b, j, k] Σ m φ_aj φ_bk
    phiphi = np.stack([[displacement[:, a].T @ each for each in weighed] for a in range(3)])
    return _assembled(total, mx.sum(axis=0), phi, xx, xphi, phiphi)


def _assembled(total: float, first: Array, phi: Array, xx: Array, xphi: Array, phiphi: Array) -> Invariants:
    one = np.eye(3)
    trace = np.einsum("aajk->jk", phiphi)
    return Invariants(
        I1=total,
        I2=first,
        I3=phi,
        I4=np.einsum("abc,bcj->aj", LEVI_CIVITA, xphi),
        I5=np.einsum("abc,bcjk->jak", LEVI_CIVITA, phiphi),
        I6=trace,
        I7=np.trace(xx) * one - xx,
        I8=np.einsum("ccj,ab->jab", xphi, one) - np.einsum("baj->jab", xphi),
        I9=np.einsum("jk,ab->jkab", trace, one) - np.einsum("bajk->jkab", phiphi),
    )


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
