"""Dependent coordinates, for implicit methods, with flexible bodies: as `nivel.motion.dependent`."""

from __future__ import annotations

from nivel.kernels.record.hook import family
from nivel.kernels.solve.embedding import depend_on
from nivel.motion.floating_frame import read_flexible_state
from nivel.motion.floating_independent import normalise_state


@family
def depend(machine, job, t):
    """What depends on the independent coordinates, see `nivel.kernels.solve.embedding.depend_on`."""
    return depend_on(machine, t, normalise_state, read_flexible_state)
