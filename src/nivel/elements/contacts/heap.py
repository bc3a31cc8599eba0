"""Contact of many spheres, each with each other and with planes, in one element.

Every pair has the force of `nivel.elements.contacts.impact` and friction μ N tanh(v/v_s). Pairs are taken in an order that follows from the
places alone, so that sums do not depend on the way. Of few spheres all pairs are looked at, of many those in cells side by side: cubes of a
grid that are larger than the largest sphere. Then a step costs as much for each sphere, however many there are.
"""

import numpy as np

from nivel.elements.contacts import law as of_law
from nivel.elements.contacts.contact import WORK, Contacts
from nivel.elements.contacts.ground import find_point_of_spheres
from nivel.elements.facts import add_outputs
from nivel.elements.forces.friction import add_friction_work, rub_off
from nivel.elements.kind import Kind
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import axis, minus, put, times
from nivel.kernels.record.record import NONE, record_at
from nivel.known import MachineRecord, SystemBuilder
from nivel.machine.bodies.shape import Sphere
from nivel.native.function import leaf, part, stage

# columns of the pair; then the markers of the spheres and those of the planes
SPHERES, PLANES, FIRST = of_law.COLUMNS, of_law.COLUMNS + 1, of_law.COLUMNS + 2
# outputs: magnitude, power, depth, normal force, friction, power of friction, pairs that touch
DEPTH, FORCE, RUB, LOST_POWER, TOUCHING = 2, 3, 4, 5, 6
# numbers of the pair; CELL: size of a cell, GAP: by how much what is not in cells side by side is apart at least, TABLE_SIZE: 0 where all
# pairs are looked at, KEPT: how many touched in the last evaluation. Behind the radii the table, of each sphere the one before it in its
# cell, and its cell (3); places of what touched, so many of each sphere
CELL, GAP, TABLE_SIZE, KEPT, RADII = (of_law.NUMBERS + at for at in range(5))
KEPT_OF_EACH = 8


@part
def push_apart(machine, k, place, i, j, depth, t):
    """Push at surface `place` of element k between markers i and j at its point and normal, where it touches."""
    record = record_at(machine)
    acts, rate = of_law.meets(machine, k, place, i, j, depth)
    if not acts:
        return
    of_law.push(machine, k, place, i, j, depth, rate, t)
    if real(depth) > 0.0:
        numbers = record.elements.number[k]
        record.outputs.value[np.int64(record.elements.columns[k, of_law.OUTPUT]) + TOUCHING] += 1.0
        if real(numbers[TABLE_SIZE]) > 0.0:
            keep_touch(machine, k, place)


