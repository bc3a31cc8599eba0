"""Mass that nodes of beams have in common over a whole step, so that energy and momenta are kept.

The momenta of a node are those of its own mass and what its pairs add (`nivel.kernels.bodies.shared_mass`): -m_ab (ċ_a - ċ_b) and, in axes
fixed in its section, h_a. Both are linear in (ċ, ω̄) with one constant symmetric matrix for the machine. So with the means of ċ and ω̄ over a
step and with axes that turn about their own mean ω, as in `nivel.motion.energy_momentum_residual`, the work that their changes take is the
change of the kinetic energy exactly, and they add nothing to the momenta of the machine.
"""

import numpy as np

from nivel.kernels.algebra.vectors import seen, turned
from nivel.kernels.bodies.shared_mass import shared_momenta
from nivel.kernels.record.record import record_at
from nivel.native.function import stage


@stage
def begin_shared_interval(machine):
    """Add to the angular momenta at the start of the step what the pairs have of the state last evaluated."""
    record = record_at(machine)
    bodies, shared, axes, start = record.bodies, record.shared, record.markers.A, record.residual.interval.start
    for k in range(shared.pair.shape[0]):
        a, b, A, B = shared.pair[k, 0], shared.pair[k, 1], axes[shared.pair[k, 2]], axes[shared.pair[k, 3]]
        wa, wb = seen(A, bodies.omega[a]), seen(B, bodies.omega[b])
        ha, hb = shared_momenta(shared.moment[k], shared.turn[k], wa, wb)
        ga, gb = turned(A, ha), turned(B, hb)
        for i in range(3):
            start[a, 6 + i] += ga[i]
            start[b, 6 + i] += gb[i]


@stage
def change_shared_momenta(machine, rates, h):
    """Add to `residual.acceleration` what the pairs add to the changes of momenta per second, and of angular ones at the end of the step.

    The bodies are at their mean place, the markers still at the end, and `residual.y` has the velocities there. rates : those of the
    bodies stand from there on in it.
    """
    record = record_at(machine)
    bodies, own, shared, markers = record.bodies, record.residual, record.shared, record.markers
    start, y, x = own.interval.start, own.y, own.acceleration
    for k in range(shared.pair.shape[0]):
        a, b, m, n = shared.pair[k, 0], shared.pair[k, 1], shared.pair[k, 2], shared.pair[k, 3]
        va, vb = rates + 6 * np.int64(a) + 3, rates + 6 * np.int64(b) + 3
        wa = seen(markers.frame_b[m], y[va : va + 3])
        wb = seen(markers.frame_b[n], y[vb : vb + 3])
        ha, hb = shared_momenta(shared.moment[k], shared.turn[k], wa, wb)
        ga, gb = turned(markers.A[m], ha), turned(markers.A[n], hb)
        for i in range(3):
            x[a, i] += ga[i] / h
            x[b, i] += gb[i] / h
            # ċ₁ - ċ₀ = 2 (u - ċ₀), u twice the way to the mean place per step
            gained = 4.0 * (bodies.R[a, i] + bodies.c[a, i] - start[a, i]) / h - 2.0 * start[a, 3 + i]
            lost = 4.0 * (bodies.R[b, i] + bodies.c[b, i] - start[b, i]) / h - 2.0 * start[b, 3 + i]
            force = shared.mass[k] * (gained - lost) / h
            x[a, 3 + i] -= force
            x[b, 3 + i] += force
