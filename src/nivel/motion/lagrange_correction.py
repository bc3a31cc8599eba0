"""Direct correction of states of the Lagrange equations (report 44, §5.5)."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.lagrange import WIDTH, factorise_mass, read_state, unwhiten, whiten_rows

MAX_CORRECTIONS = 3
# Violations up to this many times the tolerance leave the factor of S good enough for the next pass.
NEAR = 1e7


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137).

    The change is least in the mass metric M + μ θ θᵀ instead of the report's unit weights; see `newton_euler_correction.correct`.
    A level within its tolerance (control.stabilise[2:4], as a share of the row's scale) is left alone.
    """
    record = record_at(machine)
    constraints, saddle = record.constraints, record.saddle
    nb = record.bodies.mass.shape[0]
    tolerance = record.control.stabilise
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read_state(machine, t, y)
        if status != OK:
            return status
        at_positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
        if not at_positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
            return OK
        if not factorised:
            factorise_mass(machine)
            whiten_rows(machine, y)
            status = factorise_rows(machine, WIDTH)
            if status != OK:
                return status
        factorised = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
        correction(machine, constraints.C if at_positions else constraints.Cdot, WIDTH)
        first = 0 if at_positions else 7 * nb
        for b in range(nb):
            unwhiten(machine, b)
            for i in range(7):
                y[first + 7 * b + i] += saddle.z[b, i]
        if not at_positions:
            return OK
    return OK
