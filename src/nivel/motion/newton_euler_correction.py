"""Direct correction of states of the Newton–Euler equations (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.compile import entry, stage
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.rotation import rates_of_parameters
from nivel.kernels.status import OK
from nivel.motion.direct import MAX_CORRECTIONS, NOTHING, POSITIONS, VELOCITIES, find_change
from nivel.motion.newton_euler import normalise, read_state


@stage
def change(machine, y, what):
    """Apply the change found to (R, θ) or (Ṙ, ω̄)."""
    record = record_at(machine)
    bodies, saddle = record.bodies, record.saddle
    nb = bodies.mass.shape[0]
    for b in range(nb):
        if what == POSITIONS:
            turn = saddle.z[b]
            rates_of_parameters(bodies.theta[b], bodies.alpha_b[b], turn)
            for i in range(3):
                y[7 * b + i] += bodies.Rddot[b, i]
            for i in range(4):
                y[7 * b + 3 + i] += turn[i]
        else:
            v = 7 * nb + 6 * b
            for i in range(3):
                y[v + i] += bodies.Rddot[b, i]
                y[v + 3 + i] += bodies.alpha_b[b, i]


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137).

    The report's pseudo-inverse weighs metres and radians alike; here the change is least in the mass metric, which does not depend
    on units and uses the same matrix S.
    """
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        normalise(machine, y)
        status = read_state(machine, t, y)
        if status != OK:
            return status
        status, what, factorised = find_change(machine, attempt, factorised)
        if status != OK or what == NOTHING:
            return status
        change(machine, y, what)
        if what == VELOCITIES:
            return OK
    return OK
