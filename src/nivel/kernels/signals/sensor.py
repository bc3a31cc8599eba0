"""The hook of machines with sensors: their outputs, computed for recorded states only."""

import numpy as np

from nivel.kernels.algebra.analytic import arctan2
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, plus, put, seen, turned
from nivel.kernels.bodies.coordinate import measure
from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`; WHAT: marker, coordinate, function or output; FRAME: marker that it is seen from, or NONE
OUTPUT, KIND, WHAT, FRAME = 0, 1, 2, 3
# quantities of markers have three outputs, the others one
POSITION, VELOCITY, ACCELERATION, ANGULAR_VELOCITY, ANGULAR_ACCELERATION = 0, 1, 2, 3, 4
VALUE, RATE, SECOND, FUNCTION, COPY = 5, 6, 7, 8, 9
# Euler angles about the axes i, j, k as turned so far have three outputs; their kind is this and 9 i + 3 j + k
EULER_ANGLES = 16


@stage
def angular_acceleration(bodies, b):
    """α of body b, global axes."""
    return turned(bodies.A[b], bodies.alpha_b[b])


@stage
def motion_of(machine, m, kind):
    """A quantity of marker m, global axes."""
    record = record_at(machine)
    bodies, markers = record.bodies, record.markers
    b = markers.body[m]
    if kind == POSITION:
        return markers.r[m, 0], markers.r[m, 1], markers.r[m, 2]
    if kind == VELOCITY:
        return markers.rdot[m, 0], markers.rdot[m, 1], markers.rdot[m, 2]
    if kind == ANGULAR_VELOCITY:
        return bodies.omega[b, 0], bodies.omega[b, 1], bodies.omega[b, 2]
    alpha = angular_acceleration(bodies, b)
    if kind == ANGULAR_ACCELERATION:
        return alpha
    return plus(plus(bodies.Rddot[b], markers.bias[m]), cross(alpha, markers.u[m]))


@stage
def seen_from(machine, m, frame, kind):
    """A quantity of marker m relative to a moving marker, in global axes: derivatives are those that an observer on it sees."""
    value = minus(motion_of(machine, m, kind), motion_of(machine, frame, kind))
    w = motion_of(machine, frame, ANGULAR_VELOCITY)
    if kind == VELOCITY:
        value = minus(value, cross(w, seen_offset(machine, m, frame)))
    elif kind == ACCELERATION:
        d = seen_offset(machine, m, frame)
        v = minus(minus(motion_of(machine, m, VELOCITY), motion_of(machine, frame, VELOCITY)), cross(w, d))
        coriolis = cross(w, v)
        value = minus(value, cross(motion_of(machine, frame, ANGULAR_ACCELERATION), d))
        value = minus(minus(minus(value, cross(w, cross(w, d))), coriolis), coriolis)
    elif kind == ANGULAR_ACCELERATION:
        turning = minus(motion_of(machine, m, ANGULAR_VELOCITY), w)
        value = minus(value, cross(w, turning))
    return value


@stage
def seen_offset(machine, m, frame):
    """r of marker m less that of the frame."""
    return minus(motion_of(machine, m, POSITION), motion_of(machine, frame, POSITION))


@stage
def second_derivative(machine, q):
    """c̈ of coordinate q, which has just been measured with this `bias`."""
    record = record_at(machine)
    coordinates, bodies, markers = record.coordinates, record.bodies, record.markers
    total = 0.0
    for part in range(coordinates.start[q], coordinates.start[q + 1]):
        m = coordinates.part_marker[part]
        b, u, J = markers.body[m], markers.u[m], coordinates.J[part]
        alpha = angular_acceleration(bodies, b)
        total += dot(J, plus(bodies.Rddot[b], cross(alpha, u))) + dot(J[3:], alpha)
    return total


@stage
def relative_entry(machine, m, frame, i, j):
    """Component of axis j of marker m along axis i of another marker, or of the global frame."""
    A = record_at(machine).markers.A
    if frame == NONE:
        return A[m, i, j]
    return A[frame, 0, i] * A[m, 0, j] + A[frame, 1, i] * A[m, 1, j] + A[frame, 2, i] * A[m, 2, j]


@stage
def euler_angles(machine, m, frame, code):
    """Three angles of A = A_i(a) A_j(b) A_k(c), a and c within half a turn (for i = k, b from 0 to π, else within a quarter turn)."""
    i, j, k = code // 9, (code // 3) % 3, code % 3
    third = 3 - i - j
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    if i == k:
        up, across = relative_entry(machine, m, frame, j, i), -sign * relative_entry(machine, m, frame, third, i)
        first = arctan2(up, across)
        second = arctan2(np.sqrt(up * up + across * across), relative_entry(machine, m, frame, i, i))
        along = sign * relative_entry(machine, m, frame, i, third)
        return first, second, arctan2(relative_entry(machine, m, frame, i, j), along)
    up, across = -sign * relative_entry(machine, m, frame, j, k), relative_entry(machine, m, frame, k, k)
    tilt = sign * relative_entry(machine, m, frame, i, k)
    second = arctan2(tilt, np.sqrt(up * up + across * across))
    along = relative_entry(machine, m, frame, i, i)
    return arctan2(up, across), second, arctan2(-sign * relative_entry(machine, m, frame, i, j), along)


@family
def apply(machine, number, t):
    """All sensors, from the state last evaluated."""
    record = record_at(machine)
    sensors, out = record.sensors, record.outputs.value
    for k in range(sensors.columns.shape[0]):
        first, kind, what = sensors.columns[k, OUTPUT], sensors.columns[k, KIND], sensors.columns[k, WHAT]
        if kind <= ANGULAR_ACCELERATION:
            frame = sensors.columns[k, FRAME]
            if frame == NONE:
                put(out, first, motion_of(machine, what, kind))
            else:
                put(out, first, seen(record.markers.A[frame], seen_from(machine, what, frame, kind)))
        elif kind >= EULER_ANGLES:
            code = np.int64(kind) - EULER_ANGLES
            out[first], out[first + 1], out[first + 2] = euler_angles(machine, what, sensors.columns[k, FRAME], code)
        elif kind == FUNCTION:
            out[first] = evaluate_function(machine, what, t)
        elif kind == COPY:
            out[first] = out[what]
        else:
            value, rate, bias = measure(record.bodies, record.markers, record.coordinates, what)
            if kind == VALUE:
                out[first] = value
            elif kind == RATE:
                out[first] = rate
            else:
                out[first] = bias + second_derivative(machine, what)
    return OK
