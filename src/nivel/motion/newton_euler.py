"""Absolute coordinates, Newton–Euler equations: six velocities a body, v = (Ṙ, ω̄), q = (R, θ) (report 44, eqs. 90–93).

Modal coordinates p of flexible bodies stand behind (R, θ) of all bodies, ṗ behind (Ṙ, ω̄). All else that these bodies do otherwise is in
`nivel.kernels.bodies.floating_dynamics`, called by the hooks MODES and FACTORS of the machines that have them.

For a frame origin away from the centre of mass the unknowns are changed to w = (R̈ + α × c, ᾱ), in which the mass matrix is
diag(m, J̄_c): the same equations, and its factor costs nothing.
"""

from nivel.kernels.algebra.rotation import normalise_parameters, rates_of_parameters
from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.algebra.vectors import minus, moment, put, seen, times, turned
from nivel.kernels.bodies import floating_dynamics
from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.bodies.marker import move_markers, place_markers
from nivel.kernels.bodies.rigid import load_weight, place_body
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family, measure_active
from nivel.kernels.record.record import CORRECT, EVALUATE, FACTORS, MODES, record_at
from nivel.kernels.residual.residual import fill_residual, write_rows
from nivel.kernels.solve.saddle import factorise_rows
from nivel.motion.direct import POSITIONS, correct_levels, find_accelerations
from nivel.native.entry import entry
from nivel.native.function import leaf, shared, stage

WIDTH = 6


@stage
def normalise(machine, y):
    """θ := θ/|θ| for every body."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        normalise_parameters(y[7 * b + 3 : 7 * b + 7])


@stage
def read_bodies(bodies, y, first):
    """Poses and velocities of bodies; the latter stand from `first` on."""
    for b in range(bodies.mass.shape[0]):
        place_body(bodies, b, y[7 * b : 7 * b + 7])
        v = first + 6 * b
        for i in range(3):
            bodies.Rdot[b, i] = y[v + i]
            bodies.omega_b[b, i] = y[v + 3 + i]
        multiply(bodies.A[b], bodies.omega_b[b], bodies.omega[b])


@leaf
def first_rate(record):
    """Where velocities stand in y: behind (R, θ) of the bodies and the modal coordinates of flexible ones."""
    return 7 * record.bodies.mass.shape[0] + record.flexible.p.shape[0]


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and markers, and all constraint rows. Returns a status."""
    record = record_at(machine)
    bodies, own, first = record.bodies, record.flexible, first_rate(record)
    read_bodies(bodies, y, first)
    nb, modes = bodies.mass.shape[0], own.p.shape[0]
    for j in range(modes):
        own.p[j], own.pdot[j] = y[7 * nb + j], y[first + 6 * nb + j]
    call_hook(machine, MODES, floating_dynamics.BEND, t)
    status = read_markers(machine, t)
    call_hook(machine, MODES, floating_dynamics.OWN_BIAS, t)
    return status


@stage
def read_markers(machine, t):
    """Markers and all constraint rows from the poses and velocities of the bodies. Returns a status."""
    record = record_at(machine)
    place_markers(record.bodies, record.markers)
    move_markers(record.bodies, record.markers)
    constraint_rows(record.bodies, record.markers, record.constraints)
    return measure_active(machine, t)


@stage
def whiten_rows(machine):
    """W = C_q L⁻ᵀ: force part over √m; moment about the centre of mass through J̄_c^{-1/2} Aᵀ (kept in G)."""
    record = record_at(machine)
    bodies, markers, saddle = record.bodies, record.markers, record.saddle
    J = record.constraints.J
    for b in range(bodies.mass.shape[0]):
        A, K, B = bodies.A[b], bodies.whitener_b[b], saddle.G[b]
        for j in range(3):
            B[0, j] = K[0, 0] * A[j, 0]
            B[1, j] = K[1, 0] * A[j, 0] + K[1, 1] * A[j, 1]
            B[2, j] = K[2, 0] * A[j, 0] + K[2, 1] * A[j, 1] + K[2, 2] * A[j, 2]
    for k in range(saddle.block.shape[0]):
        part, marker, b = saddle.block[k, 1], saddle.block[k, 2], saddle.block[k, 3]
        if b >= bodies.mass.shape[0]:
            continue  # of the modes of a flexible body
        W, about_centre = saddle.W[k], moment(J[part], minus(markers.u[marker], bodies.c[b]))
        put(W, 0, times(bodies.inverse_root_mass[b], J[part]))
        put(W, 3, turned(saddle.G[b], about_centre))


