"""Points of a sphere, a capsule or an ellipsoid and another convex shape, where they are nearest to each other.

Of a sphere and a capsule a point or a segment with a radius touches. Its depth at a point is the radius less the signed distance of that
point from the other shape (`nivel.kernels.forces.surface_distance`). The force is along the gradient of that distance, so it has a
potential. A capsule touches with its deepest point, and, where the other shape has straight or flat sides, with that end which is less
deep: then it lies on a side with both ends, and both forces are continuous whatever it does. Where a part of it is beyond a side, its end
is the last place over that side, less deep by up to a radius where it is nearer than that to the other end: so two points become one as the
side is left.

An ellipsoid touches a plane, another convex shape or another ellipsoid at one point, as deep as `nivel.kernels.forces.ellipsoid_distance`
has it, in the middle of the overlap. There a sphere and a capsule are a point and a segment with a radius, a plane is a polytope of one
face.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, minus, plus
from nivel.kernels.forces.contact_law import (
    COUNT,
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    POINT,
    RADIUS,
    SPEED,
    begin_contact,
    is_apart,
    needs_speed,
    note_mean_speed,
    note_speed,
    press,
    report_contact,
    seen,
    velocity_at,
)
from nivel.kernels.forces.ellipsoid_distance import between_ellipsoids, from_polytope
from nivel.kernels.forces.surface_distance import BOX, CYLINDER, HULL, SEGMENT, nearest_of_segment, surface_distance
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# numbers of the pair; SWAPPED: 1 where the round body is the second one; BALL, HALF: its radius and half length; CORE: radius of the other
# capsule; SHAPE: kind of the other body, then its numbers. The RADIUS of the contact is the sum of those of balls about both markers.
SWAPPED, BALL, HALF, CORE, SHAPE, NUMBERS_OF_SHAPE = 0, 1, 2, 3, 4, 5
# numbers of a pair with an ellipsoid, behind SWAPPED; SEMI_AXES: of it; OTHER_KIND: of the other one; OTHER_CORE: its radius around what
# its numbers are of. The RADIUS of one on a plane is without bounds.
SEMI_AXES, OTHER_KIND, OTHER_CORE, NUMBERS_OF_OTHER = 1, 4, 5, 6
POLYTOPE, ELLIPSOID = 0, 1
# Bodies are far from each other where their balls are apart by this share of the radii.
FAR = 0.25
# Ends that are as deep, by this share of the radius, are equally deep; an axis turns along a side where its direction has less across.
EQUAL, ALONG = 1e-9, 1e-12


@stage
def is_far(machine, k):
    """Whether the balls around both bodies are far from each other: then their distance stands for that of all points."""
    record = record_at(machine)
    markers, columns, reach = record.markers, record.elements.columns[k], record.elements.number[k, RADIUS]
    i, j = columns[MARKER], columns[OTHER]
    d = minus(markers.r[i], markers.r[j])
    squared = dot(d, d)
    if not real(squared) > ((1.0 + FAR) * real(reach)) ** 2:
        return False
    distance = np.sqrt(squared)
    return is_apart(machine, k, distance - reach, -dot(d, minus(markers.rdot[i], markers.rdot[j])) / distance)


@leaf
def clipped(low, high, x, a, limit):
    """The part of [low, high] where |x + t a| ≤ limit; the second is below the first where there is none."""
    if np.abs(real(a)) < ALONG:
        return (low, high) if np.abs(real(x)) <= real(limit) else (high, low)
    s, t = (-limit - x) / a, (limit - x) / a
    if real(s) > real(t):
        s, t = t, s
    return s if real(s) > real(low) else low, t if real(t) < real(high) else high


@leaf
def below(low, high, x, a, limit):
    """The part of [low, high] where x + t a ≤ limit."""
    if np.abs(real(a)) < ALONG:
        return (low, high) if real(x) <= real(limit) else (high, low)
    s = (limit - x) / a
    if real(a) > 0.0:
        return low, s if real(s) < real(high) else high
    return s if real(s) > real(low) else low, high


@leaf
def within_circle(low, high, x, a, radius):
    """The part of [low, high] where x + t a is nearer to the z axis than the radius."""
    square, half = a[0] * a[0] + a[1] * a[1], x[0] * a[0] + x[1] * a[1]
    over = x[0] * x[0] + x[1] * x[1] - radius * radius
    if real(square) < ALONG:
        return (low, high) if real(over) <= 0.0 else (high, low)
    inside = half * half - square * over
    if real(inside) <= 0.0:
        return high, low
    root = np.sqrt(inside)
    s, t = (-half - root) / square, (-half + root) / square
    return s if real(s) > real(low) else low, t if real(t) < real(high) else high


@leaf
def over_face(low, high, x, a, g, n):
    """The part of [low, high] where x + t a, along the normal of that face of a hull which looks most towards g, is over this face."""
    faces, first = np.int64(real(n[1])), 3 + 3 * np.int64(real(n[0]))
    best, most = first, -np.inf
    for k in range(faces):
        p = first + 4 * k
        towards = real(g[0]) * real(n[p]) + real(g[1]) * real(n[p + 1]) + real(g[2]) * real(n[p + 2])
        if towards > most:
            best, most = p, towards
    m = n[best], n[best + 1], n[best + 2]
    height, rise = dot(m, x) - n[best + 3], dot(m, a)
    for k in range(faces):
        p = first + 4 * k
        f = n[p], n[p + 1], n[p + 2]
        cosine = dot(f, m)
        if real(cosine) < 1.0 - ALONG and real(low) <= real(high):
            low, high = below(low, high, dot(f, x) - height * cosine, dot(f, a) - rise * cosine, n[p + 3])
    return low, high


@leaf
def ends_over_side(kind, x, a, half, n, t):
    """The part of the segment x + t a that is over the side of the shape above which its point t is."""
    low, high = -half + 0.0 * x[0], half + 0.0 * x[0]
    if kind == SEGMENT:
        return clipped(low, high, x[2], a[2], n[0])
    _, g0, g1, g2 = surface_distance(kind, (x[0] + t * a[0], x[1] + t * a[1], x[2] + t * a[2]), n)
    if kind == CYLINDER:
        if real(g2) * real(g2) >= 0.5:
            return within_circle(low, high, x, a, n[0])
        return clipped(low, high, x[2], a[2], n[1])
    if kind == HULL:
        return over_face(low, high, x, a, (g0, g1, g2), n)
    if kind == BOX:
        u, v, w = np.abs(real(g0)), np.abs(real(g1)), np.abs(real(g2))
        if u < v or u < w:
            low, high = clipped(low, high, x[0], a[0], n[0])
        if v <= u or v < w:
            low, high = clipped(low, high, x[1], a[1], n[1])
        if w <= u or w <= v:
            low, high = clipped(low, high, x[2], a[2], n[2])
    return low, high


@leaf
def other_end(kind, x, a, half, n, t, radius):
    """(place on the segment x + t a of the end that is less deep, by how much it counts as less deep still), where t is deepest."""
    low, high = ends_over_side(kind, x, a, half, n, t)
    length = high - low
    if real(length) < 0.0:
        length = 0.0 * length
    less = 0.0 * length
    if real(length) < real(radius):
        share = 1.0 - length / radius
        less = radius * share * share
    up = surface_distance(kind, (x[0] + high * a[0], x[1] + high * a[1], x[2] + high * a[2]), n)[0]
    down = surface_distance(kind, (x[0] + low * a[0], x[1] + low * a[1], x[2] + low * a[2]), n)[0]
    takes_high = real(up) > real(down)
    if np.abs(real(up) - real(down)) <= EQUAL * real(radius):
        takes_high = real(high) - real(t) > real(t) - real(low)
    return high if takes_high else low, less


@stage
def ends_of(machine, k):
    """(marker of the round body, marker of the other one, 1 or -1 where the round body is the second one) of contact k."""
    elements = record_at(machine).elements
    i, j = np.int64(elements.columns[k, MARKER]), np.int64(elements.columns[k, OTHER])
    return (j, i, -1.0) if real(elements.number[k, NUMBERS + SWAPPED]) == 1.0 else (i, j, 1.0)


@stage
def note_place(machine, k, j, y, g, sign):
    """Leave in the numbers of contact k the point y and the normal g, in axes of marker j, which is turned by `sign`."""
    record = record_at(machine)
    A, r, numbers = record.markers.A[j], record.markers.r[j], record.elements.number[k]
    for a in range(3):
        numbers[POINT + a] = r[a] + A[a, 0] * y[0] + A[a, 1] * y[1] + A[a, 2] * y[2]
        numbers[NORMAL + a] = sign * (A[a, 0] * g[0] + A[a, 1] * g[1] + A[a, 2] * g[2])


@stage
def find_round_point(machine, k, n):
    """Where point n of contact k may touch and the normal there, left in the numbers; returns the overlap."""
    record = record_at(machine)
    markers, more = record.markers, record.elements.number[k, NUMBERS:]
    i, j, sign = ends_of(machine, k)
    kind, shape, half = np.int64(real(more[SHAPE])), more[NUMBERS_OF_SHAPE:], more[HALF]
    A = markers.A[j]
    x, a = seen(A, minus(markers.r[i], markers.r[j])), seen(A, axis(markers.A[i], 2))
    t, less = nearest_of_segment(kind, x, a, half, shape), 0.0 * half
    if n == 1:
        t, less = other_end(kind, x, a, half, shape, t, more[BALL])
    y = x[0] + t * a[0], x[1] + t * a[1], x[2] + t * a[2]
    distance, g0, g1, g2 = surface_distance(kind, y, shape)
    depth = more[BALL] + more[CORE] - less - distance
    # in the middle of the overlap
    below = more[BALL] - 0.5 * depth
    y = y[0] - below * g0, y[1] - below * g1, y[2] - below * g2
    note_place(machine, k, j, y, (g0, g1, g2), sign)
    return depth


@family
def apply(machine, number, t):
    """All contacts of a round body with another one."""
    elements = record_at(machine).elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        begin_contact(machine, k, t)
        if not is_far(machine, k):
            for m in range(elements.columns[k, COUNT]):
                # the deepest point last: its normal is that of the contact
                n = np.int64(elements.columns[k, COUNT]) - 1 - m
                depth = find_round_point(machine, k, n)
                if needs_speed(machine, k, n, depth):
                    note_mean_speed(machine, k)
                press(machine, k, n, depth, t)
        report_contact(machine, k)
    return OK


@stage
def between(A, B):
    """Aᵀ B of two frames (9,), by rows."""
    x, y, z = seen(A, axis(B, 0)), seen(A, axis(B, 1)), seen(A, axis(B, 2))
    return x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]


@stage
def find_point_of_ellipsoid(machine, k):
    """Where contact k may touch and the normal there, left in the numbers; returns (depth, 1 where the other body touches with a face)."""
    record = record_at(machine)
    markers, more = record.markers, record.elements.number[k, NUMBERS:]
    i, j, sign = ends_of(machine, k)
    A, a, shape = markers.A[j], more[SEMI_AXES:OTHER_KIND], more[NUMBERS_OF_OTHER:]
    c, B = seen(A, minus(markers.r[i], markers.r[j])), between(A, markers.A[i])
    if np.int64(real(more[OTHER_KIND])) == ELLIPSOID:
        o = 0.0 * c[0]
        upright = o + 1.0, o, o, o, o + 1.0, o, o, o, o + 1.0
        d, g0, g1, g2, y0, y1, y2 = between_ellipsoids(B, a, upright, shape, (-c[0], -c[1], -c[2]))
        on_face = 0.0
    else:
        d, g0, g1, g2, y0, y1, y2, on_face = from_polytope(shape, c, B, a)
    depth = more[OTHER_CORE] - d
    # in the middle of the overlap, from the point of the core on towards the ellipsoid
    below = 0.5 * depth - more[OTHER_CORE]
    note_place(machine, k, j, (y0 + below * g0, y1 + below * g1, y2 + below * g2), (g0, g1, g2), -sign)
    return depth, on_face


@stage
def speed_of_support(machine, k):
    """Velocity of the point itself where the ellipsoid of contact k rolls on a face.

    x = S² g/|S g| in axes of the ellipsoid, g = Bᵀ n, ġ = Bᵀ (Ω - ω) × n.
    """
    record = record_at(machine)
    markers, bodies, numbers = record.markers, record.bodies, record.elements.number[k]
    i, j, sign = ends_of(machine, k)
    p, normal, B, a = numbers[POINT:NORMAL], numbers[NORMAL:SPEED], markers.A[i], numbers[NUMBERS + SEMI_AXES :]
    n = -sign * normal[0], -sign * normal[1], -sign * normal[2]
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
def apply_to_ellipsoids(machine, number, t):
    """All contacts of an ellipsoid."""
    elements = record_at(machine).elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        begin_contact(machine, k, t)
        if not is_far(machine, k):
            depth, on_face = find_point_of_ellipsoid(machine, k)
            if needs_speed(machine, k, 0, depth):
                if on_face == 1.0:
                    note_speed(machine, k, speed_of_support(machine, k))
                else:
                    note_mean_speed(machine, k)
            press(machine, k, 0, depth, t)
        report_contact(machine, k)
    return OK
