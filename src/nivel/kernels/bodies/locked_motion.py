"""The motion of all bodies as one rigid body that carries their momenta, and what is left of each body's motion without it.

Both are real parts: they are used where no derivatives are taken.
"""

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.native.function import stage

# Of the trace of the inertia: masses on a line, about which nothing turns, have none about it. Its share of the angular momentum is lost to
# the push, which is itself a small share of the forces; round-off of the solution is the inverse of it times that of numbers.
LEAST_INERTIA = 1e-9


@stage
def inertial_moment(bodies, interval, b, w):
    """A J̄ Aᵀ w [kg m²/s] of body b; zero for a point mass."""
    A, J = bodies.A[b], interval.inertia[b]
    x = (
        real(A[0, 0]) * w[0] + real(A[1, 0]) * w[1] + real(A[2, 0]) * w[2],
        real(A[0, 1]) * w[0] + real(A[1, 1]) * w[1] + real(A[2, 1]) * w[2],
        real(A[0, 2]) * w[0] + real(A[1, 2]) * w[1] + real(A[2, 2]) * w[2],
    )
    m = dot(J[0], x), dot(J[1], x), dot(J[2], x)
    return (
        real(A[0, 0]) * m[0] + real(A[0, 1]) * m[1] + real(A[0, 2]) * m[2],
        real(A[1, 0]) * m[0] + real(A[1, 1]) * m[1] + real(A[1, 2]) * m[2],
        real(A[2, 0]) * m[0] + real(A[2, 1]) * m[1] + real(A[2, 2]) * m[2],
    )


@stage
def spin_momentum(bodies, interval, b, w):
    """Angular momentum of body b about its centre of mass, for the angular velocity w and with that of its modes."""
    modes = interval.internal[b]
    return _add(inertial_moment(bodies, interval, b, w), (modes[3], modes[4], modes[5]))


@stage
def centre_and_velocity(bodies, interval, b):
    """Centre of mass of body b [m], its velocity [m/s], and ω [rad/s]."""
    R, c, V, w = bodies.R[b], bodies.c[b], bodies.Rdot[b], bodies.omega[b]
    u = real(c[0]), real(c[1]), real(c[2])
    turn = real(w[0]), real(w[1]), real(w[2])
    across, drift = cross(turn, u), interval.internal[b]
    return (
        (real(R[0]) + u[0], real(R[1]) + u[1], real(R[2]) + u[2]),
        (real(V[0]) + across[0] + drift[0], real(V[1]) + across[1] + drift[1], real(V[2]) + across[2] + drift[2]),
        turn,
    )


@stage
def locked_motion(bodies, interval):
    """(x, y, z) of the centre of mass of all bodies, its velocity, and the angular velocity with which all bodies together, locked, would
    have the angular momentum that they have."""
    mass, xx, xy, xz = 0.0, 0.0, 0.0, 0.0
    vx, vy, vz = 0.0, 0.0, 0.0
    for b in range(bodies.mass.shape[0]):
        m = bodies.mass[b]
        x, u, _ = centre_and_velocity(bodies, interval, b)
        mass += m
        xx, xy, xz = xx + m * x[0], xy + m * x[1], xz + m * x[2]
        vx, vy, vz = vx + m * u[0], vy + m * u[1], vz + m * u[2]
    c, v = (xx / mass, xy / mass, xz / mass), (vx / mass, vy / mass, vz / mass)
    # columns of the inertia of all, and their angular momentum, about the common centre
    p = q = r = h = (0.0, 0.0, 0.0)
    for b in range(bodies.mass.shape[0]):
        m = bodies.mass[b]
        x, u, w = centre_and_velocity(bodies, interval, b)
        d, s = (x[0] - c[0], x[1] - c[1], x[2] - c[2]), (u[0] - v[0], u[1] - v[1], u[2] - v[2])
        p = _add(p, _column(bodies, interval, b, m, d, (1.0, 0.0, 0.0)))
        q = _add(q, _column(bodies, interval, b, m, d, (0.0, 1.0, 0.0)))
        r = _add(r, _column(bodies, interval, b, m, d, (0.0, 0.0, 1.0)))
        swing = cross(d, s)
        h = _add(h, _add((m * swing[0], m * swing[1], m * swing[2]), spin_momentum(bodies, interval, b, w)))
    least = LEAST_INERTIA * (p[0] + q[1] + r[2])
    p, q, r = (p[0] + least, p[1], p[2]), (q[0], q[1] + least, q[2]), (r[0], r[1], r[2] + least)
    determinant = dot(p, cross(q, r))
    return (
        *c,
        *v,
        dot(cross(q, r), h) / determinant,
        dot(cross(r, p), h) / determinant,
        dot(cross(p, q), h) / determinant,
    )


@stage
def _add(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@stage
def _column(bodies, interval, b, m, d, e):
    """Angular momentum of body b about a point d before its centre, per rad/s about the axis e through that point."""
    swing = cross(d, cross(e, d))
    return _add((m * swing[0], m * swing[1], m * swing[2]), inertial_moment(bodies, interval, b, e))


@stage
def internal_motion(bodies, interval, b, locked):
    """Velocity of the centre of mass and angular velocity of body b without the `locked` motion (nine zeros: all of it), with the linear
    momentum and the angular momentum about the centre of mass that belong to them."""
    x, u, w = centre_and_velocity(bodies, interval, b)
    turn = locked[6], locked[7], locked[8]
    across = cross(turn, (x[0] - locked[0], x[1] - locked[1], x[2] - locked[2]))
    own = u[0] - locked[3] - across[0], u[1] - locked[4] - across[1], u[2] - locked[5] - across[2]
    spin = w[0] - turn[0], w[1] - turn[1], w[2] - turn[2]
    m = bodies.mass[b]
    return own, spin, (m * own[0], m * own[1], m * own[2]), spin_momentum(bodies, interval, b, spin)
