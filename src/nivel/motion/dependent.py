"""Dependent coordinates, for implicit methods: `nivel.motion.independent` solved for what these leave open."""

from __future__ import annotations

from nivel.kernels.record.hook import family
from nivel.kernels.solve.embedding import depend_on
from nivel.motion.independent import normalise_state
from nivel.motion.newton_euler import read_state


@family
def depend(machine, job, t):
    """What depends on the independent coordinates, see `nivel.kernels.solve.embedding.depend_on`."""
    return depend_on(machine, t, normalise_state, read_state)
