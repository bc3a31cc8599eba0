"""Flexible bodies in a floating frame of reference with modes (Rantalainen 2007, eqs. 3.49–3.83, by invariants).

A point is at R + A (x + φ p), velocities are (Ṙ, ω̄, ṗ). The frame at an interface has the axes A exp(ψ p)~: of the first order in the
modes like the displacement, but a rotation, so that joints hold exactly.

Modes have unit modal mass, so the mass matrix in axes of the body [M_b B; Bᵀ 1] is factorised from the modes on: what is left of the frame
is M_b - B Bᵀ = L Lᵀ, 6 × 6 for any number of modes.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf, stage
from nivel.kernels.geometric_stiffening import add_shortening, add_velocity_forces, product
from nivel.kernels.record import NONE, record_at
from nivel.kernels.spatial import centripetal, cross, dot, multiply

# terms of the series of the rotation of a node, exact to round-off up to two radians
TERMS = 12


@leaf
def turn_factors(square):
    """(a, b, a'/θ, b'/θ) of a = (1 - cos θ)/θ², b = (θ - sin θ)/θ³ for θ²: of the angles of nodes, far below a turn."""
    a, b, da, db = 0.0 * square, 0.0 * square, 0.0 * square, 0.0 * square
    power, before = 1.0 + 0.0 * square, 0.0 * square
    factorial = 2.0
    for k in range(TERMS):
        a += power / factorial
        b += power / (factorial * (2 * k + 3))
        da += 2 * k * before / factorial
        db += 2 * k * before / (factorial * (2 * k + 3))
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
def bend(machine):
    """Everything of the flexible bodies that depends on their modal coordinates, from `p`, `pdot` and the places of their frames."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    for f in range(own.body.shape[0]):
        b, width = own.body[f], own.I3.shape[2]
        first, n = modes_of(own, f)
        S, J, B = own.first[f], own.inertia[f], own.coupling[f]
        for i in range(3):
            S[i] = own.I2[f, i] + dot_modes(own.I3[f, i], own.p, first, n)
            for j in range(3):
                J[i, j] = own.I7[f, i, j]
            for k in range(n):
                B[i, k], B[3 + i, k] = own.I3[f, i, k], own.I4[f, i, k]
        w = bodies.omega_b[b]
        for j in range(n):
            at, p = f * width + j, own.p[first + j]
            for i in range(3):
                total = 0.0 * p
                for c in range(3):
                    # T = I8_j + I9_kj p_k
                    T = own.I8[at, i, c] + 0.0 * p
                    for k in range(n):
                        T += own.I9[(f * width + k) * width + j, i, c] * own.p[first + k]
                    total += T * w[c]
                    J[i, c] += p * (T + own.I8[at, c, i])
                own.static[f, j, i] = total
                for k in range(n):
                    B[3 + i, k] += p * own.I5[at, i, k]
        if own.of_spin.shape[0] > 0:
            add_shortening(own, f, first, n)
        # the centre of mass, which the weight acts at
        multiply(bodies.A[b], S, bodies.c[b])
        for i in range(3):
            bodies.c[b, i] /= bodies.mass[b]
    for k in range(own.frame.shape[0]):
        place_frame(bodies, own, k)


@leaf
def dot_modes(row, p, first, n):
    """Σ row[k] p[first + k]."""
    total = 0.0 * p[first]
    for k in range(n):
        total += row[k] * p[first + k]
    return total


@stage
def follow_node(own, k, i, first, n):
    """Displacement (i below 3) or turn of the node of frame k by the modes, its rate, and its second derivative for p̈ = 0; what one of
    each mode moves it by is left in `now`."""
    shape, now = own.shape[k, i], own.now[k, i]
    value, rate, second = 0.0 * own.p[first], 0.0 * own.p[first], 0.0 * own.p[first]
    for j in range(n):
        now[j] = shape[j] + 0.0 * own.p[first]
        value += shape[j] * own.p[first + j]
    if own.of_load.shape[0] > 0:
        K = own.of_load[6 * k + i]
        value -= 0.5 * product(K, own.p, own.p, first, n)
        second -= product(K, own.pdot, own.pdot, first, n)
        for j in range(n):
            for c in range(n):
                now[j] -= K[j, c] * own.p[first + c]
    for j in range(n):
        rate += now[j] * own.pdot[first + j]
    return value, rate, second


