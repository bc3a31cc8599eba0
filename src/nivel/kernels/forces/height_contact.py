"""Contact of a body with ground whose height varies, at points of the body: balls of a sphere or a capsule, corners, points of rims.

Each point has the force of `nivel.kernels.forces.contact` along the normal of the nearest place of the ground. Friction is across the mean
of these normals, weighted by the forces.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, minus
from nivel.kernels.forces.contact import (
    BOX,
    CAPSULE,
    COUNT,
    CYLINDER,
    DEEPEST,
    FAR,
    HULL,
    ITS_RATE,
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    POINT,
    RADIUS,
    SIZE,
    SUMS,
    approach,
    begin_contact,
    corner,
    hull_corner,
    press,
    report_contact,
    rim_point,
)
from nivel.kernels.forces.height_field import HIGHEST, from_heights, surface
from nivel.kernels.forces.round_contact import seen
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import stage

# numbers behind those of `nivel.kernels.forces.contact`; KIND: of the points, as it has them; CORNERS: where those of a hull begin, among
# the numbers of the ground; BALL: radius of the balls, 0 of points. Work of `nivel.kernels.forces.height_way`: END: a pose, MISSED: the
# deepest overlap [m] that fixed steps have passed, MISSED_AT [s], and SEEN: the deepest at their ends
KIND, CORNERS, BALL, END, MISSED, MISSED_AT, SEEN, GROUND = 0, 1, 2, 3, 21, 22, 23, 24


@stage
def is_above(machine, k):
    """Whether the ball around the shape is far above all heights, and was: then its distance stands for that of all points."""
    record = record_at(machine)
    markers, elements, followed = record.markers, record.elements, record.watched.followed[0]
    columns, numbers = elements.columns[k], elements.number[k]
    i, j, radius = columns[MARKER], columns[OTHER], numbers[RADIUS]
    n, d = axis(markers.A[j], 2), minus(markers.r[i], markers.r[j])
    gap = dot(n, d) - radius - numbers[NUMBERS + GROUND + HIGHEST]
    if not real(gap) > FAR * real(radius):
        return False
    if followed == 1:
        for m in range(columns[COUNT]):
            if elements.memory[k, m] > 0.0:
                return False
    speed = minus(minus(markers.rdot[i], markers.rdot[j]), cross(record.bodies.omega[markers.body[j]], d))
    numbers[DEEPEST], numbers[ITS_RATE] = -gap, -dot(n, speed)
    for m in range(columns[COUNT]):
        elements.depth[k, m], elements.proposal[k, m] = -gap, 0.0 * gap
        if followed == 1:
            elements.depth_rate[k, m] = numbers[ITS_RATE]
    return True


@stage
def find_point_over_ground(machine, k, n):
    """Where point n of contact k may touch and the normal there, left in the numbers; returns the overlap."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    more = numbers[NUMBERS:]
    i, j, kind, ground = columns[MARKER], columns[OTHER], np.int64(real(more[KIND])), more[GROUND:]
    p, normal, size = numbers[POINT:NORMAL], numbers[NORMAL:SUMS], numbers[SIZE:RADIUS]
    r, A, o, B = markers.r[i], markers.A[i], markers.r[j], markers.A[j]
    for a in range(3):
        p[a] = r[a]
    if kind == BOX:
        corner(A, r, size, n, p)
    elif kind == HULL:
        hull_corner(A, r, ground[np.int64(real(more[CORNERS])) :], n, p)
    elif kind == CAPSULE:
        z = size[1] if n == 0 else -size[1]
        for a in range(3):
            p[a] += z * A[a, 2]
    elif kind == CYLINDER:
        # the rim is lowest against the normal below its middle
        z = size[1] if n < 4 else -size[1]
        c = seen(B, (r[0] + z * A[0, 2] - o[0], r[1] + z * A[1, 2] - o[1], r[2] + z * A[2, 2] - o[2]))
        _, hx, hy, _, _, _ = surface(ground, c[0], c[1])
        length = np.sqrt(1.0 + hx * hx + hy * hy)
        for a in range(3):
            normal[a] = (B[a, 2] - hx * B[a, 0] - hy * B[a, 1]) / length
        rim_point(A, r, size, n, normal, p)
    distance, n0, n1, n2, _, _, _ = from_heights(ground, seen(B, minus(p, o)))
    for a in range(3):
        normal[a] = B[a, 0] * n0 + B[a, 1] * n1 + B[a, 2] * n2
    if real(more[BALL]) > 0.0:
        # the force acts on the ground
        for a in range(3):
            p[a] -= distance * normal[a]
    return more[BALL] - distance


@family
def apply(machine, number, t):
    """All contacts with ground whose height varies."""
    elements = record_at(machine).elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        begin_contact(machine, k, t)
        if not is_above(machine, k):
            numbers = elements.number[k]
            o = 0.0 * numbers[SUMS]
            x, y, z = o, o, o
            for n in range(elements.columns[k, COUNT]):
                depth = find_point_over_ground(machine, k, n)
                before = numbers[SUMS]
                press(machine, k, n, depth, approach(machine, k), t)
                force = numbers[SUMS] - before
                x, y, z = x + force * numbers[NORMAL], y + force * numbers[NORMAL + 1], z + force * numbers[NORMAL + 2]
            squared = x * x + y * y + z * z
            if real(squared) > 0.0:
                size = np.sqrt(squared)
                numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2] = x / size, y / size, z / size
        report_contact(machine, k)
    return OK
