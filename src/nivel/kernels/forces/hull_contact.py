"""Contact of two convex hulls: one force at the pressure centre, along the direction in which they overlap least.

The overlap is the least of those along the normals of all faces, and along the common normals of all pairs of edges that are a face of
the Minkowski difference (separating axes; test of the pairs by arcs on the Gauss map, Gregorius 2013). Against a face, the nearest
face of the other hull is clipped by it (Sutherland & Hodgman 1974), and the force acts at the centre of the overlap over that polygon,
so it moves as bodies rock; at edges that cross it acts between them. Its size is that of `nivel.kernels.forces.impact` at the overlap.

Such a force has no potential where bodies rock: its work counts as external work.

Numbers behind those of `contact`: HEADER of two hulls, their blocks, two polygons. Of each hull: counts of corners, faces and edges;
places of corners (3 each), faces (normal, first, count), corners of faces, edges (begin, end, face to the left, to the right), and of
the corners in global axes, which are work.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import maximum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.forces.contact import (
    DEPTH,
    EXPONENT,
    FORCE,
    FRICTION,
    LAW,
    LOSS,
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    OUTPUT,
    POINT,
    RATE,
    STIFFNESS,
    TRANSITION,
    approach,
    law_force,
    velocity_at,
)
from nivel.kernels.forces.impact import impact
from nivel.kernels.forces.wrench import add_force_at
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# of each hull, behind NUMBERS
CORNERS, FACES, EDGES, AT_CORNERS, AT_FACES, AT_LISTS, AT_EDGES, AT_PLACED = 0, 1, 2, 3, 4, 5, 6, 7
OF_HULL, OF_FACE, OF_EDGE = 8, 5, 4
POLYGONS, HEADER = 2 * OF_HULL, 2 * OF_HULL + 2
# what the bodies overlap along: a face of the first, a face of the second, two edges
FIRST_FACE, SECOND_FACE, CROSSED = 0, 1, 2
# an edge counts where it overlaps less than all faces by this share of the overlap
CLEARLY = 1e-6
# sines of edges below this are parallel, areas below this share of the square of the overlap are none
PARALLEL, NO_AREA = 1e-9, 1e-12


@leaf
def whole(x):
    """A number that is an index."""
    return np.int64(real(x))


@leaf
def fact(n, hull, which):
    """A count or place of a hull."""
    return whole(n[NUMBERS + OF_HULL * hull + which])


@leaf
def triple(n, first):
    """Three numbers, as a tuple."""
    return n[first], n[first + 1], n[first + 2]


@leaf
def placed(n, hull, corner):
    """A corner in global axes."""
    return triple(n, fact(n, hull, AT_PLACED) + 3 * corner)


@leaf
def less(a, b):
    """a - b of 3-vectors."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@leaf
def turned(A, u):
    """A u."""
    return (
        A[0, 0] * u[0] + A[0, 1] * u[1] + A[0, 2] * u[2],
        A[1, 0] * u[0] + A[1, 1] * u[1] + A[1, 2] * u[2],
        A[2, 0] * u[0] + A[2, 1] * u[1] + A[2, 2] * u[2],
    )


@leaf
def normal_of(n, hull, A, face):
    """The outward normal of a face in global axes."""
    return turned(A, triple(n, fact(n, hull, AT_FACES) + OF_FACE * face))


@leaf
def corner_of(n, hull, face, k):
    """Number of corner k of a face."""
    first = whole(n[fact(n, hull, AT_FACES) + OF_FACE * face + 3])
    return whole(n[fact(n, hull, AT_LISTS) + first + k])


@leaf
def corner_count(n, hull, face):
    return whole(n[fact(n, hull, AT_FACES) + OF_FACE * face + 4])


@stage
def place_corners(n, hull, A, r):
    """Corners in global axes."""
    source, target = fact(n, hull, AT_CORNERS), fact(n, hull, AT_PLACED)
    for k in range(fact(n, hull, CORNERS)):
        p = turned(A, triple(n, source + 3 * k))
        for a in range(3):
            n[target + 3 * k + a] = r[a] + p[a]


