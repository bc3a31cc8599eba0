"""Points of an ellipsoid on a plane, and of one with another convex shape.

It touches at one point, as deep as its signed distance says, in the middle of the overlap. There a sphere and a capsule are a point and a
segment with a radius, a plane is a polytope of one face. The distance is negative where they overlap.

The distance φ of a point from a convex body is a convex function of the point, so its least value over a polytope stands at one place: in
a face, on an edge or at a corner. In a face ∇φ is against the face's normal, so the place is that of the ellipsoid's support there.
Of two ellipsoids it is the largest gap nᵀd - h₁(n) - h₂(n) over the unit vectors n, h(n) = √(nᵀ M n) the support function of xᵀ M⁻¹ x ≤ 1.
Both are exact, and so is their gradient, as long as an ellipsoid is not deeper inside than its least radius of curvature.
"""

import math
from collections.abc import Sequence

import numpy as np

from nivel.elements.contacts.law import NORMAL, NUMBERS, POINT, SPEED, Points, is_far, mean_speed, pair
from nivel.elements.contacts.rounds import ends_of, note_place
from nivel.elements.contacts.shapes import ball_of_shape, part_of, polytope_of
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, opposite, plus, seen, seen_flat, times, turned_flat
from nivel.kernels.forces.wrench import velocity_at
from nivel.kernels.record.record import record_at
from nivel.known import Contact
from nivel.machine.bodies.shape import Capsule, Ellipsoid, Sphere
from nivel.machine.bodies.solids import length
from nivel.machine.bodies.touching import Touching
from nivel.native.function import leaf, part, stage

# numbers of a polytope: the counts of corners, faces and edges, then corners (3 each), faces (normal and distance, 4 each) and edges (6
# each, both ends)
CORNERS, FACES, EDGES, FIRST = 0, 1, 2, 3
# Iterations of Newton's method, which comes to a root from one side; of the search on an edge and between ellipsoids.
MOST, SEARCH, TURNS = 60, 60, 40
# A coordinate of a point counts for no less than this share of its semi-axis, so that no point lies in a plane of symmetry.
LEAST = 1e-12
# A place in a face may be beyond its edge by this share of the distance.
EDGE = 1e-12
# Bounds of the search between two ellipsoids, which begins at the direction of the homothetic touch.
BISECTIONS = 30


@leaf
def off_plane(x, a):
    """a x, or LEAST a² where that is less in size."""
    y = a * x
    least = LEAST * real(a) * real(a)
    if np.abs(real(y)) < least:
        y = y + (least if real(y) >= 0.0 else -least)
    return y


@leaf
def from_ellipsoid(x, n):
    """(distance, gradient) of a point from the ellipsoid with the semi-axes n, in its axes.

    The foot is a² x/(t + a²) along each axis, t the root of Σ (a x/(t + a²))² = 1 (Eberly 2013).
    """
    a, b, c = n[0] * n[0], n[1] * n[1], n[2] * n[2]
    u, v, w = off_plane(x[0], n[0]), off_plane(x[1], n[1]), off_plane(x[2], n[2])
    t = max(-real(a) + np.abs(real(u)), -real(b) + np.abs(real(v)), -real(c) + np.abs(real(w)))
    for _ in range(MOST):
        f, g, h = real(u) / (t + real(a)), real(v) / (t + real(b)), real(w) / (t + real(c))
        value = f * f + g * g + h * h - 1.0
        slope = -2.0 * (f * f / (t + real(a)) + g * g / (t + real(b)) + h * h / (t + real(c)))
        change = -value / slope if slope < 0.0 else 0.0
        if not change > 1e-16 * (np.abs(t) + real(a)):
            break
        t += change
    # one step more carries the slopes
    f, g, h = u / (t + a), v / (t + b), w / (t + c)
    value = f * f + g * g + h * h - 1.0
    slope = f * f / (t + a) + g * g / (t + b) + h * h / (t + c)
    s = t + 0.5 * value / slope
    f, g, h = u / (s + a), v / (s + b), w / (s + c)
    p, q, r = f / n[0], g / n[1], h / n[2]
    size = np.sqrt(p * p + q * q + r * r)
    p, q, r = p / size, q / size, r / size
    return (x[0] - f * n[0]) * p + (x[1] - g * n[1]) * q + (x[2] - h * n[2]) * r, p, q, r


