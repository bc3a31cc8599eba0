"""Direct correction of states with flexible bodies (report 44, §5.5): positions, turns and modal coordinates, then velocities."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT, record_at
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.floating_frame import factorise, read_flexible_state, unwhiten_all
from nivel.motion.newton_euler import WIDTH, change_body, normalise
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_normalised(machine, t, y):
    """The state, with Euler parameters of unit length. Returns a status."""
    normalise(machine, y)
    return read_flexible_state(machine, t, y)


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ, p) or to (Ṙ, ω̄, ṗ)."""
    record = record_at(machine)
    nb, modes = record.bodies.mass.shape[0], record.flexible.p.shape[0]
    first = 7 * nb + modes
    unwhiten_all(machine)
    for b in range(nb):
        change_body(record, y, b, first, what == POSITIONS)
    at = 7 * nb if what == POSITIONS else first + 6 * nb
    for j in range(modes):
        y[at + j] += record.flexible.pddot[j]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_normalised, factorise, change)
