"""Contact of many spheres, each with each other and with planes, in one element.

Every pair has the force of `nivel.kernels.forces.impact` and friction μ N tanh(v/v_s). Pairs are taken in their order, so that sums do not
depend on the way. What is apart costs the square of a distance.
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
from nivel.native.function import part

# columns of `columns`; then the markers of the spheres and those of the planes
OUTPUT, SPHERES, PLANES, FIRST = 0, 1, 2, 3
# outputs: magnitude, power, depth, normal force, friction, power of friction, pairs that touch
DEPTH, FORCE, RUB, LOST, TOUCHING = 2, 3, 4, 5, 6
# columns of `number`; then a point and a normal, which are work, and the radii
STIFFNESS, EXPONENT, LOSS, FRICTION, TRANSITION, POINT, NORMAL, RADII = 0, 1, 2, 3, 4, 5, 8, 11


@part
def push_apart(machine, k, place, i, j, depth):
    """Force of surface `place` of element k between markers i and j at its point and normal, which are in its numbers."""
    record = record_at(machine)
    bodies, elements, control, out = record.bodies, record.elements, record.control, record.outputs.value
    numbers, first, followed = elements.number[k], np.int64(elements.columns[k, OUTPUT]), record.watched.followed[0]
    this, other = record.markers.body[i], record.markers.body[j]
    p, normal = numbers[POINT:NORMAL], numbers[NORMAL:RADII]
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


@family
def apply(machine, number, t):
    """All pairs of all elements."""
    record = record_at(machine)
    elements, markers, followed = record.elements, record.markers, record.watched.followed[0]
    out = record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        columns, numbers = elements.columns[k], elements.number[k]
        count, planes, first = np.int64(columns[SPHERES]), np.int64(columns[PLANES]), np.int64(columns[OUTPUT])
        p, normal, radii = numbers[POINT:NORMAL], numbers[NORMAL:RADII], numbers[RADII:]
        nothing = 0.0 * numbers[STIFFNESS]
        for a in range(7):
            out[first + a] = nothing
        deepest = nothing - np.inf
        place = 0
        for a in range(count):
            i = np.int64(columns[FIRST + a])
            r = markers.r[i]
            for b in range(planes):
                j = np.int64(columns[FIRST + count + b])
                A, o = markers.A[j], markers.r[j]
                height = (r[0] - o[0]) * A[0, 2] + (r[1] - o[1]) * A[1, 2] + (r[2] - o[2]) * A[2, 2]
                depth = radii[a] - height
                if real(depth) > real(deepest):
                    deepest = depth
                if followed == 1 or real(depth) > 0.0 or elements.depth[k, place] > 0.0:
                    for c in range(3):
                        normal[c] = A[c, 2]
                        p[c] = r[c] - height * normal[c]
                    push_apart(machine, k, place, i, j, depth)
                place += 1
            for b in range(a):
                j = np.int64(columns[FIRST + b])
                o, reach = markers.r[j], radii[a] + radii[b]
                d0, d1, d2 = r[0] - o[0], r[1] - o[1], r[2] - o[2]
                squared = d0 * d0 + d1 * d1 + d2 * d2
                # a gap that is above that of the nearest pair needs no root
                near = reach - real(deepest)
                if near > 0.0 and real(squared) < near * near:
                    deepest = reach - np.sqrt(squared)
                if followed == 1 or real(squared) < real(reach) ** 2 or elements.depth[k, place] > 0.0:
                    distance = np.sqrt(squared)
                    depth = reach - distance
                    if real(distance) == 0.0:
                        d2, distance = d2 + 1.0, distance + 1.0  # any direction will do
                    normal[0], normal[1], normal[2] = d0 / distance, d1 / distance, d2 / distance
                    for c in range(3):
                        p[c] = o[c] + (radii[b] - 0.5 * depth) * normal[c]
                    push_apart(machine, k, place, i, j, depth)
                place += 1
        force, rub = out[first + FORCE], out[first + RUB]
        out[first] = np.sqrt(force * force + rub * rub)
        out[first + DEPTH] = deepest
    return OK
