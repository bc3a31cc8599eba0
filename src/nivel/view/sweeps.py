"""Beams and whatever else is one solid drawn through the frames of a chain of bodies."""

from __future__ import annotations

from typing import Any

from nivel.looks.colours import colour_of
from nivel.view.records import Sweep
from nivel.view.triples import triple


def sweeps(scene: dict[str, Any], places: dict[str, int]) -> list[Sweep]:
    """Those of the scene (`system.scene`)."""
    return [_sweep(each, places) for each in scene.get("sweeps", [])]


def _sweep(sweep: dict[str, Any], places: dict[str, int]) -> Sweep:
    bodies = [places[name] for name in sweep["bodies"]]
    count = len(bodies)
    return Sweep(
        name=sweep["name"],
        colour=colour_of(bodies[0]),
        bodies=bodies,
        points=[triple(point) for point in sweep.get("points") or [(0, 0, 0)] * count],
        axes=[triple(axis) for axis in sweep.get("axes") or [(1, 0, 0)] * count],
        across=[triple(axis) for axis in sweep.get("across") or [(0, 1, 0)] * count],
        section=[(float(y), float(z)) for y, z in sweep["section"]],
        hollow=[(float(y), float(z)) for y, z in sweep.get("hollow") or []],
        smooth=bool(sweep.get("smooth", True)),
    )
