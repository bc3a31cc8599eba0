"""Names of what a variant keeps where its user names nothing."""

from __future__ import annotations

from nivel.results.result import Result


def usual_names(result: Result) -> tuple[str, ...]:
    """Joint coordinates and sensors, or the positions of the bodies; of a circuit alone its pressures."""
    sensors = tuple(name for name in result.variables if name.startswith("sensor."))
    names = (*result.coordinates.get("joint_coordinate_name", ()), *sensors)
    return names or (("position",) if "position" in result.variables else pressures(result))


def pressures(result: Result) -> tuple[str, ...]:
    """Names of the pressures of a circuit."""
    return tuple(name for name in result.variables if name.startswith("hydraulics.") and name.endswith(".pressure"))
