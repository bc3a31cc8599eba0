"""Euler parameters of the bodies of a tree, which no evaluation needs: from the ground outwards by half angles, so that whole turns change
no sign suddenly."""

import numpy as np

from nivel.kernels.bodies.floating_frame import TURN
from nivel.kernels.record.record import MODAL, NONE, OUTWARD, record_at
from nivel.kernels.tree.joints import joint_turn, quaternion_product
from nivel.native.function import leaf, stage


@stage
def node_turn(own, k):
    """Euler parameters of exp(q~), the turn of frame k at an interface by the modes."""
    x, y, z = own.node[k, TURN], own.node[k, TURN + 1], own.node[k, TURN + 2]
    half = 0.5 * np.sqrt(x * x + y * y + z * z)
    # sin(half)/(2 half), whose series the small angles need
    share = 0.5 * np.sin(half) / half if half > 1e-4 else 0.5 - half * half / 12.0
    return np.cos(half), share * x, share * y, share * z


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
def turn_of_node(machine, n):
    """Euler parameters of the child of node n, which is carried by no beam, seen from the marker of the parent."""
    record = record_at(machine)
    tree, modal, kind = record.tree, record.modal, record.tree.node[n, 2]
    if kind == OUTWARD:
        return node_turn(record.flexible, modal.link[n])
    if kind != MODAL:
        return joint_turn(kind, tree.number[n], tree.state[tree.place[n, 0] :])
    carrier = modal.carrier[modal.link[n]]
    if carrier == NONE:
        return 1.0, 0.0, 0.0, 0.0
    e = node_turn(record.flexible, carrier)
    return e[0], -e[1], -e[2], -e[3]


@stage
def orient(machine):
    """Euler parameters of all bodies and frames in these coordinates."""
    record = record_at(machine)
    theta, tree = record.bodies.theta, record.tree
    for n in range(tree.node.shape[0]):
        node, a, p = tree.node[n], tree.theta[n], theta[tree.node[n, 1]]
        if node[2] > OUTWARD:
            turned = parameters_of(record.bodies.A[node[0]], theta[node[0]])
        else:
            before = quaternion_product((p[0], p[1], p[2], p[3]), (a[0], a[1], a[2], a[3]))
            turned = quaternion_product(before, turn_of_node(machine, n))
        for i in range(4):
            theta[node[0], i] = turned[i]
