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

# axes of the six components of a symmetric tensor
FIRST_AXIS, SECOND_AXIS = (0, 1, 2, 0, 1, 2), (0, 1, 2, 1, 2, 0)


@leaf
def add_product(K, x, first, n, out):
    """out += Kᵀ x for one body's part of a modal vector."""
    for k in range(n):
        share, row = x[first + k], K[k]
        for j in range(n):
            out[j] += share * row[j]


@leaf
def add_products(K, x, y, first, n, along, across):
    """along += Kᵀ x, across += Kᵀ y."""
    for k in range(n):
        share, other, row = x[first + k], y[first + k], K[k]
        for j in range(n):
            along[j] += share * row[j]
            across[j] += other * row[j]


@stage
def add_shortening(own, f, first, n):
    """Terms of the second order in the first moment and the coupling of flexible body f; its inertia has them in `of_inertia`."""
    S, B, along = own.first[f], own.coupling[f], own.scratch[0]
    for i in range(3):
        for j in range(n):
            along[j] = 0.0
        add_product(own.of_acceleration[3 * f + i], own.p, first, n, along)
        for j in range(n):
            S[i] += 0.5 * own.p[first + j] * along[j]
            B[i, j] += along[j]


@stage
def add_velocity_forces(own, f, first, n, out):
    """What the modal velocities do on the frame by these terms, into out (6,)."""
    along, across = own.scratch[0], own.scratch[1]
    for i in range(3):
        for j in range(n):
            along[j], across[j] = 0.0, 0.0
        add_product(own.of_acceleration[3 * f + i], own.pdot, first, n, along)
        add_product(own.of_turning[3 * f + i], own.pdot, first, n, across)
        for j in range(n):
            out[i] -= own.pdot[first + j] * along[j]
            out[3 + i] -= own.pdot[first + j] * across[j]
