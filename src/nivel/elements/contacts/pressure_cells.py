"""The surface of equal pressure between two convex hulls that overlap, as polygons.

Each body has a field of pressure inside, c times the distance d to its nearest face; where they overlap the smaller pressure holds
(Elandt, Drumwright, Sherman & Ruina 2019, with convex bodies for their meshes of tetrahedra). So a point belongs to the cell of the face,
of either body, that is nearest to it. Two cells meet in a convex polygon of the plane on which their faces are equally far away. The energy
of the overlap is c ∫ d dV, and the force is its derivative: the pressure c d on the polygons between a cell of the first body and one
of the second. It conserves energy whatever the bodies do.

With the divergence theorem for the field -c d²/2 n of every cell, the energy is a sum over the polygons: c/2 |n₂ - n₁| ∫ d² dA.

All places are in the axes of the first body. A face is a row of four numbers: its outward normal n and its distance h from the origin;
d = h - nᵀx.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, put
from nivel.native.function import leaf

# normals whose difference is shorter than this belong to parallel faces: their cells do not meet
PARALLEL = 1e-13
# Boxes are larger by this share of the size of the hulls than what they hold, which is cut off by so much more than the overlap.
SLACK, MARGIN = 1e-9, 1e-11


@leaf
def whole(x):
    """A number that is a place."""
    return np.int64(real(x))


@leaf
def depth_under(n, face, p):
    """Distance of the point p from the face whose row begins at `face`, positive inside."""
    return n[face + 3] - n[face] * p[0] - n[face + 1] * p[1] - n[face + 2] * p[2]


@leaf
def overlap_under(n, face, corners, count):
    """(largest distance under a face of `count` corners that begin at `corners`, place of that corner)."""
    deepest, found = depth_under(n, face, n[corners:]), corners
    for k in range(1, count):
        p = corners + 3 * k
        depth = depth_under(n, face, n[p:])
        if real(depth) > real(deepest):
            deepest, found = depth, p
    return deepest, found


@leaf
def bound_cap(n, face, corners, count, edges, size, box):
    """box (6,) := least and largest coordinates of the part of a hull under a face. edges (·) : numbers of two corners each.

    A face that is a little higher counts: along a slight slope its round-off reaches far.
    """
    margin = MARGIN * size
    for a in range(3):
        box[a], box[a + 3] = np.inf, -np.inf
    for k in range(count):
        p = corners + 3 * k
        if real(depth_under(n, face, n[p:])) >= -margin:
            for a in range(3):
                box[a], box[a + 3] = min(real(box[a]), real(n[p + a])), max(real(box[a + 3]), real(n[p + a]))
    for k in range(0, edges.shape[0], 2):
        p, q = corners + 3 * np.int64(edges[k]), corners + 3 * np.int64(edges[k + 1])
        here = real(depth_under(n, face, n[p:])) + margin
        there = real(depth_under(n, face, n[q:])) + margin
        if here * there < 0.0:
            share = here / (here - there)
            for a in range(3):
                cut = real(n[p + a]) + share * (real(n[q + a]) - real(n[p + a]))
                box[a], box[a + 3] = min(real(box[a]), cut), max(real(box[a + 3]), cut)
    for a in range(3):
        box[a], box[a + 3] = box[a] - SLACK * size, box[a + 3] + SLACK * size


@leaf
def range_in_box(n, face, box):
    """(least, largest) distance under a face of the points of a box."""
    least = real(n[face + 3])
    largest = least
    for a in range(3):
        low, high = real(n[face + a]) * real(box[a]), real(n[face + a]) * real(box[a + 3])
        least, largest = least - max(low, high), largest - min(low, high)
    return least, largest


@leaf
def nearest_faces(n, faces, count, box, found):
    """found := rows of the faces that may be the nearest one of a point of the box; returns how many."""
    bound = np.inf
    for k in range(count):
        bound = min(bound, range_in_box(n, faces + 4 * k, box)[1])
    number = 0
    for k in range(count):
        if range_in_box(n, faces + 4 * k, box)[0] <= bound:
            found[number] = faces + 4 * k
            number += 1
    return number


@leaf
def span_plane(n, i, j, box, frame):
    """frame (12,) := of the plane on which faces i and j are equally far away: two axes in it, its normal from the cell of i to that of j,
    its point next to the middle of the box. Returns |n_j - n_i|, or 0 where the plane misses the box."""
    e1, e2, m, o = frame[0:3], frame[3:6], frame[6:9], frame[9:12]
    put(m, 0, minus(n[j:], n[i:]))
    length = np.sqrt(dot(m, m))
    if real(length) < PARALLEL:
        return 0.0 * length
    away, radius = (n[j + 3] - n[i + 3]) / length, 0.0
    for a in range(3):
        m[a] /= length
        o[a] = 0.5 * (box[a] + box[a + 3])
        away -= m[a] * o[a]
        radius += (real(box[a + 3]) - real(box[a])) ** 2
    if 4.0 * real(away) ** 2 > radius:
        return 0.0 * length
    for a in range(3):
        o[a] += away * m[a]
    # the axis along which the normal is shortest is well apart from it
    least = 0
    for a in range(1, 3):
        if np.abs(real(m[a])) < np.abs(real(m[least])):
            least = a
    second, third = (least + 1) % 3, (least + 2) % 3
    size = np.sqrt(m[second] * m[second] + m[third] * m[third])
    e1[least], e1[second], e1[third] = 0.0 * size, -m[third] / size, m[second] / size
    put(e2, 0, cross(m, e1))
    return length


@leaf
def clip(n, source, count, target, s0, su, sv):
    """Corners (u, v) of a polygon where s0 + su u + sv v ≥ 0, from `source` to `target`; returns how many (Sutherland & Hodgman 1974)."""
    kept = 0
    p = source + 2 * (count - 1)
    before = s0 + su * n[p] + sv * n[p + 1]
    for k in range(count):
        q = source + 2 * k
        here = s0 + su * n[q] + sv * n[q + 1]
        if (real(before) >= 0.0) != (real(here) >= 0.0):
            share = before / (before - here)
            n[target + 2 * kept] = n[p] + share * (n[q] - n[p])
            n[target + 2 * kept + 1] = n[p + 1] + share * (n[q + 1] - n[p + 1])
            kept += 1
        if real(here) >= 0.0:
            n[target + 2 * kept], n[target + 2 * kept + 1] = n[q], n[q + 1]
            kept += 1
        p, before = q, here
    return kept


@leaf
def along_plane(n, face, frame):
    """Distance under a face of the point u, v of a plane, as (d0, du, dv): d0 + du u + dv v."""
    d0 = depth_under(n, face, frame[9:])
    return d0, -dot(n[face:], frame), -dot(n[face:], frame[3:])


@leaf
def is_in_box(frame, u, v, box):
    """Whether a point of a plane lies in a box."""
    inside = True
    for a in range(3):
        x = real(frame[9 + a] + u * frame[a] + v * frame[3 + a])
        inside = inside and real(box[a]) <= x <= real(box[a + 3])
    return inside


@leaf
def meet(n, i, j, faces, count, box, floor, frame, work):
    """The polygon in which the cells of faces i and j meet, where d ≥ floor: (|n_j - n_i|, its corners, the place of the first one).

    faces (count,) : rows of the faces that may be nearest in the box. work : place of two polygons, of `count` + 4 corners each.

    Where the hulls overlap the box holds all polygons. Where they do not, what these faces leave lies outside of it, beyond other faces.
    """
    length, corners = span_plane(n, i, j, box, frame), 0
    source, target = work, work + 2 * (count + 4)
    if real(length) == 0.0:
        return length, corners, source
    half = 0.0
    for a in range(3):
        half += (real(box[a + 3]) - real(box[a])) ** 2
    half = np.sqrt(half)
    n[source], n[source + 1], n[source + 2], n[source + 3] = -half, -half, half, -half
    n[source + 4], n[source + 5], n[source + 6], n[source + 7] = half, half, -half, half
    d0, du, dv = along_plane(n, i, frame)
    corners = clip(n, source, 4, target, d0 - floor, du, dv)
    for k in range(count):
        source, target = target, source
        if corners < 3:
            return length, 0, source
        face = whole(faces[k])
        if face in (i, j):
            source, target = target, source
            continue
        s0, su, sv = along_plane(n, face, frame)
        corners = clip(n, source, corners, target, s0 - d0, su - du, sv - dv)
    if corners < 3 or not is_in_box(frame, n[target], n[target + 1], box):
        corners = 0
    return length, corners, target
