"""Tracks: patches along a belt, which presses on hard ground or on soil and drives by shear.

The belt lies on the line between two points of its frame, x from the end where shoes are laid down. Its shoes run back at the speed b = r Ω
of the sprocket against the frame, so they slide at v = V - b. A patch has the strength S: μ N on hard ground (N: load), A c + N tan φ on
soil (A: area). The share s of it along and across is of the shoes that are there:

    ∂s/∂t + b ∂s/∂x = u,   u = -(v + |v| s)/(K + τ |v|),   F = S (s + τ u)

With the slip i in one direction s = 1 - exp(-i x/K), whose sum over an even load is the drawbar pull of Wong (2008, 2.5) after Janosi and
Hanamoto (1961). τ is a damper. What a patch hands on is this solution at its end, so a few patches have that sum to all digits. At rest
u = 0: nothing creeps. On hard ground, where also a vibration must not make it creep, |v| s counts as sliding does in a tyre.

Each patch stands on the ground at two places of Gauss beside its middle. Hard ground gives way elastically, along the gradient of the
depth, so that energy is kept. Soil bears k z^n, normal to the belt, as a yield that its cells remember. Pressing it down at the leading end
costs ∫ p dz over the width for each metre (Bekker 1969), with the share that a blade's resistances have.
"""

import numpy as np

from nivel.elements.contacts.heights import surface
from nivel.elements.contacts.soil import ForceRow, SoilRow
from nivel.elements.contacts.soil_cells import (
    FAR,
    UNCUT,
    between_nodes,
    mobilised_rate,
    nodes_between,
    pressure_at,
    seen_from_corner,
)
from nivel.elements.forces.tyre import CARCASS_TIME, LEAST_GRIP, rocked, root, sliding_share
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import absolute, maximum, real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, opposite, plus, put, seen, times, turned
from nivel.kernels.forces.wrench import add_force_at, add_torque, velocity_at
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

GAUSS = 0.5 / np.sqrt(3.0)  # of the width, from the middle to a place of Gauss
KEPT = 4  # numbers of a patch: normal and strength
FEW, MANY = 1e-3, 40.0  # exponents below which a series is taken, and beyond which nothing is left
# outputs behind magnitude and power
PULL, LATERAL, MOMENT, DRIVING, SINKAGE, SLIP, SLIP_LOSS, RESISTANCE, PLACE, OUTPUTS = 2, 3, 4, 5, 6, 7, 8, 9, 10, 12


@stage
def belt_of(machine, index, n):
    """(middle, direction forwards, to the left, and out of the ground, length of the belt, its speed)."""
    record = record_at(machine)
    markers, bodies, i, j = record.markers, record.bodies, index[ForceRow.FRONT], index[ForceRow.REAR]
    d = minus(markers.r[i], markers.r[j])
    length = np.sqrt(dot(d, d))
    f = times(1.0 / length, d)
    s = cross(axis(markers.A[i], 2), f)
    s = times(1.0 / np.sqrt(dot(s, s)), s)
    turning = minus(bodies.omega[markers.body[index[ForceRow.SPROCKET]]], bodies.omega[markers.body[i]])
    return times(0.5, plus(markers.r[i], markers.r[j])), f, s, cross(f, s), length, n[ForceRow.RADIUS] * dot(turning, s)


@stage
def beside(middle, f, s, along, across):
    """A point of the belt."""
    return plus(middle, plus(times(along, f), times(across, s)))


@leaf
def place_of(k, count, length):
    """How far the middle of patch k is before the middle of the belt."""
    return (0.5 - (k + 0.5) / count) * length


@leaf
def handed_on(x):
    """x/(exp x - 1): of what a patch has beside its limit, the part at its end."""
    if real(x) < FEW:
        return 1.0 - 0.5 * x + x * x / 12.0
    return x / (np.exp(x) - 1.0) if real(x) < MANY else 0.0 * x


