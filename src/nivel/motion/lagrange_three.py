"""Absolute coordinates, Lagrange equations in three rotation coordinates: q = (R, φ), v = q̇, six a body (report 44, eqs. 57–77).

φ are Euler angles or the rotation vector, ω̄ = Ḡ φ̇ with their own Ḡ. With T = diag(1, Ḡ) of all bodies, the report's mass matrix
(m_RR = m 1, m_Rθ = -m c̃ A Ḡ, m_θθ = Ḡᵀ J̄_O Ḡ) is Tᵀ M T with M of (Ṙ, ω̄), and its C_q, with (n + u × f)ᵀ A Ḡ for φ, is that of
(Ṙ, ω̄) times T. So Tᵀ L is a factor of the mass matrix where L is one of M; whitened by it, rows and forces (eqs. 63, 71) are those of
the Newton–Euler equations, and so are the multipliers. Ḡ appears where the state is read and where φ̈ = Ḡ⁻¹ (ᾱ - Ḡ̇ φ̇) is written.
"""

from nivel.kernels.algebra import euler_angles, rotation_vector
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import product
from nivel.kernels.algebra.spatial import multiply, solve
from nivel.kernels.algebra.vectors import put, seen
from nivel.kernels.bodies.rigid import set_axes
from nivel.kernels.core.status import OK, ROTATION_SINGULAR
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import CORRECT, EULER_ANGLES, EVALUATE, record_at
from nivel.kernels.residual.residual import fill_residual, write_rows
from nivel.motion.direct import POSITIONS, correct_levels
from nivel.motion.newton_euler import WIDTH, accelerate, factorise, read_markers, unwhiten_all
from nivel.native.entry import entry
from nivel.native.function import leaf, stage

# Nearer to a singular position φ turns so much faster than the body that steps no longer follow it: where the body turns by 0.01 rad
# a step, passing at this distance (2.9° from parallel axes, 17° from a full turn) leaves an error of about 1e-5 rad with RK4.
SINGULAR = 0.05


@stage
def turn_body(rotations, b, phi, phidot):
    """θ of A(φ), Ḡ and Ḡ̇ φ̇ of body b; ω̄ = Ḡ φ̇ in body axes."""
    N, theta, G, bias = rotations.turned_b[b], rotations.theta[b], rotations.G[b], rotations.bias[b]
    if rotations.kind[0] == EULER_ANGLES:
        rotations.regularity[b] = euler_angles.turn(phi, phidot, theta, G, bias)
    else:
        rotations.regularity[b] = rotation_vector.turn(phi, phidot, theta, G, bias)
    for k in range(3):
        x, y, z = G[0, k], G[1, k], G[2, k]
        for i in range(3):
            G[i, k] = N[i, 0] * x + N[i, 1] * y + N[i, 2] * z
    x, y, z = bias[0], bias[1], bias[2]
    for i in range(3):
        bias[i] = N[i, 0] * x + N[i, 1] * y + N[i, 2] * z


@leaf
def first_rate(record):
    """Where q̇ stands in y: behind (R, φ) of the bodies."""
    return 6 * record.bodies.mass.shape[0]


@stage
def read_bodies(machine, y):
    """Poses and velocities of bodies."""
    record = record_at(machine)
    bodies, rotations = record.bodies, record.rotations
    for b in range(bodies.mass.shape[0]):
        q, v = 6 * b, first_rate(record) + 6 * b
        phidot = y[v + 3 : v + 6]
        turn_body(rotations, b, y[q + 3 : q + 6], phidot)
        product(rotations.space[b], rotations.theta[b], bodies.theta[b])
        product(bodies.theta[b], rotations.body[b], bodies.theta[b])
        set_axes(bodies, b)
        for i in range(3):
            bodies.R[b, i], bodies.Rdot[b, i] = y[q + i], y[v + i]
        multiply(rotations.G[b], phidot, bodies.omega_b[b])
        multiply(bodies.A[b], bodies.omega_b[b], bodies.omega[b])


