"""Elements in absolute nodal coordinates: the places of two nodes and gradients there, from points of the machine, and forces back.

A node is a flexible body of no other deformation than that of its gradients ∂r/∂X, ∂r/∂Y, ∂r/∂Z: the frame turns with them, modes stretch
and shear them. Points at the tips of the gradients, at a reach ℓ from the node, carry both: g = (tip - node)/ℓ. The vectors of an element
are (place, gradients) of its first node, then of its second (Shabana, Yakoub 2001); on the line between them

    r' = Σ N'_j v_j with Hermite's cubic polynomials of places and gradients along x.
"""

from nivel.kernels.algebra.vectors import minus, put, times
from nivel.native.function import stage

# columns of `columns`: markers of the node and of the tips of its gradients, of both nodes
# columns of `number`: time of damping [s], reach of each node [m]; then work: vectors of the element (8 × 3), their rates, their forces
DAMPING, REACH, VECTOR, RATE, FORCE, OWN = 0, 1, 3, 27, 51, 75


@stage
def read_vectors(markers, index, n, width):
    """Vectors of an element and their rates; width : of them at a node. Forces start at zero."""
    for a in range(2):
        node = index[width * a]
        put(n, VECTOR + 3 * width * a, markers.r[node])
        put(n, RATE + 3 * width * a, markers.rdot[node])
        for j in range(1, width):
            tip, at = index[width * a + j], 3 * (width * a + j)
            for i in range(3):
                n[VECTOR + at + i] = (markers.r[tip, i] - markers.r[node, i]) / n[REACH + a]
                n[RATE + at + i] = (markers.rdot[tip, i] - markers.rdot[node, i]) / n[REACH + a]
    for i in range(24):
        n[FORCE + i] = 0.0


@stage
def push_vectors(bodies, markers, index, n, width):
    """Forces on the vectors as forces at their points, on the bodies there: these points are where nothing is between them and the
    origin of a body or of a frame."""
    for a in range(2):
        on_node = bodies.wrench[markers.body[index[width * a]]]
        for i in range(3):
            on_node[i] += n[FORCE + 3 * width * a + i]
        for j in range(1, width):
            on_tip, at = bodies.wrench[markers.body[index[width * a + j]]], 3 * (width * a + j)
            for i in range(3):
                force = n[FORCE + at + i] / n[REACH + a]
                on_tip[i] += force
                on_node[i] -= force


@stage
def along_line(n, first, weights, width):
    """Σ weights (places and gradients along x of both nodes) of the vectors, or their rates, from n[first] on."""
    a, b, c, d = weights[0], weights[1], weights[2], weights[3]
    p, q, r, s = first, first + 3, first + 3 * width, first + 3 * width + 3
    return (
        a * n[p] + b * n[q] + c * n[r] + d * n[s],
        a * n[p + 1] + b * n[q + 1] + c * n[r + 1] + d * n[s + 1],
        a * n[p + 2] + b * n[q + 2] + c * n[r + 2] + d * n[s + 2],
    )


@stage
def add_along_line(n, weights, width, force):
    """Subtract a force on such a sum from the forces on the vectors: what is stored pulls back."""
    for k in range(4):
        at = FORCE + 3 * (width * (k // 2) + k % 2)
        put(n, at, minus(n[at:], times(weights[k], force)))