@leaf
def along_edge(m, e, t, n):
    """(distance at m + t e, its rate with t)."""
    d, p, q, r = from_ellipsoid(plus(m, times(t, e)), n)
    return d, p * e[0] + q * e[1] + r * e[2]


@part
def nearest_on_edge(m, e, n):
    """t of the point m + t e, |t| ≤ 1/2, with the least distance: that is convex, so its rate has one root at most (Illinois rule)."""
    y, b, a = reals(m), reals(e), reals(n)
    none = 0.0 * m[0]
    low, high = -0.5, 0.5
    f, g = along_edge(y, b, low, a)[1], along_edge(y, b, high, a)[1]
    if f >= 0.0:
        return none + low
    if g <= 0.0:
        return none + high
    t, side = 0.5 * (low + high), 0
    size = g - f
    for k in range(SEARCH):
        # every third step halves, whatever the rule says
        t = 0.5 * (low + high) if k % 3 == 2 else (low * g - high * f) / (g - f)
        if not low < t < high:
            break
        value = along_edge(y, b, t, a)[1]
        if np.abs(value) <= 1e-15 * size:
            break
        if value > 0.0:
            high, g = t, value
            f = 0.5 * f if side == 1 else f
            side = 1
        else:
            low, f = t, value
            g = 0.5 * g if side == -1 else g
            side = -1
    # steps of Newton's iteration carry the slopes; what the first leaves open, because differences are no slopes, the second finds
    reach = 1e-5
    bend = along_edge(y, b, t + reach, a)[1] - along_edge(y, b, t - reach, a)[1]
    found = t + none
    if bend > 0.0:
        for _ in range(2):
            slope = along_edge(m, e, found, n)[1]
            found = found - 2.0 * reach * (slope - real(slope)) / bend
    return found


@leaf
def support(B, a, n):
    """(h, x): h = √(nᵀ M n) and the point x = M n/h of an ellipsoid about the origin, farthest along the unit vector n; its axes are the
    columns of B."""
    g = seen_flat(B, n)
    g0, g1, g2 = a[0] * g[0], a[1] * g[1], a[2] * g[2]
    h = np.sqrt(g0 * g0 + g1 * g1 + g2 * g2)
    return h, turned_flat(B, (a[0] * g0 / h, a[1] * g1 / h, a[2] * g2 / h))


@leaf
def in_face(polytope, y, at, faces):
    """Whether point y of face `at` is not beyond its edges."""
    first = FIRST + 3 * np.int64(real(polytope[CORNERS]))
    for k in range(faces):
        p = first + 4 * k
        if p == at:
            continue
        over = real(dot(y, polytope[p:]))
        size = np.abs(real(y[0])) + np.abs(real(y[1])) + np.abs(real(y[2])) + np.abs(real(polytope[p + 3]))
        if over > real(polytope[p + 3]) + EDGE * size:
            return False
    return True


@leaf
def face_gap(polytope, p, c, B, a):
    """(height of the centre over the face that begins at p, gap to the ellipsoid, normal into the face, place of the face below it)."""
    o = 0.0 * c[0]
    n = polytope[p] + o, polytope[p + 1] + o, polytope[p + 2] + o
    h, x = support(B, a, n)
    above = dot(n, c) - polytope[p + 3]
    gap = above - h
    return above, gap, opposite(n), minus(minus(c, x), times(gap, n))


@leaf
def reals(x):
    """The values of three numbers."""
    return real(x[0]), real(x[1]), real(x[2])