@stage
def find_singular(machine):
    """ROTATION_SINGULAR where the coordinates of a body are near a singular position."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        if real(record.rotations.regularity[b]) < SINGULAR:
            record.control.failure[0] = b
            return ROTATION_SINGULAR
    return OK


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and markers, and all constraint rows. Returns a status."""
    read_bodies(machine, y)
    status = read_markers(machine, t)
    singular = find_singular(machine)
    return status if singular == OK else singular


@stage
def change_body(record, y, b, first):
    """Add the change left in `Rddot` and `alpha_b` of body b to its (R, φ) or (Ṙ, φ̇), which stand from `first` on for all bodies."""
    k, turn = first + 6 * b, record.saddle.z[b]
    solve(record.rotations.G[b], record.bodies.alpha_b[b], turn)
    for i in range(3):
        y[k + i] += record.bodies.Rddot[b, i]
        y[k + 3 + i] += turn[i]


@stage
def write_rate(machine, y, ydot, b):
    """(q̇, q̈) of body b in ẏ, from its accelerations."""
    record = record_at(machine)
    bodies, rotations = record.bodies, record.rotations
    q, v = 6 * b, first_rate(record) + 6 * b
    for i in range(6):
        ydot[q + i] = y[v + i]
    for i in range(3):
        ydot[v + i] = bodies.Rddot[b, i]
        ydot[v + 3 + i] = bodies.alpha_b[b, i] - rotations.bias[b, i]
    solve(rotations.G[b], ydot[v + 3 : v + 6], ydot[v + 3 : v + 6])


@stage
def write_rates(machine, y, ydot):
    """(q̇, q̈) of ẏ, and the accelerations of the bodies."""
    for b in range(record_at(machine).bodies.mass.shape[0]):
        write_rate(machine, y, ydot, b)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, q̇, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record.
    """
    status = read_state(machine, t, y)
    if status == OK:
        status = accelerate(machine, t, y, ydot)
    if status == OK:
        write_rates(machine, y, ydot)
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction: three coordinates have nothing to normalise."""
    return OK


@stage
def apply_change(machine, y, what):
    """Apply the change found to (R, φ) or to (Ṙ, φ̇)."""
    record = record_at(machine)
    nb = record.bodies.mass.shape[0]
    first = 0 if what == POSITIONS else 6 * nb
    unwhiten_all(machine)
    for b in range(nb):
        change_body(record, y, b, first)


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_state, factorise, apply_change)


# The residual of the Lagrange equations in three rotation coordinates: rows of (Ṙ, φ̇) of every body.
#
# ω̄ = Ḡ φ̇ and ᾱ = Ḡ φ̈ + Ḡ̇ φ̇ ask for the moment of the Newton–Euler equations; the rows of φ are Ḡᵀ times that.


@stage
def accelerate_bodies(machine):
    """`residual.acceleration` of all bodies from (R̈, φ̈) in `residual.vdot`."""
    record = record_at(machine)
    bodies, rotations, own = record.bodies, record.rotations, record.residual
    for b in range(bodies.mass.shape[0]):
        x, v, alpha = own.acceleration[b], own.vdot[6 * b : 6 * b + 6], bodies.alpha_b[b]
        multiply(rotations.G[b], v[3:6], alpha)
        for i in range(3):
            alpha[i] += rotations.bias[b, i]
            x[3 + i] = v[i]
        multiply(bodies.A[b], alpha, x[:3])


@stage
def write_bodies(machine):
    """The rows of all bodies from `residual.wrench`, rates of the states of forces, and constraints."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    for b in range(bodies.mass.shape[0]):
        A, F, G = bodies.A[b], own.wrench[b], record.rotations.G[b]
        put(own.value, 6 * b, (F[3], F[4], F[5]))
        put(own.value, 6 * b + 3, seen(G, seen(A, F)))
    write_rows(machine, 6 * bodies.mass.shape[0])


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    return fill_residual(machine, t, read_state, accelerate_bodies, write_bodies)
