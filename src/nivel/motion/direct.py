"""What the direct corrections of six velocities a body share: which level to put right, and by which change (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.compile import stage
from nivel.kernels.record import record_at
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.newton_euler import WIDTH, unwhiten, whiten_rows

MAX_CORRECTIONS = 3
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7
# what is changed
NOTHING, VELOCITIES, POSITIONS = 0, 1, 2


@stage
def find_change(machine, attempt, factorised):
    """The change that brings the state last read back to its constraints: (status, what to change, whether S need not be factorised again).

    It is left in `Rddot` and `alpha_b` of the bodies: of (R, rotation in body axes) or of (Ṙ, ω̄). A level within its tolerance
    (control.stabilise[2:4], as a share of the row's scale) is left alone.
    """
    record = record_at(machine)
    saddle, constraints, tolerance = record.saddle, record.constraints, record.control.stabilise
    at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
    if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
        return OK, NOTHING, factorised
    if not factorised:
        whiten_rows(machine)
        status = factorise_rows(machine, WIDTH)
        if status != OK:
            return status, NOTHING, False
    correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
    for b in range(saddle.z.shape[0]):
        unwhiten(record.bodies, saddle, b)
    near = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
    return OK, POSITIONS if at_positions else VELOCITIES, near
