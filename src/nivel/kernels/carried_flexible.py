"""What a frame shows of a machine in relative coordinates with flexible bodies beyond what its equations need: as in
`nivel.kernels.carried`."""

from __future__ import annotations

import numpy as np

from nivel.kernels.articulated import hand_wrench
from nivel.kernels.carried import (
    add_part,
    count_turns,
    joint_turn,
    multipliers_of,
    needed,
    quaternion_product,
    show_frames,
)
from nivel.kernels.compile import stage
from nivel.kernels.constraint import combine, constraint_rows
from nivel.kernels.floating_dynamics import inertia_wrench
from nivel.kernels.floating_frame import TURN
from nivel.kernels.hook import family
from nivel.kernels.marker import move_markers, place_markers
from nivel.kernels.record import MODAL, NONE, OUTWARD, record_at
from nivel.kernels.rigid import turn_to_body_axes
from nivel.kernels.status import OK


@stage
def node_turn(own, k):
    """Euler parameters of exp(q~), the turn of frame k at an interface by the modes."""
    x, y, z = own.node[k, TURN], own.node[k, TURN + 1], own.node[k, TURN + 2]
    half = 0.5 * np.sqrt(x * x + y * y + z * z)
    # sin(half)/(2 half), whose series the small angles need
    share = 0.5 * np.sin(half) / half if half > 1e-4 else 0.5 - half * half / 12.0
    return np.cos(half), share * x, share * y, share * z


@stage
def orient_flexible(machine):
    """Euler parameters of all bodies and frames."""
    record = record_at(machine)
    theta, tree, own, modal = record.bodies.theta, record.tree, record.flexible, record.modal
    for n in range(tree.node.shape[0]):
        node, a, p = tree.node[n], tree.theta[n], theta[tree.node[n, 1]]
        kind, before = node[2], quaternion_product((p[0], p[1], p[2], p[3]), (a[0], a[1], a[2], a[3]))
        turn = (1.0, 0.0, 0.0, 0.0)
        if kind == MODAL:
            if modal.carrier[modal.link[n]] != NONE:
                e = node_turn(own, modal.carrier[modal.link[n]])
                turn = e[0], -e[1], -e[2], -e[3]
        elif kind == OUTWARD:
            turn = node_turn(own, modal.link[n])
        else:
            turn = joint_turn(kind, tree.number[n], tree.state[tree.place[n, 0] :])
        turned = quaternion_product(before, turn)
        for i in range(4):
            theta[node[0], i] = turned[i]


@stage
def show_interfaces(bodies, tree):
    """Accelerations and body-axis angular velocities of the frames at interfaces, for sensors."""
    for v in range(bodies.mass.shape[0] + 1, bodies.R.shape[0]):
        d, A = tree.delta[v], bodies.A[v]
        x, y, z = tree.alpha0[v, 0] + d[0], tree.alpha0[v, 1] + d[1], tree.alpha0[v, 2] + d[2]
        for i in range(3):
            bodies.Rddot[v, i] = tree.Rddot0[v, i] + d[3 + i]
            bodies.alpha_b[v, i] = A[0, i] * x + A[1, i] * y + A[2, i] * z
        turn_to_body_axes(bodies, v)


@stage
def flexible_reactions(machine):
    """Multipliers of all joints that carry bodies, from the outermost inwards."""
    record = record_at(machine)
    bodies, tree, saddle, own = record.bodies, record.tree, record.saddle, record.flexible
    ground, rows = bodies.mass.shape[0], saddle.row.shape[0]
    for b in range(ground):
        if own.rigid[b] == 1:
            needed(bodies, tree, b, tree.wrench[b])
    for f in range(own.body.shape[0]):
        inertia_wrench(bodies, own, f, tree.wrench[own.body[f]])
    for v in range(ground + 1, tree.wrench.shape[0]):
        F, out = bodies.wrench[v], tree.wrench[v]
        for i in range(3):
            out[i], out[3 + i] = -F[3 + i], -F[i]
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


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    orient_flexible(machine)
    show_frames(machine)
    show_interfaces(record.bodies, record.tree)
    count_turns(record.coordinates, record.tree)
    place_markers(record.bodies, record.markers)
    move_markers(record.bodies, record.markers)
    constraint_rows(record.bodies, record.markers, record.tree.rows)
    combine(machine, record.tree.rows, record.coordinates, record.friction, t)
    flexible_reactions(machine)
    return OK
