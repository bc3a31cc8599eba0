"""Direct correction of states of the Lagrange equations (report 44, §5.5); the change is least in the metric M + μ θ θᵀ."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.lagrange import WIDTH, factorise, read_state, unwhiten
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ) or to (Ṙ, θ̇)."""
    record = record_at(machine)
    nb = record.bodies.mass.shape[0]
    first = 0 if what == POSITIONS else 7 * nb
    for b in range(nb):
        unwhiten(machine, b)
        for i in range(7):
            y[first + 7 * b + i] += record.saddle.z[b, i]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_state, factorise, change)
