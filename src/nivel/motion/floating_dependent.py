"""What follows from the independent coordinates, for implicit methods, with flexible bodies: as `nivel.motion.dependent`."""

from __future__ import annotations

from nivel.kernels.embedding import follow_independent
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.motion.floating_frame import read_flexible_state
from nivel.motion.floating_independent import keep


@family
def depend(machine, job, t):
    """Dependent positions, velocities and accelerations of `residual.y` and `vdot` from C = 0, Ċ = 0 and C̈ = 0; the independent ones stay.

    Returns a status: SINGULAR where the positions cannot be found; control.failure is the row that is farthest open.
    """
    own = record_at(machine).residual
    status = keep(machine, t, own.y)
    if status == OK:
        status = read_flexible_state(machine, t, own.y)
    if status == OK:
        follow_independent(machine, own.vdot)
    return status
