"""Flexible bodies over a whole step, so that energy and momenta are kept; see `nivel.motion.energy_momentum_residual`.

Velocities are those of the centre of mass (ċ), ω̄ and ṗ. About the centre of mass the kinetic energy is ½ (ω̄, ṗ)ᵀ M(p) (ω̄, ṗ); its momenta
(Π̄, π) = M (ω̄, ṗ) are found with the velocity V = -(ω̄ × S + B ṗ)/m of the frame's origin, in axes of the body, for which the linear
momentum vanishes. Over a step, with means of both ends,

    ΔT = m Δċ · ċ_m + ΔΠ̄ · ω̄_m + Δπ · ṗ_m - ½ (ω̄, ṗ)₀ᵀ ΔM (ω̄, ṗ)₁

so a force G = ½ (ω̄, ṗ)₀ᵀ M' (ω̄, ṗ)₁ on the modes, at their mean, takes the place of the velocity forces: G · Δp is that last term without
any error where M is quadratic in the modes, as it is without geometric stiffening.

A point moves by Δ(A s) = Δψ × ½ (A₀ s₀ + A₁ s₁) + Â Δs, with Δψ = h ω of the Cayley turn and Â = (1 - ¼ h² ω̃ ω̃) ½ (A₀ + A₁): forces act at
the mean of both places, which two bodies that meet there have in common, and on the modes by Â.
"""

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.floating_dynamics import frame_momenta
from nivel.kernels.bodies.floating_frame import FACTORS, TURN, dot_modes, find_node, modal_momentum, modes_of, turned
from nivel.kernels.record.flexible_record import SHORTENING, TURNING
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage


@stage
def origin_velocity(mass, own, f, w, rates, at):
    """V of flexible body f for ω̄ = w and the modal rates at `at` and behind it of `rates`, axes of the body."""
    S, B, (_, n) = own.first[f], own.coupling[f], modes_of(own, f)
    swing = cross(w, S)
    return (
        -(swing[0] + dot_modes(B[0], rates, at, n)) / mass,
        -(swing[1] + dot_modes(B[1], rates, at, n)) / mass,
        -(swing[2] + dot_modes(B[2], rates, at, n)) / mass,
    )


@stage
def central_momentum(bodies, own, f, w):
    """(V, Π̄) of flexible body f for ω̄ = w and the modal rates `pdot`; its modal momenta π are left in `pddot`."""
    first, n = modes_of(own, f)
    V = origin_velocity(bodies.mass[own.body[f]], own, f, w, own.pdot, first)
    for j in range(n):
        own.pddot[first + j] = own.pdot[first + j] + modal_momentum(own.coupling[f], V, w, j)
    return V, frame_momenta(bodies, own, f, V, w, own.pdot, first)[1]


@stage
def begin_flexible_interval(machine):
    """Note momenta about the centres of mass, and places and axes of frames at interfaces, of the state last evaluated."""
    record = record_at(machine)
    bodies, own, interval = record.bodies, record.flexible, record.residual.interval
    for f in range(own.body.shape[0]):
        b = own.body[f]
        first, n = modes_of(own, f)
        A, w, start = bodies.A[b], bodies.omega_b[b], interval.start[b]
        V, momentum = central_momentum(bodies, own, f, (w[0], w[1], w[2]))
        for i in range(3):
            # bodies.c is A S/m
            start[3 + i] = bodies.Rdot[b, i] - dot(A[i], V)
            start[6 + i] = dot(A[i], momentum)
            start[9 + i] = momentum[i]
        for j in range(n):
            interval.modal[first + j] = own.pddot[first + j]
    for k in range(own.frame.shape[0]):
        v, at = own.frame[k, 1], interval.frame[k]
        for i in range(3):
            at[i] = bodies.R[v, i]
            for j in range(3):
                at[3 + 3 * i + j] = bodies.A[v, i, j]


