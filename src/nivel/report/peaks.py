"""The largest reaction of each joint, and when."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nivel.results.scales import blocks

if TYPE_CHECKING:
    from nivel.results.result import Result


@dataclass(frozen=True)
class PeakReaction:
    """Largest force [N] and torque [N m] between the bodies of a joint, with their times [s]; `unique` if they are."""

    joint: str
    kind: str
    force: float
    force_time: float
    torque: float
    torque_time: float
    unique: bool = True


def peak_reactions(result: Result) -> list[PeakReaction]:
    """One line per joint, in the order of the machine."""
    if "joint_force" not in result.variables or not len(result.time):
        return []
    names = result.coordinates["joint"]
    kinds = {joint["name"]: joint["type"] for joint in result.scene.get("joints", [])}
    shaky = set(result.trust.non_unique_joints)
    force, torque = _peaks(result, "joint_force"), _peaks(result, "joint_torque")
    return [
        PeakReaction(name, kinds.get(name, ""), *force[k], *torque[k], name not in shaky)
        for k, name in enumerate(names)
    ]


def _peaks(result: Result, variable: str) -> list[tuple[float, float]]:
    """(largest magnitude, its time) of each joint; what is not a number is passed over."""
    best = np.full(len(result.coordinates["joint"]), -1.0)
    times = np.zeros(len(best))
    for frames in blocks(result):
        magnitude = np.linalg.norm(result.array(variable, frames), axis=-1)
        magnitude = np.where(np.isfinite(magnitude), magnitude, -1.0)
        k = np.argmax(magnitude, axis=0)
        largest = magnitude[k, np.arange(len(best))]
        times = np.where(largest > best, result.time[frames][k], times)
        best = np.maximum(best, largest)
    return [(float(value), float(time)) for value, time in zip(np.maximum(best, 0.0), times, strict=True)]
