"""Points of a sphere or a capsule and another convex shape, where they are nearest to each other.

Of them a point or a segment with a radius touches. Its depth at a point is the radius less the signed distance of that point from the other
shape, in whose axes it is, negative inside. All distances are exact: of boxes and cylinders by their faces and rims, of hulls by faces,
edges and corners in turn; that of a capsule is of its core, a segment. The force is along the gradient of the distance, so it has a
potential. A capsule touches with its deepest point, and, where the other shape has straight or flat sides, with that end which is less
deep: then it lies on a side with both ends, and both forces are continuous whatever it does. Where a part of it is beyond a side, its end
is the last place over that side, less deep by up to a radius where it is nearer than that to the other end: so two points become one as the
side is left.
"""

from collections.abc import Sequence

import numpy as np

from nivel.elements.contacts import law
from nivel.elements.contacts.shapes import ball_of_shape, part_of, polytope_of
from nivel.kernels.algebra.analytic import absolute, real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import axis, minus, plus, put, seen, times, turned
from nivel.kernels.record.record import record_at
from nivel.known import Contact
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import box_size
from nivel.machine.bodies.solids import length as bar_length
from nivel.machine.bodies.touching import Touching
from nivel.native.function import leaf, part, stage

# kinds; numbers: half lengths; radius and half length (axis z); half length of a segment along z; of a hull the counts of
# corners, faces and edges, then corners (3 each), faces (normal and distance, 4 each) and edges (6 each, both ends)
BOX, CYLINDER, SEGMENT, HULL = 0, 1, 2, 3
# A point before a face is before it, by this share of the distance, also where round-off says that it is beyond its edge.
EDGE = 1e-12


@leaf
def sign_of(x):
    """±1, of 0 too."""
    return 1.0 if real(x) >= 0.0 else -1.0


@leaf
def from_box(x, n):
    """(distance, gradient) of a box."""
    q0, q1, q2 = absolute(x[0]) - n[0], absolute(x[1]) - n[1], absolute(x[2]) - n[2]
    s0, s1, s2 = sign_of(x[0]), sign_of(x[1]), sign_of(x[2])
    o = 0.0 * q0
    if real(q0) <= 0.0 and real(q1) <= 0.0 and real(q2) <= 0.0:
        if real(q0) >= real(q1) and real(q0) >= real(q2):
            return q0, o + s0, o, o
        if real(q1) >= real(q2):
            return q1, o, o + s1, o
        return q2, o, o, o + s2
    d0 = q0 if real(q0) > 0.0 else o
    d1 = q1 if real(q1) > 0.0 else o
    d2 = q2 if real(q2) > 0.0 else o
    d = np.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
    return d, s0 * d0 / d, s1 * d1 / d, s2 * d2 / d


@leaf
def from_cylinder(x, n):
    """(distance, gradient) of a cylinder along z."""
    squared = x[0] * x[0] + x[1] * x[1]
    o = 0.0 * squared
    rho = np.sqrt(squared) if real(squared) > 0.0 else o
    c, s = (x[0] / rho, x[1] / rho) if real(rho) > 0.0 else (o + 1.0, o)
    q, p, up = rho - n[0], absolute(x[2]) - n[1], sign_of(x[2])
    if real(q) <= 0.0 and real(p) <= 0.0:
        if real(q) >= real(p):
            return q, c, s, o
        return p, o, o, o + up
    if real(p) <= 0.0:
        return q, c, s, o
    if real(q) <= 0.0:
        return p, o, o, o + up
    d = np.sqrt(q * q + p * p)
    return d, c * q / d, s * q / d, up * p / d


@leaf
def from_segment(x, n):
    """(distance, gradient) of a segment along z."""
    z = x[2]
    if real(z) > real(n[0]):
        z = x[2] - n[0]
    elif real(z) < -real(n[0]):
        z = x[2] + n[0]
    else:
        z = 0.0 * x[2]
    squared = x[0] * x[0] + x[1] * x[1] + z * z
    if real(squared) == 0.0:
        return squared, squared + 1.0, squared, squared  # any direction will do
    d = np.sqrt(squared)
    return d, x[0] / d, x[1] / d, z / d


