"""Ropes around wheels with a mass m' per length: it runs along the way of the rope past one place p, and has weight all along it.

The unstressed length L has the mass M = m' L, all of which runs at ẏ past p. With the ways s_A up to p and s_B behind it, whose geometry is
that of `nivel.elements.forces.wound_ropes`, both halves are springs of twice the stiffness:

    e_A = s_A + y - L_A,   e_B = s_B - y - L_B,   M ÿ = T_B - T_A

so wound turns turn with their drums, and free parts move along their directions; inertia across the way is left out. A winch feeds L_A with
rope that runs already. The weight spreads over the way s = s_A + s_B, h the height of a place times g:

    V = M h_m,   h_m = (Σ L (h_P + h_Q)/2 + Σ (|r| θ h - r² (u_out - u_in)·∇h))/s

with the ends P, Q of the free parts on their wheels, at c + r u × n, and their directions u. Turns on drums count at the axle.

The tension of a rope without friction grows by m' g times its height: that is what ∂V gives, with half the weight of a free part at each
end.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.forces.wound_ropes import (
    CENTRE,
    USED,
    UX,
    UY,
    RopeRow,
    X,
    Y,
    Z,
    arc_at,
    at,
    find_parts,
    lay_out,
    let_off,
    next_touched,
    paid_out,
    tangent,
    velocity_of,
)
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_force_at, add_torque
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# of `columns` behind the markers: the place p; states: y and ẏ
PAST, TRAVEL, RUN = 0, 1, 2
# of `number` behind the places: mass per length, L_B
PER_LENGTH, BEHIND = 0, 1


@leaf
def gradient(a, b, on_part, on_first, on_last, rise):
    """∂/∂d of w L + arcs at both ends, each with its weight, in the plane (x, y) and along the axis; and L.

    `rise`: weight of the mean height of L as the free part turns about the axis.
    """
    dx, dy, z, rho = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z], b[USED] - a[USED]
    square = dx * dx + dy * dy
    length, _, _ = tangent(dx, dy, rho)
    whole = np.sqrt(length * length + z * z)
    turned = on_last * b[USED] - on_first * a[USED] - rise * whole
    fx = on_part * dx / whole - turned * (rho * dx / length - dy) / square
    fy = on_part * dy / whole - turned * (rho * dy / length + dx) / square
    return fx, fy, on_part * z / whole, whole


@leaf
def height(bodies, own):
    """Height of a place times g [m²/s²]."""
    g = bodies.gravity
    return -(g[0] * own[CENTRE] + g[1] * own[CENTRE + 1] + g[2] * own[CENTRE + 2])


@leaf
def slopes(bodies, A, own):
    """Rise of h along the free part that leaves a place, in the plane of the axis, and along u × n, from the centre to the rope [m/s²]."""
    g, ux, uy = bodies.gravity, own[UX], own[UY]
    gx = -(g[0] * A[0, 0] + g[1] * A[1, 0] + g[2] * A[2, 0])
    gy = -(g[0] * A[0, 1] + g[1] * A[1, 1] + g[2] * A[2, 1])
    return ux * gx + uy * gy, uy * gx - ux * gy


@leaf
def is_before(k, p):
    """Whether the arc at place k is up to p: of a drum at the first end, which is p, its turns."""
    return k < p or (k == 0 and p == 0)


@stage
def rate_along(machine, k, n, before):
    """Rate of the way up to p, or of that behind it."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    p, A = np.int64(index[RopeRow.ALONG + count + PAST]), markers.A[index[RopeRow.AXIS]]
    w = bodies.omega[markers.body[index[RopeRow.AXIS]]]
    turning = cross((w[0], w[1], w[2]), n)
    rate, j = 0.0 * numbers[RopeRow.STIFFNESS], 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a = numbers[at(j) : at(j + 1)]
        b = numbers[at(i) : at(i + 1)]
        part = 1.0 if (i <= p) == before else 0.0
        first = 1.0 if is_before(j, p) == before else 0.0
        last = 1.0 if is_before(i, p) == before else 0.0
        fx, fy, fz, _ = gradient(a, b, part, first, last, 0.0)
        dx, dy, z = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z]
        tx, ty = fz * dx - z * fx, fz * dy - z * fy
        v = velocity_of(bodies, markers.body[index[RopeRow.ALONG + i]], b)
        u = velocity_of(bodies, markers.body[index[RopeRow.ALONG + j]], a)
        for m in range(3):
            rate += (A[m, 0] * fx + A[m, 1] * fy + fz * n[m]) * (v[m] - u[m])
            rate += (A[m, 0] * tx + A[m, 1] * ty) * turning[m]
        j = i
    for end in range(2):
        j = 0 if end == 0 else count - 1
        if is_before(j, p) == before:
            used = numbers[at(j) + USED]
            r, w = -used if end == 0 else used, bodies.omega[markers.body[index[RopeRow.ALONG + j]]]
            rate += r * (w[0] * n[0] + w[1] * n[1] + w[2] * n[2])
    return rate


