"""Independent coordinates with flexible bodies: the embedding technique on the velocities (Ṙ, ω̄) of all bodies and ṗ of all modes.

As for rigid bodies (`nivel.motion.independent`); modes are independent wherever the machine without them determines its dependent
velocities. The state is that of `nivel.motion.floating_frame`, which finds the accelerations where there is friction in joints.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, stage
from nivel.kernels.embedding import embed, generalised_forces
from nivel.kernels.floating_dynamics import factorise_frames, gather
from nivel.kernels.floating_frame import accelerate_frames
from nivel.kernels.hook import apply_forces, finish_forces
from nivel.kernels.partition import divide, solve_dependent, solve_multipliers
from nivel.kernels.record import correct_signature, evaluate_signature, record_at
from nivel.kernels.rigid import load_weight
from nivel.kernels.status import OK
from nivel.motion.floating_frame import evaluate as evaluate_newton_euler
from nivel.motion.floating_frame import read_flexible_state, write_rates
from nivel.motion.independent import MOST_PASSES, close
from nivel.motion.newton_euler import normalise


@stage
def read_factorised(machine, t, y):
    """The state, and the factors of the floating frames, by which dependent rows are weighed. Returns a status."""
    status = read_flexible_state(machine, t, y)
    return factorise_frames(machine) if status == OK else status


@stage
def take_accelerations(machine):
    """Accelerations of bodies, modes and frames from those of the partition."""
    record = record_at(machine)
    bodies, own, acceleration = record.bodies, record.flexible, record.partition.v
    nb = bodies.mass.shape[0]
    for b in range(nb):
        for i in range(3):
            bodies.Rddot[b, i], bodies.alpha_b[b, i] = acceleration[6 * b + i], acceleration[6 * b + 3 + i]
    for j in range(own.p.shape[0]):
        own.pddot[j] = acceleration[6 * nb + j]
    accelerate_frames(machine)


@entry(evaluate_signature)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x). Leaves everything else in the record."""
    record = record_at(machine)
    if record.friction.columns.shape[0] > 0:
        return evaluate_newton_euler(machine, t, y, ydot)
    rank = np.int64(record.control.rank[0])
    status = read_factorised(machine, t, y)
    if status != OK:
        return status
    load_weight(record.bodies)
    status = apply_forces(machine, t, y)
    if status != OK:
        return status
    gather(machine)
    status = divide(machine)
    if status != OK:
        return status
    generalised_forces(machine)
    solve_dependent(record.partition, rank, record.constraints.gamma)
    embed(machine)
    solve_multipliers(record.partition, rank, record.partition.Q, record.constraints.lam)
    status = finish_forces(machine, t, ydot)
    take_accelerations(machine)
    write_rates(machine, ydot)
    return status


@entry(correct_signature)
def keep(machine, t, y):
    """Dependent positions from C = 0 by Newton's method with the independent ones held, then dependent velocities from Ċ = 0.

    SINGULAR where the positions cannot be found: control.failure is the row that is farthest open.
    """
    status, done, factorised, before = OK, False, False, np.inf
    for attempt in range(MOST_PASSES + 1):
        normalise(machine, y)
        status = read_factorised(machine, t, y)
        if status == OK:
            status, done, factorised, before = close(machine, y, attempt, factorised, before)
        if status != OK or done:
            break
    return status


# the dependent coordinates are solved for with every stabilisation, so there is nothing left to correct directly
correct = keep
