"""The residual in relative coordinates with flexible bodies: accelerations from the ground outwards, wrenches inwards, one row a joint or
modal velocity."""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import hand_wrench
from nivel.kernels.flexible_whitening import bend_by
from nivel.kernels.floating_dynamics import flexible_wrench
from nivel.kernels.floating_frame import modes_of
from nivel.kernels.hook import family
from nivel.kernels.record import MODAL, OUTWARD, record_at
from nivel.kernels.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.status import OK
from nivel.motion.flexible_tree import load_flexible_tree, read_flexible_tree


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual`."""
    record = record_at(machine)
    bodies, tree, flexible, modal, own = record.bodies, record.tree, record.flexible, record.modal, record.residual
    status = read_flexible_tree(machine, t, own.y)
    if status == OK:
        status = load_flexible_tree(machine, t, own.y)
    if status != OK:
        return status
    ground, count = bodies.mass.shape[0], tree.node.shape[0]
    # accelerations less those that the bodies have while no velocity changes ...
    for n in range(count):
        node = tree.node[n]
        child, parent, kind, low = node[0], node[1], node[2], np.int64(node[4])
        r, xp, x = tree.arm[child], own.acceleration[parent], own.acceleration[child]
        x[0], x[1], x[2] = xp[0], xp[1], xp[2]
        x[3] = xp[3] + xp[1] * r[2] - xp[2] * r[1]
        x[4] = xp[4] + xp[2] * r[0] - xp[0] * r[2]
        x[5] = xp[5] + xp[0] * r[1] - xp[1] * r[0]
        if kind == OUTWARD:
            k = modal.link[n]
            first, size = modes_of(flexible, flexible.frame[k, 0])
            for i in range(3):
                turn, displacement = flexible.turn[k, i], flexible.displacement[k, i]
                for j in range(size):
                    x[i] += turn[j] * flexible.pddot[first + j]
                    x[3 + i] += displacement[j] * flexible.pddot[first + j]
        elif kind == MODAL:
            f = modal.link[n]
            first, size = modes_of(flexible, f)
            for j in range(size):
                flexible.pddot[first + j] = own.vdot[low + j]
            if modal.carrier[f] < flexible.frame.shape[0]:
                for i in range(6):
                    motion = modal.column[f, i]
                    for j in range(size):
                        x[i] += motion[j] * own.vdot[low + j]
        else:
            for k in range(low, np.int64(node[5])):
                for i in range(6):
                    x[i] += own.vdot[k] * tree.column[k, i]
    # ... and all of them
    for b in range(own.acceleration.shape[0]):
        for i in range(3):
            own.acceleration[b, i] += tree.alpha0[b, i]
            own.acceleration[b, 3 + i] += tree.Rddot0[b, i]
    status = load_multipliers(machine, t)
    if status != OK:
        return status
    inertial_wrenches(machine)
    for v in range(ground + 1, own.wrench.shape[0]):
        F, out = bodies.wrench[v], own.wrench[v]
        for i in range(3):
            out[i], out[3 + i] = -F[3 + i], -F[i]
    for f in range(flexible.body.shape[0]):
        flexible_wrench(bodies, flexible, f, own.acceleration, own.wrench, modal.effort)
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        child, parent, kind, low, F = node[0], node[1], node[2], np.int64(node[4]), own.wrench[node[0]]
        if kind == OUTWARD:
            k = modal.link[n]
            first, size = modes_of(flexible, flexible.frame[k, 0])
            bend_by(flexible.turn[k], flexible.displacement[k], F, modal.effort[first : first + size], size)
        elif kind == MODAL:
            f = modal.link[n]
            first, size = modes_of(flexible, f)
            for j in range(size):
                own.value[low + j] = modal.effort[first + j]
            if modal.carrier[f] < flexible.frame.shape[0]:
                for i in range(6):
                    motion = modal.column[f, i]
                    for j in range(size):
                        own.value[low + j] += motion[j] * F[i]
        else:
            for k in range(low, np.int64(node[5])):
                s = tree.column[k]
                own.value[k] = (s[0] * F[0] + s[1] * F[1] + s[2] * F[2]) + (s[3] * F[3] + s[4] * F[4] + s[5] * F[5])
        if parent != ground:
            hand_wrench(F, tree.arm[child], own.wrench[parent])
    write_rows(machine, tree.column.shape[0])
    return OK
