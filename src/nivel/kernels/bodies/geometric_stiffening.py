"""Geometric stiffening of flexible bodies, as displacements of the second order in the modes.

A unit load whose stress has the geometric stiffness K on the modes does work on the displacement -½ pᵀ K p, along which a bent bar is
shortened. So the first moment of the mass, its inertia and the nodes at interfaces get terms of the second order: with the load cases of
Wallrapp & Schwertassek 1991 (`nivel.flexible.reduction.bases`), for accelerations a, α and for ω_a ω_b per unit,

    S_i + ½ pᵀ K_ai p        C_i + (K_αi p)ᵀ        J̄: ω̄ᵀ ΔJ̄ ω̄ = -pᵀ Σ ω_a ω_b K_ab p        u_k - ½ pᵀ K_k p

and from these, by Lagrange's equations, the stiffening K_g p with the accelerations that the body really has, a symmetric mass matrix, and
an energy that is kept.
"""

from nivel.native.function import leaf, stage

# axes of the six components of a symmetric tensor
FIRST_AXIS, SECOND_AXIS = (0, 1, 2, 0, 1, 2), (0, 1, 2, 1, 2, 0)


@leaf
def multiply_rows(K, base, x, first, n, out, width):
    """out (width,) = Σ x[first + k] K[base + k] over n rows, two at a time."""
    for j in range(width):
        out[j] = 0.0
    k = 0
    while k + 1 < n:
        a, b, one, other = x[first + k], x[first + k + 1], K[base + k], K[base + k + 1]
        for j in range(width):
            out[j] += a * one[j] + b * other[j]
        k += 2
    if k < n:
        a, one = x[first + k], K[base + k]
        for j in range(width):
            out[j] += a * one[j]


@stage
def add_shortening(own, f, first, n):
    """Terms of the second order in the first moment and the coupling of flexible body f; its inertia has them in `of_inertia`."""
    S, B, along, most = own.first[f], own.coupling[f], own.scratch[0], own.I3.shape[2]
    multiply_rows(own.of_acceleration, f * most, own.p, first, n, along, 3 * most)
    for i in range(3):
        row = along[i * most : i * most + n]
        total = 0.0 * own.p[first]
        for j in range(n):
            total += own.p[first + j] * row[j]
            B[i, j] += row[j]
        S[i] += 0.5 * total


@stage
def add_velocity_forces(own, f, first, n, out):
    """What the modal velocities do on the frame by these terms, into out (6,)."""
    along, across, most = own.scratch[0], own.scratch[1], own.I3.shape[2]
    multiply_rows(own.of_acceleration, f * most, own.pdot, first, n, along, 3 * most)
    multiply_rows(own.of_turning, f * most, own.pdot, first, n, across, 3 * most)
    for i in range(3):
        force, moment = 0.0 * own.p[first], 0.0 * own.p[first]
        for j in range(n):
            force += own.pdot[first + j] * along[i * most + j]
            moment += own.pdot[first + j] * across[i * most + j]
        out[i] -= force
        out[3 + i] -= moment
