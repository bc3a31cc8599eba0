"""Nodes, and where there are any elements and node sets, from files of other programs."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.foreign.matrix import FormatError, text_lines
from nivel.flexible.foreign.nastran import read_grids, table
from nivel.flexible.foreign.shell_sections import SHELLS, Shell, ShellSection, section

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

SOLIDS: Final = {
    "C3D4": 4,
    "C3D4T": 4,
    "C3D6": 6,
    "C3D8": 8,
    "C3D8I": 8,
    "C3D8R": 8,
    "C3D10": 10,
    "C3D10M": 10,
    "C3D10MH": 10,
    "C3D10T": 10,
    "C3D15": 15,
    "C3D20": 20,
    "C3D20R": 20,
}  # types of elements whose stress can be recovered, with their number of nodes


class RigidGroup(NamedTuple):
    """Nodes that CalculiX moves as a rigid body, by *RIGID BODY or *COUPLING with *KINEMATIC.

    reference : node whose rows are its translations. rotation : node whose rows are its rotations; None: CalculiX makes one.
    members : name of the set of its nodes; empty where they are those of a surface.
    """

    reference: int
    rotation: int | None
    keyword: str
    line: int
    members: str = ""


@dataclass
class Mesh:
    """Numbers (n,) and places (n, 3) of nodes; node sets by name; `elements` numbers of nodes of solids, by type.

    only_solids : whether there are no other elements. types : line of the first element of each type. young,
    poisson, density : of the only material, or None. element_sets : numbers of elements by the name of their set in capitals.
    of_nodes : first keyword that gives normals or thicknesses by nodes, with its line, or None.
    """

    numbers: Whole
    places: Array
    sets: dict[str, list[int]] = field(default_factory=dict)
    elements: dict[str, list[list[int]]] = field(default_factory=dict)
    only_solids: bool = True
    materials: int = 0
    young: float | None = None
    poisson: float | None = None
    density: float | None = None
    types: dict[str, int] = field(default_factory=dict)
    rigid: list[RigidGroup] = field(default_factory=list)
    shells: list[Shell] = field(default_factory=list)
    sections: list[ShellSection] = field(default_factory=list)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    of_nodes: tuple[str, int] | None = None


def read_mesh(path: Path) -> Mesh:
    """The mesh in an Abaqus or CalculiX input file (.inp), Nastran bulk data (.bdf, .dat, .nas, .pch) or a table of nodes.

    A table (.csv) has the columns id, x, y, z. Raises FormatError.
    """
    suffix = path.suffix.lower()
    if suffix == ".inp":
        mesh = _Input(path).mesh()
    elif suffix in (".bdf", ".dat", ".nas", ".pch", ".blk"):
        mesh = Mesh(*table(*read_grids(path)))
    else:
        mesh = Mesh(*_table(path))
    if not len(mesh.numbers):
        raise FormatError("there are no nodes in this file")
    unique, counts = np.unique(mesh.numbers, return_counts=True)
    if counts.max() > 1:
        raise FormatError(f"node {unique[np.argmax(counts)]} stands {counts.max()} times in this file")
    order = np.argsort(mesh.numbers)
    mesh.numbers, mesh.places = mesh.numbers[order], mesh.places[order]
    return mesh


def _table(path: Path) -> tuple[Whole, Array]:
    numbers, places = [], []
    with path.open(encoding="utf-8", newline="") as file:
        for line, row in enumerate(csv.DictReader(file, skipinitialspace=True), start=2):
            try:
                numbers.append(int(row["id"]))
                places.append([float(row[axis]) for axis in "xyz"])
            except (KeyError, TypeError, ValueError):
                raise FormatError("the columns id, x, y, z were expected", line) from None
    return table(numbers, places)


class _Input:
    """Reads the keywords *NODE, *ELEMENT, *NSET, *ELSET, *ELASTIC, *DENSITY, *SHELL SECTION, *RIGID BODY and *COUPLING; others are
    passed over."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.numbers: list[int] = []
        self.places: list[list[float]] = []
        self.sets: dict[str, list[int]] = {}
        self.elements: dict[str, list[list[int]]] = {}
        self.others = False
        self.materials = self.instances = 0
        self.values: dict[str, list[float]] = {}
        self.pending: list[int] = []
        self.types: dict[str, int] = {}
        self.rigid: list[RigidGroup] = []
        self.coupling = 0
        self.shells: list[Shell] = []
        self.section: int | None = None
        self.of_nodes: tuple[str, int] | None = None
        self.sections: list[ShellSection] = []
        self.element_sets: dict[str, list[int]] = {}

    def mesh(self) -> Mesh:
        keyword, options = "", {}
        for number, text in text_lines(self.path):
            line = text.strip()
            if not line or line.startswith("**"):
                continue
            if line.startswith("*"):
                keyword, options = _keyword(line)
                self.pending = []
                self._begin(keyword, options, number)
                continue
            if keyword == "INSTANCE":
                raise FormatError(f"*INSTANCE moves its nodes by `{line[:60]}`; write a flat input file", number)
            try:
                self._data(keyword, options, [part.strip() for part in line.split(",")], number)
            except ValueError:
                raise FormatError(f"this line of *{keyword} cannot be read: `{line[:60]}`", number) from None
        young, poisson = ([*self.values.get("ELASTIC", []), None, None])[:2]
        density = ([*self.values.get("DENSITY", []), None])[0]
        return Mesh(
            *table(self.numbers, self.places),
            self.sets,
            self.elements,
            not self.others,
            self.materials,
            young,
            poisson,
            density,
            self.types,
            self.rigid,
            self.shells,
            self.sections,
            self.element_sets,
            self.of_nodes,
        )

    def _begin(self, keyword: str, options: dict[str, str], line: int) -> None:
        if keyword == "INCLUDE":
            raise FormatError("*INCLUDE is not followed; write the mesh into one file", line)
        if keyword == "NODE" and options.get("SYSTEM"):
            raise FormatError("*NODE with SYSTEM gives nodes in axes of their own; write them in global ones", line)
        if keyword in ("NORMAL", "NODAL THICKNESS"):
            self.of_nodes = self.of_nodes or (keyword, line)
        self.instances += keyword == "INSTANCE"
        if self.instances > 1:
            raise FormatError(
                "this is a second *INSTANCE, with numbers of nodes of its own; write a flat input file", line
            )
        self.materials += keyword == "MATERIAL"
        if keyword == "ELEMENT":
            self.types.setdefault(options.get("TYPE", "").upper(), line)
            self.others |= options.get("TYPE", "").upper() not in SOLIDS
        if keyword == "SHELL SECTION":
            self.section = line
        self._bind(keyword, options, line)

    def _bind(self, keyword: str, options: dict[str, str], line: int) -> None:
        """Groups of nodes that move as rigid bodies."""
        match keyword:
            case "RIGID BODY":
                rotation = options.get("ROT NODE")
                self.rigid.append(
                    RigidGroup(
                        _number(options, "REF NODE", keyword, line),
                        None if rotation is None else _number(options, "ROT NODE", keyword, line),
                        keyword,
                        line,
                        options.get("NSET", ""),
                    )
                )
            case "COUPLING":
                self.coupling = _number(options, "REF NODE", keyword, line)
            case "KINEMATIC" if self.coupling:
                self.rigid.append(RigidGroup(self.coupling, None, keyword, line))

    def _data(self, keyword: str, options: dict[str, str], parts: list[str], line: int) -> None:
        match keyword:
            case "NODE":
                self.numbers.append(int(parts[0]))
                self.places.append([float(part) if part else 0.0 for part in [*parts[1:4], "", "", ""][:3]])
                if "NSET" in options:
                    self.sets.setdefault(options["NSET"], []).append(int(parts[0]))
            case "ELEMENT" if options.get("TYPE", "").upper() in SOLIDS:
                self._element(options, parts)
            case "ELEMENT" if options.get("TYPE", "").upper() in SHELLS:
                self._shell(options, parts, line)
            case "NSET":
                _set(self.sets, options.get("NSET", ""), options, [part for part in parts if part])
            case "ELSET":
                _set(
                    self.element_sets,
                    options.get("ELSET", "").upper(),
                    options,
                    [part.upper() for part in parts if part],
                )
            case "SHELL SECTION" if self.section is not None:
                self.sections.append(section(self.section, options, parts[0]))
                self.section = None
            case "ELASTIC" | "DENSITY" if keyword not in self.values:
                self.values[keyword] = [float(part) for part in parts if part]

    def _element(self, options: dict[str, str], parts: list[str]) -> None:
        kind = options["TYPE"].upper()
        if not self.pending:
            self._in_set(options, int(parts[0]))
        self.pending += [int(part) for part in parts if part]
        if len(self.pending) > SOLIDS[kind]:
            self.elements.setdefault(kind, []).append(self.pending[1 : SOLIDS[kind] + 1])
            self.pending = []

    def _shell(self, options: dict[str, str], parts: list[str], line: int) -> None:
        kind = options["TYPE"].upper()
        self.pending += [int(part) for part in parts if part]
        if len(self.pending) > SHELLS[kind]:
            number, *nodes = self.pending[: SHELLS[kind] + 1]
            self.shells.append(Shell(kind, number, tuple(nodes), line))
            self._in_set(options, number)
            self.pending = []

    def _in_set(self, options: dict[str, str], number: int) -> None:
        if "ELSET" in options:
            self.element_sets.setdefault(options["ELSET"].upper(), []).append(number)


def _set(sets: dict[str, list[int]], name: str, options: dict[str, str], parts: list[str]) -> None:
    """Add the members on a line to the set."""
    members = sets.setdefault(name, [])
    if "GENERATE" in options:
        first, last, step = [int(part) for part in [*parts, "1"][:3]]
        members += range(first, last + 1, step)
        return
    for part in parts:
        members += [int(part)] if part.isdecimal() else sets.get(part, [])


def _number(options: dict[str, str], key: str, keyword: str, line: int) -> int:
    """The number of a node. Raises FormatError."""
    if not (given := options.get(key, "")).isdecimal():
        raise FormatError(f"*{keyword} needs `{key}=` with the number of a node, got `{given}`", line)
    return int(given)


def _keyword(line: str) -> tuple[str, dict[str, str]]:
    parts = [part.strip() for part in line[1:].split(",")]
    options = {}
    for part in parts[1:]:
        name, _, value = part.partition("=")
        options[name.strip().upper()] = value.strip()
    return parts[0].upper(), options
