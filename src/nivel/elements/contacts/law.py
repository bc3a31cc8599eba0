"""Law of contacts: what acts at a point where two surfaces touch, and what a contact reports.

A pair of shapes (`ground`, `rounds`, `ellipsoids`, `heights`, `heap`) finds its points: place, normal from the
other body to this one, overlap, and where friction sticks the velocity of the point itself. The law is the same for all of them. Normal
force: `nivel.elements.contacts.impact`, or a law of the user, which works from outside and never pulls. Friction of every point:
μ N tanh(v/v_s) against the sliding velocity of the bodies there; or that of a patch of all points, which sticks:
`nivel.kernels.elements.patch`.

The surface of a body may move over it, as a belt or a turntable: its velocity in axes of a marker there, and its spin about z through the
marker's point, are functions.
"""

from collections.abc import Callable
from functools import update_wrapper
from typing import Any

import numpy as np

from nivel.elements.contacts.contact import Contact, Contacts
from nivel.elements.contacts.impact import damping_of_restitution, impact
from nivel.kernels.algebra.analytic import maximum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, opposite, plus, put, times
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import leave_patch, middle_of, tangents, write_patch
from nivel.kernels.elements.touch import DEPTH, FORCE, RATE, RUB, SLIP, leave_touch, write_touch
from nivel.kernels.forces.wrench import add_force_at, velocity_at
from nivel.kernels.record.function import evaluate_function, evaluate_motion
from nivel.kernels.record.hook import Family, family
from nivel.kernels.record.record import NONE, record_at
from nivel.lazy import Struct
from nivel.native.function import stage

# columns; FUNCTIONS: the first of four, or NONE; SMOOTH: 1 where they are motions, whose rates are known; FRAME: the marker
FUNCTIONS, SMOOTH, FRAME = 0, 1, 2
# numbers: velocity at the marker's point and its rate, global axes; spin and its rate
VELOCITY, CHANGE, SPIN, SPIN_RATE, SURFACE_NUMBERS = 0, 3, 6, 7, 8


@stage
def find_surface(machine, columns, n, t):
    """Leave velocity, spin and their rates in the numbers; a rate that is not known counts as 0."""
    record = record_at(machine)
    frame = columns[FRAME]
    A, W, o = record.markers.A[frame], record.bodies.omega[record.markers.body[frame]], 0.0 * n[SPIN]
    for a in range(SURFACE_NUMBERS):
        n[a] = o
    for b in range(4):
        if columns[SMOOTH] == 1:
            value, rate, _ = evaluate_motion(machine, columns[FUNCTIONS] + b, t)
        else:
            value, rate = evaluate_function(machine, columns[FUNCTIONS] + b, t), 0.0
        if b == 3:
            n[SPIN], n[SPIN_RATE] = o + value, o + rate
        else:
            for a in range(3):
                n[VELOCITY + a] += A[a, b] * value
                n[CHANGE + a] += A[a, b] * rate
    turning = cross(W, n[VELOCITY:CHANGE])
    for a in range(3):
        n[CHANGE + a] += turning[a]


@stage
def surface_at(machine, frame, n, p):
    """Velocity of the surface over its body at p, global axes."""
    markers = record_at(machine).markers
    turning = cross(axis(markers.A[frame], 2), minus(p, markers.r[frame]))
    return plus(n[VELOCITY:CHANGE], times(n[SPIN], turning))


@stage
def surface_rate_at(machine, frame, n, p, pdot):
    """Its rate of change at a point that moves."""
    record = record_at(machine)
    markers = record.markers
    z, W = axis(markers.A[frame], 2), record.bodies.omega[markers.body[frame]]
    d = minus(p, markers.r[frame])
    swept = plus(cross(cross(W, z), d), cross(z, minus(pdot, markers.rdot[frame])))
    return plus(n[CHANGE:SPIN], plus(times(n[SPIN_RATE], cross(z, d)), times(n[SPIN], swept)))


