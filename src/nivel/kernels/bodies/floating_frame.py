"""Flexible bodies in a floating frame of reference with modes: where they and the frames at their interfaces are (Rantalainen 2007).

A point is at R + A (x + φ p), velocities are (Ṙ, ω̄, ṗ). The frame at an interface has the axes A exp(ψ p)~: of the first order in the
modes like the displacement, but a rotation, so that joints hold exactly.
"""

import numpy as np

from nivel.kernels.algebra.spatial import centripetal, cross, dot, multiply
from nivel.kernels.bodies.geometric_stiffening import FIRST_AXIS, SECOND_AXIS, add_shortening, multiply_rows
from nivel.kernels.record.flexible_record import BULGING, SHORTENING, TURNING
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# terms of the series of the rotation of a node, exact to round-off up to two radians
TERMS = 12
# columns of Flexible.node, axes of the body: place, its rate and second derivative for p̈ = 0, angular velocity and its rate for p̈ = 0,
# axes, rotation vector, its `turn_factors`
PLACE, SPEED, BEND, SPIN, TWIST, AXES, TURN, FACTORS = 0, 3, 6, 9, 12, 15, 24, 27


@leaf
def turn_factors(square):
    """(a, b, a'/θ, b'/θ) of a = (1 - cos θ)/θ², b = (θ - sin θ)/θ³ for θ²: of the angles of nodes, far below a turn."""
    a, b, da, db = 0.0 * square, 0.0 * square, 0.0 * square, 0.0 * square
    power, before = 1.0 + 0.0 * square, 0.0 * square
    factorial = 2.0
    for k in range(TERMS):
        # factors that are known when this is compiled: products with them take a fifth of the time of quotients
        over = 1.0 / factorial
        more = 1.0 / (factorial * (2 * k + 3))
        a += power * over
        b += power * more
        da += before * (2 * k * over)
        db += before * (2 * k * more)
        before = -power
        power *= -square
        factorial *= (2 * k + 3) * (2 * k + 4)
    return a, b, da, db


@leaf
def modes_of(own, f):
    """First mode of flexible body f, and how many it has."""
    first = np.int64(own.mode[f, 0])
    return first, np.int64(own.mode[f, 1]) - first


@stage
def bend_body(bodies, own, f):
    """First moment, inertia and coupling of flexible body f from its modal coordinates; also its centre of mass, where the weight acts."""
    b, most = own.body[f], own.I3.shape[2]
    first, n = modes_of(own, f)
    S, J, B, T, I8 = own.first[f], own.inertia[f], own.coupling[f], own.bulge[f], own.I8[f]
    for i in range(3):
        for k in range(n):
            B[i, k], B[3 + i, k] = own.I3[f, i, k], own.I4[f, i, k]
        S[i] = own.I2[f, i] + dot_modes(own.I3[f, i], own.p, first, n)
    if own.terms[f, BULGING] != 0:
        multiply_rows(own.of_inertia, f * most, own.p, first, n, T, 6 * most)
    else:
        for k in range(6 * most):
            T[k] = 0.0
    for c in range(6):
        value, row = 0.0 * own.p[first], T[c * most : c * most + n]
        for k in range(n):
            value += own.p[first + k] * (2.0 * I8[c, k] + row[k])
            row[k] += I8[c, k]
        i, j = FIRST_AXIS[c], SECOND_AXIS[c]
        J[i, j] = own.I7[f, i, j] + value
        J[j, i] = J[i, j]
    if own.terms[f, TURNING] != 0 or own.terms[f, SHORTENING] != 0:
        extra = own.scratch[0]
        multiply_rows(own.of_coupling, f * most, own.p, first, n, extra, 3 * most)
        for i in range(3):
            for k in range(n):
                B[3 + i, k] += extra[i * most + k]
    if own.terms[f, SHORTENING] != 0:
        add_shortening(own, f, first, n)
    multiply(bodies.A[b], S, bodies.c[b])
    for i in range(3):
        bodies.c[b, i] /= bodies.mass[b]


