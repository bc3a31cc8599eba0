"""Whitened rows and forces of a tree with flexible bodies, and accelerations from them, with the factors of
`nivel.kernels.tree.flexible_articulated`: efforts e and wrenches x pass the modes of a body as e := U⁻ᵀ (e + sᵀ x), x := x - Yᵀ e."""

import numpy as np

from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.bodies.floating_dynamics import velocity_forces
from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.record.record import MODAL, OUTWARD, record_at
from nivel.kernels.tree import articulated
from nivel.native.function import leaf, stage


@leaf
def whiten_modes(M, s, carried, effort, wrench, n):
    """effort (n,) := U⁻ᵀ (effort + sᵀ wrench), wrench := wrench - Yᵀ effort."""
    if carried:
        for i in range(6):
            share, row = wrench[i], s[i]
            for j in range(n):
                effort[j] += share * row[j]
    for k in range(n):
        row = M[k]
        e = effort[k] / row[k]
        effort[k] = e
        for j in range(k + 1, n):
            effort[j] -= e * row[j]
        for i in range(6):
            wrench[i] -= e * row[n + i]


@leaf
def bend_by(turn, displacement, wrench, effort, n):
    """effort += Φᵀ wrench of a frame at an interface."""
    m0, m1, m2, f0, f1, f2 = wrench[0], wrench[1], wrench[2], wrench[3], wrench[4], wrench[5]
    for j in range(n):
        effort[j] += (
            m0 * turn[0, j] + m1 * turn[1, j] + m2 * turn[2, j]
            + f0 * displacement[0, j] + f1 * displacement[1, j] + f2 * displacement[2, j]
        )  # fmt: skip


@stage
def applied_on_modes(bodies, tree, own, modal, f):
    """Wrench about the origin of the floating frame, and modal efforts: applied and velocity forces less the inertia forces of the
    accelerations that others are counted from."""
    b = own.body[f]
    first, n = modes_of(own, f)
    A, S, J, B, F = bodies.A[b], own.first[f], own.inertia[f], own.coupling[f], bodies.wrench[b]
    q, out = own.velocity_force[f], tree.wrench[b]
    velocity_forces(bodies, own, f, q)
    x, y = tree.Rddot0[b], tree.alpha0[b]
    a = dot(A[:, 0], x), dot(A[:, 1], x), dot(A[:, 2], x)
    alpha = dot(A[:, 0], y), dot(A[:, 1], y), dot(A[:, 2], y)
    swing, heave, m = cross(alpha, S), cross(S, a), bodies.mass[b]
    force = q[0] - m * a[0] - swing[0], q[1] - m * a[1] - swing[1], q[2] - m * a[2] - swing[2]
    moment = q[3] - heave[0] - dot(J[0], alpha), q[4] - heave[1] - dot(J[1], alpha), q[5] - heave[2] - dot(J[2], alpha)
    multiply(A, moment, out[0:3])
    multiply(A, force, out[3:6])
    for i in range(3):
        out[i] += F[3 + i]
        out[3 + i] += F[i]
    a0, a1, a2, b0, b1, b2 = a[0], a[1], a[2], alpha[0], alpha[1], alpha[2]
    for j in range(n):
        modal.effort[first + j] = own.Q[first + j] - (
            a0 * B[0, j] + a1 * B[1, j] + a2 * B[2, j] + b0 * B[3, j] + b1 * B[4, j] + b2 * B[5, j]
        )


@stage
def whiten_flexible_efforts(machine, y):
    """z of all applied and inertia forces, from the outermost node inwards; y is not needed for it here."""
    record = record_at(machine)
    bodies, tree, own, modal = record.bodies, record.tree, record.flexible, record.modal
    ground = bodies.mass.shape[0]
    for b in range(ground):
        if own.rigid[b] == 1:
            articulated.applied(bodies, tree, b, tree.wrench[b])
    for v in range(ground + 1, tree.wrench.shape[0]):
        F, out = bodies.wrench[v], tree.wrench[v]
        out[0], out[1], out[2], out[3], out[4], out[5] = F[3], F[4], F[5], F[0], F[1], F[2]
    for f in range(own.body.shape[0]):
        applied_on_modes(bodies, tree, own, modal, f)
    hand_efforts_inwards(machine)


