"""The largest reaction of each joint, and when."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from nivel.lazy import dataclass
from nivel.results.scales import blocks

if TYPE_CHECKING:
    from nivel.results.result import Result

NEGLIGIBLE = 1e-9  # of the largest reaction in the machine, a torque counted as a force at its size: round-off


@dataclass(frozen=True)
class PeakReaction:
    """Largest force [N] and torque [N m] between the bodies of a joint, with their times [s]; 0 where negligible.

    unique : False where redundant constraints share the load in more than one way.
    """

    joint: str
    kind: str
    force: float
    force_time: float
    torque: float
    torque_time: float
    unique: bool = True


def peak_reactions(result: Result) -> list[PeakReaction]:
    """One line per joint that constrains something, in the order of the machine."""
    if "joint_force" not in result.variables or not len(result.time):
        return []
    kinds = {joint["name"]: joint["type"] for joint in result.scene.get("joints", [])}
    shaky = set(result.trust.non_unique_joints)
    floors = negligible(result)
    force, torque = (
        [(value, time) if value > floors[variable] else (0.0, 0.0) for value, time in _peaks(result, variable)]
        for variable in ("joint_force", "joint_torque")
    )
    return [
        PeakReaction(name, kinds.get(name, ""), *force[k], *torque[k], name not in shaky)
        for k, name in enumerate(result.coordinates["joint"])
        if kinds.get(name) != "variable-distance"
    ]


def negligible(result: Result) -> dict[str, float]:
    """The force [N] and torque [N m] below which a reaction is round-off."""
    size = result.trust.size
    force, torque = (max((v for v, _ in _peaks(result, name)), default=0.0) for name in ("joint_force", "joint_torque"))
    largest = max(force, torque / size)
    return {"joint_force": NEGLIGIBLE * largest, "joint_torque": NEGLIGIBLE * largest * size}


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
