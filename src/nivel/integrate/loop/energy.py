"""The energy constraint of geometric elimination (report 44, eqs. 121–136, in the form that works).

After positions and velocities are back on their constraints, the velocities are scaled so that T + V - W + dissipated keeps its value
at the start. Scaling keeps Ċ = C_q v = 0 where no constraint depends on time.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import EVALUATIONS, TIME, UNCONSERVED, run_at
from nivel.kernels.bodies.rigid import turn_to_body_axes
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import energies
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# The energy that is missing is a small share of the kinetic energy; near rest it is not, and no scale factor is meant by it.
LARGEST_SHARE = 0.1


@leaf
def conserve(evaluate, machine, history):
    """Scale the velocities of y, just evaluated, and evaluate again. States too near to rest are left and counted. Returns a status."""
    run = run_at(history)
    record = record_at(machine)
    bodies, y = record.bodies, run.y
    for b in range(bodies.mass.shape[0]):
        turn_to_body_axes(bodies, b)
    kinetic, potential = energies(machine)
    last = y.shape[0] - 1
    missing = record.control.energy[2] + y[last - 1] - y[last] - potential - kinetic
    if missing == 0.0:
        return OK  # at rest for good, where no factor is known
    if not np.abs(missing) <= LARGEST_SHARE * kinetic:
        run.counter[UNCONSERVED] += 1
        return OK
    factor = np.sqrt(1.0 + missing / kinetic)
    for k in range(run.plain.shape[0]):
        y[run.plain[k, 1]] *= factor
    for k in range(run.turns.shape[0]):
        for i in range(3):
            y[run.turns[k, 1] + i] *= factor
    run.counter[EVALUATIONS] += 1
    return call_evaluate(evaluate, machine, run.clock[TIME], y, run.rate)
