"""Equations of motion of a flexible body, written in NumPy from its invariants: the reference that compiled kernels are held against.

Floating frame of reference, Rantalainen 2007. A point with undeformed position x in the body frame is at
r = R + A (x + Φ q). Velocities v = (Ṙ global, ω̄ in body axes, q̇), forces of the same length; `with_euler_parameters`
turns them to the document's (Ṙ, θ̇, q̇). Frame and normalisation of the modes: see `body.ReducedBody`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.invariants import Invariants, tilde

Array = NDArray[np.float64]


def inertia(invariants: Invariants, q: Array) -> Array:
    """(3, 3) [kg m²] J̄ of the deformed body about the origin of its frame, body axes: I7 + (I8 + I8ᵀ) q + I9 q q."""
    linear = np.einsum("jab,j->ab", invariants.I8, q)
    return invariants.I7 + linear + linear.T + np.einsum("jkab,j,k->ab", invariants.I9, q, q)


def mass_matrix(invariants: Invariants, A: Array, q: Array) -> Array:
    """(6 + n, 6 + n) in (Ṙ, ω̄, q̇). Eqs (3.50)–(3.58) without Ḡ."""
    n = len(q)
    out = np.zeros((6 + n, 6 + n), dtype=np.result_type(A, q, 1.0))
    out[:3, :3] = invariants.I1 * np.eye(3)
    out[:3, 3:6] = -A @ tilde(invariants.I2 + invariants.I3 @ q)
    out[:3, 6:] = A @ invariants.I3
    out[3:6, 3:6] = inertia(invariants, q)
    out[3:6, 6:] = invariants.I4 + np.einsum("jak,j->ak", invariants.I5, q)
    out[6:, 6:] = invariants.I6
    lower = np.tril_indices(6 + n, -1)
    out[lower] = out.T[lower]
    return out


def quadratic_velocity(invariants: Invariants, A: Array, omega_b: Array, q: Array, qdot: Array) -> Array:
    """(6 + n,) Q_v on the right-hand side: M v̇ = Q_v + Q_e - K q - D q̇.

    From the invariants, by differentiating the kinetic energy; equal to -Σ m Lᵀ L̇ v.
    """
    w, I8, I9 = tilde(omega_b), invariants.I8, invariants.I9
    static = np.einsum("ab,b->a", inertia(invariants, q), omega_b)
    rate = np.einsum("jab,j->ab", I8 + np.einsum("kjab,k->jab", I9, q), qdot)
    spread = I8.transpose(0, 2, 1) + np.einsum("jkab,k->jab", I9, q)
    return np.concatenate(
        [
            -A @ (w @ w @ (invariants.I2 + invariants.I3 @ q) + 2.0 * w @ (invariants.I3 @ qdot)),
            -(w @ static + 2.0 * rate @ omega_b),
            np.einsum("a,jab,b->j", omega_b, spread, omega_b)
            + 2.0 * np.einsum("a,jak,k->j", omega_b, invariants.I5, qdot),
        ]
    )


def kinetic_energy(invariants: Invariants, A: Array, q: Array, v: Array) -> float:
    """[J]"""
    return float(0.5 * v @ mass_matrix(invariants, A, q) @ v)


def gravity_force(invariants: Invariants, A: Array, q: Array, gravity: Array) -> Array:
    """(6 + n,) of the acceleration of free fall, (3,) [m/s²] global axes."""
    g_b = A.T @ gravity
    return np.concatenate(
        [invariants.I1 * gravity, tilde(invariants.I2 + invariants.I3 @ q) @ g_b, invariants.I3.T @ g_b]
    )


def point_force(A: Array, position_b: Array, phi: Array, psi: Array, q: Array, force: Array, torque: Array) -> Array:
    """(6 + n,) of a force and a torque, (3,) global axes, at a node: x, its modes phi (3, n) and turns psi (3, n).

    Eq. (3.82) with the work that torques do on the turn of the node by its modes.
    """
    f_b, t_b = A.T @ force, A.T @ torque
    return np.concatenate([force, np.cross(position_b + phi @ q, f_b) + t_b, phi.T @ f_b + psi.T @ t_b])


def elastic_force(stiffness: Array, q: Array) -> Array:
    """(6 + n,) of the (n,) modal stiffnesses [1/s²]."""
    return np.concatenate([np.zeros(6), -stiffness * q])


def damping_force(damping: Array, qdot: Array) -> Array:
    """(6 + n,) of the (n,) modal damping [1/s]: 2 ζ ω of a damping ratio ζ, or α + β ω² of Rayleigh's."""
    return np.concatenate([np.zeros(6), -damping * qdot])


def stiffening(terms: dict[str, Array], acceleration_b: Array, alpha_b: Array, omega_b: Array) -> Array:
    """(n, n) [1/s²] geometric stiffness for the motion of the frame, body axes.

    terms : `acceleration` (3, n, n), `angular_acceleration` (3, n, n), `centrifugal` (6, n, n) for ω_x², ω_y², ω_z²,
    ω_x ω_y, ω_y ω_z, ω_z ω_x. acceleration_b : of the origin less gravity, Aᵀ (R̈ - g) [m/s²].
    """
    w = omega_b
    pairs = np.array([w[0] ** 2, w[1] ** 2, w[2] ** 2, w[0] * w[1], w[1] * w[2], w[2] * w[0]])
    return (
        np.einsum("i,ijk->jk", acceleration_b, terms["acceleration"])
        + np.einsum("i,ijk->jk", alpha_b, terms["angular_acceleration"])
        + np.einsum("i,ijk->jk", pairs, terms["centrifugal"])
    )


def direct_mass_matrix(position: Array, displacement: Array, weight, A: Array, q: Array) -> Array:
    """(6 + n, 6 + n) the sum Σ_pq m_pq L_pᵀ L_q over points, eq. (3.44); the arguments as of `invariants.of_points`."""
    count, _, n = displacement.shape
    L = np.zeros((count, 3, 6 + n))
    L[:, :, :3] = np.eye(3)
    L[:, :, 3:6] = -A @ tilde(position + displacement @ q)
    L[:, :, 6:] = A @ displacement
    out = np.zeros((6 + n, 6 + n))
    for a in range(3):
        weighed = weight[:, None] * L[:, a] if getattr(weight, "ndim", 2) == 1 else weight @ L[:, a]
        out += L[:, a].T @ weighed
    return out


def transformation(theta: Array) -> Array:
    """(3, 4) Ḡ, eq. (3.14): ω̄ = Ḡ θ̇."""
    e0, e1, e2, e3 = theta
    return 2.0 * np.array([[-e1, e0, e3, -e2], [-e2, -e3, e0, e1], [-e3, e2, -e1, e0]])


def with_euler_parameters(matrix: Array, theta: Array) -> Array:
    """A mass matrix (6 + n, 6 + n) as (7 + n, 7 + n) in (Ṙ, θ̇, q̇)."""
    n = len(matrix) - 6
    T = np.zeros((6 + n, 7 + n), dtype=np.result_type(matrix, theta))
    T[:3, :3], T[3:6, 3:7], T[6:, 7:] = np.eye(3), transformation(theta), np.eye(n)
    return T.T @ matrix @ T
