"""The row of numbers of a contact of two convex hulls, and the second hull as seen from the first."""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.elements.moving_surface import NUMBERS as SURFACE_NUMBERS
from nivel.kernels.forces.pressure_cells import bound_cap, nearest_faces, overlap_under
from nivel.native.function import leaf

# columns of `columns`; MARKER, OTHER: axes of the two hulls; counts of their corners and faces; the patch as in
# `nivel.kernels.forces.contact_law`, and the surface; then EDGES of the first hull, two corners each, as many numbers as FIRST_EDGES says,
# and those of the second
OUTPUT, MARKER, OTHER, CORNERS, OTHER_CORNERS, FACES, OTHER_FACES, FIRST_EDGES, SECOND_EDGES = range(9)
PATCH, AXES, COORDINATE, SURFACE, EDGES = 9, 10, 11, 12, 15
# columns of `number`; TRANSITION: 0 where friction is that of a patch. Then work: place of the second hull in axes of the first, velocity
# and angular velocity relative to the first at its origin, sums (normal force and its torque, friction and its torque, or what the patch is
# made of), a box, a plane, the normal of the contact from first to second, velocity of the
# second one's surface over it, the moving surface
FIELD, DAMPING, FRICTION, TRANSITION, RADIUS, OTHER_RADIUS = range(6)
TURN, SHIFT, SPEED, SPIN, PUSH, PUSH_TORQUE, RUB, RUB_TORQUE, BOX, PLANE, NORMAL = (
    6, 15, 18, 21, 24, 27, 30, 33, 36, 42, 54,
)  # fmt: skip
# then the corners of the first hull (3 each), all faces (4 each), those of the second as seen from the first, which is work; corners
# and faces of the second in its own axes; work: its corners as seen from the first, rows of the nearest faces, two polygons
OVER, MOVING = 57, 60
NUMBERS = MOVING + SURFACE_NUMBERS
# The second hull is larger by this share of the sizes, so that of two faces in one plane the nearest is never in doubt.
APART = 1e-13


@leaf
def places(columns):
    """Where the corners of the first hull begin, all faces, corners and faces of the second in its axes, its corners, rows, polygons."""
    first = NUMBERS
    faces = first + 3 * np.int64(columns[CORNERS])
    corners = faces + 4 * (np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES]))
    others = corners + 3 * np.int64(columns[OTHER_CORNERS])
    seen = others + 4 * np.int64(columns[OTHER_FACES])
    rows = seen + 3 * np.int64(columns[OTHER_CORNERS])
    polygons = rows + np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])
    return first, faces, corners, others, seen, rows, polygons


@leaf
def turn(A, x, y, z):
    """A (x, y, z), A (9,) by rows."""
    return (
        A[0] * x + A[1] * y + A[2] * z,
        A[3] * x + A[4] * y + A[5] * z,
        A[6] * x + A[7] * y + A[8] * z,
    )


@leaf
def place_second(columns, n):
    """Corners and faces of the second hull in the axes of the first."""
    _, faces, corners, others, seen, _, _ = places(columns)
    A = n[TURN:SHIFT]
    for k in range(columns[OTHER_CORNERS]):
        p, q = corners + 3 * k, seen + 3 * k
        x, y, z = turn(A, n[p], n[p + 1], n[p + 2])
        n[q], n[q + 1], n[q + 2] = n[SHIFT] + x, n[SHIFT + 1] + y, n[SHIFT + 2] + z
    apart = APART * (n[RADIUS] + n[OTHER_RADIUS])
    for k in range(columns[OTHER_FACES]):
        p, q = others + 4 * k, faces + 4 * (np.int64(columns[FACES]) + k)
        x, y, z = turn(A, n[p], n[p + 1], n[p + 2])
        n[q], n[q + 1], n[q + 2] = x, y, z
        n[q + 3] = n[p + 3] + apart + x * n[SHIFT] + y * n[SHIFT + 1] + z * n[SHIFT + 2]


@leaf
def velocity(n, x, y, z):
    """Velocity relative to the first hull of the point of the second one at (x, y, z)."""
    return (
        n[SPEED] + n[SPIN + 1] * z - n[SPIN + 2] * y,
        n[SPEED + 1] + n[SPIN + 2] * x - n[SPIN] * z,
        n[SPEED + 2] + n[SPIN] * y - n[SPIN + 1] * x,
    )


@leaf
def least_overlap(columns, n):
    """(overlap along the normal of the face under which the other hull is least deep, its rate, the row of that face). Negative: apart."""
    first, faces, _, _, seen, _, _ = places(columns)
    least, face, corner, own = overlap_under(n, faces, seen, columns[OTHER_CORNERS])[0] + np.inf, faces, seen, True
    for k in range(np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])):
        of_first = k < columns[FACES]
        overlap, at = overlap_under(
            n,
            faces + 4 * k,
            seen if of_first else first,
            columns[OTHER_CORNERS] if of_first else columns[CORNERS],
        )
        if real(overlap) < real(least):
            least, face, corner, own = overlap, faces + 4 * k, at, of_first
    v0, v1, v2 = velocity(n, n[corner], n[corner + 1], n[corner + 2])
    rate = n[face] * v0 + n[face + 1] * v1 + n[face + 2] * v2
    return least, -rate if own else rate, face


@leaf
def find_faces(columns, n, face):
    """The box that holds the overlap, and rows of the faces that may be nearest in it, which it returns the number of."""
    first, faces, _, _, seen, rows, _ = places(columns)
    ends, size = EDGES + np.int64(columns[FIRST_EDGES]), real(n[RADIUS]) + real(n[OTHER_RADIUS])
    count = np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])
    if face < faces + 4 * np.int64(columns[FACES]):
        edges = columns[ends : ends + np.int64(columns[SECOND_EDGES])]
        bound_cap(n, face, seen, columns[OTHER_CORNERS], edges, size, n[BOX:PLANE])
    else:
        bound_cap(n, face, first, columns[CORNERS], columns[EDGES:ends], size, n[BOX:PLANE])
    return nearest_faces(n, faces, count, n[BOX:PLANE], n[rows : rows + count])
