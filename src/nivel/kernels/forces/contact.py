"""Contact of shapes with planes, and of spheres with each other.

A box and a hull touch with their corners, a capsule with its two balls. A cylinder touches with four points of each rim, the lowest one
and those a quarter turn on, so it rolls on exact circles and stands on four feet. Normal force:
`nivel.kernels.forces.impact`, or a law of the user, which works from outside and never pulls. Friction of every point: μ N tanh(v/v_s)
against the sliding velocity of the bodies there; or that of a patch of all points, which sticks: `nivel.kernels.elements.patch`.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import maximum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.moving_surface import NUMBERS as SURFACE_NUMBERS
from nivel.kernels.elements.moving_surface import SPIN, SPIN_RATE, find_surface, surface_at, surface_rate_at, times
from nivel.kernels.elements.patch import axis, leave_patch, middle_of, minus, plus, tangents, write_patch
from nivel.kernels.elements.touch import DEPTH, FORCE, RATE, RUB, SLIP, leave_touch, write_touch
from nivel.kernels.forces.impact import impact
from nivel.kernels.forces.wrench import add_force_at
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`; MARKER: centre and axes of the shape (of a cylinder and a capsule z is its); OTHER: the plane (z outwards), or
# the other sphere; LAW: of the normal force, or NONE; COUNT: points that may touch; PATCH: first friction of a patch, or NONE, AXES:
# how many it has, COORDINATE: the first of these; SURFACE: the columns of a surface that moves over its body
OUTPUT, KIND, MARKER, OTHER, LAW, COUNT, PATCH, AXES, COORDINATE, SURFACE = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
# a law reads overlap and rate of its point among the outputs; ROUND: two bodies of `nivel.kernels.forces.round_contact`
SPHERE, BOX, CYLINDER, SPHERES, HULL, CAPSULE, ROUND = 0, 1, 2, 3, 4, 5, 6
# columns of `number`; SIZE: radius; half lengths; radius and half length; semi-axes; the two radii; RADIUS: of a ball about the marker that
# holds the shape, of two spheres 0. Then work: a point, a normal, sums over the points (force, moments of first and second order, force
# times velocity of the point; friction on the first body; sum of the sizes of friction, power lost, power of the moving surface, power,
# deepest overlap, its rate, fastest slip), and the moving surface; then the corners of a hull in its axes, three numbers each.
STIFFNESS, EXPONENT, LOSS, FRICTION, TRANSITION, SIZE, RADIUS, POINT, NORMAL, SUMS = 0, 1, 2, 3, 4, 5, 8, 9, 12, 15
RUBBED, RUBBING, LOST, GIVEN, POWER, DEEPEST, ITS_RATE, SLIDING, MOVING = 23, 26, 27, 28, 29, 30, 31, 32, 33
NUMBERS = MOVING + SURFACE_NUMBERS
# A shape is far from a plane if its ball is by this share of its radius: then the distance of the ball stands for that of all its points.
FAR = 0.5
# A cylinder whose axis is as near to the normal, by the square of the sine, stands.
UPRIGHT = 1e-3


@stage
def corner(A, r, size, n, p):
    """Corner n of a box."""
    x = size[0] if n % 2 == 0 else -size[0]
    y = size[1] if (n // 2) % 2 == 0 else -size[1]
    z = size[2] if n < 4 else -size[2]
    for a in range(3):
        p[a] = r[a] + A[a, 0] * x + A[a, 1] * y + A[a, 2] * z


@stage
def hull_corner(A, r, corners, n, p):
    """Corner n of a hull."""
    x, y, z = corners[3 * n], corners[3 * n + 1], corners[3 * n + 2]
    for a in range(3):
        p[a] = r[a] + A[a, 0] * x + A[a, 1] * y + A[a, 2] * z


@stage
def rim_point(A, r, size, n, normal, p):
    """Point n of a cylinder: the rim's direction that points most against the normal, and its quarter turns."""
    c, s = 0.0, 0.0
    for a in range(3):
        c -= normal[a] * A[a, 0]
        s -= normal[a] * A[a, 1]
    length = np.sqrt(c * c + s * s)
    if real(length) > 1e-12:
        c, s = c / length, s / length
    else:
        c, s = 1.0, 0.0
    quarter = n % 4
    if quarter == 1:
        c, s = -s, c
    elif quarter == 2:
        c, s = -c, -s
    elif quarter == 3:
        c, s = s, -c
    z = size[1] if n < 4 else -size[1]
    for a in range(3):
        p[a] = r[a] + size[0] * (c * A[a, 0] + s * A[a, 1]) + z * A[a, 2]


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
def touch(machine, k, n, depth, t):
    """Forces at the point of number[POINT:], normal number[NORMAL:] from the other body to this one, added to the sums of the contact."""
    record = record_at(machine)
    bodies, markers, elements, control = record.bodies, record.markers, record.elements, record.control
    columns, numbers = elements.columns[k], elements.number[k]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:SUMS]
    this, other = markers.body[columns[MARKER]], markers.body[columns[OTHER]]
    v0, v1, v2 = velocity_at(bodies, this, p)
    u0, u1, u2 = velocity_at(bodies, other, p)
    v0, v1, v2 = v0 - u0, v1 - u1, v2 - u2
    out = v0 * normal[0] + v1 * normal[1] + v2 * normal[2]
    if columns[LAW] != NONE:
        force = law_force(machine, k, depth, -out, t)
        elements.proposal[k, n] = 0.0 * force + (1.0 if real(depth) > 0.0 else 0.0)
        control.power[0] += force * out
    else:
        force, stored, loss, elements.proposal[k, n] = impact(
            depth,
            -out,
            numbers[STIFFNESS],
            numbers[EXPONENT],
            numbers[LOSS],
            elements.memory[k, n],
            record.watched.followed[0],
        )
        control.stored[0] += stored
        control.power[1] += loss
    s = v0 - out * normal[0], v1 - out * normal[1], v2 - out * normal[2]
    over = 0.0 * out, 0.0 * out, 0.0 * out
    if columns[SURFACE] != NONE:
        over = surface_at(machine, columns[SURFACE + 2], numbers[MOVING:NUMBERS], p)
        up = dot(over, normal)
        over = over[0] - up * normal[0], over[1] - up * normal[1], over[2] - up * normal[2]
        s = minus(s, over)
    squared = dot(s, s)
    speed = np.sqrt(squared) if real(squared) > 0.0 else 0.0 * squared
    friction = 0.0 * force
    if real(numbers[FRICTION]) > 0.0 and real(speed) > 0.0:
        friction = numbers[FRICTION] * force * tanh(speed / numbers[TRANSITION])
        s = friction * s[0] / speed, friction * s[1] / speed, friction * s[2] / speed
        given = -dot(s, over)
        control.power[1] += friction * speed
        control.power[0] += given
        numbers[LOST] += friction * speed
        numbers[GIVEN] += given
    else:
        s = friction, friction, friction
    x, y, z = force * normal[0] - s[0], force * normal[1] - s[1], force * normal[2] - s[2]
    power = add_force_at(bodies, this, p, x, y, z)
    numbers[POWER] += power + add_force_at(bodies, other, p, -x, -y, -z)
    numbers[RUBBING] += friction
    if real(speed) > real(numbers[SLIDING]):
        numbers[SLIDING] = speed
    for a in range(3):
        numbers[RUBBED + a] -= s[a]
    gather(machine, k, n, force)