@stage
def mean_inertia_force(mass, own, f, w, u, base, y, at, out):
    """G of flexible body f for ω̄ = w at the start and u at the end, and modal rates at `at` and behind it of `base` and `y`; subtracted
    from out (n,). Returns its power with the mean rates `pdot`, a real number."""
    most = own.I3.shape[2]
    first, n = modes_of(own, f)
    B, T = own.coupling[f], own.bulge[f]
    V, U = origin_velocity(mass, own, f, w, base, at), origin_velocity(mass, own, f, u, y, at)
    one, other = cross(U, w), cross(V, u)
    xx, yy, zz = w[0] * u[0], w[1] * u[1], w[2] * u[2]
    xy, yz, zx = w[0] * u[1] + w[1] * u[0], w[1] * u[2] + w[2] * u[1], w[2] * u[0] + w[0] * u[2]
    turning, shortening = own.terms[f, TURNING] != 0 or own.terms[f, SHORTENING] != 0, own.terms[f, SHORTENING] != 0
    power = 0.0
    for j in range(n):
        total = 2.0 * (
            xx * T[j] + yy * T[most + j] + zz * T[2 * most + j]
            + xy * T[3 * most + j] + yz * T[4 * most + j] + zx * T[5 * most + j]
        )  # fmt: skip
        for i in range(3):
            total += B[i, j] * (one[i] + other[i])
        if turning:
            row = own.of_coupling[f * most + j]
            for i in range(3):
                for k in range(n):
                    total += row[i * most + k] * (w[i] * y[at + k] + u[i] * base[at + k])
        if shortening:
            row = own.of_acceleration[f * most + j]
            for i in range(3):
                for k in range(n):
                    total += row[i * most + k] * (U[i] * base[at + k] + V[i] * y[at + k])
        out[j] -= 0.5 * total
        power += 0.5 * real(total) * real(own.pdot[first + j])
    return power


@leaf
def hat_column(A, w, h, j):
    """Column j of Â for mean axes A (3, 3), mean angular velocity w and step h."""
    a = A[0, j], A[1, j], A[2, j]
    twice = cross(w, cross(w, a))
    share = 0.25 * h * h
    return a[0] - share * twice[0], a[1] - share * twice[1], a[2] - share * twice[2]


@stage
def mean_frame(machine, k, h):
    """Bring frame k at an interface, whose body is at its mean place, from the end of the step to its own mean place and velocities, and
    take its wrench away."""
    record = record_at(machine)
    bodies, own, at = record.bodies, record.flexible, record.residual.interval.frame[k]
    f, v = own.frame[k, 0], own.frame[k, 1]
    b, (first, n) = own.body[f], modes_of(own, f)
    A, w = bodies.A[b], bodies.omega[b]
    find_node(own, k)
    node, now = own.node[k], own.now[k]
    q, a, c = (node[TURN], node[TURN + 1], node[TURN + 2]), node[FACTORS], node[FACTORS + 1]
    x, y, z = turned(q, (1.0, 0.0, 0.0), a, c), turned(q, (0.0, 1.0, 0.0), a, c), turned(q, (0.0, 0.0, 1.0), a, c)
    X, Y, Z = hat_column(A, w, h, 0), hat_column(A, w, h, 1), hat_column(A, w, h, 2)
    for i in range(6):
        bodies.wrench[v, i] = 0.0
    for i in range(3):
        bodies.Rdot[v, i] = (bodies.R[v, i] - at[i]) / h
        bodies.R[v, i] = 0.5 * (bodies.R[v, i] + at[i])
        bodies.c[v, i] = bodies.R[v, i] - bodies.R[b, i]
        H0, H1, H2 = dot(A[i], x), dot(A[i], y), dot(A[i], z)
        displacement, turn = own.displacement[k, i], own.turn[k, i]
        for j in range(n):
            displacement[j] = X[i] * now[0, j] + Y[i] * now[1, j] + Z[i] * now[2, j]
            turn[j] = H0 * now[3, j] + H1 * now[4, j] + H2 * now[5, j]
        bodies.omega[v, i] = w[i] + dot_modes(turn, own.pdot, first, n)
        for j in range(3):
            bodies.A[v, i, j] = 0.5 * (bodies.A[v, i, j] + at[3 + 3 * i + j])


@stage
def load_mean_modes(machine):
    """Start `Q` with elastic and damping forces of the modes, and the power that the latter lose."""
    record = record_at(machine)
    own, control = record.flexible, record.control
    for f in range(own.body.shape[0]):
        first, n = modes_of(own, f)
        for j in range(first, first + n):
            damping = own.damping[f, j - first] * own.pdot[j]
            own.Q[j] = -own.stiffness[f, j - first] * own.p[j] - damping
            control.power[1] += own.pdot[j] * damping


