"""Looks of joints: where their signs stand, which are links, and their axes in space, which say what is planar."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.looks.poses import Array, Pose

ON_RAIL = ("translational", "cylindrical", "screw")  # drawn where the moving body is
ON_FIRST = (
    "planar",
    "point-on-line",
    "point-on-plane",
    "rolling",
)  # a point of the second body on a line or plane of the first
# along a beam, whose node in the joint is only where it began
SLIDING_ON_BEAMS = ("point-on-beam", "keyed-on-beam", "cylindrical-on-beam", "translational-on-beam")
# massless links between two bodies, and the joints at their ends
LINKS = {
    "distance": ("spherical", "spherical"),
    "spherical-spherical": ("spherical", "spherical"),
    "variable-distance": ("spherical", "spherical"),
    "revolute-spherical": ("revolute", "spherical"),
    "revolute-cylindrical": ("revolute", "cylindrical"),
}
# axes of a joint that turns about them only, or slides along them only: they say what is planar
TURNING = ("revolute", "cylindrical", "planar", "revolute-spherical", "revolute-translational", "revolute-cylindrical")
SLIDING = ("translational", "screw", "point-on-line")


def turning_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies turn about, global; a link between two hinges has two."""
    axes = _axes(scene, poses, TURNING, "first")
    return np.concatenate([axes, _axes(scene, poses, ("revolute-cylindrical",), "second")])


def sliding_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies slide along, global."""
    return np.concatenate(
        [_axes(scene, poses, SLIDING, "first"), _axes(scene, poses, ("revolute-translational",), "slot")]
    )


def _axes(scene: dict[str, Any], poses: dict[str, Pose], kinds: tuple[str, ...], which: str) -> Array:
    found = [joint_axis(joint, poses, which) for joint in scene["joints"] if joint["type"] in kinds]
    return np.reshape(np.array(found), (-1, 3))


def joint_axis(joint: dict[str, Any], poses: dict[str, Pose], which: str) -> Array:
    """(3,) global axis of the first or the second marker, or of the slot, where there is one."""
    side = 0 if which == "first" else 1
    local = joint.get("slot", joint["axes"][side]) if which == "slot" else joint["axes"][side]
    return poses[joint["bodies"][side]][1] @ np.asarray(local, dtype=float)
