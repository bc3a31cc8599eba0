"""Derivatives of elements of beams by hand: material, geometric and inertial tangents (Simo, Vu-Quoc 1986; Crisfield, Jelenić 1999).

Seen from the reference node r, an element has the potential U(y_a, ψ_a), y_a = R_rᵀ (x_a - x_r), with forces P and the symmetric
stiffness k. At a point, with the potential M·T(ψ) ψ' of given moments and N·exp(-ψ̃) y' of given forces,

    k = Bᵀ C B + ∂²(M·T ψ')/∂(ψ, ψ')² + that of N,        δΓ = Qᵀ δy' + (Qᵀ y')~ T δψ,   δΚ = E δψ + T δψ'

Nodes feel f_a = R_r P_a and t_a = R_a T_a⁻ᵀ P_ψa; the reference node what balances them. Their changes for a motion (δx, δθ) of the nodes
follow from k and from how these forces turn, and rows are their work on the motions of the unknowns. While the other derivatives are
found on dual numbers the elements keep their wrenches (`nivel.elements.beams.exact.hold`), which gives what turns of rows do to them; for
plain nodes that is done here too, with their inertia.
"""

import numpy as np

from nivel.elements.beams.exact import (
    SHAPE,
    SLOPE,
    STRAIN,
    WEIGHT,
    WIDTH,
    ElementRow,
    along_line,
    rotated,
    row_by,
    six_by_six,
    sum_of,
    tangent_product,
)
from nivel.kernels.algebra.inverse_tangent import inverse_tangent_by, inverse_tangent_factor, slope_of_factor
from nivel.kernels.algebra.relative_rotation import rotation_vector
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, opposite, plus, put, seen, seen_flat, times, turned
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.tangent import inverse_tangent
from nivel.native.function import leaf, stage

# what `job` asks for: all parts as Newton's iteration combines them, or one of them
TOTAL, ACCELERATIONS, VELOCITIES, POSITIONS = 0, 1, 2, 3
TERMS = 10
# BeamTangent.local: from here on η of T⁻¹ of each node, then η'/ψ
ETA, ETA_SLOPE = 24, 28


@leaf
def series(square):
    """b = (1 - cos ψ)/ψ², c = (ψ - sin ψ)/ψ³ for ψ², their derivatives over ψ, and those of these over ψ: (b, c, b₁, c₁, b₂, c₂)."""
    b, c, b1, c1, b2, c2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    # b = Σ (-1)^k ψ^2k/(2k+2)!, c with (2k+3)!
    p0, p1, p2, factorial = 1.0, 0.0, 0.0, 2.0
    for k in range(TERMS):
        over = 1.0 / factorial
        more = over / (2 * k + 3)
        first, second = 2.0 * k, 2.0 * k * (2 * k - 2)
        b, c = b + p0 * over, c + p0 * more
        b1, c1 = b1 + first * p1 * over, c1 + first * p1 * more
        b2, c2 = b2 + second * p2 * over, c2 + second * p2 * more
        p2, p1, p0 = -p1, -p0, -p0 * square
        factorial *= (2 * k + 3) * (2 * k + 4)
    return b, c, b1, c1, b2, c2


@stage
def unit(i):
    """The unit vector along axis i."""
    return 1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0


