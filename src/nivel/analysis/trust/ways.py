"""Ways of points between the frames of a result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import cross
from nivel.results.scales import Readable, rotated

Array = NDArray[np.float64]
# speeds of frames differ by less where nothing happened between them
UNCHANGED = 0.2
# straight pieces of the way between two frames
PIECES = 64


@dataclass(frozen=True)
class Way:
    """Place (n, 3) of one point from another at the frames, its rate and its second rate."""

    time: Array
    place: Array
    rate: Array
    bend: Array

    @property
    def length(self) -> Array:
        """(n - 1,) [m] of the ways between frames, at most."""
        speed = np.linalg.norm(self.rate, axis=1)
        return np.diff(self.time) * np.maximum(speed[:-1], speed[1:])

    @property
    def undisturbed(self) -> NDArray[np.bool_]:
        """(n - 1,) whether accelerations at both frames explain the change of the velocity, as on straight lines and arcs: nothing else,
        such as an impact, has happened between them."""
        span, change = np.diff(self.time)[:, None], np.diff(self.rate, axis=0)
        left = np.linalg.norm(change - 0.5 * span * (self.bend[:-1] + self.bend[1:]), axis=1)
        speed = np.linalg.norm(self.rate, axis=1)
        return left < UNCHANGED * np.maximum(speed[:-1], speed[1:])

    def between(self, k: Any, share: Any) -> Array:
        """(…, 3) places at a share of the way from frame k to the next: the cubic with the places and rates at both."""
        s, span = np.asarray(share)[..., None], np.asarray(self.time[k + 1] - self.time[k])[..., None]
        first = (1.0 + 2.0 * s) * self.place[k] + s * span * self.rate[k]
        last = (3.0 - 2.0 * s) * self.place[k + 1] - (1.0 - s) * span * self.rate[k + 1]
        return (1.0 - s) ** 2 * first + s * s * last

    def nearest(self, reach: float) -> tuple[float, float, float] | None:
        """Least distance [m] in an interval at whose ends it is larger than `reach`, its time [s], and for how long it is less [s]."""
        distance = np.linalg.norm(self.place, axis=1)
        apart = np.minimum(distance[:-1], distance[1:])
        # to come within reach and to leave it again takes twice that way
        taken = self.undisturbed & (apart > reach) & (apart - 0.75 * self.length < reach)
        best: tuple[float, float, float] | None = None
        shares = np.linspace(0.0, 1.0, PIECES + 1)
        for k in np.flatnonzero(taken):
            points = self.between(k, shares)
            step = np.diff(points, axis=0)
            square = np.maximum(np.sum(step * step, axis=1), np.finfo(float).tiny)
            part = np.clip(-np.sum(points[:-1] * step, axis=1) / square, 0.0, 1.0)
            least = np.linalg.norm(points[:-1] + part[:, None] * step, axis=1)
            j = int(np.argmin(least))
            if least[j] < reach and (best is None or least[j] < best[0]):
                span = float(self.time[k + 1] - self.time[k])
                speed = np.sqrt(square[j]) * PIECES / span
                lasted = min(2.0 * np.sqrt(reach**2 - least[j] ** 2) / speed, span)
                best = float(least[j]), float(self.time[k] + (j + part[j]) / PIECES * span), float(lasted)
        return best


def way_between(result: Readable, bodies: tuple[str, str], points: tuple[Array, Array]) -> Way:
    """The way of a point of the first body, seen from one of the second in global axes."""
    first, second = (motion_of(result, body, at) for body, at in zip(bodies, points, strict=True))
    return Way(result.time, *(a - b for a, b in zip(first, second, strict=True)))


def motion_of(result: Readable, body: str, at: Array) -> tuple[Array, Array, Array]:
    """Place, velocity and acceleration (n, 3) of a point of a body."""
    k = result.coordinates["body"].index(body)
    arm = rotated(result.array("orientation")[:, k], at)
    omega, alpha = result.array("angular_velocity")[:, k], result.array("angular_acceleration")[:, k]
    turning = cross(omega, arm)
    bending = cross(alpha, arm) + cross(omega, turning)
    return (
        result.array("position")[:, k] + arm,
        result.array("velocity")[:, k] + turning,
        result.array("acceleration")[:, k] + bending,
    )
