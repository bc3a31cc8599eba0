"""The equations of motion as a residual for given accelerations and multipliers: what implicit methods bring to zero.

    r = M v̇ + C_qᵀ λ - Q        C        Ċ = C_q v + C_t        C̈ = C_q v̇ - γ + 2α Ċ + β² C

The feedback of Ċ and C is that of Baumgarte's stabilisation or of penalty methods; there is none with others.

Nothing is factorised here, so it costs little; and the same code on dual numbers gives exact derivatives. Coordinates add
only how accelerations of bodies come from v̇, and generalised forces from wrenches on bodies.
"""

from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.floating_dynamics import GATHER
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.bodies.shared_mass import add_shared_inertia
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook
from nivel.kernels.record.record import GIVEN_FRICTION, MODES, POINTS, record_at
from nivel.native.function import shared, stage


@stage
def load_multipliers(machine, t):
    """Add the forces -C_qᵀ λ of the constraints to the wrenches of the bodies, with the friction that they cause, and the work of drivers
    to the power. Returns a status."""
    record = record_at(machine)
    residual, constraints, markers, wrench = record.residual, record.constraints, record.markers, record.bodies.wrench
    for row in range(constraints.lam.shape[0]):
        constraints.lam[row] = 0.0
    for k in range(residual.row.shape[0]):
        constraints.lam[residual.row[k]] = residual.lam[k]
    for p in range(residual.part.shape[0]):
        lam, J = residual.lam[residual.part[p, 0]], constraints.J[residual.part[p, 1]]
        u, F = markers.u[residual.part[p, 2]], wrench[residual.part[p, 3]]
        x, y, z = lam * J[0], lam * J[1], lam * J[2]
        F[0] -= x
        F[1] -= y
        F[2] -= z
        F[3] -= lam * J[3] + u[1] * z - u[2] * y
        F[4] -= lam * J[4] + u[2] * x - u[0] * z
        F[5] -= lam * J[5] + u[0] * y - u[1] * x
    for k in range(constraints.combination.shape[0]):
        record.control.power[0] -= constraints.lam[constraints.combination[k, 0]] * constraints.motion[k]
    return call_hook(machine, GIVEN_FRICTION, 0, t)


@stage
def known_multiplier(record, k):
    """Multiplier k of the residual as the equations of motion last found it: that of a constraint, or the effort of a friction."""
    rows = record.residual.row.shape[0]
    if k < rows:
        return record.constraints.lam[record.residual.row[k]]
    return record.friction.force[record.residual.stiction[k - rows]]


@stage
def acceleration_of(machine, b):
    """(α, R̈) of body or frame b from `residual.acceleration`: in relative coordinates the whole of it, else that of a frame at an interface
    less its bias."""
    record = record_at(machine)
    x, first = record.residual.acceleration[b], record.bodies.mass.shape[0] + 1
    if b < first or record.tree.node.shape[0] > 0:
        return x[0], x[1], x[2], x[3], x[4], x[5]
    bias = record.flexible.bias[b - first]
    return x[0] + bias[0], x[1] + bias[1], x[2] + bias[2], x[3] + bias[3], x[4] + bias[4], x[5] + bias[5]