@stage
def hand_efforts_inwards(machine):
    """z of the wrenches in `tree.wrench` and the modal efforts in `modal.effort`."""
    record = record_at(machine)
    tree, own, modal, z = record.tree, record.flexible, record.modal, record.saddle.z
    ground, count = record.bodies.mass.shape[0], tree.node.shape[0]
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        child, parent, kind, low, last = node[0], node[1], node[2], np.int64(node[4]), np.int64(node[5])
        wrench = tree.wrench[child]
        if kind == OUTWARD:
            k = modal.link[n]
            first, size = modes_of(own, own.frame[k, 0])
            bend_by(own.turn[k], own.displacement[k], wrench, modal.effort[first : first + size], size)
        elif kind == MODAL:
            f = modal.link[n]
            first, size = modes_of(own, f)
            carried = modal.carrier[f] < own.frame.shape[0]
            effort = modal.effort[first : first + size]
            whiten_modes(modal.factor[f], modal.column[f], carried, effort, wrench, size)
            for j in range(size):
                z[low + j, 0] = effort[j]
        else:
            for c in range(last - low):
                k = last - 1 - c
                z[k, 0] = articulated.transmit(tree, k, wrench)
        if parent != ground:
            articulated.hand_wrench(wrench, tree.arm[child], tree.wrench[parent])


@stage
def whiten_flexible_bundle(machine, first, last):
    """W of rows first to last - 1, which have the same path from their bodies to the ground."""
    record = record_at(machine)
    tree, own, modal, W = record.tree, record.flexible, record.modal, record.saddle.W
    ground, count = record.bodies.mass.shape[0], last - first
    start, stop = tree.path_start[first], tree.path_start[first + 1]
    length = np.int64(tree.row_blocks[first])
    for p in range(start, stop):
        n, block = tree.path[p, 0], np.int64(tree.path[p, 1])
        node = tree.node[n]
        child, parent, kind, low = node[0], node[1], node[2], np.int64(node[4])
        columns = np.int64(node[5]) - np.int64(node[4])
        for i in range(count):
            x = tree.load[i, child]
            if kind == OUTWARD:
                k = modal.link[n]
                begin, size = modes_of(own, own.frame[k, 0])
                bend_by(own.turn[k], own.displacement[k], x, modal.load[i, begin : begin + size], size)
            elif kind == MODAL:
                f = modal.link[n]
                begin, size = modes_of(own, f)
                carried = modal.carrier[f] < own.frame.shape[0]
                effort = modal.load[i, begin : begin + size]
                whiten_modes(modal.factor[f], modal.column[f], carried, effort, x, size)
                for j in range(size):
                    # blocks are in the order of columns, the last one first
                    W[block + i * length + size - 1 - j, 0] = effort[j]
                    effort[j] = 0.0
            else:
                for c in range(columns):
                    W[block + i * length + c, 0] = articulated.transmit(tree, low + columns - 1 - c, x)
            if parent != ground:
                articulated.hand_wrench(x, tree.arm[child], tree.load[i, parent])
            x[0], x[1], x[2], x[3], x[4], x[5] = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@stage
def whiten_flexible_tree_rows(machine):
    """W of all rows in a tree with flexible bodies, see `nivel.kernels.tree.articulated.whiten_bundles`.

    `modal.load` is zero before and after.
    """
    articulated.whiten_bundles(machine, whiten_flexible_bundle)


@stage
def accelerate_flexible(machine, change):
    """Joint and modal accelerations from z, in `change` (U,), and `delta` of all bodies and frames; also the change of coordinates in a
    correction."""
    record = record_at(machine)
    tree, own, modal, z = record.tree, record.flexible, record.modal, record.saddle.z
    for n in range(tree.node.shape[0]):
        node = tree.node[n]
        child, parent, kind, low = node[0], node[1], node[2], np.int64(node[4])
        a = tree.delta[child]
        articulated.carry_motion(tree.delta[parent], tree.arm[child], a)
        if kind == OUTWARD:
            k = modal.link[n]
            first, size = modes_of(own, own.frame[k, 0])
            for i in range(3):
                turn, displacement = own.turn[k, i], own.displacement[k, i]
                for j in range(size):
                    a[i] += turn[j] * own.pddot[first + j]
                    a[3 + i] += displacement[j] * own.pddot[first + j]
        elif kind == MODAL:
            f = modal.link[n]
            first, size = modes_of(own, f)
            M, motion = modal.factor[f], modal.column[f]
            for m in range(size):
                k = size - 1 - m
                row = M[k]
                value = z[low + k, 0]
                for i in range(6):
                    value -= row[size + i] * a[i]
                for j in range(k + 1, size):
                    value -= row[j] * own.pddot[first + j]
                own.pddot[first + k] = value / row[k]
                change[low + k] = own.pddot[first + k]
            if modal.carrier[f] < own.frame.shape[0]:
                for i in range(6):
                    for j in range(size):
                        a[i] += motion[i, j] * own.pddot[first + j]
        else:
            for k in range(low, np.int64(node[5])):
                articulated.accelerate_column(tree, z, k, a, change)