@stage
def place_frame(bodies, own, k):
    """Place, axes and velocities of frame k at an interface, its motion by the modes, and its accelerations for none of theirs."""
    f, v = own.frame[k, 0], own.frame[k, 1]
    b = own.body[f]
    first, n = modes_of(own, f)
    A, w, now, bias = bodies.A[b], bodies.omega[b], own.now[k], own.bias[k]
    ux, vx, ax = follow_node(own, k, 0, first, n)
    uy, vy, ay = follow_node(own, k, 1, first, n)
    uz, vz, az = follow_node(own, k, 2, first, n)
    qx, wx, bx = follow_node(own, k, 3, first, n)
    qy, wy, by = follow_node(own, k, 4, first, n)
    qz, wz, bz = follow_node(own, k, 5, first, n)
    u = own.place_b[k, 0] + ux, own.place_b[k, 1] + uy, own.place_b[k, 2] + uz
    q, qdot = (qx, qy, qz), (wx, wy, wz)
    a, c, da, dc = turn_factors(dot(q, q))
    spin, more, further = turned(q, qdot, a, c), bias_of_turn(q, qdot, a, c, da, dc), turned(q, (bx, by, bz), a, c)
    arm, rate, turning = bodies.c[v], bodies.Rdot[v], bodies.omega[v]
    multiply(A, u, arm)
    multiply(A, (vx, vy, vz), rate)
    multiply(A, spin, turning)
    second = more[0] + further[0], more[1] + further[1], more[2] + further[2]
    coriolis, across = cross(w, rate), cross(w, turning)
    centripetal(w, arm, bias[3:6])
    moved = cross(w, arm)
    for i in range(3):
        bias[i] = across[i] + dot(A[i], second)
        bias[3 + i] += 2.0 * coriolis[i] + dot(A[i], (ax, ay, az))
        bodies.R[v, i] = bodies.R[b, i] + arm[i]
        rate[i] += bodies.Rdot[b, i] + moved[i]
        turning[i] += w[i]
    # columns of A exp(q~) = A (1 + q~ H)
    for j in range(3):
        e = (1.0 if j == 0 else 0.0), (1.0 if j == 1 else 0.0), (1.0 if j == 2 else 0.0)
        swing = cross(q, turned(q, e, a, c))
        for i in range(3):
            bodies.A[v, i, j] = A[i, j] + dot(A[i], swing)
    for j in range(n):
        spin = turned(q, (now[3, j], now[4, j], now[5, j]), a, c)
        for i in range(3):
            own.displacement[k, i, j] = A[i, 0] * now[0, j] + A[i, 1] * now[1, j] + A[i, 2] * now[2, j]
            own.turn[k, i, j] = dot(A[i], spin)


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
        row, part, marker = (
            saddle.block[own.block[e, 0], 0],
            saddle.block[own.block[e, 0], 1],
            saddle.block[own.block[e, 0], 2],
        )
        J, bias = constraints.J[part], own.bias[k]
        across = cross(bias, markers.u[marker])
        for i in range(3):
            constraints.gamma[row] -= J[i] * (bias[3 + i] + across[i]) + J[3 + i] * bias[i]


@stage
def gather(machine):
    """Bring the wrenches at interfaces to the floating frames and to `Q`, with weight, elastic and damping forces of the modes."""
    record = record_at(machine)
    bodies, own, control = record.bodies, record.flexible, record.control
    for j in range(own.Q.shape[0]):
        own.Q[j] = 0.0
    for k in range(own.frame.shape[0]):
        f, v = own.frame[k, 0], own.frame[k, 1]
        b = own.body[f]
        first, n = modes_of(own, f)
        F, total = bodies.wrench[v], bodies.wrench[b]
        moment = cross(bodies.c[v], F)
        for j in range(n):
            power = 0.0 * F[0]
            for i in range(3):
                power += own.displacement[k, i, j] * F[i] + own.turn[k, i, j] * F[3 + i]
            own.Q[first + j] += power
        for i in range(3):
            total[i] += F[i]
            total[3 + i] += F[3 + i] + moment[i]
        for i in range(6):
            F[i] = 0.0
    for f in range(own.body.shape[0]):
        A, g, B = bodies.A[own.body[f]], bodies.gravity, own.coupling[f]
        first, n = modes_of(own, f)
        g_b = dot(A[:, 0], g), dot(A[:, 1], g), dot(A[:, 2], g)
        for j in range(n):
            elastic = dot_modes(own.stiffness[f, j], own.p, first, n)
            damping = dot_modes(own.damping[f, j], own.pdot, first, n)
            weight = B[0, j] * g_b[0] + B[1, j] * g_b[1] + B[2, j] * g_b[2]
            own.Q[first + j] += weight - elastic - damping
            control.stored[0] += 0.5 * own.p[first + j] * elastic
            control.power[1] += own.pdot[first + j] * damping


