"""Points of shapes on a plane, and of two spheres.

A sphere and a capsule touch with the balls about their centre and their ends, a box and a hull with their corners. A cylinder touches with
four points of each rim, the lowest one and those a quarter turn on, so it rolls on exact circles and stands on four feet. Of a ball the
force acts on the ground.
"""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.elements.contacts.law import (
    COLUMNS,
    MARKER,
    NORMAL,
    NUMBERS,
    OTHER,
    POINT,
    RADIUS,
    SPEED,
    Points,
    is_apart,
    is_far,
    pair,
)
from nivel.elements.contacts.shapes import ball_of_shape, corners_of
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus, put, times, turned
from nivel.kernels.forces.wrench import velocity_at
from nivel.kernels.record.record import record_at
from nivel.known import Contact
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import box_size
from nivel.machine.bodies.solids import length as bar_length
from nivel.machine.bodies.touching import Touching
from nivel.native.function import leaf, stage

# columns of the pair. KIND: of the shape; SHAPE: where its numbers begin, behind those of ground with heights
KIND, SHAPE = COLUMNS, COLUMNS + 1
# kinds, and numbers of the shape: radius; half lengths; radius and half length; corners in its axes, three numbers each; radius and half
# length
SPHERE, BOX, CYLINDER, HULL, CAPSULE = 0, 1, 2, 3, 4
# A cylinder whose axis is as near to the normal, by the square of the sine, stands.
UPRIGHT = 1e-3
# A shape is far from a plane if its ball is by this share of its radius: then the distance of the ball stands for that of all its points.
FAR = 0.5


@leaf
def end_sign(n, count):
    """1 of the first half of `count` points along z, -1 of the others."""
    return 1.0 if 2 * n < count else -1.0


@stage
def rim_direction(A, n, normal):
    """Cosine and sine from the x axis of point n of a rim: the direction that points most against the normal, and its quarter turns."""
    c, s = -dot(normal, axis(A, 0)), -dot(normal, axis(A, 1))
    length = np.sqrt(c * c + s * s)
    if real(length) > 1e-12:
        c, s = c / length, s / length
    else:
        c, s = 0.0 * length + 1.0, 0.0 * length
    quarter = n % 4
    if quarter == 1:
        return -s, c
    if quarter == 2:
        return -c, -s
    return (s, -c) if quarter == 3 else (c, s)


@stage
def shape_point(kind, A, r, size, n, normal, p):
    """p := point n of a shape of this kind at r, in global axes; of a cylinder over ground with this normal."""
    o = 0.0 * r[0]
    x, y, z = o, o, o
    if kind == BOX:
        x = o + (size[0] if n % 2 == 0 else -size[0])
        y = o + (size[1] if (n // 2) % 2 == 0 else -size[1])
        z = o + size[2] * end_sign(n, 8)
    elif kind == CYLINDER:
        c, s = rim_direction(A, n, normal)
        x, y, z = size[0] * c, size[0] * s, o + size[1] * end_sign(n, 8)
    elif kind == HULL:
        x, y, z = o + size[3 * n], o + size[3 * n + 1], o + size[3 * n + 2]
    elif kind == CAPSULE:
        z = o + size[1] * end_sign(n, 2)
    put(p, 0, plus(r, turned(A, (x, y, z))))


@stage
def ball_radius(kind, size):
    """Radius of the balls about the points of a shape, 0 of points."""
    return size[0] if kind in (SPHERE, CAPSULE) else 0.0 * size[0]


@stage
def speed_of_rim_point(machine, i, j, p, normal):
    """Velocity of the point of a rim itself, at p, of the cylinder of marker i that rolls on the plane of marker j."""
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    w, W, a = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]], axis(markers.A[i], 2)
    sigma = dot(a, normal)
    if not real(sigma * sigma) < 1.0 - UPRIGHT:
        return velocity_at(bodies, markers.body[i], p)
    # the axis and the direction to the lowest point of a rim turn with this velocity
    turning, t = cross(minus(w, W), a), cross(a, normal)
    spin = -sigma / (1.0 - sigma * sigma) * dot(t, turning)
    v = plus(W, plus(cross(a, turning), times(spin, a)))
    return plus(markers.rdot[i], cross(v, minus(p, markers.r[i])))


