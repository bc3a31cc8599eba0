"""Viewpoint from which a machine is seen."""

import numpy as np

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

PLANAR = 0.05  # a machine thinner than this fraction of its length is flat
ALIGNED = 0.99  # cosine of axes that count as parallel
ELEVATION = np.deg2rad(28.0)
AZIMUTHS = np.deg2rad([-60.0, -45.0, -30.0, 30.0, 45.0, 60.0, 120.0, 135.0, 150.0, -120.0, -135.0, -150.0])
X, Y, Z = np.eye(3)


class View(Struct):
    """An orthographic view; three perpendicular unit vectors in global axes.

    right, up : directions on the screen. towards : from the machine to the eye.
    """

    right: Array
    up: Array
    towards: Array

    def on_screen(self, points: Array) -> Array:
        """(…, 2) [m] right and up of points (…, 3)."""
        return points @ np.stack([self.right, self.up], axis=-1)

    def depth(self, points: Array) -> Array:
        """(…,) [m], larger is nearer to the eye."""
        return points @ self.towards


def choose_view(points: Array, turning: Array, sliding: Array, up: Array = Z) -> View:
    """The view of a machine with these points (n, 3) [m], all in global axes.

    turning, sliding : (k, 3) axes of its joints. A machine is planar when its points lie in a plane, it turns about the
    plane's normal only and slides in the plane only. It is seen along the normal, with `up` upwards or, where that is the
    normal, Y (Z for a normal along Y). Any other is seen from above at 28 degrees, from the side that keeps its points
    furthest apart.
    """
    if is_planar(points, turning, sliding):
        return _head_on(turning[0], up)
    views = [_from_side(azimuth, up) for azimuth in AZIMUTHS]
    return max(views, key=lambda view: _clarity(view.on_screen(points)))


def is_planar(points: Array, turning: Array, sliding: Array) -> bool:
    """Whether a machine with these points and axes, as for `choose_view`, moves in one plane."""
    if not len(turning) or abs(turning @ turning[0]).min() <= ALIGNED:
        return False
    flat = np.ptp(points @ turning[0]) <= PLANAR * np.ptp(points, axis=0).max()
    return bool(flat and np.all(np.abs(sliding @ turning[0]) < 0.1))


def _head_on(normal: Array, up: Array) -> View:
    """Look along the normal, from the side that is usual in drawings: X to the right before Y, Y before Z."""
    if abs(normal @ up) > 0.99:
        up = Y if abs(normal @ Y) < 0.99 else Z
    up = up - (up @ normal) * normal
    up = up / np.linalg.norm(up)
    right = np.asarray(np.cross(up, normal), dtype=float)
    sign = 1.0 if right[int(np.argmax(np.abs(right) - [0.0, 1e-6, 2e-6]))] >= 0.0 else -1.0
    return View(sign * right, up, sign * normal)


def _from_side(azimuth: float, up: Array) -> View:
    """From above at the elevation, turned by `azimuth` about `up` from the horizontal direction that is usual."""
    front = -Y if abs(up @ Z) > 0.9 else Z
    front = front - (front @ up) * up
    front = front / np.linalg.norm(front)
    side = np.cross(up, front)
    horizontal = np.cos(azimuth) * front + np.sin(azimuth) * side
    towards = np.cos(ELEVATION) * horizontal + np.sin(ELEVATION) * up
    right = np.asarray(np.cross(up, horizontal), dtype=float)
    return View(right, np.cross(towards, right), towards)


def _clarity(flat: Array) -> float:
    """How well points (n, 2) are seen apart: their spread in both directions, less where many nearly coincide."""
    centred = flat - flat.mean(axis=0)
    extents = np.linalg.svd(centred, compute_uv=False)
    length = extents[0] or 1.0
    distances = np.linalg.norm(flat[:60, None] - flat[None, :60], axis=-1)
    apart = np.clip(distances / (0.15 * np.ptp(flat, axis=0).max() or 1.0), 0.0, 1.0)
    return float(extents[-1] / length + apart.mean())