@stage
def inertial_wrenches(machine):
    """`residual.wrench` of all bodies: inertial minus applied and constraint wrenches.

    Force m (R̈ + α × c + ω × (ω × c)), moment about the frame origin A (J̄_O ᾱ + ω̄ × J̄_O ω̄) + m c × R̈.
    """
    record = record_at(machine)
    bodies, residual = record.bodies, record.residual
    for b in range(bodies.mass.shape[0]):
        A, J, w, c, F = bodies.A[b], bodies.inertia_origin_b[b], bodies.omega[b], bodies.c[b], bodies.wrench[b]
        m = bodies.mass[b]
        x, out = residual.acceleration[b], residual.wrench[b]
        alpha, a = (x[0], x[1], x[2]), (x[3], x[4], x[5])
        turning, wc, ww, lever = cross(alpha, c), dot(w, c), dot(w, w), cross(c, a)
        for i in range(3):
            out[3 + i] = m * (a[i] + turning[i] + w[i] * wc - c[i] * ww) - F[i]
        w0 = A[0, 0] * w[0] + A[1, 0] * w[1] + A[2, 0] * w[2]
        w1 = A[0, 1] * w[0] + A[1, 1] * w[1] + A[2, 1] * w[2]
        w2 = A[0, 2] * w[0] + A[1, 2] * w[1] + A[2, 2] * w[2]
        a0 = A[0, 0] * x[0] + A[1, 0] * x[1] + A[2, 0] * x[2]
        a1 = A[0, 1] * x[0] + A[1, 1] * x[1] + A[2, 1] * x[2]
        a2 = A[0, 2] * x[0] + A[1, 2] * x[1] + A[2, 2] * x[2]
        h0 = J[0, 0] * w0 + J[0, 1] * w1 + J[0, 2] * w2
        h1 = J[1, 0] * w0 + J[1, 1] * w1 + J[1, 2] * w2
        h2 = J[2, 0] * w0 + J[2, 1] * w1 + J[2, 2] * w2
        n0 = J[0, 0] * a0 + J[0, 1] * a1 + J[0, 2] * a2 + w1 * h2 - w2 * h1
        n1 = J[1, 0] * a0 + J[1, 1] * a1 + J[1, 2] * a2 + w2 * h0 - w0 * h2
        n2 = J[2, 0] * a0 + J[2, 1] * a1 + J[2, 2] * a2 + w0 * h1 - w1 * h0
        for i in range(3):
            out[i] = A[i, 0] * n0 + A[i, 1] * n1 + A[i, 2] * n2 + m * lever[i] - F[3 + i]
    add_shared_inertia(machine)


@shared
def fill_residual(machine, t, read, accelerate, write):
    """The residual in coordinates of single bodies.

    read(machine, t, y) : the state; accelerate(machine) : `residual.acceleration` of all bodies from `vdot`; write(machine) : all rows from
    `residual.wrench`; compiled into this one. Returns a status, as the first does.
    """
    record = record_at(machine)
    status = read(machine, t, record.residual.y)
    if status != OK:
        return status
    accelerate(machine)
    load_weight(record.bodies)
    status = apply_forces(machine, t, record.residual.y)
    if status == OK:
        status = load_multipliers(machine, t)
    if status == OK:
        status = call_hook(machine, POINTS, 0, t)
    if status == OK:
        status = call_hook(machine, MODES, GATHER, t)
    if status == OK:
        inertial_wrenches(machine)
        write(machine)
    return status


@stage
def write_rows(machine, first):
    """Rates of the states of forces, C, Ċ and C̈ into `residual.value` from `first` on; the rows of frictions are there already."""
    record = record_at(machine)
    residual, constraints, markers = record.residual, record.constraints, record.markers
    rate = record.elements.state_rate
    value, rows, states = residual.value, residual.lam.shape[0], rate.shape[0]
    for i in range(states):
        value[first + i] = rate[i]
    at = first + states
    twice_alpha, beta_squared = record.control.stabilise[0], record.control.stabilise[1]
    own = record.control.feedback
    for k in range(residual.row.shape[0]):
        row = residual.row[k]
        value[at + k], value[at + rows + k] = constraints.C[row], constraints.Cdot[row]
        fed_back = twice_alpha * own[row, 0] * constraints.Cdot[row] + beta_squared * own[row, 1] * constraints.C[row]
        value[at + 2 * rows + k] = fed_back - constraints.gamma[row]
    at += 2 * rows
    for p in range(residual.part.shape[0]):
        J, u = constraints.J[residual.part[p, 1]], markers.u[residual.part[p, 2]]
        x = residual.acceleration[residual.part[p, 3]]
        turning = x[1] * u[2] - x[2] * u[1], x[2] * u[0] - x[0] * u[2], x[0] * u[1] - x[1] * u[0]
        along = J[0] * (x[3] + turning[0]) + J[1] * (x[4] + turning[1]) + J[2] * (x[5] + turning[2])
        value[at + residual.part[p, 0]] += along + J[3] * x[0] + J[4] * x[1] + J[5] * x[2]
