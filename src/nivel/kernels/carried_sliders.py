"""What a frame shows of a machine in relative coordinates where bodies slide along beams that carry them; see `nivel.kernels.carried`."""

from __future__ import annotations

import numpy as np

from nivel.kernels.carried import count_turns, joint_turn, multipliers_of, quaternion_product, show_frames
from nivel.kernels.compile import leaf, stage
from nivel.kernels.constraint import combine, constraint_rows
from nivel.kernels.coordinate import ALONG
from nivel.kernels.hook import call_hook, family
from nivel.kernels.marker import move_markers, place_markers
from nivel.kernels.record import NONE, RAIL, record_at
from nivel.kernels.status import OK


@leaf
def parameters_of(A, near):
    """Euler parameters of a rotation matrix, of the two the one nearer to `near`.

    4 θ θᵀ is linear in the matrix; the row with the largest diagonal is the best conditioned multiple of θ.
    """
    trace = A[0, 0] + A[1, 1] + A[2, 2]
    x, y, z = A[2, 1] - A[1, 2], A[0, 2] - A[2, 0], A[1, 0] - A[0, 1]
    xy, xz, yz = A[0, 1] + A[1, 0], A[0, 2] + A[2, 0], A[1, 2] + A[2, 1]
    d, e, f, g = 1.0 + trace, 1.0 + 2.0 * A[0, 0] - trace, 1.0 + 2.0 * A[1, 1] - trace, 1.0 + 2.0 * A[2, 2] - trace
    largest = max(d, e, f, g)
    if d == largest:
        a, b, c, d = d, x, y, z
    elif e == largest:
        a, b, c, d = x, e, xy, xz
    elif f == largest:
        a, b, c, d = y, xy, f, yz
    else:
        a, b, c, d = z, xz, yz, g
    size = np.sqrt(a * a + b * b + c * c + d * d)
    if a * near[0] + b * near[1] + c * near[2] + d * near[3] < 0.0:
        size = -size
    return a / size, b / size, c / size, d / size


@stage
def orient(machine):
    """Euler parameters of all bodies in these coordinates."""
    record = record_at(machine)
    theta, tree = record.bodies.theta, record.tree
    for n in range(tree.node.shape[0]):
        node, a, p = tree.node[n], tree.theta[n], theta[tree.node[n, 1]]
        if tree.slider_of[n] == NONE:
            before = quaternion_product((p[0], p[1], p[2], p[3]), (a[0], a[1], a[2], a[3]))
            turned = quaternion_product(before, joint_turn(node[2], tree.number[n], tree.state[tree.place[n, 0] :]))
        else:
            turned = parameters_of(record.bodies.A[node[0]], theta[node[0]])
        for i in range(4):
            theta[node[0], i] = turned[i]


@stage
def measure_rows(machine, t):
    """The coordinates that rows of sliders are made of, which no evaluation needs."""
    record = record_at(machine)
    coordinates, tree = record.coordinates, record.tree
    for q in range(coordinates.reference.shape[0]):
        if coordinates.what[q, 0] > ALONG:
            for k in range(tree.slider.shape[0]):
                if coordinates.what[q, 3] == tree.slider[k, 1]:
                    call_hook(machine, RAIL, q, t)


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need: the residual knows accelerations of bodies
    and what their joints transmit."""
    record = record_at(machine)
    bodies, tree, own = record.bodies, record.tree, record.residual
    for b in range(bodies.mass.shape[0]):
        for i in range(3):
            tree.delta[b, i] = own.acceleration[b, i] - tree.alpha0[b, i]
            tree.delta[b, 3 + i] = own.acceleration[b, 3 + i] - tree.Rddot0[b, i]
        for i in range(6):
            tree.wrench[b, i] = own.wrench[b, i]
    orient(machine)
    show_frames(machine)
    count_turns(record.coordinates, tree)
    place_markers(bodies, record.markers)
    move_markers(bodies, record.markers)
    constraint_rows(bodies, record.markers, tree.rows)
    measure_rows(machine, t)
    combine(machine, tree.rows, record.coordinates, record.friction, t)
    for m in range(tree.node.shape[0]):
        multipliers_of(machine, tree.node.shape[0] - 1 - m)
    return OK
