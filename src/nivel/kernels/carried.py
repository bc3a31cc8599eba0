"""What a frame shows of a machine in relative coordinates beyond what its equations need: accelerations, Euler parameters, all
markers, and the rows and reactions of the joints that carry bodies.

A joint that carries a body transmits what its branch needs: the inertia forces of all bodies outwards of it less all that is applied
to them. The multipliers of its rows are the ones whose forces on the child are that wrench.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import hand_wrench
from nivel.kernels.compile import leaf, stage
from nivel.kernels.constraint import combine, constraint_rows
from nivel.kernels.hook import family
from nivel.kernels.marker import move_markers, place_markers
from nivel.kernels.record import FIXED, FREE, PLANAR, SPHERICAL, TRANSLATIONAL, UNIVERSAL, record_at
from nivel.kernels.rigid import turn_to_body_axes
from nivel.kernels.spatial import cross, dot
from nivel.kernels.status import OK
from nivel.kernels.tree import swing


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
def joint_turn(kind, number, q):
    """Euler parameters of the child seen from the marker of the parent: half angles, so whole turns change no sign suddenly."""
    if kind == SPHERICAL:
        return q[0], q[1], q[2], q[3]
    if kind == FREE:
        return q[3], q[4], q[5], q[6]
    if kind in (TRANSLATIONAL, FIXED):
        # markers may be half a turn apart
        return (1.0, 0.0, 0.0, 0.0) if number[2] > 0.0 else (0.0, 0.0, 0.0, 1.0)
    half = 0.5 * (q[2] if kind == PLANAR else q[0])
    about_first = (np.cos(half), 0.0, 0.0, np.sin(half))
    if kind != UNIVERSAL:
        return about_first
    # X: half a turn about (1, 0, 1)/√2
    crossed = quaternion_product(about_first, (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)))
    return quaternion_product(crossed, (np.cos(0.5 * q[1]), 0.0, 0.0, np.sin(0.5 * q[1])))


@stage
def orient(machine):
    """Euler parameters of all bodies in these coordinates, then of their own frames."""
    record = record_at(machine)
    theta, tree = record.bodies.theta, record.tree
    for n in range(tree.node.shape[0]):
        node, a, p = tree.node[n], tree.theta[n], theta[tree.node[n, 1]]
        before = quaternion_product((p[0], p[1], p[2], p[3]), (a[0], a[1], a[2], a[3]))
        turned = quaternion_product(before, joint_turn(node[2], tree.number[n], tree.state[tree.place[n, 0] :]))
        for i in range(4):
            theta[node[0], i] = turned[i]


@stage
def show_frames(machine):
    """Positions, Euler parameters, velocities and accelerations of the bodies' own frames; ω̄ and ᾱ of these coordinates' frames."""
    record = record_at(machine)
    bodies, tree, frames = record.bodies, record.tree, record.frames
    for b in range(bodies.mass.shape[0]):
        d, A, w, own, e, f = (
            tree.delta[b],
            bodies.A[b],
            bodies.omega[b],
            tree.own[b],
            bodies.theta[b],
            tree.own_theta[b],
        )
        alpha = (tree.alpha0[b, 0] + d[0], tree.alpha0[b, 1] + d[1], tree.alpha0[b, 2] + d[2])
        u = (dot(A[0], own), dot(A[1], own), dot(A[2], own))
        speed, acceleration = cross(w, u), swing(alpha, w, u)
        for i in range(3):
            bodies.Rddot[b, i] = tree.Rddot0[b, i] + d[3 + i]
            bodies.alpha_b[b, i] = A[0, i] * alpha[0] + A[1, i] * alpha[1] + A[2, i] * alpha[2]
            frames.R[b, i] = bodies.R[b, i] + u[i]
            frames.Rdot[b, i] = bodies.Rdot[b, i] + speed[i]
            frames.Rddot[b, i] = bodies.Rddot[b, i] + acceleration[i]
        turn_to_body_axes(bodies, b)
        turned = quaternion_product((e[0], e[1], e[2], e[3]), (f[0], f[1], f[2], f[3]))
        for i in range(4):
            frames.theta[b, i] = turned[i]


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
    J, u, wrench = (
        record.constraints.J[tree.part[p, 1]],
        record.markers.u[tree.part[p, 2]],
        tree.wrench[tree.part[p, 3]],
    )
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
            hand_wrench(tree.wrench[child], tree.arm[child], tree.wrench[parent])


@stage
def count_turns(coordinates, tree):
    """References of the angles whose turns the state counts."""
    for n in range(tree.counted.shape[0]):
        coordinates.reference[tree.counted[n, 0]] = tree.turn[n, 0] * tree.state[tree.counted[n, 1]] + tree.turn[n, 1]


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    orient(machine)
    show_frames(machine)
    count_turns(record.coordinates, record.tree)
    place_markers(record.bodies, record.markers)
    move_markers(record.bodies, record.markers)
    constraint_rows(record.bodies, record.markers, record.tree.rows)
    combine(machine, record.tree.rows, record.coordinates, record.friction, t)
    reactions(machine)
    return OK