@stage
def whiten_forces(machine):
    """z = L⁻¹ (Q_e + Q_v): force - m ω × (ω × c) over √m; J̄_c^{-1/2} (moment about the centre of mass - ω̄ × J̄_c ω̄)."""
    record = record_at(machine)
    bodies, saddle = record.bodies, record.saddle
    for b in range(bodies.mass.shape[0]):
        F, c, w, w_b = bodies.wrench[b], bodies.c[b], bodies.omega[b], bodies.omega_b[b]
        A, J, K, z = bodies.A[b], bodies.inertia_b[b], bodies.whitener_b[b], saddle.z[b]
        m, root = bodies.mass[b], bodies.inverse_root_mass[b]
        wc, ww = dot(w, c), dot(w, w)
        for i in range(3):
            z[i] = root * (F[i] - m * (w[i] * wc - c[i] * ww))
        # moment about the centre of mass, global axes
        torque = minus((F[3], F[4], F[5]), cross(c, F))
        m0, m1, m2 = minus(seen(A, torque), cross(w_b, turned(J, w_b)))
        z[3] = K[0, 0] * m0
        z[4] = K[1, 0] * m0 + K[1, 1] * m1
        z[5] = K[2, 0] * m0 + K[2, 1] * m1 + K[2, 2] * m2


@stage
def unwhiten(bodies, saddle, b):
    """(R̈, ᾱ) of body b from z = Lᵀ (R̈ + α × c, ᾱ); also the change of (R, rotation) or of (Ṙ, ω̄) in a correction."""
    z, K, root = saddle.z[b], bodies.whitener_b[b], bodies.inverse_root_mass[b]
    alpha, c, a, A = bodies.alpha_b[b], bodies.c[b], bodies.Rddot[b], bodies.A[b]
    alpha[0] = K[0, 0] * z[3] + K[1, 0] * z[4] + K[2, 0] * z[5]
    alpha[1] = K[1, 1] * z[4] + K[2, 1] * z[5]
    alpha[2] = K[2, 2] * z[5]
    put(a, 0, minus(times(root, z), cross(turned(A, alpha), c)))