@stage
def shear_belt(machine, index, n, belt, shear_length, ahead, sticks):
    """Shear of all patches, whose normals and strengths are among the numbers; returns (power, force along, across, moment about the
    middle, moment on the sprocket, power lost by sliding)."""
    record = record_at(machine)
    markers, bodies, share, rate = record.markers, record.bodies, record.elements.state, record.elements.state_rate
    middle, f, s, _, length, run = belt
    frame, road = markers.body[index[ForceRow.FRONT]], markers.body[index[ForceRow.PLANE]]
    count, o = np.int64(index[ForceRow.PATCHES]), 0.0 * run
    passing = rocked(run) * count / length
    power, pull, lateral, moment, driven, lost, in_x, in_y = o, o, o, o, o, o, o, o
    for j in range(count):
        k = j if real(run) >= 0.0 else count - 1 - j
        own, shares = n[ForceRow.WORK + KEPT * k :], index[ForceRow.SHARES + 2 * k :]
        x, y = shares[0], shares[1]
        normal = own[0], own[1], own[2]
        a = cross(normal, f)
        a = times(1.0 / np.sqrt(dot(a, a)), a)
        t, along = cross(a, normal), place_of(k, count, length)
        p = beside(middle, f, s, along, o)
        v = minus(velocity_at(bodies, frame, p), velocity_at(bodies, road, p))
        part = dot(f, t)
        vx, vy, sx, sy = dot(v, t) - run * part, dot(v, a), share[x], share[y]
        speed, size = root(vx * vx + vy * vy), root(sx * sx + sy * sy)
        slides = speed
        if sticks:
            slides *= sliding_share(size, real(vx * sx + vy * sy) > 0.0, speed)
            if real(size) > 1.0:  # more than the grip is at no rest
                slides += (size - 1.0) * shear_length / ahead
        ux = -(vx + slides * sx) / (shear_length + ahead * slides)
        uy = -(vy + slides * sy) / (shear_length + ahead * slides)
        if real(own[3]) <= 0.0:
            ux, uy, out_x, out_y = -sx / CARCASS_TIME, -sy / CARCASS_TIME, sx, sy
        elif real(passing) > 0.0 and real(speed) > 0.0:
            left = handed_on(speed / ((shear_length + ahead * speed) * passing))
            out_x, out_y = left * sx - (1.0 - left) * vx / speed, left * sy - (1.0 - left) * vy / speed
        else:
            out_x, out_y = sx, sy
        rate[x] += ux + passing * (in_x - out_x)
        rate[y] += uy + passing * (in_y - out_y)
        in_x, in_y = out_x, out_y
        fx, fy = own[3] * (sx + ahead * ux), own[3] * (sy + ahead * uy)
        force = plus(times(fx, t), times(fy, a))
        power += add_force_at(bodies, frame, p, force) + add_force_at(bodies, road, p, opposite(force))
        pull, lateral, driven = pull + fx * part, lateral + fy, driven - n[ForceRow.RADIUS] * fx * part
        moment, lost = moment + along * fy, lost - fx * vx - fy * vy
    power += add_torque(bodies, markers.body[index[ForceRow.SPROCKET]], times(driven, s))
    power += add_torque(bodies, frame, times(-driven, s))
    return power, pull, lateral, moment, driven, lost


@stage
def tell(machine, index, belt, sums, load, power, resisted, deepest):
    """Outputs of a track. sums : of `shear_belt`."""
    record = record_at(machine)
    markers, middle, f, run = record.markers, belt[0], belt[1], belt[5]
    out, m = record.outputs.value[index[ForceRow.OUTPUT] :], index[ForceRow.PLANE]
    frame, road = markers.body[index[ForceRow.FRONT]], markers.body[m]
    v = dot(minus(velocity_at(record.bodies, frame, middle), velocity_at(record.bodies, road, middle)), f)
    fastest = maximum(absolute(v), absolute(run))
    put(out, 0, (load, power, sums[1] + resisted))
    put(out, LATERAL, (sums[2], sums[3], sums[4]))
    put(out, SINKAGE, (deepest, (run - v) / fastest if real(fastest) > 0.0 else 0.0 * v, sums[5]))
    out[RESISTANCE] = -resisted
    out[PLACE], out[PLACE + 1], _ = seen(markers.A[m], minus(middle, markers.r[m]))


