"""Motion of the bodies of a tree from its joint coordinates, from the ground outwards.

Node n carries a child body on a parent body by a joint with a first marker i and a second marker j. Whatever the joint, A_j = A_i Q and
r_j = r_i + A_i d, and the second marker moves relative to the first body with ω_rel = Σ w_k u_k and v_rel = Σ v_k u_k; the columns
(w_k, v_k) are fixed in one of the two bodies. Seen from the point of r_j:

    ω_child = ω_parent + σ ω_rel                 α_child = α_parent + σ (Σ w_k u̇_k + ω_i × ω_rel + …)
    v_child = v_parent(r_j) + σ v_rel            a_child = a_parent(r_j) + σ (Σ v_k u̇_k + 2 ω_i × v_rel)

with σ = -1 where the child holds the first marker; ω_i is of the body of the first marker, … is u_1 u_2 w_1 × w_2 of a universal joint.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf, stage
from nivel.kernels.record import (
    CYLINDRICAL,
    FIXED,
    FREE,
    PLANAR,
    REVOLUTE,
    SCREW,
    SPHERICAL,
    TRANSLATIONAL,
    UNIVERSAL,
)
from nivel.kernels.spatial import cross, dot, multiply


@leaf
def product(A, B, out):
    """out = A B of 3×3 matrices; `out` is neither."""
    for i in range(3):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        for j in range(3):
            out[i, j] = a * B[0, j] + b * B[1, j] + c * B[2, j]


@leaf
def product_transposed(A, B, out):
    """out = A Bᵀ."""
    for i in range(3):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        for j in range(3):
            out[i, j] = a * B[j, 0] + b * B[j, 1] + c * B[j, 2]


@leaf
def turned_about_z(A, c, s, out):
    """out = A Rz, with the cosine and sine of the angle."""
    for i in range(3):
        x, y = A[i, 0], A[i, 1]
        out[i, 0], out[i, 1], out[i, 2] = c * x + s * y, c * y - s * x, A[i, 2]


@leaf
def turned_back(A, c, s, out):
    """out = A Rzᵀ."""
    turned_about_z(A, c, -s, out)


@leaf
def joint_angle(kind, q):
    """The angle about the z axis of the first marker."""
    if kind == PLANAR:
        return q[2]
    if kind in (TRANSLATIONAL, FIXED):
        return 0.0
    return q[0]


@stage
def universal(A, q, out):
    """out = A Rz(a₁) X Rz(a₂): X lays the second z axis along the first x axis, the second x axis along the first z axis."""
    c, s, e, f = np.cos(q[0]), np.sin(q[0]), np.cos(q[1]), np.sin(q[1])
    for i in range(3):
        x, y, z = A[i, 0], A[i, 1], A[i, 2]
        arm = c * x + s * y
        side = s * x - c * y
        out[i, 0], out[i, 1], out[i, 2] = e * z + f * side, e * side - f * z, arm


@stage
def universal_back(A, q, out):
    """out = A (Rz(a₁) X Rz(a₂))ᵀ."""
    c, s, e, f = np.cos(q[0]), np.sin(q[0]), np.cos(q[1]), np.sin(q[1])
    for i in range(3):
        x, y, arm = A[i, 0], A[i, 1], A[i, 2]
        z, side = e * x - f * y, f * x + e * y
        out[i, 0], out[i, 1], out[i, 2] = c * arm + s * side, s * arm - c * side, z


@stage
def turn(kind, number, q, A, back, out):
    """out = A Q, or A Qᵀ where `back`, for the rotation Q of a joint with the coordinates q."""
    if kind == UNIVERSAL:
        if back == 1:
            universal_back(A, q, out)
        else:
            universal(A, q, out)
        return
    if kind in (SPHERICAL, FREE):
        theta = q[3:7] if kind == FREE else q[0:4]
        rotate_by_parameters(theta, A, back, out)
        return
    c, s = number[2], number[3]
    if kind not in (TRANSLATIONAL, FIXED):
        angle = joint_angle(kind, q)
        c, s = np.cos(angle), np.sin(angle)
    if back == 1:
        turned_back(A, c, s, out)
    else:
        turned_about_z(A, c, s, out)


@leaf
def rotate_by_parameters(theta, A, back, out):
    """out = A Q(θ), or A Q(θ)ᵀ."""
    sign = -1.0 if back == 1 else 1.0
    e0, e1, e2, e3 = theta[0], sign * theta[1], sign * theta[2], sign * theta[3]
    k = 2.0 / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
    q00, q01, q02 = 1.0 - k * (e2 * e2 + e3 * e3), k * (e1 * e2 - e0 * e3), k * (e1 * e3 + e0 * e2)
    q10, q11, q12 = k * (e1 * e2 + e0 * e3), 1.0 - k * (e1 * e1 + e3 * e3), k * (e2 * e3 - e0 * e1)
    q20, q21, q22 = k * (e1 * e3 - e0 * e2), k * (e2 * e3 + e0 * e1), 1.0 - k * (e1 * e1 + e2 * e2)
    for i in range(3):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        out[i, 0] = a * q00 + b * q10 + c * q20
        out[i, 1] = a * q01 + b * q11 + c * q21
        out[i, 2] = a * q02 + b * q12 + c * q22


@leaf
def along(A, axis, x, d):
    """d + x times a column of A."""
    return d[0] + x * A[0, axis], d[1] + x * A[1, axis], d[2] + x * A[2, axis]


@stage
def shift(kind, number, q, A):
    """A_i d: from the first to the second marker, global axes."""
    d = (0.0, 0.0, 0.0)
    if kind == TRANSLATIONAL:
        d = along(A, 2, q[0], d)
    elif kind == CYLINDRICAL:
        d = along(A, 2, q[1], d)
    elif kind == SCREW:
        d = along(A, 2, number[0] * q[0] + number[1], d)
    elif kind == PLANAR:
        d = along(A, 1, q[1], along(A, 0, q[0], d))
    elif kind == FREE:
        d = along(A, 2, q[2], along(A, 1, q[1], along(A, 0, q[0], d)))
    return d


@leaf
def set_column(column, sign, w, v):
    """A column (w, v), turned round for a joint whose first body is the child."""
    for i in range(3):
        column[i], column[3 + i] = sign * w[i], sign * v[i]


@leaf
def axis_of(A, axis):
    """A column of A."""
    return A[0, axis], A[1, axis], A[2, axis]


@stage
def set_columns(kind, number, first, second, sign, column, k):
    """The columns of a joint from number k on, in the order of its velocities."""
    zero = (0.0, 0.0, 0.0)
    z = axis_of(first, 2)
    if kind == REVOLUTE:
        set_column(column[k], sign, z, zero)
    elif kind == TRANSLATIONAL:
        set_column(column[k], sign, zero, z)
    elif kind == CYLINDRICAL:
        set_column(column[k], sign, z, zero)
        set_column(column[k + 1], sign, zero, z)
    elif kind == SCREW:
        set_column(column[k], sign, z, along(first, 2, number[0], zero))
    elif kind == UNIVERSAL:
        set_column(column[k], sign, z, zero)
        set_column(column[k + 1], sign, axis_of(second, 2), zero)
    elif kind == PLANAR:
        set_column(column[k], sign, zero, axis_of(first, 0))
        set_column(column[k + 1], sign, zero, axis_of(first, 1))
        set_column(column[k + 2], sign, z, zero)
    elif kind == SPHERICAL:
        for i in range(3):
            set_column(column[k + i], sign, axis_of(second, i), zero)
    elif kind == FREE:
        for i in range(3):
            set_column(column[k + i], sign, zero, axis_of(first, i))
            set_column(column[k + 3 + i], sign, axis_of(second, i), zero)


@stage
def place_child(bodies, markers, tree, n, y):
    """Pose of the child of node n, its point of reference, and the columns of its joint."""
    node = tree.node[n]
    child, parent, i, j, kind, turned = node[0], node[1], node[2], node[3], node[4], node[5]
    q = y[tree.place[n, 0] :]
    number, first, second = tree.number[n], tree.first[n], tree.second[n]
    Ap, R = bodies.A[parent], bodies.R[child]
    near, far = (j, i) if turned == 1 else (i, j)
    s, o = markers.position_b[near], markers.position_b[far]
    p0 = bodies.R[parent, 0] + Ap[0, 0] * s[0] + Ap[0, 1] * s[1] + Ap[0, 2] * s[2]
    p1 = bodies.R[parent, 1] + Ap[1, 0] * s[0] + Ap[1, 1] * s[1] + Ap[1, 2] * s[2]
    p2 = bodies.R[parent, 2] + Ap[2, 0] * s[0] + Ap[2, 1] * s[1] + Ap[2, 2] * s[2]
    point = tree.reference[child]
    if turned == 1:
        product(Ap, markers.frame_b[j], second)
        turn(kind, number, q, second, 1, first)
        product_transposed(first, markers.frame_b[i], bodies.A[child])
        d = shift(kind, number, q, first)
        point[0], point[1], point[2] = p0, p1, p2
        p0, p1, p2 = p0 - d[0], p1 - d[1], p2 - d[2]
    else:
        product(Ap, markers.frame_b[i], first)
        turn(kind, number, q, first, 0, second)
        product_transposed(second, markers.frame_b[j], bodies.A[child])
        d = shift(kind, number, q, first)
        p0, p1, p2 = p0 + d[0], p1 + d[1], p2 + d[2]
        point[0], point[1], point[2] = p0, p1, p2
    A = bodies.A[child]
    R[0] = p0 - (A[0, 0] * o[0] + A[0, 1] * o[1] + A[0, 2] * o[2])
    R[1] = p1 - (A[1, 0] * o[0] + A[1, 1] * o[1] + A[1, 2] * o[2])
    R[2] = p2 - (A[2, 0] * o[0] + A[2, 1] * o[1] + A[2, 2] * o[2])
    multiply(A, bodies.centre_b[child], bodies.c[child])
    set_columns(kind, number, first, second, -1.0 if turned == 1 else 1.0, tree.column, node[6])


@leaf
def swing(alpha, w, u):
    """α × u + ω × (ω × u)."""
    a = cross(alpha, u)
    wu, ww = dot(w, u), dot(w, w)
    return a[0] + w[0] * wu - u[0] * ww, a[1] + w[1] * wu - u[1] * ww, a[2] + w[2] * wu - u[2] * ww


@stage
def move_child(bodies, tree, n, y):
    """Velocity of the child of node n, and its acceleration while no joint velocity changes."""
    node = tree.node[n]
    child, parent, kind, turned = node[0], node[1], node[4], node[5]
    u = y[tree.place[n, 1] :]
    # with their signs: relative to the parent
    w0, w1, w2, v0, v1, v2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(np.int64(node[7]) - np.int64(node[6])):
        c, rate = tree.column[node[6] + k], u[k]
        w0 += rate * c[0]
        w1 += rate * c[1]
        w2 += rate * c[2]
        v0 += rate * c[3]
        v1 += rate * c[4]
        v2 += rate * c[5]
    W, V, wp, omega = bodies.Rdot[parent], bodies.Rdot[child], bodies.omega[parent], bodies.omega[child]
    omega[0], omega[1], omega[2] = wp[0] + w0, wp[1] + w1, wp[2] + w2
    R, Rp, point = bodies.R[child], bodies.R[parent], tree.reference[child]
    arm = (point[0] - Rp[0], point[1] - Rp[1], point[2] - Rp[2])
    back = (R[0] - point[0], R[1] - point[1], R[2] - point[2])
    out, home = cross(wp, arm), cross(omega, back)
    for i in range(3):
        V[i] = W[i] + out[i] + home[i]
    V[0] += v0
    V[1] += v1
    V[2] += v2
    # ω_i of the first marker's body
    wi = omega if turned == 1 else wp
    bend, coriolis = cross(wi, (w0, w1, w2)), cross(wi, (v0, v1, v2))
    ap, alpha, a = tree.alpha0[parent], tree.alpha0[child], tree.Rddot0[child]
    alpha[0], alpha[1], alpha[2] = ap[0] + bend[0], ap[1] + bend[1], ap[2] + bend[2]
    if kind == UNIVERSAL:
        # the columns carry the sign σ, the term has it once
        twist = cross(tree.column[node[6]][0:3], tree.column[node[6] + 1][0:3])
        share = u[0] * u[1] * (-1.0 if turned == 1 else 1.0)
        alpha[0] += share * twist[0]
        alpha[1] += share * twist[1]
        alpha[2] += share * twist[2]
    there, here = swing(ap, wp, arm), swing(alpha, omega, back)
    ar = tree.Rddot0[parent]
    for i in range(3):
        a[i] = ar[i] + there[i] + 2.0 * coriolis[i] + here[i]
    A, w_b = bodies.A[child], bodies.omega_b[child]
    for i in range(3):
        w_b[i] = A[0, i] * omega[0] + A[1, i] * omega[1] + A[2, i] * omega[2]


@stage
def place_tree(bodies, markers, tree, y):
    """Poses and velocities of all bodies from the state."""
    for n in range(tree.node.shape[0]):
        place_child(bodies, markers, tree, n, y)
        move_child(bodies, tree, n, y)
