"""Colours of bodies."""

from __future__ import annotations

from typing import Final

COLOURS: Final = ("#5b86b4", "#cf7f4f", "#6fa17a", "#9274b0", "#c6a548", "#469c9f", "#bb6a86", "#7d8998")


def colour_of(number: int) -> str:
    """Colour of the body with this number, as `#rrggbb`."""
    return COLOURS[number % len(COLOURS)]
