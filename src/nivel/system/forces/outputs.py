"""What forces report."""

from __future__ import annotations

from nivel.kernels.coordinate import LAST_ANGLE
from nivel.system.draft import Draft


def force_outputs(draft: Draft, name: str, *entries: tuple[str, str, str]) -> int:
    """Index of the first output of the force `name`: (output, units, in words)."""
    named = [(f"force.{name}.{output}", units, f"{words} of {name}") for output, units, words in entries]
    return draft.outputs.add(*named)


def magnitude_and_power(units: str) -> tuple[tuple[str, str, str], tuple[str, str, str]]:
    """The two outputs that all forces begin with."""
    return ("magnitude", units, "magnitude"), ("power", "W", "power into the machine")


def is_angle(draft: Draft, coordinate: int) -> bool:
    """Whether a coordinate is an angle [rad] and not a length [m]."""
    return draft.coordinates.what[coordinate][0] <= LAST_ANGLE
