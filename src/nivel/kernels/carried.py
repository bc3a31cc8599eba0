"""What a frame shows of a machine in relative coordinates beyond what its equations need: accelerations, Euler parameters, all
markers, and the rows and reactions of the joints that carry bodies.

A joint that carries a body transmits what its branch needs: the inertia forces of all bodies outwards of it less all that is applied
to them. The multipliers of its rows are the ones whose forces on the child are that wrench.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import arm_of, hand_wrench
from nivel.kernels.compile import leaf, stage
from nivel.kernels.constraint import combine, constraint_rows
from nivel.kernels.hook import family
from nivel.kernels.marker import move_markers, place_markers
from nivel.kernels.record import FIXED, FREE, PLANAR, SPHERICAL, TRANSLATIONAL, UNIVERSAL, record_at
from nivel.kernels.spatial import cross, dot
from nivel.kernels.status import OK


@leaf
def quaternion_product(a, b):
    """a ∘ b: first b, then a."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


@stage
def joint_turn(kind, q):
    """Euler parameters of the second marker seen from the first: half angles, so whole turns change no sign suddenly."""
    if kind == SPHERICAL:
        return q[0], q[1], q[2], q[3]
    if kind == FREE:
        return q[3], q[4], q[5], q[6]
    if kind in (TRANSLATIONAL, FIXED):
        return 1.0, 0.0, 0.0, 0.0
    half = 0.5 * (q[2] if kind == PLANAR else q[0])
    about_first = (np.cos(half), 0.0, 0.0, np.sin(half))
    if kind != UNIVERSAL:
        return about_first
    # X: half a turn about (1, 0, 1)/√2
    crossed = quaternion_product(about_first, (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)))
    return quaternion_product(crossed, (np.cos(0.5 * q[1]), 0.0, 0.0, np.sin(0.5 * q[1])))


@stage
def orient(machine, y):
    """Euler parameters of all bodies."""
    record = record_at(machine)
    bodies, tree = record.bodies, record.tree
    for n in range(tree.node.shape[0]):
        node = tree.node[n]
        a, b, parent, theta = tree.theta[n, 0], tree.theta[n, 1], bodies.theta[node[1]], bodies.theta[node[0]]
        e = joint_turn(node[4], y[tree.place[n, 0] :])
        if node[5] == 1:
            e = (e[0], -e[1], -e[2], -e[3])
        before = quaternion_product((parent[0], parent[1], parent[2], parent[3]), (a[0], a[1], a[2], a[3]))
        e = quaternion_product(quaternion_product(before, e), (b[0], b[1], b[2], b[3]))
        theta[0], theta[1], theta[2], theta[3] = e


@stage
def bodies_accelerate(bodies, tree):
    """(R̈, ᾱ) of all bodies from those for joint accelerations of zero and `delta`."""
    for b in range(bodies.mass.shape[0]):
        d, A, R, point = tree.delta[b], bodies.A[b], bodies.R[b], tree.reference[b]
        alpha = (tree.alpha0[b, 0] + d[0], tree.alpha0[b, 1] + d[1], tree.alpha0[b, 2] + d[2])
        arm = (R[0] - point[0], R[1] - point[1], R[2] - point[2])
        turned = cross((d[0], d[1], d[2]), arm)
        for i in range(3):
            bodies.Rddot[b, i] = tree.Rddot0[b, i] + d[3 + i] + turned[i]
            bodies.alpha_b[b, i] = A[0, i] * alpha[0] + A[1, i] * alpha[1] + A[2, i] * alpha[2]


@stage
def needed(bodies, tree, b, out):
    """Wrench about the point of reference that the joints of body b must give it: inertia forces less applied forces."""
    F, c, w, w_b, a_b = bodies.wrench[b], bodies.c[b], bodies.omega[b], bodies.omega_b[b], bodies.alpha_b[b]
    A, J, m, a = bodies.A[b], bodies.inertia_b[b], bodies.mass[b], bodies.Rddot[b]
    alpha = (dot(A[0], a_b), dot(A[1], a_b), dot(A[2], a_b))
    ac, wc, ww = cross(alpha, c), dot(w, c), dot(w, w)
    h = (dot(J[0], w_b), dot(J[1], w_b), dot(J[2], w_b))
    g = cross(w_b, h)
    n = (dot(J[0], a_b) + g[0], dot(J[1], a_b) + g[1], dot(J[2], a_b) + g[2])
    f = (
        m * (a[0] + ac[0] + w[0] * wc - c[0] * ww) - F[0],
        m * (a[1] + ac[1] + w[1] * wc - c[1] * ww) - F[1],
        m * (a[2] + ac[2] + w[2] * wc - c[2] * ww) - F[2],
    )
    R, point = bodies.R[b], tree.reference[b]
    u = (R[0] + c[0] - point[0], R[1] + c[1] - point[1], R[2] + c[2] - point[2])
    moment, moved = cross(u, f), cross(c, F)
    for i in range(3):
        out[i] = dot(A[i], n) - F[3 + i] + moved[i] + moment[i]
        out[3 + i] = f[i]


