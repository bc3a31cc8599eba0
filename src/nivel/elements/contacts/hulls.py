"""Contact of two convex hulls by their fields of pressure, see `nivel.elements.contacts.pressure_cells`.

The elastic force of all pressures has a direction, the normal N of the contact. At every point the pressure is damped: p (1 + a v), v
the speed along N at which the bodies approach there; it never pulls (Hunt & Crossley 1975). Friction: μ times the pressure along N, times
tanh(v/v_s), against the sliding velocity at the point. So a body that slides without turning feels μ times the normal force.

Or the friction of all points is that of a patch, which sticks: `nivel.kernels.elements.patch`.

Sums over a polygon are those of the triangles around its middle, by Gauss's three points; of an elastic pressure this is exact.
"""

import numpy as np

from nivel.elements.contacts.law import SURFACE_NUMBERS, find_surface, mean_of, place_patch
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
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import maximum, minimum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, opposite, plus, put, seen, times, turned, turned_flat
from nivel.kernels.elements.patch import leave_patch, middle_of
from nivel.kernels.elements.touch import DEPTH, FORCE, RATE, leave_touch, write_touch
from nivel.kernels.elements.touch import RUB as FRICTION_FORCE
from nivel.kernels.elements.touch import SLIP as SLIP_SPEED
from nivel.kernels.forces.wrench import add_force_at, add_torque, velocity_at
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
def place_second(columns, n):
    """Corners and faces of the second hull in the axes of the first."""
    _, faces, corners, others, seen, _, _ = places(columns)
    A, shift = n[TURN:SHIFT], n[SHIFT:SPEED]
    for k in range(columns[OTHER_CORNERS]):
        put(n, seen + 3 * k, plus(shift, turned_flat(A, n[corners + 3 * k :])))
    apart = APART * (n[RADIUS] + n[OTHER_RADIUS])
    for k in range(columns[OTHER_FACES]):
        p, q = others + 4 * k, faces + 4 * (np.int64(columns[FACES]) + k)
        x, y, z = turned_flat(A, n[p:])
        n[q], n[q + 1], n[q + 2] = x, y, z
        n[q + 3] = n[p + 3] + apart + x * n[SHIFT] + y * n[SHIFT + 1] + z * n[SHIFT + 2]


@leaf
def velocity(n, p):
    """Velocity relative to the first hull of the point of the second one at p."""
    v, w = n[SPEED:SPIN], n[SPIN:PUSH]
    return v[0] + w[1] * p[2] - w[2] * p[1], v[1] + w[2] * p[0] - w[0] * p[2], v[2] + w[0] * p[1] - w[1] * p[0]


@leaf
def least_overlap(columns, n):
    """(overlap along the normal of the face under which the other hull is least deep, its rate, the row of that face). Negative: apart."""
    first, faces, _, _, seen, _, _ = places(columns)
    least, face, corner, own = overlap_under(n, faces, seen, columns[OTHER_CORNERS])[0] + np.inf, faces, seen, True
    for k in range(np.int64(columns[FACES]) + np.int64(columns[OTHER_FACES])):
        of_first = k < columns[FACES]
        overlap, at = overlap_under(
            n, faces + 4 * k, seen if of_first else first, columns[OTHER_CORNERS] if of_first else columns[CORNERS]
        )
        if real(overlap) < real(least):
            least, face, corner, own = overlap, faces + 4 * k, at, of_first
    rate = dot(n[face:], velocity(n, n[corner:]))
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
    A, B, r, w = markers.A[i], markers.A[j], markers.r[i], bodies.omega[markers.body[i]]
    v = minus(velocity_at(bodies, markers.body[j], r), velocity_at(bodies, markers.body[i], r))
    shift = seen(A, minus(markers.r[j], r))
    put(n, SHIFT, shift)
    put(n, SPEED, seen(A, v))
    put(n, SPIN, seen(A, minus(bodies.omega[markers.body[j]], w)))
    for b in range(3):
        column = seen(A, axis(B, b))
        n[TURN + b], n[TURN + 3 + b], n[TURN + 6 + b] = column
    if columns[SURFACE] != NONE:
        find_surface(machine, columns[SURFACE:], n[MOVING:], t)
        put(n, OVER, seen(A, n[MOVING:]))
    return np.sqrt(dot(shift, shift))


@leaf
def length_of(n, first):
    """Length of a vector, 0 of none."""
    squared = dot(n[first:], n[first:])
    return np.sqrt(squared) if real(squared) > 0.0 else 0.0 * squared


@leaf
def clear(n):
    """The sums of forces := 0."""
    for k in range(PUSH, BOX):
        n[k] = 0.0 * n[FIELD]


@leaf
def add_to(n, sums, p, force):
    """Add a force at a point to the sums of force and torque that begin at `sums`."""
    put(n, sums, plus(n[sums:], force))
    put(n, sums + 3, plus(n[sums + 3 :], cross(p, force)))


@leaf
def slip_at(n, v):
    """Velocity with which the second surface slides over the first, where the second body moves relative to the first."""
    N, whole = n[NORMAL : NORMAL + 3], plus(v, n[OVER:])
    return minus(whole, times(dot(whole, N), N))


