"""The way of a belt or chain around its two pulleys."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from nivel.looks.joints import joint_axis
from nivel.looks.poses import Array, Pose, in_space

STEPS: Final = 24  # of an arc


def belt_line(belt: dict[str, Any], joints: list[dict[str, Any]], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points of a closed belt; none where one pulley lies within the other. `belt` and `joints` are those of a scene.

    A pulley turns about the axis of its joint, and its centre is the point of the joint on the second body.
    """
    first, second = (next(each for each in joints if each["name"] == name) for name in belt["joints"])
    centres = [in_space(poses[each["bodies"][1]], each["points"][1])[0] for each in (first, second)]
    axis = joint_axis(first, poses, "first")
    apart = centres[1] - centres[0]
    apart = apart - (apart @ axis) * axis
    distance = float(np.linalg.norm(apart))
    r1, r2 = belt["radii"]
    reach = r1 + r2 if belt["crossed"] else r1 - r2
    if not abs(reach) < distance:
        return np.empty((0, 3))
    x = apart / distance
    y = np.cross(axis, x)
    alpha = float(np.arccos(reach / distance))  # from the line of the centres to where the belt leaves the first pulley
    far = alpha - np.pi if belt["crossed"] else alpha  # the same on the second one
    arcs = (
        (centres[0], r1, np.linspace(alpha, 2.0 * np.pi - alpha, STEPS)),
        (centres[1], r2, np.linspace(-far, far, STEPS)),
    )
    parts = [c + r * (np.outer(np.cos(angle), x) + np.outer(np.sin(angle), y)) for c, r, angle in arcs]
    return np.concatenate([*parts, parts[0][:1]])