@stage
def stiffness_of_point(own, n, q, stretched, psi, bend):
    """S (9, 9) of (y', ψ, ψ') at a Gauss point with y', ψ, ψ' in axes of the reference node, and what they ask for: (force on y', that on
    ψ, that on ψ'), all times the weight."""
    weight, unstrained = q[WEIGHT], q[STRAIN : STRAIN + 6]
    square = dot(psi, psi)
    b, c, b1, c1, b2, c2 = series(square)
    a, a1, a2 = 1.0 - square * c, -2.0 * c - square * c1, -4.0 * c1 - square * c2
    gamma = rotated(-a, b, psi, stretched)
    kappa = tangent_product(a, b, c, psi, bend)
    B, S = own.B, own.S
    both, across = dot(psi, bend), cross(psi, bend)
    for j in range(3):
        e = unit(j)
        t = tangent_product(a, b, c, psi, e)
        along, shear = rotated(-a, b, psi, e), cross(gamma, t)
        d = sum_of(a1 * psi[j], bend, -b1 * psi[j], across, -b, cross(e, bend))
        d = sum_of(c * both, e, c * bend[j] + c1 * psi[j] * both, psi, 1.0, d)
        for i in range(3):
            B[i, j], B[i, 3 + j], B[i, 6 + j] = along[i], shear[i], 0.0
            B[3 + i, j], B[3 + i, 3 + j], B[3 + i, 6 + j] = 0.0, d[i], t[i]
    s, f = six_by_six(n[ElementRow.STIFFNESS :], minus(gamma, unstrained) + minus(kappa, unstrained[3:])), own.local
    for i in range(6):
        f[i] = weight * s[i]
    N, M = (f[0], f[1], f[2]), (f[3], f[4], f[5])
    # material part: Bᵀ (w C) B, column by column
    for j in range(9):
        for i in range(6):
            C = n[ElementRow.STIFFNESS + 6 * i : ElementRow.STIFFNESS + 6 * i + 6]
            total = 0.0
            for m in range(6):
                total += C[m] * B[m, j]
            f[6 + i] = weight * total
        for i in range(j + 1):
            total = 0.0
            for m in range(6):
                total += B[m, i] * f[6 + m]
            S[i, j], S[j, i] = total, total
    moment = cross(N, gamma)
    chi, beta, mu = cross(bend, M), dot(bend, M), dot(psi, M)
    nu = both
    outwards = a1 * beta - b1 * dot(psi, chi) + c1 * mu * nu
    further = a2 * beta - b2 * dot(psi, chi) + c2 * mu * nu
    mixed = sum_of(nu, M, mu, bend, 0.0, M)
    for j in range(3):
        e = unit(j)
        t = tangent_product(a, b, c, psi, e)
        # of N: force on y' turns with ψ, and Tᵀ (N × Qᵀ y') changes
        y_psi = rotated(a, b, psi, cross(t, N))
        m_psi = tangent_product(a, -b, c, psi, cross(N, cross(gamma, t)))
        turning = change_of_transposed(a1, b1, c1, b, c, psi, moment, j)
        # of M
        bending = change_of_transposed(a1, b1, c1, b, c, psi, M, j)
        for i in range(3):
            S[i, 3 + j] += y_psi[i]
            S[3 + j, i] += y_psi[i]
            S[6 + i, 3 + j] += bending[i]
            S[3 + j, 6 + i] += bending[i]
            own_part = outwards if i == j else 0.0
            own_part += further * psi[i] * psi[j] - b1 * (psi[i] * chi[j] + chi[i] * psi[j])
            own_part += c1 * (psi[i] * mixed[j] + mixed[i] * psi[j]) + c * (M[i] * bend[j] + bend[i] * M[j])
            S[3 + i, 3 + j] += m_psi[i] + turning[i] + own_part
    of_psi = sum_of(1.0, tangent_product(a, -b, c, psi, moment), -b, chi, c * nu, M)
    of_psi = sum_of(1.0, of_psi, outwards, psi, c * mu, bend)
    return rotated(a, b, psi, N), of_psi, tangent_product(a, -b, c, psi, M)


@stage
def change_of_transposed(a1, b1, c1, b, c, psi, v, j):
    """Derivative of Tᵀ v = a v + b ψ × v + c ψ (ψ·v) along ψ_j."""
    e = unit(j)
    along = dot(psi, v)
    out = sum_of(a1 * psi[j], v, b1 * psi[j], cross(psi, v), b, cross(e, v))
    return sum_of(1.0, out, c * along, e, c * v[j] + c1 * psi[j] * along, psi)


@stage
def slot(a, r):
    """Number of node a among those that are not the reference node."""
    return a if a < r else a - 1