@stage
def velocity_forces(bodies, own, f, out):
    """Quadratic velocity force of the frame of flexible body f into out (6,), axes of the body; that of its modes is added to `Q`."""
    b = own.body[f]
    first, n = modes_of(own, f)
    width, w, S, J = own.I3.shape[2], bodies.omega_b[b], own.first[f], own.inertia[f]
    drift = (
        dot_modes(own.I3[f, 0], own.pdot, first, n),
        dot_modes(own.I3[f, 1], own.pdot, first, n),
        dot_modes(own.I3[f, 2], own.pdot, first, n),
    )
    centripetal(w, S, out[:3])
    coriolis = cross(w, drift)
    gyroscopic = cross(w, (dot(J[0], w), dot(J[1], w), dot(J[2], w)))
    for i in range(3):
        out[i] = -out[i] - 2.0 * coriolis[i]
        out[3 + i] = -gyroscopic[i]
    for j in range(n):
        at, t = f * width + j, own.static[f, j]
        force = dot(w, t)
        for i in range(3):
            out[3 + i] -= 2.0 * own.pdot[first + j] * t[i]
            force += 2.0 * w[i] * dot_modes(own.I5[at, i], own.pdot, first, n)
        own.Q[first + j] += force
    if own.of_spin.shape[0] > 0:
        add_velocity_forces(own, f, w, first, n, out)


@stage
def factorise_frame(bodies, own, f):
    """root[f] := L of M_b - B Bᵀ = L Lᵀ."""
    L, B, S, J, b = own.root[f], own.coupling[f], own.first[f], own.inertia[f], own.body[f]
    m, (_, n) = bodies.mass[b], modes_of(own, f)
    for i in range(6):
        for j in range(i + 1):
            L[i, j] = J[i - 3, j - 3] if i > 2 and j > 2 else 0.0
    for i in range(3):
        L[i, i] = m
    # S~ of M_θR
    L[3, 1], L[3, 2], L[4, 0], L[4, 2], L[5, 0], L[5, 1] = -S[2], S[1], S[2], -S[0], -S[1], S[0]
    for i in range(6):
        for j in range(i + 1):
            total = L[i, j]
            for k in range(n):
                total -= B[i, k] * B[j, k]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            L[i, j] = np.sqrt(total) if i == j else total / L[j, j]


@leaf
def whiten_frame(L, x):
    """x (6,) := L⁻¹ x."""
    for i in range(6):
        total = x[i]
        for k in range(i):
            total -= L[i, k] * x[k]
        x[i] = total / L[i, i]