@element
def apply(machine, index, n, t):
    """A track on hard ground."""
    record = record_at(machine)
    markers, bodies, control, out = record.markers, record.bodies, record.control, record.outputs.value
    belt = belt_of(machine, index, n)
    middle, f, s, b, length, run = belt
    m, first = index[ForceRow.PLANE], np.int64(index[ForceRow.OUTPUT])
    frame, road, A = markers.body[index[ForceRow.FRONT]], markers.body[m], markers.A[m]
    count, o = np.int64(index[ForceRow.PATCHES]), 0.0 * run
    heights = n[ForceRow.WORK + KEPT * count :]
    c, d = 0.5 / count * n[ForceRow.STIFFNESS], 0.5 / count * n[ForceRow.DAMPING]
    load, power, spread, deepest = o, o, o, -np.inf
    for k in range(count):
        total, along = (o, o, o), place_of(k, count, length)
        for side in range(2):
            p = beside(middle, f, s, along, (2.0 * side - 1.0) * GAUSS * n[ForceRow.WIDTH])
            x, y, z = seen(A, minus(p, markers.r[m]))
            h, gx, gy = o, o, o
            if index[ForceRow.UNEVEN] == 1:
                h, gx, gy, _, _, _ = surface(heights, x, y)
            out[first + PLACE] = x if side == 0 else 0.5 * (out[first + PLACE] + x)
            out[first + PLACE + 1] = y if side == 0 else 0.5 * (out[first + PLACE + 1] + y)
            depth, g = h - z, turned(A, (-gx, -gy, 1.0 + o))
            deepest = max(deepest, real(depth))
            if real(depth) <= 0.0:
                continue
            sinking = -dot(g, minus(velocity_at(bodies, frame, p), velocity_at(bodies, road, p)))
            press = maximum(c * depth + d * sinking, o)
            control.stored[0] += 0.5 * c * depth * depth
            spread += (press - c * depth) * sinking
            force = times(press, g)
            power += add_force_at(bodies, frame, p, force) + add_force_at(bodies, road, p, opposite(force))
            total = plus(total, force)
        size = root(dot(total, total))
        normal = times(1.0 / size, total) if real(size) > 0.0 else b
        grip = maximum(evaluate_function(machine, index[ForceRow.GRIP], t), LEAST_GRIP + o)
        put(n, ForceRow.WORK + KEPT * k, normal)
        n[ForceRow.WORK + KEPT * k + 3] = grip * size
        load += size
    sums = shear_belt(machine, index, n, belt, n[ForceRow.SHEAR_LENGTH], CARCASS_TIME, True)
    control.power[1] += spread - sums[0]
    tell(machine, index, belt, sums, load, power + sums[0], o, deepest + o)


@stage
def resist(machine, index, n, cells, belt, sign, state):
    """(force along the belt, power) of soil that is pressed down before its front end (sign 1) or its rear end (-1)."""
    record = record_at(machine)
    markers, number = record.markers, cells.number
    middle, f, s, _, length, _ = belt
    m, frame = index[ForceRow.PLANE], markers.body[index[ForceRow.FRONT]]
    cell, more, work = number[SoilRow.CELL], number[SoilRow.EXPONENT] + 1.0, 0.0 * length
    for side in range(2):
        across = (2.0 * side - 1.0) * GAUSS * n[ForceRow.WIDTH]
        _, _, bottom = seen_from_corner(cells, markers, m, beside(middle, f, s, 0.5 * sign * length, across))
        before = sign * (0.5 * length + UNCUT * cell)
        x, y, _ = seen_from_corner(cells, markers, m, beside(middle, f, s, before, across))
        h, rest = between_nodes(cells.h, cell, x, y), between_nodes(cells.rest, cell, x, y)
        if real(h) > real(bottom):
            pressed = maximum(rest - h, 0.0 * h)
            work += (maximum(rest - bottom, 0.0 * h) ** more - pressed**more) / more
    p = beside(middle, f, s, 0.5 * sign * length, 0.0 * length)
    v = sign * dot(f, velocity_at(record.bodies, frame, p))
    share = record.elements.state[state]
    record.elements.state_rate[state] += mobilised_rate(v, share)
    force = -sign * share * 0.5 * n[ForceRow.WIDTH] * number[SoilRow.MODULUS] * work
    return force, add_force_at(record.bodies, frame, p, times(force, f))


