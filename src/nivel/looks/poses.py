"""Positions of points of bodies in space."""

from typing import Any

import numpy as np

from nivel.elements.joints import JOINTS, drawn
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
