"""Tornado of the report: by how much each parameter moves curves of the run at its end, the largest first."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from nivel.lazy import dataclass

if TYPE_CHECKING:
    from nivel.results.result import Result

OUTPUTS, PARAMETERS = 6, 12  # that are drawn; others stand in the result
CHANGE = 0.01  # of the parameter, for which the change of the curve is told


@dataclass(frozen=True)
class Bar:
    """One parameter. change : of the curve at the end for 1 % more of the parameter, as a share of its range. width, left : of the bar, as
    shares of the drawing."""

    parameter: str
    change: float
    width: float
    left: float


@dataclass(frozen=True)
class Tornado:
    """The bars of one curve, the longest first."""

    name: str
    bars: tuple[Bar, ...]


def tornados(result: Result) -> list[Tornado]:
    """Of the first joint coordinates and sensors, or of the bodies' places; none where a result has no sensitivities."""
    parameters = json.loads(str(result.attributes.get("sensitivities", "{}")))
    if not parameters or not len(result.time):
        return []
    return [_tornado(result, name, parameters) for name in _names(result)[:OUTPUTS]]


def headline(result: Result) -> str:
    """How far to trust the slopes."""
    return str(result.attributes.get("sensitivities_headline", ""))


def _names(result: Result) -> list[str]:
    sensors = [name for name in result.variables if name.startswith("sensor.") and result.array(name).ndim == 1]
    chosen = [*result.coordinates.get("joint_coordinate_name", ()), *sensors]
    return chosen or [f"{body}.position.{axis}" for body in result.coordinates.get("body", ()) for axis in "xyz"]


def _tornado(result: Result, name: str, parameters: dict[str, dict[str, float]]) -> Tornado:
    values = result.array(name)
    extent = float(np.ptp(values)) or float(np.max(np.abs(values))) or 1.0
    changes = {
        path: CHANGE * (facts["value"] or 1.0) * float(result.array(f"d({name})/d({path})")[-1]) / extent
        for path, facts in parameters.items()
    }
    largest = max(map(abs, changes.values())) or 1.0
    ordered = sorted(changes, key=lambda path: -abs(changes[path]))[:PARAMETERS]
    shares = {path: 0.5 * changes[path] / largest for path in ordered}
    bars = [Bar(path, changes[path], abs(shares[path]), 0.5 + min(0.0, shares[path])) for path in ordered]
    return Tornado(name, tuple(bars))
