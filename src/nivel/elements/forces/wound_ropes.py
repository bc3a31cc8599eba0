"""Ropes around wheels whose axes are parallel: one tension along tangents and arcs, wound up on drums at the ends.

Every place of the rope is a circle of the signed radius r, positive where the rope runs right-handed about the axis n, zero for a point.
Seen along n, a free part between the centres a and b with d = c_b - c_a, ρ = r_b - r_a has, d as a complex number,

    l = √(|d|² - ρ²),   direction u = d (l - iρ)/|d|²,   in space L = √(l² + z²) with z = nᵀ(c_b - c_a)

and the way is s = Σ L + Σ |r| θ with the arcs θ. With the angle α of u, and φ of a drum about n,

    ds = Σ (l dl + z dz)/L - ρ dα - r_first dφ_first + r_last dφ_last,   dl = dᵀdd/l,   dα = (J d)ᵀdd/|d|² + ρ dl/|d|²

so that forces act at the centres, torques on the drums alone, and on the body that carries n where the rope leaves its plane. A wheel that
the rope does not touch is passed over; a drum that is unwound holds the rope at its rim.

With friction there is a tension for every free part, which sticks to the wheels between them or slips (Euler, Eytelwein). The free part p
from wheel a to wheel b has the length L and the direction α; with ρ = r_b - r_a and the angles φ of the wheels about n its stretch is

    e = L - ρ α - r_a φ_a + r_b φ_b - λ,   T = max(0, k e + d ė)

where λ changes alone as the rope slips: by Δ on wheel j, λ of the part behind it grows and that of the part before it shrinks. It slips
where T_behind > T_before exp(μ θ), or the other way round, and so far that both are equal (a return mapping, wheel by
wheel, until all hold).
λ is kept from accepted state to accepted state. All angles are those seen from the body that carries n: e does not depend on its own turn.
Every wheel between the ends is touched all the time, and drums never unwind: the rope lies in grooves and is fixed with turns left.
"""

from collections.abc import Sequence

import numpy as np

from nivel.elements.forces.shafts import flank
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import arctan2, maximum, real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import axis, minus, plus, seen, times, turned
from nivel.kernels.forces.wrench import add_force_at, add_torque, velocity_at
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage


class RopeRow(Row):
    """A rope along COUNT places with markers from ALONG on, of which AXIS turns with the wheels, or along COUNT distances from ALONG on;
    without LENGTH and SPEED where there is no winch. What other ropes have on top stands behind the markers and the PLACES, WIDTH numbers
    each."""

    output: int
    length: int
    speed: int
    count: int
    axis: int = NONE
    along: Sequence[int] = several()
    stiffness: float
    damping: float
    unstressed: float
    places: Sequence[float] = several(default=())


# of a place: signed radius, about which arc [rad] its own is at the start, of a drum the direction [rad] in which the rope is fixed, from
# the marker's x axis; then work: radius in use, centre in space (3), in the plane (x, y, z), direction of the free part behind it (x, y)
RADIUS, NEAR, FIXED, USED, CENTRE, X, Y, Z, UX, UY = 0, 1, 2, 3, 4, 7, 8, 9, 10, 11
WIDTH = 12
# of `number` behind the places: coefficient of friction, length as placed; then PART for each free part: its stiffness, way and direction
# as placed; then work: stretch, its rate, force on its first end per tension, global (3), moment across the axis (3), and the rate of the
# stretch that slip takes from it
FRICTION, PLACED, PARTS = 0, 1, 2
STIFF, WAY, ANGLE, STRETCH, RATE, FORCE, MOMENT, SLIPPED = 0, 1, 2, 3, 4, 5, 8, 11
PART = 12
# of `memory`: whether there is one; of each part λ and its direction; of each wheel its angle
KNOWN, LAMBDA = 0, 1
# Sweeps over the wheels; shares of a tension that are round-off, and within which a wheel is at its limit.
SWEEPS, ENOUGH, AT_LIMIT = 100, 1e-14, 1e-9


