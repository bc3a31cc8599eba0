"""Contact of a sphere or a capsule with another convex shape, at the points that are nearest to each other.

What touches is a segment, or a point, with a radius. Its depth at a point is the radius less the signed distance of that point from the
other shape (`nivel.kernels.forces.surface_distance`). The force is along the gradient of that distance, so it has a potential. A capsule
touches with its deepest point, and, where the other shape has straight or flat sides, with that end which is less deep: then it lies on
a side with both ends, and both forces are continuous whatever it does. Where a part of it is beyond a side, its end is the last place over
that side, less deep by up to a radius where it is nearer than that to the other end: so two points become one as the side is left.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, minus
from nivel.kernels.forces.contact import (
    COUNT,
    DEEPEST,
    ITS_RATE,
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    POINT,
    SUMS,
    begin_contact,
    press,
    report_contact,
    velocity_at,
)
from nivel.kernels.forces.surface_distance import BOX, CYLINDER, HULL, SEGMENT, nearest_of_segment, surface_distance
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# numbers behind those of `nivel.kernels.forces.contact`; SWAPPED: 1 where the round body is the second one; RADIUS, HALF: of it; CORE:
# radius of the other capsule; BALL: sum of radii of balls about both markers; SHAPE: of the other one, then its numbers
SWAPPED, RADIUS, HALF, CORE, BALL, SHAPE, NUMBERS_OF_SHAPE = 0, 1, 2, 3, 4, 5, 6
# Bodies are far from each other where their balls are apart by this share of the radii.
FAR = 0.25
# Ends that are as deep, by this share of the radius, are equally deep; an axis turns along a side where its direction has less across.
EQUAL, ALONG = 1e-9, 1e-12


@stage
def seen(A, d):
    """Aᵀ d."""
    return dot(axis(A, 0), d), dot(axis(A, 1), d), dot(axis(A, 2), d)


@stage
def is_far(machine, k):
    """Whether the balls around both bodies are far from each other, and were: then their distance stands for that of all points."""
    record = record_at(machine)
    markers, elements, followed = record.markers, record.elements, record.watched.followed[0]
    columns, numbers = elements.columns[k], elements.number[k]
    i, j, reach = columns[MARKER], columns[OTHER], numbers[NUMBERS + BALL]
    d = minus(markers.r[i], markers.r[j])
    squared = dot(d, d)
    if not real(squared) > ((1.0 + FAR) * real(reach)) ** 2:
        return False
    if followed == 1:
        for m in range(columns[COUNT]):
            if elements.memory[k, m] > 0.0:
                return False
    distance = np.sqrt(squared)
    gap = distance - reach
    numbers[DEEPEST], numbers[ITS_RATE] = -gap, -dot(d, minus(markers.rdot[i], markers.rdot[j])) / distance
    for m in range(columns[COUNT]):
        elements.depth[k, m], elements.proposal[k, m] = -gap, 0.0 * gap
        if followed == 1:
            elements.depth_rate[k, m] = numbers[ITS_RATE]
    return True


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
def find_round_point(machine, k, n):
    """Where point n of contact k may touch and the normal there, left in the numbers; returns (depth, its rate)."""
    record = record_at(machine)
    markers, bodies, columns, numbers = (
        record.markers,
        record.bodies,
        record.elements.columns[k],
        record.elements.number[k],
    )
    more = numbers[NUMBERS:]
    is_swapped = real(more[SWAPPED]) == 1.0
    i, j = (columns[OTHER], columns[MARKER]) if is_swapped else (columns[MARKER], columns[OTHER])
    kind, shape, half = np.int64(real(more[SHAPE])), more[NUMBERS_OF_SHAPE:], more[HALF]
    A, r = markers.A[j], markers.r[j]
    x, a = seen(A, minus(markers.r[i], r)), seen(A, axis(markers.A[i], 2))
    t, less = nearest_of_segment(kind, x, a, half, shape), 0.0 * half
    if n == 1:
        t, less = other_end(kind, x, a, half, shape, t, more[RADIUS])
    y = x[0] + t * a[0], x[1] + t * a[1], x[2] + t * a[2]
    distance, g0, g1, g2 = surface_distance(kind, y, shape)
    depth = more[RADIUS] + more[CORE] - less - distance
    # in the middle of the overlap
    below = more[RADIUS] - 0.5 * depth
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:SUMS]
    sign = -1.0 if is_swapped else 1.0
    for b in range(3):
        along = A[b, 0] * g0 + A[b, 1] * g1 + A[b, 2] * g2
        p[b] = r[b] + A[b, 0] * y[0] + A[b, 1] * y[1] + A[b, 2] * y[2] - below * along
        normal[b] = sign * along
    v = velocity_at(bodies, markers.body[columns[MARKER]], p)
    u = velocity_at(bodies, markers.body[columns[OTHER]], p)
    return depth, -dot(normal, minus(v, u))


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
                depth, rate = find_round_point(machine, k, n)
                press(machine, k, n, depth, rate, t)
        report_contact(machine, k)
    return OK
