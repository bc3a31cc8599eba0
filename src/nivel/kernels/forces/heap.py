"""Contact of many spheres, each with each other and with planes, in one element.

Every pair has the force of `nivel.kernels.forces.impact` and friction μ N tanh(v/v_s). Pairs are taken in an order that follows from the
places alone, so that sums do not depend on the way. Of few spheres all pairs are looked at, of many those in cells side by side: cubes of a
grid that are larger than the largest sphere. Then a step costs as much for each sphere, however many there are.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.core.status import OK
from nivel.kernels.forces.contact import velocity_at
from nivel.kernels.forces.impact import impact
from nivel.kernels.forces.wrench import add_force_at
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, part, stage

# columns of `columns`; then the markers of the spheres and those of the planes
OUTPUT, SPHERES, PLANES, FIRST = 0, 1, 2, 3
# outputs: magnitude, power, depth, normal force, friction, power of friction, pairs that touch
DEPTH, FORCE, RUB, LOST, TOUCHING = 2, 3, 4, 5, 6
# columns of `number`; then a point and a normal, which are work
STIFFNESS, EXPONENT, LOSS, FRICTION, TRANSITION, POINT, NORMAL = 0, 1, 2, 3, 4, 5, 8
# CELL: size of a cell, GAP: by how much what is not in cells side by side is apart at least, TABLE_SIZE: 0 where all pairs are looked at,
# KEPT: how many touched in the last evaluation. Behind the radii the table, of each sphere the one before it in its cell, and its cell (3);
# places of what touched, so many of each sphere
CELL, GAP, TABLE_SIZE, KEPT, RADII = 11, 12, 13, 14, 15
KEPT_OF_EACH = 8


@part
def push_apart(machine, k, place, i, j, depth):
    """Force of surface `place` of element k between markers i and j at its point and normal, which are in its numbers."""
    record = record_at(machine)
    bodies, elements, control, out = record.bodies, record.elements, record.control, record.outputs.value
    numbers, first, followed = elements.number[k], np.int64(elements.columns[k, OUTPUT]), record.watched.followed[0]
    this, other = record.markers.body[i], record.markers.body[j]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:CELL]
    v0, v1, v2 = velocity_at(bodies, this, p)
    u0, u1, u2 = velocity_at(bodies, other, p)
    v0, v1, v2 = v0 - u0, v1 - u1, v2 - u2
    away = v0 * normal[0] + v1 * normal[1] + v2 * normal[2]
    elements.depth[k, place] = depth
    if followed == 1:
        elements.depth_rate[k, place] = -away
    if not (real(depth) > 0.0 or (followed == 1 and elements.memory[k, place] > 0.0)):
        elements.proposal[k, place] = 0.0 * depth
        return
    force, stored, loss, elements.proposal[k, place] = impact(
        depth, -away, numbers[STIFFNESS], numbers[EXPONENT], numbers[LOSS], elements.memory[k, place], followed
    )
    control.stored[0] += stored
    control.power[1] += loss
    s0, s1, s2 = v0 - away * normal[0], v1 - away * normal[1], v2 - away * normal[2]
    squared = s0 * s0 + s1 * s1 + s2 * s2
    x, y, z = force * normal[0], force * normal[1], force * normal[2]
    if real(numbers[FRICTION]) > 0.0 and real(squared) > 0.0:
        speed = np.sqrt(squared)
        friction = numbers[FRICTION] * force * tanh(speed / numbers[TRANSITION])
        share = friction / speed
        x, y, z = x - share * s0, y - share * s1, z - share * s2
        control.power[1] += friction * speed
        out[first + RUB] += friction
        out[first + LOST] += friction * speed
    power = add_force_at(bodies, this, p, x, y, z)
    out[first + 1] += power + add_force_at(bodies, other, p, -x, -y, -z)
    out[first + FORCE] += force
    out[first + TOUCHING] += 1.0 if real(depth) > 0.0 else 0.0


@leaf
def cell_of(x, size):
    """Number of the cell along an axis."""
    return np.int64(np.floor(real(x) / size))


@leaf
def place_in_table(x, y, z, size):
    """Place of a cell in a table whose size is a power of two (Teschner and others 2003)."""
    return ((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) & (size - 1)


@stage
def fill_cells(machine, k):
    """Put the spheres of element k into cells: a place of the table has the last sphere there, plus one; a sphere has the one before."""
    record = record_at(machine)
    columns, numbers, r = record.elements.columns[k], record.elements.number[k], record.markers.r
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    table, nothing = RADII + count, 0.0 * numbers[STIFFNESS]
    before, cells = table + size, table + size + count
    for m in range(size):
        numbers[table + m] = nothing
    for a in range(count):
        i = np.int64(columns[FIRST + a])
        x, y, z = (
            cell_of(r[i, 0], real(numbers[CELL])),
            cell_of(r[i, 1], real(numbers[CELL])),
            cell_of(r[i, 2], real(numbers[CELL])),
        )
        numbers[cells + 3 * a], numbers[cells + 3 * a + 1], numbers[cells + 3 * a + 2] = (
            nothing + x,
            nothing + y,
            nothing + z,
        )
        m = table + place_in_table(x, y, z, size)
        numbers[before + a], numbers[m] = numbers[m], nothing + (a + 1)


@stage
def forget_touches(machine, k):
    """Those that touched in the evaluation before are apart until they are found again."""
    record = record_at(machine)
    elements = record.elements
    columns, numbers = elements.columns[k], elements.number[k]
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    kept, nothing = RADII + size + 5 * count, 0.0 * numbers[STIFFNESS]
    touching = np.int64(real(numbers[KEPT]))
    if touching > KEPT_OF_EACH * count:  # more than there was room for
        for place in range(count * np.int64(columns[PLANES]) + count * (count - 1) // 2):
            elements.depth[k, place], elements.proposal[k, place] = nothing - 1.0, nothing
    else:
        for m in range(touching):
            place = np.int64(real(numbers[kept + m]))
            elements.depth[k, place], elements.proposal[k, place] = nothing - 1.0, nothing
    numbers[KEPT] = nothing


@stage
def keep_touch(machine, k, place):
    """Note that something touches."""
    elements = record_at(machine).elements
    columns, numbers = elements.columns[k], elements.number[k]
    count, m = np.int64(columns[SPHERES]), np.int64(real(numbers[KEPT]))
    if m < KEPT_OF_EACH * count:
        numbers[RADII + np.int64(real(numbers[TABLE_SIZE])) + 5 * count + m] = 0.0 * numbers[STIFFNESS] + place
    numbers[KEPT] += 1.0


@part
def touch_plane(machine, k, place, a, j, height):
    """Push sphere a, whose centre is so high above the plane of marker j."""
    record = record_at(machine)
    columns, numbers, markers = record.elements.columns[k], record.elements.number[k], record.markers
    i, A = np.int64(columns[FIRST + a]), markers.A[j]
    for c in range(3):
        numbers[NORMAL + c] = A[c, 2]
        numbers[POINT + c] = markers.r[i, c] - height * A[c, 2]
    depth = numbers[RADII + a] - height
    push_apart(machine, k, place, i, j, depth)
    if real(numbers[TABLE_SIZE]) > 0.0 and real(depth) > 0.0:
        keep_touch(machine, k, place)


@part
def touch_sphere(machine, k, place, a, b):
    """Push spheres a and b apart."""
    record = record_at(machine)
    columns, numbers, r = record.elements.columns[k], record.elements.number[k], record.markers.r
    i, j = np.int64(columns[FIRST + a]), np.int64(columns[FIRST + b])
    d0, d1, d2 = r[i, 0] - r[j, 0], r[i, 1] - r[j, 1], r[i, 2] - r[j, 2]
    distance = np.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
    depth = numbers[RADII + a] + numbers[RADII + b] - distance
    if real(distance) == 0.0:
        d2, distance = d2 + 1.0, distance + 1.0  # any direction will do
    numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2] = d0 / distance, d1 / distance, d2 / distance
    for c in range(3):
        numbers[POINT + c] = r[j, c] + (numbers[RADII + b] - 0.5 * depth) * numbers[NORMAL + c]
    push_apart(machine, k, place, i, j, depth)
    if real(numbers[TABLE_SIZE]) > 0.0 and real(depth) > 0.0:
        keep_touch(machine, k, place)


@stage
def look_at_pair(machine, k, a, b, r, deepest):
    """Sphere a, at r, beside sphere b, which comes before it: push where they touch; returns the deepest overlap so far."""
    record = record_at(machine)
    elements = record.elements
    columns, numbers = elements.columns[k], elements.number[k]
    o, reach = record.markers.r[np.int64(columns[FIRST + b])], numbers[RADII + a] + numbers[RADII + b]
    place = (a + 1) * np.int64(columns[PLANES]) + a * (a - 1) // 2 + b
    d0, d1, d2 = r[0] - o[0], r[1] - o[1], r[2] - o[2]
    squared = d0 * d0 + d1 * d1 + d2 * d2
    # a gap that is above that of the nearest pair needs no root
    near = reach - real(deepest)
    if near > 0.0 and real(squared) < near * near:
        deepest = reach - np.sqrt(squared)
    if record.watched.followed[0] == 1 or real(squared) < real(reach) * real(reach) or elements.depth[k, place] > 0.0:
        touch_sphere(machine, k, place, a, b)
    return deepest


@stage
def look_around(machine, k, a, r, deepest):
    """Sphere a, at r, beside those before it in its cell and the cells around; returns the deepest overlap so far."""
    record = record_at(machine)
    columns, numbers = record.elements.columns[k], record.elements.number[k]
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    table = RADII + count
    before, cells = table + size, table + size + count
    u, v, w = (
        np.int64(real(numbers[cells + 3 * a])),
        np.int64(real(numbers[cells + 3 * a + 1])),
        np.int64(real(numbers[cells + 3 * a + 2])),
    )
    for n in range(27):
        x, y, z = u + n % 3 - 1, v + (n // 3) % 3 - 1, w + n // 9 - 1
        b = np.int64(real(numbers[table + place_in_table(x, y, z, size)])) - 1
        while b >= 0:
            its = cells + 3 * b
            if b < a and real(numbers[its]) == x and real(numbers[its + 1]) == y and real(numbers[its + 2]) == z:
                deepest = look_at_pair(machine, k, a, b, r, deepest)
            b = np.int64(real(numbers[before + b])) - 1
    return deepest


@family
def apply(machine, number, t):
    """All pairs of all elements."""
    record = record_at(machine)
    elements, markers, followed, out = record.elements, record.markers, record.watched.followed[0], record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        columns, numbers = elements.columns[k], elements.number[k]
        count, planes, first = np.int64(columns[SPHERES]), np.int64(columns[PLANES]), np.int64(columns[OUTPUT])
        nothing = 0.0 * numbers[STIFFNESS]
        for a in range(7):
            out[first + a] = nothing
        # where surfaces are followed each has its own distance
        uses_cells = real(numbers[TABLE_SIZE]) > 0.0 and followed == 0
        deepest = nothing - np.inf
        if real(numbers[TABLE_SIZE]) > 0.0:
            forget_touches(machine, k)
        if uses_cells:
            fill_cells(machine, k)
            # what is farther than the cells around is apart by that
            deepest = nothing - real(numbers[GAP])
        for a in range(count):
            r = markers.r[np.int64(columns[FIRST + a])]
            for b in range(planes):
                j = np.int64(columns[FIRST + count + b])
                A, o = markers.A[j], markers.r[j]
                height = (r[0] - o[0]) * A[0, 2] + (r[1] - o[1]) * A[1, 2] + (r[2] - o[2]) * A[2, 2]
                depth, place = numbers[RADII + a] - height, a * planes + a * (a - 1) // 2 + b
                if real(depth) > real(deepest):
                    deepest = depth
                if followed == 1 or real(depth) > 0.0 or elements.depth[k, place] > 0.0:
                    touch_plane(machine, k, place, a, j, height)
            if uses_cells:
                deepest = look_around(machine, k, a, r, deepest)
            else:
                for b in range(a):
                    deepest = look_at_pair(machine, k, a, b, r, deepest)
        force, rub = out[first + FORCE], out[first + RUB]
        out[first] = np.sqrt(force * force + rub * rub)
        out[first + DEPTH] = deepest
    return OK
