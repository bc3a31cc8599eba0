"""Absolute coordinates with flexible bodies, Lagrange equations in three rotation coordinates: q = (R, φ of every body; p), v = q̇.

As for rigid bodies (`nivel.motion.lagrange_three`): the mass matrix is Tᵀ M T with that of (Ṙ, ω̄, ṗ) and T = diag(1, Ḡ, 1), so whitened
rows and forces, and the multipliers, are those of the Newton–Euler equations.
"""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.floating_frame import add_bias, bend
from nivel.kernels.record import correct_signature, evaluate_signature, record_at
from nivel.kernels.status import OK
from nivel.motion.floating_frame import accelerate
from nivel.motion.lagrange_three import find_singular, first_rate, read_bodies, write_rate
from nivel.motion.newton_euler import read_markers


@stage
def read_flexible_state(machine, t, y):
    """Poses and velocities of bodies, frames at interfaces and markers, and all constraint rows. Returns a status."""
    record = record_at(machine)
    own, nb, v = record.flexible, record.bodies.mass.shape[0], first_rate(record)
    read_bodies(machine, y)
    for j in range(own.p.shape[0]):
        own.p[j], own.pdot[j] = y[6 * nb + j], y[v + 6 * nb + j]
    bend(machine)
    status = read_markers(machine, t)
    add_bias(machine)
    singular = find_singular(machine)
    return status if singular == OK else singular


@entry(evaluate_signature)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (R, φ of every body; p; Ṙ, φ̇ of every body; ṗ; x). Leaves everything else in the record."""
    record = record_at(machine)
    own, nb, v = record.flexible, record.bodies.mass.shape[0], first_rate(record)
    status = read_flexible_state(machine, t, y)
    if status == OK:
        status = accelerate(machine, t, y, ydot)
    if status != OK:
        return status
    for b in range(nb):
        write_rate(machine, y, ydot, b)
    for j in range(own.p.shape[0]):
        ydot[6 * nb + j], ydot[v + 6 * nb + j] = own.pdot[j], own.pddot[j]
    return OK


@entry(correct_signature)
def keep(machine, t, y):
    """No correction: three coordinates have nothing to keep."""
    return OK
