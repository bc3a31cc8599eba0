"""Reactions of the joints that carry bodies in relative coordinates.

A joint that carries a body transmits what its branch needs: the inertia forces of all bodies outwards of it less all that is applied
to them. The multipliers of its rows are the ones whose forces on the child are that wrench.
"""

import numpy as np

from nivel.kernels.algebra.spatial import cross
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.articulated import hand_wrench
from nivel.kernels.tree.tree import swing
from nivel.native.function import leaf, stage


@stage
def needed(bodies, tree, b, out):
    """Wrench about the frame's origin that the joints of body b must give it: inertia forces less applied forces."""
    F, c, w, P, d = bodies.wrench[b], bodies.c[b], bodies.omega[b], tree.inertia[b], tree.delta[b]
    m, a = bodies.mass[b], bodies.Rddot[b]
    alpha = (tree.alpha0[b, 0] + d[0], tree.alpha0[b, 1] + d[1], tree.alpha0[b, 2] + d[2])
    s, ca = swing(alpha, w, c), cross(c, a)
    xx, xy, xz, yy, yz, zz = P[21], P[22], P[23], P[24], P[25], P[26]
    h = (xx * w[0] + xy * w[1] + xz * w[2], xy * w[0] + yy * w[1] + yz * w[2], xz * w[0] + yz * w[1] + zz * w[2])
    g = cross(w, h)
    out[0] = xx * alpha[0] + xy * alpha[1] + xz * alpha[2] + g[0] + m * ca[0] - F[3]
    out[1] = xy * alpha[0] + yy * alpha[1] + yz * alpha[2] + g[1] + m * ca[1] - F[4]
    out[2] = xz * alpha[0] + yz * alpha[1] + zz * alpha[2] + g[2] + m * ca[2] - F[5]
    for i in range(3):
        out[3 + i] = m * (a[i] + s[i]) - F[i]


@stage
def add_part(machine, p, factor):
    """Add `factor` times part p of the rows that are left to the wrench of its body."""
    record = record_at(machine)
    tree = record.tree
    J, u = record.constraints.J[tree.part[p, 1]], record.markers.u[tree.part[p, 2]]
    wrench = tree.wrench[tree.part[p, 3]]
    moment = cross(u, J)
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
def row_wrench(machine, r):
    """Row r of a joint that carries a body as a wrench on it about its frame's origin, moments over the machine's length."""
    record = record_at(machine)
    tree = record.tree
    J, u, over = record.constraints.J[tree.reaction[r, 1]], record.markers.u[tree.reaction[r, 2]], 1.0 / tree.size[0]
    moment = cross(u, J)
    return (J[3] + moment[0]) * over, (J[4] + moment[1]) * over, (J[5] + moment[2]) * over, J[0], J[1], J[2]


@stage
def multipliers_of(machine, n):
    """λ of the joint of node n: the rows whose forces -Σ λ J on the child are the wrench that its branch needs."""
    record = record_at(machine)
    tree, wrench = record.tree, record.tree.wrench[record.tree.node[n, 0]]
    first, count = np.int64(tree.carried[n, 0]), np.int64(tree.carried[n, 1]) - np.int64(tree.carried[n, 0])
    K, over = tree.small, 1.0 / tree.size[0]
    for i in range(count):
        a = row_wrench(machine, first + i)
        for k in range(i + 1):
            b = row_wrench(machine, first + k)
            K[i, k] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
        K[i, 6] = -(a[0] * wrench[0] + a[1] * wrench[1] + a[2] * wrench[2]) * over
        K[i, 6] -= a[3] * wrench[3] + a[4] * wrench[4] + a[5] * wrench[5]
    solve_small(K, count)
    for i in range(count):
        record.constraints.lam[tree.reaction[first + i, 0]] = K[i, 6]


@stage
def hand_reactions(machine):
    """Multipliers of all joints that carry bodies, from the outermost inwards: from `tree.wrench` of what every body needs by itself, and
    the constraints that are left."""
    record = record_at(machine)
    tree, saddle = record.tree, record.saddle
    ground, rows, count = record.bodies.mass.shape[0], saddle.row.shape[0], tree.node.shape[0]
    for k in range(tree.part_start.shape[0] - 1):
        factor = record.constraints.lam[saddle.row[k]] if k < rows else -record.friction.force[k - rows]
        for p in range(tree.part_start[k], tree.part_start[k + 1]):
            add_part(machine, p, factor)
    for m in range(count):
        n = count - 1 - m
        child, parent = tree.node[n, 0], tree.node[n, 1]
        multipliers_of(machine, n)
        if parent != ground:
            hand_wrench(tree.wrench[child], tree.arm[child], tree.wrench[parent])
