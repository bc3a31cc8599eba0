"""Relative pose of two body frames, as numbers that can be wished for one by one.

The turn from the first to the second frame is R = R_x(a) R_y(b) R_z(c): angles a, b, c about x, y, z, each about the axis that the turns
before it have left (Cardan angles; Haug 1989, section 9.3 has the same for z, x, z). A turn has two such triples, (a, b, c) and
(a + π, π - b, c + π); the one nearest to the angles shown before is taken, so that every angle goes all round without a jump.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from nivel.lazy import dataclass, scipy
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

ANGLES: Final = (0, 1, 2)  # axes of a frame: its three angles [rad], then its three coordinates [m]
SHIFTS: Final = (3, 4, 5)
AXIS_NAMES: Final = ("angle_x", "angle_y", "angle_z", "x", "y", "z")
UPRIGHT: Final = 1e-6  # cosine of b below which a and c turn about one axis
ALL_ANGLES: Final = frozenset(ANGLES)


@dataclass(frozen=True)
class TurnedFrame:
    """The frame of body `second` seen from that of body `first`, -1 the ground; 3x3 axes of both frames in their bodies.

    Its coordinates x, y, z are those of the second body's origin and make sense from the ground only.
    """

    name: str
    first: int
    second: int
    first_axes: Array
    second_axes: Array

    def turn(self, q: Array) -> Array:
        """(3, 3) R from the first to the second frame at positions q (7 B,)."""
        return self._axes_in_space(q, 0).T @ self._axes_in_space(q, 1)

    def values(self, q: Array, near: Array) -> Array:
        """(6,) three angles, nearest to those of `near` (6,), and three coordinates."""
        place = q.reshape(-1, 7)[self.second, :3]
        return np.append(nearest_angles(self.turn(q), near[:3]), place)

    def turning(self, q: Array) -> Iterator[tuple[int, Array]]:
        """Body and (3, 6): derivative of the turn, as an angular velocity in first axes, for (Ṙ, ω̄) of the body."""
        back = self._axes_in_space(q, 0).T
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            if body >= 0:
                yield (
                    body,
                    np.hstack([np.zeros((3, 3)), sign * back @ rotation_matrices(q.reshape(-1, 7)[[body], 3:])[0]]),
                )

    def _axes_in_space(self, q: Array, side: int) -> Array:
        body, axes = (self.first, self.first_axes) if side == 0 else (self.second, self.second_axes)
        return axes if body < 0 else rotation_matrices(q.reshape(-1, 7)[[body], 3:])[0] @ axes


@dataclass(frozen=True)
class FrameAim:
    """Values wished for some axes of a frame: {axis: value}. size : [m] a length to weigh metres against radians."""

    frame: TurnedFrame
    values: dict[int, float]
    near: Array
    size: float

    @property
    def scale(self) -> Array:
        """(k,) what counts as one of each error."""
        return np.array([1.0 if axis in ANGLES else self.size for axis in sorted(self.values)])

    def error(self, q: Array) -> Array:
        """(k,) how far the values are from those wished for, at positions q."""
        if self._is_whole:
            turn = scipy.spatial.transform.Rotation
            wanted = turn.from_euler("XYZ", [self.values[axis] for axis in ANGLES]).as_matrix()
            turned = wanted @ turn.from_matrix(wanted.T @ self.frame.turn(q)).as_rotvec()
            return np.append(turned, [self._shift(q, axis) for axis in sorted(self.values) if axis in SHIFTS])
        now = self.frame.values(q, self.near)
        return np.array(
            [
                _wrapped(now[axis] - self.values[axis]) if axis in ANGLES else self._shift(q, axis)
                for axis in sorted(self.values)
            ]
        )

    def rows(self, q: Array) -> Iterator[tuple[int, int, Array]]:
        """Row, body and (6,) derivatives of the errors for (Ṙ, ω̄) of the body."""
        chosen = sorted(self.values)
        rates = np.eye(3) if self._is_whole else rates_of_angles(self.frame.values(q, self.near)[:3])
        for body, block in self.frame.turning(q):
            for row, axis in enumerate(chosen):
                if axis in ANGLES:
                    yield row, body, rates[axis] @ block
        for row, axis in enumerate(chosen):
            if axis in SHIFTS:
                yield row, self.frame.second, np.eye(6)[axis - 3]

    @property
    def _is_whole(self) -> bool:
        """All angles are wished for: then the turn is aimed at as a whole, which is never singular."""
        return set(self.values) >= ALL_ANGLES

    def _shift(self, q: Array, axis: int) -> float:
        return float(q.reshape(-1, 7)[self.frame.second, axis - 3]) - self.values[axis]


def nearest_angles(R: Array, near: Array) -> Array:
    """(3,) angles of the turn R that are nearest to `near`."""
    b = np.arctan2(R[0, 2], np.hypot(R[0, 0], R[0, 1]))
    upright = np.hypot(R[0, 0], R[0, 1]) < UPRIGHT
    a = near[0] if upright else np.arctan2(-R[1, 2], R[2, 2])
    candidates = []
    for first, second in ((a, b), (a + np.pi, np.pi - b)):
        rest = np.array([0.0, np.cos(first), np.sin(first)]) @ R  # second row of R_x(-a) R: (sin c, cos c, 0)
        angles = np.array([first, second, np.arctan2(rest[0], rest[1])])
        candidates.append(near + _wrapped(angles - near))
    return min(candidates, key=lambda angles: float(np.sum((angles - near) ** 2)))


def rates_of_angles(angles: Array) -> Array:
    """(3, 3) ȧ, ḃ, ċ for an angular velocity in first axes: the inverse of [e_x, R_x e_y, R_x R_y e_z]; large near b = ±90°."""
    (ca, cb, _), (sa, sb, _) = np.cos(angles), np.sin(angles)
    cb = cb if abs(cb) > UPRIGHT else UPRIGHT
    return np.array([[1.0, sa * sb / cb, -ca * sb / cb], [0.0, ca, sa], [0.0, -sa / cb, ca / cb]])


def _wrapped(angle: Array) -> Array:
    """Between -π and π."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi
