"""Reading of meshes of other programs: input files of CalculiX and Abaqus, bulk data of Nastran, tables of nodes."""

import csv
from pathlib import Path
from typing import Final

import numpy as np

from nivel.flexible.foreign.deck import NO_STRESS, Card, Line, entries
from nivel.flexible.foreign.elasticity import Law, orientation
from nivel.flexible.foreign.matrix import FormatError, fortran_number
from nivel.flexible.foreign.mesh import (
    SHELLS,
    SOLIDS,
    SPRINGS,
    Array,
    Mesh,
    RigidGroup,
    Shell,
    Whole,
    shell_section,
    solid_section,
)
from nivel.flexible.foreign.nastran import read_grids, table

# cards of what stores energy
STORING: Final = ("SPRING", "GAP", "CONTACT PAIR", "CONTACT", "CONNECTOR SECTION", "FASTENER")
AT_REST: Final = ("STRESS", "PLASTICSTRAIN", "SOLUTION")  # initial conditions that are stress or make one


def read_mesh(path: Path) -> Mesh:
    """The mesh in an Abaqus or CalculiX input file (.inp), Nastran bulk data (.bdf, .dat, .nas, .pch) or a table of nodes.

    A table (.csv) has the columns id, x, y, z. Raises FormatError.
    """
    suffix = path.suffix.lower()
    if suffix == ".inp":
        mesh = _Input().mesh(path)
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
                places.append([fortran_number(row[axis]) for axis in "xyz"])
            except (KeyError, TypeError, ValueError, AttributeError):
                raise FormatError("the columns id, x, y, z were expected", line) from None
    return table(numbers, places)