# columns of `columns`; MARKER, OTHER: of both shapes, or NONE in a heap; COUNT: points that may touch; LAW: of the normal force, or NONE;
# PATCH: first friction of a patch, or NONE, AXES: how many it has, COORDINATE: the first of these; SURFACE: the columns of a surface that
# moves over its body; then those of the pair. A law reads overlap and rate of its point among the outputs.
OUTPUT, MARKER, OTHER, COUNT, LAW, PATCH, AXES, COORDINATE, SURFACE, COLUMNS = 0, 1, 2, 3, 4, 5, 6, 7, 8, 11
# columns of `number`. RADIUS: of a ball about the marker that holds the shape. Then work: a point, its normal, velocity of this body
# relative to the other there and that of the point itself; sums over the points (force, moments of first and second order about the marker,
# force times velocity of the point; friction on the first body; sum of the sizes of friction, power lost, power of the moving surface,
# power), deepest overlap, its rate, fastest slip, and the moving surface; then the numbers of the pair.
STIFFNESS, EXPONENT, LOSS, FRICTION, TRANSITION, RADIUS, POINT, NORMAL, SPEED, OWN_SPEED, SUMS = (
    0, 1, 2, 3, 4, 5, 6, 9, 12, 15, 18,
)  # fmt: skip
RUBBED, RUBBING, LOST, GIVEN, POWER, DEEPEST, DEEPEST_RATE, SLIDING, MOVING = 26, 29, 30, 31, 32, 33, 34, 35, 36
NUMBERS = MOVING + SURFACE_NUMBERS
# Bodies are far from each other where their balls are apart by this share of the radii.
FAR = 0.25


@stage
def begin_contact(machine, k, t):
    """Clear the sums of contact k, and find its moving surface."""
    elements = record_at(machine).elements
    columns, numbers = elements.columns[k], elements.number[k]
    for a in range(SUMS, MOVING):
        numbers[a] = 0.0 * numbers[STIFFNESS]
    numbers[DEEPEST] = numbers[DEEPEST] - np.inf
    if columns[SURFACE] != NONE:
        find_surface(machine, columns[SURFACE:], numbers[MOVING:NUMBERS], t)


@stage
def is_apart(machine, k, gap, rate):
    """Whether all points of contact k were apart in the accepted state: then a `gap` between bounds of both bodies, which closes at this
    rate, stands for that of all points."""
    record = record_at(machine)
    elements, followed = record.elements, record.watched.followed[0]
    count, numbers = elements.columns[k, COUNT], elements.number[k]
    if followed == 1:
        for n in range(count):
            if elements.memory[k, n] > 0.0:
                return False
    numbers[DEEPEST], numbers[DEEPEST_RATE] = -gap, rate
    for n in range(count):
        elements.depth[k, n], elements.proposal[k, n] = -gap, 0.0 * gap
        if followed == 1:
            elements.depth_rate[k, n] = rate
    return True


@stage
def is_far(machine, k):
    """Whether the balls around both bodies are far from each other: then their distance stands for that of all points."""
    record = record_at(machine)
    markers, columns, reach = record.markers, record.elements.columns[k], record.elements.number[k, RADIUS]
    i, j = columns[MARKER], columns[OTHER]
    d = minus(markers.r[i], markers.r[j])
    squared = dot(d, d)
    if not real(squared) > ((1.0 + FAR) * real(reach)) ** 2:
        return False
    distance = np.sqrt(squared)
    return is_apart(machine, k, distance - reach, -dot(d, minus(markers.rdot[i], markers.rdot[j])) / distance)


@stage
def meets(machine, k, n, i, j, depth):
    """Note the overlap of surface n of contact k, between markers i and j, at the point and normal in its numbers, where the relative
    velocity is left; returns (whether the law acts there, rate of the overlap)."""
    record = record_at(machine)
    bodies, body, elements, followed = record.bodies, record.markers.body, record.elements, record.watched.followed[0]
    numbers = elements.number[k]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:SPEED]
    v = minus(velocity_at(bodies, body[i], p), velocity_at(bodies, body[j], p))
    put(numbers, SPEED, v)
    rate = -dot(v, normal)
    elements.depth[k, n] = depth
    if followed == 1:
        elements.depth_rate[k, n] = rate
    acts = real(depth) > 0.0 or (followed == 1 and elements.memory[k, n] > 0.0)
    if not acts:
        elements.proposal[k, n] = 0.0 * depth
    return acts, rate


@stage
def needs_speed(machine, k, n, depth):
    """Whether the law needs the velocity of point n of contact k itself: friction sticks, and the point touches."""
    record = record_at(machine)
    elements = record.elements
    acts = real(depth) > 0.0 or (record.watched.followed[0] == 1 and elements.memory[k, n] > 0.0)
    return elements.columns[k, PATCH] != NONE and acts


@stage
def note_speed(machine, k, v):
    """Leave the velocity of the point of contact k itself in the numbers."""
    put(record_at(machine).elements.number[k], OWN_SPEED, v)


@stage
def mean_speed(machine, k, n):
    """The mean of the velocities of both bodies at the point of contact k, for that of the point itself."""
    record = record_at(machine)
    bodies, body, columns = record.bodies, record.markers.body, record.elements.columns[k]
    p = record.elements.number[k, POINT:NORMAL]
    return mean_of(bodies, body[columns[MARKER]], body[columns[OTHER]], p)