@stage
def ways(machine, k):
    """(s_A, s_B, Σ length · h) of the way as its places are laid out, and the least h up to p and behind it."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    p = np.int64(index[RopeRow.ALONG + count + PAST])
    first, second, heavy = (
        0.0 * numbers[RopeRow.STIFFNESS],
        0.0 * numbers[RopeRow.STIFFNESS],
        0.0 * numbers[RopeRow.STIFFNESS],
    )
    A, end = markers.A[index[RopeRow.AXIS]], numbers[at(count - 1) : at(count)]
    low, other_low = height(bodies, numbers[at(0) : at(1)]), height(bodies, end)
    into, before, j = 0.0 * heavy, 0, 0
    while j < count:
        own = numbers[at(j) : at(j + 1)]
        h, along, out = height(bodies, own), 0.0 * heavy, 0.0 * heavy
        if j < count - 1:
            along, out = slopes(bodies, A, own)
        if real(own[USED]) != 0.0:
            r = own[USED] if real(own[USED]) > 0.0 else -own[USED]
            arc = r * arc_at(machine, k, j, before)
            heavy += arc * h
            if 0 < j < count - 1:
                heavy -= r * r * (along - into)
            if is_before(j, p):
                first += arc
            else:
                second += arc
        i = next_touched(numbers, j, count) if j < count - 1 else count
        if i < count:
            b = numbers[at(i) : at(i + 1)]
            _, _, _, whole = gradient(own, b, 0.0, 0.0, 0.0, 0.0)
            ha, hb = h + own[USED] * out, height(bodies, b) + b[USED] * out
            lower = ha if real(ha) < real(hb) else hb
            heavy += whole * 0.5 * (ha + hb)
            if i <= p:
                first += whole
                if real(lower) < real(low):
                    low = lower
            else:
                second += whole
                if real(lower) < real(other_low):
                    other_low = lower
        into, before, j = along, j, i
    return first, second, heavy, low, other_low


@stage
def act(machine, k, n, ahead, behind, density, mean):
    """Tensions ahead of p and behind it [N], and the weight of the rope with this mass per length of the way, act on the bodies."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    p, A, carrier = (
        np.int64(index[RopeRow.ALONG + count + PAST]),
        markers.A[index[RopeRow.AXIS]],
        markers.body[index[RopeRow.AXIS]],
    )
    g, before, j = bodies.gravity, 0, 0
    while j < count:
        a = numbers[at(j) : at(j + 1)]
        ba, ha, along, out = markers.body[index[RopeRow.ALONG + j]], height(bodies, a) - mean, 0.0 * mean, 0.0 * mean
        if j < count - 1:
            along, out = slopes(bodies, A, a)
        on_first = (ahead if is_before(j, p) else behind) + density * (ha + a[USED] * out if j > 0 else ha)
        if real(a[USED]) != 0.0:
            r = a[USED] if real(a[USED]) > 0.0 else -a[USED]
            m = density * r * arc_at(machine, k, j, before)
            add_force_at(bodies, ba, a[CENTRE : CENTRE + 3], m * g[0], m * g[1], m * g[2])
        if j in (0, count - 1):
            r = on_first * (-a[USED] if j == 0 else a[USED])
            add_torque(bodies, ba, -r * n[0], -r * n[1], -r * n[2])
        i = next_touched(numbers, j, count) if j < count - 1 else count
        if i < count:
            b = numbers[at(i) : at(i + 1)]
            bb, hb = markers.body[index[RopeRow.ALONG + i]], height(bodies, b) - mean
            on_last = (ahead if is_before(i, p) else behind) + density * (hb + b[USED] * out if i < count - 1 else hb)
            both = 0.5 * (a[USED] + b[USED])
            on_part = (ahead if i <= p else behind) + density * (0.5 * (ha + hb) + both * out)
            fx, fy, fz, whole = gradient(a, b, on_part, on_first, on_last, density * both * along)
            dx, dy, z = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z]
            gx, gy = A[0, 0] * fx + A[0, 1] * fy + fz * n[0], A[1, 0] * fx + A[1, 1] * fy + fz * n[1]
            gz, m = A[2, 0] * fx + A[2, 1] * fy + fz * n[2], 0.5 * density * whole
            add_force_at(bodies, ba, a[CENTRE : CENTRE + 3], gx + m * g[0], gy + m * g[1], gz + m * g[2])
            add_force_at(bodies, bb, b[CENTRE : CENTRE + 3], m * g[0] - gx, m * g[1] - gy, m * g[2] - gz)
            tx, ty = fz * dx - z * fx, fz * dy - z * fy
            tilt = A[0, 0] * tx + A[0, 1] * ty, A[1, 0] * tx + A[1, 1] * ty, A[2, 0] * tx + A[2, 1] * ty
            c = cross(n, tilt)
            add_torque(bodies, carrier, -c[0], -c[1], -c[2])
            # weight beside the centres tilts the wheels
            off, ahead_of = whole * both, 0.0 * both
            if j > 0:
                ahead_of -= a[USED] * a[USED]
            if i < count - 1:
                ahead_of += b[USED] * b[USED]
            sx, sy = off * a[UY] + ahead_of * a[UX], ahead_of * a[UY] - off * a[UX]
            c = cross(
                (A[0, 0] * sx + A[0, 1] * sy, A[1, 0] * sx + A[1, 1] * sy, A[2, 0] * sx + A[2, 1] * sy),
                (g[0], g[1], g[2]),
            )
            about = c[0] * n[0] + c[1] * n[1] + c[2] * n[2]
            add_torque(
                bodies,
                carrier,
                density * (c[0] - about * n[0]),
                density * (c[1] - about * n[1]),
                density * (c[2] - about * n[2]),
            )
        before, j = j, i