class _Input:
    """Reads the cards of an input file that are used; `cards` says what becomes of the others."""

    def __init__(self) -> None:
        self.out = Mesh(np.zeros(0, dtype=np.int64), np.zeros((0, 3)))
        self.places: dict[int, list[float]] = {}
        self.moved: list[int] = []
        self.pending: list[int] = []
        self.lines: list[list[str]] = []
        self.temperatures: list[tuple[str, float]] = []
        self.law: Law | None = None
        self.instances = self.coupling = self.steps = 0
        self.assembled = False

    def mesh(self, path: Path) -> Mesh:
        """Raises FormatError."""
        last: Card | None = None
        for card, line, parts in entries(path):
            try:
                if parts is None:
                    self._end(last)
                    last = card
                    self._begin(card)
                else:
                    self._data(card, parts, line)
            except FormatError:
                raise
            except (ValueError, IndexError):
                what = "" if parts is None else f": `{', '.join(parts)[:60]}`"
                raise FormatError(f"this line of *{card.keyword} cannot be read{what}", line) from None
        self._end(last)
        mesh = self.out
        mesh.numbers, mesh.places = table(list(self.places), list(self.places.values()))
        if self.temperatures:
            mesh.temperatures = {}
            for target, value in self.temperatures:
                nodes = [int(target)] if target.isdecimal() else mesh.sets.get(target, [])
                mesh.temperatures |= dict.fromkeys(nodes, value)
        if self.moved:
            mesh.notes += (
                f"node {self.moved[0]} stands at several places in the deck: the last one holds, as in CalculiX",
            )
        return mesh

    def _begin(self, card: Card) -> None:
        self.pending, self.lines, line = [], [], card.line
        self.assembled |= card.keyword in ("PART", "INSTANCE", "ASSEMBLY")
        self.out.springs |= card.keyword in STORING or card.name("TYPE") in SPRINGS
        if "INPUT" in card.options:
            raise FormatError(
                f"*{card.keyword} with INPUT= is not followed; write `*INCLUDE, INPUT=…` below the keyword", line
            )
        match card.keyword:
            case "NODE" if "SYSTEM" in card.options:
                raise FormatError("*NODE with SYSTEM gives nodes in axes of their own; write them in global ones", line)
            case "NSET" if "ELSET" in card.options:
                raise FormatError("*NSET with ELSET= is not followed; write the numbers of the nodes", line)
            case "NORMAL" | "NODAL THICKNESS":
                self.out.of_nodes = self.out.of_nodes or (card.keyword, line)
            case "INSTANCE":
                self.instances += 1
                if self.instances > 1:
                    what = "this is a second *INSTANCE, with numbers of nodes of its own; write a flat input file"
                    raise FormatError(what, line)
            case "ELEMENT":
                if not card.name("TYPE"):
                    raise FormatError("*ELEMENT needs `TYPE=`, such as `TYPE=C3D10`", line)
                self.out.types.setdefault(card.name("TYPE"), line)
            case "STEP":
                self.steps += 1
                if self.steps > 1 and "PERTURBATION" in card.options:
                    self.out.notes += (
                        "stress is that of the motion alone: loads of steps before *STEP, PERTURBATION add theirs",
                    )
            case "SOLID SECTION":
                self.out.sections.append(solid_section(card))
            case "RIGID BODY" | "COUPLING" | "KINEMATIC":
                self._bind(card)
            case _:
                self._begin_material(card)

    def _begin_material(self, card: Card) -> None:
        """Materials, and what makes stress unknown."""
        match card.keyword:
            case "MATERIAL":
                self.law = self.out.laws[card.name("NAME")] = Law(card.name("NAME"), card.line)
            case "ELASTIC":
                if self.law is None:
                    raise FormatError("*ELASTIC is of no material; write `*MATERIAL, NAME=…` before it", card.line)
                self.law.begin(card)
            case "INITIAL CONDITIONS":
                kind = "".join(card.name("TYPE").split())
                odd = [key for key in card.options if key != "TYPE"]
                if kind in AT_REST or (kind == "TEMPERATURE" and odd):
                    what = f"with {odd[0]} cannot be followed" if odd else "is a stress at rest, or makes one"
                    self.out.stressless.append(f"*INITIAL CONDITIONS, TYPE={kind} (line {card.line}) {what}")
            case keyword if keyword in NO_STRESS:
                problem = f"*{keyword} (line {card.line}) {NO_STRESS[keyword]}"
                if self.law is not None and NO_STRESS[keyword].startswith("is no linear"):
                    self.law.problem = problem
                else:
                    self.out.stressless.append(problem)

    def _bind(self, card: Card) -> None:
        match card.keyword:
            case "RIGID BODY":
                rotation = None if "ROTNODE" not in card.options else _number(card, "ROT NODE")
                group = RigidGroup(_number(card, "REF NODE"), rotation, card.keyword, card.line, card.name("NSET"))
                self.out.rigid.append(group)
            case "COUPLING":
                self.coupling = _number(card, "REF NODE")
            case "KINEMATIC" if self.coupling:
                self.out.rigid.append(RigidGroup(self.coupling, None, card.keyword, card.line))

    def _data(self, card: Card, parts: list[str], line: Line) -> None:
        out = self.out
        match card.keyword:
            case "INSTANCE":
                raise FormatError(
                    f"*INSTANCE moves its nodes by `{', '.join(parts)[:60]}`; write a flat input file", line
                )
            case "NODE":
                self._node(card, parts, line)
            case "ELEMENT" if card.name("TYPE") in SOLIDS:
                self._element(card, parts)
            case "ELEMENT" if card.name("TYPE") in SHELLS:
                self._shell(card, parts, line)
            case "NSET":
                _set(out.sets, card.name("NSET"), card, [part.upper() for part in parts if part])
            case "ELSET":
                _set(out.element_sets, card.name("ELSET"), card, [part.upper() for part in parts if part])
            case "ELASTIC" if self.law is not None:
                self.law.read(parts)
            case "INITIAL CONDITIONS" if card.name("TYPE") == "TEMPERATURE":
                self.temperatures.append((parts[0].upper(), fortran_number(parts[1])))
                if any(fortran_number(part) for part in parts[2:] if part):
                    out.stressless.append(
                        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE (line {line}) with gradients cannot be followed"
                    )
            case "ORIENTATION" | "SHELL SECTION":
                self.lines.append(parts)

    def _end(self, card: Card | None) -> None:
        """All lines of a card have been read."""
        match None if card is None else card.keyword:
            case "ORIENTATION":
                assert card is not None
                self.out.orientations[card.name("NAME")] = orientation(card, self.lines)
            case "SHELL SECTION":
                assert card is not None
                self.out.sections.append(shell_section(card, self.lines[0][0] if self.lines else ""))
            case "ELEMENT" if self.pending:
                assert card is not None
                raise FormatError(f"element {self.pending[0]} of type {card.name('TYPE')} has too few nodes", card.line)

    def _node(self, card: Card, parts: list[str], line: Line) -> None:
        number = int(parts[0])
        place = [fortran_number(part) if part else 0.0 for part in [*parts[1:4], "", "", ""][:3]]
        if self.places.setdefault(number, place) != place:
            if self.assembled:
                raise FormatError(f"node {number} stands in a part and in the assembly; write a flat input file", line)
            self.moved.append(number)
            self.places[number] = place
        if "NSET" in card.options:
            self.out.sets.setdefault(card.name("NSET"), []).append(number)

    def _element(self, card: Card, parts: list[str]) -> None:
        kind = card.name("TYPE")
        if not self.pending:
            self._in_set(card, int(parts[0]))
        self.pending += [int(part) for part in parts if part]
        if len(self.pending) > SOLIDS[kind]:
            self.out.element_numbers.setdefault(kind, []).append(self.pending[0])
            self.out.elements.setdefault(kind, []).append(self.pending[1 : SOLIDS[kind] + 1])
            self.pending = []

    def _shell(self, card: Card, parts: list[str], line: Line) -> None:
        kind = card.name("TYPE")
        self.pending += [int(part) for part in parts if part]
        if len(self.pending) > SHELLS[kind]:
            number, *nodes = self.pending[: SHELLS[kind] + 1]
            self.out.shells.append(Shell(kind, number, tuple(nodes), line))
            self._in_set(card, number)
            self.pending = []

    def _in_set(self, card: Card, number: int) -> None:
        if "ELSET" in card.options:
            self.out.element_sets.setdefault(card.name("ELSET"), []).append(number)


def _set(sets: dict[str, list[int]], name: str, card: Card, parts: list[str]) -> None:
    members = sets.setdefault(name, [])
    if "GENERATE" in card.options:
        first, last, step = [int(part) for part in [*parts, "1"][:3]]
        members += range(first, last + 1, step)
        return
    for part in parts:
        members += [int(part)] if part.isdecimal() else sets.get(part, [])


def _number(card: Card, key: str) -> int:
    """The number of a node. Raises FormatError."""
    if not (given := card.options.get(key.replace(" ", ""), "")).isdecimal():
        raise FormatError(f"*{card.keyword} needs `{key}=` with the number of a node, got `{given}`", card.line)
    return int(given)
