"""Coordinate partitioning and embedding with flexible bodies: velocities are (Ṙ, ω̄) of all bodies, then ṗ of all modes.

Modal velocities have small units (`nivel.system.states.floating`), so that pivots of C_q are found among those of bodies: modes
are independent wherever the machine without them determines its dependent velocities.
"""

import numpy as np

from nivel.kernels.algebra.spatial import dot, multiply
from nivel.kernels.bodies.floating_dynamics import flexible_row, forward, frame_momenta, load_frame
from nivel.kernels.bodies.floating_frame import modal_momentum, modes_of
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf


@leaf
def moves_with_modes(record, b):
    """Whether row b of the saddle is one of a flexible body: its frame, or modes."""
    own = record.flexible
    return own.body.shape[0] > 0 and (b >= own.rigid.shape[0] or own.rigid[b] == 0)


@leaf
def fill_flexible_rows(machine):
    """Add the entries of flexible bodies to C_q, unscaled but in the units of the partition. W of their blocks is C_q then."""
    record = record_at(machine)
    own, saddle, partition = record.flexible, record.saddle, record.partition
    unit, place = partition.unit, partition.column_place
    modes = 6 * record.bodies.mass.shape[0]
    for e in range(own.block.shape[0]):
        at, f, modal = own.block[e, 0], own.block[e, 2], np.int64(own.block[e, 3])
        if at >= saddle.blocks[0]:
            continue  # of friction
        flexible_row(machine, e)
        entries, W = partition.E[partition.row_place[saddle.block[at, 0]]], saddle.W[at]
        part, v = record.constraints.J[saddle.block[at, 1]], 6 * np.int64(own.body[f])
        for i in range(3):
            entries[place[v + i]] += unit[v + i] * part[i]
            entries[place[v + 3 + i]] += unit[v + 3 + i] * W[3 + i]
        first, n = modes_of(own, f)
        for j in range(n):
            v = modes + first + j
            entries[place[v]] += unit[v] * saddle.W[modal + j // 6, j % 6]


@leaf
def weigh_flexible_row(machine, entries):
    """What flexible bodies contribute to C_q M⁻¹ C_qᵀ of a row of E, with the factors of their frames."""
    record = record_at(machine)
    own, partition = record.flexible, record.partition
    unit, place, modes = partition.unit, partition.column_place, 6 * record.bodies.mass.shape[0]
    square, x = 0.0, partition.p[:6]
    for f in range(own.body.shape[0]):
        A, B, v = record.bodies.A[own.body[f]], own.coupling[f], 6 * np.int64(own.body[f])
        first, n = modes_of(own, f)
        f0, f1, f2 = entries[place[v]] / unit[v], entries[place[v + 1]] / unit[v], entries[place[v + 2]] / unit[v]
        for i in range(3):
            x[i] = A[0, i] * f0 + A[1, i] * f1 + A[2, i] * f2
            x[3 + i] = entries[place[v + 3 + i]] / unit[v + 3 + i]
        for j in range(n):
            power = entries[place[modes + first + j]] / unit[modes + first + j]
            square += power * power
            for i in range(6):
                x[i] -= B[i, j] * power
        forward(own.root[f], x)
        for i in range(6):
            square += x[i] * x[i]
    return square


@leaf
def flexible_forces(machine, Q):
    """Q (n,) of flexible bodies: applied and velocity forces on their frames, (force in global axes, moment in axes of the body), and on
    their modes."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    modes = 6 * bodies.mass.shape[0]
    for f in range(own.body.shape[0]):
        b = np.int64(own.body[f])
        A, out, (first, n) = bodies.A[b], Q[6 * b : 6 * b + 6], modes_of(own, f)
        load_frame(bodies, own, f, out)
        force = out[0], out[1], out[2]
        multiply(A, force, out)
        for j in range(n):
            Q[modes + first + j] = own.Q[first + j]


@leaf
def times_flexible_mass(machine, x, out):
    """The entries of flexible bodies of out (n,) = M x."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    modes = 6 * bodies.mass.shape[0]
    for f in range(own.body.shape[0]):
        b = np.int64(own.body[f])
        A, (first, n) = bodies.A[b], modes_of(own, f)
        R, w, p, to = x[6 * b : 6 * b + 3], x[6 * b + 3 : 6 * b + 6], x[modes:], out[6 * b : 6 * b + 6]
        v = dot(A[:, 0], R), dot(A[:, 1], R), dot(A[:, 2], R)
        force, moment = frame_momenta(bodies, own, f, v, w, p, first)
        multiply(A, force, to)
        for i in range(3):
            to[3 + i] = moment[i]
        for j in range(n):
            out[modes + first + j] = p[first + j] + modal_momentum(own.coupling[f], v, w, j)