@stage
def mean_of(bodies, first, second, p):
    """The mean of the velocities of two bodies at p."""
    return times(0.5, plus(velocity_at(bodies, first, p), velocity_at(bodies, second, p)))


@stage
def press(machine, k, n, depth, t):
    """Push at point n of contact k, where it touches; returns the force."""
    elements = record_at(machine).elements
    columns, numbers = elements.columns[k], elements.number[k]
    i, j = np.int64(columns[MARKER]), np.int64(columns[OTHER])
    acts, rate = meets(machine, k, n, i, j, depth)
    if real(depth) > real(numbers[DEEPEST]):
        numbers[DEEPEST], numbers[DEEPEST_RATE] = depth, rate
    return push(machine, k, n, i, j, depth, rate, t) if acts else 0.0 * depth


@stage
def law_force(machine, k, depth, rate, t):
    """The user's normal force at an overlap and its rate; none where the surfaces are apart, or where it would pull."""
    record = record_at(machine)
    out, first = record.outputs.value, record.elements.columns[k, OUTPUT]
    force = 0.0 * depth
    if real(depth) > 0.0:
        out[first + DEPTH], out[first + RATE] = depth, rate
        force = maximum(evaluate_function(machine, record.elements.columns[k, LAW], t), force)
    return force


@stage
def normal_force(machine, k, n, depth, rate, t):
    """Force along the normal at surface n of contact k, with its energy and what damping loses."""
    record = record_at(machine)
    elements, control, numbers = record.elements, record.control, record.elements.number[k]
    if elements.columns[k, LAW] != NONE:
        force = law_force(machine, k, depth, rate, t)
        elements.proposal[k, n] = 0.0 * force + (1.0 if real(depth) > 0.0 else 0.0)
        control.power[0] -= force * rate
        return force
    force, stored, loss, elements.proposal[k, n] = impact(
        depth,
        rate,
        numbers[STIFFNESS],
        numbers[EXPONENT],
        numbers[LOSS],
        elements.memory[k, n],
        record.watched.followed[0],
    )
    control.stored[0] += stored
    control.power[1] += loss
    return force


@stage
def creep_friction(machine, k, force):
    """Friction on the first body at the point in the numbers of contact k under a normal force, with its powers; noted in the sums."""
    record = record_at(machine)
    control, columns, numbers = record.control, record.elements.columns[k], record.elements.number[k]
    normal, v, o = numbers[NORMAL:SPEED], numbers[SPEED:OWN_SPEED], 0.0 * force
    out, over = dot(v, normal), (o, o, o)
    s = minus(v, times(out, normal))
    if columns[SURFACE] != NONE:
        over = surface_at(machine, columns[SURFACE + 2], numbers[MOVING:NUMBERS], numbers[POINT:NORMAL])
        over = minus(over, times(dot(over, normal), normal))
        s = minus(s, over)
    squared = dot(s, s)
    speed = np.sqrt(squared) if real(squared) > 0.0 else 0.0 * squared
    if real(speed) > real(numbers[SLIDING]):
        numbers[SLIDING] = speed
    if not (real(numbers[FRICTION]) > 0.0 and real(speed) > 0.0):
        return o, o, o
    friction = numbers[FRICTION] * force * tanh(speed / numbers[TRANSITION])
    s = times(-friction / speed, s)
    given, lost = dot(s, over), friction * speed
    control.power[0] += given
    control.power[1] += lost
    numbers[RUBBING] += friction
    numbers[LOST] += lost
    numbers[GIVEN] += given
    return s


@stage
def push(machine, k, n, i, j, depth, rate, t):
    """Forces at surface n of contact k on the bodies of markers i and j, at the point in its numbers, which are added to the sums; returns
    the normal force."""
    record = record_at(machine)
    bodies, markers, columns = record.bodies, record.markers, record.elements.columns[k]
    numbers = record.elements.number[k]
    p, normal, sums = numbers[POINT:NORMAL], numbers[NORMAL:SPEED], numbers[SUMS:RUBBED]
    force = normal_force(machine, k, n, depth, rate, t)
    rub = creep_friction(machine, k, force)
    whole = plus(times(force, normal), rub)
    power = add_force_at(bodies, markers.body[i], p, whole)
    numbers[POWER] += power + add_force_at(bodies, markers.body[j], p, opposite(whole))
    d = minus(p, markers.r[i])
    sums[0] += force
    for a in range(3):
        sums[1 + a] += force * d[a]
        numbers[RUBBED + a] += rub[a]
    if columns[PATCH] != NONE:
        sums[4] += force * dot(d, d)
        for a in range(3):
            sums[5 + a] += force * numbers[OWN_SPEED + a]
    return force