@leaf
def tension_of(stiffness, damping, stretch, rate, least):
    """(tension, its elastic part, energy) of one half at height h_m: of twice the stiffness and damping of the rope, not below `least`."""
    elastic = 2.0 * stiffness * stretch
    if real(elastic) <= real(least):
        return least, 0.0 * least, 0.25 * least * least / stiffness
    tension = elastic + 2.0 * damping * rate
    if real(tension) < real(least):
        tension = 0.0 * tension + least
    return tension, elastic, 0.5 * elastic * stretch


@leaf
def least_of(density, low, mean):
    """Tension at height h_m of a half that is slack: above h_m it pulls there by less than nothing before its lowest place is slack."""
    least = density * (mean - low)
    return least if real(least) < 0.0 else 0.0 * least


@family
def apply(machine, number, t):
    """Tensions of both halves, weight, and the motion of the mass along the way; its kinetic energy is among what is stored."""
    record = record_at(machine)
    bodies, elements, control, out = record.bodies, record.elements, record.control, record.outputs.value
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
        own, base = RopeRow.ALONG + count, at(count)
        n = lay_out(machine, k)
        find_parts(numbers, count)
        if let_off(machine, k):
            find_parts(numbers, count)
        first, second, heavy, low, other_low = ways(machine, k)
        travel, run = elements.state[index[own + TRAVEL]], elements.state[index[own + RUN]]
        length, speed = paid_out(machine, k, t, 0.0 * first)
        ahead, its_rate = first + travel - (length - numbers[base + BEHIND]), rate_along(machine, k, n, True)
        behind, other_rate = second - travel - numbers[base + BEHIND], rate_along(machine, k, n, False)
        per_length, way = numbers[base + PER_LENGTH], first + second
        mass, mean = per_length * length, heavy / way
        least, other_least = least_of(mass / way, low, mean), least_of(mass / way, other_low, mean)
        one, one_elastic, one_stored = tension_of(
            numbers[RopeRow.STIFFNESS], numbers[RopeRow.DAMPING], ahead, its_rate + run - speed, least
        )
        two, two_elastic, two_stored = tension_of(
            numbers[RopeRow.STIFFNESS], numbers[RopeRow.DAMPING], behind, other_rate - run, other_least
        )
        elements.state_rate[index[own + TRAVEL]] += run
        elements.state_rate[index[own + RUN]] += (two - one) / mass
        act(machine, k, n, one, two, mass / way, mean)
        control.stored[0] += one_stored + two_stored + 0.5 * mass * run * run + mass * mean
        # the winch pulls, and feeds rope that runs and is high
        control.power[0] += speed * (per_length * (0.5 * run * run + mean) - one)
        control.power[1] += (one - one_elastic) * (its_rate + run - speed) + (two - two_elastic) * (other_rate - run)
        elements.depth[k, 0] = ahead + behind
        if followed == 1:
            elements.depth_rate[k, 0] = its_rate + other_rate - speed
        output, last = index[RopeRow.OUTPUT], numbers[at(count - 1) : at(count)]
        out[output] = one + mass / way * (height(bodies, numbers[at(0) : at(1)]) - mean)
        out[output + 1], out[output + 2] = -one * its_rate - two * other_rate, ahead + behind
        out[output + 3] = two + mass / way * (height(bodies, last) - mean)
    return OK
