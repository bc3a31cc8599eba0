"""Direct correction of states of the Lagrange equations with flexible bodies (report 44, §5.5): (R, θ, p), then their rates."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.kernels.record import correct_signature, record_at
from nivel.kernels.saddle import correction, exceeds, factorise_rows
from nivel.kernels.status import OK
from nivel.motion.direct import MAX_CORRECTIONS, NEAR
from nivel.motion.floating_lagrange import factorise_masses, read_flexible_state, unwhiten_all, whiten_all_rows
from nivel.motion.lagrange import WIDTH, first_rate


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, least in the metric M + μ θ θᵀ; see `nivel.motion.lagrange_correction`."""
    record = record_at(machine)
    constraints, saddle, own = record.constraints, record.saddle, record.flexible
    nb, tolerance = record.bodies.mass.shape[0], record.control.stabilise
    factorised = False
    for attempt in range(MAX_CORRECTIONS + 1):
        status = read_flexible_state(machine, t, y)
        if status != OK:
            return status
        positions = attempt < MAX_CORRECTIONS and exceeds(saddle, constraints.C, constraints.scale, tolerance[2])
        if not positions and not exceeds(saddle, constraints.Cdot, constraints.scale, tolerance[3]):
            return OK
        if not factorised:
            status = factorise_masses(machine)
            if status != OK:
                return status
            whiten_all_rows(machine, y)
            status = factorise_rows(machine, WIDTH)
            if status != OK:
                return status
        factorised = not exceeds(saddle, constraints.C, constraints.scale, NEAR * tolerance[2])
        correction(machine, constraints.C if positions else constraints.Cdot, WIDTH)
        unwhiten_all(machine)
        first = 0 if positions else first_rate(record)
        for b in range(nb):
            for i in range(7):
                y[first + 7 * b + i] += saddle.z[b, i]
        for j in range(own.p.shape[0]):
            y[first + 7 * nb + j] += own.pddot[j]
        if not positions:
            return OK
    return OK
