"""Signed distance of a point from a convex shape, and the direction in which it grows; negative inside.

A capsule's is that of its core, a line segment. All are exact: boxes and cylinders by their faces and rims, hulls by faces,
edges and corners in turn. The point is in axes of the shape.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import absolute, real
from nivel.native.function import leaf, part

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
        over = real(x[0]) * n[p] + real(x[1]) * n[p + 1] + real(x[2]) * n[p + 2] - n[p + 3]
        if real(over) > most:
            best, most = p, real(over)
    d = x[0] * n[best] + x[1] * n[best + 1] + x[2] * n[best + 2] - n[best + 3]
    o = 0.0 * d
    is_before = True
    if real(d) > 0.0:
        y0, y1, y2 = (
            real(x[0]) - real(d) * real(n[best]),
            real(x[1]) - real(d) * real(n[best + 1]),
            real(x[2]) - real(d) * real(n[best + 2]),
        )
        for k in range(faces):
            p = first + 4 * k
            over = y0 * real(n[p]) + y1 * real(n[p + 1]) + y2 * real(n[p + 2]) - real(n[p + 3])
            if over > EDGE * np.abs(real(n[p + 3])) + EDGE * real(d):
                is_before = False
    if is_before:
        return d, o + n[best], o + n[best + 1], o + n[best + 2]
    first += 4 * faces
    least, at = np.inf, first
    for k in range(edges):
        p = first + 6 * k
        s = share_of_edge(real(x[0]), real(x[1]), real(x[2]), n, p)
        z0 = real(x[0]) - real(n[p]) - s * (real(n[p + 3]) - real(n[p]))
        z1 = real(x[1]) - real(n[p + 1]) - s * (real(n[p + 4]) - real(n[p + 1]))
        z2 = real(x[2]) - real(n[p + 2]) - s * (real(n[p + 5]) - real(n[p + 2]))
        if z0 * z0 + z1 * z1 + z2 * z2 < least:
            least, at = z0 * z0 + z1 * z1 + z2 * z2, p
    e0, e1, e2 = n[at + 3] - n[at], n[at + 4] - n[at + 1], n[at + 5] - n[at + 2]
    d0, d1, d2 = x[0] - n[at], x[1] - n[at + 1], x[2] - n[at + 2]
    s = (d0 * e0 + d1 * e1 + d2 * e2) / (e0 * e0 + e1 * e1 + e2 * e2)
    if real(s) < 0.0:
        s = 0.0 * s
    elif real(s) > 1.0:
        s = 0.0 * s + 1.0
    d0, d1, d2 = d0 - s * e0, d1 - s * e1, d2 - s * e2
    d = np.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
    return d, d0 / d, d1 / d, d2 / d


@leaf
def share_of_edge(x, y, z, n, p):
    """Where on an edge the next point is, from 0 to 1."""
    e0, e1, e2 = real(n[p + 3]) - real(n[p]), real(n[p + 4]) - real(n[p + 1]), real(n[p + 5]) - real(n[p + 2])
    along = (x - real(n[p])) * e0 + (y - real(n[p + 1])) * e1 + (z - real(n[p + 2])) * e2
    return min(max(along / (e0 * e0 + e1 * e1 + e2 * e2), 0.0), 1.0)


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
    _, p, q, r = surface_distance(kind, (x[0] + t * a[0], x[1] + t * a[1], x[2] + t * a[2]), n)
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
