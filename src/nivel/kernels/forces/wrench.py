"""Wrenches: generalised forces of forces and torques on bodies."""

from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, plus_cross, times
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage


@leaf
def add_wrench(bodies, b, force, moment):
    """Add a force and its moment about the origin of body b, global axes."""
    F = bodies.wrench[b]
    F[0] += force[0]
    F[1] += force[1]
    F[2] += force[2]
    F[3] += moment[0]
    F[4] += moment[1]
    F[5] += moment[2]


@stage
def add_coordinate_force(machine, q, effort):
    """Add the generalised force `effort` [N or N m] on coordinate q, positive where it drives the coordinate up; returns its power."""
    record = record_at(machine)
    bodies, markers, coordinates = record.bodies, record.markers, record.coordinates
    for part in range(coordinates.start[q], coordinates.start[q + 1]):
        m = coordinates.part_marker[part]
        J, u = coordinates.J[part], markers.u[m]
        force, couple = times(effort, J), times(effort, (J[3], J[4], J[5]))
        add_wrench(bodies, markers.body[m], force, plus_cross(couple, u, force))
    return effort * coordinates.rate[q]


@stage
def add_marker_force(bodies, markers, m, force):
    """Add a force (3,) at marker m, global axes; returns its power."""
    add_wrench(bodies, markers.body[m], force, cross(markers.u[m], force))
    return dot(force, markers.rdot[m])


@stage
def add_force_at(bodies, b, p, force):
    """Add a force (3,) on body b at the point p (3,), global; returns its power."""
    moment = cross(minus(p, bodies.R[b]), force)
    add_wrench(bodies, b, force, moment)
    V, w = bodies.Rdot[b], bodies.omega[b]
    return force[0] * V[0] + force[1] * V[1] + force[2] * V[2] + moment[0] * w[0] + moment[1] * w[1] + moment[2] * w[2]


@stage
def add_torque(bodies, b, torque):
    """Add a torque (3,) on body b, global axes; returns its power."""
    F = bodies.wrench[b]
    F[3] += torque[0]
    F[4] += torque[1]
    F[5] += torque[2]
    return dot(torque, bodies.omega[b])


@stage
def velocity_at(bodies, b, p):
    """Velocity of the point of body b that is at p."""
    V, w, u = bodies.Rdot[b], bodies.omega[b], minus(p, bodies.R[b])
    return plus_cross(V, w, u)