@stage
def nearest_corner(n, hull, direction):
    """Number of the corner of a hull that lies farthest against a direction."""
    least, found = np.inf, 0
    for k in range(fact(n, hull, CORNERS)):
        along = real(dot(direction, placed(n, hull, k)))
        if along < least:
            least, found = along, k
    return found


@stage
def over_faces(n, hull, A):
    """(gap, face): the largest gap between the other hull and a face of this one, along its normal."""
    best, found = -np.inf, 0
    for face in range(fact(n, hull, FACES)):
        normal = normal_of(n, hull, A, face)
        on = placed(n, hull, corner_of(n, hull, face, 0))
        gap = real(dot(normal, less(placed(n, 1 - hull, nearest_corner(n, 1 - hull, normal)), on)))
        if gap > best:
            best, found = gap, face
    return best, found


@stage
def edge_of(n, hull, A, e):
    """(begin, direction, normal to the left, normal to the right) of an edge."""
    at = fact(n, hull, AT_EDGES) + OF_EDGE * e
    begin, end = placed(n, hull, whole(n[at])), placed(n, hull, whole(n[at + 1]))
    return begin, less(end, begin), normal_of(n, hull, A, whole(n[at + 2])), normal_of(n, hull, A, whole(n[at + 3]))


@stage
def common_normal(n, A, B, e, f):
    """(whether the edges e and f are a face of the Minkowski difference, normal from the first hull to the second, gap)."""
    p, d, a, b = edge_of(n, 0, A, e)
    q, g, c, h = edge_of(n, 1, B, f)
    ba, hc = cross(b, a), cross(h, c)
    # arcs a b and -c -h on the unit sphere
    cba, hba, ahc, bhc = -real(dot(c, ba)), -real(dot(h, ba)), real(dot(a, hc)), real(dot(b, hc))
    crossing = cross(d, g)
    length = np.sqrt(dot(crossing, crossing))
    scale = np.sqrt(real(dot(d, d)) * real(dot(g, g)))
    if cba * hba >= 0.0 or ahc * bhc >= 0.0 or cba * bhc <= 0.0 or real(length) < PARALLEL * scale:
        return False, a, 0.0 * length
    sign = 1.0 / length if real(dot(crossing, (a[0] + b[0], a[1] + b[1], a[2] + b[2]))) > 0.0 else -1.0 / length
    normal = (sign * crossing[0], sign * crossing[1], sign * crossing[2])
    return True, normal, dot(normal, less(q, p))


@stage
def over_edges(n, A, B, least):
    """(gap, first edge, second edge): the largest gap along a common normal of two edges, if above `least`."""
    best, e_best, f_best = least, -1, -1
    for e in range(fact(n, 0, EDGES)):
        for f in range(fact(n, 1, EDGES)):
            is_face, _, gap = common_normal(n, A, B, e, f)
            if is_face and real(gap) > best:
                best, e_best, f_best = real(gap), e, f
    return best, e_best, f_best


@stage
def cut(n, source, count, target, on, inward):
    """Number of corners of the polygon at `target`: what of that at `source` lies beside the plane through `on`, where `inward` points."""
    new = 0
    for k in range(count):
        p, q = triple(n, source + 3 * k), triple(n, source + 3 * ((k + 1) % count))
        x, y = dot(inward, less(p, on)), dot(inward, less(q, on))
        if real(x) >= 0.0:
            for a in range(3):
                n[target + 3 * new + a] = p[a]
            new += 1
        if (real(x) >= 0.0) != (real(y) >= 0.0):
            share = x / (x - y)
            for a in range(3):
                n[target + 3 * new + a] = p[a] + share * (q[a] - p[a])
            new += 1
    return new


