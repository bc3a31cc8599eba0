"""Outputs of forces."""

from __future__ import annotations

from nivel.kernels.bodies.coordinate import LAST_ANGLE
from nivel.system.builder import SystemBuilder


def force_outputs(builder: SystemBuilder, name: str, *entries: tuple[str, str, str]) -> int:
    """Index of the first output of the force `name`: (output, units, in words)."""
    named = [(f"force.{name}.{output}", units, f"{words} of {name}") for output, units, words in entries]
    return builder.outputs.add(*named)


Output = tuple[str, str, str]


def magnitude_and_power(units: str, words: str = "magnitude") -> tuple[Output, Output]:
    """The two outputs that all forces begin with."""
    return ("magnitude", units, words), ("power", "W", "power into the machine")


def is_angle(builder: SystemBuilder, coordinate: int) -> bool:
    """Whether a coordinate is an angle [rad] and not a length [m]."""
    return builder.coordinates.what[coordinate][0] <= LAST_ANGLE