@stage
def stiffness_of_element(own, markers, index, n):
    """k and P of an element, and its rotation vectors."""
    count, r = np.int64(index[ElementRow.COUNT]), np.int64(index[ElementRow.REFERENCE])
    Ar, k, P = markers.A[index[ElementRow.NODE + r]], own.k, own.P
    size = 6 * (count - 1)
    P[:size], k[:size, :size], own.psi[:count] = 0.0, 0.0, 0.0
    for a in range(count):
        if a != r:
            rotation_vector(Ar, markers.A[index[ElementRow.NODE + a]], own.psi[a])
        square = dot(own.psi[a], own.psi[a])
        own.local[ETA + a], own.local[ETA_SLOPE + a] = inverse_tangent_factor(square), slope_of_factor(square)
    for g in range(index[ElementRow.POINTS]):
        q = n[ElementRow.POINT + WIDTH * g : ElementRow.POINT + WIDTH * (g + 1)]
        shape, slope = q[SHAPE : SHAPE + 4], q[SLOPE : SLOPE + 4]
        psi, bend = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        for a in range(count):
            psi, bend = plus(psi, times(shape[a], own.psi[a])), plus(bend, times(slope[a], own.psi[a]))
        stretched = seen(Ar, along_line(markers.r, index, slope, count))
        force, of_psi, of_slope = stiffness_of_point(own, n, q, stretched, psi, bend)
        S = own.S
        for a in range(count):
            if a == r:
                continue
            at, N, D = 6 * slot(a, r), shape[a], slope[a]
            for i in range(3):
                P[at + i] += D * force[i]
                P[at + 3 + i] += N * of_psi[i] + D * of_slope[i]
            for b in range(count):
                if b == r:
                    continue
                to, Nb, Db = 6 * slot(b, r), shape[b], slope[b]
                for i in range(3):
                    for j in range(3):
                        k[at + i, to + j] += D * Db * S[i, j]
                        k[at + i, to + 3 + j] += D * (Nb * S[i, 3 + j] + Db * S[i, 6 + j])
                        k[at + 3 + i, to + j] += (N * S[3 + i, j] + D * S[6 + i, j]) * Db
                        k[at + 3 + i, to + 3 + j] += N * (Nb * S[3 + i, 3 + j] + Db * S[3 + i, 6 + j]) + D * (
                            Nb * S[6 + i, 3 + j] + Db * S[6 + i, 6 + j]
                        )


@stage
def change_of_inverse(eta, slope, psi, v, w):
    """Derivative of T⁻ᵀ v = v - ½ ψ × v + η ψ × (ψ × v) along w. slope : η'/ψ."""
    c = cross(psi, v)
    d = sum_of(-0.5, cross(w, v), eta, cross(w, c), eta, cross(psi, cross(w, v)))
    return sum_of(1.0, d, slope * dot(psi, w), cross(psi, c), 0.0, v)


@stage
def motion_of_nodes(record, unknown, markers, index, out):
    """out (24,) := (δx, δθ) of each node of an element by one unknown, global axes."""
    bodies, tree = record.bodies, record.tree
    j, b = np.int64(unknown[0]), unknown[1]
    if tree.node.shape[0] > 0:
        column = tree.column[j]
        w, v = (column[0], column[1], column[2]), (column[3], column[4], column[5])
    else:
        axis, A = j - 6 * np.int64(b), bodies.A[b]
        w, v = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        if axis < 3:
            v = unit(axis)
        else:
            w = (A[0, axis - 3], A[1, axis - 3], A[2, axis - 3])
    for a in range(np.int64(index[ElementRow.COUNT])):
        moved, arm = (unknown[2] >> a) & 1 == 1, minus(markers.r[index[ElementRow.NODE + a]], bodies.R[b])
        put(out, 6 * a, plus(v, cross(w, arm)) if moved else (0.0, 0.0, 0.0))
        put(out, 6 * a + 3, w if moved else (0.0, 0.0, 0.0))


@stage
def see_from_ground(own, markers, index):
    """own.k := changes of force and torque on each node for (δx_a - δx_r - δθ_r × arm, δθ_a - δθ_r) of each, all in global axes, while
    the forces that there are do not turn.

    δψ_a = J_a (δθ_a - δθ_r), J_a = T_a⁻¹ R_aᵀ, and a torque is J_aᵀ P_ψa: to J_aᵀ k J_b comes how T_a⁻ᵀ changes.
    """
    count, r = np.int64(index[ElementRow.COUNT]), np.int64(index[ElementRow.REFERENCE])
    Ar, k, P, local = markers.A[index[ElementRow.NODE + r]], own.k, own.P, own.local
    size = 6 * (count - 1)
    for a in range(count):
        if a == r:
            continue
        s, A, psi, eta = slot(a, r), markers.A[index[ElementRow.NODE + a]], own.psi[a], local[ETA + a]
        J, u = own.B[s], 6 * slot(a, r)
        for j in range(3):
            J[j], J[3 + j], J[6 + j] = inverse_tangent_by(eta, 0.5, psi, A[j])
        for c in range(size):
            k[u, c], k[u + 1, c], k[u + 2, c] = turned(Ar, (k[u, c], k[u + 1, c], k[u + 2, c]))
            k[u + 3, c], k[u + 4, c], k[u + 5, c] = seen_flat(J, (k[u + 3, c], k[u + 4, c], k[u + 5, c]))
        for j in range(3):
            bent = turned(A, change_of_inverse(eta, local[ETA_SLOPE + a], psi, P[u + 3 : u + 6], unit(j)))
            for i in range(3):
                k[u + 3 + i, u + 3 + j] += bent[i]
    for i in range(size):
        for s in range(count - 1):
            row, J = k[i, 6 * s : 6 * s + 6], own.B[s]
            row[0], row[1], row[2] = turned(Ar, row[0:3])
            row[3], row[4], row[5] = seen_flat(J, row[3:6])


