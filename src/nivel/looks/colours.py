"""Colours of bodies."""

from __future__ import annotations

from typing import Any, Final

from nivel.looks.solids import shapes_of

COLOURS: Final = ("#5b86b4", "#cf7f4f", "#6fa17a", "#9274b0", "#c6a548", "#469c9f", "#bb6a86", "#7d8998")


def colour_of(number: int) -> str:
    """Colour of the body with this number, as `#rrggbb`."""
    return COLOURS[number % len(COLOURS)]


def colour_of_body(body: dict[str, Any], number: int) -> str:
    """Colour of a body of the scene, for what has none of its own: that of its first shape with one, else that of its number."""
    return next((shape["colour"] for shape in shapes_of(body) if "colour" in shape), colour_of(number))
