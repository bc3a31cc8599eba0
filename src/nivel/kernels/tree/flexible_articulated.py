"""Articulated bodies with modes: the recursion of `nivel.kernels.tree.articulated` over a tree with flexible bodies, O(n) in their number.

A flexible body feels (α, a) of its floating frame and p̈, global axes:

    [N; F] = P [α; a] + B p̈ + …        e = Bᵀ [α; a] + M p̈ + …

A frame at an interface moves by [α; a] and its modal twist Φ p̈, so the inertia P_k of all that it carries adds P_k to P, P_k Φ to B and
Φᵀ P_k Φ to M, which is one at first. While the carrier is at rest p̈ also moves the floating frame, by s p̈: sᵀ B + Bᵀ s + sᵀ P s is added to
M, P s to B.
With M = Uᵀ U the modes are eliminated before the joint that carries their body:

    Y = U⁻ᵀ Bᵀ        P := P - Yᵀ Y
"""

import numpy as np

from nivel.kernels.bodies.floating_frame import modes_of
from nivel.kernels.core.status import NO_MASS_LEFT, OK
from nivel.kernels.record.record import MODAL, OUTWARD, record_at
from nivel.kernels.tree.articulated import eliminate_columns, hand_inertia, own_inertia, set_inertia, subtract_outer
from nivel.native.function import leaf, stage


@leaf
def times_inertia(P, x, y, n, out):
    """out (6, n) = P [x; y], x (3, n) angular, y (3, n) of the origin."""
    for j in range(n):
        out[0, j] = P[0] * x[0, j] + P[1] * x[1, j] + P[2] * x[2, j] + P[6] * y[0, j] + P[7] * y[1, j] + P[8] * y[2, j]
    for j in range(n):
        out[1, j] = (
            P[1] * x[0, j] + P[3] * x[1, j] + P[4] * x[2, j] + P[9] * y[0, j] + P[10] * y[1, j] + P[11] * y[2, j]
        )
    for j in range(n):
        out[2, j] = (
            P[2] * x[0, j] + P[4] * x[1, j] + P[5] * x[2, j] + P[12] * y[0, j] + P[13] * y[1, j] + P[14] * y[2, j]
        )
    for j in range(n):
        out[3, j] = (
            P[6] * x[0, j] + P[9] * x[1, j] + P[12] * x[2, j] + P[15] * y[0, j] + P[16] * y[1, j] + P[17] * y[2, j]
        )
    for j in range(n):
        out[4, j] = (
            P[7] * x[0, j] + P[10] * x[1, j] + P[13] * x[2, j] + P[16] * y[0, j] + P[18] * y[1, j] + P[19] * y[2, j]
        )
    for j in range(n):
        out[5, j] = (
            P[8] * x[0, j] + P[11] * x[1, j] + P[14] * x[2, j] + P[17] * y[0, j] + P[19] * y[1, j] + P[20] * y[2, j]
        )


@stage
def modal_inertia(bodies, tree, own, modal, f):
    """Inertia, coupling and modal mass of flexible body f alone, about the origin of its floating frame, global axes."""
    b = own.body[f]
    A, B, out, M = bodies.A[b], own.coupling[f], modal.coupling[f], modal.factor[f]
    set_inertia(A, own.inertia[f], bodies.mass[b], bodies.c[b], tree.inertia[b])
    _, n = modes_of(own, f)
    for i in range(3):
        A0, A1, A2 = A[i, 0], A[i, 1], A[i, 2]
        for j in range(n):
            out[i, j] = A0 * B[3, j] + A1 * B[4, j] + A2 * B[5, j]
        for j in range(n):
            out[3 + i, j] = A0 * B[0, j] + A1 * B[1, j] + A2 * B[2, j]
    first = np.int64(own.mode[f, 0])
    for j in range(n):
        for k in range(j, n):
            M[j, k] = 0.0
        M[j, j] = 1.0 + modal.shift[first + j]