@stage
def elastic_change(own, markers, index, e, twist, cq):
    """own.change := cq times the changes of force and torque of the element (what it resists with) at its nodes for the motion `twist`."""
    count, r = np.int64(index[ElementRow.COUNT]), np.int64(index[ElementRow.REFERENCE])
    k, local, wrench, change = own.k, own.local, own.wrench[e], own.change
    xr, tr = twist[6 * r : 6 * r + 3], twist[6 * r + 3 : 6 * r + 6]
    size = 6 * (count - 1)
    for a in range(count):
        if a == r:
            continue
        at, arm = 6 * slot(a, r), minus(markers.r[index[ElementRow.NODE + a]], markers.r[index[ElementRow.NODE + r]])
        put(local, at, minus(minus(twist[6 * a :], xr), cross(tr, arm)))
        put(local, at + 3, minus(twist[6 * a + 3 :], tr))
    change[r, :6] = 0.0
    for a in range(count):
        if a == r:
            continue
        at = 6 * slot(a, r)
        for i in range(6):
            total = 0.0
            for j in range(size):
                total += k[at + i, j] * local[j]
            local[18 + i] = total
        # the element resists with the opposite of the wrench on its nodes
        f, t = opposite(wrench[6 * a :]), opposite(wrench[6 * a + 3 :])
        arm = minus(markers.r[index[ElementRow.NODE + a]], markers.r[index[ElementRow.NODE + r]])
        df = plus(local[18:], cross(tr, f))
        dt = plus(local[21:], cross(twist[6 * a + 3 :], t))
        turning = plus(plus(cross(minus(twist[6 * a :], xr), f), cross(arm, df)), dt)
        put(change[a], 0, times(cq, df))
        put(change[a], 3, times(cq, dt))
        put(change[r], 0, minus(change[r], times(cq, df)))
        put(change[r], 3, minus(change[r, 3:], times(cq, turning)))


@stage
def add_work(own, index, first, size, plain, e, twist, cq, out, at):
    """Add the work of own.change on the motions of the unknowns of element e to their rows of one column of `out`."""
    for a in range(np.int64(index[ElementRow.COUNT])):
        c = own.change[a]
        for i in range(size):
            if (own.unknown[first + i, 2] >> a) & 1 == 1:
                out[own.place[at + i * size]] += row_by(own.twist[i, 6 * a :], c)
    if plain != NONE and cq != 0.0:
        t = own.wrench[e, 6 * plain + 3 : 6 * plain + 6]
        arm = cross(t, twist[6 * plain + 3 : 6 * plain + 6])
        for i in range(size):
            if own.unknown[first + i, 3] == plain:
                # the row of a turn is about an axis that turns too
                out[own.place[at + i * size]] -= cq * dot(arm, own.twist[i, 6 * plain + 3 : 6 * plain + 6])


@stage
def add_inertial_change(record, index, pair, e, twist, turning, w, cv, cm):
    """Add to beams.change what pair `pair` of shared mass asks for more by one unknown of a plain node.

    turning : node that it turns, by w in section axes for a unit of the unknown; NONE: it moves the node of `twist` along an axis.
    """
    shared, bodies, markers, change = record.shared, record.bodies, record.markers, record.beams.change
    a, b = np.int64(0), np.int64(0)
    for s in range(np.int64(index[ElementRow.COUNT])):
        a = s if index[ElementRow.NODE + s] == shared.pair[pair, 2] else a
        b = s if index[ElementRow.NODE + s] == shared.pair[pair, 3] else b
    if turning == NONE:
        m = shared.mass[pair]
        for i in range(3):
            change[a, i] += cm * m * (twist[6 * b + i] - twist[6 * a + i])
            change[b, i] += cm * m * (twist[6 * a + i] - twist[6 * b + i])
        return
    if turning not in (a, b):
        return
    J, Q = shared.moment[pair], shared.turn[pair]
    A, B = markers.A[shared.pair[pair, 2]], markers.A[shared.pair[pair, 3]]
    wa, wb = seen(A, bodies.omega[shared.pair[pair, 0]]), seen(B, bodies.omega[shared.pair[pair, 1]])
    zero = (0.0, 0.0, 0.0)
    da, db = (w, zero) if turning == a else (zero, w)
    ha, hb = turned(J, minus(wb, turned(Q, wa))), seen(J, minus(wa, seen(Q, wb)))
    dha, dhb = turned(J, minus(db, turned(Q, da))), seen(J, minus(da, seen(Q, db)))
    na = sum_of(cm, dha, cv, cross(da, ha), cv, cross(wa, dha))
    nb = sum_of(cm, dhb, cv, cross(db, hb), cv, cross(wb, dhb))
    put(change[a], 3, plus(change[a, 3:], turned(A, na)))
    put(change[b], 3, plus(change[b, 3:], turned(B, nb)))


