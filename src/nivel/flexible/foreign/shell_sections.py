"""Shell elements and their sections, as a deck gives them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

SHELLS: Final = {"S3": 3, "S4": 4, "S4R": 4, "S6": 6, "S8": 8, "S8R": 8}  # types of shells, with their number of nodes


class Shell(NamedTuple):
    """A shell element: its type, number, nodes, and its line in the file."""

    kind: str
    number: int
    nodes: tuple[int, ...]
    line: int


class ShellSection(NamedTuple):
    """Thickness of the shells of a set; offset of their nodes above their middle, in thicknesses.

    problem : why it cannot be followed, or empty. line : of the keyword.
    """

    elements: str
    thickness: float
    offset: float
    problem: str
    line: int

    def members(self, sets: Mapping[str, list[int]]) -> list[int]:
        """Numbers of the elements of the set."""
        return sets.get(self.elements, [])


def section(line: int, options: Mapping[str, str], thickness: str) -> ShellSection:
    """The section of a *SHELL SECTION with these options, in capitals, and the thickness as it is written."""
    elements, problem, height, offset = options.get("ELSET", "").upper(), "", 0.0, 0.0
    for key, what in (("NODAL THICKNESS", "thickness by nodes"), ("COMPOSITE", "layers")):
        if key in options:
            problem = f"*SHELL SECTION with {key}: {what} cannot be followed; give each set of elements one thickness"
    try:
        height, offset = float(thickness), float(options.get("OFFSET", "0"))
    except ValueError:
        given = f"thickness `{thickness}`, OFFSET `{options.get('OFFSET', '0')}`"
        problem = problem or f"*SHELL SECTION needs a number for the thickness and for OFFSET, got {given}"
    return ShellSection(elements, height, offset, problem, line)
