"""Viewpoint from which a machine is seen, and positions of points of its bodies in space."""

from typing import Any

import numpy as np

from nivel.elements.joints import JOINTS, drawn
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

Pose = tuple[Array, Array]  # position (3,) [m] and rotation matrix (3, 3) of a body frame, global axes


def body_poses(scene: dict[str, Any], position: Array, orientation: Array) -> dict[str, Pose]:
    """Pose of every body by name; of the ground too."""
    out = {"ground": (np.zeros(3), np.eye(3))}
    for body, r, theta in zip(scene["bodies"], position, orientation, strict=True):
        out[body["name"]] = (np.asarray(r, dtype=float), rotation(np.asarray(theta, dtype=float)))
    return out


def rotation(theta: Array) -> Array:
    """(…, 3, 3) of Euler parameters (…, 4) of unit length, scalar first: 1 + 2 θ₀ ẽ + 2 ẽ ẽ."""
    e0, (x, y, z) = theta[..., 0, None, None], np.moveaxis(theta[..., 1:], -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*theta.shape[:-1], 3, 3)
    return np.eye(3) + 2.0 * e0 * cross + 2.0 * cross @ cross


def in_space(pose: Pose, points: Any) -> Array:
    """(n, 3) [m] global points of points in the body frame."""
    r, A = pose
    return r + np.reshape(np.asarray(points, dtype=float), (-1, 3)) @ A.T


def ends_in_space(element: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(2, 3) [m] global points of a joint or force: on its first and on its second body; of a rope more."""
    pairs = zip(element["bodies"], element["points"], strict=True)
    return np.concatenate([in_space(poses[body], point) for body, point in pairs])


def upwards(gravity: Any) -> Array:
    """(3,) the direction that points up in a picture: against gravity along the nearest axis; Z where nothing falls."""
    gravity = np.array(gravity or [0.0, 0.0, 0.0], dtype=float)
    axis = int(np.argmax(np.abs(gravity)))
    return -np.sign(gravity[axis]) * np.eye(3)[axis] if gravity.any() else np.array([0.0, 0.0, 1.0])


def turning_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies turn about and about nothing else, global; a link between two hinges has two."""
    axes = [joint_axis(joint, poses, which) for joint in scene["joints"] for which in drawn(joint["type"]).looks.turns]
    return np.reshape(np.array(axes), (-1, 3))


def sliding_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies slide along and along nothing else, global."""
    axes = [
        joint_axis(joint, poses, slides) for joint in scene["joints"] if (slides := drawn(joint["type"]).looks.slides)
    ]
    return np.reshape(np.array(axes), (-1, 3))


def slides_on_beam(joint: dict[str, Any]) -> bool:
    """Whether a joint slides along a beam, whose node in it is only where it began."""
    words = JOINTS.get(joint["type"])
    return words is not None and words.rail


def stands_at_second(joint: dict[str, Any]) -> bool:
    """Whether the sign of a joint stands at its point on the second body."""
    at = drawn(joint["type"]).looks.at
    return at == "second" or (at == "moving" and joint["bodies"][1] != "ground")


def joint_axis(joint: dict[str, Any], poses: dict[str, Pose], which: str) -> Array:
    """(3,) global axis of the first or the second marker, or of the slot, where there is one."""
    side = 0 if which == "first" else 1
    local = joint.get("slot", joint["axes"][side]) if which == "slot" else joint["axes"][side]
    return poses[joint["bodies"][side]][1] @ np.asarray(local, dtype=float)


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