@stage
def turned_by(newton, j, axis, total):
    """What a unit of unknown j, a turn about an axis of its body, does to the angular velocity: T⁻¹ in Newton's iteration, else itself."""
    e = unit(axis)
    first = j - axis
    return inverse_tangent(newton.change[first : first + 3], e) if total else e


@stage
def add_element(machine, out, e, total, cq, cv, cm):
    """Add the derivatives of element e to `out`."""
    record = record_at(machine)
    own, newton, markers = record.beams, record.newton, record.markers
    index, n = record.elements.columns[own.first[0] + e], record.elements.number[own.first[0] + e]
    if cq != 0.0:
        stiffness_of_element(own, markers, index, n)
        see_from_ground(own, markers, index)
    first, last = np.int64(own.start[e]), np.int64(own.start[e + 1])
    size = last - first
    for u in range(size):
        motion_of_nodes(record, own.unknown[first + u], markers, index, own.twist[u])
    for c in range(size):
        unknown, twist = own.unknown[first + c], own.twist[c]
        j, plain = np.int64(unknown[0]), np.int64(unknown[3])
        if cq != 0.0:
            elastic_change(own, markers, index, e, twist, cq)
        else:
            own.change[:4, :6] = 0.0
        axis = np.int64(newton.place[j, 1])
        if plain != NONE and (cm != 0.0 or cv != 0.0):
            turns = newton.place[j, 1] != NONE
            w = turned_by(newton, j, axis, total) if turns else (0.0, 0.0, 0.0)
            for pair in range(own.pair[e, 0], own.pair[e, 1]):
                add_inertial_change(record, index, pair, e, twist, plain if turns else NONE, w, cv, cm)
        add_work(own, index, first, size, plain, e, twist, cq, out, np.int64(own.place_start[e]) + c)


@stage
def add_plain_node(machine, out, k, total, cv, cm):
    """Add the inertia of what is lumped at a plain node: its mass centre is at its origin."""
    record = record_at(machine)
    own, newton, bodies = record.beams, record.newton, record.bodies
    b, first = own.plain[k, 0], np.int64(own.plain[k, 1])
    J, A = bodies.inertia_b[b], bodies.A[b]
    omega = seen(A, bodies.omega[b])
    h = turned(J, omega)
    for i in range(3):
        out[np.int64(own.plain[k, 2 + i]) + i] += cm * bodies.mass[b]
        w = turned_by(newton, first + 3 + i, i, total)
        dh = turned(J, w)
        n = sum_of(cm, dh, cv, cross(w, h), cv, cross(omega, dh))
        for row in range(3):
            out[np.int64(own.plain[k, 5 + row]) + 3 + i] += n[row]


@stage
def add_beams(machine, out, total, cq, cv, cm):
    """Add all derivatives of elements, and those of the motion of plain nodes, whose entries were not found otherwise."""
    record = record_at(machine)
    own, newton = record.beams, record.newton
    for k in range(own.plain.shape[0]):
        for j in range(np.int64(own.plain[k, 1]), np.int64(own.plain[k, 1]) + 6):
            for entry in range(newton.entry_start[j], newton.entry_start[j + 1]):
                out[newton.entry[entry, 1]] = 0.0
    for k in range(own.plain.shape[0]):
        add_plain_node(machine, out, k, total, cv, cm)
    for e in range(own.start.shape[0] - 1):
        add_element(machine, out, e, total, cq, cv, cm)


@family
def tangent(machine, job, t):
    """The derivatives that `job` asks for, at the state and the velocities last evaluated, added to where they belong."""
    newton = record_at(machine).newton
    c = newton.asked
    if job == TOTAL:
        add_beams(machine, newton.value, True, c[0], c[1], 1.0)
    elif job == ACCELERATIONS:
        add_beams(machine, newton.balance.value if c[2] == 1.0 else newton.shifted.M, False, 0.0, 0.0, 1.0)
    elif job == VELOCITIES:
        add_beams(machine, newton.shifted.D, False, 0.0, 1.0, 0.0)
    else:
        add_beams(machine, newton.shifted.K, False, 1.0, 0.0, 0.0)
    return OK
