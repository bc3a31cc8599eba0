"""Motion of the bodies of a tree from its joint coordinates, from the ground outwards.

Node n carries a child body on a parent body by a joint between a marker i of the parent and a marker j of the child. In these coordinates
the frame of a body is its marker j. Whatever the joint, A_j = A_i Q and r_j = r_i + A_i d, and the child moves relative to the parent
with ω_rel = Σ w_k u_k and, at r_j, v_rel = Σ v_k u_k; columns (w_k, v_k) are fixed in one of the two bodies:

    ω_child = ω_parent + ω_rel            α_child = α_parent + Σ w_k u̇_k + ω_parent × ω_rel + …
    v_child = v_parent(r_j) + v_rel       a_child = a_parent(r_j) + Σ v_k u̇_k + 2 ω_parent × v_rel

with … = u_1 u_2 w_1 × w_2 of a universal joint, whose second axis is fixed in the child.
"""

import numpy as np

from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.algebra.vectors import turned
from nivel.kernels.record.record import NONE, UNIVERSAL, record_at
from nivel.kernels.tree.joints import BY_ADDRESS, call_motion, move_joint, plus, times
from nivel.native.function import leaf, stage


@leaf
def product(A, B, out):
    """out = A B of 3×3 matrices; `out` is neither."""
    for i in range(3):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        out[i, 0] = a * B[0, 0] + b * B[1, 0] + c * B[2, 0]
        out[i, 1] = a * B[0, 1] + b * B[1, 1] + c * B[2, 1]
        out[i, 2] = a * B[0, 2] + b * B[1, 2] + c * B[2, 2]


@leaf
def swing(alpha, w, u):
    """α × u + ω × (ω × u)."""
    a = cross(alpha, u)
    wu, ww = dot(w, u), dot(w, w)
    return a[0] + w[0] * wu - u[0] * ww, a[1] + w[1] * wu - u[1] * ww, a[2] + w[2] * wu - u[2] * ww


@stage
def move_child(machine, bodies, tree, n, y):
    """Pose and velocity of the child of node n, its acceleration while no joint velocity changes, and the columns of its joint."""
    node, number = tree.node[n], tree.number[n]
    child, parent, kind, k = node[0], node[1], node[2], np.int64(node[4])
    carried = parent != bodies.mass.shape[0]
    axes, arm, A = tree.first[n], (number[4], number[5], number[6]), bodies.A[child]
    if carried:
        Ap = bodies.A[parent]
        product(Ap, tree.first[n], tree.axes)
        axes = tree.axes
        arm = turned(Ap, arm)
    alpha, a = tree.alpha0[child], tree.Rddot0[child]
    if kind >= BY_ADDRESS:
        call_motion(machine, n, y)
        arm = plus(arm, (tree.arm[child, 0], tree.arm[child, 1], tree.arm[child, 2]))
    else:
        arm = plus(arm, move_joint(kind, number, y[tree.place[n, 0] :], axes, A, tree.column, k))
        alpha[0], alpha[1], alpha[2] = 0.0, 0.0, 0.0
        a[0], a[1], a[2] = 0.0, 0.0, 0.0
    R, V, w = bodies.R[child], bodies.Rdot[child], bodies.omega[child]
    tree.arm[child, 0], tree.arm[child, 1], tree.arm[child, 2] = arm
    multiply(A, bodies.centre_b[child], bodies.c[child])
    u = y[tree.place[n, 1] :]
    w0, w1, w2, v0, v1, v2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for c in range(np.int64(node[5]) - k):
        s, rate = tree.column[k + c], u[c]
        w0 += rate * s[0]
        w1 += rate * s[1]
        w2 += rate * s[2]
        v0 += rate * s[3]
        v1 += rate * s[4]
        v2 += rate * s[5]
    R[0], R[1], R[2] = arm
    w[0], w[1], w[2] = w0, w1, w2
    V[0], V[1], V[2] = v0, v1, v2
    if kind == UNIVERSAL:
        twist = cross(tree.column[k][0:3], tree.column[k + 1][0:3])
        alpha[0], alpha[1], alpha[2] = times(u[0] * u[1], twist)
    if carried:
        add_parent(bodies, tree, child, parent, arm)


@stage
def add_parent(bodies, tree, child, parent, arm):
    """Add the motion of the parent to that of the child relative to it."""
    R, Rp, V, Vp = bodies.R[child], bodies.R[parent], bodies.Rdot[child], bodies.Rdot[parent]
    w, wp, alpha, ap = bodies.omega[child], bodies.omega[parent], tree.alpha0[child], tree.alpha0[parent]
    a, ar = tree.Rddot0[child], tree.Rddot0[parent]
    out, bend, coriolis, there = cross(wp, arm), cross(wp, w), cross(wp, V), swing(ap, wp, arm)
    R[0], R[1], R[2] = Rp[0] + arm[0], Rp[1] + arm[1], Rp[2] + arm[2]
    alpha[0] += ap[0] + bend[0]
    alpha[1] += ap[1] + bend[1]
    alpha[2] += ap[2] + bend[2]
    a[0] += ar[0] + there[0] + 2.0 * coriolis[0]
    a[1] += ar[1] + there[1] + 2.0 * coriolis[1]
    a[2] += ar[2] + there[2] + 2.0 * coriolis[2]
    w[0], w[1], w[2] = wp[0] + w[0], wp[1] + w[1], wp[2] + w[2]
    V[0], V[1], V[2] = Vp[0] + out[0] + V[0], Vp[1] + out[1] + V[1], Vp[2] + out[2] + V[2]


@stage
def move_tree(machine, y):
    """Poses and velocities of all bodies from the state."""
    record = record_at(machine)
    bodies, tree = record.bodies, record.tree
    for n in range(tree.node.shape[0]):
        move_child(machine, bodies, tree, n, y)


@leaf
def has_passed(tree):
    """Whether a slider has just passed a node of its beam, see `nivel.kernels.residual.element_crossing`."""
    for k in range(tree.element.shape[0]):
        if tree.element[k, 1] != NONE:
            return True
    return False
