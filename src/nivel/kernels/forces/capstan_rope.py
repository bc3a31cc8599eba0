"""Ropes around wheels with friction: a tension for every free part, which sticks to the wheels between them or slips (Euler, Eytelwein).

With the free part p from wheel a to wheel b, its length L and direction α, ρ = r_b - r_a and the angles φ of the wheels about n, as in
`nivel.kernels.forces.wound_rope`, its stretch is

    e = L - ρ α - r_a φ_a + r_b φ_b - λ,   T = max(0, k e + d ė)

where λ changes alone as the rope slips: by Δ on wheel j, λ of the part behind it grows and that of the part before it shrinks. It slips
where T_behind > T_before exp(μ θ), or the other way round, and so far that both are equal (a return mapping, wheel by
wheel, until all hold).
λ is kept from accepted state to accepted state. All angles are those seen from the body that carries n: e does not depend on its own turn.
Every wheel between the ends is touched all the time, and drums never unwind: the rope lies in grooves and is fixed with turns left.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import maximum, real
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wound_rope import (
    AXIS,
    CENTRE,
    COUNT,
    DAMPING,
    FIRST,
    LENGTH,
    OUTPUT,
    PLACES,
    SPEED,
    STIFFNESS,
    UNSTRESSED,
    USED,
    WIDTH,
    X,
    Y,
    Z,
    direction_fixed,
    followed_angle,
    lay_out,
    tangent,
    velocity_of,
)
from nivel.kernels.forces.wrench import add_force_at, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# of `number` behind the places: coefficient of friction, length as placed; then PART for each free part: its stiffness, way and direction
# as placed; then work: stretch, its rate, force of the part on its ends per tension, global (3), of its axis (3), and the rate of the
# stretch that slip takes from it
FRICTION, PLACED, PARTS = 0, 1, 2
STIFF, WAY, ANGLE, STRETCH, RATE, FORCE, TILT, SLIPPED = 0, 1, 2, 3, 4, 5, 8, 11
PART = 12
# of `memory`: whether there is one; of each part λ and its direction; of each wheel its angle
KNOWN, LAMBDA = 0, 1
# Sweeps over the wheels; shares of a tension that are round-off, and within which a wheel is at its limit.
SWEEPS, ENOUGH, AT_LIMIT = 100, 1e-14, 1e-9


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
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, COUNT])
    memory, proposal = elements.memory[k], elements.proposal[k]
    A, carrier = markers.A[index[AXIS]], markers.body[index[AXIS]]
    w = bodies.omega[carrier]
    turning = cross((w[0], w[1], w[2]), n)
    base, wheels = PLACES + WIDTH * count, LAMBDA + 2 * (count - 1)
    for j in range(count):
        x, y = direction_fixed(A, markers.A[index[FIRST + j]], 0.0)
        proposal[wheels + j] = followed_angle(y, x, memory[wheels + j])
    for p in range(count - 1):
        a = numbers[PLACES + WIDTH * p : PLACES + WIDTH * (p + 1)]
        b = numbers[PLACES + WIDTH * (p + 1) : PLACES + WIDTH * (p + 2)]
        own = numbers[base + PARTS + PART * p : base + PARTS + PART * (p + 1)]
        dx, dy, z, rho = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z], b[USED] - a[USED]
        square = dx * dx + dy * dy
        length, ux, uy = tangent(dx, dy, rho)
        whole = np.sqrt(length * length + z * z)
        near = memory[LAMBDA + 2 * p + 1] if memory[KNOWN] > 0.0 else real(own[ANGLE])
        alpha = followed_angle(uy, ux, near)
        proposal[LAMBDA + 2 * p + 1] = alpha
        along = 1.0 / whole - rho * rho / (square * length)
        fx, fy, fz = along * dx + rho * dy / square, along * dy - rho * dx / square, z / whole
        own[FORCE] = A[0, 0] * fx + A[0, 1] * fy + fz * n[0]
        own[FORCE + 1] = A[1, 0] * fx + A[1, 1] * fy + fz * n[1]
        own[FORCE + 2] = A[2, 0] * fx + A[2, 1] * fy + fz * n[2]
        tx, ty = fz * dx - z * fx, fz * dy - z * fy
        own[TILT], own[TILT + 1] = A[0, 0] * tx + A[0, 1] * ty, A[1, 0] * tx + A[1, 1] * ty
        own[TILT + 2] = A[2, 0] * tx + A[2, 1] * ty
        ba, bb = markers.body[index[FIRST + p]], markers.body[index[FIRST + p + 1]]
        v, u, wa, wb = velocity_of(bodies, bb, b), velocity_of(bodies, ba, a), bodies.omega[ba], bodies.omega[bb]
        rate = 0.0 * whole
        for i in range(3):
            rate += own[FORCE + i] * (v[i] - u[i]) + own[TILT + i] * turning[i]
            rate += (b[USED] * wb[i] - a[USED] * wa[i]) * n[i]
        own[RATE] = rate
        own[STRETCH] = whole - rho * alpha - a[USED] * proposal[wheels + p] + b[USED] * proposal[wheels + p + 1]
    begin_tension(numbers, memory, proposal, count)
    for p in range(count - 1):
        numbers[base + PARTS + PART * p + STRETCH] -= proposal[LAMBDA + 2 * p]


@leaf
def begin_tension(numbers, memory, proposal, count):
    """λ of the last accepted state; at the start that with which all parts have the same tension."""
    base = PLACES + WIDTH * count
    proposal[KNOWN] = 1.0
    stretch = numbers[base + PLACED] - numbers[UNSTRESSED]
    for p in range(count - 1):
        own = base + PARTS + PART * p
        stretch += numbers[own + STRETCH] - numbers[own + WAY]
    for p in range(count - 1):
        own = base + PARTS + PART * p
        if memory[KNOWN] > 0.0:
            proposal[LAMBDA + 2 * p] = memory[LAMBDA + 2 * p] + 0.0 * stretch
        else:
            proposal[LAMBDA + 2 * p] = numbers[own + STRETCH] - stretch * numbers[STIFFNESS] / numbers[own + STIFF]


@leaf
def ratio_at(numbers, proposal, count, j):
    """exp(μ θ) of wheel j between the ends."""
    r = numbers[PLACES + WIDTH * j + USED]
    theta = proposal[LAMBDA + 2 * j + 1] - proposal[LAMBDA + 2 * j - 1]
    theta = theta if real(r) > 0.0 else -theta
    theta = maximum(theta, 0.0 * theta) if real(r) != 0.0 else 0.0 * theta
    return np.exp(numbers[PLACES + WIDTH * count + FRICTION] * theta)


@stage
def slip(machine, k):
    """Let the rope slip on its wheels."""
    record = record_at(machine)
    elements = record.elements
    numbers, proposal, count = elements.number[k], elements.proposal[k], np.int64(elements.columns[k, COUNT])
    base = PLACES + WIDTH * count + PARTS
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
def act(machine, k, p, n, tension):
    """The tension of free part p acts on the bodies."""
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, COUNT])
    a = numbers[PLACES + WIDTH * p : PLACES + WIDTH * (p + 1)]
    b = numbers[PLACES + WIDTH * (p + 1) : PLACES + WIDTH * (p + 2)]
    own = numbers[PLACES + WIDTH * count + PARTS + PART * p : PLACES + WIDTH * count + PARTS + PART * (p + 1)]
    ba, bb = markers.body[index[FIRST + p]], markers.body[index[FIRST + p + 1]]
    x, y, z = tension * own[FORCE], tension * own[FORCE + 1], tension * own[FORCE + 2]
    add_force_at(bodies, ba, a[CENTRE : CENTRE + 3], x, y, z)
    add_force_at(bodies, bb, b[CENTRE : CENTRE + 3], -x, -y, -z)
    m = cross(n, (own[TILT], own[TILT + 1], own[TILT + 2]))
    add_torque(bodies, markers.body[index[AXIS]], -tension * m[0], -tension * m[1], -tension * m[2])
    r, s = tension * a[USED], -tension * b[USED]
    add_torque(bodies, ba, r * n[0], r * n[1], r * n[2])
    add_torque(bodies, bb, s * n[0], s * n[1], s * n[2])


@family
def apply(machine, number, t):
    """Tensions of all parts; outputs: that of the first part, power, its stretch, tension of the last part."""
    record = record_at(machine)
    elements, control, out = record.elements, record.control, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        count = np.int64(index[COUNT])
        n = lay_out(machine, k)
        measure_parts(machine, k, n)
        base = PLACES + WIDTH * count + PARTS
        speed = 0.0 * numbers[base + STRETCH]
        if index[LENGTH] != NONE:
            speed = speed + evaluate_function(machine, index[SPEED], t)
            elements.state_rate[index[LENGTH]] += speed
            # what is paid out is at the first end
            numbers[base + STRETCH] -= elements.state[index[LENGTH]] - numbers[UNSTRESSED]
            numbers[base + RATE] -= speed
        first, power = index[OUTPUT], 0.0 * speed
        slip(machine, k)
        for p in range(count - 1):
            own = base + PART * p
            stretch, rate, stiff = numbers[own + STRETCH], numbers[own + RATE], numbers[own + STIFF]
            elastic, tension = 0.0 * stretch, 0.0 * stretch
            if real(stretch) > 0.0:
                elastic = stiff * stretch
                damped = elastic + numbers[DAMPING] * stiff / numbers[STIFFNESS] * rate
                tension = maximum(damped, 0.0 * damped)
            control.stored[0] += 0.5 * elastic * stretch
            # what slips takes power by the whole tension, as it acts on the bodies
            slipped = numbers[own + SLIPPED]
            control.power[1] += (tension - elastic) * rate + tension * slipped
            power -= tension * (rate + slipped)
            if p == 0:
                control.power[0] -= tension * speed
                power -= tension * speed
                out[first], out[first + 2] = tension, stretch
            if p == count - 2:
                out[first + 3] = tension
            if real(tension) > 0.0:
                act(machine, k, p, n, tension)
        out[first + 1] = power
    return OK
