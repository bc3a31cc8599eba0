"""Ropes around wheels whose axes are parallel: one tension along tangents and arcs, wound up on drums at the ends.

Every place of the rope is a circle of the signed radius r, positive where the rope runs right-handed about the axis n, zero for a point.
Seen along n, a free part between the centres a and b with d = c_b - c_a, ρ = r_b - r_a has, d as a complex number,

    l = √(|d|² - ρ²),   direction u = d (l - iρ)/|d|²,   in space L = √(l² + z²) with z = nᵀ(c_b - c_a)

and the way is s = Σ L + Σ |r| θ with the arcs θ. With the angle α of u, and φ of a drum about n,

    ds = Σ (l dl + z dz)/L - ρ dα - r_first dφ_first + r_last dφ_last,   dl = dᵀdd/l,   dα = (J d)ᵀdd/|d|² + ρ dl/|d|²

so that forces act at the centres, torques on the drums alone, and on the body that carries n where the rope leaves its plane. A wheel that
the rope does not touch is passed over; a drum that is unwound holds the rope at its rim.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import arctan2, real
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_force_at, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# columns of `columns`; FIRST: the first of COUNT markers; outputs: tension, power, stretch
OUTPUT, LENGTH, SPEED, COUNT, AXIS, FIRST = 0, 1, 2, 3, 4, 5
# columns of `number`, then WIDTH for each place
STIFFNESS, DAMPING, UNSTRESSED, PLACES = 0, 1, 2, 3
# of a place: signed radius, about which arc [rad] its own is at the start, of a drum the direction [rad] in which the rope is fixed, from
# the marker's x axis; then work: radius in use, centre in space (3), in the plane (x, y, z), direction of the free part behind it (x, y)
RADIUS, NEAR, FIXED, USED, CENTRE, X, Y, Z, UX, UY = 0, 1, 2, 3, 4, 7, 8, 9, 10, 11
WIDTH = 12


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


@stage
def lay_out(machine, k):
    """Centres of all places, in space and in the plane of the axis, and their radii; returns that axis (3)."""
    record = record_at(machine)
    markers, index, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    A = markers.A[index[AXIS]]
    for j in range(np.int64(index[COUNT])):
        own = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
        r = markers.r[index[FIRST + j]]
        own[USED] = own[RADIUS]
        place_at(own, A, r[0], r[1], r[2])
    return A[0, 2], A[1, 2], A[2, 2]


@leaf
def place_at(own, A, x, y, z):
    """Put the centre of a place there."""
    own[CENTRE], own[CENTRE + 1], own[CENTRE + 2] = x, y, z
    own[X] = A[0, 0] * x + A[1, 0] * y + A[2, 0] * z
    own[Y] = A[0, 1] * x + A[1, 1] * y + A[2, 1] * z
    own[Z] = A[0, 2] * x + A[1, 2] * y + A[2, 2] * z


@leaf
def direction_fixed(A, B, angle):
    """(x, y) in the plane of A of the direction at an angle from the x axis of B towards its y axis."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = c * B[0, 0] + s * B[0, 1], c * B[1, 0] + s * B[1, 1], c * B[2, 0] + s * B[2, 1]
    return A[0, 0] * x + A[1, 0] * y + A[2, 0] * z, A[0, 1] * x + A[1, 1] * y + A[2, 1] * z


@stage
def next_touched(numbers, j, count):
    """The next place behind j that the rope touches: one whose radius in use is a number."""
    j += 1
    while j < count - 1 and real(numbers[PLACES + WIDTH * j + USED]) != real(numbers[PLACES + WIDTH * j + USED]):
        j += 1
    return j


@stage
def find_parts(numbers, count):
    """Directions of all free parts, from touched place to touched place."""
    j = 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a, b = PLACES + WIDTH * j, PLACES + WIDTH * i
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
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, COUNT])
    own = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
    sign = 1.0 if real(own[RADIUS]) > 0.0 else -1.0
    near = real(own[NEAR]) + elements.memory[k, 1 + j]
    if j == 0 or j == count - 1:
        last = numbers[PLACES + WIDTH * before + UX : PLACES + WIDTH * before + UY + 1]
        ux, uy = (own[UX], own[UY]) if j == 0 else (last[0], last[1])
        ex, ey = direction_fixed(markers.A[index[AXIS]], markers.A[index[FIRST + j]], own[FIXED])
        # from the centre the rope touches the rim towards -J u where it runs right-handed
        tx, ty = sign * uy, -sign * ux
        sine, cosine = ex * ty - ey * tx, ex * tx + ey * ty
        turned = sign if j == 0 else -sign
        theta = followed_angle(turned * sine, cosine, near)
    else:
        vx, vy = numbers[PLACES + WIDTH * before + UX], numbers[PLACES + WIDTH * before + UY]
        theta = followed_angle(sign * (vx * own[UY] - vy * own[UX]), vx * own[UX] + vy * own[UY], near)
    elements.proposal[k, 1 + j] = theta - real(own[NEAR])
    return theta


