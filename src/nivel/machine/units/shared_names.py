"""Names that are those of a parameter and of a unit or constant: what stands for which, in words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Final

from nivel.machine.units.arithmetic import FREE_CONSTANTS
from nivel.machine.units.dimension import symbol
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import CONSTANTS, ExpressionError, Name, Number, Parameters, leaves
from nivel.machine.units.unit import UNITS

LITRE: Final = ("l", "L")  # what a parameter may take the name of, also behind a number
# units with the letters of quantities
_WORDS: Final = {
    "m": "the metre",
    "g": "the gram",
    "t": "the tonne",
    "s": "the second",
    "h": "the hour",
    "N": "the newton",
    "J": "the joule",
    "W": "the watt",
}


def name_notes(parameters: Mapping[str, object]) -> tuple[str, ...]:
    """What a reader has to know of `parameters` that have the name of a unit or of a constant, in sentences without a full stop."""
    numbers = {name: value for name, value in parameters.items() if isinstance(value, Number)}
    units = {name: value for name, value in numbers.items() if name in UNITS}
    notes = []
    if units:
        which = _listed(f"`{name}` ({_shown(value)})" for name, value in units.items())
        others, first = _listed(map(_other_meaning, units)), next(iter(units))
        are, they = (
            ("is the parameter", "it is the unit") if len(units) == 1 else ("are the parameters", "they are the units")
        )
        notes.append(f"in expressions {which} {are}, not {others}; directly after a number {they}: `2 {first}`")
    notes += [
        f"in expressions `{name}` ({_shown(value)}) is the parameter, not {_other_meaning(name)}"
        for name, value in numbers.items()
        if name in FREE_CONSTANTS
    ]
    return tuple(notes)


def shared_names_hint(text: str, parameters: Parameters) -> str:
    """What the shared names in an expression stand for there, as the end of a message on it; empty where there are none."""
    try:
        found = [leaf for leaf in leaves(parse(text)) if isinstance(leaf, Name) and leaf.text in parameters]
    except ExpressionError:
        return ""
    hints = []
    for name in dict.fromkeys(found):
        if name.place == "free" and (name.text in UNITS or name.text in FREE_CONSTANTS):
            hints.append(f"`{name.text}` is the parameter here, not {_other_meaning(name.text)}")
        elif name.text in LITRE and name.place != "free":
            others = [f"`{each}`" for each in (*LITRE, "dm^3") if each not in parameters]
            hints.append(f"`{name.text}` is your parameter; litre is {' or '.join(others)}")
        elif re.search(rf"\*\s*{name.text}\b", text) and name.text in UNITS:
            hints.append(
                f"`{name.text}` is {_other_meaning(name.text)} here; the parameter is written `(2 N)*{name.text}`"
            )
    return f" ({'; '.join(hints)})" if hints else ""


def _other_meaning(name: str) -> str:
    return f"the constant {CONSTANTS[name]:.5g}" if name in CONSTANTS else _WORDS.get(name, f"the unit `{name}`")


def _listed(texts: Iterable[str]) -> str:
    *first, last = texts
    return f"{', '.join(first)} and {last}" if first else last


def _shown(number: Number) -> str:
    return f"{number.value:g}" if number.dimension is None else f"{number.value:g} {symbol(number.dimension)}"
