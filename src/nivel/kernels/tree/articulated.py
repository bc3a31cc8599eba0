"""Articulated bodies: recursion over a tree in O(n) (Featherstone 1983), as a factorisation of its mass matrix.

Written with accelerations (α, a) of a body's frame and wrenches (N, F) about its origin, in global axes:

    [N; F] = [I, H; Hᵀ, M] [α; a] + (N, F)₀

Accelerations are counted from those that the bodies have while no joint velocity changes, so the recursion itself has no velocity
terms. Columns of a joint are eliminated one after another, the last one first: with U = P s, D = sᵀ U,

    P := P - U Uᵀ/D        the inertia that the next column, and at last the parent, feels

In the columns' own order that is M = L D Lᵀ of the mass matrix in joint coordinates; "whitened" rows and forces are D^{-1/2} L⁻¹ of
their generalised forces, the form in which `nivel.kernels.solve.saddle` takes them.
"""

import numpy as np

from nivel.kernels.algebra.spatial import cross
from nivel.kernels.algebra.vectors import moment
from nivel.kernels.elements.friction import is_apart
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.tree import swing
from nivel.native.function import leaf, stage


@stage
def own_inertia(bodies, tree, b):
    """Inertia of body b about its frame's origin, global axes."""
    set_inertia(bodies.A[b], bodies.inertia_origin_b[b], bodies.mass[b], bodies.c[b], tree.inertia[b])


@stage
def set_inertia(A, J, m, c, P):
    """Inertia in global axes, its moments again from column 21 on: A J̄_O Aᵀ; H = m c̃, M = m 1."""
    x0 = A[0, 0] * J[0, 0] + A[0, 1] * J[1, 0] + A[0, 2] * J[2, 0]
    y0 = A[0, 0] * J[0, 1] + A[0, 1] * J[1, 1] + A[0, 2] * J[2, 1]
    z0 = A[0, 0] * J[0, 2] + A[0, 1] * J[1, 2] + A[0, 2] * J[2, 2]
    x1 = A[1, 0] * J[0, 0] + A[1, 1] * J[1, 0] + A[1, 2] * J[2, 0]
    y1 = A[1, 0] * J[0, 1] + A[1, 1] * J[1, 1] + A[1, 2] * J[2, 1]
    z1 = A[1, 0] * J[0, 2] + A[1, 1] * J[1, 2] + A[1, 2] * J[2, 2]
    x2 = A[2, 0] * J[0, 0] + A[2, 1] * J[1, 0] + A[2, 2] * J[2, 0]
    y2 = A[2, 0] * J[0, 1] + A[2, 1] * J[1, 1] + A[2, 2] * J[2, 1]
    z2 = A[2, 0] * J[0, 2] + A[2, 1] * J[1, 2] + A[2, 2] * J[2, 2]
    P[0] = x0 * A[0, 0] + y0 * A[0, 1] + z0 * A[0, 2]
    P[1] = x0 * A[1, 0] + y0 * A[1, 1] + z0 * A[1, 2]
    P[2] = x0 * A[2, 0] + y0 * A[2, 1] + z0 * A[2, 2]
    P[3] = x1 * A[1, 0] + y1 * A[1, 1] + z1 * A[1, 2]
    P[4] = x1 * A[2, 0] + y1 * A[2, 1] + z1 * A[2, 2]
    P[5] = x2 * A[2, 0] + y2 * A[2, 1] + z2 * A[2, 2]
    for k in range(6):
        P[21 + k] = P[k]
    m0, m1, m2 = m * c[0], m * c[1], m * c[2]
    P[6], P[7], P[8] = 0.0, -m2, m1
    P[9], P[10], P[11] = m2, 0.0, -m0
    P[12], P[13], P[14] = -m1, m0, 0.0
    P[15], P[16], P[17], P[18], P[19], P[20] = m, 0.0, 0.0, m, 0.0, m


@stage
def subtract_outer(P, d, u):
    """P -= d uᵀ for 6-vectors whose product is symmetric."""
    P[0] -= d[0] * u[0]
    P[1] -= d[0] * u[1]
    P[2] -= d[0] * u[2]
    P[3] -= d[1] * u[1]
    P[4] -= d[1] * u[2]
    P[5] -= d[2] * u[2]
    P[6] -= d[0] * u[3]
    P[7] -= d[0] * u[4]
    P[8] -= d[0] * u[5]
    P[9] -= d[1] * u[3]
    P[10] -= d[1] * u[4]
    P[11] -= d[1] * u[5]
    P[12] -= d[2] * u[3]
    P[13] -= d[2] * u[4]
    P[14] -= d[2] * u[5]
    P[15] -= d[3] * u[3]
    P[16] -= d[3] * u[4]
    P[17] -= d[3] * u[5]
    P[18] -= d[4] * u[4]
    P[19] -= d[4] * u[5]
    P[20] -= d[5] * u[5]


