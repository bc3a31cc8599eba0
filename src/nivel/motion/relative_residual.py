"""The residual in relative coordinates: accelerations from the ground outwards, wrenches inwards (recursive Newton–Euler; Luh, Walker,
Paul 1980), one row a joint or modal velocity.

One for all machines: joints carry rigid bodies and flexible ones at their interfaces, beams carry what slides along them, and any of these
may have mass in common. What only some have is done by hooks of their nodes (`nivel.kernels.tree.tree_nodes`).
"""

from __future__ import annotations

from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family
from nivel.kernels.record.record import LOAD, MODES, NEED, POINTS, record_at
from nivel.kernels.residual.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.tree.flexible_tree import clear_frames
from nivel.kernels.tree.tree_markers import read_markers
from nivel.kernels.tree.tree_nodes import accelerate_nodes, hand_inwards, move_nodes


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    count = tree.node.shape[0]
    status = move_nodes(machine, t)
    if status == OK:
        status = read_markers(machine, t)
    if status != OK:
        return status
    load_weight(record.bodies)
    clear_frames(record.bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    call_hook(machine, MODES, LOAD * count, t)
    accelerate_nodes(machine, t)
    status = load_multipliers(machine, t)
    if status == OK:
        status = call_hook(machine, POINTS, 0, t)
    if status != OK:
        return status
    inertial_wrenches(machine)
    call_hook(machine, MODES, NEED * count, t)
    hand_inwards(machine, t)
    write_rows(machine, tree.column.shape[0])
    return OK
