"""Nodes between the frames of flexible bodies for the residual in relative coordinates; see `nivel.kernels.tree.tree_nodes`."""

import numpy as np

from nivel.kernels.bodies.floating_dynamics import flexible_wrench, load_modes
from nivel.kernels.bodies.floating_frame import dot_modes, modes_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import ACCELERATE, HAND, LOAD, MODAL, MOVE, record_at
from nivel.kernels.tree.articulated import carry_motion, hand_wrench
from nivel.kernels.tree.flexible_tree import carry_body, carry_frame, read_modes
from nivel.kernels.tree.flexible_whitening import bend_by
from nivel.native.function import stage


@stage
def move(record, n):
    """Pose and velocity of the child of node n."""
    bodies, tree, flexible, modal = record.bodies, record.tree, record.flexible, record.modal
    if tree.node[n, 2] == MODAL:
        read_modes(flexible, tree, modal, n, record.residual.y)
        carry_body(bodies, tree, flexible, modal, n)
    else:
        carry_frame(bodies, tree, flexible, modal.link[n])


@stage
def accelerate(record, n):
    """Acceleration of the child of node n, with that by the modes."""
    tree, flexible, modal, own = record.tree, record.flexible, record.modal, record.residual
    child, parent = tree.node[n, 0], tree.node[n, 1]
    x = own.acceleration[child]
    carry_motion(own.acceleration[parent], tree.arm[child], x)
    if tree.node[n, 2] == MODAL:
        f, low = modal.link[n], np.int64(tree.node[n, 4])
        first, size = modes_of(flexible, f)
        for j in range(size):
            flexible.pddot[first + j] = own.vdot[low + j]
        if modal.carrier[f] < flexible.frame.shape[0]:
            for i in range(6):
                x[i] += dot_modes(modal.column[f, i], own.vdot, low, size)
        return
    k = modal.link[n]
    first, size = modes_of(flexible, flexible.frame[k, 0])
    for i in range(3):
        x[i] += dot_modes(flexible.turn[k, i], flexible.pddot, first, size)
        x[3 + i] += dot_modes(flexible.displacement[k, i], flexible.pddot, first, size)


@stage
def hand(record, n):
    """The rows of the modes of node n, and its wrench to its parent."""
    tree, flexible, modal, own = record.tree, record.flexible, record.modal, record.residual
    child, parent = tree.node[n, 0], tree.node[n, 1]
    F = own.wrench[child]
    if tree.node[n, 2] == MODAL:
        f, low = modal.link[n], np.int64(tree.node[n, 4])
        first, size = modes_of(flexible, f)
        value = own.value[low : low + size]
        for j in range(size):
            value[j] = modal.effort[first + j]
        if modal.carrier[f] < flexible.frame.shape[0]:
            for i in range(6):
                motion = modal.column[f, i]
                for j in range(size):
                    value[j] += motion[j] * F[i]
    else:
        k = modal.link[n]
        first, size = modes_of(flexible, flexible.frame[k, 0])
        bend_by(flexible.turn[k], flexible.displacement[k], F, modal.effort[first : first + size], size)
    hand_wrench(F, tree.arm[child], own.wrench[parent])


@stage
def need(record):
    """`residual.wrench` of frames and flexible bodies, and what the modes ask for: inertia less all applied forces."""
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    for v in range(bodies.mass.shape[0] + 1, own.wrench.shape[0]):
        F, out = bodies.wrench[v], own.wrench[v]
        for i in range(3):
            out[i], out[3 + i] = -F[3 + i], -F[i]
    for f in range(flexible.body.shape[0]):
        flexible_wrench(bodies, flexible, f, own.acceleration, own.wrench, record.modal.effort)


@family
def pass_modes(machine, job, t):
    """MOVE, ACCELERATE or HAND for a node of kind MODAL or OUTWARD, LOAD and NEED for all flexible bodies."""
    record = record_at(machine)
    count = record.tree.node.shape[0]
    what, n = job // count, job % count
    if what == MOVE:
        move(record, n)
    elif what == ACCELERATE:
        accelerate(record, n)
    elif what == HAND:
        hand(record, n)
    elif what == LOAD:
        load_modes(machine)
    else:
        need(record)
    return OK