@stage
def paid_out(machine, k, t, nothing):
    """Unstressed length of a rope, and the speed [m/s] at which its winch pays it out."""
    record = record_at(machine)
    elements = record.elements
    index, length = elements.columns[k], nothing + elements.number[k, RopeRow.UNSTRESSED]
    if index[RopeRow.LENGTH] == NONE:
        return length, nothing
    speed = nothing + evaluate_function(machine, index[RopeRow.SPEED], t)
    elements.state_rate[index[RopeRow.LENGTH]] += speed
    return elements.state[index[RopeRow.LENGTH]], speed


@stage
def tension_in(machine, k, stretch, rate, speed):
    """Tension T = k x + d ẋ of the stretch x = s - l, zero where x < 0 or T < 0.

    Where steps are chosen one ends where x passes zero, up to which the rope is slack or taut as at its begin. The rope stores ½ k x²,
    the winch works by -T l̇, and (T - k x) ẋ is dissipated, also where the rope goes slack.
    """
    record = record_at(machine)
    elements, control, numbers = record.elements, record.control, record.elements.number[k]
    followed = record.watched.followed[0]
    elements.depth[k, 0] = stretch
    if followed == 1:
        elements.depth_rate[k, 0] = rate
    tension, elastic, elements.proposal[k, 0] = flank(
        stretch, rate, numbers[RopeRow.STIFFNESS], numbers[RopeRow.DAMPING], elements.memory[k, 0], followed
    )
    control.stored[0] += 0.5 * elastic * stretch
    control.power[0] -= tension * speed
    control.power[1] += (tension - elastic) * rate
    return tension


@leaf
def at(j):
    """Where the numbers of place j begin."""
    return RopeRow.PLACES + WIDTH * j


@leaf
def tangent(dx, dy, rho):
    """(l, u) of the free part between two circles, d from centre to centre, rho = r_b - r_a; no number where one lies in the other."""
    square = dx * dx + dy * dy
    length = np.sqrt(square - rho * rho)
    return length, (dx * length + dy * rho) / square, (dy * length - dx * rho) / square


@leaf
def followed_angle(sine, cosine, near):
    """The angle with this sine and cosine that is next to `near`."""
    angle = arctan2(sine, cosine)
    return angle + 2.0 * np.pi * np.floor((near - real(angle)) / (2.0 * np.pi) + 0.5)


@leaf
def way_between(A, a, b, on_part, on_first, on_last, rise):
    """(f, moment, L) of the free part from place a to place b: f = ∂/∂(c_b - c_a) of w L + arcs at both ends, each with its weight; what of
    (c_b - c_a) × f is across the axis, which turns the body that carries it; its length in space. Global axes.

    `rise`: weight of the mean height of L as the free part turns about the axis.
    """
    dx, dy, z, rho = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z], b[USED] - a[USED]
    square = dx * dx + dy * dy
    length, _, _ = tangent(dx, dy, rho)
    whole = np.sqrt(length * length + z * z)
    turning = on_last * b[USED] - on_first * a[USED] - rise * whole
    along = on_part / whole - turning * rho / (square * length)
    fx, fy = along * dx + turning * dy / square, along * dy - turning * dx / square
    fz = on_part * z / whole
    return turned(A, (fx, fy, fz)), turned(A, (dy * fz - z * fy, z * fx - dx * fz, 0.0 * fz)), whole


@leaf
def centre_of(own):
    """The centre of a place, global."""
    return own[CENTRE], own[CENTRE + 1], own[CENTRE + 2]


@stage
def lay_out(machine, k):
    """Centres of all places, in space and in the plane of the axis, and their radii; returns that axis (3)."""
    record = record_at(machine)
    markers, index, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    A = markers.A[index[RopeRow.AXIS]]
    for j in range(np.int64(index[RopeRow.COUNT])):
        own = numbers[at(j) : at(j + 1)]
        own[USED] = own[RADIUS]
        place_at(own, A, markers.r[index[RopeRow.ALONG + j]])
    return axis(A, 2)