@stage
def pressure_centre(n, source, count, on, normal, depth, p):
    """p := centre of the overlap under the plane through `on` over a polygon; False where it has no area."""
    total, area = 0.0 * depth, 0.0 * depth
    sums = (total, total, total)
    first = triple(n, source)
    for k in range(1, count - 1):
        second, third = triple(n, source + 3 * k), triple(n, source + 3 * (k + 1))
        size = 0.5 * dot(normal, cross(less(second, first), less(third, first)))
        size = size if real(size) > 0.0 else -size
        u, v, w = -dot(normal, less(first, on)), -dot(normal, less(second, on)), -dot(normal, less(third, on))
        # ∫ x y dA = A/12 (Σ x Σ y + Σ x y) over a triangle of linear x, y
        total += size * (u + v + w) / 3.0
        area += size
        s = u + v + w
        sums = (
            sums[0] + size / 12.0 * (s * (first[0] + second[0] + third[0]) + u * first[0] + v * second[0] + w * third[0]),
            sums[1] + size / 12.0 * (s * (first[1] + second[1] + third[1]) + u * first[1] + v * second[1] + w * third[1]),
            sums[2] + size / 12.0 * (s * (first[2] + second[2] + third[2]) + u * first[2] + v * second[2] + w * third[2]),
        )
    if real(area) <= NO_AREA * real(depth) * real(depth) or real(total) <= 0.0:
        return False
    for a in range(3):
        p[a] = sums[a] / total
    return True


@stage
def against_face(n, hull, face, A, B, p, normal):
    """Overlap of the other hull with a face of this one; p, normal := pressure centre, normal from the second hull to the first.

    A, B : axes of this hull and the other one.
    """
    out = normal_of(n, hull, A, face)
    on = placed(n, hull, corner_of(n, hull, face, 0))
    deepest = placed(n, 1 - hull, nearest_corner(n, 1 - hull, out))
    depth = -dot(out, less(deepest, on))
    facing, least = 0, np.inf
    for f in range(fact(n, 1 - hull, FACES)):
        along = real(dot(out, normal_of(n, 1 - hull, B, f)))
        if along < least:
            least, facing = along, f
    here, there = whole(n[NUMBERS + POLYGONS]), whole(n[NUMBERS + POLYGONS + 1])
    count = corner_count(n, 1 - hull, facing)
    for k in range(count):
        corner = placed(n, 1 - hull, corner_of(n, 1 - hull, facing, k))
        for a in range(3):
            n[here + 3 * k + a] = corner[a]
    sides = corner_count(n, hull, face)
    for k in range(sides + 1):
        if k < sides:
            begin = placed(n, hull, corner_of(n, hull, face, k))
            inward = cross(out, less(placed(n, hull, corner_of(n, hull, face, (k + 1) % sides)), begin))
        else:
            begin, inward = on, (-out[0], -out[1], -out[2])
        count = cut(n, here, count, there, begin, inward)
        here, there = there, here
    if count < 3 or not pressure_centre(n, here, count, on, out, depth, p):
        for a in range(3):
            p[a] = deepest[a]
    above = 0.5 * dot(out, less(on, (p[0], p[1], p[2])))
    sign = -1.0 if hull == 0 else 1.0
    for a in range(3):
        p[a] += above * out[a]
        normal[a] = sign * out[a]
    return depth


@stage
def at_edges(n, A, B, e, f, p, normal):
    """Overlap of two crossing edges; p := the point between them."""
    _, common, gap = common_normal(n, A, B, e, f)
    begin, d, _, _ = edge_of(n, 0, A, e)
    other, g, _, _ = edge_of(n, 1, B, f)
    # nearest points begin + x d, other + y g
    apart = less(other, begin)
    dd, dg, gg, da, ga = dot(d, d), dot(d, g), dot(g, g), dot(d, apart), dot(g, apart)
    determinant = dd * gg - dg * dg
    x, y = (da * gg - ga * dg) / determinant, (da * dg - ga * dd) / determinant
    for a in range(3):
        p[a] = 0.5 * (begin[a] + x * d[a] + other[a] + y * g[a])
        normal[a] = -common[a]
    return -gap