@leaf
def add_outer(M, x, y, first, n):
    """Upper triangle of M += Σ x_iᵀ y_i over three rows of x and y from `first` on of y."""
    y0, y1, y2 = y[first], y[first + 1], y[first + 2]
    for j in range(n):
        a, b, c, row = x[0, j], x[1, j], x[2, j], M[j]
        for k in range(j, n):
            row[k] += a * y0[k] + b * y1[k] + c * y2[k]


@stage
def take_frame(bodies, tree, own, modal, k):
    """Add the inertia that frame k at an interface carries to that of its body and its modes."""
    f, v = own.frame[k, 0], own.frame[k, 1]
    b = own.body[f]
    P, r, turn, displacement, push = tree.inertia[v], tree.arm[v], own.turn[k], own.displacement[k], modal.push
    B, M = modal.coupling[f], modal.factor[f]
    _, n = modes_of(own, f)
    times_inertia(P, turn, displacement, n, push)
    add_outer(M, turn, push, 0, n)
    add_outer(M, displacement, push, 3, n)
    r0, r1, r2 = r[0], r[1], r[2]
    for j in range(n):
        B[0, j] += push[0, j] + r1 * push[5, j] - r2 * push[4, j]
        B[1, j] += push[1, j] + r2 * push[3, j] - r0 * push[5, j]
        B[2, j] += push[2, j] + r0 * push[4, j] - r1 * push[3, j]
    for i in range(3, 6):
        for j in range(n):
            B[i, j] += push[i, j]
    hand_inertia(P, r, tree.inertia[b])


@stage
def eliminate_modes(bodies, tree, own, modal, f):
    """Factor of the modal mass of flexible body f, with all that it carries; its inertia becomes what its carrier feels. Whether there is a
    factor."""
    b = own.body[f]
    P, B, s, M, push = tree.inertia[b], modal.coupling[f], modal.column[f], modal.factor[f], modal.push
    _, n = modes_of(own, f)
    if modal.carrier[f] < own.frame.shape[0]:
        times_inertia(P, s[0:3], s[3:6], n, push)
        add_outer(M, B[0:3], s, 0, n)
        add_outer(M, B[3:6], s, 3, n)
        for i in range(6):
            for j in range(n):
                B[i, j] += push[i, j]
        add_outer(M, s[0:3], B, 0, n)
        add_outer(M, s[3:6], B, 3, n)
    for j in range(n):
        for i in range(6):
            M[j, n + i] = B[i, j]
    width = n + 6
    for k in range(n):
        row = M[k]
        if not row[k] > 0.0:
            return False
        scale = 1.0 / np.sqrt(row[k])
        for j in range(k, width):
            row[j] *= scale
        for i in range(k + 1, n):
            share, below = row[i], M[i]
            for j in range(i, width):
                below[j] -= share * row[j]
        y = row[n], row[n + 1], row[n + 2], row[n + 3], row[n + 4], row[n + 5]
        subtract_outer(P, y, y)
    return True


@stage
def factorise_flexible_tree(machine):
    """Inertias of all bodies, and the factors of all columns, from the outermost node inwards. Returns a status."""
    record = record_at(machine)
    bodies, tree, own, modal = record.bodies, record.tree, record.flexible, record.modal
    ground, count = bodies.mass.shape[0], tree.node.shape[0]
    for b in range(ground):
        if own.rigid[b] == 1:
            own_inertia(bodies, tree, b)
    for b in range(ground, tree.inertia.shape[0]):
        for i in range(27):
            tree.inertia[b, i] = 0.0
    for f in range(own.body.shape[0]):
        modal_inertia(bodies, tree, own, modal, f)
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        child, parent, kind, first, last = node[0], node[1], node[2], np.int64(node[4]), np.int64(node[5])
        P = tree.inertia[child]
        if kind == OUTWARD:
            if modal.heavy[n] != 0:
                take_frame(bodies, tree, own, modal, modal.link[n])
            continue
        if kind == MODAL:
            if not eliminate_modes(bodies, tree, own, modal, modal.link[n]):
                record.control.failure[0] = child
                return NO_MASS_LEFT
        else:
            eliminate_columns(tree, P, first, last)
        if parent != ground:
            hand_inertia(P, tree.arm[child], tree.inertia[parent])
    return OK
