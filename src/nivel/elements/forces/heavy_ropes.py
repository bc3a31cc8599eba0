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

import numpy as np

from nivel.elements.forces.wound_ropes import (
    USED,
    UX,
    UY,
    RopeRow,
    arc_at,
    at,
    centre_of,
    find_parts,
    lay_out,
    let_off,
    next_touched,
    paid_out,
    way_between,
)
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, opposite, plus, seen, times, turned
from nivel.kernels.forces.wrench import add_force_at, add_torque, velocity_at
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# of `columns` behind the markers: the place p; states: y and ẏ
PAST, TRAVEL, RUN = 0, 1, 2
# of `number` behind the places: mass per length, L_B
PER_LENGTH, BEHIND = 0, 1


@leaf
def height(bodies, own):
    """Height of a place times g [m²/s²]."""
    return -dot(bodies.gravity, centre_of(own))


@leaf
def slopes(bodies, A, own):
    """Rise of h along the free part that leaves a place, in the plane of the axis, and along u × n, from the centre to the rope [m/s²]."""
    gx, gy, _ = opposite(seen(A, bodies.gravity))
    return own[UX] * gx + own[UY] * gy, own[UY] * gx - own[UX] * gy


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
    carrier, rate, j = markers.body[index[RopeRow.AXIS]], 0.0 * numbers[RopeRow.STIFFNESS], 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a, b = numbers[at(j) : at(j + 1)], numbers[at(i) : at(i + 1)]
        part = 1.0 if (i <= p) == before else 0.0
        first = 1.0 if is_before(j, p) == before else 0.0
        last = 1.0 if is_before(i, p) == before else 0.0
        f, moment, _ = way_between(A, a, b, part, first, last, 0.0)
        v = velocity_at(bodies, markers.body[index[RopeRow.ALONG + i]], centre_of(b))
        u = velocity_at(bodies, markers.body[index[RopeRow.ALONG + j]], centre_of(a))
        rate += dot(f, minus(v, u)) - dot(moment, bodies.omega[carrier])
        j = i
    for end in range(2):
        j = 0 if end == 0 else count - 1
        if is_before(j, p) == before:
            used, drum = numbers[at(j) + USED], markers.body[index[RopeRow.ALONG + j]]
            rate += (-used if end == 0 else used) * dot(bodies.omega[drum], n)
    return rate


