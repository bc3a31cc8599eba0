"""A surface that moves over its body: a belt, or a turntable. Its velocity in axes of a marker there, and its spin about z through the
marker's point, are functions."""

from __future__ import annotations

from nivel.kernels.algebra.spatial import cross
from nivel.kernels.elements.patch import axis, minus, plus
from nivel.kernels.record.function import evaluate_function, evaluate_motion
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# columns; FUNCTIONS: the first of four, or NONE; SMOOTH: 1 where they are motions, whose rates are known; FRAME: the marker
FUNCTIONS, SMOOTH, FRAME = 0, 1, 2
# numbers: velocity at the marker's point and its rate, global axes; spin and its rate
VELOCITY, CHANGE, SPIN, SPIN_RATE, NUMBERS = 0, 3, 6, 7, 8


@stage
def find_surface(machine, columns, n, t):
    """Leave velocity, spin and their rates in the numbers; a rate that is not known counts as 0."""
    record = record_at(machine)
    frame = columns[FRAME]
    A, W, o = record.markers.A[frame], record.bodies.omega[record.markers.body[frame]], 0.0 * n[SPIN]
    for a in range(NUMBERS):
        n[a] = o
    for b in range(4):
        if columns[SMOOTH] == 1:
            value, rate, _ = evaluate_motion(machine, columns[FUNCTIONS] + b, t)
        else:
            value, rate = evaluate_function(machine, columns[FUNCTIONS] + b, t), 0.0
        if b == 3:
            n[SPIN], n[SPIN_RATE] = o + value, o + rate
        else:
            for a in range(3):
                n[VELOCITY + a] += A[a, b] * value
                n[CHANGE + a] += A[a, b] * rate
    turning = cross(W, n[VELOCITY:CHANGE])
    for a in range(3):
        n[CHANGE + a] += turning[a]


@leaf
def times(s, x):
    """s x of a 3-vector."""
    return s * x[0], s * x[1], s * x[2]


@stage
def surface_at(machine, frame, n, p):
    """Velocity of the surface over its body at p, global axes."""
    markers = record_at(machine).markers
    turning = cross(axis(markers.A[frame], 2), minus(p, markers.r[frame]))
    return plus(n[VELOCITY:CHANGE], times(n[SPIN], turning))


@stage
def surface_rate_at(machine, frame, n, p, pdot):
    """Its rate of change at a point that moves."""
    record = record_at(machine)
    markers = record.markers
    z, W = axis(markers.A[frame], 2), record.bodies.omega[markers.body[frame]]
    d = minus(p, markers.r[frame])
    swept = plus(cross(cross(W, z), d), cross(z, minus(pdot, markers.rdot[frame])))
    return plus(n[CHANGE:SPIN], plus(times(n[SPIN_RATE], cross(z, d)), times(n[SPIN], swept)))
