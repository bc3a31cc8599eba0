"""The direct correction in relative coordinates (report 44, §5.5), where only joints that are cut can be open."""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.motion.direct import (
    LOST,
    MOST_CORRECTIONS,
    NOTHING,
    VELOCITIES,
    find_correction,
    is_near,
    name_lost,
    open_level,
)
from nivel.motion.tree_motion import WIDTH, normalise, write_positions
from nivel.native.function import shared


@shared
def correct_tree(machine, t, y, read, factorise, accelerate):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137), least in the mass metric.

    read, factorise, accelerate : the recursion of a tree, compiled into this one. Returns a status.
    """
    record = record_at(machine)
    tree, change = record.tree, record.tree.change
    positions, columns = np.int64(tree.positions[0]), tree.column.shape[0]
    normalise(machine, y)
    if record.saddle.row.shape[0] == 0:
        return OK
    factorised = False
    for attempt in range(MOST_CORRECTIONS + 1):
        status = read(machine, t, y)
        if status != OK:
            return status
        what = open_level(machine, attempt)
        if what == NOTHING:
            return OK
        if what == LOST:
            return name_lost(machine)
        if not factorised:
            status = factorise(machine)
            if status != OK:
                return status
        factorised = is_near(machine)
        find_correction(machine, what, WIDTH)
        accelerate(machine, change)
        if what == VELOCITIES:
            for k in range(columns):
                y[positions + k] += change[k]
            return OK
        for n in range(tree.node.shape[0]):
            write_positions(machine, y, change, tree.moved, n, np.int64(tree.node[n, 4]))
        for k in range(positions):
            y[k] += tree.moved[k]
        normalise(machine, y)
    return OK