@leaf
def eliminate(P, s, U):
    """U = P s, 1/(sᵀ U) returned, P := P - U Uᵀ/(sᵀ U)."""
    w0, w1, w2, v0, v1, v2 = s[0], s[1], s[2], s[3], s[4], s[5]
    U0 = (P[0] * w0 + P[1] * w1 + P[2] * w2) + (P[6] * v0 + P[7] * v1 + P[8] * v2)
    U1 = (P[1] * w0 + P[3] * w1 + P[4] * w2) + (P[9] * v0 + P[10] * v1 + P[11] * v2)
    U2 = (P[2] * w0 + P[4] * w1 + P[5] * w2) + (P[12] * v0 + P[13] * v1 + P[14] * v2)
    U3 = (P[6] * w0 + P[9] * w1 + P[12] * w2) + (P[15] * v0 + P[16] * v1 + P[17] * v2)
    U4 = (P[7] * w0 + P[10] * w1 + P[13] * w2) + (P[16] * v0 + P[18] * v1 + P[19] * v2)
    U5 = (P[8] * w0 + P[11] * w1 + P[14] * w2) + (P[17] * v0 + P[19] * v1 + P[20] * v2)
    Dinv = 1.0 / ((U0 * w0 + U1 * w1 + U2 * w2) + (U3 * v0 + U4 * v1 + U5 * v2))
    U[0], U[1], U[2], U[3], U[4], U[5] = U0, U1, U2, U3, U4, U5
    d0, d1, d2, d3, d4, d5 = Dinv * U0, Dinv * U1, Dinv * U2, Dinv * U3, Dinv * U4, Dinv * U5
    subtract_outer(P, (d0, d1, d2, d3, d4, d5), (U0, U1, U2, U3, U4, U5))
    return Dinv


@stage
def eliminate_columns(tree, P, first, last):
    """Eliminate columns first to last - 1 of a joint, the last one first; P, the inertia outside of it, becomes what its parent feels."""
    for c in range(last - first):
        k = last - 1 - c
        Dinv = eliminate(P, tree.column[k], tree.U[k])
        tree.Dinv[k] = Dinv
        tree.root[k] = np.sqrt(Dinv)


@leaf
def hand_inertia(P, r, parent):
    """Add the inertia P of a child to that of its parent, r = from the parent's origin to the child's.

    H' = H + r̃ M and I' = I - (K r̃ + (K r̃)ᵀ) with K = H + ½ r̃ M.
    """
    x, y, z = r[0], r[1], r[2]
    a, b, c, d, e, f = P[15], P[16], P[17], P[18], P[19], P[20]
    # B = r̃ M, rows
    B0, B1, B2 = y * c - z * b, y * e - z * d, y * f - z * e
    B3, B4, B5 = z * a - x * c, z * b - x * e, z * c - x * f
    B6, B7, B8 = x * b - y * a, x * d - y * b, x * e - y * c
    K0, K1, K2 = P[6] + 0.5 * B0, P[7] + 0.5 * B1, P[8] + 0.5 * B2
    K3, K4, K5 = P[9] + 0.5 * B3, P[10] + 0.5 * B4, P[11] + 0.5 * B5
    K6, K7, K8 = P[12] + 0.5 * B6, P[13] + 0.5 * B7, P[14] + 0.5 * B8
    # (K r̃) row by row: [k1 z - k2 y, k2 x - k0 z, k0 y - k1 x]
    parent[0] += P[0] - 2.0 * (K1 * z - K2 * y)
    parent[1] += P[1] - (K2 * x - K0 * z) - (K4 * z - K5 * y)
    parent[2] += P[2] - (K0 * y - K1 * x) - (K7 * z - K8 * y)
    parent[3] += P[3] - 2.0 * (K5 * x - K3 * z)
    parent[4] += P[4] - (K3 * y - K4 * x) - (K8 * x - K6 * z)
    parent[5] += P[5] - 2.0 * (K6 * y - K7 * x)
    parent[6] += P[6] + B0
    parent[7] += P[7] + B1
    parent[8] += P[8] + B2
    parent[9] += P[9] + B3
    parent[10] += P[10] + B4
    parent[11] += P[11] + B5
    parent[12] += P[12] + B6
    parent[13] += P[13] + B7
    parent[14] += P[14] + B8
    parent[15] += a
    parent[16] += b
    parent[17] += c
    parent[18] += d
    parent[19] += e
    parent[20] += f