@stage
def ways(machine, k):
    """(s_A, s_B, Σ length · h) of the way as its places are laid out, and the least h up to p and behind it."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    p = np.int64(index[RopeRow.ALONG + count + PAST])
    first, second = 0.0 * numbers[RopeRow.STIFFNESS], 0.0 * numbers[RopeRow.STIFFNESS]
    heavy = 0.0 * numbers[RopeRow.STIFFNESS]
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
            whole = way_between(A, own, b, 0.0, 0.0, 0.0, 0.0)[2]
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
    p, A = np.int64(index[RopeRow.ALONG + count + PAST]), markers.A[index[RopeRow.AXIS]]
    carrier, gravity, before, j = markers.body[index[RopeRow.AXIS]], bodies.gravity, 0, 0
    while j < count:
        a = numbers[at(j) : at(j + 1)]
        ba, ha, along, out = markers.body[index[RopeRow.ALONG + j]], height(bodies, a) - mean, 0.0 * mean, 0.0 * mean
        if j < count - 1:
            along, out = slopes(bodies, A, a)
        on_first = (ahead if is_before(j, p) else behind) + density * (ha + a[USED] * out if j > 0 else ha)
        if real(a[USED]) != 0.0:
            r = a[USED] if real(a[USED]) > 0.0 else -a[USED]
            add_force_at(bodies, ba, centre_of(a), times(density * r * arc_at(machine, k, j, before), gravity))
        if j in (0, count - 1):
            add_torque(bodies, ba, times(on_first * (a[USED] if j == 0 else -a[USED]), n))
        i = next_touched(numbers, j, count) if j < count - 1 else count
        if i < count:
            b = numbers[at(i) : at(i + 1)]
            bb, hb = markers.body[index[RopeRow.ALONG + i]], height(bodies, b) - mean
            on_last = (ahead if is_before(i, p) else behind) + density * (hb + b[USED] * out if i < count - 1 else hb)
            both = 0.5 * (a[USED] + b[USED])
            on_part = (ahead if i <= p else behind) + density * (0.5 * (ha + hb) + both * out)
            f, moment, whole = way_between(A, a, b, on_part, on_first, on_last, density * both * along)
            weight = times(0.5 * density * whole, gravity)
            add_force_at(bodies, ba, centre_of(a), plus(weight, f))
            add_force_at(bodies, bb, centre_of(b), minus(weight, f))
            add_torque(bodies, carrier, moment)
            # weight beside the centres tilts the wheels
            off, ahead_of = whole * both, 0.0 * both
            if j > 0:
                ahead_of -= a[USED] * a[USED]
            if i < count - 1:
                ahead_of += b[USED] * b[USED]
            lever = off * a[UY] + ahead_of * a[UX], ahead_of * a[UY] - off * a[UX], 0.0 * off
            c = cross(turned(A, lever), gravity)
            add_torque(bodies, carrier, times(density, minus(c, times(dot(c, n), n))))
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


@element
def apply(machine, k, index, n, t):
    """Tensions of both halves, weight, and the motion of the mass along the way; its kinetic energy is among what is stored."""
    record = record_at(machine)
    bodies, elements, control, out = record.bodies, record.elements, record.control, record.outputs.value
    count = np.int64(index[RopeRow.COUNT])
    own, base = RopeRow.ALONG + count, at(count)
    axle = lay_out(machine, k)
    find_parts(n, count)
    if let_off(machine, k):
        find_parts(n, count)
    first, second, heavy, low, other_low = ways(machine, k)
    travel, run = elements.state[index[own + TRAVEL]], elements.state[index[own + RUN]]
    length, speed = paid_out(machine, k, t, 0.0 * first)
    ahead, its_rate = first + travel - (length - n[base + BEHIND]), rate_along(machine, k, axle, True)
    behind, other_rate = second - travel - n[base + BEHIND], rate_along(machine, k, axle, False)
    per_length, way = n[base + PER_LENGTH], first + second
    mass, mean = per_length * length, heavy / way
    least, other_least = least_of(mass / way, low, mean), least_of(mass / way, other_low, mean)
    stiffness, damping = n[RopeRow.STIFFNESS], n[RopeRow.DAMPING]
    one, one_elastic, one_stored = tension_of(stiffness, damping, ahead, its_rate + run - speed, least)
    two, two_elastic, two_stored = tension_of(stiffness, damping, behind, other_rate - run, other_least)
    elements.state_rate[index[own + TRAVEL]] += run
    elements.state_rate[index[own + RUN]] += (two - one) / mass
    act(machine, k, axle, one, two, mass / way, mean)
    control.stored[0] += one_stored + two_stored + 0.5 * mass * run * run + mass * mean
    # the winch pulls, and feeds rope that runs and is high
    control.power[0] += speed * (per_length * (0.5 * run * run + mean) - one)
    control.power[1] += (one - one_elastic) * (its_rate + run - speed) + (two - two_elastic) * (other_rate - run)
    elements.depth[k, 0] = ahead + behind
    if record.watched.followed[0] == 1:
        elements.depth_rate[k, 0] = its_rate + other_rate - speed
    output, last = index[RopeRow.OUTPUT], n[at(count - 1) : at(count)]
    out[output] = one + mass / way * (height(bodies, n[at(0) : at(1)]) - mean)
    out[output + 1], out[output + 2] = -one * its_rate - two * other_rate, ahead + behind
    out[output + 3] = two + mass / way * (height(bodies, last) - mean)