@part
def from_polytope(polytope, c, B, a):
    """(distance, its gradient with the place of the polytope, its nearest or deepest point, whether that is in a face) of a polytope, in
    whose axes all is, from the ellipsoid at c whose axes are the columns of B.

    Where the centre is inside the polytope the ellipsoid comes out by the face that is next.
    """
    corners, faces = np.int64(real(polytope[CORNERS])), np.int64(real(polytope[FACES]))
    edges, first, o = np.int64(real(polytope[EDGES])), FIRST + 3 * corners, 0.0 * c[0]
    next_face, most, is_inside = first, -np.inf, faces > 0
    for k in range(faces):
        p = first + 4 * k
        above, gap, g, y = face_gap(polytope, p, c, B, a)
        if real(above) > 0.0:
            is_inside = False
            if in_face(polytope, y, p, faces):
                return gap, g, y, 1.0
        if real(gap) > most:
            next_face, most = p, real(gap)
    if is_inside:
        _, gap, g, y = face_gap(polytope, next_face, c, B, a)
        return gap, g, y, 1.0
    first += 4 * faces
    least, e, s = np.inf, (o, o, o), reals(a)
    # without edges it is a point
    m = seen_flat(B, minus((polytope[FIRST], polytope[FIRST + 1], polytope[FIRST + 2]), c))
    for k in range(edges):
        p = polytope[first + 6 * k : first + 6 * k + 6]
        middle = seen_flat(B, minus((0.5 * (p[0] + p[3]), 0.5 * (p[1] + p[4]), 0.5 * (p[2] + p[5])), c))
        along = seen_flat(B, (p[3] - p[0] + o, p[4] - p[1] + o, p[5] - p[2] + o))
        y, b = reals(middle), reals(along)
        d, rate = along_edge(y, b, 0.0, s)
        # a convex function is nowhere below its tangent
        if d - 0.5 * np.abs(rate) < least:
            d = along_edge(y, b, nearest_on_edge(y, b, s), s)[0]
            if d < least:
                least, m, e = d, middle, along
    t = nearest_on_edge(m, e, a) if edges > 0 else o
    y = plus(m, times(t, e))
    d, p, q, r = from_ellipsoid(y, a)
    return d, turned_flat(B, (p, q, r)), plus(c, turned_flat(B, y)), 0.0


@leaf
def times_matrix(B, a, x):
    """M x, M = B diag(a²) Bᵀ."""
    y = seen_flat(B, x)
    return turned_flat(B, (a[0] * a[0] * y[0], a[1] * a[1] * y[1], a[2] * a[2] * y[2]))


@leaf
def solve_symmetric(P, Q, R, d):
    """x of [P Q R] x = d, by Cramer's rule."""
    u, v, w = cross(Q, R), cross(R, P), cross(P, Q)
    k = dot(P, u)
    return dot(u, d) / k, dot(v, d) / k, dot(w, d) / k


@leaf
def homothetic_direction(A, a, B, b, d):
    """The unit normal where two ellipsoids touch that are both scaled until they do: C⁻¹ d, C = (1 - λ) M₁ + λ M₂, with the λ that makes
    λ (1 - λ) dᵀ C⁻¹ d largest (Perram, Wertheim 1985)."""
    low, high = 0.0, 1.0
    X = d
    for _ in range(BISECTIONS):
        s = 0.5 * (low + high)
        P, Q, R = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
        p1, q1, r1 = times_matrix(A, a, P), times_matrix(A, a, Q), times_matrix(A, a, R)
        p2, q2, r2 = times_matrix(B, b, P), times_matrix(B, b, Q), times_matrix(B, b, R)
        k = 1.0 - s
        p, q, r = plus(times(k, p1), times(s, p2)), plus(times(k, q1), times(s, q2)), plus(times(k, r1), times(s, r2))
        X = solve_symmetric(p, q, r, d)
        if k * k * dot(X, times_matrix(A, a, X)) - s * s * dot(X, times_matrix(B, b, X)) > 0.0:
            low = s
        else:
            high = s
    size = np.sqrt(dot(X, X))
    return X[0] / size, X[1] / size, X[2] / size


@leaf
def across(n):
    """Two unit vectors across the unit vector n and each other."""
    a = (1.0, 0.0, 0.0) if np.abs(n[0]) < 0.6 else (0.0, 1.0, 0.0)
    t = cross(n, a)
    size = np.sqrt(dot(t, t))
    t = t[0] / size, t[1] / size, t[2] / size
    return t, cross(n, t)


