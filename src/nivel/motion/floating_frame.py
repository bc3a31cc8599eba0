"""Absolute coordinates with flexible bodies: Newton–Euler equations, and modes of flexible bodies in floating frames.

State y = (R, θ of every body; p; Ṙ, ω̄ of every body; ṗ; states of forces; work, dissipated energy).
"""

from __future__ import annotations

from nivel.kernels.algebra.spatial import multiply
from nivel.kernels.bodies.floating_dynamics import (
    flexible_wrench,
    gather,
    unwhiten_flexible,
    whiten_flexible_forces,
    whiten_flexible_rows,
)
from nivel.kernels.bodies.floating_frame import accelerate_frames, add_bias, bend, move_frames
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family, finish_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, POINTS, record_at
from nivel.kernels.residual.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.solve.saddle import factorise_rows, multipliers
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.newton_euler import (
    WIDTH,
    change_body,
    normalise,
    read_bodies,
    read_markers,
    unwhiten,
    whiten_forces,
    whiten_rows,
    write_rate,
)
from nivel.native.entry import entry
from nivel.native.function import shared, stage


@stage
def read_flexible_state(machine, t, y):
    """Poses and velocities of bodies, frames at interfaces and markers, and all constraint rows. Returns a status."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    nb, modes = bodies.mass.shape[0], own.p.shape[0]
    first = 7 * nb + modes
    read_bodies(bodies, y, first)
    for j in range(modes):
        own.p[j], own.pdot[j] = y[7 * nb + j], y[first + 6 * nb + j]
    bend(machine)
    status = read_markers(machine, t)
    add_bias(machine)
    return status


@stage
def factorise(machine, y):
    """W = C_q L⁻ᵀ of rigid and flexible bodies, and the factor of S; y is not needed for them here. Returns a status."""
    whiten_rows(machine)
    status = whiten_flexible_rows(machine)
    return factorise_rows(machine, WIDTH) if status == OK else status


@stage
def unwhiten_all(machine):
    """Accelerations of all bodies and modes from z; also their changes in a correction."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        if record.flexible.rigid[b] == 1:
            unwhiten(record.bodies, record.saddle, b)
    unwhiten_flexible(machine)


@shared
def accelerate(machine, t, y, ydot):
    """Multipliers, accelerations of all bodies, modes and frames, and the rates of the states of forces and energies, from the state read
    before. Returns a status."""
    load_weight(record_at(machine).bodies)
    status = apply_forces(machine, t, y)
    if status != OK:
        return status
    gather(machine)
    status = factorise(machine, y)
    if status != OK:
        return status
    whiten_forces(machine)
    whiten_flexible_forces(machine)
    status = multipliers(machine, WIDTH)
    if status == OK:
        status = finish_forces(machine, t, ydot)
    if status != OK:
        return status
    unwhiten_all(machine)
    accelerate_frames(machine)
    return OK


@stage
def write_rates(machine, ydot):
    """(Ṙ, θ̇, ṗ, R̈, ᾱ, p̈) of ẏ."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    nb, modes = bodies.mass.shape[0], own.p.shape[0]
    first = 7 * nb + modes
    for b in range(nb):
        write_rate(bodies, ydot, b, first)
    for j in range(modes):
        ydot[7 * nb + j], ydot[first + 6 * nb + j] = own.pdot[j], own.pddot[j]


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ. Leaves everything else in the record."""
    status = read_flexible_state(machine, t, y)
    if status == OK:
        status = accelerate(machine, t, y, ydot)
    if status == OK:
        write_rates(machine, ydot)
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing because A is taken of θ/|θ|."""
    normalise(machine, y)
    return OK


@stage
def read_normalised_state(machine, t, y):
    """The state, with Euler parameters of unit length. Returns a status."""
    normalise(machine, y)
    return read_flexible_state(machine, t, y)


@stage
def apply_change(machine, y, what):
    """Apply the change found to (R, θ, p) or to (Ṙ, ω̄, ṗ)."""
    record = record_at(machine)
    nb, modes = record.bodies.mass.shape[0], record.flexible.p.shape[0]
    first = 7 * nb + modes
    unwhiten_all(machine)
    for b in range(nb):
        change_body(record, y, b, first, what == POSITIONS)
    at = 7 * nb if what == POSITIONS else first + 6 * nb
    for j in range(modes):
        y[at + j] += record.flexible.pddot[j]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_normalised_state, factorise, apply_change)


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    status = read_flexible_state(machine, t, own.y)
    if status != OK:
        return status
    load_weight(bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    count = bodies.mass.shape[0]
    for b in range(count):
        x, v = own.acceleration[b], own.vdot[6 * b : 6 * b + 6]
        multiply(bodies.A[b], v[3:6], x[:3])
        for i in range(3):
            x[3 + i] = v[i]
    for j in range(flexible.p.shape[0]):
        flexible.pddot[j] = own.vdot[6 * count + j]
    move_frames(machine)
    status = load_multipliers(machine, t)
    if status != OK:
        return status
    status = call_hook(machine, POINTS, 0, t)
    if status != OK:
        return status
    gather(machine)
    inertial_wrenches(machine)
    for f in range(flexible.body.shape[0]):
        flexible_wrench(bodies, flexible, f, own.acceleration, own.wrench, own.value[6 * count :])
    for b in range(count):
        A, F = bodies.A[b], own.wrench[b]
        for i in range(3):
            own.value[6 * b + i] = F[3 + i]
            own.value[6 * b + 3 + i] = A[0, i] * F[0] + A[1, i] * F[1] + A[2, i] * F[2]
    write_rows(machine, 6 * count + flexible.p.shape[0])
    return OK