@stage
def is_above(machine, k, highest):
    """Whether the ball around the shape of contact k is far above this height over the plane: then its distance stands for all points."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    i, j, radius = columns[MARKER], columns[OTHER], numbers[RADIUS]
    n, d = axis(markers.A[j], 2), minus(markers.r[i], markers.r[j])
    gap = dot(n, d) - radius - highest
    if not real(gap) > FAR * real(radius):
        return False
    speed = minus(minus(markers.rdot[i], markers.rdot[j]), cross(record.bodies.omega[markers.body[j]], d))
    return is_apart(machine, k, gap, -dot(n, speed))


@stage
def speed_of_ball_point(machine, i, j, z, normal):
    """Velocity of the point itself below a ball of the body of marker i, whose centre is z along its z axis, on the plane of marker j."""
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    arm = times(z, axis(markers.A[i], 2))
    d = minus(plus(markers.r[i], arm), markers.r[j])
    own = plus(markers.rdot[i], cross(bodies.omega[markers.body[i]], arm))
    W = bodies.omega[markers.body[j]]
    out, turning = dot(normal, minus(minus(own, markers.rdot[j]), cross(W, d))), cross(W, normal)
    return minus(own, plus(times(out, normal), times(dot(normal, d), turning)))


@stage
def speed_over_plane(machine, k, n):
    """Velocity of point n of contact k itself: of a corner that of the body; what rolls passes it on."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    i, j, kind, p = columns[MARKER], columns[OTHER], columns[KIND], numbers[POINT:NORMAL]
    normal = numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]
    if kind == SPHERE:
        return speed_of_ball_point(machine, i, j, 0.0 * p[0], normal)
    if kind == CAPSULE:
        return speed_of_ball_point(machine, i, j, numbers[NUMBERS + 1] * end_sign(n, 2), normal)
    if kind == CYLINDER:
        return speed_of_rim_point(machine, i, j, p, normal)
    return velocity_at(record.bodies, markers.body[i], p)


@stage
def is_above_plane(machine, k):
    """Whether the ball around the shape of contact k is far above the plane."""
    return is_above(machine, k, 0.0)


@pair(is_above_plane, speed_over_plane)
def apply(machine, k, n):
    """A shape over a plane: where point n may touch."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    i, j, kind = columns[MARKER], columns[OTHER], columns[KIND]
    p, normal, size = numbers[POINT:NORMAL], numbers[NORMAL:SPEED], numbers[NUMBERS:]
    put(normal, 0, axis(markers.A[j], 2))
    shape_point(kind, markers.A[i], markers.r[i], size, n, normal, p)
    height, radius = dot(minus(p, markers.r[j]), normal), ball_radius(kind, size)
    if kind in (SPHERE, CAPSULE):
        put(p, 0, minus(p, times(height, normal)))
    return radius - height


@stage
def find_point_of_spheres(r, o, numbers, radius, other):
    """Point and normal between two spheres at r and o, left in the numbers of their contact; returns the overlap."""
    d = minus(r, o)
    distance = np.sqrt(dot(d, d))
    depth = radius + other - distance
    if real(distance) == 0.0:
        d, distance = (d[0], d[1], d[2] + 1.0), distance + 1.0  # any direction will do
    normal = d[0] / distance, d[1] / distance, d[2] / distance
    put(numbers, NORMAL, normal)
    put(numbers, POINT, plus(o, times(other - 0.5 * depth, normal)))
    return depth


@stage
def speed_between_spheres(machine, k, n):
    """Velocity of the point itself between the two spheres of contact k."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    i, j = columns[MARKER], columns[OTHER]
    normal, o = numbers[NORMAL:SPEED], markers.r[j]
    d, speed = minus(markers.r[i], o), minus(markers.rdot[i], markers.rdot[j])
    # p - o = s n, s half of the way between both surfaces
    out, distance, s = dot(normal, speed), dot(normal, d), dot(normal, minus(numbers[POINT:NORMAL], o))
    a, b = s / distance, (0.5 - s / distance) * out
    return plus(markers.rdot[j], plus(times(a, speed), times(b, normal)))


@pair(is_far, speed_between_spheres)
def apply_to_spheres(machine, k, n):
    """Two spheres: where they may touch."""
    record = record_at(machine)
    columns, numbers, r = record.elements.columns[k], record.elements.number[k], record.markers.r
    return find_point_of_spheres(r[columns[MARKER]], r[columns[OTHER]], numbers, numbers[NUMBERS], numbers[NUMBERS + 1])


def ground_shape(body: Touching, corners: Callable[[Touching], NDArray[np.float64]]) -> tuple[int, int, list[float]]:
    """Kind, number of points and numbers of a shape; `corners` of an extrusion or a mesh."""
    match body.shape:
        case Sphere():
            return SPHERE, 1, [body.shape.radius]
        case Box():
            return BOX, 8, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return CYLINDER, 8, [body.shape.radius, 0.5 * bar_length(body.shape)]
        case Capsule():
            return CAPSULE, 2, [body.shape.radius, 0.5 * bar_length(body.shape)]
        case Extrusion() | Mesh():
            found = corners(body)
            return HULL, len(found), found.ravel().tolist()
    raise ValueError(f"{body.name} has no shape that can touch")


def points_over_plane(force: Contact, bodies: Sequence[Touching]) -> Points:
    """Of a shape on a plane."""
    kind, count, size = ground_shape(bodies[0], corners_of)
    return Points(count, ball_of_shape(bodies[0]), [kind], size)


def points_of_spheres(force: Contact, bodies: Sequence[Touching]) -> Points:
    """Of two spheres."""
    radii = [ball_of_shape(body) for body in bodies]
    return Points(1, sum(radii), [], radii)
