"""Direct correction of states in relative coordinates with flexible bodies (report 44, §5.5): only joints that are cut can be open."""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry
from nivel.kernels.flexible_articulated import factorise_flexible_tree
from nivel.kernels.flexible_whitening import accelerate_flexible, whiten_flexible_tree_rows
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.direct import MAX_CORRECTIONS, NEAR
from nivel.motion.flexible_tree import read_flexible_tree
from nivel.motion.relative import WIDTH, normalise, write_positions


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, least in the mass metric; see `nivel.motion.relative_correction`."""
    record = record_at(machine)
    tree, saddle, constraints = record.tree, record.saddle, record.constraints
    tolerance, change = record.control.stabilise, tree.change
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    normalise(machine, y)
    if saddle.row.shape[0] == 0:
        return OK
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read_flexible_tree(machine, t, y)
        if status != OK:
            return status
        at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
        if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
            return OK
        if not factorised:
            status = factorise_flexible_tree(machine)
            if status != OK:
                return status
            whiten_flexible_tree_rows(machine)
            status = factorise_rows(machine, WIDTH)
            if status != OK:
                return status
        factorised = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
        correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
        accelerate_flexible(machine, change)
        if not at_positions:
            for k in range(columns):
                y[positions + k] += change[k]
            return OK
        for n in range(tree.node.shape[0]):
            write_positions(machine, y, change, tree.moved, n, np.int64(tree.node[n, 4]))
        for k in range(positions):
            y[k] += tree.moved[k]
        normalise(machine, y)
    return OK