@stage
def factorise_tree(bodies, tree):
    """Inertias of all bodies, and the factors of all columns, from the outermost node inwards."""
    ground = bodies.mass.shape[0]
    for b in range(ground):
        own_inertia(bodies, tree, b)
    count = tree.node.shape[0]
    for m in range(count):
        node = tree.node[count - 1 - m]
        child, parent, first, last = node[0], node[1], np.int64(node[4]), np.int64(node[5])
        P = tree.inertia[child]
        eliminate_columns(tree, P, first, last)
        if parent != ground:
            hand_inertia(P, tree.arm[child], tree.inertia[parent])


@leaf
def transmit(tree, k, wrench):
    """Generalised force of a wrench on column k over √D, then the wrench less what the column takes of it."""
    s, U = tree.column[k], tree.U[k]
    turning = s[0] * wrench[0] + s[1] * wrench[1] + s[2] * wrench[2]
    effort = turning + (s[3] * wrench[3] + s[4] * wrench[4] + s[5] * wrench[5])
    share = effort * tree.Dinv[k]
    for i in range(6):
        wrench[i] -= share * U[i]
    return effort * tree.root[k]


@leaf
def hand_wrench(wrench, r, parent):
    """Add the wrench of a child to that of its parent, r = from the parent's origin to the child's."""
    parent[0] += wrench[0] + r[1] * wrench[5] - r[2] * wrench[4]
    parent[1] += wrench[1] + r[2] * wrench[3] - r[0] * wrench[5]
    parent[2] += wrench[2] + r[0] * wrench[4] - r[1] * wrench[3]
    parent[3] += wrench[3]
    parent[4] += wrench[4]
    parent[5] += wrench[5]


@leaf
def carry_motion(parent, r, out):
    """Motion (angular, of the origin) of a child that moves with its parent, r = from the parent's origin to the child's."""
    out[0], out[1], out[2] = parent[0], parent[1], parent[2]
    out[3] = parent[3] + parent[1] * r[2] - parent[2] * r[1]
    out[4] = parent[4] + parent[2] * r[0] - parent[0] * r[2]
    out[5] = parent[5] + parent[0] * r[1] - parent[1] * r[0]


@leaf
def applied(bodies, tree, b, out):
    """Wrench about the frame's origin: applied forces less the inertia forces of the accelerations that others are counted from.

    F - m (a + α × c + ω × (ω × c)), τ - J_O α - ω × (J_O ω) - m c × a.
    """
    F, c, w, P = bodies.wrench[b], bodies.c[b], bodies.omega[b], tree.inertia[b]
    alpha, a, m = tree.alpha0[b], tree.Rddot0[b], bodies.mass[b]
    s = swing(alpha, w, c)
    xx, xy, xz, yy, yz, zz = P[21], P[22], P[23], P[24], P[25], P[26]
    h = (xx * w[0] + xy * w[1] + xz * w[2], xy * w[0] + yy * w[1] + yz * w[2], xz * w[0] + yz * w[1] + zz * w[2])
    g, ca = cross(w, h), cross(c, a)
    out[0] = F[3] - (xx * alpha[0] + xy * alpha[1] + xz * alpha[2]) - g[0] - m * ca[0]
    out[1] = F[4] - (xy * alpha[0] + yy * alpha[1] + yz * alpha[2]) - g[1] - m * ca[1]
    out[2] = F[5] - (xz * alpha[0] + yz * alpha[1] + zz * alpha[2]) - g[2] - m * ca[2]
    out[3], out[4], out[5] = F[0] - m * (a[0] + s[0]), F[1] - m * (a[1] + s[1]), F[2] - m * (a[2] + s[2])


@stage
def hand_all_inwards(machine):
    """z of the wrenches in `tree.wrench`, from the outermost node inwards."""
    record = record_at(machine)
    tree, z, ground = record.tree, record.saddle.z, record.bodies.mass.shape[0]
    count = tree.node.shape[0]
    for m in range(count):
        node = tree.node[count - 1 - m]
        child, parent, first, last = node[0], node[1], np.int64(node[4]), np.int64(node[5])
        wrench = tree.wrench[child]
        for c in range(last - first):
            z[last - 1 - c, 0] = transmit(tree, last - 1 - c, wrench)
        if parent != ground:
            hand_wrench(wrench, tree.arm[child], tree.wrench[parent])


