"""Frames of bodies as their user placed them, in the twin of an instant: relative coordinates use frames of their own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.instant import Instant
from nivel.analysis.assembly.lanes import Lanes, cross, product


def _offset(own: Instant, b: int) -> Lanes:
    """(3, ·) [m] from the frame of the body in the equations."""
    A, tree = own.twin.bodies.A[b], own.twin.tree
    return np.einsum("ijz,j->iz", A, tree.own[b] if len(tree.node) else np.zeros(3))


def frame_place(own: Instant, b: int) -> Lanes:
    """(3, ·) [m] place of the frame of a body as its user placed it."""
    return own.twin.bodies.R[b] + _offset(own, b)


def frame_velocity(own: Instant, b: int) -> Lanes:
    """(3, ·) [m/s] its velocity."""
    bodies = own.twin.bodies
    return bodies.Rdot[b] + cross(bodies.omega[b], _offset(own, b))


def frame_axes(own: Instant, b: int) -> Lanes:
    """(3, 3, ·) its axes, as columns."""
    bodies, tree = own.twin.bodies, own.twin.tree
    if not len(tree.node):
        return bodies.A[b]
    axes = Rotation.from_quat(tree.own_theta[b], scalar_first=True).as_matrix()
    return np.einsum("ijz,jk->ikz", bodies.A[b], axes)


def point_velocity(own: Instant, b: int, position: NDArray[np.float64]) -> Lanes:
    """(6, ·) [m/s, rad/s] velocity of a point of the body, given in its frame [m], and angular velocity."""
    omega = own.twin.bodies.omega[b]
    arm = np.einsum("ijz,j->iz", frame_axes(own, b), position)
    return np.concatenate([frame_velocity(own, b) + cross(omega, arm), omega])


def point_acceleration(own: Instant, b: int, position: NDArray[np.float64]) -> Lanes:
    """(6, ·) [m/s², rad/s²] acceleration of a point of the body and angular acceleration; the accelerations of bodies are known."""
    bodies = own.twin.bodies
    alpha, omega = product("ij,j->i", bodies.A[b], bodies.alpha_b[b]), bodies.omega[b]
    d = _offset(own, b) + np.einsum("ijz,j->iz", frame_axes(own, b), position)
    return np.concatenate([bodies.Rddot[b] + cross(alpha, d) + cross(omega, cross(omega, d)), alpha])
