"""Coordinates of a marker whose orientation is prescribed: components of the turn by which it is ahead of its target.

i is the marker of reference, j the driven one, T the target: axes that turn relative to i as functions of time say,

    A_T = A_i R(t),   ω_T = ω_i + A_i Ω(t),   ω̇_T = α_i + A_i Ω̇(t) + ω_i × A_i Ω(t)

with R = R₁(φ₁) R₂(φ₂) …, turns about axes of the frame as turned so far, or of Euler parameters e of any length. Along axis x of the
target, of which y and z follow (cyclic), with n = y_T × z_j:

    value -y_Tᵀ z_j,   rate nᵀ(ω_j - ω_T)

All three are zero where the axes agree, and there n is the axis x_T, so the multiplier of a row is the torque about that axis.
Half a turn from there they vanish too: `nivel.analysis.assembly.assemble` refuses to start there.

Their numbers (`Coordinates.station`): the first of the functions, which follow each other; the axes of the turns as digits 1, 2, 3 to the
base 4, the last turn in the last digit, or zero for Euler parameters.
"""

import numpy as np

from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.coordinate import axes_product
from nivel.kernels.bodies.rolling import axis_of, plus
from nivel.kernels.record.function import evaluate_motion
from nivel.kernels.record.record import record_at
from nivel.native.function import stage

TURN_X, TURN_Y, TURN_Z = 17, 18, 19
FUNCTIONS, SEQUENCE = 0, 1  # places among the two numbers of a coordinate
BASE = 4


@stage
def turned_axes(x, y, z, a, c, s):
    """The axes x, y, z after a turn about axis a of them, with cosine c and sine s."""
    if a == 0:
        y, z = plus(c, y, s, z), plus(-s, y, c, z)
    elif a == 1:
        z, x = plus(c, z, s, x), plus(-s, z, c, x)
    else:
        x, y = plus(c, x, s, y), plus(-s, x, c, y)
    return x, y, z


@stage
def target_of_turns(machine, first, sequence, t, zero):
    """(x, y, z axes of the target, Ω, Ω̇) in the axes of the reference, from turns one after the other. zero : of the numbers' type."""
    one = zero + 1.0
    x, y, z = (one, zero, zero), (zero, one, zero), (zero, zero, one)
    spin, change = (zero, zero, zero), (zero, zero, zero)
    count, place = 0, 1
    while place <= sequence:
        place *= BASE
        count += 1
    for n in range(count):
        place //= BASE
        a = (sequence // place) % BASE - 1
        angle, rate, second = evaluate_motion(machine, first + n, t)
        u = x if a == 0 else (y if a == 1 else z)
        # u turns with the frame so far: u̇ = Ω × u
        change = plus(1.0, change, 1.0, plus(rate, cross(spin, u), second, u))
        spin = plus(1.0, spin, rate, u)
        x, y, z = turned_axes(x, y, z, a, np.cos(angle), np.sin(angle))
    return x, y, z, spin, change


@stage
def target_of_parameters(machine, first, t, zero):
    """The same from four Euler parameters, which need not have unit length: Ω = 2 G ė/|e|², d|e|²/dt = 2 eᵀė."""
    e0, d0, s0 = evaluate_motion(machine, first, t)
    e1, d1, s1 = evaluate_motion(machine, first + 1, t)
    e2, d2, s2 = evaluate_motion(machine, first + 2, t)
    e3, d3, s3 = evaluate_motion(machine, first + 3, t)
    e, d, s = (zero + e1, zero + e2, zero + e3), (zero + d1, zero + d2, zero + d3), (zero + s1, zero + s2, zero + s3)
    square = e0 * e0 + dot(e, e)
    f = 2.0 / square
    x = f * (e0 * e0 + e1 * e1) - 1.0, f * (e1 * e2 + e0 * e3), f * (e1 * e3 - e0 * e2)
    y = f * (e1 * e2 - e0 * e3), f * (e0 * e0 + e2 * e2) - 1.0, f * (e2 * e3 + e0 * e1)
    z = f * (e1 * e3 + e0 * e2), f * (e2 * e3 - e0 * e1), f * (e0 * e0 + e3 * e3) - 1.0
    spin = plus(f, plus(e0, d, -d0, e), f, cross(e, d))
    growth = f * (e0 * d0 + dot(e, d))
    change = plus(1.0, plus(f, plus(e0, s, -s0, e), f, cross(e, s)), -growth, spin)
    return x, y, z, spin, change


@stage
def in_global(A, u):
    """A u."""
    return plus(1.0, plus(u[0], axis_of(A, 0), u[1], axis_of(A, 1)), u[2], axis_of(A, 2))


@stage
def driven_turn(machine, k, t):
    """(value, rate, second derivative without accelerations of bodies) of coordinate k; its parts of C_q are filled."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    kind, i, j = coordinates.what[k, 0], coordinates.what[k, 1], coordinates.what[k, 2]
    part = coordinates.start[k]
    first = np.int64(coordinates.station[part + FUNCTIONS])
    sequence = np.int64(coordinates.station[part + SEQUENCE])
    A, w, wj = markers.A[i], bodies.omega[markers.body[i]], bodies.omega[markers.body[j]]
    zero = 0.0 * A[0, 0]
    if sequence > 0:
        x, y, z, spin, change = target_of_turns(machine, first, sequence, t, zero)
    else:
        x, y, z, spin, change = target_of_parameters(machine, first, t, zero)
    if kind == TURN_X:
        a, b = in_global(A, y), axis_of(markers.A[j], 2)
    elif kind == TURN_Y:
        a, b = in_global(A, z), axis_of(markers.A[j], 0)
    else:
        a, b = in_global(A, x), axis_of(markers.A[j], 1)
    spin, change = in_global(A, spin), in_global(A, change)
    change = plus(1.0, change, 1.0, cross(w, spin))
    value, n0, n1, n2, rate, bias = axes_product(a[0], a[1], a[2], b[0], b[1], b[2], plus(1.0, w, 1.0, spin), wj)
    Ji, Jj = coordinates.J[part], coordinates.J[part + 1]
    Ji[3], Ji[4], Ji[5] = -n0, -n1, -n2
    Jj[3], Jj[4], Jj[5] = n0, n1, n2
    return -value, -rate, -bias - (n0 * change[0] + n1 * change[1] + n2 * change[2])


@stage
def note_motions(machine):
    """The rates at which time alone moves these coordinates, for the power of their drivers: nᵀ A_i Ω = C_q v - Ċ."""
    record = record_at(machine)
    bodies, markers, coordinates, constraints = record.bodies, record.markers, record.coordinates, record.constraints
    for k in range(constraints.combination.shape[0]):
        first = constraints.combination[k, 1]
        if first == constraints.combination[k, 2]:
            continue
        q = constraints.term[first, 0]
        if coordinates.what[q, 0] < TURN_X:
            continue
        part = coordinates.start[q]
        w, wj = bodies.omega[markers.body[coordinates.what[q, 1]]], bodies.omega[markers.body[coordinates.what[q, 2]]]
        moved = dot(coordinates.J[part, 3:], w) + dot(coordinates.J[part + 1, 3:], wj)
        constraints.motion[k] = moved - coordinates.rate[q]
