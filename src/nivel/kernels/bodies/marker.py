"""Markers: frames on bodies. Joints, forces and sensors see these only."""

from nivel.kernels.algebra.spatial import centripetal, multiply
from nivel.kernels.algebra.vectors import plus_cross, put
from nivel.native.function import stage


@stage
def place_marker(bodies, markers, k):
    """Position r and axes A of marker k."""
    place_point(bodies, markers, k)
    turn_axes(bodies, markers, k)


@stage
def place_point(bodies, markers, k):
    """Position r of marker k."""
    b = markers.body[k]
    multiply(bodies.A[b], markers.position_b[k], markers.u[k])
    for i in range(3):
        markers.r[k, i] = bodies.R[b, i] + markers.u[k, i]


@stage
def turn_axes(bodies, markers, k):
    """Axes A of marker k."""
    A = bodies.A[markers.body[k]]
    for i in range(3):
        for j in range(3):
            markers.A[k, i, j] = (
                A[i, 0] * markers.frame_b[k, 0, j]
                + A[i, 1] * markers.frame_b[k, 1, j]
                + A[i, 2] * markers.frame_b[k, 2, j]
            )


@stage
def move_marker(bodies, markers, k):
    """Velocity ṙ = Ṙ + ω × u and bias acceleration ω × (ω × u) of marker k."""
    b = markers.body[k]
    w, u, V = bodies.omega[b], markers.u[k], bodies.Rdot[b]
    put(markers.rdot[k], 0, plus_cross(V, w, u))
    centripetal(w, u, markers.bias[k])


@stage
def place_markers(bodies, markers):
    """Position r and axes A of every marker, from the poses of the bodies."""
    for k in range(markers.body.shape[0]):
        place_marker(bodies, markers, k)


@stage
def move_markers(bodies, markers):
    """Velocity ṙ = Ṙ + ω × u and bias acceleration ω × (ω × u) of every marker."""
    for k in range(markers.body.shape[0]):
        move_marker(bodies, markers, k)
