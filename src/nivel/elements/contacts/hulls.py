"""Contact of two convex hulls by their fields of pressure, see `nivel.elements.contacts.pressure_cells`.

The elastic force of all pressures has a direction, the normal N of the contact. At every point the pressure is damped: p (1 + a v), v
the speed along N at which the bodies approach there; it never pulls (Hunt & Crossley 1975). Friction: μ times the pressure along N, times
tanh(v/v_s), against the sliding velocity at the point. So a body that slides without turning feels μ times the normal force.

Or the friction of all points is that of a patch, which sticks: `nivel.kernels.elements.patch`.

Sums over a polygon are those of the triangles around its middle, by Gauss's three points; of an elastic pressure this is exact.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.contacts.law import SURFACE_NUMBERS, find_surface, place_patch, velocity_at
from nivel.elements.contacts.pressure_cells import (
    along_plane,
    bound_cap,
    depth_under,
    meet,
    nearest_faces,
    overlap_under,
    whole,
)
from nivel.elements.contacts.shapes import Hull
from nivel.kernels.algebra.analytic import maximum, minimum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import leave_patch, middle_of, plus
from nivel.kernels.elements.touch import DEPTH, FORCE, RATE, leave_touch, write_touch
from nivel.kernels.elements.touch import RUB as FRICTION_FORCE
from nivel.kernels.elements.touch import SLIP as SLIP_SPEED
from nivel.kernels.forces.wrench import add_force_at, add_torque
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.known import Contact
from nivel.native.function import leaf, stage

# columns of `columns`; MARKER, OTHER: axes of the two hulls; counts of their corners and faces; the patch as in
# `nivel.elements.contacts.law`, and the surface; then EDGES of the first hull, two corners each, as many numbers as FIRST_EDGES says,
# and those of the second
OUTPUT, MARKER, OTHER, CORNERS, OTHER_CORNERS, FACES, OTHER_FACES, FIRST_EDGES, SECOND_EDGES = range(9)
PATCH, AXES, COORDINATE, SURFACE, EDGES = 9, 10, 11, 12, 15
# columns of `number`; TRANSITION: 0 where friction is that of a patch. Then work: place of the second hull in axes of the first, velocity
# and angular velocity relative to the first at its origin, sums (normal force and its torque, friction and its torque, or what the patch is
# made of), a box, a plane, the normal of the contact from first to second, velocity of the
# second one's surface over it, the moving surface
FIELD, DAMPING, FRICTION, TRANSITION, RADIUS, OTHER_RADIUS = range(6)
TURN, SHIFT, SPEED, SPIN, PUSH, PUSH_TORQUE, RUB, RUB_TORQUE, BOX, PLANE, NORMAL = (
    6, 15, 18, 21, 24, 27, 30, 33, 36, 42, 54,
)  # fmt: skip
# then the corners of the first hull (3 each), all faces (4 each), those of the second as seen from the first, which is work; corners
# and faces of the second in its own axes; work: its corners as seen from the first, rows of the nearest faces, two polygons
OVER, MOVING = 57, 60
NUMBERS = MOVING + SURFACE_NUMBERS
# The second hull is larger by this share of the sizes, so that of two faces in one plane the nearest is never in doubt.
APART = 1e-13


@leaf
def places(columns):
    """Where the corners of the first hull begin, all faces, corners and faces of the second in its axes, its corners, rows, polygons."""
    first = NUMBERS
    faces = first + 3 * np.int64(columns[CORNERS])
    corners = faces + 4 * (np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES]))
    others = corners + 3 * np.int64(columns[OTHER_CORNERS])
    seen = others + 4 * np.int64(columns[OTHER_FACES])
    rows = seen + 3 * np.int64(columns[OTHER_CORNERS])
    polygons = rows + np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])
    return first, faces, corners, others, seen, rows, polygons


@leaf
def turn(A, x, y, z):
    """A (x, y, z), A (9,) by rows."""
    return (
        A[0] * x + A[1] * y + A[2] * z,
        A[3] * x + A[4] * y + A[5] * z,
        A[6] * x + A[7] * y + A[8] * z,
    )


@leaf
def place_second(columns, n):
    """Corners and faces of the second hull in the axes of the first."""
    _, faces, corners, others, seen, _, _ = places(columns)
    A = n[TURN:SHIFT]
    for k in range(columns[OTHER_CORNERS]):
        p, q = corners + 3 * k, seen + 3 * k
        x, y, z = turn(A, n[p], n[p + 1], n[p + 2])
        n[q], n[q + 1], n[q + 2] = n[SHIFT] + x, n[SHIFT + 1] + y, n[SHIFT + 2] + z
    apart = APART * (n[RADIUS] + n[OTHER_RADIUS])
    for k in range(columns[OTHER_FACES]):
        p, q = others + 4 * k, faces + 4 * (np.int64(columns[FACES]) + k)
        x, y, z = turn(A, n[p], n[p + 1], n[p + 2])
        n[q], n[q + 1], n[q + 2] = x, y, z
        n[q + 3] = n[p + 3] + apart + x * n[SHIFT] + y * n[SHIFT + 1] + z * n[SHIFT + 2]


@leaf
def velocity(n, x, y, z):
    """Velocity relative to the first hull of the point of the second one at (x, y, z)."""
    return (
        n[SPEED] + n[SPIN + 1] * z - n[SPIN + 2] * y,
        n[SPEED + 1] + n[SPIN + 2] * x - n[SPIN] * z,
        n[SPEED + 2] + n[SPIN] * y - n[SPIN + 1] * x,
    )


@leaf
def least_overlap(columns, n):
    """(overlap along the normal of the face under which the other hull is least deep, its rate, the row of that face). Negative: apart."""
    first, faces, _, _, seen, _, _ = places(columns)
    least, face, corner, own = overlap_under(n, faces, seen, columns[OTHER_CORNERS])[0] + np.inf, faces, seen, True
    for k in range(np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])):
        of_first = k < columns[FACES]
        overlap, at = overlap_under(
            n,
            faces + 4 * k,
            seen if of_first else first,
            columns[OTHER_CORNERS] if of_first else columns[CORNERS],
        )
        if real(overlap) < real(least):
            least, face, corner, own = overlap, faces + 4 * k, at, of_first
    v0, v1, v2 = velocity(n, n[corner], n[corner + 1], n[corner + 2])
    rate = n[face] * v0 + n[face + 1] * v1 + n[face + 2] * v2
    return least, -rate if own else rate, face


@leaf
def find_faces(columns, n, face):
    """The box that holds the overlap, and rows of the faces that may be nearest in it, which it returns the number of."""
    first, faces, _, _, seen, rows, _ = places(columns)
    ends, size = EDGES + np.int64(columns[FIRST_EDGES]), real(n[RADIUS]) + real(n[OTHER_RADIUS])
    count = np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])
    if face < faces + 4 * np.int64(columns[FACES]):
        edges = columns[ends : ends + np.int64(columns[SECOND_EDGES])]
        bound_cap(n, face, seen, columns[OTHER_CORNERS], edges, size, n[BOX:PLANE])
    else:
        bound_cap(n, face, first, columns[CORNERS], columns[EDGES:ends], size, n[BOX:PLANE])
    return nearest_faces(n, faces, count, n[BOX:PLANE], n[rows : rows + count])


# what polygons are asked for
STORE, PRESS, RUB_ALONG = 0, 1, 2
# Gauss's points of a triangle, by the shares of its corners
NEAR, FAR = 2.0 / 3.0, 1.0 / 6.0
# [m] hulls that overlap by less than round-off are apart by this
TOUCH = 1e-30


@stage
def see(machine, k, t):
    """Place and motion of the second hull and its surface in the axes of the first; returns the distance of their middles."""
    record = record_at(machine)
    markers, bodies, n, columns = record.markers, record.bodies, record.elements.number[k], record.elements.columns[k]
    i, j = record.elements.columns[k, MARKER], record.elements.columns[k, OTHER]
    A, B, r = markers.A[i], markers.A[j], markers.r[i]
    a0, a1, a2 = velocity_at(bodies, markers.body[i], r)
    b0, b1, b2 = velocity_at(bodies, markers.body[j], r)
    v0, v1, v2 = b0 - a0, b1 - a1, b2 - a2
    w, u = bodies.omega[markers.body[j]], bodies.omega[markers.body[i]]
    distance = 0.0 * v0
    for a in range(3):
        n[SHIFT + a], n[SPEED + a], n[SPIN + a] = 0.0 * v0, A[0, a] * v0 + A[1, a] * v1 + A[2, a] * v2, 0.0 * v0
        for b in range(3):
            n[SHIFT + a] += A[b, a] * (markers.r[j, b] - r[b])
            n[SPIN + a] += A[b, a] * (w[b] - u[b])
            n[TURN + 3 * a + b] = A[0, a] * B[0, b] + A[1, a] * B[1, b] + A[2, a] * B[2, b]
        distance += n[SHIFT + a] * n[SHIFT + a]
    if columns[SURFACE] != NONE:
        find_surface(machine, columns[SURFACE:], n[MOVING:], t)
        for a in range(3):
            n[OVER + a] = A[0, a] * n[MOVING] + A[1, a] * n[MOVING + 1] + A[2, a] * n[MOVING + 2]
    return np.sqrt(distance)


@leaf
def length_of(n, first):
    """Length of a vector, 0 of none."""
    squared = n[first] * n[first] + n[first + 1] * n[first + 1] + n[first + 2] * n[first + 2]
    return np.sqrt(squared) if real(squared) > 0.0 else 0.0 * squared


@leaf
def clear(n):
    """The sums of forces := 0."""
    for k in range(PUSH, BOX):
        n[k] = 0.0 * n[FIELD]


@leaf
def add_to(n, sums, x, y, z, f0, f1, f2):
    """Add a force at a point to the sums of force and torque that begin at `sums`."""
    n[sums] += f0
    n[sums + 1] += f1
    n[sums + 2] += f2
    n[sums + 3] += y * f2 - z * f1
    n[sums + 4] += z * f0 - x * f2
    n[sums + 5] += x * f1 - y * f0


@leaf
def slip_at(n, v0, v1, v2):
    """Velocity with which the second surface slides over the first, where the second body moves relative to the first."""
    N = n[NORMAL : NORMAL + 3]
    x, y, z = v0 + n[OVER], v1 + n[OVER + 1], v2 + n[OVER + 2]
    out = x * N[0] + y * N[1] + z * N[2]
    return x - out * N[0], y - out * N[1], z - out * N[2]


@leaf
def rub_at(n, weight, x, y, z):
    """Add what damping and friction do where an elastic pressure pushes the second hull with the force `weight` against the normal of the
    plane; returns the power that is lost."""
    m, N = n[PLANE + 6 : PLANE + 9], n[NORMAL : NORMAL + 3]
    v0, v1, v2 = velocity(n, x, y, z)
    rate = -(N[0] * v0 + N[1] * v1 + N[2] * v2)
    damping = weight * maximum(n[DAMPING] * rate, -1.0 + 0.0 * rate)
    add_to(n, PUSH, x, y, z, -damping * m[0], -damping * m[1], -damping * m[2])
    loss = damping * (m[0] * v0 + m[1] * v1 + m[2] * v2)
    if real(n[FRICTION]) > 0.0 and real(n[TRANSITION]) == 0.0:
        force = -(weight + damping) * (m[0] * N[0] + m[1] * N[1] + m[2] * N[2])
        sums = n[RUB:BOX]
        sums[0] += force
        sums[1] += force * x
        sums[2] += force * y
        sums[3] += force * z
        sums[4] += force * (x * x + y * y + z * z)
    elif real(n[FRICTION]) > 0.0:
        s0, s1, s2 = slip_at(n, v0, v1, v2)
        squared = s0 * s0 + s1 * s1 + s2 * s2
        along = -(m[0] * N[0] + m[1] * N[1] + m[2] * N[2])
        if real(squared) > 0.0 and real(along) > 0.0:
            speed = np.sqrt(squared)
            friction = n[FRICTION] * (weight + damping) * along * tanh(speed / n[TRANSITION])
            loss += friction * speed
            friction = -friction / speed
            add_to(n, RUB, x, y, z, friction * s0, friction * s1, friction * s2)
    return loss


@leaf
def press_polygon(n, polygon, count, d, job, stretch):
    """(energy, power lost, largest distance d) of a polygon. d : as `along_plane` has it; stretch : |n₂ - n₁|.

    job : STORE, which adds no force; PRESS, the elastic pressure between cells of the two bodies; or RUB_ALONG, damping and friction.
    """
    d0, du, dv = d
    frame = n[PLANE:NORMAL]
    m = frame[6:9]
    middle_u, middle_v = n[polygon], n[polygon + 1]
    for k in range(1, count):
        middle_u, middle_v = middle_u + n[polygon + 2 * k], middle_v + n[polygon + 2 * k + 1]
    middle_u, middle_v = middle_u / count, middle_v / count
    middle = d0 + du * middle_u + dv * middle_v
    energy, loss, deepest = 0.0 * d0, 0.0 * d0, middle
    p = polygon + 2 * (count - 1)
    for k in range(count):
        q = polygon + 2 * k
        u1, v1, u2, v2 = n[p], n[p + 1], n[q], n[q + 1]
        d1, d2 = d0 + du * u1 + dv * v1, d0 + du * u2 + dv * v2
        area = 0.5 * ((u1 - middle_u) * (v2 - middle_v) - (v1 - middle_v) * (u2 - middle_u))
        energy += n[FIELD] / 12.0 * stretch * area * (middle * (middle + d1 + d2) + d1 * (d1 + d2) + d2 * d2)
        if real(d2) > real(deepest):
            deepest = d2
        if job != STORE:
            share = n[FIELD] * area / 3.0
            for g in range(3):
                b0, b1, b2 = NEAR if g == 0 else FAR, NEAR if g == 1 else FAR, NEAR if g == 2 else FAR
                weight = share * (b0 * middle + b1 * d1 + b2 * d2)
                u, v = b0 * middle_u + b1 * u1 + b2 * u2, b0 * middle_v + b1 * v1 + b2 * v2
                x = frame[9] + u * frame[0] + v * frame[3]
                y = frame[10] + u * frame[1] + v * frame[4]
                z = frame[11] + u * frame[2] + v * frame[5]
                if job == PRESS:
                    add_to(n, PUSH, x, y, z, -weight * m[0], -weight * m[1], -weight * m[2])
                else:
                    loss += rub_at(n, weight, x, y, z)
        p = q
    return energy, loss, deepest


@leaf
def press(columns, n, count, floor, job):
    """(energy, power lost, largest distance d ≥ floor) of all polygons, whose forces are added to the sums in the numbers.

    job : as for `press_polygon`; of PRESS the polygons between cells of one body have energy alone, of RUB_ALONG they are left out.
    """
    _, faces, _, _, _, rows, polygons = places(columns)
    found, box, frame = n[rows : rows + count], n[BOX:PLANE], n[PLANE:NORMAL]
    second = faces + 4 * np.int64(columns[FACES])
    energy, loss, deepest = 0.0 * n[FIELD], 0.0 * n[FIELD], 0.0 * n[FIELD] + floor
    for k in range(count):
        i = whole(found[k])
        for other in range(k + 1, count):
            j = whole(found[other])
            is_between = i < second <= j
            if job == RUB_ALONG and not is_between:
                continue
            stretch, corners, polygon = meet(n, i, j, found, count, box, floor, frame, polygons)
            if corners > 0:
                its = press_polygon(
                    n, polygon, corners, along_plane(n, i, frame), job if is_between else STORE, stretch
                )
                energy, loss = energy + its[0], loss + its[1]
                if real(its[2]) > real(deepest):
                    deepest = its[2]
    return energy, loss, deepest


@leaf
def gap_of_edges(columns, n):
    """Twice the largest distance d where edges alone keep the hulls apart: negative."""
    _, faces, _, _, _, rows, _ = places(columns)
    count = np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])
    size, floor = real(n[RADIUS]) + real(n[OTHER_RADIUS]), -TOUCH
    for a in range(3):
        n[BOX + a], n[BOX + 3 + a] = 0.5 * n[SHIFT + a] - 2.0 * size, 0.5 * n[SHIFT + a] + 2.0 * size
    for k in range(count):
        n[rows + k] = faces + 4 * k
        # the distance of any point is a bound
        here = depth_under(n, faces + 4 * k, 0.5 * n[SHIFT], 0.5 * n[SHIFT + 1], 0.5 * n[SHIFT + 2])
        floor = min(floor, real(here))
    gap = 2.0 * press(columns, n, count, floor, STORE)[2]
    return minimum(gap, 0.0 * gap - TOUCH)


@leaf
def push_elastically(columns, n, face):
    """(energy, largest distance d, speed of approach along the normal, size of the force, number of faces) of the elastic pressure."""
    count = find_faces(columns, n, face)
    clear(n)
    energy, _, deepest = press(columns, n, count, 0.0, PRESS)
    force = length_of(n, PUSH)
    rate = 0.0 * force
    if real(force) > 0.0:
        for a in range(3):
            n[NORMAL + a] = n[PUSH + a] / force
            rate -= n[PUSH + a] * n[SPEED + a] + n[PUSH_TORQUE + a] * n[SPIN + a]
        rate /= force
    return energy, deepest, rate, force, count


@leaf
def overlap(columns, n, distance, is_apart):
    """(depth, rate, energy, power lost); the sums of forces stand in the numbers.

    depth : twice the distance from the deepest common point to the nearest face; negative while the hulls are apart.
    is_apart : no force yet, although they may overlap.
    """
    nothing = 0.0 * n[FIELD]
    clear(n)
    far = distance - n[RADIUS] - n[OTHER_RADIUS]
    if real(far) > 0.0:
        speed = n[SHIFT] * n[SPEED] + n[SHIFT + 1] * n[SPEED + 1] + n[SHIFT + 2] * n[SPEED + 2]
        return -far, -speed / distance, nothing, nothing
    place_second(columns, n)
    depth, rate, face = least_overlap(columns, n)
    if real(depth) <= 0.0:
        return depth, rate, nothing, nothing
    energy, deepest, its_rate, force, count = push_elastically(columns, n, face)
    if real(deepest) <= 0.0:
        return gap_of_edges(columns, n), rate, nothing, nothing
    if is_apart:
        clear(n)
        return 2.0 * deepest, its_rate, nothing, nothing
    loss = nothing
    if real(force) > 0.0 and (real(n[DAMPING]) > 0.0 or real(n[FRICTION]) > 0.0):
        loss = press(columns, n, count, 0.0, RUB_ALONG)[1]
    return 2.0 * deepest, its_rate, energy, loss


@stage
def find_patch(machine, k):
    """The patch of contact k, from its sums, which are clear then; returns its middle."""
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    columns, n = record.elements.columns[k], record.elements.number[k]
    i, j, sums, p = columns[MARKER], columns[OTHER], n[RUB:BOX], middle_of_push(machine, k)
    if real(sums[0]) > 0.0:
        A = markers.A[i]
        d, reach = middle_of(sums)
        d, normal = turned(A, d), turned(A, (-n[NORMAL], -n[NORMAL + 1], -n[NORMAL + 2]))
        p = plus(markers.r[i], d)
        v, w = velocity_at(bodies, markers.body[i], p), velocity_at(bodies, markers.body[j], p)
        pdot = 0.5 * (v[0] + w[0]), 0.5 * (v[1] + w[1]), 0.5 * (v[2] + w[2])
        place_patch(machine, columns[PATCH:], n[MOVING:], i, j, sums[0], d, reach, normal, pdot)
    else:
        leave_patch(machine, np.int64(columns[PATCH]), np.int64(columns[AXES]), np.int64(columns[COORDINATE]))
    for a in range(6):
        sums[a] = 0.0 * n[FIELD]
    return p


@stage
def middle_of_push(machine, k):
    """The point of the normal force's line that is next to the middle of the overlap."""
    record = record_at(machine)
    n, i = record.elements.number[k], record.elements.columns[k, MARKER]
    F, T = n[PUSH:PUSH_TORQUE], n[PUSH_TORQUE:RUB]
    squared = dot(F, F)
    x = 0.0 * squared, 0.0 * squared, 0.0 * squared
    if real(squared) > 0.0:
        x = cross(F, T)
        along = 0.0 * squared
        for a in range(3):
            along += F[a] * 0.5 * (n[BOX + a] + n[BOX + 3 + a])
        x = (x[0] + along * F[0]) / squared, (x[1] + along * F[1]) / squared, (x[2] + along * F[2]) / squared
    return plus(record.markers.r[i], turned(record.markers.A[i], x))