@stage
def bend(machine):
    """Everything of the flexible bodies that depends on their modal coordinates, from `p`, `pdot` and the places of their frames."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    for f in range(own.body.shape[0]):
        bend_body(bodies, own, f)
    for k in range(own.frame.shape[0]):
        find_node(own, k)
        place_frame(bodies, own, k)


@leaf
def dot_modes(row, p, first, n):
    """Σ row[k] p[first + k]."""
    total = 0.0 * p[first]
    for k in range(n):
        total += row[k] * p[first + k]
    return total


@leaf
def modal_momentum(B, v, w, j):
    """What velocities v and w of the frame, axes of the body, add to the momentum of mode j: Bᵀ (v, w)."""
    return B[0, j] * v[0] + B[1, j] * v[1] + B[2, j] * v[2] + (B[3, j] * w[0] + B[4, j] * w[1] + B[5, j] * w[2])


@stage
def follow_node(own, k, i, first, n):
    """Displacement (i below 3) or turn of the node of frame k by the modes, its rate, and its second derivative for p̈ = 0, with the
    products of its stiffening in `scratch`; what one of each mode moves it by is left in `now`."""
    shape, now, at = own.shape[k, i], own.now[k, i], i * own.I3.shape[2]
    value, rate, second = 0.0 * own.p[first], 0.0 * own.p[first], 0.0 * own.p[first]
    if own.loaded[k] != 0:
        along, across = own.scratch[0, at : at + n], own.scratch[1, at : at + n]
        for j in range(n):
            p, pdot = own.p[first + j], own.pdot[first + j]
            a = shape[j] - along[j]
            now[j] = a
            value += 0.5 * (shape[j] + a) * p
            rate += a * pdot
            second -= pdot * across[j]
    else:
        for j in range(n):
            a = shape[j] + 0.0 * own.p[first]
            now[j] = a
            value += a * own.p[first + j]
            rate += a * own.pdot[first + j]
    return value, rate, second


@stage
def find_node(own, k):
    """Motion of the node of frame k by the modes, seen from its body, into `node`."""
    first, n = modes_of(own, own.frame[k, 0])
    out, most = own.node[k], own.I3.shape[2]
    if own.loaded[k] != 0:
        multiply_rows(own.of_load, k * most, own.p, first, n, own.scratch[0], 6 * most)
        multiply_rows(own.of_load, k * most, own.pdot, first, n, own.scratch[1], 6 * most)
    ux, out[SPEED], out[BEND] = follow_node(own, k, 0, first, n)
    uy, out[SPEED + 1], out[BEND + 1] = follow_node(own, k, 1, first, n)
    uz, out[SPEED + 2], out[BEND + 2] = follow_node(own, k, 2, first, n)
    qx, wx, bx = follow_node(own, k, 3, first, n)
    qy, wy, by = follow_node(own, k, 4, first, n)
    qz, wz, bz = follow_node(own, k, 5, first, n)
    out[PLACE], out[PLACE + 1], out[PLACE + 2] = own.place_b[k, 0] + ux, own.place_b[k, 1] + uy, own.place_b[k, 2] + uz
    q, qdot = (qx, qy, qz), (wx, wy, wz)
    a, c, da, dc = turn_factors(dot(q, q))
    spin, more, further = turned(q, qdot, a, c), bias_of_turn(q, qdot, a, c, da, dc), turned(q, (bx, by, bz), a, c)
    out[TURN], out[TURN + 1], out[TURN + 2], out[FACTORS], out[FACTORS + 1] = qx, qy, qz, a, c
    for i in range(3):
        out[SPIN + i] = spin[i]
        out[TWIST + i] = more[i] + further[i]
    # columns of exp(q~) = 1 + q~ H
    for j in range(3):
        e = (1.0 if j == 0 else 0.0), (1.0 if j == 1 else 0.0), (1.0 if j == 2 else 0.0)
        swing = cross(q, turned(q, e, a, c))
        for i in range(3):
            out[AXES + 3 * i + j] = e[i] + swing[i]


@stage
def move_node(A, w, own, k, arm, rate, turning):
    """Of the node of frame k on a body with axes A and angular velocity w: arm from the origin, rate and angular velocity by the modes
    alone, global axes; its accelerations for none of the body and of the modes in `bias`, and what each mode moves and turns it by."""
    node, now, bias = own.node[k], own.now[k], own.bias[k]
    _, n = modes_of(own, own.frame[k, 0])
    multiply(A, node[PLACE : PLACE + 3], arm)
    multiply(A, node[SPEED : SPEED + 3], rate)
    multiply(A, node[SPIN : SPIN + 3], turning)
    coriolis, across = cross(w, rate), cross(w, turning)
    centripetal(w, arm, bias[3:6])
    for i in range(3):
        bias[i] = across[i] + dot(A[i], node[TWIST : TWIST + 3])
        bias[3 + i] += 2.0 * coriolis[i] + dot(A[i], node[BEND : BEND + 3])
    q, a, c = (node[TURN], node[TURN + 1], node[TURN + 2]), node[FACTORS], node[FACTORS + 1]
    x = turned(q, (1.0, 0.0, 0.0), a, c)
    y = turned(q, (0.0, 1.0, 0.0), a, c)
    z = turned(q, (0.0, 0.0, 1.0), a, c)
    for i in range(3):
        A0, A1, A2 = A[i, 0], A[i, 1], A[i, 2]
        H0, H1, H2 = dot(A[i], x), dot(A[i], y), dot(A[i], z)
        displacement, turn = own.displacement[k, i], own.turn[k, i]
        for j in range(n):
            displacement[j] = A0 * now[0, j] + A1 * now[1, j] + A2 * now[2, j]
        for j in range(n):
            turn[j] = H0 * now[3, j] + H1 * now[4, j] + H2 * now[5, j]


@stage
def place_frame(bodies, own, k):
    """Place, axes and velocities of frame k at an interface from those of its body."""
    v, b = own.frame[k, 1], own.body[own.frame[k, 0]]
    A, w, node = bodies.A[b], bodies.omega[b], own.node[k]
    arm, rate, turning = bodies.c[v], bodies.Rdot[v], bodies.omega[v]
    move_node(A, w, own, k, arm, rate, turning)
    moved = cross(w, arm)
    for i in range(3):
        bodies.R[v, i] = bodies.R[b, i] + arm[i]
        rate[i] += bodies.Rdot[b, i] + moved[i]
        turning[i] += w[i]
        for j in range(3):
            bodies.A[v, i, j] = A[i, 0] * node[AXES + j] + A[i, 1] * node[AXES + 3 + j] + A[i, 2] * node[AXES + 6 + j]


@leaf
def turned(q, x, a, b):
    """H x = x + a q × x + b q × (q × x): angular velocity of exp q~ for q̇ = x, axes before the turn."""
    first = cross(q, x)
    second = cross(q, first)
    return (
        x[0] + a * first[0] + b * second[0],
        x[1] + a * first[1] + b * second[1],
        x[2] + a * first[2] + b * second[2],
    )


@leaf
def bias_of_turn(q, x, a, b, da, db):
    """Ḣ x for q̇ = x."""
    along = dot(q, x)
    first = cross(q, x)
    second, third = cross(q, first), cross(x, first)
    return (
        da * along * first[0] + db * along * second[0] + b * third[0],
        da * along * first[1] + db * along * second[1] + b * third[1],
        da * along * first[2] + db * along * second[2] + b * third[2],
    )


@stage
def add_bias(machine):
    """Let γ of all rows know the accelerations that the frames at interfaces have by themselves."""
    record = record_at(machine)
    own, constraints, markers, saddle = record.flexible, record.constraints, record.markers, record.saddle
    for e in range(own.block.shape[0]):
        k = own.block[e, 1]
        if k == NONE:
            continue
        row, part = saddle.block[own.block[e, 0], 0], saddle.block[own.block[e, 0], 1]
        marker = saddle.block[own.block[e, 0], 2]
        J, bias = constraints.J[part], own.bias[k]
        across = cross(bias, markers.u[marker])
        for i in range(3):
            constraints.gamma[row] -= J[i] * (bias[3 + i] + across[i]) + J[3 + i] * bias[i]


@stage
def move_frames(machine):
    """Accelerations of the frames at interfaces into `residual.acceleration` from those of their bodies and modes, less their bias."""
    record = record_at(machine)
    bodies, own, acceleration = record.bodies, record.flexible, record.residual.acceleration
    for k in range(own.frame.shape[0]):
        f, v = own.frame[k, 0], own.frame[k, 1]
        x, out = acceleration[own.body[f]], acceleration[v]
        first, n = modes_of(own, f)
        across = cross(x, bodies.c[v])
        for i in range(3):
            out[i] = x[i] + dot_modes(own.turn[k, i], own.pddot, first, n)
            out[3 + i] = x[3 + i] + across[i] + dot_modes(own.displacement[k, i], own.pddot, first, n)


@stage
def accelerate_frames(machine):
    """Accelerations of the frames at interfaces from those of their bodies and modes, for sensors."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    for k in range(own.frame.shape[0]):
        f, v = own.frame[k, 0], own.frame[k, 1]
        b, bias = own.body[f], own.bias[k]
        first, n = modes_of(own, f)
        multiply(bodies.A[b], bodies.alpha_b[b], bodies.Rddot[v])
        alpha = bodies.Rddot[v, 0], bodies.Rddot[v, 1], bodies.Rddot[v, 2]
        across, A = cross(alpha, bodies.c[v]), bodies.A[v]
        for i in range(3):
            bodies.Rddot[v, i] = (
                bodies.Rddot[b, i] + across[i] + bias[3 + i] + dot_modes(own.displacement[k, i], own.pddot, first, n)
            )
        turning = (
            alpha[0] + bias[0] + dot_modes(own.turn[k, 0], own.pddot, first, n),
            alpha[1] + bias[1] + dot_modes(own.turn[k, 1], own.pddot, first, n),
            alpha[2] + bias[2] + dot_modes(own.turn[k, 2], own.pddot, first, n),
        )
        for i in range(3):
            bodies.alpha_b[v, i] = A[0, i] * turning[0] + A[1, i] * turning[1] + A[2, i] * turning[2]