@stage
def unwhiten_all(machine):
    """Accelerations of all bodies and modes from z; also their changes in a correction."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        unwhiten(record.bodies, record.saddle, b)
    call_hook(machine, FACTORS, floating_dynamics.UNWHITEN, 0.0)


@stage
def write_rate(bodies, ydot, b, first):
    """(Ṙ, θ̇, R̈, ᾱ) of body b in ẏ; the latter two stand from `first` on for all bodies."""
    q, v = 7 * b, first + 6 * b
    rates_of_parameters(bodies.theta[b], bodies.omega_b[b], ydot[q + 3 : q + 7])
    for i in range(3):
        ydot[q + i] = bodies.Rdot[b, i]
        ydot[v + i] = bodies.Rddot[b, i]
        ydot[v + 3 + i] = bodies.alpha_b[b, i]


@stage
def write_rates(machine, ydot):
    """(Ṙ, θ̇, ṗ, R̈, ᾱ, p̈) of ẏ."""
    record = record_at(machine)
    bodies, own, first = record.bodies, record.flexible, first_rate(record)
    nb = bodies.mass.shape[0]
    for b in range(nb):
        write_rate(bodies, ydot, b, first)
    for j in range(own.p.shape[0]):
        ydot[7 * nb + j], ydot[first + 6 * nb + j] = own.pdot[j], own.pddot[j]


@stage
def change_body(record, y, b, first, at_positions):
    """Add the change left in `Rddot` and `alpha_b` of body b to its (R, θ), or to its (Ṙ, ω̄), which stand from `first` on."""
    bodies = record.bodies
    if at_positions:
        turn = record.saddle.z[b]
        rates_of_parameters(bodies.theta[b], bodies.alpha_b[b], turn)
        for i in range(3):
            y[7 * b + i] += bodies.Rddot[b, i]
        for i in range(4):
            y[7 * b + 3 + i] += turn[i]
    else:
        v = first + 6 * b
        for i in range(3):
            y[v + i] += bodies.Rddot[b, i]
            y[v + 3 + i] += bodies.alpha_b[b, i]


@stage
def factorise(machine, y):
    """W of all rows, and the factor of S; y is not needed for them here. Returns a status."""
    whiten_rows(machine)
    status = call_hook(machine, FACTORS, floating_dynamics.FACTORISE, 0.0)
    return factorise_rows(machine, WIDTH) if status == OK else status


@stage
def load_bodies(machine, t, y):
    """All applied forces on bodies and modes. Returns a status."""
    load_weight(record_at(machine).bodies)
    status = apply_forces(machine, t, y)
    return call_hook(machine, MODES, floating_dynamics.GATHER, t) if status == OK else status


@stage
def whiten_all_forces(machine, y):
    """z of all bodies and modes; y is not needed for it here."""
    whiten_forces(machine)
    call_hook(machine, FACTORS, floating_dynamics.WHITEN, 0.0)


@shared
def accelerate(machine, t, y, ydot):
    """Multipliers, accelerations, and the rates of the states of forces and energies, from the state read before. Returns a status."""
    status = find_accelerations(machine, t, y, ydot, WIDTH, load_bodies, factorise, whiten_all_forces)
    if status == OK:
        unwhiten_all(machine)
        call_hook(machine, FACTORS, floating_dynamics.FRAMES, t)
    return status


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record.
    """
    status = read_state(machine, t, y)
    if status == OK:
        status = accelerate(machine, t, y, ydot)
    if status == OK:
        write_rates(machine, ydot)
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing because A is taken of θ/|θ|."""
    normalise(machine, y)
    return OK


@stage
def read_normalised(machine, t, y):
    """The state, with Euler parameters of unit length. Returns a status."""
    normalise(machine, y)
    return read_state(machine, t, y)


@stage
def apply_change(machine, y, what):
    """Apply the change found to (R, θ, p) or (Ṙ, ω̄, ṗ)."""
    record = record_at(machine)
    nb, first = record.bodies.mass.shape[0], first_rate(record)
    unwhiten_all(machine)
    for b in range(nb):
        change_body(record, y, b, first, what == POSITIONS)
    at = 7 * nb if what == POSITIONS else first + 6 * nb
    for j in range(record.flexible.p.shape[0]):
        y[at + j] += record.flexible.pddot[j]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_normalised, factorise, apply_change)


@stage
def accelerate_bodies(machine):
    """`residual.acceleration` of all bodies and frames from (R̈, ᾱ, p̈) in `residual.vdot`."""
    record = record_at(machine)
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    count = bodies.mass.shape[0]
    for b in range(count):
        A, x, v = bodies.A[b], own.acceleration[b], own.vdot[6 * b : 6 * b + 6]
        put(x, 0, turned(A, (v[3], v[4], v[5])))
        put(x, 3, v)
    for j in range(flexible.p.shape[0]):
        flexible.pddot[j] = own.vdot[6 * count + j]
    call_hook(machine, MODES, floating_dynamics.MOVE_FRAMES, 0.0)


@stage
def write_bodies(machine):
    """The rows of all bodies and modes from `residual.wrench`, rates of the states of forces, and constraints."""
    record = record_at(machine)
    bodies, own, count = record.bodies, record.residual, record.bodies.mass.shape[0]
    call_hook(machine, MODES, floating_dynamics.NEEDED, 0.0)
    for b in range(count):
        A, F = bodies.A[b], own.wrench[b]
        put(own.value, 6 * b, (F[3], F[4], F[5]))
        put(own.value, 6 * b + 3, seen(A, F))
    write_rows(machine, 6 * count + record.flexible.p.shape[0])


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    return fill_residual(machine, t, read_state, accelerate_bodies, write_bodies)