@leaf
def turned(A, d):
    """A d."""
    x = A[0, 0] * d[0] + A[0, 1] * d[1] + A[0, 2] * d[2]
    y = A[1, 0] * d[0] + A[1, 1] * d[1] + A[1, 2] * d[2]
    return x, y, A[2, 0] * d[0] + A[2, 1] * d[1] + A[2, 2] * d[2]


@leaf
def speed_of_slip(n):
    """Speed across the normal at the middle of the normal force, between the two bodies."""
    F, T = n[PUSH:PUSH_TORQUE], n[PUSH_TORQUE:RUB]
    squared = dot(F, F)
    p = cross(F, T)
    v = velocity(n, p[0] / squared, p[1] / squared, p[2] / squared)
    s = slip_at(n, v[0], v[1], v[2])
    square = dot(s, s)
    return np.sqrt(square) if real(square) > 0.0 else 0.0 * square


@stage
def push(machine, k):
    """Put the sums of forces on both bodies; returns their power."""
    record = record_at(machine)
    markers, bodies, n = record.markers, record.bodies, record.elements.number[k]
    i, j = record.elements.columns[k, MARKER], record.elements.columns[k, OTHER]
    A, r = markers.A[i], markers.r[i]
    F, T, f, t = n[PUSH:PUSH_TORQUE], n[PUSH_TORQUE:RUB], n[RUB:RUB_TORQUE], n[RUB_TORQUE:BOX]
    x, y, z = F[0] + f[0], F[1] + f[1], F[2] + f[2]
    p, q, s = T[0] + t[0], T[1] + t[1], T[2] + t[2]
    F0 = A[0, 0] * x + A[0, 1] * y + A[0, 2] * z
    F1 = A[1, 0] * x + A[1, 1] * y + A[1, 2] * z
    F2 = A[2, 0] * x + A[2, 1] * y + A[2, 2] * z
    T0 = A[0, 0] * p + A[0, 1] * q + A[0, 2] * s
    T1 = A[1, 0] * p + A[1, 1] * q + A[1, 2] * s
    T2 = A[2, 0] * p + A[2, 1] * q + A[2, 2] * s
    power = add_force_at(bodies, markers.body[j], r, F0, F1, F2) + add_torque(bodies, markers.body[j], T0, T1, T2)
    power += add_force_at(bodies, markers.body[i], r, -F0, -F1, -F2)
    return power + add_torque(bodies, markers.body[i], -T0, -T1, -T2)