@leaf
def gap_and_slope(A, a, B, b, d, n):
    """(gap nᵀd - h₁ - h₂, its gradient d - x₁ - x₂) with the unit normal n from the first ellipsoid to the second."""
    h, x = support(A, a, n)
    k, y = support(B, b, n)
    return dot(n, d) - h - k, minus(minus(d, x), y)


@leaf
def bend_of(B, a, n, t, u):
    """tᵀ (M/h - M n nᵀ M/h³) u, of the second derivatives of the support function."""
    h, x = support(B, a, n)
    return (dot(t, times_matrix(B, a, u)) - dot(t, x) * dot(u, x)) / h


@leaf
def turn_towards(A, a, B, b, d, n, G, gap):
    """The tangent vector by which Newton's method for the largest gap turns the unit vector n, where the gap has the gradient G."""
    t, u = across(n)
    x, y = dot(t, G), dot(u, G)
    p = bend_of(A, a, n, t, t) + bend_of(B, b, n, t, t) + gap
    q = bend_of(A, a, n, t, u) + bend_of(B, b, n, t, u)
    r = bend_of(A, a, n, u, u) + bend_of(B, b, n, u, u) + gap
    k = p * r - q * q
    if not (k > 0.0 and p > 0.0):
        p, q, r = np.abs(gap) + p * p, 0.0, np.abs(gap) + p * p  # uphill
        k = p * r
    f, g = (r * x - q * y) / k, (p * y - q * x) / k
    return plus(times(f, t), times(g, u))


@leaf
def turned_by(n, v, share):
    """(n + share v), of unit length."""
    x = plus(n, times(share, v))
    size = np.sqrt(dot(x, x))
    return x[0] / size, x[1] / size, x[2] / size


@part
def between_ellipsoids(A, a, B, b, d):
    """(distance, unit normal from the first to the second, the point of the second that is nearest or deepest) of two ellipsoids with the
    axes A, B and the semi-axes a, b; d from the centre of the first to that of the second, from which the point is counted."""
    A0, B0 = reals(A[:3]) + reals(A[3:6]) + reals(A[6:]), reals(B[:3]) + reals(B[3:6]) + reals(B[6:])
    a0, b0, d0 = reals(a), reals(b), reals(d)
    n = homothetic_direction(A0, a0, B0, b0, d0)
    gap, G = gap_and_slope(A0, a0, B0, b0, d0, n)
    v = (0.0, 0.0, 0.0)
    for _ in range(TURNS):
        v = turn_towards(A0, a0, B0, b0, d0, n, G, gap)
        if not dot(v, v) > 1e-30:
            break
        share = 1.0
        while share > 1e-3:
            if gap_and_slope(A0, a0, B0, b0, d0, turned_by(n, v, share))[0] >= gap:
                break
            share *= 0.5
        before = gap
        n = turned_by(n, v, share)
        gap, G = gap_and_slope(A0, a0, B0, b0, d0, n)
        if not gap > before:
            break
    # one step more carries the slopes
    o = 0.0 * d[0]
    m = n[0] + o, n[1] + o, n[2] + o
    uphill = gap_and_slope(A, a, B, b, d, m)[1]
    m = turned_by(m, turn_towards(A0, a0, B0, b0, d0, n, uphill, gap), 1.0)
    y = support(B, b, m)[1]
    return gap_and_slope(A, a, B, b, d, m)[0], m, opposite(y)


# numbers of a pair with an ellipsoid, behind SWAPPED; SEMI_AXES: of it; OTHER_KIND: of the other one; OTHER_CORE: its radius around what
# its numbers are of; ON_FACE: work, 1 where it touches with a face. The RADIUS of one on a plane is without bounds.
SEMI_AXES, OTHER_KIND, OTHER_CORE, ON_FACE, NUMBERS_OF_OTHER = 1, 4, 5, 6, 7
POLYTOPE, ELLIPSOID = 0, 1


