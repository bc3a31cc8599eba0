"""Direct evaluation in all coordinates, and direct corrections of states: levels that are put right, pass after pass (report 44, §5.5)."""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.number import share_of_lanes, some
from nivel.kernels.core.status import NOT_CLOSED, OK
from nivel.kernels.record.hook import finish_forces
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.saddle import CONTRADICTORY, PIVOTED, RANK, correction, exceeds, multipliers
from nivel.native.function import shared, stage

# Passes for the positions; and as many where they are visibly open after these, in a step too long or a position that there is not.
MAX_CORRECTIONS, MOST_CORRECTIONS = 3, 20
# What is visible, as a share of the scales of the rows.
VISIBLE = 1e-6
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7
# Slopes of what is closed, as a share of the scales of the rows.
STEEP = 1e-9
# what is changed
NOTHING, VELOCITIES, POSITIONS, LOST = 0, 1, 2, 3


@stage
def are_open(machine, limit):
    """Whether positions are open by more than `limit`, a share of the scales of their rows, that the passes are to close.

    Of redundant rows those count that were kept in the last factor: what the others are open by is left to the loop
    (`nivel.kernels.solve.saddle.contradicts`). Penalties close no rows that contradict each other, and leave them as far open.
    """
    record = record_at(machine)
    saddle, constraints = record.saddle, record.constraints
    if saddle.dense.shape[0] == 0:
        least = limit if saddle.shift[0] == 0.0 else max(limit, CONTRADICTORY)
        return exceeds(saddle, constraints.C, constraints.scale, least)
    rank, pivoted = record.control.rank, record.control.rank[PIVOTED] == 1
    for k in range(np.int64(rank[RANK]) if pivoted else saddle.order.shape[0]):
        if not pivoted and saddle.least[k] < 0.0:
            continue
        row = saddle.row[saddle.order[saddle.pivot[k] if pivoted else k]]
        if np.abs(real(constraints.C[row])) > limit * constraints.scale[row]:
            return True
    return False


@stage
def are_steep(saddle, violation, scale):
    """Whether any row of the saddle is violated by slopes. Of redundant rows those that are left out say nothing."""
    for k in range(saddle.row.shape[0]):
        row = saddle.row[k]
        if saddle.dense.shape[0] == 0 and steepest(violation[row]) > STEEP * real(scale[row]):
            return True
    return False


@stage
def open_level(machine, attempt):
    """What pass `attempt` has to change in the state last read.

    A level within its tolerance (control.stabilise[2:4], as a share of the row's scale) is left alone. LOST where positions are far open
    after all passes: of those that are less open the loop asks whether the machine jams. Where numbers have slopes, these are put right
    too: a level that is closed may move with what it depends on.
    """
    record = record_at(machine)
    saddle, constraints, tolerance = record.saddle, record.constraints, record.control.stabilise
    if is_whole(machine) and attempt < MOST_CORRECTIONS and are_steep(saddle, constraints.C, constraints.scale):
        return POSITIONS
    if some(exceeds(saddle, constraints.C, constraints.scale, tolerance[2])):
        if attempt < MAX_CORRECTIONS:
            return POSITIONS
        if are_open(machine, VISIBLE):
            if attempt < MOST_CORRECTIONS:
                return POSITIONS
            if are_open(machine, CONTRADICTORY):
                return LOST
    if is_whole(machine) and are_steep(saddle, constraints.Cdot, constraints.scale):
        return VELOCITIES
    return VELOCITIES if some(exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3])) else NOTHING


@stage
def name_lost(machine):
    """Leave the row that is farthest open in control.failure. Returns NOT_CLOSED."""
    record = record_at(machine)
    constraints, rows = record.constraints, record.saddle.row
    largest = 0.0
    for k in range(rows.shape[0]):
        share = np.abs(real(constraints.C[rows[k]])) / constraints.scale[rows[k]]
        if share > largest:
            largest, record.control.failure[0] = share, rows[k]
    return NOT_CLOSED


@stage
def is_near(machine):
    """Whether the factor of S for the state last read serves for the next pass."""
    record = record_at(machine)
    constraints = record.constraints
    return not some(exceeds(record.saddle, constraints.C, constraints.scale, NEAR * record.control.stabilise[2]))


@stage
def find_correction(machine, what, width):
    """z, the whitened change that closes the level `what`, least in the mass metric. Of several machines those are closed that need it."""
    record = record_at(machine)
    constraints, tolerance = record.constraints, record.control.stabilise[2 if what == POSITIONS else 3]
    violation = constraints.C if what == POSITIONS else constraints.Cdot
    share = share_of_lanes(exceeds(record.saddle, violation, constraints.scale, tolerance))
    correction(machine, violation, share, width)


@shared
def correct_levels(machine, t, y, width, read, factorise, change):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137). Returns a status.

    The report's pseudo-inverse weighs metres and radians alike; here the change is least in the mass metric, which does not depend
    on units and uses the matrix S of the accelerations.

    width : unknowns a body. Compiled into this one: read(machine, t, y), the state; factorise(machine, y), the factor of S; and
    change(machine, y, what), which applies the change in z to the level `what`. The first two return a status.
    """
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
            status = factorise(machine, y)
            if status != OK:
                return status
        factorised = is_near(machine)
        find_correction(machine, what, width)
        change(machine, y, what)
        if what == VELOCITIES:
            return OK
    return OK


@shared
def find_accelerations(machine, t, y, ydot, width, load, factorise, whiten):
    """Multipliers, whitened accelerations in `saddle.z`, and the rates of the states of forces and energies, from the state read before.

    width : unknowns a body. Compiled into this one: load(machine, t, y), all applied forces; factorise(machine, y), the factor of S; and
    whiten(machine, y), z of the forces. Returns a status, as the first two do.
    """
    status = load(machine, t, y)
    if status == OK:
        status = factorise(machine, y)
    if status != OK:
        return status
    whiten(machine, y)
    status = multipliers(machine, width)
    if status != OK:
        return status
    return finish_forces(machine, t, ydot)