@leaf
def place_at(own, A, p):
    """Put the centre of a place there."""
    own[CENTRE], own[CENTRE + 1], own[CENTRE + 2] = p[0], p[1], p[2]
    own[X], own[Y], own[Z] = seen(A, p)


@leaf
def direction_fixed(A, B, angle):
    """(x, y) in the plane of A of the direction at an angle from the x axis of B towards its y axis."""
    x, y, _ = seen(A, plus(times(np.cos(angle), axis(B, 0)), times(np.sin(angle), axis(B, 1))))
    return x, y


@stage
def next_touched(numbers, j, count):
    """The next place behind j that the rope touches: one whose radius in use is a number."""
    j += 1
    while j < count - 1 and real(numbers[at(j) + USED]) != real(numbers[at(j) + USED]):
        j += 1
    return j


@stage
def find_parts(numbers, count):
    """Directions of all free parts, from touched place to touched place."""
    j = 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a, b = at(j), at(i)
        _, ux, uy = tangent(
            numbers[b + X] - numbers[a + X], numbers[b + Y] - numbers[a + Y], numbers[b + USED] - numbers[a + USED]
        )
        numbers[a + UX], numbers[a + UY] = ux, uy
        j = i


@stage
def arc_at(machine, k, j, before):
    """The arc [rad] on place j, behind the free part that leaves place `before`; below zero where the rope does not touch it."""
    record = record_at(machine)
    elements, markers = record.elements, record.markers
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    own = numbers[at(j) : at(j + 1)]
    sign = 1.0 if real(own[RADIUS]) > 0.0 else -1.0
    near = real(own[NEAR]) + elements.memory[k, 1 + j]
    if j == 0 or j == count - 1:
        last = numbers[at(before) + UX : at(before) + UY + 1]
        ux, uy = (own[UX], own[UY]) if j == 0 else (last[0], last[1])
        ex, ey = direction_fixed(markers.A[index[RopeRow.AXIS]], markers.A[index[RopeRow.ALONG + j]], own[FIXED])
        # from the centre the rope touches the rim towards -J u where it runs right-handed
        tx, ty = sign * uy, -sign * ux
        sine, cosine = ex * ty - ey * tx, ex * tx + ey * ty
        turned = sign if j == 0 else -sign
        theta = followed_angle(turned * sine, cosine, near)
    else:
        vx, vy = numbers[at(before) + UX], numbers[at(before) + UY]
        theta = followed_angle(sign * (vx * own[UY] - vy * own[UX]), vx * own[UX] + vy * own[UY], near)
    elements.proposal[k, 1 + j] = theta - real(own[NEAR])
    return theta


@stage
def let_off(machine, k):
    """Pass over wheels that the rope does not touch, hold it at the rims of drums that are unwound; whether there were any."""
    record = record_at(machine)
    elements, markers = record.elements, record.markers
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    A = markers.A[index[RopeRow.AXIS]]
    before, changed = 0, False
    j = 0
    while j < count:
        own = numbers[at(j) : at(j + 1)]
        if real(own[USED]) != 0.0 and real(arc_at(machine, k, j, before)) < 0.0:
            changed = True
            if j == 0 or j == count - 1:
                ex, ey = direction_fixed(A, markers.A[index[RopeRow.ALONG + j]], own[FIXED])
                r = own[RADIUS] if real(own[RADIUS]) > 0.0 else -own[RADIUS]
                place_at(own, A, plus(centre_of(own), turned(A, (r * ex, r * ey, 0.0 * ex))))
                own[USED] = 0.0
            else:
                own[USED] = np.nan
        before, j = j, next_touched(numbers, j, count) if j < count - 1 else count
    return changed