@stage
def crawl(machine, index, n, cells, ahead):
    """Forces of soil on a track; returns their power."""
    record = record_at(machine)
    markers, bodies, number = record.markers, record.bodies, cells.number
    belt = belt_of(machine, index, n)
    middle, f, s, b, length, run = belt
    m, frame, o = index[ForceRow.PLANE], markers.body[index[ForceRow.FRONT]], 0.0 * run
    count, cell, tangent = (
        np.int64(index[ForceRow.PATCHES]),
        number[SoilRow.CELL],
        np.tan(number[SoilRow.FRICTION_ANGLE]),
    )
    area = 0.5 / count * length * n[ForceRow.WIDTH]
    load, power, deepest = o, o, -np.inf
    for k in range(count):
        along, strength = place_of(k, count, length), o
        for side in range(2):
            p = beside(middle, f, s, along, (2.0 * side - 1.0) * GAUSS * n[ForceRow.WIDTH])
            x, y, bottom = seen_from_corner(cells, markers, m, p)
            h, rest = between_nodes(cells.h, cell, x, y), between_nodes(cells.rest, cell, x, y)
            lifted = dot(axis(markers.A[m], 2), velocity_at(bodies, frame, p))
            pressure = pressure_at(number, h, rest, bottom, -ahead * lifted)
            deepest = max(deepest, real(rest - bottom))
            if real(pressure) > 0.0:
                strength += area * (number[SoilRow.COHESION] + pressure * tangent)
                load += area * pressure
                power += add_force_at(bodies, frame, p, times(area * pressure, b))
        put(n, ForceRow.WORK + KEPT * k, b)
        n[ForceRow.WORK + KEPT * k + 3] = strength
    sums = shear_belt(machine, index, n, belt, number[SoilRow.SHEAR_LENGTH], ahead, False)
    front, first = resist(machine, index, n, cells, belt, 1.0, index[ForceRow.PUSH])
    rear, second = resist(machine, index, n, cells, belt, -1.0, index[ForceRow.BEARING])
    power += sums[0] + first + second
    tell(machine, index, belt, sums, load, power, front + rear, deepest + o)
    return power


@stage
def press_cells(machine, index, n, cells):
    """Cells under a belt sink to where their pressure is what they bear."""
    markers, number, cell = record_at(machine).markers, cells.number, cells.number[SoilRow.CELL]
    m = index[ForceRow.PLANE]
    middle, f, s, b, length, _ = belt_of(machine, index, n)
    A, width = markers.A[m], n[ForceRow.WIDTH]
    (cx, cy, cz), (fx, fy, _) = seen_from_corner(cells, markers, m, middle), seen(A, f)
    (sx, sy, _), (bx, by, bz) = seen(A, s), seen(A, b)
    # a belt on its side presses nothing, and a place that is no number ends the run elsewhere
    if not (np.abs(cx + cy) < FAR and bz > GAUSS):
        return
    rx, ry = 0.5 * (np.abs(fx) * length + np.abs(sx) * width), 0.5 * (np.abs(fy) * length + np.abs(sy) * width)
    p0, p1 = nodes_between(cx - rx, cx + rx, cell, cells.h.shape[0])
    q0, q1 = nodes_between(cy - ry, cy + ry, cell, cells.h.shape[1])
    for p in range(p0, p1):
        for q in range(q0, q1):
            dx, dy = p * cell - cx, q * cell - cy
            if np.abs(fx * dx + fy * dy) > 0.5 * length or np.abs(sx * dx + sy * dy) > 0.5 * width:
                continue
            bottom = cz - (bx * dx + by * dy) / bz
            pressure = pressure_at(number, cells.h[p, q], cells.rest[p, q], bottom, 0.0)
            sunk = cells.h[p, q] - bottom - pressure / number[SoilRow.UNLOADING]
            if sunk > 0.0:
                cells.h[p, q] -= sunk
                cells.moved[index[ForceRow.SLOT]] += sunk * cell * cell
