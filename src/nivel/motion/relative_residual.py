"""The residual in relative coordinates: accelerations from the ground outwards, wrenches inwards (recursive Newton–Euler; Luh, Walker,
Paul 1980), one row a joint velocity."""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import hand_wrench
from nivel.kernels.hook import apply_forces, family
from nivel.kernels.record import record_at
from nivel.kernels.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.rigid import load_weight
from nivel.kernels.status import OK
from nivel.motion.relative import read_state


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
    ground, count = bodies.mass.shape[0], tree.node.shape[0]
    # accelerations less those that the bodies have while no joint velocity changes ...
    for n in range(count):
        node = tree.node[n]
        child, parent = node[0], node[1]
        r, xp, x = tree.arm[child], own.acceleration[parent], own.acceleration[child]
        x[0], x[1], x[2] = xp[0], xp[1], xp[2]
        x[3] = xp[3] + xp[1] * r[2] - xp[2] * r[1]
        x[4] = xp[4] + xp[2] * r[0] - xp[0] * r[2]
        x[5] = xp[5] + xp[0] * r[1] - xp[1] * r[0]
        for k in range(np.int64(node[4]), np.int64(node[5])):
            for i in range(6):
                x[i] += own.vdot[k] * tree.column[k, i]
    # ... and all of them
    for b in range(ground):
        for i in range(3):
            own.acceleration[b, i] += tree.alpha0[b, i]
            own.acceleration[b, 3 + i] += tree.Rddot0[b, i]
    status = load_multipliers(machine, t)
    if status != OK:
        return status
    inertial_wrenches(machine)
    for m in range(count):
        node = tree.node[count - 1 - m]
        child, parent, F = node[0], node[1], own.wrench[node[0]]
        for k in range(np.int64(node[4]), np.int64(node[5])):
            s = tree.column[k]
            own.value[k] = (s[0] * F[0] + s[1] * F[1] + s[2] * F[2]) + (s[3] * F[3] + s[4] * F[4] + s[5] * F[5])
        if parent != ground:
            hand_wrench(F, tree.arm[child], own.wrench[parent])
    write_rows(machine, tree.column.shape[0])
    return OK
