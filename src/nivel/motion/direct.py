"""The direct correction of states, whatever coordinates they are in: which level to put right, and pass after pass (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.compile import shared, stage
from nivel.kernels.record import record_at
from nivel.kernels.saddle import correction, exceeds
from nivel.kernels.status import OK

MAX_CORRECTIONS = 3
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7
# what is changed
NOTHING, VELOCITIES, POSITIONS = 0, 1, 2


@stage
def open_level(machine, attempt):
    """What pass `attempt` has to change in the state last read.

    A level within its tolerance (control.stabilise[2:4], as a share of the row's scale) is left alone.
    """
    record = record_at(machine)
    saddle, constraints, tolerance = record.saddle, record.constraints, record.control.stabilise
    if attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2]):
        return POSITIONS
    return VELOCITIES if exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]) else NOTHING


@stage
def is_near(machine):
    """Whether the factor of S for the state last read serves for the next pass."""
    record = record_at(machine)
    constraints = record.constraints
    return not exceeds(record.saddle, constraints.C, constraints.scale, NEAR * record.control.stabilise[2])


@stage
def find_correction(machine, what, width):
    """z, the whitened change that closes the level `what`, least in the mass metric."""
    constraints = record_at(machine).constraints
    correction(machine, constraints.C if what == POSITIONS else constraints.Cdot, width)


@shared
def correct_levels(machine, t, y, width, read, factorise, change):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137). Returns a status.

    The report's pseudo-inverse weighs metres and radians alike; here the change is least in the mass metric, which does not depend
    on units and uses the matrix S of the accelerations.

    width : unknowns a body. Compiled into this one: read(machine, t, y), the state; factorise(machine, y), the factor of S; and
    change(machine, y, what), which applies the change in z to the level `what`. The first two return a status.
    """
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read(machine, t, y)
        if status != OK:
            return status
        what = open_level(machine, attempt)
        if what == NOTHING:
            return OK
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
