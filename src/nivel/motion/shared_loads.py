"""Loads shared by redundant joints: of all multipliers that give a frame's accelerations, those of least length.

In relative coordinates the joint that carries a body transmits all that its branch needs. The same reactions with C_qᵀ λ unchanged are
found in absolute coordinates from the frame itself, which has the places of all bodies and some λ: see
`nivel.kernels.solve.least_multipliers`.
"""

import numpy as np

from nivel.kernels.algebra.dense import solve_pivoted
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import CONSTRAINT_FORCE, OUTPUTS, first_column, write_reactions
from nivel.kernels.record.record import EVALUATE, NONE, record_at
from nivel.kernels.solve.least_multipliers import product, spread_multipliers
from nivel.kernels.solve.saddle import PIVOTED, RANK
from nivel.motion.newton_euler import factorise, read_state
from nivel.native.entry import entry
from nivel.native.function import leaf, stage


@leaf
def read_multipliers(record, frame):
    """λ of the frame."""
    first = first_column(record, CONSTRAINT_FORCE)
    for row in range(record.constraints.lam.shape[0]):
        record.constraints.lam[row] = frame[first + row]


@stage
def shorten_multipliers(machine):
    """λ := the one of least length with the same C_qᵀ λ, after `factorise`."""
    record = record_at(machine)
    saddle, lam = record.saddle, record.constraints.lam
    if record.control.rank[PIVOTED] == 0:
        spread_multipliers(machine)
        return
    product(saddle, lam)
    solve_pivoted(saddle, np.int64(record.control.rank[RANK]))
    for k in range(saddle.b.shape[0]):
        lam[saddle.row[k]] = saddle.b[k]


@stage
def write_loads(machine, frame):
    """λ, the reactions of joints, and the efforts and powers of couplings and drivers."""
    record = record_at(machine)
    constraints, outputs = record.constraints, record.outputs
    first, reported = first_column(record, CONSTRAINT_FORCE), first_column(record, OUTPUTS)
    for row in range(constraints.lam.shape[0]):
        frame[first + row] = constraints.lam[row]
    for k in range(outputs.combination.shape[0]):
        if outputs.combination[k, 0] != NONE:
            at = reported + outputs.combination[k, 0]
            before, effort = frame[at], -constraints.lam[constraints.combination[k, 0]]
            frame[at] = effort
            if outputs.combination[k, 1] == 1:
                # at the speed of the frame
                frame[at + 1] = effort * (frame[at + 1] / before if before != 0.0 else constraints.motion[k])
    write_reactions(machine, frame)


@entry(EVALUATE)
def share_loads(machine, t, y, frame):
    """Multipliers, reactions and efforts of a frame := those of least length. y : its positions and velocities in absolute coordinates.

    Returns a status; the frame is as it was where too few rows are independent.
    """
    record = record_at(machine)
    status = read_state(machine, t, y)
    if status == OK:
        status = factorise(machine, y)
    if status == OK:
        read_multipliers(record, frame)
        shorten_multipliers(machine)
        write_loads(machine, frame)
    return status
