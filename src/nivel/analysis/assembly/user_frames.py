"""Frames of bodies as their user placed them, in the complex twin of an instant: relative coordinates use frames of their own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.instant import Instant
from nivel.machine.core.vectors import cross

Vector = NDArray[np.complex128]


def frame_place(own: Instant, b: int) -> Vector:
    """(3,) [m] place of the frame of a body as its user placed it."""
    bodies, tree = own.twin.bodies, own.twin.tree
    return bodies.R[b] + (bodies.A[b] @ tree.own[b] if len(tree.node) else 0.0)


def frame_velocity(own: Instant, b: int) -> Vector:
    """(3,) [m/s] its velocity."""
    bodies, tree = own.twin.bodies, own.twin.tree
    offset = bodies.A[b] @ tree.own[b] if len(tree.node) else np.zeros(3, dtype=np.complex128)
    return bodies.Rdot[b] + cross(bodies.omega[b], offset)


def frame_axes(own: Instant, b: int) -> Vector:
    """(3, 3) its axes, as columns."""
    bodies, tree = own.twin.bodies, own.twin.tree
    if not len(tree.node):
        return bodies.A[b]
    return bodies.A[b] @ Rotation.from_quat(tree.own_theta[b], scalar_first=True).as_matrix()


def point_velocity(own: Instant, b: int, position: NDArray[np.float64]) -> Vector:
    """(6,) [m/s, rad/s] velocity of a point of the body, given in its frame [m], and angular velocity."""
    omega = own.twin.bodies.omega[b]
    return np.concatenate([frame_velocity(own, b) + cross(omega, frame_axes(own, b) @ position), omega])


def point_acceleration(own: Instant, b: int, position: NDArray[np.float64]) -> Vector:
    """(6,) [m/s², rad/s²] acceleration of a point of the body and angular acceleration; the accelerations of bodies are known."""
    bodies, tree = own.twin.bodies, own.twin.tree
    alpha, omega = bodies.A[b] @ bodies.alpha_b[b], bodies.omega[b]
    offset = bodies.A[b] @ tree.own[b] if len(tree.node) else np.zeros(3, dtype=np.complex128)
    d = offset + frame_axes(own, b) @ position
    return np.concatenate([bodies.Rddot[b] + cross(alpha, d) + cross(omega, cross(omega, d)), alpha])
