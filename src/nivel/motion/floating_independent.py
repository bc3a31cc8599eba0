"""Independent coordinates with flexible bodies: the embedding technique on the velocities (Ṙ, ω̄) of all bodies and ṗ of all modes.

As for rigid bodies (`nivel.motion.independent`); modes are independent wherever the machine without them determines its dependent
velocities. The state is that of `nivel.motion.floating_frame`, which finds the accelerations where there is friction in joints.
"""

from __future__ import annotations

from nivel.kernels.bodies.floating_dynamics import factorise_frames, gather
from nivel.kernels.bodies.floating_frame import accelerate_frames
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, family, finish_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, record_at
from nivel.kernels.solve.embedding import depend_on
from nivel.kernels.solve.partition import divide
from nivel.motion.floating_frame import evaluate as evaluate_newton_euler
from nivel.motion.floating_frame import read_flexible_state, write_rates
from nivel.motion.independent import embedded_accelerations, keep_independent, move_dependent, take_accelerations
from nivel.motion.newton_euler import normalise
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_factorised(machine, t, y):
    """The state, and the factors of the floating frames, by which dependent rows are weighed. Returns a status."""
    status = read_flexible_state(machine, t, y)
    return factorise_frames(machine) if status == OK else status


@stage
def take_all_accelerations(machine):
    """Accelerations of bodies, modes and frames from those of the partition."""
    record = record_at(machine)
    own, first = record.flexible, 6 * record.bodies.mass.shape[0]
    take_accelerations(record)
    for j in range(own.p.shape[0]):
        own.pddot[j] = record.partition.v[first + j]
    accelerate_frames(machine)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x). Leaves everything else in the record."""
    record = record_at(machine)
    if record.friction.columns.shape[0] > 0:
        return evaluate_newton_euler(machine, t, y, ydot)
    status = read_factorised(machine, t, y)
    if status != OK:
        return status
    load_weight(record.bodies)
    status = apply_forces(machine, t, y)
    if status != OK:
        return status
    gather(machine)
    status = embedded_accelerations(machine)
    if status != OK:
        return status
    status = finish_forces(machine, t, ydot)
    take_all_accelerations(machine)
    write_rates(machine, ydot)
    return status


@stage
def read_normalised(machine, t, y):
    """The same with Euler parameters of length one. Returns a status."""
    normalise(machine, y)
    return read_factorised(machine, t, y)


@entry(CORRECT)
def normalise_state(machine, t, y):
    """What depends on the independent coordinates, see `nivel.motion.independent.keep_independent`."""
    return keep_independent(machine, t, y, read_normalised, divide, move_dependent)


# the dependent coordinates are solved for with every stabilisation, so there is nothing left to correct directly
correct = normalise_state


@family
def depend(machine, job, t):
    """What depends on the independent coordinates, see `nivel.kernels.solve.embedding.depend_on`."""
    return depend_on(machine, t, normalise_state, read_flexible_state)
