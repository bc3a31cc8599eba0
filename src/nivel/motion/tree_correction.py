"""The direct correction in relative coordinates (report 44, §5.5), where only joints that are cut can be open."""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import stage
from nivel.kernels.record import record_at
from nivel.kernels.saddle import correction, exceeds
from nivel.kernels.status import OK
from nivel.motion.tree_motion import WIDTH, normalise, write_positions

MAX_CORRECTIONS = 3
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7


@stage
def correct_tree(machine, t, y, read, factorise, accelerate):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137), least in the mass metric.

    read, factorise, accelerate : the recursion of a tree, compiled into this one. A level within its tolerance (control.stabilise[2:4], as
    a share of the row's scale) is left alone. Returns a status.
    """
    record = record_at(machine)
    tree, saddle, constraints = record.tree, record.saddle, record.constraints
    tolerance, change = record.control.stabilise, tree.change
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    normalise(machine, y)
    if saddle.row.shape[0] == 0:
        return OK
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read(machine, t, y)
        if status != OK:
            return status
        at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
        if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
            return OK
        if not factorised:
            status = factorise(machine)
            if status != OK:
                return status
        factorised = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
        correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
        accelerate(machine, change)
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