@stage
def place_patch(machine, columns, moving, i, j, load, d, reach, normal, pdot):
    """The patch of a contact between markers i and j: its columns from PATCH on, its moving surface, its load, its middle from the first
    marker, radius of gyration, normal and velocity of the middle."""
    markers = record_at(machine).markers
    first, count, q, frame = np.int64(columns[0]), np.int64(columns[1]), np.int64(columns[2]), columns[5]
    t, u = tangents(markers.A[j], normal)
    p, o = plus(markers.r[i], d), 0.0 * load
    over, change, spin, spin_rate = (o, o, o), (o, o, o), o, o
    if columns[3] != NONE:
        over, change = surface_at(machine, frame, moving, p), surface_rate_at(machine, frame, moving, p, pdot)
        spin, spin_rate = o + moving[SPIN], o + moving[SPIN_RATE]
    write_patch(machine, first, count, q, p, pdot, normal, t, u, load, reach, over, change, spin, spin_rate)


@stage
def report_contact(machine, k):
    """Patch and outputs of contact k, from its sums."""
    record = record_at(machine)
    columns, numbers, out = record.elements.columns[k], record.elements.number[k], record.outputs.value
    first, force, friction, sums = columns[OUTPUT], numbers[SUMS], numbers[RUBBING], numbers[SUMS:RUBBED]
    i, j, normal = columns[MARKER], columns[OTHER], (numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2])
    out[first] = np.sqrt(force * force + friction * friction)
    out[first + 1], out[first + DEPTH], out[first + FORCE] = numbers[POWER], numbers[DEEPEST], force
    out[first + RATE], out[first + RUB], out[first + SLIP] = numbers[DEEPEST_RATE], friction, numbers[SLIDING]
    if real(force) > 0.0:
        d, reach = middle_of(sums)
        if columns[PATCH] != NONE:
            pdot = sums[5] / force, sums[6] / force, sums[7] / force
            place_patch(machine, columns[PATCH:], numbers[MOVING:NUMBERS], i, j, force, d, reach, normal, pdot)
        p = plus(record.markers.r[i], d)
        write_touch(machine, first, p, normal, numbers[RUBBED:RUBBING], numbers[LOST], numbers[GIVEN])
    else:
        if columns[PATCH] != NONE:
            leave_patch(machine, np.int64(columns[PATCH]), np.int64(columns[AXES]), np.int64(columns[COORDINATE]))
        leave_touch(machine, first)


def pair(is_far: Callable[..., Any], speed: Callable[..., Any]) -> Callable[[Callable[..., Any]], Family]:
    """Decorator: what finds the points of a pair of shapes as the family of all such contacts.

    It leaves point n of contact k and the normal there in the numbers, and returns the overlap: `find(machine, k, n)`. is_far : whether the
    distance of bounds stands for that of all points, `is_far(machine, k)`. speed : velocity of the point itself, `speed(machine, k, n)`.
    """

    def family_of(find: Callable[..., Any]) -> Family:
        find_point = stage(find)

        def touch(machine, number, t):
            elements = record_at(machine).elements
            for k in range(elements.span[number, 0], elements.span[number, 1]):
                begin_contact(machine, k, t)
                if not is_far(machine, k):
                    for n in range(elements.columns[k, COUNT]):
                        depth = find_point(machine, k, n)
                        if needs_speed(machine, k, n, depth):
                            note_speed(machine, k, speed(machine, k, n))
                        press(machine, k, n, depth, t)
                report_contact(machine, k)
            return OK

        update_wrapper(touch, find)
        vars(touch).pop("__wrapped__")  # whose arguments Numba would take for its own
        return family(touch)

    return family_of


class Points(Struct):
    """Points of a pair: how many, radius [m] of the balls that hold both shapes, and what its family has behind the law."""

    count: int
    radius: float
    columns: list[int]
    numbers: list[float]


def law_numbers(force: Contact | Contacts, stiffness: float | None, radius: float) -> list[float]:
    """Numbers of the law, with a ball of this radius [m] about the marker of the shape."""
    loss = damping_of_restitution(force.restitution) if force.restitution is not None else 0.0
    if isinstance(force, Contact) and force.damping is not None:
        loss = -force.damping
    sticks = isinstance(force, Contact) and force.sticks
    friction, transition = 0.0 if sticks else force.friction, force.friction_transition_speed or 1.0
    numbers = [stiffness or 0.0, force.exponent, loss, friction, transition, radius]
    return numbers + [0.0] * (NUMBERS - len(numbers))
