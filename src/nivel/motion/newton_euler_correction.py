"""Direct correction of states of the Newton–Euler equations (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.newton_euler import WIDTH, change_body, factorise, normalise, read_state, unwhiten
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_normalised(machine, t, y):
    """The state, with Euler parameters of unit length. Returns a status."""
    normalise(machine, y)
    return read_state(machine, t, y)


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ) or (Ṙ, ω̄)."""
    record = record_at(machine)
    nb = record.bodies.mass.shape[0]
    for b in range(nb):
        unwhiten(record.bodies, record.saddle, b)
        change_body(record, y, b, 7 * nb, what == POSITIONS)


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_normalised, factorise, change)