@stage
def velocity_at(bodies, b, p):
    """Velocity of the point of body b that is at p."""
    R, V, w = bodies.R[b], bodies.Rdot[b], bodies.omega[b]
    u0, u1, u2 = p[0] - R[0], p[1] - R[1], p[2] - R[2]
    return V[0] + w[1] * u2 - w[2] * u1, V[1] + w[2] * u0 - w[0] * u2, V[2] + w[0] * u1 - w[1] * u0


@stage
def approach(machine, k):
    """Rate of the overlap at the point of number[POINT:]."""
    record = record_at(machine)
    bodies, body, elements = record.bodies, record.markers.body, record.elements
    p, normal = elements.number[k, POINT:NORMAL], elements.number[k, NORMAL:SUMS]
    v0, v1, v2 = velocity_at(bodies, body[elements.columns[k, MARKER]], p)
    u0, u1, u2 = velocity_at(bodies, body[elements.columns[k, OTHER]], p)
    return (u0 - v0) * normal[0] + (u1 - v1) * normal[1] + (u2 - v2) * normal[2]


@stage
def find_point(machine, k, n):
    """Where point n of contact k may touch and the normal there, left in the numbers; returns the overlap."""
    record = record_at(machine)
    markers, elements = record.markers, record.elements
    numbers = elements.number[k]
    marker, other, kind = elements.columns[k, MARKER], elements.columns[k, OTHER], elements.columns[k, KIND]
    p, normal, size = numbers[POINT:NORMAL], numbers[NORMAL:SUMS], numbers[SIZE:POINT]
    r, A, o = markers.r[marker], markers.A[marker], markers.r[other]
    if kind == SPHERES:
        d0, d1, d2 = r[0] - o[0], r[1] - o[1], r[2] - o[2]
        distance = np.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
        depth = size[0] + size[1] - distance
        if real(distance) == 0.0:
            d2, distance = d2 + 1.0, distance + 1.0  # any direction will do
        normal[0], normal[1], normal[2] = d0 / distance, d1 / distance, d2 / distance
        for a in range(3):
            p[a] = o[a] + (size[1] - 0.5 * depth) * normal[a]
        return depth
    for a in range(3):
        normal[a] = markers.A[other, a, 2]
        p[a] = r[a]
    if kind == BOX:
        corner(A, r, size, n, p)
    elif kind == CYLINDER:
        rim_point(A, r, size, n, normal, p)
    elif kind == HULL:
        hull_corner(A, r, numbers[NUMBERS:], n, p)
    elif kind == CAPSULE:
        z = size[1] if n == 0 else -size[1]
        for a in range(3):
            p[a] += z * A[a, 2]
    height = (p[0] - o[0]) * normal[0] + (p[1] - o[1]) * normal[1] + (p[2] - o[2]) * normal[2]
    depth = size[0] - height if kind in (SPHERE, CAPSULE) else -height
    if kind in (SPHERE, CAPSULE):
        # the force acts on the plane
        for a in range(3):
            p[a] -= height * normal[a]
    return depth