@leaf
def rub_at(n, weight, p):
    """Add what damping and friction do where an elastic pressure pushes the second hull with the force `weight` against the normal of the
    plane; returns the power that is lost."""
    m, N, v = n[PLANE + 6 : PLANE + 9], n[NORMAL : NORMAL + 3], velocity(n, p)
    rate = -dot(N, v)
    damping = weight * maximum(n[DAMPING] * rate, -1.0 + 0.0 * rate)
    add_to(n, PUSH, p, times(-damping, m))
    loss = damping * dot(m, v)
    if real(n[FRICTION]) > 0.0 and real(n[TRANSITION]) == 0.0:
        force, sums = -(weight + damping) * dot(m, N), n[RUB:BOX]
        sums[0] += force
        put(sums, 1, plus(sums[1:], times(force, p)))
        sums[4] += force * dot(p, p)
    elif real(n[FRICTION]) > 0.0:
        s, along = slip_at(n, v), -dot(m, N)
        squared = dot(s, s)
        if real(squared) > 0.0 and real(along) > 0.0:
            speed = np.sqrt(squared)
            friction = n[FRICTION] * (weight + damping) * along * tanh(speed / n[TRANSITION])
            loss += friction * speed
            add_to(n, RUB, p, times(-friction / speed, s))
    return loss


@leaf
def press_polygon(n, polygon, count, d, job, stretch):
    """(energy, power lost, largest distance d) of a polygon. d : as `along_plane` has it; stretch : |n₂ - n₁|.

    job : STORE, which adds no force; PRESS, the elastic pressure between cells of the two bodies; or RUB_ALONG, damping and friction.
    """
    d0, du, dv = d
    e1, e2, m, o = n[PLANE : PLANE + 3], n[PLANE + 3 : PLANE + 6], n[PLANE + 6 : PLANE + 9], n[PLANE + 9 : NORMAL]
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
                place = plus(plus(o, times(u, e1)), times(v, e2))
                if job == PRESS:
                    add_to(n, PUSH, place, times(-weight, m))
                else:
                    loss += rub_at(n, weight, place)
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
        here = depth_under(n, faces + 4 * k, times(0.5, n[SHIFT:]))
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
        return -far, -dot(n[SHIFT:], n[SPEED:]) / distance, nothing, nothing
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
        d, normal = turned(A, d), turned(A, opposite(n[NORMAL:]))
        pdot = mean_of(bodies, markers.body[i], markers.body[j], plus(markers.r[i], d))
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
        along = 0.5 * dot(F, plus(n[BOX:], n[BOX + 3 :]))
        x = times(1.0 / squared, plus(cross(F, T), times(along, F)))
    return plus(record.markers.r[i], turned(record.markers.A[i], x))


@leaf
def speed_of_slip(n):
    """Speed across the normal at the middle of the normal force, between the two bodies."""
    F, T = n[PUSH:PUSH_TORQUE], n[PUSH_TORQUE:RUB]
    s = slip_at(n, velocity(n, times(1.0 / dot(F, F), cross(F, T))))
    square = dot(s, s)
    return np.sqrt(square) if real(square) > 0.0 else 0.0 * square


@stage
def push(machine, k):
    """Put the sums of forces on both bodies; returns their power."""
    record = record_at(machine)
    markers, bodies, n = record.markers, record.bodies, record.elements.number[k]
    i, j = record.elements.columns[k, MARKER], record.elements.columns[k, OTHER]
    A, r, first, second = markers.A[i], markers.r[i], markers.body[i], markers.body[j]
    force, torque = turned(A, plus(n[PUSH:], n[RUB:])), turned(A, plus(n[PUSH_TORQUE:], n[RUB_TORQUE:]))
    power = add_force_at(bodies, second, r, force) + add_torque(bodies, second, torque)
    return power + add_force_at(bodies, first, r, opposite(force)) + add_torque(bodies, first, opposite(torque))


@element
def apply(machine, k, columns, n, t):
    """A contact of two hulls."""
    record = record_at(machine)
    elements, control, followed = record.elements, record.control, record.watched.followed[0]
    distance = see(machine, k, t)
    # where steps end at a touch, the hulls touch from the next accepted state on
    depth, rate, energy, loss = overlap(columns, n, distance, followed == 1 and elements.memory[k, 0] == 0.0)
    elements.depth[k, 0], elements.proposal[k, 0] = depth, 0.0 * depth + (1.0 if real(depth) > 0.0 else 0.0)
    if followed == 1:
        elements.depth_rate[k, 0] = rate
    normal, power, slip, given = length_of(n, PUSH), 0.0 * depth, 0.0 * depth, 0.0 * depth
    out, first = record.outputs.value, columns[OUTPUT]
    p = middle_of_push(machine, k) if columns[PATCH] == NONE else find_patch(machine, k)
    if real(normal) > 0.0:
        power, slip = push(machine, k), speed_of_slip(n)
        given, spun = -dot(n[RUB:RUB_TORQUE], n[OVER:MOVING]), dot(n[RUB_TORQUE:BOX], n[SPIN:PUSH])
        rubbed = given - dot(n[RUB:RUB_TORQUE], n[SPEED:SPIN]) - spun
        A = record.markers.A[columns[MARKER]]
        N, drag = turned(A, opposite(n[NORMAL:])), turned(A, opposite(n[RUB:]))
        write_touch(machine, first, p, N, drag, rubbed, given)
    else:
        leave_touch(machine, first)
    control.power[0] += given
    control.stored[0] += energy
    control.power[1] += loss
    out[first + DEPTH], out[first + FORCE], out[first + RATE] = depth, normal, rate
    out[first + FRICTION_FORCE], out[first + SLIP_SPEED] = length_of(n, RUB), slip
    put(n, PUSH, plus(n[PUSH:], n[RUB:]))
    out[first], out[first + 1] = length_of(n, PUSH), power


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
