"""Direct correction of states in three rotation coordinates with flexible bodies (report 44, §5.5): (R, φ, p), then their rates."""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.record import correct_signature, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.floating_frame import factorise, unwhiten_all
from nivel.motion.floating_lagrange_three import read_flexible_state
from nivel.motion.lagrange_three import change_body, first_rate
from nivel.motion.newton_euler import WIDTH


@stage
def change(machine, y, what):
    """Apply the change found to (R, φ, p) or to (Ṙ, φ̇, ṗ)."""
    record = record_at(machine)
    nb, own = record.bodies.mass.shape[0], record.flexible
    first = 0 if what == POSITIONS else first_rate(record)
    unwhiten_all(machine)
    for b in range(nb):
        change_body(record, y, b, first)
    for j in range(own.p.shape[0]):
        y[first + 6 * nb + j] += own.pddot[j]


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_flexible_state, factorise, change)
