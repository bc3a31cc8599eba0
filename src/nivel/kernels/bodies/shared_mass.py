"""Consistent mass of beams: what nodes have in common, in place of what is lumped at each of them.

Mass centres x are interpolated along an element, and so are angular velocities ω̄ in the axes of the unstressed sections. To the kinetic
energy of the lumped masses every pair of nodes a, b then adds

    -½ m_ab |ẋ_a - ẋ_b|² + ½ ω̄_a·h_a + ½ ω̄_b·h_b,        h_a = J_ab (ω̄_b - Q_ba ω̄_a),  h_b = J_abᵀ (ω̄_a - Q_baᵀ ω̄_b)

Q_ba turns axes of a to those of b in the unstressed beam, so a rigid motion of that adds nothing. The energy depends on velocities of
bodies in their own axes only: it is a metric on the group of motions, invariant to where the machine is, and energy and momenta hold.
"""

from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, opposite, plus, seen, times, turned
from nivel.kernels.record.record import record_at
from nivel.native.function import stage


@stage
def shared_momenta(J, Q, wa, wb):
    """(h_a, h_b) = (J (w_b - Q w_a), Jᵀ (w_a - Qᵀ w_b)), each in its own axes."""
    return turned(J, minus(wb, turned(Q, wa))), seen(J, minus(wa, seen(Q, wb)))


@stage
def acceleration_of_centre(bodies, b, x):
    """R̈ + α × c + ω × (ω × c) of body b with x = (α, R̈)."""
    c, w = bodies.c[b], bodies.omega[b]
    turning, wc, ww = cross(x, c), dot(w, c), dot(w, w)
    return (
        x[3] + turning[0] + w[0] * wc - c[0] * ww,
        x[4] + turning[1] + w[1] * wc - c[1] * ww,
        x[5] + turning[2] + w[2] * wc - c[2] * ww,
    )


@stage
def add_to_wrench(A, c, out, force, rate, w, h):
    """Add a force at the mass centre, c from the origin, and the moment ḣ + ω̄ × h in axes A to `out`: (moment about the origin, force)."""
    lever, moment = cross(c, force), turned(A, plus(rate, cross(w, h)))
    for i in range(3):
        out[i] += moment[i] + lever[i]
        out[3 + i] += force[i]


@stage
def add_shared_inertia(machine):
    """Add to `residual.wrench` what pairs of nodes ask for, from `residual.acceleration`."""
    record = record_at(machine)
    bodies, own, shared, axes = record.bodies, record.residual, record.shared, record.markers.A
    for k in range(shared.pair.shape[0]):
        a, b, m = shared.pair[k, 0], shared.pair[k, 1], shared.mass[k]
        J, Q, xa, xb = shared.moment[k], shared.turn[k], own.acceleration[a], own.acceleration[b]
        ca, cb = acceleration_of_centre(bodies, a, xa), acceleration_of_centre(bodies, b, xb)
        force = times(m, minus(cb, ca))
        A, B = axes[shared.pair[k, 2]], axes[shared.pair[k, 3]]
        wa, wb = seen(A, bodies.omega[a]), seen(B, bodies.omega[b])
        ha, hb = shared_momenta(J, Q, wa, wb)
        ra, rb = shared_momenta(J, Q, seen(A, xa), seen(B, xb))
        add_to_wrench(A, bodies.c[a], own.wrench[a], force, ra, wa, ha)
        add_to_wrench(B, bodies.c[b], own.wrench[b], opposite(force), rb, wb, hb)


@stage
def shared_kinetic_energy(bodies, markers, shared, k):
    """What pair k adds to the kinetic energy of the lumped masses [J]."""
    a, b = shared.pair[k, 0], shared.pair[k, 1]
    ca, cb = cross(bodies.omega[a], bodies.c[a]), cross(bodies.omega[b], bodies.c[b])
    square = 0.0
    for i in range(3):
        apart = bodies.Rdot[b, i] + cb[i] - bodies.Rdot[a, i] - ca[i]
        square += apart * apart
    A, B = markers.A[shared.pair[k, 2]], markers.A[shared.pair[k, 3]]
    wa, wb = seen(A, bodies.omega[a]), seen(B, bodies.omega[b])
    ha, hb = shared_momenta(shared.moment[k], shared.turn[k], wa, wb)
    return 0.5 * (dot(wa, ha) + dot(wb, hb) - shared.mass[k] * square)