@leaf
def from_hull(x, n):
    """(distance, gradient) of a convex hull."""
    corners, faces, edges = np.int64(real(n[0])), np.int64(real(n[1])), np.int64(real(n[2]))
    first = 3 + 3 * corners
    best, most = first, -np.inf
    for k in range(faces):
        p = first + 4 * k
        over = real(height_over(x, n, p))
        if over > most:
            best, most = p, over
    d = height_over(x, n, best)
    o = 0.0 * d
    is_before = True
    if real(d) > 0.0:
        y = minus(x, times(d, n[best:]))
        for k in range(faces):
            p = first + 4 * k
            if real(height_over(y, n, p)) > EDGE * np.abs(real(n[p + 3])) + EDGE * real(d):
                is_before = False
    if is_before:
        return d, o + n[best], o + n[best + 1], o + n[best + 2]
    first += 4 * faces
    least, nearest = np.inf, (o, o, o)
    for k in range(edges):
        away = from_edge(x, n, first + 6 * k)
        if real(dot(away, away)) < least:
            least, nearest = real(dot(away, away)), away
    size = np.sqrt(dot(nearest, nearest))
    return size, nearest[0] / size, nearest[1] / size, nearest[2] / size


@leaf
def height_over(x, n, face):
    """Height of x over the face of a hull whose normal and distance begin there."""
    return x[0] * n[face] + x[1] * n[face + 1] + x[2] * n[face + 2] - n[face + 3]


@leaf
def from_edge(x, n, p):
    """x from the next point of the edge whose ends begin at p."""
    e, d = minus(n[p + 3 :], n[p:]), minus(x, n[p:])
    s = dot(d, e) / dot(e, e)
    if real(s) < 0.0:
        s = 0.0 * s
    elif real(s) > 1.0:
        s = 0.0 * s + 1.0
    return minus(d, times(s, e))


@part
def surface_distance(kind, x, n):
    """(distance, gradient) of point x from the shape of this kind with the numbers n."""
    if kind == BOX:
        return from_box(x, n)
    if kind == CYLINDER:
        return from_cylinder(x, n)
    if kind == SEGMENT:
        return from_segment(x, n)
    return from_hull(x, n)


@leaf
def along_segment(kind, x, a, t, n):
    """Rate of the distance along the segment x + t a."""
    _, p, q, r = surface_distance(kind, plus(x, times(t, a)), n)
    return p * a[0] + q * a[1] + r * a[2]


@leaf
def nearest_of_segment(kind, x, a, half, n):
    """t of the point of the segment x + t a, |t| ≤ half, that is nearest to the shape, or deepest in it: the distance is convex in t."""
    if real(half) == 0.0:
        return 0.0 * half
    y, b = (real(x[0]), real(x[1]), real(x[2])), (real(a[0]), real(a[1]), real(a[2]))
    low, high = -real(half), real(half)
    if real(along_segment(kind, y, b, low, n)) >= 0.0:
        return -half
    if real(along_segment(kind, y, b, high, n)) <= 0.0:
        return half
    while True:
        t = 0.5 * (low + high)
        if not low < t < high:
            break
        if real(along_segment(kind, y, b, t, n)) > 0.0:
            high = t
        else:
            low = t
    # steps of Newton's iteration carry the slopes; what the first leaves open, because differences are no slopes, the second finds
    reach = 1e-5 * real(half)
    bend = real(along_segment(kind, y, b, t + reach, n)) - real(along_segment(kind, y, b, t - reach, n))
    found = t + 0.0 * half
    if bend > 0.0:
        for _ in range(2):
            slope = along_segment(kind, x, a, found, n)
            found = found - 2.0 * reach * (slope - real(slope)) / bend
    return found