@stage
def modal_elastic_energy(own):
    """½ pᵀ K p of all modes [J], a real number."""
    total = 0.0
    for f in range(own.body.shape[0]):
        first, n = modes_of(own, f)
        for j in range(n):
            p = real(own.p[first + j])
            total += 0.5 * own.stiffness[f, j] * p * p
    return total


@stage
def balance_modes(machine, h, value):
    """Subtract the forces on all modes from value (m,), with what is left for velocities of the centres of mass: Q - Bᵀ Âᵀ (F - m g)/m."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    g = bodies.gravity
    for f in range(own.body.shape[0]):
        b, (first, n) = own.body[f], modes_of(own, f)
        A, w, B, m, F = bodies.A[b], bodies.omega[b], own.coupling[f], bodies.mass[b], bodies.wrench[b]
        applied = F[0] / m - g[0], F[1] / m - g[1], F[2] / m - g[2]
        x = dot(hat_column(A, w, h, 0), applied)
        y = dot(hat_column(A, w, h, 1), applied)
        z = dot(hat_column(A, w, h, 2), applied)
        for j in range(n):
            value[first + j] -= own.Q[first + j] - (B[0, j] * x + B[1, j] * y + B[2, j] * z)


@stage
def note_central_inertia(machine, f, h):
    """What `nivel.kernels.bodies.locked_motion` has to know of flexible body f at its mean place: its inertia about the centre of mass,
    and what
    its modes alone do to the velocity of that and to the angular momentum about it, as real numbers."""
    record = record_at(machine)
    bodies, own, interval = record.bodies, record.flexible, record.residual.interval
    b, first = own.body[f], modes_of(own, f)[0]
    S, J, m = own.first[f], own.inertia[f], bodies.mass[b]
    square = real(S[0]) ** 2 + real(S[1]) ** 2 + real(S[2]) ** 2
    for i in range(3):
        for j in range(3):
            part = real(S[i]) * real(S[j]) / m - (square / m if i == j else 0.0)
            interval.inertia[b, i, j] = real(J[i, j]) + part
    none = 0.0 * own.pdot[first]
    V = origin_velocity(m, own, f, (none, none, none), own.pdot, first)
    own_momentum = frame_momenta(bodies, own, f, V, (none, none, none), own.pdot, first)[1]
    A, w = bodies.A[b], bodies.omega[b]
    X, Y, Z = hat_column(A, w, h, 0), hat_column(A, w, h, 1), hat_column(A, w, h, 2)
    for i in range(3):
        # V is that of the origin against the centre of mass
        interval.internal[b, i] = -real(X[i] * V[0] + Y[i] * V[1] + Z[i] * V[2])
        interval.internal[b, 3 + i] = real(dot(A[i], own_momentum))


@stage
def push_modes(machine, f, spin, factor, p, h):
    """Add `factor` times the modal momenta for the angular velocity `spin` (global) and the rates `pdot` to the modal forces, and what the
    force factor p on the centre of mass would take from them. Returns twice the kinetic energy in these momenta, a real number."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    b, (first, n) = own.body[f], modes_of(own, f)
    A, w, B, m = bodies.A[b], bodies.omega[b], own.coupling[f], bodies.mass[b]
    s = (
        real(A[0, 0]) * spin[0] + real(A[1, 0]) * spin[1] + real(A[2, 0]) * spin[2],
        real(A[0, 1]) * spin[0] + real(A[1, 1]) * spin[1] + real(A[2, 1]) * spin[2],
        real(A[0, 2]) * spin[0] + real(A[1, 2]) * spin[1] + real(A[2, 2]) * spin[2],
    )
    V = origin_velocity(m, own, f, s, own.pdot, first)
    x = dot(hat_column(A, w, h, 0), p)
    y = dot(hat_column(A, w, h, 1), p)
    z = dot(hat_column(A, w, h, 2), p)
    twice = 0.0
    for j in range(n):
        momentum = real(own.pdot[first + j]) + real(B[0, j] * V[0] + B[1, j] * V[1] + B[2, j] * V[2])
        momentum += real(B[3, j]) * s[0] + real(B[4, j]) * s[1] + real(B[5, j]) * s[2]
        twice += momentum * real(own.pdot[first + j])
        own.Q[first + j] += factor * (momentum + real(B[0, j] * x + B[1, j] * y + B[2, j] * z) / m)
    return twice
