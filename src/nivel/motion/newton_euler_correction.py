"""Direct correction of states of the Newton–Euler equations (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.rotation import rates_of_parameters
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.newton_euler import WIDTH, normalise, read_state, unwhiten, whiten_rows

MAX_CORRECTIONS = 3
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137).

    The report's pseudo-inverse weighs metres and radians alike; here the change is least in the mass metric, which does not depend
    on units and uses the same matrix S. A level within its tolerance (control.stabilise[2:4], as a share of the row's scale) is left alone.
    """
    record = record_at(machine)
    bodies, saddle, constraints = record.bodies, record.saddle, record.constraints
    nb = bodies.mass.shape[0]
    tolerance = record.control.stabilise
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        normalise(machine, y)
        status = read_state(machine, t, y)
        if status != OK:
            return status
        at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
        if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
            return OK
        if not factorised:
            whiten_rows(machine)
            status = factorise_rows(machine, WIDTH)
            if status != OK:
                return status
        factorised = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
        correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
        for b in range(nb):
            unwhiten(bodies, saddle, b)
            if at_positions:
                turn, change = bodies.alpha_b[b], saddle.z[b]
                rates_of_parameters(bodies.theta[b], turn, change)
                for i in range(3):
                    y[7 * b + i] += bodies.Rddot[b, i]
                for i in range(4):
                    y[7 * b + 3 + i] += change[i]
            else:
                v = 7 * nb + 6 * b
                for i in range(3):
                    y[v + i] += bodies.Rddot[b, i]
                    y[v + 3 + i] += bodies.alpha_b[b, i]
        if not at_positions:
            return OK
    return OK
