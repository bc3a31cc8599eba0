"""Wrenches: generalised forces of forces and torques on bodies."""

from __future__ import annotations

from nivel.kernels.record.record import record_at
from nivel.native.function import stage


@stage
def add_coordinate_force(machine, q, effort):
    """Add the generalised force `effort` [N or N m] on coordinate q, positive where it drives the coordinate up; returns its power."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    for part in range(coordinates.start[q], coordinates.start[q + 1]):
        m = coordinates.part_marker[part]
        J, u, F = coordinates.J[part], markers.u[m], bodies.wrench[markers.body[m]]
        x, y, z = effort * J[0], effort * J[1], effort * J[2]
        F[0] += x
        F[1] += y
        F[2] += z
        F[3] += effort * J[3] + u[1] * z - u[2] * y
        F[4] += effort * J[4] + u[2] * x - u[0] * z
        F[5] += effort * J[5] + u[0] * y - u[1] * x
    return effort * coordinates.rate[q]


@stage
def add_marker_force(bodies, markers, m, x, y, z):
    """Add a force at marker m, global axes; returns its power."""
    u, v, F = markers.u[m], markers.rdot[m], bodies.wrench[markers.body[m]]
    F[0] += x
    F[1] += y
    F[2] += z
    F[3] += u[1] * z - u[2] * y
    F[4] += u[2] * x - u[0] * z
    F[5] += u[0] * y - u[1] * x
    return x * v[0] + y * v[1] + z * v[2]


@stage
def add_force_at(bodies, b, p, x, y, z):
    """Add a force on body b at the point p (3,), global; returns its power."""
    R, V, w, F = bodies.R[b], bodies.Rdot[b], bodies.omega[b], bodies.wrench[b]
    u0, u1, u2 = p[0] - R[0], p[1] - R[1], p[2] - R[2]
    n0, n1, n2 = u1 * z - u2 * y, u2 * x - u0 * z, u0 * y - u1 * x
    F[0] += x
    F[1] += y
    F[2] += z
    F[3] += n0
    F[4] += n1
    F[5] += n2
    return x * V[0] + y * V[1] + z * V[2] + n0 * w[0] + n1 * w[1] + n2 * w[2]


@stage
def add_torque(bodies, b, x, y, z):
    """Add a torque on body b, global axes; returns its power."""
    F, w = bodies.wrench[b], bodies.omega[b]
    F[3] += x
    F[4] += y
    F[5] += z
    return x * w[0] + y * w[1] + z * w[2]
