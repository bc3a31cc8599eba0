"""What a picture of a machine consists of, and where its points are in space."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.report.labels import Label

Array = NDArray[np.float64]
Pose = tuple[Array, Array]  # position (3,) [m] and rotation matrix (3, 3) of a body frame, global axes


@dataclass
class Drawing:
    """What is drawn, and what names must keep clear of. Pixels.

    parts : (depth, SVG) of bodies, drawn far things first. links : over them. signs : over all.
    points, covered : to keep free. lines : better not crossed.
    """

    parts: list[tuple[float, str]] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    signs: list[str] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)
    covered: list[Array] = field(default_factory=list)
    lines: list[Array] = field(default_factory=list)


def body_poses(scene: dict[str, Any], position: Array, orientation: Array) -> dict[str, Pose]:
    """Pose of every body by name; of the ground too."""
    out = {"ground": (np.zeros(3), np.eye(3))}
    for body, r, theta in zip(scene["bodies"], position, orientation, strict=True):
        out[body["name"]] = (np.asarray(r, dtype=float), _rotation(np.asarray(theta, dtype=float)))
    return out


def _rotation(theta: Array) -> Array:
    e0, e = theta[0], theta[1:]
    cross = np.array([[0.0, -e[2], e[1]], [e[2], 0.0, -e[0]], [-e[1], e[0], 0.0]])
    return np.eye(3) + 2.0 * e0 * cross + 2.0 * cross @ cross


def in_space(pose: Pose, points: Any) -> Array:
    """(n, 3) [m] global points of points in the body frame."""
    r, A = pose
    return r + np.reshape(np.asarray(points, dtype=float), (-1, 3)) @ A.T


def ends_in_space(element: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(2, 3) [m] global points of a joint or force: on its first and on its second body."""
    pairs = zip(element["bodies"], element["points"], strict=True)
    return np.concatenate([in_space(poses[body], point) for body, point in pairs])
