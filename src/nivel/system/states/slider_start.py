"""Joint coordinates and velocities of a body that slides along a beam, from its pose; see `nivel.kernels.tree.slider`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from nivel.lazy import dataclass, scipy
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.system.joints.rails import between, element_of
from nivel.system.system import Array

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline

MOST = 50  # iterations
CLOSE = 1e-14  # of the length of the beam


@dataclass(frozen=True)
class Rail:
    """The nodes of a beam: places along the unstressed line (N,) [m], positions (N, 3), axes of the sections (N, 3, 3), velocities and
    angular velocities (N, 3), in global axes. near : where the slider is, about [m]."""

    station: Array
    near: float
    r: Array
    axes: Array
    rdot: Array
    omega: Array


def slider_start(kind: str, pose: tuple[Array, Array, Array, Array], rail: Rail) -> tuple[list[float], list[float]]:
    """Positions and velocities of the joint. pose : position, axes, velocity and angular velocity of the slider's marker."""
    p, A, v, w = pose
    sigma, e = _nearest(rail, p)
    line, moving = _line(rail, e), _line(rail, e, rates=True)
    T = line(sigma, 1)
    rate = float(T @ (v - moving(sigma)) / (T @ T))
    if kind == "point-on-beam":
        return [sigma, *euler_parameters_from_matrix(A)], [rate, *(A.T @ w)]
    (x, xdot), (y, ydot) = (_axis(rail, e, sigma, rate, k) for k in (0, 1))
    e2 = np.cross(x, y)
    e2 /= np.linalg.norm(e2)
    if kind == "keyed-on-beam":
        e1 = y / np.linalg.norm(y)
        e3 = np.cross(e1, e2)
        over = e2 @ ydot / np.linalg.norm(y)
        of_axes = np.array([(x @ e1 * over - e2 @ xdot) / (x @ e3), -(e3 @ ydot) / np.linalg.norm(y), over])
    else:
        e3 = x / np.linalg.norm(x)
        e1 = np.cross(e2, e3)
        across = e2 @ xdot / np.linalg.norm(x)
        of_axes = np.array([-across, e1 @ xdot / np.linalg.norm(x), (e2 @ ydot - y @ e3 * across) / (y @ e1)])
    F = np.column_stack([e1, e2, e3])
    Q, own = F.T @ A, F.T @ w - of_axes
    if kind == "translational-on-beam":
        return [sigma], [rate]
    if kind == "cylindrical-on-beam":
        return [sigma, float(np.arctan2(Q[1, 0], Q[0, 0]))], [rate, float(own[2])]
    first, second = float(np.arctan2(Q[2, 1], Q[1, 1])), float(np.arctan2(Q[0, 2], Q[0, 0]))
    return [sigma, first, second], [rate, float(own[0]), float(Q[:, 1] @ own)]


def _line(rail: Rail, e: int, *, rates: bool = False) -> CubicHermiteSpline:
    """The line between the nodes e and e + 1, or its rates at fixed places."""
    ends = slice(e, e + 2)
    if rates:
        return scipy.interpolate.CubicHermiteSpline(
            rail.station[ends], rail.rdot[ends], np.cross(rail.omega[ends], rail.axes[ends, :, 0])
        )
    return scipy.interpolate.CubicHermiteSpline(rail.station[ends], rail.r[ends], rail.axes[ends, :, 0])


def _axis(rail: Rail, e: int, sigma: float, rate: float, k: int) -> tuple[Array, Array]:
    """Axis k of the sections between the nodes e and e + 1, and its rate at a place that moves with a rate."""
    axes = rail.axes[:, :, k]
    axis, moving = between(rail.station, axes, e), between(rail.station, np.cross(rail.omega, axes), e)
    return axis(sigma), moving(sigma) + rate * axis(sigma, 1)


def _nearest(rail: Rail, p: Array) -> tuple[float, int]:
    """Place of the point p along the beam and the number of the node before it, by Newton's iteration as
    `nivel.kernels.bodies.rail.closest`."""
    sigma = rail.near
    for _ in range(MOST):
        e = element_of(rail.station, sigma)
        line = _line(rail, e)
        d, T = p - line(sigma), line(sigma, 1)
        most = 2.0 * (rail.station[e + 1] - rail.station[e])
        change = float(np.clip(T @ d / (T @ T - d @ line(sigma, 2)), -most, most))
        sigma += change
        if abs(change) <= CLOSE * rail.station[-1]:
            break
    return sigma, element_of(rail.station, sigma)