@stage
def way_along(machine, k, n, tension, act):
    """(s, ṡ) of the way, as the places are laid out; where `act`, its tension [N] acts on the bodies."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    A, carrier = markers.A[index[RopeRow.AXIS]], markers.body[index[RopeRow.AXIS]]
    s, rate, j = 0.0 * tension, 0.0 * tension, 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a, b = numbers[at(j) : at(j + 1)], numbers[at(i) : at(i + 1)]
        first, last = markers.body[index[RopeRow.ALONG + j]], markers.body[index[RopeRow.ALONG + i]]
        f, moment, whole = way_between(A, a, b, 1.0, 1.0, 1.0, 0.0)
        s += whole
        if act:
            add_force_at(bodies, first, centre_of(a), times(tension, f))
            add_force_at(bodies, last, centre_of(b), times(-tension, f))
            add_torque(bodies, carrier, times(tension, moment))
        else:
            v, u = velocity_at(bodies, last, centre_of(b)), velocity_at(bodies, first, centre_of(a))
            rate += dot(f, minus(v, u)) - dot(moment, bodies.omega[carrier])
        j = i
    for end in range(2):
        j = 0 if end == 0 else count - 1
        used, drum = numbers[at(j) + USED], markers.body[index[RopeRow.ALONG + j]]
        r = -used if end == 0 else used
        if act:
            add_torque(bodies, drum, times(-tension * r, n))
        else:
            rate += r * dot(bodies.omega[drum], n)
    if not act:
        before, j = 0, 0
        while j < count:
            own = numbers[at(j) : at(j + 1)]
            if real(own[USED]) != 0.0:
                r = own[USED] if real(own[USED]) > 0.0 else -own[USED]
                s += r * arc_at(machine, k, j, before)
            before, j = j, next_touched(numbers, j, count) if j < count - 1 else count
    return s, rate


@element
def apply(machine, k, index, n, t):
    """Tension along the way around wheels."""
    out, first, count = record_at(machine).outputs.value, index[RopeRow.OUTPUT], np.int64(index[RopeRow.COUNT])
    axle = lay_out(machine, k)
    find_parts(n, count)
    if let_off(machine, k):
        find_parts(n, count)
    s, rate = way_along(machine, k, axle, 0.0 * n[RopeRow.STIFFNESS], False)
    length, speed = paid_out(machine, k, t, 0.0 * s)
    stretch = s - length
    tension = tension_in(machine, k, stretch, rate - speed, speed)
    if real(tension) > 0.0:
        way_along(machine, k, axle, tension, True)
    out[first], out[first + 1], out[first + 2] = tension, -tension * rate, stretch


@leaf
def lacks(first, second, m, grows):
    """Whether a tension is more than m times the other one, or just as much while that `grows`."""
    return first > m * second or (grows > 0.0 and first > m * second - AT_LIMIT * (first + second))


@leaf
def slip_to_limit(strained, other, k, k_other, m):
    """Way that leaves a part with `strained` > 0 for the other one, so that k (strained - x) = m k_other max(0, other + x)."""
    x = (k * strained - m * k_other * other) / (k + m * k_other)
    return strained if real(other + x) < 0.0 else x


@stage
def measure_parts(machine, k, n):
    """Stretches without a new slip, their rates, and how each part acts. Fills `number` and the proposal, in which λ is the old one."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    memory, proposal = elements.memory[k], elements.proposal[k]
    A, carrier = markers.A[index[RopeRow.AXIS]], markers.body[index[RopeRow.AXIS]]
    base, wheels = at(count), LAMBDA + 2 * (count - 1)
    for j in range(count):
        x, y = direction_fixed(A, markers.A[index[RopeRow.ALONG + j]], 0.0)
        proposal[wheels + j] = followed_angle(y, x, memory[wheels + j])
    for p in range(count - 1):
        a, b = numbers[at(p) : at(p + 1)], numbers[at(p + 1) : at(p + 2)]
        own = numbers[base + PARTS + PART * p : base + PARTS + PART * (p + 1)]
        rho = b[USED] - a[USED]
        _, ux, uy = tangent(b[X] - a[X], b[Y] - a[Y], rho)
        near = memory[LAMBDA + 2 * p + 1] if memory[KNOWN] > 0.0 else real(own[ANGLE])
        alpha = followed_angle(uy, ux, near)
        proposal[LAMBDA + 2 * p + 1] = alpha
        f, moment, whole = way_between(A, a, b, 1.0, 1.0, 1.0, 0.0)
        own[FORCE], own[FORCE + 1], own[FORCE + 2] = f
        own[MOMENT], own[MOMENT + 1], own[MOMENT + 2] = moment
        first, last = markers.body[index[RopeRow.ALONG + p]], markers.body[index[RopeRow.ALONG + p + 1]]
        v, u = velocity_at(bodies, last, centre_of(b)), velocity_at(bodies, first, centre_of(a))
        own[RATE] = dot(f, minus(v, u)) - dot(moment, bodies.omega[carrier])
        own[RATE] += b[USED] * dot(bodies.omega[last], n) - a[USED] * dot(bodies.omega[first], n)
        own[STRETCH] = whole - rho * alpha - a[USED] * proposal[wheels + p] + b[USED] * proposal[wheels + p + 1]
    begin_tension(numbers, memory, proposal, count)
    for p in range(count - 1):
        numbers[base + PARTS + PART * p + STRETCH] -= proposal[LAMBDA + 2 * p]