@family
def apply(machine, number, t):
    """All contacts of two hulls."""
    record = record_at(machine)
    elements, control, followed = record.elements, record.control, record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        columns, n = elements.columns[k], elements.number[k]
        distance = see(machine, k, t)
        # where steps end at a touch, the hulls touch from the next accepted state on
        depth, rate, energy, loss = overlap(columns, n, distance, followed == 1 and elements.memory[k, 0] == 0.0)
        elements.depth[k, 0], elements.proposal[k, 0] = depth, 0.0 * depth + (1.0 if real(depth) > 0.0 else 0.0)
        if followed == 1:
            elements.depth_rate[k, 0] = rate
        normal, power, slip = length_of(n, PUSH), 0.0 * depth, 0.0 * depth
        given, first = 0.0 * depth, columns[OUTPUT]
        p = middle_of_push(machine, k) if columns[PATCH] == NONE else find_patch(machine, k)
        if real(normal) > 0.0:
            power, slip = push(machine, k), speed_of_slip(n)
            given, spun = -dot(n[RUB:RUB_TORQUE], n[OVER:MOVING]), dot(n[RUB_TORQUE:BOX], n[SPIN:PUSH])
            rubbed = given - dot(n[RUB:RUB_TORQUE], n[SPEED:SPIN]) - spun
            A = record.markers.A[columns[MARKER]]
            N = turned(A, (-n[NORMAL], -n[NORMAL + 1], -n[NORMAL + 2]))
            drag = turned(A, (-n[RUB], -n[RUB + 1], -n[RUB + 2]))
            write_touch(machine, first, p, N, drag, rubbed, given)
        else:
            leave_touch(machine, first)
        control.power[0] += given
        control.stored[0] += energy
        control.power[1] += loss
        out = record.outputs.value
        out[first + DEPTH], out[first + FORCE], out[first + RATE] = depth, normal, rate
        out[first + FRICTION_FORCE], out[first + SLIP_SPEED] = length_of(n, RUB), slip
        for a in range(3):
            n[PUSH + a] += n[RUB + a]
        out[first], out[first + 1] = length_of(n, PUSH), power
    return OK


def row_of(hulls: tuple[Hull, Hull], force: Contact, patch: list[int]) -> tuple[list[int], list[float]]:
    """Columns behind the markers, and numbers, of a contact with this patch: see above."""
    first, second = hulls
    counts = (
        [len(each.corners) for each in hulls]
        + [len(each.faces) for each in hulls]
        + [each.edges.size for each in hulls]
    )
    modulus = force.foundation_modulus or 0.0
    speed = 0.0 if force.sticks else force.friction_transition_speed or 1.0
    # pressure of both bodies at the same depth: half the overlap each
    numbers = [2.0 * modulus, force.damping or 0.0, force.friction, speed, first.radius, second.radius]
    numbers += [0.0] * (NUMBERS - len(numbers))
    numbers += [*first.corners.ravel(), *first.faces.ravel(), *np.zeros(second.faces.size)]
    numbers += [*second.corners.ravel(), *second.faces.ravel(), *np.zeros(second.corners.size)]
    faces = len(first.faces) + len(second.faces)
    numbers += [0.0] * (faces + 4 * (faces + 4))
    return [*counts, *patch, *first.edges.ravel().tolist(), *second.edges.ravel().tolist()], [
        float(each) for each in numbers
    ]
