"""The hook of friction in the residual of implicit methods: the multipliers are given, so nothing has to be iterated here."""

from __future__ import annotations

from nivel.kernels.forces.push import push_coordinate
from nivel.kernels.friction import COORDINATE, report, sliding_effort
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def rub(machine, number, t):
    """Add the efforts of all frictions for the multipliers of the constraints to the wrenches of the bodies, and report them."""
    record = record_at(machine)
    for k in range(record.friction.columns.shape[0]):
        force = sliding_effort(machine, k)
        push_coordinate(machine, record.friction.columns[k, COORDINATE], force)
        report(machine, k, force)
    return OK
