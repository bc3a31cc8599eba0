"""The residual in relative coordinates where bodies slide along beams that carry them: as `nivel.motion.relative_residual`, but a slider
gets its acceleration from two nodes, and both get its wrench."""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import hand_wrench
from nivel.kernels.compile import stage
from nivel.kernels.constraint import constraint_rows
from nivel.kernels.hook import apply_forces, family, measure_active
from nivel.kernels.marker import move_marker, place_marker
from nivel.kernels.record import NONE, record_at
from nivel.kernels.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.rigid import load_weight
from nivel.kernels.slider import carry_slider, hand_slider, move_slider
from nivel.kernels.status import OK
from nivel.kernels.tree import move_child


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and of the markers in use, and the rows that are left. Returns a status."""
    record = record_at(machine)
    bodies, markers, tree = record.bodies, record.markers, record.tree
    for n in range(tree.node.shape[0]):
        if tree.slider_of[n] == NONE:
            move_child(bodies, tree, n, y)
        else:
            status = move_slider(machine, n, y)
            if status != OK:
                return status
    for n in range(tree.marker.shape[0]):
        place_marker(bodies, markers, tree.marker[n])
        move_marker(bodies, markers, tree.marker[n])
    constraint_rows(bodies, markers, record.constraints)
    return measure_active(machine, t)


@stage
def accelerate(machine):
    """`residual.acceleration` of all bodies, less those that they have while no joint velocity changes."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    for n in range(tree.node.shape[0]):
        node = tree.node[n]
        x = own.acceleration[node[0]]
        if tree.slider_of[n] == NONE:
            r, xp = tree.arm[node[0]], own.acceleration[node[1]]
            x[0], x[1], x[2] = xp[0], xp[1], xp[2]
            x[3] = xp[3] + xp[1] * r[2] - xp[2] * r[1]
            x[4] = xp[4] + xp[2] * r[0] - xp[0] * r[2]
            x[5] = xp[5] + xp[0] * r[1] - xp[1] * r[0]
        else:
            carry_slider(machine, n, own.acceleration)
        for k in range(np.int64(node[4]), np.int64(node[5])):
            for i in range(6):
                x[i] += own.vdot[k] * tree.column[k, i]


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual`."""
    record = record_at(machine)
    bodies, tree, own = record.bodies, record.tree, record.residual
    status = read_state(machine, t, own.y)
    if status != OK:
        return status
    load_weight(bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    accelerate(machine)
    ground, count = bodies.mass.shape[0], tree.node.shape[0]
    for b in range(ground):
        for i in range(3):
            own.acceleration[b, i] += tree.alpha0[b, i]
            own.acceleration[b, 3 + i] += tree.Rddot0[b, i]
    status = load_multipliers(machine, t)
    if status != OK:
        return status
    inertial_wrenches(machine)
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        F = own.wrench[node[0]]
        for k in range(np.int64(node[4]), np.int64(node[5])):
            s = tree.column[k]
            own.value[k] = (s[0] * F[0] + s[1] * F[1] + s[2] * F[2]) + (s[3] * F[3] + s[4] * F[4] + s[5] * F[5])
        if tree.slider_of[n] != NONE:
            hand_slider(machine, n, own.wrench)
        elif node[1] != ground:
            hand_wrench(F, tree.arm[node[0]], own.wrench[node[1]])
    write_rows(machine, tree.column.shape[0])
    return OK
