"""Geometric stiffening of flexible bodies, as displacements of the second order in the modes.

A unit load whose stress has the geometric stiffness K on the modes does work on the displacement -½ pᵀ K p, along which a bent bar is
shortened. So the first moment of the mass, its inertia and the nodes at interfaces get terms of the second order: with the load cases of
Wallrapp & Schwertassek 1991 (`nivel.flexible.stiffening`), for accelerations a, α and for ω_a ω_b per unit,

    S_i + ½ pᵀ K_ai p        C_i + (K_αi p)ᵀ        J̄: ω̄ᵀ ΔJ̄ ω̄ = -pᵀ Σ ω_a ω_b K_ab p        u_k - ½ pᵀ K_k p

and from these, by Lagrange's equations, the stiffening K_g p with the accelerations that the body really has, a symmetric mass matrix, and
an energy that is kept.
"""

from __future__ import annotations

from nivel.kernels.compile import leaf, stage
from nivel.kernels.spatial import cross

# ω_a ω_b of the six matrices
FIRST_AXIS, SECOND_AXIS = (0, 1, 2, 0, 1, 2), (0, 1, 2, 1, 2, 0)


@leaf
def product(K, x, y, first, n):
    """xᵀ K y of one body's part of modal vectors."""
    total = 0.0 * x[first]
    for j in range(n):
        row = 0.0 * x[first]
        for k in range(n):
            row += K[j, k] * y[first + k]
        total += x[first + j] * row
    return total


@stage
def add_shortening(own, f, first, n):
    """Terms of the second order in the first moment, the inertia and the coupling of flexible body f."""
    S, J, B = own.first[f], own.inertia[f], own.coupling[f]
    for i in range(3):
        Ka, Kt = own.of_acceleration[3 * f + i], own.of_turning[3 * f + i]
        for j in range(n):
            along, about = 0.0 * own.p[first], 0.0 * own.p[first]
            for k in range(n):
                along += Ka[j, k] * own.p[first + k]
                about += Kt[j, k] * own.p[first + k]
            S[i] += 0.5 * own.p[first + j] * along
            B[i, j] += along
            B[3 + i, j] += about
    for c in range(6):
        a, b = FIRST_AXIS[c], SECOND_AXIS[c]
        value = product(own.of_spin[6 * f + c], own.p, own.p, first, n)
        if a == b:
            J[a, a] -= value
        else:
            J[a, b] -= 0.5 * value
            J[b, a] -= 0.5 * value


@stage
def add_velocity_forces(own, f, w, first, n, out):
    """Quadratic velocity forces of these terms, on the frame into out (6,), on the modes into `Q`. w : ω̄."""
    drift, spin = own.drift[f], own.spin[f]
    for i in range(3):
        Ka, Kt = own.of_acceleration[3 * f + i], own.of_turning[3 * f + i]
        out[i] -= product(Ka, own.pdot, own.pdot, first, n)
        out[3 + i] -= product(Kt, own.pdot, own.pdot, first, n)
        # ΔṠ and ΔC ṗ
        drift[i] = product(Ka, own.p, own.pdot, first, n)
        spin[i] = product(Kt, own.p, own.pdot, first, n)
    coriolis, gyroscopic = cross(w, drift), cross(w, spin)
    for i in range(3):
        out[i] -= 2.0 * coriolis[i]
        out[3 + i] -= gyroscopic[i]
    for c in range(6):
        a, b = FIRST_AXIS[c], SECOND_AXIS[c]
        K, share = own.of_spin[6 * f + c], w[a] * w[b]
        for j in range(n):
            force = 0.0 * own.p[first]
            for k in range(n):
                force += K[j, k] * own.p[first + k]
            own.Q[first + j] -= share * force
        rate = product(K, own.p, own.pdot, first, n)
        # -ΔJ̄' ω̄
        if a == b:
            out[3 + a] += 2.0 * rate * w[a]
        else:
            out[3 + a] += rate * w[b]
            out[3 + b] += rate * w[a]