@leaf
def begin_tension(numbers, memory, proposal, count):
    """λ of the last accepted state; at the start that with which all parts have the same tension."""
    base = at(count)
    proposal[KNOWN] = 1.0
    stretch = numbers[base + PLACED] - numbers[RopeRow.UNSTRESSED]
    for p in range(count - 1):
        own = base + PARTS + PART * p
        stretch += numbers[own + STRETCH] - numbers[own + WAY]
    for p in range(count - 1):
        own = base + PARTS + PART * p
        if memory[KNOWN] > 0.0:
            proposal[LAMBDA + 2 * p] = memory[LAMBDA + 2 * p] + 0.0 * stretch
        else:
            proposal[LAMBDA + 2 * p] = (
                numbers[own + STRETCH] - stretch * numbers[RopeRow.STIFFNESS] / numbers[own + STIFF]
            )


@leaf
def ratio_at(numbers, proposal, count, j):
    """exp(μ θ) of wheel j between the ends."""
    r = numbers[at(j) + USED]
    theta = proposal[LAMBDA + 2 * j + 1] - proposal[LAMBDA + 2 * j - 1]
    theta = theta if real(r) > 0.0 else -theta
    theta = maximum(theta, 0.0 * theta) if real(r) != 0.0 else 0.0 * theta
    return np.exp(numbers[at(count) + FRICTION] * theta)


@stage
def slip(machine, k):
    """Let the rope slip on its wheels."""
    record = record_at(machine)
    elements = record.elements
    numbers, proposal, count = elements.number[k], elements.proposal[k], np.int64(elements.columns[k, RopeRow.COUNT])
    base = at(count) + PARTS
    for p in range(count - 1):
        numbers[base + PART * p + SLIPPED] = 0.0 * numbers[base + STRETCH]
    for _ in range(SWEEPS):
        most, largest = 0.0, 0.0
        for j in range(1, count - 1):
            before, behind = base + PART * (j - 1), base + PART * j
            m = ratio_at(numbers, proposal, count, j)
            kb, ka = numbers[before + STIFF], numbers[behind + STIFF]
            eb, ea = numbers[before + STRETCH], numbers[behind + STRETCH]
            tb, ta = max(real(kb * eb), 0.0), max(real(ka * ea), 0.0)
            x = 0.0 * eb
            vb, va = real(numbers[before + RATE]), real(numbers[behind + RATE])
            if lacks(ta, tb, real(m), real(ka) * va - real(m * kb) * vb):
                x = slip_to_limit(ea, eb, ka, kb, m)
            elif lacks(tb, ta, real(m), real(kb) * vb - real(m * ka) * va):
                x = -slip_to_limit(eb, ea, kb, ka, m)
            numbers[behind + STRETCH] = ea - x
            numbers[before + STRETCH] = eb + x
            proposal[LAMBDA + 2 * j] += x
            proposal[LAMBDA + 2 * (j - 1)] -= x
            most, largest = max(most, np.abs(real(x)) * real(ka)), max(largest, ta, tb)
        if most <= ENOUGH * largest:
            break
    # rates of those that slip on
    for _ in range(SWEEPS):
        most = 0.0
        for j in range(1, count - 1):
            before, behind = base + PART * (j - 1), base + PART * j
            m = ratio_at(numbers, proposal, count, j)
            kb, ka = numbers[before + STIFF], numbers[behind + STIFF]
            tb, ta = kb * numbers[before + STRETCH], ka * numbers[behind + STRETCH]
            vb, va = numbers[before + RATE], numbers[behind + RATE]
            v = 0.0 * va
            if real(ta) > 0.0 and real(tb) > 0.0:
                if lacks(real(ta), real(tb), real(m), real(ka * va - m * kb * vb)):
                    v = (ka * va - m * kb * vb) / (ka + m * kb)
                elif lacks(real(tb), real(ta), real(m), real(kb * vb - m * ka * va)):
                    v = -(kb * vb - m * ka * va) / (kb + m * ka)
            numbers[behind + RATE] = va - v
            numbers[before + RATE] = vb + v
            numbers[behind + SLIPPED] += v
            numbers[before + SLIPPED] -= v
            most = max(most, np.abs(real(v)))
        if most == 0.0:
            break