@stage
def find_overlap(machine, k):
    """The overlap of contact k, negative while the hulls are apart; its point and normal are left in the numbers."""
    record = record_at(machine)
    markers, n = record.markers, record.elements.number[k]
    i, j = record.elements.columns[k, MARKER], record.elements.columns[k, OTHER]
    A, B = markers.A[i], markers.A[j]
    place_corners(n, 0, A, markers.r[i])
    place_corners(n, 1, B, markers.r[j])
    p, normal = n[POINT:NORMAL], n[NORMAL:NUMBERS]
    first, face = over_faces(n, 0, A)
    second, other_face = over_faces(n, 1, B)
    kind, gap = (FIRST_FACE, first) if first >= second else (SECOND_FACE, second)
    e, f = -1, -1
    if gap < 0.0:
        _, e, f = over_edges(n, A, B, gap - CLEARLY * gap)
    if e >= 0:
        kind = CROSSED
    if kind == CROSSED:
        depth = at_edges(n, A, B, e, f, p, normal)
    elif kind == FIRST_FACE:
        depth = against_face(n, 0, face, A, B, p, normal)
    else:
        depth = against_face(n, 1, other_face, B, A, p, normal)
    return depth


@stage
def press(machine, k, depth, rate, t):
    """Forces at the point of the numbers; returns (N, friction, power)."""
    record = record_at(machine)
    bodies, markers, elements, control = record.bodies, record.markers, record.elements, record.control
    numbers = elements.number[k]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:NUMBERS]
    this, other = markers.body[elements.columns[k, MARKER]], markers.body[elements.columns[k, OTHER]]
    if elements.columns[k, LAW] != NONE:
        force = law_force(machine, k, depth, rate, t)
        elements.proposal[k, 0] = 0.0 * force + (1.0 if real(depth) > 0.0 else 0.0)
    else:
        force, _, _, elements.proposal[k, 0] = impact(
            depth,
            rate,
            numbers[STIFFNESS],
            numbers[EXPONENT],
            numbers[LOSS],
            elements.memory[k, 0],
            record.watched.followed[0],
        )
    control.power[0] -= force * rate
    v0, v1, v2 = velocity_at(bodies, this, p)
    u0, u1, u2 = velocity_at(bodies, other, p)
    s0, s1, s2 = v0 - u0 + rate * normal[0], v1 - u1 + rate * normal[1], v2 - u2 + rate * normal[2]
    speed = np.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
    friction, drag = 0.0 * force, 0.0 * force
    if real(numbers[FRICTION]) > 0.0 and real(speed) > 0.0:
        friction = numbers[FRICTION] * maximum(force, 0.0 * force) * tanh(speed / numbers[TRANSITION])
        control.power[1] += friction * speed
        drag = friction / speed
    x, y, z = force * normal[0] - drag * s0, force * normal[1] - drag * s1, force * normal[2] - drag * s2
    power = add_force_at(bodies, this, p, x, y, z)
    power += add_force_at(bodies, other, p, -x, -y, -z)
    return force, friction, power


@family
def apply(machine, number, t):
    """All contacts of two hulls."""
    record = record_at(machine)
    elements, followed, out = record.elements, record.watched.followed[0], record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        depth = find_overlap(machine, k)
        rate = approach(machine, k)
        elements.depth[k, 0] = depth
        if followed == 1:
            elements.depth_rate[k, 0] = rate
        force, friction, power = 0.0 * depth, 0.0 * depth, 0.0 * depth
        if real(depth) > 0.0 or (followed == 1 and elements.memory[k, 0] > 0.0):
            force, friction, power = press(machine, k, depth, rate, t)
        else:
            elements.proposal[k, 0] = 0.0
        first = elements.columns[k, OUTPUT]
        out[first] = np.sqrt(force * force + friction * friction)
        out[first + 1], out[first + DEPTH], out[first + FORCE], out[first + RATE] = power, depth, force, rate
    return OK