@stage
def speed_of_point(machine, k, n):
    """Velocity with which the point of number[POINT:] itself moves: of corners that of the body there; what rolls passes it on."""
    record = record_at(machine)
    markers, bodies, columns, numbers = (
        record.markers,
        record.bodies,
        record.elements.columns[k],
        record.elements.number[k],
    )
    i, j, kind, p = columns[MARKER], columns[OTHER], columns[KIND], numbers[POINT:NORMAL]
    w, W = bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    if kind == ROUND:
        v, u = velocity_at(bodies, markers.body[i], p), velocity_at(bodies, markers.body[j], p)
        return 0.5 * (v[0] + u[0]), 0.5 * (v[1] + u[1]), 0.5 * (v[2] + u[2])
    normal, o = (numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]), markers.r[j]
    r = markers.r[i, 0], markers.r[i, 1], markers.r[i, 2]
    if kind == CAPSULE:
        z = numbers[SIZE + 1] if n == 0 else -numbers[SIZE + 1]
        r = plus(r, times(z, axis(markers.A[i], 2)))
    if kind in (SPHERE, SPHERES, CAPSULE):
        own = plus(markers.rdot[i], cross(w, minus(r, markers.r[i])))
        d, speed = minus(r, o), minus(own, markers.rdot[j])
        if kind == SPHERES:
            # p - o = s n, s half of the way between both surfaces
            out, distance, s = dot(normal, speed), dot(normal, d), dot(normal, minus(p, o))
            a, b = s / distance, (0.5 - s / distance) * out
            return plus(
                markers.rdot[j],
                (a * speed[0] + b * normal[0], a * speed[1] + b * normal[1], a * speed[2] + b * normal[2]),
            )
        out, turning = dot(normal, minus(speed, cross(W, d))), cross(W, normal)
        height = dot(normal, d)
        down = (
            out * normal[0] + height * turning[0],
            out * normal[1] + height * turning[1],
            out * normal[2] + height * turning[2],
        )
        return minus(own, down)
    if kind == CYLINDER:
        a = axis(markers.A[i], 2)
        sigma = dot(a, normal)
        h = np.sqrt(1.0 - sigma * sigma) if real(sigma * sigma) < 1.0 - UPRIGHT else 0.0 * sigma
        if real(h) > 0.0:
            # the axis and the direction to the lowest point of a rim turn with this velocity
            turning, t = cross(minus(w, W), a), cross(a, normal)
            spin = -sigma / (h * h) * dot(t, turning)
            across = cross(a, turning)
            v = plus(W, (across[0] + spin * a[0], across[1] + spin * a[1], across[2] + spin * a[2]))
            return plus(markers.rdot[i], cross(v, minus(p, r)))
    return velocity_at(bodies, markers.body[i], p)


