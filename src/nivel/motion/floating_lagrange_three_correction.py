"""Direct correction of states in three rotation coordinates with flexible bodies (report 44, §5.5): (R, φ, p), then their rates."""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.spatial import solve
from nivel.kernels.status import OK
from nivel.motion.direct import MAX_CORRECTIONS, NOTHING, POSITIONS, VELOCITIES
from nivel.motion.floating_frame_correction import find_flexible_change
from nivel.motion.floating_lagrange_three import read_flexible_state
from nivel.motion.lagrange_three import first_rate


@stage
def change(machine, y, what):
    """Apply the change found to (R, φ, p) or to (Ṙ, φ̇, ṗ)."""
    record = record_at(machine)
    bodies, own, turn = record.bodies, record.flexible, record.saddle.z
    nb = bodies.mass.shape[0]
    first = 0 if what == POSITIONS else first_rate(record)
    for b in range(nb):
        k = first + 6 * b
        solve(record.rotations.G[b], bodies.alpha_b[b], turn[b])
        for i in range(3):
            y[k + i] += bodies.Rddot[b, i]
            y[k + 3 + i] += turn[b, i]
    for j in range(own.p.shape[0]):
        y[first + 6 * nb + j] += own.pddot[j]


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137), least in the mass metric."""
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read_flexible_state(machine, t, y)
        if status != OK:
            return status
        status, what, factorised = find_flexible_change(machine, attempt, factorised)
        if status != OK or what == NOTHING:
            return status
        change(machine, y, what)
        if what == VELOCITIES:
            return OK
    return OK