@stage
def between(A, B):
    """Aᵀ B of two frames (9,), by rows."""
    x, y, z = seen(A, axis(B, 0)), seen(A, axis(B, 1)), seen(A, axis(B, 2))
    return x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]


@stage
def speed_of_support(machine, k, n):
    """Velocity of the point itself: where the ellipsoid of contact k rolls on a face, that of its support; else the mean.

    x = S² g/|S g| in axes of the ellipsoid, g = Bᵀ n, ġ = Bᵀ (Ω - ω) × n.
    """
    record = record_at(machine)
    markers, bodies, numbers = record.markers, record.bodies, record.elements.number[k]
    i, j, sign = ends_of(machine, k)
    p, normal, B, a = numbers[POINT:NORMAL], numbers[NORMAL:SPEED], markers.A[i], numbers[NUMBERS + SEMI_AXES :]
    if real(numbers[NUMBERS + ON_FACE]) != 1.0:
        return mean_speed(machine, k, 0)
    d = times(-sign, normal)
    turning = cross(minus(bodies.omega[markers.body[j]], bodies.omega[markers.body[i]]), d)
    square, along = 0.0 * d[0], 0.0 * d[0]
    for b in range(3):
        g = dot(axis(B, b), d)
        square += a[b] * a[b] * g * g
        along += a[b] * a[b] * g * dot(axis(B, b), turning)
    h = np.sqrt(square)
    v = velocity_at(bodies, markers.body[i], p)
    for b in range(3):
        share = a[b] * a[b] * (dot(axis(B, b), turning) - dot(axis(B, b), d) * along / square) / h
        v = plus(v, times(share, axis(B, b)))
    return v


@pair(is_far, speed_of_support)
def apply_to_ellipsoids(machine, k, n):
    """An ellipsoid on another body: where they may touch."""
    record = record_at(machine)
    markers, more = record.markers, record.elements.number[k, NUMBERS:]
    i, j, sign = ends_of(machine, k)
    A, a, shape = markers.A[j], more[SEMI_AXES:OTHER_KIND], more[NUMBERS_OF_OTHER:]
    c, B = seen(A, minus(markers.r[i], markers.r[j])), between(A, markers.A[i])
    if np.int64(real(more[OTHER_KIND])) == ELLIPSOID:
        o = 0.0 * c[0]
        upright = o + 1.0, o, o, o, o + 1.0, o, o, o, o + 1.0
        d, g, y = between_ellipsoids(B, a, upright, shape, opposite(c))
        on_face = 0.0
    else:
        d, g, y, on_face = from_polytope(shape, c, B, a)
    depth = more[OTHER_CORE] - d
    # in the middle of the overlap, from the point of the core on towards the ellipsoid
    below = 0.5 * depth - more[OTHER_CORE]
    note_place(machine, k, j, plus(y, times(below, g)), g, -sign)
    more[ON_FACE] = 0.0 * depth + on_face
    return depth


def points_of_ellipsoid(force: Contact, bodies: Sequence[Touching]) -> Points:
    """Of an ellipsoid on a plane or another shape."""
    first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Ellipsoid))
    own, core, kind, balls = bodies[first].shape, 0.0, POLYTOPE, math.inf
    assert isinstance(own, Ellipsoid)
    # the half-space below z = 0: a face alone
    numbers = [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    if force.bodies is not None:
        other, balls = bodies[1 - first], sum(ball_of_shape(body) for body in bodies)
        match other.shape:
            case Ellipsoid():
                kind, numbers = ELLIPSOID, list(other.shape.semi_axes)
            case Sphere():
                core, numbers = other.shape.radius, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            case Capsule():
                ends = [0.0, 0.0, -0.5 * length(other.shape), 0.0, 0.0, 0.5 * length(other.shape)]
                core, numbers = other.shape.radius, [2.0, 0.0, 1.0, *ends, *ends]
            case _:
                numbers = polytope_of(other, part_of(force, bodies, 1 - first))
    return Points(1, balls, [], [float(first), *own.semi_axes, float(kind), core, 0.0, *numbers])