@stage
def gather(machine, k, n, force):
    """Add the force at the point of number[POINT:] to the sums: force, its moments of first order about the marker; for a patch those of
    second order, and force times velocity of the point."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    d = minus(numbers[POINT:NORMAL], markers.r[columns[MARKER]])
    sums = numbers[SUMS:RUBBED]
    sums[0] += force
    for a in range(3):
        sums[1 + a] += force * d[a]
    if columns[PATCH] != NONE:
        v = speed_of_point(machine, k, n)
        sums[4] += force * dot(d, d)
        for a in range(3):
            sums[5 + a] += force * v[a]


@stage
def find_patch(machine, k):
    """The patch of contact k, from its sums."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    sums, count, j = numbers[SUMS:RUBBED], np.int64(columns[AXES]), columns[OTHER]
    first, q = np.int64(columns[PATCH]), np.int64(columns[COORDINATE])
    load = sums[0]
    if not real(load) > 0.0:
        leave_patch(machine, first, count, q)
        return
    d, reach = middle_of(sums)
    n = numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]
    t, u = axis(markers.A[j], 0), axis(markers.A[j], 1)
    if columns[KIND] in (SPHERES, ROUND):
        t, u = tangents(markers.A[j], n)
    p, pdot = plus(markers.r[columns[MARKER]], d), (sums[5] / load, sums[6] / load, sums[7] / load)
    o = 0.0 * load
    over, change, spin, spin_rate = (o, o, o), (o, o, o), o, o
    if columns[SURFACE] != NONE:
        moving, frame = numbers[MOVING:NUMBERS], columns[SURFACE + 2]
        over, change = surface_at(machine, frame, moving, p), surface_rate_at(machine, frame, moving, p, pdot)
        spin, spin_rate = o + moving[SPIN], o + moving[SPIN_RATE]
    write_patch(machine, first, count, q, p, pdot, n, t, u, load, reach, over, change, spin, spin_rate)


@stage
def is_far(machine, k):
    """Whether the ball of the shape is far from the plane, and was: then its distance stands for that of all points."""
    record = record_at(machine)
    markers, elements, followed = record.markers, record.elements, record.watched.followed[0]
    columns, numbers = elements.columns[k], elements.number[k]
    i, j, radius = columns[MARKER], columns[OTHER], numbers[RADIUS]
    n, d = axis(markers.A[j], 2), minus(markers.r[i], markers.r[j])
    gap = dot(n, d) - radius
    if not real(gap) > FAR * real(radius) or columns[KIND] == SPHERES:
        return False
    if followed == 1:
        for m in range(columns[COUNT]):
            if elements.memory[k, m] > 0.0:
                return False
    speed = minus(minus(markers.rdot[i], markers.rdot[j]), cross(record.bodies.omega[markers.body[j]], d))
    numbers[DEEPEST], numbers[ITS_RATE] = -gap, -dot(n, speed)
    for m in range(columns[COUNT]):
        elements.depth[k, m], elements.proposal[k, m] = -gap, 0.0 * gap
        if followed == 1:
            elements.depth_rate[k, m] = numbers[ITS_RATE]
    return True


@stage
def press(machine, k, n, depth, rate, t):
    """Push at point n of contact k, where it touches."""
    record = record_at(machine)
    elements, followed, numbers = record.elements, record.watched.followed[0], record.elements.number[k]
    if real(depth) > real(numbers[DEEPEST]):
        numbers[DEEPEST], numbers[ITS_RATE] = depth, rate
    elements.depth[k, n] = depth
    if followed == 1:
        elements.depth_rate[k, n] = rate
    if real(depth) > 0.0 or (followed == 1 and elements.memory[k, n] > 0.0):
        touch(machine, k, n, depth, t)
    else:
        elements.proposal[k, n] = 0.0


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
def report_contact(machine, k):
    """Patch and outputs of contact k, from its sums."""
    record = record_at(machine)
    columns, numbers, out = record.elements.columns[k], record.elements.number[k], record.outputs.value
    if columns[PATCH] != NONE:
        find_patch(machine, k)
    first, force, friction = columns[OUTPUT], numbers[SUMS], numbers[RUBBING]
    out[first] = np.sqrt(force * force + friction * friction)
    out[first + 1], out[first + DEPTH], out[first + FORCE] = numbers[POWER], numbers[DEEPEST], force
    out[first + RATE], out[first + RUB], out[first + SLIP] = numbers[ITS_RATE], friction, numbers[SLIDING]
    if real(force) > 0.0:
        d = numbers[SUMS + 1] / force, numbers[SUMS + 2] / force, numbers[SUMS + 3] / force
        p = plus(record.markers.r[columns[MARKER]], d)
        write_touch(machine, first, p, numbers[NORMAL:SUMS], numbers[RUBBED:RUBBING], numbers[LOST], numbers[GIVEN])
    else:
        leave_touch(machine, first)


@family
def apply(machine, number, t):
    """All contacts."""
    elements = record_at(machine).elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        begin_contact(machine, k, t)
        if not is_far(machine, k):
            for n in range(elements.columns[k, COUNT]):
                depth = find_point(machine, k, n)
                press(machine, k, n, depth, approach(machine, k), t)
        report_contact(machine, k)
    return OK