@stage
def whiten_flexible_rows(machine):
    """W of all blocks of flexible bodies: of their frames L⁻¹ (C_qr - C_qp Bᵀ)ᵀ, of their modes C_qp."""
    record = record_at(machine)
    bodies, own, markers, saddle, J = (
        record.bodies,
        record.flexible,
        record.markers,
        record.saddle,
        record.constraints.J,
    )
    for f in range(own.body.shape[0]):
        factorise_frame(bodies, own, f)
    for e in range(own.block.shape[0]):
        at, k, f, modal = own.block[e, 0], own.block[e, 1], own.block[e, 2], own.block[e, 3]
        A, B = bodies.A[own.body[f]], own.coupling[f]
        _, n = modes_of(own, f)
        part, u, W = J[saddle.block[at, 1]], markers.u[saddle.block[at, 2]], saddle.W[at]
        across = cross(u, part)
        # about the node; then about the origin of the floating frame
        M = part[3] + across[0], part[4] + across[1], part[5] + across[2]
        lever = (0.0, 0.0, 0.0) if k == NONE else cross(bodies.c[own.frame[k, 1]], part)
        for i in range(3):
            W[i] = A[0, i] * part[0] + A[1, i] * part[1] + A[2, i] * part[2]
            W[3 + i] = A[0, i] * (M[0] + lever[0]) + A[1, i] * (M[1] + lever[1]) + A[2, i] * (M[2] + lever[2])
        for j in range(n):
            power = 0.0
            if k != NONE:
                for i in range(3):
                    power += own.displacement[k, i, j] * part[i] + own.turn[k, i, j] * M[i]
            saddle.W[modal + j // 6, j % 6] = power
            for i in range(6):
                W[i] -= B[i, j] * power
        whiten_frame(own.root[f], W)


@stage
def whiten_flexible_forces(machine):
    """z of all flexible bodies: of their frames, then of their modes in rows of six behind all bodies."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        first, n = modes_of(own, f)
        A, B, F, z = bodies.A[b], own.coupling[f], bodies.wrench[b], saddle.z[b]
        velocity_forces(bodies, own, f, z)
        for i in range(3):
            z[i] += A[0, i] * F[0] + A[1, i] * F[1] + A[2, i] * F[2]
            z[3 + i] += A[0, i] * F[3] + A[1, i] * F[4] + A[2, i] * F[5]
        for j in range(n):
            saddle.z[at + j // 6, j % 6] = own.Q[first + j]
            for i in range(6):
                z[i] -= B[i, j] * own.Q[first + j]
        whiten_frame(own.root[f], z)
        at += (n + 5) // 6


@stage
def unwhiten_flexible(machine):
    """(R̈, ᾱ) of the frames of flexible bodies and p̈ from z; also changes of (R, rotation, p) or (Ṙ, ω̄, ṗ) in a correction."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        first, n = modes_of(own, f)
        L, B, x = own.root[f], own.coupling[f], saddle.z[b]
        for i in range(5, -1, -1):
            total = x[i]
            for k in range(i + 1, 6):
                total -= L[k, i] * x[k]
            x[i] = total / L[i, i]
        multiply(bodies.A[b], x[:3], bodies.Rddot[b])
        for i in range(3):
            bodies.alpha_b[b, i] = x[3 + i]
        for j in range(n):
            total = saddle.z[at + j // 6, j % 6]
            for i in range(6):
                total -= B[i, j] * x[i]
            own.pddot[first + j] = total
        at += (n + 5) // 6


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
def flexible_rows(machine):
    """Rows of the residual of flexible bodies: M v̇ - Q_v - Q of their frames and modes."""
    record = record_at(machine)
    bodies, own, residual = record.bodies, record.flexible, record.residual
    modal = 6 * np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        first, n = modes_of(own, f)
        A, S, J, B, F, q = (
            bodies.A[b],
            own.first[f],
            own.inertia[f],
            own.coupling[f],
            bodies.wrench[b],
            own.velocity_force[f],
        )
        at = 6 * np.int64(b)
        x, alpha = residual.vdot[at : at + 3], residual.vdot[at + 3 : at + 6]
        a = dot(A[:, 0], x), dot(A[:, 1], x), dot(A[:, 2], x)
        velocity_forces(bodies, own, f, q)
        swing, heave = cross(alpha, S), cross(S, a)
        for i in range(3):
            q[i] = bodies.mass[b] * a[i] + swing[i] - q[i]
            q[3 + i] = heave[i] + dot(J[i], alpha) - q[3 + i] - dot(A[:, i], F[3:6])
        for j in range(n):
            rate = own.pddot[first + j]
            total = rate - own.Q[first + j]
            for i in range(3):
                total += B[i, j] * a[i] + B[3 + i, j] * alpha[i]
                q[i] += B[i, j] * rate
                q[3 + i] += B[3 + i, j] * rate
            residual.value[modal + first + j] = total
        multiply(A, q[:3], residual.value[at : at + 3])
        for i in range(3):
            residual.value[at + i] -= F[i]
            residual.value[at + 3 + i] = q[3 + i]


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


@stage
def flexible_kinetic_energy(bodies, own, f):
    """½ m |Ṙ|² + Ṙᵀ A (ω̄ × S + I3 ṗ) + ½ ω̄ᵀ J̄ ω̄ + ω̄ᵀ C ṗ + ½ |ṗ|² of flexible body f [J]."""
    b = own.body[f]
    first, n = modes_of(own, f)
    A, V, w, S, J, B = bodies.A[b], bodies.Rdot[b], bodies.omega_b[b], own.first[f], own.inertia[f], own.coupling[f]
    v = dot(A[:, 0], V), dot(A[:, 1], V), dot(A[:, 2], V)
    total = 0.5 * bodies.mass[b] * dot(v, v) + dot(v, cross(w, S))
    total += 0.5 * (w[0] * dot(J[0], w) + w[1] * dot(J[1], w) + w[2] * dot(J[2], w))
    for j in range(n):
        rate = own.pdot[first + j]
        along = B[0, j] * v[0] + B[1, j] * v[1] + B[2, j] * v[2]
        total += rate * (along + B[3, j] * w[0] + B[4, j] * w[1] + B[5, j] * w[2] + 0.5 * rate)
    return total
