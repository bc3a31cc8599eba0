"""Motion of a tree with flexible bodies from its joint and modal coordinates, from the ground outwards.

What a joint carries, and what a joint hangs on, is the frame at an interface of a flexible body, which is a body to it (see
`nivel.kernels.bodies.floating_frame`). Two more kinds of nodes lie between such frames and the floating frame of their body:

    MODAL     from the frame at the interface by which the body is carried to the floating frame: A = A_k exp(q~)ᵀ, R = R_k - A (x + φ p)
    OUTWARD   from the floating frame to the frame at every other interface

so a modal velocity moves, while its carrier is at rest, the floating frame by the column (-turn, turn × u - displacement) of its node, u
from the floating frame to the node, and all further frames with it and by their own displacement. A flexible body that hangs on nothing,
or on a marker that its modes do not move (of a node of a beam with gradients), is carried by a frame fixed to its floating frame.
"""

import numpy as np

from nivel.kernels.algebra.spatial import cross, multiply
from nivel.kernels.algebra.vectors import turned
from nivel.kernels.bodies.floating_frame import AXES, SPIN, bend_body, find_node, modes_of, move_node, place_frame
from nivel.kernels.bodies.rigid import turn_to_body_axes
from nivel.kernels.record.record import MODAL, NONE, OUTWARD, record_at
from nivel.kernels.tree.tree import move_child, product, swing
from nivel.native.function import stage


@stage
def read_modes(own, tree, modal, n, y):
    """Modal coordinates and their rates of MODAL node n from the state."""
    first, count = modes_of(own, modal.link[n])
    q, v = np.int64(tree.place[n, 0]), np.int64(tree.place[n, 1])
    for j in range(count):
        own.p[first + j], own.pdot[first + j] = y[q + j], y[v + j]


@stage
def carry_body(bodies, tree, own, modal, n):
    """Pose and velocity of the flexible body of MODAL node n from those of its carrier, and what moves it while its joint is at rest."""
    b, r, f = tree.node[n, 0], tree.node[n, 1], modal.link[n]
    k, A, arm, number = modal.carrier[f], bodies.A[b], tree.arm[b], tree.number[n]
    R, w, V, alpha, a = bodies.R[b], bodies.omega[b], bodies.Rdot[b], tree.alpha0[b], tree.Rddot0[b]
    Rr, wr, Vr, alphar, ar = bodies.R[r], bodies.omega[r], bodies.Rdot[r], tree.alpha0[r], tree.Rddot0[r]
    product(bodies.A[r], tree.first[n], tree.axes)
    Ar = bodies.A[r]
    # from the carrier's origin to the node, or where this is none of the modes to the origin
    d = turned(Ar, (number[4], number[5], number[6]))
    of_node, push = cross(wr, d), swing(alphar, wr, d)
    if k == NONE:
        for i in range(3):
            for j in range(3):
                A[i, j] = tree.axes[i, j]
            arm[i], R[i], V[i] = d[i], Rr[i] + d[i], Vr[i] + of_node[i]
            w[i], alpha[i], a[i] = wr[i], alphar[i], ar[i] + push[i]
        turn_to_body_axes(bodies, b)
        bend_body(bodies, own, f)
        return
    find_node(own, k)
    node, X = own.node[k], tree.axes
    for i in range(3):
        for j in range(3):
            at = AXES + 3 * j
            A[i, j] = X[i, 0] * node[at] + X[i, 1] * node[at + 1] + X[i, 2] * node[at + 2]
    # seen from the body: the node moves by `rate` and turns by `turning`; R and V serve as work
    u, rate, turning = R, V, w
    multiply(A, node[SPIN : SPIN + 3], turning)
    ww = (wr[0] - turning[0], wr[1] - turning[1], wr[2] - turning[2])
    move_node(A, ww, own, k, u, rate, turning)
    bias, column = own.bias[k], modal.column[f]
    ux, uy, uz = u[0], u[1], u[2]
    vx, vy, vz = rate[0], rate[1], rate[2]
    lever = (ux, uy, uz)
    of_lever = cross(ww, lever)
    for i in range(3):
        w[i] = ww[i]
        alpha[i] = alphar[i] - bias[i]
    pull = cross(alpha, lever)
    arm[0], arm[1], arm[2] = d[0] - ux, d[1] - uy, d[2] - uz
    V[0], V[1], V[2] = (
        Vr[0] + of_node[0] - of_lever[0] - vx,
        Vr[1] + of_node[1] - of_lever[1] - vy,
        Vr[2] + of_node[2] - of_lever[2] - vz,
    )
    for i in range(3):
        R[i] = Rr[i] + arm[i]
        a[i] = ar[i] + push[i] - pull[i] - bias[3 + i]
    turn, displacement = own.turn[k], own.displacement[k]
    _, count = modes_of(own, f)
    for j in range(count):
        x, y, z = turn[0, j], turn[1, j], turn[2, j]
        column[0, j], column[1, j], column[2, j] = -x, -y, -z
        column[3, j] = y * uz - z * uy - displacement[0, j]
        column[4, j] = z * ux - x * uz - displacement[1, j]
        column[5, j] = x * uy - y * ux - displacement[2, j]
    turn_to_body_axes(bodies, b)
    bend_body(bodies, own, f)


@stage
def carry_frame(bodies, tree, own, k):
    """Pose, velocity and bias of frame k at an interface from those of its body."""
    v, b = own.frame[k, 1], own.body[own.frame[k, 0]]
    find_node(own, k)
    place_frame(bodies, own, k)
    arm, bias, alpha, a = bodies.c[v], own.bias[k], tree.alpha0[b], tree.Rddot0[b]
    across = cross(alpha, arm)
    for i in range(3):
        tree.arm[v, i] = arm[i]
        tree.alpha0[v, i] = alpha[i] + bias[i]
        tree.Rddot0[v, i] = a[i] + across[i] + bias[3 + i]


@stage
def move_flexible_tree(machine, y):
    """Poses and velocities of all bodies and frames from the state, and the columns of their motion."""
    record = record_at(machine)
    bodies, tree, own, modal = record.bodies, record.tree, record.flexible, record.modal
    for n in range(tree.node.shape[0]):
        kind = tree.node[n, 2]
        if kind == MODAL:
            read_modes(own, tree, modal, n, y)
            carry_body(bodies, tree, own, modal, n)
        elif kind == OUTWARD:
            carry_frame(bodies, tree, own, modal.link[n])
        else:
            move_child(machine, bodies, tree, n, y)


@stage
def clear_frames(bodies):
    """No wrenches on the frames behind the ground."""
    for v in range(bodies.mass.shape[0] + 1, bodies.wrench.shape[0]):
        for i in range(6):
            bodies.wrench[v, i] = 0.0
