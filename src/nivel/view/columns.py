"""Variables of a result that can be plotted, to which element each belongs, and which of them a package carries."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.results.result import Result
from nivel.view.package import Block
from nivel.view.records import Column

MOST: Final = 20_000  # variables that are listed
PREFIXES: Final = (
    "force.",
    "driver.",
    "coupling.",
    "hydraulics.",
)  # of variables that belong to what is named after them
# what is carried first where not all has room; of equal ones those that stand first in the result
FIRST: Final = (
    "joint_coordinate",
    "kinetic_energy",
    "potential_energy",
    "energy_error",
    "position",
    "joint_force",
    "joint_rate",
)


def column_names(result: Result) -> list[str]:
    """Names of all variables that are one number a frame."""
    names = []
    for name in result.names:
        found = result.selection(name)
        dims = result.variables[found.variable].dims[1:]
        if len(found.where[1:]) == len(dims) and all(isinstance(place, int) for place in found.where[1:]):
            names.append(name)
        if len(names) == MOST:
            break
    return names


def columns(result: Result, frames: slice, block: Block, budget: int) -> list[Column]:
    """All columns; those that have room within `budget` bytes are put into the block. frames : those of the package."""
    names = column_names(result)
    count = len(range(len(result.time))[frames])
    room = budget // max(4 * count, 1)
    variables = {name: result.selection(name).variable for name in names}
    rank = {variable: k for k, variable in enumerate(FIRST)}
    ordered = sorted(names, key=lambda name: rank.get(variables[name], len(FIRST)))
    carried = set(ordered[:room])
    arrays: dict[str, NDArray[np.float64]] = {}
    elements = _elements(result)
    out = []
    for name in names:
        packed = None
        if name in carried:
            variable = variables[name]
            if variable not in arrays:
                arrays = {variable: result.array(variable, frames)}  # one at a time: names come in their order
            packed = block.add(arrays[variable][(slice(None), *result.selection(name).where[1:])])
        out.append(Column(name, result.units(name), _owner(name, elements), packed))
    return out


def _elements(result: Result) -> set[str]:
    """Names of bodies, joints, and what else owns variables."""
    scene = result.scene
    found = {each["name"] for section in ("bodies", "joints", "forces") for each in scene.get(section, [])}
    return found | {name.split(".")[1] for name in result.variables if name.startswith(PREFIXES)}


def _owner(name: str, elements: set[str]) -> str:
    """The element whose name a variable begins with, after a word for its kind; empty for the whole machine.

    Nodes of beams have names of two words.
    """
    parts = name.split(".")
    rest = parts[1:] if f"{parts[0]}." in PREFIXES and len(parts) > 2 else parts
    candidates = (".".join(rest[:words]) for words in (2, 1) if words < len(rest))
    return next((each for each in candidates if each in elements), "")