# numbers of the pair; SWAPPED: 1 where the round body is the second one; BALL, HALF: its radius and half length; CORE: radius of the other
# capsule; SHAPE: kind of the other body, then its numbers. The RADIUS of the contact is the sum of those of balls about both markers.
SWAPPED, BALL, HALF, CORE, SHAPE, NUMBERS_OF_SHAPE = 0, 1, 2, 3, 4, 5
# Ends that are as deep, by this share of the radius, are equally deep; an axis turns along a side where its direction has less across.
EQUAL, ALONG = 1e-9, 1e-12


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
        towards = real(dot(g, n[p:]))
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
    _, g0, g1, g2 = surface_distance(kind, plus(x, times(t, a)), n)
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
    up = surface_distance(kind, plus(x, times(high, a)), n)[0]
    down = surface_distance(kind, plus(x, times(low, a)), n)[0]
    takes_high = real(up) > real(down)
    if np.abs(real(up) - real(down)) <= EQUAL * real(radius):
        takes_high = real(high) - real(t) > real(t) - real(low)
    return high if takes_high else low, less


@stage
def ends_of(machine, k):
    """(marker of the round body, marker of the other one, 1 or -1 where the round body is the second one) of contact k."""
    elements = record_at(machine).elements
    i, j = np.int64(elements.columns[k, law.MARKER]), np.int64(elements.columns[k, law.OTHER])
    return (j, i, -1.0) if real(elements.number[k, law.NUMBERS + SWAPPED]) == 1.0 else (i, j, 1.0)


@stage
def note_place(machine, k, j, y, g, sign):
    """Leave in the numbers of contact k the point y and the normal g, in axes of marker j, which is turned by `sign`."""
    record = record_at(machine)
    A, r, numbers = record.markers.A[j], record.markers.r[j], record.elements.number[k]
    put(numbers, law.POINT, plus(r, turned(A, y)))
    put(numbers, law.NORMAL, times(sign, turned(A, g)))


@law.pair(law.is_far, law.mean_speed)
def apply(machine, k, n):
    """A round body on another one: where its end may touch, or, as the last one whose normal is that of the contact, its deepest point."""
    record = record_at(machine)
    markers, more = record.markers, record.elements.number[k, law.NUMBERS :]
    i, j, sign = ends_of(machine, k)
    kind, shape, half = np.int64(real(more[SHAPE])), more[NUMBERS_OF_SHAPE:], more[HALF]
    A = markers.A[j]
    x, a = seen(A, minus(markers.r[i], markers.r[j])), seen(A, axis(markers.A[i], 2))
    t, less = nearest_of_segment(kind, x, a, half, shape), 0.0 * half
    if n + 1 < record.elements.columns[k, law.COUNT]:
        t, less = other_end(kind, x, a, half, shape, t, more[BALL])
    y = plus(x, times(t, a))
    distance, g0, g1, g2 = surface_distance(kind, y, shape)
    depth = more[BALL] + more[CORE] - less - distance
    # in the middle of the overlap
    y = minus(y, times(more[BALL] - 0.5 * depth, (g0, g1, g2)))
    note_place(machine, k, j, y, (g0, g1, g2), sign)
    return depth


def distance_numbers(body: Touching, part: int | None) -> tuple[int, list[float]]:
    """Kind and numbers of a shape, in the axes of its marker."""
    match body.shape:
        case Box():
            return BOX, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return CYLINDER, [body.shape.radius, 0.5 * bar_length(body.shape)]
        case Capsule():
            return SEGMENT, [0.5 * bar_length(body.shape)]
        case Extrusion() | Mesh():
            return HULL, polytope_of(body, part)
    raise ValueError(f"{body.name} has no shape that can touch")


def points_of_round(force: Contact, bodies: Sequence[Touching]) -> law.Points:
    """Of a sphere or a capsule and another shape."""
    # a sphere before a capsule: it has one point
    first = next((k for k, body in enumerate(bodies) if isinstance(body.shape, Sphere)), None)
    if first is None:
        first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Capsule))
    own, other = bodies[first].shape, bodies[1 - first]
    assert isinstance(own, Sphere | Capsule)  # the record was checked
    half = 0.0 if isinstance(own, Sphere) else 0.5 * bar_length(own)
    kind, numbers = distance_numbers(other, part_of(force, bodies, 1 - first))
    core = other.shape.radius if isinstance(other.shape, Capsule) else 0.0
    balls = own.radius + half + ball_of_shape(other)
    return law.Points(2 if half > 0.0 else 1, balls, [], [float(first), own.radius, half, core, float(kind), *numbers])
