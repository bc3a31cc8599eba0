"""The residual of the Lagrange equations in three rotation coordinates: rows of (Ṙ, φ̇) of every body.

ω̄ = Ḡ φ̇ and ᾱ = Ḡ φ̈ + Ḡ̇ φ̇ ask for the moment of the Newton–Euler equations; the rows of φ are Ḡᵀ times that.
"""

from __future__ import annotations

from nivel.kernels.algebra.spatial import multiply
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.residual import find_wrenches, write_rows
from nivel.motion.lagrange_three import read_state
from nivel.native.function import stage


@stage
def accelerate_bodies(machine):
    """`residual.acceleration` of all bodies from (R̈, φ̈) in `residual.vdot`."""
    record = record_at(machine)
    bodies, rotations, own = record.bodies, record.rotations, record.residual
    for b in range(bodies.mass.shape[0]):
        x, v, alpha = own.acceleration[b], own.vdot[6 * b : 6 * b + 6], bodies.alpha_b[b]
        multiply(rotations.G[b], v[3:6], alpha)
        for i in range(3):
            alpha[i] += rotations.bias[b, i]
            x[3 + i] = v[i]
        multiply(bodies.A[b], alpha, x[:3])


@stage
def write_bodies(machine):
    """The rows of all bodies from `residual.wrench`, rates of the states of forces, and constraints."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    for b in range(bodies.mass.shape[0]):
        A, F, G = bodies.A[b], own.wrench[b], record.rotations.G[b]
        n0 = A[0, 0] * F[0] + A[1, 0] * F[1] + A[2, 0] * F[2]
        n1 = A[0, 1] * F[0] + A[1, 1] * F[1] + A[2, 1] * F[2]
        n2 = A[0, 2] * F[0] + A[1, 2] * F[1] + A[2, 2] * F[2]
        for i in range(3):
            own.value[6 * b + i] = F[3 + i]
            own.value[6 * b + 3 + i] = G[0, i] * n0 + G[1, i] * n1 + G[2, i] * n2
    write_rows(machine, 6 * bodies.mass.shape[0])


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    status = read_state(machine, t, record.residual.y)
    if status == OK:
        accelerate_bodies(machine)
        status = find_wrenches(machine, t)
    if status == OK:
        write_bodies(machine)
    return status