@stage
def pull(machine, k, p, n, tension):
    """The tension of free part p acts on the bodies."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, RopeRow.COUNT])
    a, b = numbers[at(p) : at(p + 1)], numbers[at(p + 1) : at(p + 2)]
    own = numbers[at(count) + PARTS + PART * p : at(count) + PARTS + PART * (p + 1)]
    first, last = markers.body[index[RopeRow.ALONG + p]], markers.body[index[RopeRow.ALONG + p + 1]]
    add_force_at(bodies, first, centre_of(a), times(tension, own[FORCE:MOMENT]))
    add_force_at(bodies, last, centre_of(b), times(-tension, own[FORCE:MOMENT]))
    add_torque(bodies, markers.body[index[RopeRow.AXIS]], times(tension, own[MOMENT:SLIPPED]))
    add_torque(bodies, first, times(tension * a[USED], n))
    add_torque(bodies, last, times(-tension * b[USED], n))


@element
def stick_and_slip(machine, k, index, n, t):
    """Tensions of all parts; outputs: that of the first part, power, its stretch, tension of the last part."""
    record = record_at(machine)
    control, out, count = record.control, record.outputs.value, np.int64(index[RopeRow.COUNT])
    first = index[RopeRow.OUTPUT]
    axle = lay_out(machine, k)
    measure_parts(machine, k, axle)
    base = at(count) + PARTS
    length, speed = paid_out(machine, k, t, 0.0 * n[base + STRETCH])
    # what is paid out is at the first end
    n[base + STRETCH] -= length - n[RopeRow.UNSTRESSED]
    n[base + RATE] -= speed
    power = 0.0 * speed
    slip(machine, k)
    for p in range(count - 1):
        own = n[base + PART * p : base + PART * (p + 1)]
        elastic, tension = 0.0 * own[STRETCH], 0.0 * own[STRETCH]
        if real(own[STRETCH]) > 0.0:
            elastic = own[STIFF] * own[STRETCH]
            damped = elastic + n[RopeRow.DAMPING] * own[STIFF] / n[RopeRow.STIFFNESS] * own[RATE]
            tension = maximum(damped, 0.0 * damped)
        control.stored[0] += 0.5 * elastic * own[STRETCH]
        # what slips takes power by the whole tension, as it acts on the bodies
        control.power[1] += (tension - elastic) * own[RATE] + tension * own[SLIPPED]
        power -= tension * (own[RATE] + own[SLIPPED])
        if p == 0:
            control.power[0] -= tension * speed
            power -= tension * speed
            out[first], out[first + 2] = tension, own[STRETCH]
        if p == count - 2:
            out[first + 3] = tension
        if real(tension) > 0.0:
            pull(machine, k, p, axle, tension)
    out[first + 1] = power
