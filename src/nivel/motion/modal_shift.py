"""Linear equations (1 - s J) x = r in relative coordinates, where J knows of the forces nothing but stiffness and damping of the modes.

    Δq̇ = Δv        M Δv̇ + C_qᵀ Δλ = -K Δq - D Δv        C_q Δv̇ = 0

with diagonal K and D of the modes, so that x = (r_q + s x_v, r_v + s Δv̇) follows from one recursion over the tree with the modal masses
1 + s D + s² K and the modal efforts -(D r_v + K (r_q + s r_v)): this costs about an evaluation, and there is no matrix. All that J leaves
out (weight, velocity and other forces, how M and C_q change) has to be slow against the step; a method that is of its order for any J,
as ROS2, takes it explicitly then.
"""

import numpy as np

from nivel.kernels.algebra.rows import clear
from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.record.record import MODAL, record_at
from nivel.kernels.tree.flexible_whitening import accelerate_flexible, hand_efforts_inwards
from nivel.motion.circuit_shift import hold_rows
from nivel.motion.flexible_tree import factorise_flexible
from nivel.motion.tree_motion import write_positions
from nivel.native.function import part, stage


@part
def factorise_shifted_modes(machine, s):
    """Factors of the tree with the modal masses of s, in the state last evaluated. Returns a status."""
    record = record_at(machine)
    own, shift = record.flexible, record.modal.shift
    for f in range(own.body.shape[0]):
        first, n = modes_of(own, f)
        for j in range(n):
            shift[first + j] = s * (own.damping[f, j] + s * own.stiffness[f, j])
    status = factorise_flexible(machine, shift)
    clear(shift)
    return status


@stage
def load_shifted_modes(machine, r, s):
    """Modal efforts of the right-hand side r, and no wrenches."""
    record = record_at(machine)
    tree, own, modal = record.tree, record.flexible, record.modal
    for b in range(tree.wrench.shape[0]):
        for i in range(6):
            tree.wrench[b, i] = 0.0
    for n in range(tree.node.shape[0]):
        if tree.node[n, 2] == MODAL:
            f = modal.link[n]
            first, count = modes_of(own, f)
            q, v = np.int64(tree.place[n, 0]), np.int64(tree.place[n, 1])
            for j in range(count):
                moved = r[q + j] + s * r[v + j]
                modal.effort[first + j] = -own.damping[f, j] * r[v + j] - own.stiffness[f, j] * moved


@part
def solve_shifted_modes(machine, y, r, s):
    """Overwrite r (ny,) with x, the solution of (1 - s J) x = r, with the factors for s. y : state whose Euler parameters turn. Returns a
    status."""
    record = record_at(machine)
    tree = record.tree
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    load_shifted_modes(machine, r, s)
    hand_efforts_inwards(machine)
    status = hold_rows(machine)
    accelerate_flexible(machine, tree.change)
    for k in range(columns):
        r[positions + k] += s * tree.change[k]
        tree.change[k] = s * r[positions + k]
    for n in range(tree.node.shape[0]):
        write_positions(machine, y, tree.change, tree.moved, n, np.int64(tree.node[n, 4]))
    for k in range(positions):
        r[k] += tree.moved[k]
    return status
