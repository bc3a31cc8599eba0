"""Direct correction of states with flexible bodies (report 44, §5.5): positions, turns and modal coordinates, then velocities."""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.rotation import rates_of_parameters
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.direct import MAX_CORRECTIONS, NEAR, NOTHING, POSITIONS, VELOCITIES
from nivel.motion.floating_frame import read_flexible_state, unwhiten_all, whiten_all_rows
from nivel.motion.newton_euler import WIDTH, normalise


@stage
def find_flexible_change(machine, attempt, factorised):
    """As `nivel.motion.direct.find_change`, with the modes, whose change is left in `pddot`."""
    record = record_at(machine)
    saddle, constraints, tolerance = record.saddle, record.constraints, record.control.stabilise
    at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
    if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
        return OK, NOTHING, factorised
    if not factorised:
        status = whiten_all_rows(machine)
        if status == OK:
            status = factorise_rows(machine, WIDTH)
        if status != OK:
            return status, NOTHING, False
    correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
    unwhiten_all(machine)
    near = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
    return OK, POSITIONS if at_positions else VELOCITIES, near


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ, p) or to (Ṙ, ω̄, ṗ)."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    nb, modes = bodies.mass.shape[0], own.p.shape[0]
    first = 7 * nb + modes
    for b in range(nb):
        if what == POSITIONS:
            turn = record.saddle.z[b]
            rates_of_parameters(bodies.theta[b], bodies.alpha_b[b], turn)
            for i in range(3):
                y[7 * b + i] += bodies.Rddot[b, i]
            for i in range(4):
                y[7 * b + 3 + i] += turn[i]
        else:
            for i in range(3):
                y[first + 6 * b + i] += bodies.Rddot[b, i]
                y[first + 6 * b + 3 + i] += bodies.alpha_b[b, i]
    at = 7 * nb if what == POSITIONS else first + 6 * nb
    for j in range(modes):
        y[at + j] += own.pddot[j]


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, least in the mass metric; see `nivel.motion.newton_euler_correction`."""
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        normalise(machine, y)
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
