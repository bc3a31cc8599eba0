"""The inertia invariants I1 … I9 of a flexible body, and what they are computed from.

Rantalainen 2007, eqs (3.59)–(3.67), of mass points p with undeformed position x_p in the body frame and displacement
φ_jp by mode j. Where the mass is not at points but spread over pairs of them (consistent mass of solids), each sum
Σ m_p f_p g_p is the double sum Σ_pq m_pq f_p g_q: the kinetic energy of a velocity field that is interpolated from its
values at the nodes, which is exact, since the interpolation of solid elements commutes with rotations.
"""

import numpy as np

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

LEVI_CIVITA = np.zeros((3, 3, 3))
for _a, _b, _c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    LEVI_CIVITA[_a, _b, _c], LEVI_CIVITA[_a, _c, _b] = 1.0, -1.0


class Invariants(Struct):
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

    def of_modes(self, change: Array) -> "Invariants":
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
