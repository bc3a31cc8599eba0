"""Direct correction of states of the Lagrange equations in three rotation coordinates (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.lagrange_three import change_body, read_state
from nivel.motion.newton_euler import WIDTH, factorise, unwhiten
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def change(machine, y, what):
    """Apply the change found to (R, φ) or to (Ṙ, φ̇)."""
    record = record_at(machine)
    nb = record.bodies.mass.shape[0]
    first = 0 if what == POSITIONS else 6 * nb
    for b in range(nb):
        unwhiten(record.bodies, record.saddle, b)
        change_body(record, y, b, first)


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_state, factorise, change)
