"""Elements and sections of a deck: shells, and the thickness, material and orientation of the elements of a set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

from nivel.flexible.foreign.deck import Card, Line
from nivel.flexible.foreign.matrix import fortran_number

SHELLS: Final = {"S3": 3, "S4": 4, "S4R": 4, "S6": 6, "S8": 8, "S8R": 8}  # types of shells, with their number of nodes


class Shell(NamedTuple):
    """A shell element: its type, number, nodes, and its line in the file."""

    kind: str
    number: int
    nodes: tuple[int, ...]
    line: Line


class Section(NamedTuple):
    """Material and orientation of the elements of a set; of shells thickness, and offset of their nodes above their middle, in thicknesses.

    Names are in capitals; an orientation that is not given is empty. thickness : None of solids.
    problem : why it cannot be followed, or empty. line : of the keyword.
    """

    elements: str
    material: str
    orientation: str
    line: Line
    thickness: float | None = None
    offset: float = 0.0
    problem: str = ""

    def members(self, sets: Mapping[str, list[int]]) -> list[int]:
        """Numbers of the elements of the set."""
        return sets.get(self.elements, [])


def solid_section(card: Card) -> Section:
    """The section of a *SOLID SECTION."""
    problem = "*SOLID SECTION with COMPOSITE: layers cannot be followed" if "COMPOSITE" in card.options else ""
    return Section(card.name("ELSET"), card.name("MATERIAL"), card.name("ORIENTATION"), card.line, problem=problem)


def shell_section(card: Card, thickness: str) -> Section:
    """The section of a *SHELL SECTION with the thickness as it is written."""
    problem, height, offset = "", 0.0, 0.0
    for key, name, what in (
        ("NODALTHICKNESS", "NODAL THICKNESS", "thickness by nodes"),
        ("COMPOSITE", "COMPOSITE", "layers"),
    ):
        if key in card.options:
            problem = f"*SHELL SECTION with {name}: {what} cannot be followed; give each set of elements one thickness"
    try:
        height, offset = fortran_number(thickness), fortran_number(card.options.get("OFFSET", "0"))
    except ValueError:
        given = f"thickness `{thickness}`, OFFSET `{card.options.get('OFFSET', '0')}`"
        problem = problem or f"*SHELL SECTION needs a number for the thickness and for OFFSET, got {given}"
    names = card.name("ELSET"), card.name("MATERIAL"), card.name("ORIENTATION")
    return Section(*names, card.line, height, offset, problem)
