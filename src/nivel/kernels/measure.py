"""The hook of machines that measure coordinates in every evaluation."""

from __future__ import annotations

from nivel.kernels.constraint import combine
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def measure(machine, number, t):
    """Active coordinates and the rows made of them, see `nivel.kernels.constraint.combine`."""
    combine(record_at(machine), t)
    return OK