@stage
def let_off(machine, k):
    """Pass over wheels that the rope does not touch, hold it at the rims of drums that are unwound; whether there were any."""
    record = record_at(machine)
    elements, markers = record.elements, record.markers
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, COUNT])
    A = markers.A[index[AXIS]]
    before, changed = 0, False
    j = 0
    while j < count:
        own = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
        if real(own[USED]) != 0.0 and real(arc_at(machine, k, j, before)) < 0.0:
            changed = True
            if j == 0 or j == count - 1:
                ex, ey = direction_fixed(A, markers.A[index[FIRST + j]], own[FIXED])
                r = own[RADIUS] if real(own[RADIUS]) > 0.0 else -own[RADIUS]
                ex, ey = r * ex, r * ey
                x = own[CENTRE] + A[0, 0] * ex + A[0, 1] * ey
                y = own[CENTRE + 1] + A[1, 0] * ex + A[1, 1] * ey
                z = own[CENTRE + 2] + A[2, 0] * ex + A[2, 1] * ey
                place_at(own, A, x, y, z)
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
    index, numbers, count = elements.columns[k], elements.number[k], np.int64(elements.columns[k, COUNT])
    A, carrier = markers.A[index[AXIS]], markers.body[index[AXIS]]
    w = bodies.omega[carrier]
    turning = cross((w[0], w[1], w[2]), n)
    s, rate = 0.0 * tension, 0.0 * tension
    j = 0
    while j < count - 1:
        i = next_touched(numbers, j, count)
        a = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
        b = numbers[PLACES + WIDTH * i : PLACES + WIDTH * (i + 1)]
        dx, dy, z, rho = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z], b[USED] - a[USED]
        square = dx * dx + dy * dy
        length, _, _ = tangent(dx, dy, rho)
        whole = np.sqrt(length * length + z * z)
        # ∂s/∂d in the plane, along n, and by the direction of n
        along = 1.0 / whole - rho * rho / (square * length)
        fx, fy, fz = along * dx + rho * dy / square, along * dy - rho * dx / square, z / whole
        gx = A[0, 0] * fx + A[0, 1] * fy + fz * n[0]
        gy = A[1, 0] * fx + A[1, 1] * fy + fz * n[1]
        gz = A[2, 0] * fx + A[2, 1] * fy + fz * n[2]
        tx, ty = fz * dx - z * fx, fz * dy - z * fy
        tilt = A[0, 0] * tx + A[0, 1] * ty, A[1, 0] * tx + A[1, 1] * ty, A[2, 0] * tx + A[2, 1] * ty
        s += whole
        if act:
            ba, bb = markers.body[index[FIRST + j]], markers.body[index[FIRST + i]]
            add_force_at(bodies, ba, a[CENTRE : CENTRE + 3], tension * gx, tension * gy, tension * gz)
            add_force_at(bodies, bb, b[CENTRE : CENTRE + 3], -tension * gx, -tension * gy, -tension * gz)
            m = cross(n, tilt)
            add_torque(bodies, carrier, -tension * m[0], -tension * m[1], -tension * m[2])
        else:
            v, u = (
                velocity_of(bodies, markers.body[index[FIRST + i]], b),
                velocity_of(bodies, markers.body[index[FIRST + j]], a),
            )
            rate += gx * (v[0] - u[0]) + gy * (v[1] - u[1]) + gz * (v[2] - u[2])
            rate += tilt[0] * turning[0] + tilt[1] * turning[1] + tilt[2] * turning[2]
        j = i
    for end in range(2):
        j = 0 if end == 0 else count - 1
        own = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
        r = -own[USED] if end == 0 else own[USED]
        b = markers.body[index[FIRST + j]]
        if act:
            add_torque(bodies, b, -tension * r * n[0], -tension * r * n[1], -tension * r * n[2])
        else:
            w = bodies.omega[b]
            rate += r * (w[0] * n[0] + w[1] * n[1] + w[2] * n[2])
    if not act:
        before, j = 0, 0
        while j < count:
            own = numbers[PLACES + WIDTH * j : PLACES + WIDTH * (j + 1)]
            if real(own[USED]) != 0.0:
                r = own[USED] if real(own[USED]) > 0.0 else -own[USED]
                s += r * arc_at(machine, k, j, before)
            before, j = j, next_touched(numbers, j, count) if j < count - 1 else count
    return s, rate


@leaf
def velocity_of(bodies, b, own):
    """Velocity (3) of the body's point at the centre of a place."""
    R, V, w = bodies.R[b], bodies.Rdot[b], bodies.omega[b]
    x, y, z = own[CENTRE] - R[0], own[CENTRE + 1] - R[1], own[CENTRE + 2] - R[2]
    return V[0] + w[1] * z - w[2] * y, V[1] + w[2] * x - w[0] * z, V[2] + w[0] * y - w[1] * x


@family
def apply(machine, number, t):
    """Tension T = k x + d ẋ of the stretch x = s - l as in `nivel.kernels.forces.rope`, with the way s around wheels."""
    record = record_at(machine)
    elements, control, out = record.elements, record.control, record.outputs.value
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        count = np.int64(index[COUNT])
        n = lay_out(machine, k)
        find_parts(numbers, count)
        if let_off(machine, k):
            find_parts(numbers, count)
        s, rate = way_along(machine, k, n, 0.0 * numbers[STIFFNESS], False)
        length, speed = 0.0 * s + numbers[UNSTRESSED], 0.0 * s
        if index[LENGTH] != NONE:
            length = elements.state[index[LENGTH]]
            speed = speed + evaluate_function(machine, index[SPEED], t)
            elements.state_rate[index[LENGTH]] += speed
        stretch, rate = s - length, rate - speed
        elements.depth[k, 0] = stretch
        if followed == 1:
            elements.depth_rate[k, 0] = rate
        elastic, tension = 0.0 * stretch, 0.0 * stretch
        if real(stretch) > 0.0:
            elastic = numbers[STIFFNESS] * stretch
            if real(elastic + numbers[DAMPING] * rate) > 0.0:
                tension = elastic + numbers[DAMPING] * rate
        control.stored[0] += 0.5 * elastic * stretch
        control.power[0] -= tension * speed
        control.power[1] += (tension - elastic) * rate
        if real(tension) > 0.0:
            way_along(machine, k, n, tension, True)
        first = index[OUTPUT]
        out[first], out[first + 1], out[first + 2] = tension, -tension * (rate + speed), stretch
    return OK