@stage
def add_part(machine, p, factor):
    """Add `factor` times part p of the rows that are left to the wrench of its body."""
    record = record_at(machine)
    bodies, tree = record.bodies, record.tree
    J, marker, b = record.constraints.J[tree.part[p, 1]], tree.part[p, 2], tree.part[p, 3]
    u, R, point, wrench = record.markers.u[marker], bodies.R[b], tree.reference[b], tree.wrench[b]
    arm = (R[0] + u[0] - point[0], R[1] + u[1] - point[1], R[2] + u[2] - point[2])
    moment = cross(arm, (J[0], J[1], J[2]))
    for i in range(3):
        wrench[i] += factor * (J[3 + i] + moment[i])
        wrench[3 + i] += factor * J[i]


@leaf
def solve_small(K, n):
    """x with K[:n, :n] x = K[:n, 6] by Cholesky's method, left in K[:n, 6]."""
    for i in range(n):
        for k in range(i + 1):
            value = K[i, k]
            for j in range(k):
                value -= K[i, j] * K[k, j]
            K[i, k] = np.sqrt(value) if i == k else value / K[k, k]
        value = K[i, 6]
        for j in range(i):
            value -= K[i, j] * K[j, 6]
        K[i, 6] = value / K[i, i]
    for m in range(n):
        i = n - 1 - m
        value = K[i, 6]
        for j in range(i + 1, n):
            value -= K[j, i] * K[j, 6]
        K[i, 6] = value / K[i, i]


@stage
def row_wrench(machine, n, r):
    """Row r of the joint of node n as a wrench on the child about its point of reference, moments over the machine's length."""
    record = record_at(machine)
    tree, bodies = record.tree, record.bodies
    child, part, marker = tree.node[n, 0], tree.reaction[r, 1], tree.reaction[r, 2]
    J, u, R, point = record.constraints.J[part], record.markers.u[marker], bodies.R[child], tree.reference[child]
    f = (J[0], J[1], J[2])
    moment = cross((R[0] + u[0] - point[0], R[1] + u[1] - point[1], R[2] + u[2] - point[2]), f)
    over = 1.0 / tree.size[0]
    return (J[3] + moment[0]) * over, (J[4] + moment[1]) * over, (J[5] + moment[2]) * over, f[0], f[1], f[2]


@stage
def multipliers_of(machine, n):
    """λ of the joint of node n: the rows whose forces -Σ λ J on the child are the wrench that its branch needs."""
    record = record_at(machine)
    tree, wrench = record.tree, record.tree.wrench[record.tree.node[n, 0]]
    first, count = np.int64(tree.carried[n, 0]), np.int64(tree.carried[n, 1]) - np.int64(tree.carried[n, 0])
    K, over = tree.small, 1.0 / tree.size[0]
    for i in range(count):
        a = row_wrench(machine, n, first + i)
        for k in range(i + 1):
            b = row_wrench(machine, n, first + k)
            K[i, k] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
        K[i, 6] = -(a[0] * wrench[0] + a[1] * wrench[1] + a[2] * wrench[2]) * over
        K[i, 6] -= a[3] * wrench[3] + a[4] * wrench[4] + a[5] * wrench[5]
    solve_small(K, count)
    for i in range(count):
        record.constraints.lam[tree.reaction[first + i, 0]] = K[i, 6]


@stage
def reactions(machine):
    """Multipliers of all joints that carry bodies, from the outermost inwards."""
    record = record_at(machine)
    bodies, tree, saddle = record.bodies, record.tree, record.saddle
    ground, rows = bodies.mass.shape[0], saddle.row.shape[0]
    for b in range(ground):
        needed(bodies, tree, b, tree.wrench[b])
    for k in range(tree.part_start.shape[0] - 1):
        factor = record.constraints.lam[saddle.row[k]] if k < rows else -record.friction.force[k - rows]
        for p in range(tree.part_start[k], tree.part_start[k + 1]):
            add_part(machine, p, factor)
    count = tree.node.shape[0]
    for m in range(count):
        n = count - 1 - m
        child, parent = tree.node[n, 0], tree.node[n, 1]
        multipliers_of(machine, n)
        if parent != ground:
            hand_wrench(tree.wrench[child], arm_of(tree, child, parent), tree.wrench[parent])


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    bodies_accelerate(record.bodies, record.tree)
    orient(machine, record.tree.state)
    place_markers(record.bodies, record.markers)
    move_markers(record.bodies, record.markers)
    constraint_rows(record.bodies, record.markers, record.tree.rows)
    combine(machine, record.tree.rows, record.coordinates, record.friction, t)
    reactions(machine)
    return OK
