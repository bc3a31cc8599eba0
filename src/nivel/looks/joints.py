"""Axes of joints in space, which say what is planar, and where their signs stand."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.looks.poses import Array, Pose
from nivel.machine.joints.joint import JOINT_WORDS
from nivel.system.joints.joints import looks_of


def turning_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies turn about and about nothing else, global; a link between two hinges has two."""
    axes = [joint_axis(joint, poses, which) for joint in scene["joints"] for which in looks_of(joint["type"]).turns]
    return np.reshape(np.array(axes), (-1, 3))


def sliding_axes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(k, 3) axes that bodies slide along and along nothing else, global."""
    axes = [joint_axis(joint, poses, slides) for joint in scene["joints"] if (slides := looks_of(joint["type"]).slides)]
    return np.reshape(np.array(axes), (-1, 3))


def slides_on_beam(joint: dict[str, Any]) -> bool:
    """Whether a joint slides along a beam, whose node in it is only where it began."""
    words = JOINT_WORDS.get(joint["type"])
    return words is not None and words.rail


def stands_at_second(joint: dict[str, Any]) -> bool:
    """Whether the sign of a joint stands at its point on the second body."""
    at = looks_of(joint["type"]).at
    return at == "second" or (at == "moving" and joint["bodies"][1] != "ground")


def joint_axis(joint: dict[str, Any], poses: dict[str, Pose], which: str) -> Array:
    """(3,) global axis of the first or the second marker, or of the slot, where there is one."""
    side = 0 if which == "first" else 1
    local = joint.get("slot", joint["axes"][side]) if which == "slot" else joint["axes"][side]
    return poses[joint["bodies"][side]][1] @ np.asarray(local, dtype=float)
