"""Contact of an ellipsoid with a plane, with another convex body or with another ellipsoid, at one point.

The depth is that of `nivel.kernels.forces.ellipsoid_distance`, the force is along its gradient, in the middle of the overlap, so it has a
potential. A sphere and a capsule are a point and a segment with a radius, a plane is a polytope of one face.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, minus, plus
from nivel.kernels.forces.contact import (
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    PATCH,
    POINT,
    SUMS,
    begin_contact,
    press,
    report_contact,
    velocity_at,
)
from nivel.kernels.forces.ellipsoid_distance import between_ellipsoids, from_polytope
from nivel.kernels.forces.round_contact import is_far, seen
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# numbers behind those of `nivel.kernels.forces.contact`; SWAPPED: 1 where the ellipsoid is the second body; SEMI_AXES: of it; BALL: as
# `nivel.kernels.forces.round_contact` has it, without bounds for a plane; KIND: of the other one; CORE: its radius around what its
# numbers are of
SWAPPED, SEMI_AXES, BALL, KIND, CORE, NUMBERS_OF_SHAPE = 0, 1, 4, 5, 6, 7
POLYTOPE, ELLIPSOID = 0, 1


@stage
def between(A, B):
    """Aᵀ B of two frames (9,), by rows."""
    a, b, c = axis(A, 0), axis(A, 1), axis(A, 2)
    x, y, z = axis(B, 0), axis(B, 1), axis(B, 2)
    return dot(a, x), dot(a, y), dot(a, z), dot(b, x), dot(b, y), dot(b, z), dot(c, x), dot(c, y), dot(c, z)


@stage
def find_point_of_ellipsoid(machine, k):
    """Where contact k may touch and the normal there, left in the numbers; returns (depth, its rate, 1 where the other body touches with a
    face)."""
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    columns, numbers = record.elements.columns[k], record.elements.number[k]
    more = numbers[NUMBERS:]
    is_swapped = real(more[SWAPPED]) == 1.0
    i, j = (columns[OTHER], columns[MARKER]) if is_swapped else (columns[MARKER], columns[OTHER])
    A, r, a, shape = markers.A[j], markers.r[j], more[SEMI_AXES:BALL], more[NUMBERS_OF_SHAPE:]
    c, B = seen(A, minus(markers.r[i], r)), between(A, markers.A[i])
    if np.int64(real(more[KIND])) == ELLIPSOID:
        o = 0.0 * c[0]
        upright = o + 1.0, o, o, o, o + 1.0, o, o, o, o + 1.0
        d, g0, g1, g2, y0, y1, y2 = between_ellipsoids(B, a, upright, shape, (-c[0], -c[1], -c[2]))
        on_face = 0.0
    else:
        d, g0, g1, g2, y0, y1, y2, on_face = from_polytope(shape, c, B, a)
    depth = more[CORE] - d
    # in the middle of the overlap, from the point of the core on towards the ellipsoid
    below = 0.5 * depth - more[CORE]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:SUMS]
    sign = 1.0 if is_swapped else -1.0
    for b in range(3):
        along = A[b, 0] * g0 + A[b, 1] * g1 + A[b, 2] * g2
        p[b] = r[b] + A[b, 0] * y0 + A[b, 1] * y1 + A[b, 2] * y2 + below * along
        normal[b] = sign * along
    v = velocity_at(bodies, markers.body[columns[MARKER]], p)
    u = velocity_at(bodies, markers.body[columns[OTHER]], p)
    return depth, -dot(normal, minus(v, u)), on_face


@stage
def velocity_of_support(machine, k):
    """Velocity with which the point of number[POINT:] itself moves where the ellipsoid rolls on a face.

    x = S² g/|S g| in axes of the ellipsoid, g = Bᵀ n, ġ = Bᵀ (Ω - ω) × n.
    """
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    columns, numbers = record.elements.columns[k], record.elements.number[k]
    more = numbers[NUMBERS:]
    is_swapped = real(more[SWAPPED]) == 1.0
    i, j = (columns[OTHER], columns[MARKER]) if is_swapped else (columns[MARKER], columns[OTHER])
    p, normal, B, a = numbers[POINT:NORMAL], numbers[NORMAL:SUMS], markers.A[i], more[SEMI_AXES:BALL]
    sign = 1.0 if is_swapped else -1.0
    n = sign * normal[0], sign * normal[1], sign * normal[2]
    turning = cross(minus(bodies.omega[markers.body[j]], bodies.omega[markers.body[i]]), n)
    square, along = 0.0 * n[0], 0.0 * n[0]
    for b in range(3):
        g = dot(axis(B, b), n)
        square += a[b] * a[b] * g * g
        along += a[b] * a[b] * g * dot(axis(B, b), turning)
    h = np.sqrt(square)
    v = velocity_at(bodies, markers.body[i], p)
    for b in range(3):
        share = a[b] * a[b] * (dot(axis(B, b), turning) - dot(axis(B, b), n) * along / square) / h
        v = plus(v, (share * B[0, b], share * B[1, b], share * B[2, b]))
    return v


@family
def apply(machine, number, t):
    """All contacts of an ellipsoid."""
    elements = record_at(machine).elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        begin_contact(machine, k, t)
        if not is_far(machine, k):
            depth, rate, on_face = find_point_of_ellipsoid(machine, k)
            press(machine, k, 0, depth, rate, t)
            numbers = elements.number[k]
            if elements.columns[k, PATCH] != NONE and on_face == 1.0:
                v = velocity_of_support(machine, k)
                for a in range(3):
                    numbers[SUMS + 5 + a] = numbers[SUMS] * v[a]
        report_contact(machine, k)
    return OK
