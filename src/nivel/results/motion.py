"""The motion of all bodies at the frames of a run, and how far two of them are apart."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass
from nivel.results.peaks import Peak
from nivel.results.scales import Readable

Array = NDArray[np.float64]
SAME_TIME: Final = 1e-9  # of the time span: frames this near are of one time

DEFINITION: Final = (
    "the largest, over all frames and bodies, of the distance between the two body origins divided by the size of the machine, and of "
    "the angle between the two orientations in radians"
)


@dataclass(frozen=True)
class Motion:
    """time (n,) [s], position (n, bodies, 3) [m], orientation (n, bodies, 4): Euler parameters of body frames in global axes."""

    time: Array
    position: Array
    orientation: Array
    bodies: tuple[str, ...]

    @classmethod
    def of(cls, result: Readable) -> Motion:
        """The motion in `result`; it may have no bodies."""
        bodies = result.coordinates.get("body", ())
        if "position" not in result.variables:
            n = len(result.time)
            return cls(result.time, np.zeros((n, 0, 3)), np.zeros((n, 0, 4)), ())
        return cls(result.time, result.array("position"), result.array("orientation"), bodies)


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is far away, not a warning
def distance(a: Motion, b: Motion, size: float) -> Peak:
    """How far two motions are apart: DEFINITION, with body and time. size : of the machine [m].

    Only frames at times that both have count; the first NaN counts as the largest.
    """
    time, worst = distances(a, b, size)
    if not worst.size:
        return Peak(0.0)
    k, body = np.unravel_index(int(np.argmax(worst)), worst.shape)
    return Peak(float(worst[k, body]), a.bodies[body], float(time[k]))


@np.errstate(over="ignore", invalid="ignore")
def distances(a: Motion, b: Motion, size: float, levers: Array | float | None = None) -> tuple[Array, Array]:
    """Times (n,) [s] that both motions have, and how far each body is from itself then (n, bodies), as DEFINITION says.

    levers : (bodies,) [m] that angles are multiplied by, before they are divided by the size too; by default the size itself.
    """
    first, second = common_frames(a.time, b.time)
    off = np.linalg.norm(a.position[first] - b.position[second], axis=-1) / size
    p, q = a.orientation[first], b.orientation[second]
    # θ and -θ are one orientation; |θ_a - θ_b| = 2 sin(angle/4)
    chord = np.minimum(np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1))
    angle = 4.0 * np.arcsin(np.clip(0.5 * chord, 0.0, 1.0))
    return a.time[first], np.maximum(off, angle if levers is None else angle * (np.asarray(levers) / size))


def common_frames(a: Array, b: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Places in the times a (n,) and b (m,) [s], both rising, of the frames that both have."""
    if not len(a) or not len(b):
        return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
    tolerance = SAME_TIME * max(abs(float(a[-1])), abs(float(b[-1])))
    places = np.minimum(np.searchsorted(b, a - tolerance), len(b) - 1)
    found = np.flatnonzero(np.abs(b[places] - a) <= tolerance)
    return found, places[found]


def rotation_matrices(theta: Array) -> Array:
    """(n, 3, 3) of Euler parameters (n, 4), scalar first and of unit length: columns are the axes of the frames."""
    e0, e = theta[:, 0], theta[:, 1:]
    tilde = np.zeros((len(theta), 3, 3))
    tilde[:, [2, 0, 1], [1, 2, 0]], tilde[:, [1, 2, 0], [2, 0, 1]] = e, -e
    return np.eye(3) + 2.0 * (e0[:, None, None] * tilde + tilde @ tilde)
