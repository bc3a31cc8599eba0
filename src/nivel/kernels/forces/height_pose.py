"""Poses of shapes over ground with heights: kept at accepted states, at the ends of steps, and between both on cubics."""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.elements.patch import axis, minus
from nivel.kernels.forces.contact_law import COUNT, MARKER, NORMAL, OTHER, POINT, seen
from nivel.kernels.forces.ground_contact import END, ball_of, find_point_over_ground
from nivel.kernels.record.record import record_at
from nivel.native.function import stage

# what is kept of an accepted state behind the points in the memory of an element: pose and twist of the shape in axes of the ground (place,
# axes, velocity, angular velocity), time, 1
PLACE, AXES, SPEED, SPIN, SINCE, KNOWN, KEPT = 0, 3, 12, 15, 18, 19, 20


@stage
def write_pose(machine, k, out, first):
    """Pose and twist of the shape of element k in axes of its ground, into out[first:]."""
    record = record_at(machine)
    markers, bodies, columns = record.markers, record.bodies, record.elements.columns[k]
    i, j = columns[MARKER], columns[OTHER]
    B, W = markers.A[j], bodies.omega[markers.body[j]]
    d = minus(markers.r[i], markers.r[j])
    v = minus(minus(markers.rdot[i], markers.rdot[j]), cross(W, d))
    turning = seen(B, minus(bodies.omega[markers.body[i]], W))
    d, v = seen(B, d), seen(B, v)
    for a in range(3):
        out[first + PLACE + a], out[first + SPEED + a], out[first + SPIN + a] = d[a], v[a], turning[a]
        column = seen(B, axis(markers.A[i], a))
        for b in range(3):
            out[first + AXES + 3 * b + a] = column[b]


@stage
def predict(out, end, memory, first, h):
    """The pose at the end of a step of length h with the twist kept, into out[end:]."""
    w = real(memory[first + SPIN]), real(memory[first + SPIN + 1]), real(memory[first + SPIN + 2])
    rate = np.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    s, c = (np.sin(rate * h) / rate, (1.0 - np.cos(rate * h)) / (rate * rate)) if rate > 0.0 else (h, 0.5 * h * h)
    for a in range(3):
        out[end + PLACE + a] = memory[first + PLACE + a] + h * memory[first + SPEED + a]
        out[end + SPEED + a], out[end + SPIN + a] = memory[first + SPEED + a], memory[first + SPIN + a]
        x = real(memory[first + AXES + a]), real(memory[first + AXES + 3 + a]), real(memory[first + AXES + 6 + a])
        y = cross(w, x)
        z = cross(w, y)
        for b in range(3):
            out[end + AXES + 3 * b + a] = x[b] + s * y[b] + c * z[b]


@stage
def set_pose(machine, k, theta, h):
    """Put the shape of element k where it is at the share θ of a step of length h, by cubics through the pose kept and that at the end."""
    record = record_at(machine)
    markers, columns, n = record.markers, record.elements.columns[k], record.elements.number[k]
    memory, first = record.elements.memory[k], np.int64(columns[COUNT])
    i, j, end = columns[MARKER], columns[OTHER], END
    one = theta * theta * (3.0 - 2.0 * theta)
    low, high = h * theta * (1.0 - theta) * (1.0 - theta), -h * theta * theta * (1.0 - theta)
    B, o = markers.A[j], markers.r[j]
    w = real(memory[first + SPIN]), real(memory[first + SPIN + 1]), real(memory[first + SPIN + 2])
    W = real(n[end + SPIN]), real(n[end + SPIN + 1]), real(n[end + SPIN + 2])
    for c in range(4):
        at, step = (PLACE, 1) if c == 3 else (AXES + c, 3)
        x = real(memory[first + at]), real(memory[first + at + step]), real(memory[first + at + 2 * step])
        y = real(n[end + at]), real(n[end + at + step]), real(n[end + at + 2 * step])
        u, v = cross(w, x), cross(W, y)
        if c == 3:
            u = real(memory[first + SPEED]), real(memory[first + SPEED + 1]), real(memory[first + SPEED + 2])
            v = real(n[end + SPEED]), real(n[end + SPEED + 1]), real(n[end + SPEED + 2])
        p = (
            x[0] + one * (y[0] - x[0]) + low * u[0] + high * v[0],
            x[1] + one * (y[1] - x[1]) + low * u[1] + high * v[1],
            x[2] + one * (y[2] - x[2]) + low * u[2] + high * v[2],
        )
        for a in range(3):
            q = real(B[a, 0]) * p[0] + real(B[a, 1]) * p[1] + real(B[a, 2]) * p[2]
            if c == 3:
                markers.r[i, a] = real(o[a]) + q
            else:
                markers.A[i, a, c] = q


@stage
def overlap_at(machine, k, n, theta, h):
    """Overlap of point n at the share θ; its place in axes of the ground: of a ball that of its middle."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    set_pose(machine, k, theta, h)
    depth = real(find_point_over_ground(machine, k, n))
    p = seen(markers.A[columns[OTHER]], minus(numbers[POINT:NORMAL], markers.r[columns[OTHER]]))
    ball = ball_of(machine, k)
    if ball > 0.0:
        # the point of a ball was put on the ground
        m = seen(markers.A[columns[OTHER]], (numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]))
        away = ball - depth
        return depth, (real(p[0] + away * m[0]), real(p[1] + away * m[1]), real(p[2] + away * m[2]))
    return depth, (real(p[0]), real(p[1]), real(p[2]))


@stage
def kept(machine, k):
    """Place, axes and normal of element k as they are, which ways change."""
    record = record_at(machine)
    i, n = record.elements.columns[k, MARKER], record.elements.number[k]
    r, A = record.markers.r[i], record.markers.A[i]
    return (r[0], r[1], r[2]), axis(A, 0), axis(A, 1), axis(A, 2), (n[NORMAL], n[NORMAL + 1], n[NORMAL + 2])


@stage
def put_back(machine, k, own):
    """Put back what `kept` gave."""
    record = record_at(machine)
    i, n = record.elements.columns[k, MARKER], record.elements.number[k]
    for a in range(3):
        record.markers.r[i, a], n[NORMAL + a] = own[0][a], own[4][a]
        record.markers.A[i, a, 0], record.markers.A[i, a, 1], record.markers.A[i, a, 2] = (
            own[1][a],
            own[2][a],
            own[3][a],
        )
