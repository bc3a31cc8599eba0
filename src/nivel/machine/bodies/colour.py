"""Colours of solids, in words."""

from __future__ import annotations

import re
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, WithJsonSchema

from nivel.machine.units.quantity import fault, shown

NAMED: Final = {
    "yellow": "#e3b02b",
    "orange": "#d9772f",
    "red": "#b8473c",
    "blue": "#3f6ea6",
    "green": "#5d8f62",
    "white": "#e6e9ec",
    "silver": "#b7bec6",
    "grey": "#858e98",
    "dark": "#3d444c",
    "brown": "#8a6a4c",
}
_DIGITS: Final = re.compile(r"#[0-9a-fA-F]{6}")


def _colour(value: Any) -> str:
    if isinstance(value, str) and (value in NAMED or _DIGITS.fullmatch(value)):
        return value.lower()
    raise fault(f"a colour was expected, one of {', '.join(NAMED)} or a text such as '#e3b02b'; got {shown(value)}")


Colour = Annotated[str, BeforeValidator(_colour), WithJsonSchema({"type": "string"})]


def digits_of(colour: str) -> str:
    """The colour as `#rrggbb`."""
    return NAMED.get(colour, colour)
