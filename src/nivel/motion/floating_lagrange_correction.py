"""Direct correction of states of the Lagrange equations with flexible bodies (report 44, §5.5): (R, θ, p), then their rates. The change is
least in the metric M + μ θ θᵀ."""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.record import correct_signature, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.floating_lagrange import factorise, read_flexible_state, unwhiten_all
from nivel.motion.lagrange import WIDTH, first_rate


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ, p) or to (Ṙ, θ̇, ṗ)."""
    record = record_at(machine)
    nb, own, z = record.bodies.mass.shape[0], record.flexible, record.saddle.z
    first = 0 if what == POSITIONS else first_rate(record)
    unwhiten_all(machine)
    for b in range(nb):
        for i in range(7):
            y[first + 7 * b + i] += z[b, i]
    for j in range(own.p.shape[0]):
        y[first + 7 * nb + j] += own.pddot[j]


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_flexible_state, factorise, change)