@leaf
def place_in_table(x, y, z, size):
    """Place of a cell in a table whose size is a power of two (Teschner and others 2003)."""
    return ((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) & (size - 1)


@leaf
def cell_at(numbers, at):
    """The cell of a sphere, whose numbers begin at `at`."""
    return np.int64(real(numbers[at])), np.int64(real(numbers[at + 1])), np.int64(real(numbers[at + 2]))


@stage
def fill_cells(machine, k):
    """Put the spheres of element k into cells: a place of the table has the last sphere there, plus one; a sphere has the one before."""
    record = record_at(machine)
    columns, numbers, r = record.elements.columns[k], record.elements.number[k], record.markers.r
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    table, nothing = RADII + count, 0.0 * numbers[of_law.STIFFNESS]
    before, cells = table + size, table + size + count
    for m in range(size):
        numbers[table + m] = nothing
    for a in range(count):
        i, cell = np.int64(columns[FIRST + a]), cells + 3 * a
        for c in range(3):
            numbers[cell + c] = nothing + np.floor(real(r[i, c]) / real(numbers[CELL]))
        x, y, z = cell_at(numbers, cell)
        m = table + place_in_table(x, y, z, size)
        numbers[before + a], numbers[m] = numbers[m], nothing + (a + 1)


@stage
def forget_touches(machine, k):
    """Those that touched in the evaluation before are apart until they are found again."""
    record = record_at(machine)
    elements = record.elements
    columns, numbers = elements.columns[k], elements.number[k]
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    kept, nothing = RADII + size + 5 * count, 0.0 * numbers[of_law.STIFFNESS]
    touching = np.int64(real(numbers[KEPT]))
    more = touching > KEPT_OF_EACH * count  # than there was room for: all are forgotten
    for m in range(count * np.int64(columns[PLANES]) + count * (count - 1) // 2 if more else touching):
        place = m if more else np.int64(real(numbers[kept + m]))
        elements.depth[k, place], elements.proposal[k, place] = nothing - 1.0, nothing
    numbers[KEPT] = nothing


@stage
def keep_touch(machine, k, place):
    """Note that something touches."""
    elements = record_at(machine).elements
    columns, numbers = elements.columns[k], elements.number[k]
    count, m = np.int64(columns[SPHERES]), np.int64(real(numbers[KEPT]))
    if m < KEPT_OF_EACH * count:
        numbers[RADII + np.int64(real(numbers[TABLE_SIZE])) + 5 * count + m] = 0.0 * numbers[of_law.STIFFNESS] + place
    numbers[KEPT] += 1.0


@stage
def touch_plane(machine, k, place, a, j, height, t):
    """Push sphere a, whose centre is so high above the plane of marker j."""
    record = record_at(machine)
    numbers, markers = record.elements.number[k], record.markers
    i = np.int64(record.elements.columns[k, FIRST + a])
    normal = axis(markers.A[j], 2)
    put(numbers, of_law.NORMAL, normal)
    put(numbers, of_law.POINT, minus(markers.r[i], times(height, normal)))
    push_apart(machine, k, place, i, j, numbers[RADII + a] - height, t)


@stage
def touch_sphere(machine, k, place, a, b, t):
    """Push spheres a and b apart."""
    record = record_at(machine)
    columns, numbers, r = record.elements.columns[k], record.elements.number[k], record.markers.r
    i, j = np.int64(columns[FIRST + a]), np.int64(columns[FIRST + b])
    depth = find_point_of_spheres(r[i], r[j], numbers, numbers[RADII + a], numbers[RADII + b])
    push_apart(machine, k, place, i, j, depth, t)


@stage
def look_at_pair(machine, k, a, b, r, deepest, t):
    """Sphere a, at r, beside sphere b, which comes before it: push where they touch; returns the deepest overlap so far."""
    record = record_at(machine)
    elements = record.elements
    columns, numbers = elements.columns[k], elements.number[k]
    o, reach = record.markers.r[np.int64(columns[FIRST + b])], numbers[RADII + a] + numbers[RADII + b]
    place = (a + 1) * np.int64(columns[PLANES]) + a * (a - 1) // 2 + b
    d = minus(r, o)
    squared = dot(d, d)
    # a gap that is above that of the nearest pair needs no root
    near = reach - real(deepest)
    if near > 0.0 and real(squared) < near * near:
        deepest = reach - np.sqrt(squared)
    if record.watched.followed[0] == 1 or real(squared) < real(reach) * real(reach) or elements.depth[k, place] > 0.0:
        touch_sphere(machine, k, place, a, b, t)
    return deepest


@stage
def look_around(machine, k, a, r, deepest, t):
    """Sphere a, at r, beside those before it in its cell and the cells around; returns the deepest overlap so far."""
    record = record_at(machine)
    columns, numbers = record.elements.columns[k], record.elements.number[k]
    count, size = np.int64(columns[SPHERES]), np.int64(real(numbers[TABLE_SIZE]))
    table = RADII + count
    before, cells = table + size, table + size + count
    u, v, w = cell_at(numbers, cells + 3 * a)
    for n in range(27):
        x, y, z = u + n % 3 - 1, v + (n // 3) % 3 - 1, w + n // 9 - 1
        b = np.int64(real(numbers[table + place_in_table(x, y, z, size)])) - 1
        while b >= 0:
            its = cells + 3 * b
            if b < a and real(numbers[its]) == x and real(numbers[its + 1]) == y and real(numbers[its + 2]) == z:
                deepest = look_at_pair(machine, k, a, b, r, deepest, t)
            b = np.int64(real(numbers[before + b])) - 1
    return deepest


@element
def apply(machine, k, columns, numbers, t):
    """All pairs of an element."""
    record = record_at(machine)
    elements, markers, followed, out = record.elements, record.markers, record.watched.followed[0], record.outputs.value
    count, planes, first = np.int64(columns[SPHERES]), np.int64(columns[PLANES]), np.int64(columns[of_law.OUTPUT])
    nothing = 0.0 * numbers[of_law.STIFFNESS]
    of_law.begin_contact(machine, k, t)
    out[first + TOUCHING] = nothing
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
            height = dot(minus(r, markers.r[j]), axis(markers.A[j], 2))
            depth, place = numbers[RADII + a] - height, a * planes + a * (a - 1) // 2 + b
            if real(depth) > real(deepest):
                deepest = depth
            if followed == 1 or real(depth) > 0.0 or elements.depth[k, place] > 0.0:
                touch_plane(machine, k, place, a, j, height, t)
        if uses_cells:
            deepest = look_around(machine, k, a, r, deepest, t)
        else:
            for b in range(a):
                deepest = look_at_pair(machine, k, a, b, r, deepest, t)
    force, rub = numbers[of_law.SUMS], numbers[of_law.RUBBING]
    out[first], out[first + 1] = np.sqrt(force * force + rub * rub), numbers[of_law.POWER]
    out[first + DEPTH], out[first + FORCE], out[first + RUB] = deepest, force, rub
    out[first + LOST_POWER] = numbers[of_law.LOST]


# From so many spheres on pairs are found by cells, which are so many times as large as the largest sphere.
MANY, LARGER = 128, 1.25


def spheres_between(machine: MachineRecord, force: Contacts) -> list[str]:
    """Names of the bodies that touch each other."""
    return list(force.between) or [body.name for body in machine.bodies if isinstance(body.shape, Sphere)]


def add_contacts(builder: SystemBuilder, force: Contacts) -> None:
    """One row for all pairs, with a place to remember for each: of every sphere those with the planes, then with the spheres before it."""
    first = add_outputs(builder, force, without=() if force.friction_work else (WORK,))
    if force.friction_work:
        add_friction_work(builder, force.name, first + LOST_POWER)
    names = spheres_between(builder.machine, force)
    markers, radii = [], []
    for name in names:
        shape = builder.machine.body_named[name].shape
        assert isinstance(shape, Sphere)  # the record was checked
        markers.append(builder.place((name, np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), np.eye(3))))
        radii.append(shape.radius)
    planes = [builder.end(plane) for plane in force.planes]
    numbers = of_law.law_numbers(force, force.stiffness, 0.0)
    cell, size = LARGER * 2.0 * max(radii), 0
    if len(names) >= MANY:
        size = 1 << (2 * len(names) - 1).bit_length()
    numbers += [cell, cell - 2.0 * max(radii), size, 0.0, *radii]
    if size:
        numbers += [0.0] * (size + (4 + KEPT_OF_EACH) * len(names))
    places = len(names) * len(planes) + len(names) * (len(names) - 1) // 2
    law = [first, NONE, NONE, 0, NONE, NONE, 0, 0, NONE, 0, NONE]
    columns = [*law, len(names), len(planes), *markers, *planes]
    builder.elements.add(apply, columns, [float(number) for number in numbers], places, tuple(range(places)))


KINDS = (Kind(Contacts, add_contacts, (apply, rub_off)),)
