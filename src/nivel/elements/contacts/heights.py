"""Ground z = h(x, y) through heights on a grid: the surface, and the place on it that is nearest to a point.

Between the heights h is a cubic in x and in y by convolution (Keys 1981): its slopes are continuous, and it is exact for parabolas. Beyond
the grid the heights of its border go on.

Points of shapes touch it as they touch a plane (`nivel.elements.contacts.ground`). Each force is along the normal of the nearest place of
the ground, and friction is across the mean of these normals, weighted by the forces.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nivel.elements.contacts import law
from nivel.elements.contacts.ground import (
    CYLINDER,
    KIND,
    SHAPE,
    ball_radius,
    end_sign,
    ground_shape,
    is_above,
    shape_point,
)
from nivel.elements.contacts.shapes import ball_of_shape, corners_of_parts
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import axis, minus, plus, put, seen, times, turned
from nivel.kernels.record.record import record_at
from nivel.machine.bodies.touching import Touching
from nivel.native.function import leaf, part, stage

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from nivel.elements.contacts.contact import Contact


# numbers: counts of heights along x and y, the lengths between the outermost of them, a bound that no height passes, one of the second
# derivative along any line by the squares of meshes [m]; then the heights, row by row along x, with one more on each side
ALONG, ACROSS, WIDTH, LENGTH, HIGHEST, BEND, HEIGHTS = 0, 1, 2, 3, 4, 5, 6
# Of the cubic between heights, the sum of the sizes of the weights of all sixteen.
OVERSHOOT = 1.25**2
# Bound of its second derivatives by second differences of the heights.
CUBIC = 3.0
# Steps of Newton's method, and halvings of one that does not come nearer; behind a step below this share of a mesh one more is the last.
STEPS, HALVINGS, SETTLED = 40, 12, 1e-11
# Searches anew from a place that is nearer, at most, and halvings with which that is found.
SEARCHES, CLOSER = 8, 30
# roundings of a squared distance, in units in the last place of what it is formed from
ROUNDINGS = 8.0 * 2.2e-16


def numbers_of(heights: NDArray[Any], size: tuple[float, float]) -> list[float]:
    """The numbers of heights (rows along y, heights along x) [m]: around the grid the parabolas through its outer heights go on."""
    least, most = heights.min(), heights.max()
    bound = 0.5 * (least + most) + 0.5 * OVERSHOOT * (most - least)
    rows, columns = heights.shape
    padded = np.zeros((rows + 2, columns + 2))
    padded[1:-1, 1:-1] = heights
    padded[1:-1, 0], padded[1:-1, -1] = heights[:, :3] @ [3.0, -3.0, 1.0], heights[:, -3:] @ [1.0, -3.0, 3.0]
    padded[0], padded[-1] = [3.0, -3.0, 1.0] @ padded[1:4], [1.0, -3.0, 3.0] @ padded[-4:-1]
    along = np.abs(np.diff(padded[1:-1], 2, axis=1)) + np.abs(np.diff(padded[:, 1:-1], 2, axis=0))
    bend = CUBIC * (along + 2.0 * np.abs(np.diff(np.diff(padded, axis=0), axis=1))[1:, 1:]).max()
    return [float(columns), float(rows), *size, float(bound), float(bend), *padded.ravel().tolist()]


@leaf
def weights(f):
    """Of the four heights around a place between the second and the third, at the share f: values, slopes and second derivatives."""
    return (
        (-0.5 * f + f * f - 0.5 * f * f * f, -0.5 + 2.0 * f - 1.5 * f * f, 2.0 - 3.0 * f),
        (1.0 - 2.5 * f * f + 1.5 * f * f * f, -5.0 * f + 4.5 * f * f, -5.0 + 9.0 * f),
        (0.5 * f + 2.0 * f * f - 1.5 * f * f * f, 0.5 + 4.0 * f - 4.5 * f * f, 4.0 - 9.0 * f),
        (-0.5 * f * f + 0.5 * f * f * f, -f + 1.5 * f * f, -1.0 + 3.0 * f),
    )


@leaf
def place_in(u, count):
    """(number of the mesh, share within it, 1 inside the grid) of the place u along a side; 0 beyond it, where nothing changes with u.

    A place that is no number lies before the grid, so that it is no index.
    """
    if not real(u) > 0.0:
        return 0, 0.0 * u, 0.0
    if real(u) >= count - 1.0:
        return count - 2, 0.0 * u + 1.0, 0.0
    k = np.int64(real(u))
    return k, u - k, 1.0


@part
def surface(n, x, y):
    """(h, ∂h/∂x, ∂h/∂y, ∂²h/∂x², ∂²h/∂x∂y, ∂²h/∂y²)."""
    along, across = np.int64(real(n[ALONG])), np.int64(real(n[ACROSS]))
    p, q = (along - 1.0) / n[WIDTH], (across - 1.0) / n[LENGTH]
    i, f, is_along = place_in((x / n[WIDTH] + 0.5) * (along - 1.0), along)
    j, g, is_across = place_in((y / n[LENGTH] + 0.5) * (across - 1.0), across)
    a, b = weights(f), weights(g)
    h = 0.0 * x + 0.0 * y
    hx, hy, hxx, hxy, hyy = h, h, h, h, h
    for m in range(4):
        first = HEIGHTS + (j + m) * (along + 2) + i
        value = a[0][0] * n[first] + a[1][0] * n[first + 1] + a[2][0] * n[first + 2] + a[3][0] * n[first + 3]
        slope = a[0][1] * n[first] + a[1][1] * n[first + 1] + a[2][1] * n[first + 2] + a[3][1] * n[first + 3]
        bend = a[0][2] * n[first] + a[1][2] * n[first + 1] + a[2][2] * n[first + 2] + a[3][2] * n[first + 3]
        h += b[m][0] * value
        hx += b[m][0] * slope
        hxx += b[m][0] * bend
        hy += b[m][1] * value
        hxy += b[m][1] * slope
        hyy += b[m][2] * value
    p, q = p * is_along, q * is_across
    return h, p * hx, q * hy, p * p * hxx, p * q * hxy, q * q * hyy


@leaf
def height(n, x, y):
    """h alone, of real numbers, at a third of the cost of `surface`."""
    along, across = np.int64(real(n[ALONG])), np.int64(real(n[ACROSS]))
    i, f, _ = place_in((x / real(n[WIDTH]) + 0.5) * (along - 1.0), along)
    j, g, _ = place_in((y / real(n[LENGTH]) + 0.5) * (across - 1.0), across)
    a, b = weights(f), weights(g)
    h = 0.0
    for m in range(4):
        first = HEIGHTS + (j + m) * (along + 2) + i
        value = a[0][0] * real(n[first]) + a[1][0] * real(n[first + 1])
        h += b[m][0] * (value + a[2][0] * real(n[first + 2]) + a[3][0] * real(n[first + 3]))
    return h


@leaf
def squared_distance(n, x, y, c):
    """Of the place above (x, y) from the point c."""
    d0, d1, d2 = x - c[0], y - c[1], surface(n, x, y)[0] - c[2]
    return d0 * d0 + d1 * d1 + d2 * d2


@leaf
def step_to(n, x, y, c, bends):
    """The change of (x, y) by Newton's method for the least distance from c, without the surface's bend where `bends` is 0."""
    h, hx, hy, hxx, hxy, hyy = surface(n, x, y)
    d = h - c[2]
    g0, g1, e = x - c[0] + d * hx, y - c[1] + d * hy, bends * d
    A, B, C = 1.0 + hx * hx + e * hxx, hx * hy + e * hxy, 1.0 + hy * hy + e * hyy
    k = A * C - B * B
    return (B * g1 - C * g0) / k, (B * g0 - A * g1) / k, real(k) > 0.0 and real(A) > 0.0


@leaf
def search_from(n, x, y, c, before):
    """(x, y, whether the bend of the surface counts there) of a place nearest to the point c of real numbers, by Newton's method from the
    place above (x, y), whose squared distance is `before`."""
    mesh = real(n[WIDTH]) / real(n[ALONG])
    bends = 1.0
    for _ in range(STEPS):
        u, v, is_least = step_to(n, x, y, c, 1.0)
        bends = 1.0
        if not is_least:
            bends = 0.0
            u, v, _ = step_to(n, x, y, c, 0.0)
        u, v = real(u), real(v)
        if u * u + v * v <= (SETTLED * mesh) ** 2:
            break
        d = np.sqrt(before)
        allowed = before + ROUNDINGS * d * (d + np.abs(x) + np.abs(y) + np.abs(c[2]))
        before = real(squared_distance(n, x + u, y + v, c))
        for _ in range(HALVINGS):
            if before <= allowed:
                break
            u, v = 0.5 * u, 0.5 * v
            before = real(squared_distance(n, x + u, y + v, c))
        x, y = x + u, y + v
    return x, y, bends


@leaf
def place_before(n, x, y, c, above):
    """Where the line from the point c, which is `above` the surface or below, to the place above (x, y) comes to the surface before."""
    p, q, r = x - c[0], y - c[1], real(surface(n, x, y)[0]) - c[2]
    low, high = 0.0, 1.0
    for _ in range(CLOSER):
        t = 0.5 * (low + high)
        if (c[2] + t * r - real(surface(n, c[0] + t * p, c[1] + t * q)[0])) * above > 0.0:
            low = t
        else:
            high = t
    return c[0] + high * p, c[1] + high * q


@part
def from_heights(n, c):
    """(distance, normal, place) of a point c from the ground, in its axes; negative below it. The place is that of a nearest one which the
    search from the place below c finds, seen from the side of c: else the search begins anew where the line to it crosses the ground."""
    c0 = real(c[0]), real(c[1]), real(c[2])
    x, y = c0[0], c0[1]
    above = c0[2] - real(surface(n, x, y)[0])
    x, y, bends = search_from(n, x, y, c0, above * above)
    for _ in range(SEARCHES):
        h, hx, hy, _, _, _ = surface(n, x, y)
        out = -real(hx) * (c0[0] - x) - real(hy) * (c0[1] - y) + c0[2] - real(h)
        if out * above >= 0.0:
            break
        x, y = place_before(n, x, y, c0, above)
        x, y, bends = search_from(n, x, y, c0, real(squared_distance(n, x, y, c0)))
    # one step more carries the slopes
    o = 0.0 * c[0]
    du, dv, _ = step_to(n, x + o, y + o, c, bends)
    s, t = x + du, y + dv
    h, hx, hy, _, _, _ = surface(n, s, t)
    size = np.sqrt(1.0 + hx * hx + hy * hy)
    n0, n1, n2 = -hx / size, -hy / size, 1.0 / size
    return (c[0] - s) * n0 + (c[1] - t) * n1 + (c[2] - h) * n2, n0, n1, n2, s, t, h


@part
def look_at_heights(n, low_x, high_x, low_y, high_y):
    """(bound that no height over the rectangle passes, bound of its second derivative along any line by the squares of meshes)."""
    along, across = np.int64(real(n[ALONG])), np.int64(real(n[ACROSS]))
    i = np.int64(max(0.0, min(along - 1.0, np.floor((low_x / real(n[WIDTH]) + 0.5) * (along - 1.0)))))
    j = np.int64(max(0.0, min(across - 1.0, np.floor((low_y / real(n[LENGTH]) + 0.5) * (across - 1.0)))))
    last_i = np.int64(max(0.0, min(along - 1.0, np.ceil((high_x / real(n[WIDTH]) + 0.5) * (along - 1.0)))))
    last_j = np.int64(max(0.0, min(across - 1.0, np.ceil((high_y / real(n[LENGTH]) + 0.5) * (across - 1.0)))))
    width = along + 2
    least, most, bend = np.inf, -np.inf, 0.0
    for row in range(j, last_j + 1):
        for column in range(i, last_i + 1):
            at = HEIGHTS + (row + 1) * width + column + 1
            z, left, right = real(n[at]), real(n[at - 1]), real(n[at + 1])
            down, up = real(n[at - width]), real(n[at + width])
            least = min(least, z, left, right, down, up)
            most = max(most, z, left, right, down, up)
            both = real(n[at + width + 1]) - up - right + z
            bend = max(bend, np.abs(left - 2.0 * z + right) + np.abs(down - 2.0 * z + up) + 2.0 * np.abs(both))
    return 0.5 * (least + most) + 0.5 * OVERSHOOT * (most - least), CUBIC * bend


@leaf
def mesh_of(ground):
    """The shorter side of a mesh [m]."""
    return min(real(ground[WIDTH]) / (real(ground[ALONG]) - 1.0), real(ground[LENGTH]) / (real(ground[ACROSS]) - 1.0))


@leaf
def meshes(n, p, q):
    """Meshes from a place to another one along the side of which these are more."""
    x, y = (q[0] - p[0]) / n[WIDTH] * (n[ALONG] - 1.0), (q[1] - p[1]) / n[LENGTH] * (n[ACROSS] - 1.0)
    return max(np.abs(real(x)), np.abs(real(y)))


# numbers of ground with heights, at first work of `nivel.elements.contacts.height_way`; END: a pose, MISSED: the deepest overlap [m] that
# fixed steps have passed, MISSED_AT [s], and SEEN: the deepest at their ends
END, MISSED, MISSED_AT, SEEN, GROUND = (law.NUMBERS + at for at in (0, 18, 19, 20, 21))


@stage
def normal_below(ground, B, o, c):
    """Normal of the ground below c, global axes."""
    d = seen(B, minus(c, o))
    _, hx, hy, _, _, _ = surface(ground, d[0], d[1])
    n = minus(axis(B, 2), plus(times(hx, axis(B, 0)), times(hy, axis(B, 1))))
    return times(1.0 / np.sqrt(1.0 + hx * hx + hy * hy), n)


@stage
def ball_of(machine, k):
    """Radius of the balls about the points of contact k, 0 of points."""
    elements = record_at(machine).elements
    columns = elements.columns[k]
    return real(ball_radius(columns[KIND], elements.number[k, columns[SHAPE] :]))


@stage
def find_point_over_ground(machine, k, n):
    """Where point n of contact k may touch and the normal there, left in the numbers; returns the overlap."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    i, j, kind, size = columns[law.MARKER], columns[law.OTHER], columns[KIND], numbers[columns[SHAPE] :]
    p, normal, ground = numbers[law.POINT : law.NORMAL], numbers[law.NORMAL : law.SPEED], numbers[GROUND:]
    r, A, o, B = markers.r[i], markers.A[i], markers.r[j], markers.A[j]
    below = axis(B, 2)
    if kind == CYLINDER:
        # the rim is lowest against the normal below its middle
        below = normal_below(ground, B, o, plus(r, times(size[1] * end_sign(n, 8), axis(A, 2))))
    shape_point(kind, A, r, size, n, below, p)
    distance, n0, n1, n2, _, _, _ = from_heights(ground, seen(B, minus(p, o)))
    radius = ball_radius(kind, size)
    put(normal, 0, turned(B, (n0, n1, n2)))
    if real(radius) > 0.0:
        # the force acts on the ground
        put(p, 0, minus(p, times(distance, normal)))
    return radius - distance