@stage
def whiten_efforts(machine, y):
    """z of all applied and inertia forces; y is not needed for it here."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        applied(record.bodies, record.tree, b, record.tree.wrench[b])
    hand_all_inwards(machine)


@stage
def load_row(machine, row, slot):
    """Put the parts of a row as wrenches on their bodies, in place `slot`; returns what is left of C̈ while no joint velocity changes."""
    record = record_at(machine)
    markers, tree = record.markers, record.tree
    bias = 0.0 * tree.Rddot0[0, 0]
    for p in range(tree.part_start[row], tree.part_start[row + 1]):
        J, marker, b = record.constraints.J[tree.part[p, 1]], tree.part[p, 2], tree.part[p, 3]
        u, alpha, a, wrench = markers.u[marker], tree.alpha0[b], tree.Rddot0[b], tree.load[slot, b]
        n = moment(J, u)
        bias += J[0] * a[0] + J[1] * a[1] + J[2] * a[2] + n[0] * alpha[0] + n[1] * alpha[1] + n[2] * alpha[2]
        for i in range(3):
            wrench[i] += n[i]
            wrench[3 + i] += J[i]
    return bias


@stage
def whiten_bundle(machine, first, last):
    """W of rows first to last - 1, which have the same path from their bodies to the ground."""
    record = record_at(machine)
    tree, W = record.tree, record.saddle.W
    ground, count = record.bodies.mass.shape[0], last - first
    start, stop = tree.path_start[first], tree.path_start[first + 1]
    length = np.int64(tree.row_blocks[first])
    for p in range(start, stop):
        node, block = tree.node[tree.path[p, 0]], np.int64(tree.path[p, 1])
        child, parent, low, columns = node[0], node[1], np.int64(node[4]), np.int64(node[5]) - np.int64(node[4])
        for c in range(columns):
            k = low + columns - 1 - c
            s, U, Dinv, root = tree.column[k], tree.U[k], tree.Dinv[k], tree.root[k]
            s0, s1, s2, s3, s4, s5 = s[0], s[1], s[2], s[3], s[4], s[5]
            U0, U1, U2, U3, U4, U5 = U[0], U[1], U[2], U[3], U[4], U[5]
            for i in range(count):
                x = tree.load[i, child]
                effort = (s0 * x[0] + s1 * x[1] + s2 * x[2]) + (s3 * x[3] + s4 * x[4] + s5 * x[5])
                W[block + i * length + c, 0] = effort * root
                share = effort * Dinv
                x[0] -= share * U0
                x[1] -= share * U1
                x[2] -= share * U2
                x[3] -= share * U3
                x[4] -= share * U4
                x[5] -= share * U5
        for i in range(count):
            x = tree.load[i, child]
            if parent != ground:
                hand_wrench(x, tree.arm[child], tree.load[i, parent])
            x[0], x[1], x[2], x[3], x[4], x[5] = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@stage
def are_apart(record, first, last):
    """Whether frictions first to last - 1 are of patches where nothing touches."""
    for k in range(first, last):
        if not is_apart(record, k):
            return False
    return True


@stage
def whiten_bundles(machine, whiten):
    """W of all rows that are left, and of friction; their γ becomes the right-hand side for joint accelerations.

    whiten(machine, first, last) : W of rows first to last - 1, loaded, compiled into this one. `load` is zero before and after.
    """
    record = record_at(machine)
    tree, saddle, gamma = record.tree, record.saddle, record.constraints.gamma
    rows, all_rows = saddle.row.shape[0], record.constraints.C.shape[0]
    for n in range(tree.bundle.shape[0] - 1):
        first, last = np.int64(tree.bundle[n]), np.int64(tree.bundle[n + 1])
        if first >= rows and are_apart(record, first - rows, last - rows):
            continue  # nothing reads their W
        for k in range(first, last):
            bias = load_row(machine, k, k - first)
            gamma[saddle.row[k] if k < rows else all_rows + k - rows] -= bias
        whiten(machine, first, last)


@stage
def whiten_tree_rows(machine):
    """W of all rows in a tree of rigid bodies, see `whiten_bundles`."""
    whiten_bundles(machine, whiten_bundle)


@stage
def accelerate_column(tree, z, k, a, change):
    """Acceleration of column k of a joint, in `change`, and what it adds to `a`, that of its body."""
    s, U = tree.column[k], tree.U[k]
    felt = (U[0] * a[0] + U[1] * a[1] + U[2] * a[2]) + (U[3] * a[3] + U[4] * a[4] + U[5] * a[5])
    x = z[k, 0] * tree.root[k] - tree.Dinv[k] * felt
    change[k] = x
    for i in range(6):
        a[i] += x * s[i]


@stage
def accelerate(machine, change):
    """Joint accelerations from z, in `change` (U,), and `delta` of all bodies; also the change of joint coordinates in a correction."""
    record = record_at(machine)
    tree, z = record.tree, record.saddle.z
    for n in range(tree.node.shape[0]):
        node = tree.node[n]
        child, parent = node[0], node[1]
        a = tree.delta[child]
        carry_motion(tree.delta[parent], tree.arm[child], a)
        for k in range(np.int64(node[4]), np.int64(node[5])):
            accelerate_column(tree, z, k, a, change)
