"""Contact of spheres, boxes, cylinders and convex hulls with planes, and of spheres with each other.

A box and a hull touch with their corners. A cylinder touches with four points of each rim, the lowest one and those a quarter turn
on, so it rolls on exact circles and stands on four feet. Normal force: `nivel.kernels.forces.impact`, or a law of the user, which
works from outside and never pulls. Friction of every point: μ N tanh(v/v_s) against the sliding velocity of the bodies there; or that of a
patch of all points, which sticks: `nivel.kernels.elements.patch`.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import maximum, real, tanh
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, leave_patch, middle_of, minus, plus, tangents, write_patch
from nivel.kernels.forces.impact import impact
from nivel.kernels.forces.wrench import add_force_at
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`; MARKER: centre and axes of the shape (a cylinder's is z); OTHER: the plane (z outwards), or the other sphere;
# LAW: of the normal force, or NONE; COUNT: points that may touch; PATCH: first friction of a patch, or NONE, AXES: how many it has,
# COORDINATE: the first of these
OUTPUT, KIND, MARKER, OTHER, LAW, COUNT, PATCH, AXES, COORDINATE = 0, 1, 2, 3, 4, 5, 6, 7, 8
# outputs: magnitude, power, deepest overlap, normal force, rate of the deepest overlap, friction, speed of slip; a law reads overlap and
# rate of its point there
DEPTH, FORCE, RATE, RUB, SLIP = 2, 3, 4, 5, 6
SPHERE, BOX, CYLINDER, SPHERES, HULL = 0, 1, 2, 3, 4
# columns of `number`; SIZE: radius; half lengths; radius and half length; the two radii. Then a point, a normal and sums of work; then the
# corners of a hull in the axes of its marker, three numbers each.
STIFFNESS, EXPONENT, LOSS, FRICTION, TRANSITION, SIZE, POINT, NORMAL, SUMS = 0, 1, 2, 3, 4, 5, 8, 11, 14
NUMBERS = 22
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
    """Forces at the point of number[POINT:], normal number[NORMAL:] from the other body to this one; returns (N, friction, power, speed of
    slip)."""
    record = record_at(machine)
    bodies, markers, elements, control = record.bodies, record.markers, record.elements, record.control
    numbers = elements.number[k]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:SUMS]
    this, other = markers.body[elements.columns[k, MARKER]], markers.body[elements.columns[k, OTHER]]
    v0, v1, v2 = velocity_at(bodies, this, p)
    u0, u1, u2 = velocity_at(bodies, other, p)
    v0, v1, v2 = v0 - u0, v1 - u1, v2 - u2
    out = v0 * normal[0] + v1 * normal[1] + v2 * normal[2]
    if elements.columns[k, LAW] != NONE:
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
    s0, s1, s2 = v0 - out * normal[0], v1 - out * normal[1], v2 - out * normal[2]
    speed = np.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
    friction = 0.0 * force
    if real(numbers[FRICTION]) > 0.0 and real(speed) > 0.0:
        friction = numbers[FRICTION] * force * tanh(speed / numbers[TRANSITION])
        s0, s1, s2 = friction * s0 / speed, friction * s1 / speed, friction * s2 / speed
        control.power[1] += friction * speed
    else:
        s0, s1, s2 = 0.0, 0.0, 0.0
    x, y, z = force * normal[0] - s0, force * normal[1] - s1, force * normal[2] - s2
    power = add_force_at(bodies, this, p, x, y, z)
    power += add_force_at(bodies, other, p, -x, -y, -z)
    return force, friction, power, speed


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
    height = (p[0] - o[0]) * normal[0] + (p[1] - o[1]) * normal[1] + (p[2] - o[2]) * normal[2]
    depth = size[0] - height if kind == SPHERE else -height
    if kind == SPHERE:
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
    normal, r, o = (numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]), markers.r[i], markers.r[j]
    if kind in (SPHERE, SPHERES):
        d, speed = minus(r, o), minus(markers.rdot[i], markers.rdot[j])
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
        return minus(markers.rdot[i], down)
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
    """Add the force at the point of number[POINT:] to the sums for the patch: force, its moments of first and second order about the
    marker, force times velocity of the point."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    d, v = minus(numbers[POINT:NORMAL], markers.r[columns[MARKER]]), speed_of_point(machine, k, n)
    sums = numbers[SUMS:NUMBERS]
    sums[0] += force
    sums[4] += force * dot(d, d)
    for a in range(3):
        sums[1 + a] += force * d[a]
        sums[5 + a] += force * v[a]


@stage
def find_patch(machine, k):
    """The patch of contact k, from its sums."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    sums, count, j = numbers[SUMS:NUMBERS], np.int64(columns[AXES]), columns[OTHER]
    first, q = np.int64(columns[PATCH]), np.int64(columns[COORDINATE])
    load = sums[0]
    if not real(load) > 0.0:
        leave_patch(machine, first, count, q)
        return
    d, reach = middle_of(sums)
    n = numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]
    t, u = axis(markers.A[j], 0), axis(markers.A[j], 1)
    if columns[KIND] == SPHERES:
        t, u = tangents(markers.A[j], n)
    p, pdot = plus(markers.r[columns[MARKER]], d), (sums[5] / load, sums[6] / load, sums[7] / load)
    write_patch(machine, first, count, q, p, pdot, n, t, u, load, reach)


@family
def apply(machine, number, t):
    """All contacts."""
    record = record_at(machine)
    elements, followed = record.elements, record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        nothing = 0.0 * elements.number[k, STIFFNESS]
        normal_force, friction_force, power, slip = nothing, nothing, nothing, nothing
        deepest, its_rate = nothing - np.inf, nothing
        sticks = elements.columns[k, PATCH] != NONE
        if sticks:
            for a in range(SUMS, NUMBERS):
                elements.number[k, a] = nothing
        for n in range(elements.columns[k, COUNT]):
            depth = find_point(machine, k, n)
            rate = approach(machine, k)
            if real(depth) > real(deepest):
                deepest, its_rate = depth, rate
            elements.depth[k, n] = depth
            if followed == 1:
                elements.depth_rate[k, n] = rate
            if real(depth) > 0.0 or (followed == 1 and elements.memory[k, n] > 0.0):
                force, friction, gained, speed = touch(machine, k, n, depth, t)
                normal_force += force
                friction_force += friction
                power += gained
                slip = speed if real(speed) > real(slip) else slip
                if sticks:
                    gather(machine, k, n, force)
            else:
                elements.proposal[k, n] = 0.0
        if sticks:
            find_patch(machine, k)
        out = record.outputs.value
        first = elements.columns[k, OUTPUT]
        out[first] = np.sqrt(normal_force * normal_force + friction_force * friction_force)
        out[first + 1], out[first + DEPTH], out[first + FORCE], out[first + RATE] = (
            power,
            deepest,
            normal_force,
            its_rate,
        )
        out[first + RUB], out[first + SLIP] = friction_force, slip
    return OK