@element
def apply_over_heights(machine, k, columns, numbers, t):
    """A contact with ground whose height varies."""
    law.begin_contact(machine, k, t)
    if not is_above(machine, k, numbers[GROUND + HIGHEST]):
        o = 0.0 * numbers[law.SUMS]
        total = o, o, o
        for n in range(columns[law.COUNT]):
            depth = find_point_over_ground(machine, k, n)
            if law.needs_speed(machine, k, n, depth):
                law.note_speed(machine, k, law.mean_speed(machine, k, n))
            total = plus(total, times(law.press(machine, k, n, depth, t), numbers[law.NORMAL : law.SPEED]))
        squared = dot(total, total)
        if real(squared) > 0.0:
            put(numbers, law.NORMAL, times(1.0 / np.sqrt(squared), total))
    law.report_contact(machine, k)


def points_over_heights(force: Contact, bodies: Sequence[Touching]) -> law.Points:
    """Of a shape on ground with heights."""
    assert force.heights is not None
    kind, count, size = ground_shape(bodies[0], corners_of_parts)
    work = [0.0] * (GROUND - law.NUMBERS)
    numbers = [*work, *numbers_of(force.heights.heights, force.heights.size)]
    return law.Points(count, ball_of_shape(bodies[0]), [kind, law.NUMBERS + len(numbers)], numbers + size)
