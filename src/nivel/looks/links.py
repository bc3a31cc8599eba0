"""Automatic shapes of bodies, links from the centre of mass to where joints and forces hold them, and the colours of bodies."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.looks.solids import reach_of, shapes_of

Array = NDArray[np.float64]


def held_points(scene: dict[str, Any], body: dict[str, Any]) -> Array:
    """(n, 3) [m] points in the body's frame where joints and forces hold it."""
    points = [*body.get("points", []), *attached(scene, body["name"])]
    return np.reshape(np.asarray(points, dtype=float), (-1, 3))


def attached(scene: dict[str, Any], body: str) -> list[list[float]]:
    """Points of a body where forces hold it."""
    return [
        point
        for force in scene.get("forces", [])
        if force["type"] != "contact"
        for name, point in zip(force["bodies"], force["points"], strict=True)
        if name == body
    ]


def link_ends(body: dict[str, Any], held: Array) -> Array:
    """(m, 3) [m] those of the points `held` (n, 3) to which links lead: all without a shape, else those that lie outside of it."""
    return held[_outside(reach_of(body), held)] if shapes_of(body) else held


def _outside(extent: Array, points: Array) -> NDArray[np.bool_]:
    """Which points (n, 3) of the body frame lie outside the box around others."""
    slack = 1e-3 * np.ptp(extent, axis=0).max()
    low, high = extent.min(axis=0) - slack, extent.max(axis=0) + slack
    return np.any((points < low) | (points > high), axis=1)


COLOURS: Final = ("#5b86b4", "#cf7f4f", "#6fa17a", "#9274b0", "#c6a548", "#469c9f", "#bb6a86", "#7d8998")


def colour_of(number: int) -> str:
    """Colour of the body with this number, as `#rrggbb`."""
    return COLOURS[number % len(COLOURS)]


def colour_of_body(body: dict[str, Any], number: int) -> str:
    """Colour of a body of the scene, for what has none of its own: that of its first shape with one, else that of its number."""
    return next((shape["colour"] for shape in shapes_of(body) if "colour" in shape), colour_of(number))
