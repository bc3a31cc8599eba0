"""Shells of CalculiX as the solids that it computes with: one element through the thickness, along the normals at the nodes.

A node of shells becomes two or three nodes along the mean of the normals of the elements around it. Elements whose normals differ by
more than 20°, or that differ in thickness or offset, get nodes of their own at a shared node; all these move with the shared node as one
solid that may stretch: a knot, u = u_N + θ × r + e r, with r from the shared node N, its turn θ and one stretch e.
Source: Dhondt, CalculiX CrunchiX User's Manual 2.20, sections 6.2.14 (shells) and 6.2.33 (knots).
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Final, NamedTuple

import numpy as np

from nivel.flexible.foreign.matrix import FormatError, Label
from nivel.flexible.foreign.mesh import SHELLS, Array, Mesh, Section, Shell
from nivel.lazy import Struct, replace

SMOOTH: Final = 0.939693  # cosine of the largest angle, 20°, between normals that are averaged
FLAT: Final = 0.999962  # cosine of the angle below which normals are the same line
SAME: Final = 1e-10  # of thicknesses and offsets
TRIANGLE: Final = ((0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5))
SQUARE: Final = ((-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0))
POWERS: Final = {
    3: ((0, 0), (1, 0), (0, 1)),
    4: ((0, 0), (1, 0), (0, 1), (1, 1)),
    6: ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)),
    8: ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (2, 1), (1, 2)),
}  # of the monomials of the shape functions, by the number of nodes
SOLID_OF: Final = {"S3": "C3D6", "S4": "C3D8I", "S4R": "C3D8R", "S6": "C3D15", "S8": "C3D20", "S8R": "C3D20R"}


class Knot(NamedTuple):
    """Nodes that follow a node of shells as one solid that stretches: their numbers, those whose rows are its turn and the stretch."""

    nodes: tuple[int, ...]
    rotation: int
    stretch: int


class Expansion(Struct):
    """The mesh of solids, and what became of the nodes of shells.

    layers : by number of a node of shells, the numbers of its nodes from the bottom to the top. offsets : how far the node is above
    the middle, in thicknesses, by the same number. knots : by number of the node that they follow.
    """

    mesh: Mesh
    layers: Mapping[int, tuple[int, ...]]
    offsets: Mapping[int, float]
    knots: Mapping[int, Knot]

    @property
    def notes(self) -> tuple[str, ...]:
        """What was assumed, for the report."""
        notes = []
        if self.knots:
            joined = f"{len(self.knots)} node{'s' if len(self.knots) > 1 else ''}"
            notes.append(
                f"at {joined} shells with a kink or a step are joined by a solid that may stretch, as CalculiX does"
            )
        if "S4R" in self.mesh.types:
            notes.append(
                "shells S4R bend by hourglass control alone, and their mass is that of one point each: S4 and S8R are better"
            )
        return tuple(notes)

    def tied(self, labels: Sequence[Label]) -> set[int]:
        """Nodes of shells that *RIGID BODY or *COUPLING of the deck holds: rows of their lowest nodes through the thickness are missing.

        CalculiX holds the mean of the lowest and the highest, and eliminates the lowest.
        """
        if not self.mesh.rigid:
            return set()
        total = Counter(labels)
        return {
            node
            for node, layers in self.layers.items()
            if all(total[node, axis] == len(layers) - 1 for axis in (1, 2, 3))
        }

    def _refuse_hinges(self, tied: set[int]) -> None:
        """Raises FormatError for groups that can turn about a straight line of their nodes while the shell stays."""
        place = {node: self.mesh.places[k] for k, node in enumerate(self.mesh.numbers.tolist())}
        for group in self.mesh.rigid:
            members = self.mesh.sets.get(group.members, [])
            if group.reference not in place or not members or not tied.issuperset(members):
                continue
            x = np.array([place[node] for node in members]) - place[members[0]]
            size = np.linalg.norm(x)
            on_line = np.linalg.matrix_rank(x, 1e-9 * size) <= 1
            if (
                on_line
                and np.linalg.matrix_rank(np.vstack([x, place[group.reference] - place[members[0]]]), 1e-9 * size) > 1
            ):
                raise FormatError(
                    f"*{group.keyword} turns about the straight line of its nodes of shells, as about a hinge, while the shell stays; "
                    f"take it out of the deck, and write `interfaces: {{NAME: {{set: {group.members}}}}}` here for a clamped edge, or put "
                    "its reference node on the line",
                    group.line,
                )

    def labels(self, labels: Sequence[Label]) -> tuple[Label, ...]:
        """Rows by the nodes of the solids. CalculiX names them all by the node of the shells, from the bottom to the top.

        The stretch of a knot is direction 4 of its own number, so that it has the unit of a turn. Raises FormatError.
        """
        total, seen = Counter(labels), Counter[Label]()
        tied = self.tied(labels)
        self._refuse_hinges(tied)
        for node, layers in self.layers.items():
            for axis in (1, 2, 3):
                if node not in tied and total[node, axis] != len(layers):
                    raise FormatError(
                        f"node {node} of shells has {total[node, axis]} rows of direction {axis}, and its {len(layers)} nodes through the "
                        "thickness have one each: it is held or tied in the deck (*BOUNDARY, *EQUATION, *TIE), or the matrices are of "
                        "another deck; leave that out of the deck, and tie its nodes by `interfaces` here"
                    )
        turns = {knot.rotation: node for node, knot in self.knots.items()}
        stretches = {knot.stretch for knot in self.knots.values()}
        for number in sorted((turns.keys() | stretches) - {node for node, _ in labels}):
            raise FormatError(
                f"the matrices have no rows of node {number}, which CalculiX makes for a kink or step of shells: they are of another deck"
            )
        out = []
        for node, axis in labels:
            if node in self.layers:
                out.append((self.layers[node][seen[node, axis] + (node in tied)], axis))
                seen[node, axis] += 1
            elif node in turns:
                out.append((turns[node], axis + 3))
            else:
                out.append((node, 4) if node in stretches else (node, axis))
        return tuple(out)


class _Place(NamedTuple):
    """A shell at one of its nodes: which shell, which of its nodes, its normal there (3,), its section."""

    shell: Shell
    corner: int
    normal: Array
    section: Section


def expansion(mesh: Mesh) -> Expansion:
    """The solids in place of the shells of a mesh, with the numbers that CalculiX gives their nodes. Raises FormatError."""
    _refuse_given(mesh)
    _refuse_shared(mesh)
    next_number = int(mesh.numbers[-1]) + sum(group.rotation is None for group in mesh.rigid) + 1
    place = {int(number): k for k, number in enumerate(mesh.numbers)}
    numbers, places = [], []
    layers, offsets, knots = {}, {}, {}
    nodes_of: dict[tuple[int, int], tuple[int, int, int]] = {}  # by shell and corner: bottom, middle, top
    for node, around in sorted(_around(mesh, place).items()):
        groups = _groups(around)
        own: list[int] = []
        for group in groups:
            three = (next_number, next_number + 1, next_number + 2)
            next_number += 3
            normal = _mean(group, node)
            section = group[0].section
            heights = (section.thickness or 0.0) * (np.array([-0.5, 0.0, 0.5]) - section.offset)
            used = [k for k in range(3) if k != 1 or any(_has_middle(each) for each in group)]
            own += [three[k] for k in used]
            numbers += [three[k] for k in used]
            places += [mesh.places[place[node]] + heights[k] * normal for k in used]
            nodes_of.update({(each.shell.number, each.corner): three for each in group})
        if len(groups) == 1:
            layers[node], offsets[node] = tuple(own), groups[0][0].section.offset
            continue
        _refuse_skew(groups, node)
        knots[node] = Knot(tuple(own), next_number, next_number + 1)
        next_number += 2 + 3 * len(groups)  # CalculiX makes a node more for each of those that follow
    order = np.argsort(all_numbers := np.concatenate([mesh.numbers, np.array(numbers, dtype=np.int64)]))
    solids = replace(
        mesh,
        numbers=all_numbers[order],
        places=np.concatenate([mesh.places, np.array(places)])[order],
        elements=_solids(mesh, nodes_of),
        element_numbers=_numbers(mesh),
        temperatures=_temperatures(mesh, layers, knots),
        planes={s.number: _plane(mesh.places[[place[node] for node in s.nodes]]) for s in mesh.shells},
        types=mesh.types | {SOLID_OF[shell.kind]: shell.line for shell in mesh.shells},
        shells=[],
    )
    return Expansion(solids, layers, offsets, knots)


def _refuse_given(mesh: Mesh) -> None:
    """Raises FormatError for sections and keywords that cannot be followed."""
    for section in mesh.sections:
        if section.problem and section.thickness is not None:
            raise FormatError(section.problem, section.line)
    if mesh.of_nodes is not None:
        keyword, line = mesh.of_nodes
        raise FormatError(
            f"*{keyword} is not followed: shells are expanded along the mean normals of their elements, by the thickness of their "
            "*SHELL SECTION; remove it, also where the matrices are written",
            line,
        )


def _refuse_shared(mesh: Mesh) -> None:
    """Raises FormatError for nodes of shells that are of solids too."""
    solid = {node for kind in mesh.elements.values() for element in kind for node in element}
    for shell in mesh.shells:
        shared = sorted(solid.intersection(shell.nodes))
        if shared:
            raise FormatError(
                f"node {shared[0]} belongs to the shell {shell.number} and to a solid: CalculiX joins them by equations of its own, which "
                f"are not followed; model the part of element {shell.number} by solids such as C3D20R, or reduce it as a body of its own",
                shell.line,
            )


def _around(mesh: Mesh, place: Mapping[int, int]) -> dict[int, list[_Place]]:
    """The shells at each of their nodes, by ascending numbers. Raises FormatError."""
    sections = [section for section in mesh.sections if section.thickness is not None]
    section_of = {number: section for section in sections for number in section.members(mesh.element_sets)}
    out: dict[int, list[_Place]] = {}
    for shell in sorted(mesh.shells, key=lambda shell: shell.number):
        section = section_of.get(shell.number)
        if section is None:
            raise FormatError(
                f"shell {shell.number} has no thickness; write `*SHELL SECTION, ELSET=…, MATERIAL=…` for a set with it",
                shell.line,
            )
        missing = [node for node in shell.nodes if node not in place]
        if missing:
            raise FormatError(f"shell {shell.number} has the node {missing[0]}, which does not exist", shell.line)
        normals = _normals(mesh.places[[place[node] for node in shell.nodes]])
        for corner, node in enumerate(shell.nodes):
            size = float(np.linalg.norm(normals[corner]))
            if not size > 0.0:
                raise FormatError(
                    f"shell {shell.number} has no normal at its node {node}: two of its nodes coincide", shell.line
                )
            out.setdefault(node, []).append(_Place(shell, corner, normals[corner] / size, section))
    return out


@cache
def _coefficients(count: int) -> Array:
    """(monomials, nodes) of the shape functions."""
    at = np.array((TRIANGLE if count in (3, 6) else SQUARE)[:count], dtype=float)
    return np.linalg.inv(np.prod(at[:, None] ** np.array(POWERS[count]), axis=2))


@cache
def _slopes(count: int) -> Array:
    """(count, count, 2) slopes of the shape functions at the nodes: [at, of, along ξ or η]."""
    at = np.array((TRIANGLE if count in (3, 6) else SQUARE)[:count], dtype=float)
    powers, coefficients = np.array(POWERS[count]), _coefficients(count)
    out = []
    for axis in range(2):
        lower = powers.copy()
        lower[:, axis] = np.maximum(lower[:, axis] - 1, 0)
        out.append((powers[:, axis] * np.prod(at[:, None] ** lower, axis=2)) @ coefficients)
    return np.stack(out, axis=2)


def _normals(corners: Array) -> Array:
    """(n, 3) at the nodes of a shell with nodes at `corners` (n, 3), not of unit length."""
    along = np.einsum("pna,nx->pax", _slopes(len(corners)), corners)
    return np.cross(along[:, 0], along[:, 1])


def _plane(corners: Array) -> tuple[Array, Array]:
    """Point (3,) and unit normal (3,) where CalculiX places the axes of a shell: ξ = η = 0, which is the first node of triangles."""
    at, along, across = (
        _coefficients(len(corners))[POWERS[len(corners)].index(power)] for power in ((0, 0), (1, 0), (0, 1))
    )
    normal = np.cross(along @ corners, across @ corners)
    return at @ corners, normal / np.linalg.norm(normal)


def _groups(around: Sequence[_Place]) -> list[list[_Place]]:
    """The shells at a node that share nodes through the thickness: those like the first that is in no group yet."""
    left, out = list(around), []
    while left:
        first = left[0]
        group = [first] + [each for each in left[1:] if _alike(first, each)]
        left = [each for each in left if all(each is not other for other in group)]
        out.append(group)
    return out


def _alike(first: _Place, other: _Place) -> bool:
    return (
        float(first.normal @ other.normal) > SMOOTH
        and abs((first.section.thickness or 0.0) - (other.section.thickness or 0.0)) < SAME
        and abs(first.section.offset - other.section.offset) < SAME
    )


def _mean(group: Sequence[_Place], node: int) -> Array:
    total = np.sum([each.normal for each in group], axis=0)
    size = float(np.linalg.norm(total))
    if not size > 0.0:
        raise FormatError(f"the normals of the shells at node {node} cancel out", group[0].shell.line)
    return total / size


def _has_middle(place: _Place) -> bool:
    """Whether the solid has a node in the middle of the thickness there: at the corners of quadratic elements."""
    count = SHELLS[place.shell.kind]
    return count > 4 and place.corner < count // 2


def _refuse_skew(groups: Sequence[Sequence[_Place]], node: int) -> None:
    """Raises FormatError for a knot of nodes on one line, about which CalculiX stops its turn, along none of the axes."""
    normals = [each.normal for group in groups for each in group]
    if all(abs(float(normals[0] @ each)) > FLAT for each in normals) and np.abs(normals[0]).max() < 1.0 - 1e-12:
        shell = groups[1][0].shell
        raise FormatError(
            f"shells of different thickness, offset or sense meet at node {node} (element {shell.number}) in a plane across none of the "
            "axes: CalculiX stops a turn there in a way that is not followed; give them one *SHELL SECTION and one sense of numbering, "
            "or turn the model so that their normal is along x, y or z",
            shell.line,
        )


def _solids(mesh: Mesh, nodes_of: Mapping[tuple[int, int], tuple[int, int, int]]) -> dict[str, list[list[int]]]:
    """Elements by type: corners below and above, then nodes in the middle of edges below, above, and through the thickness."""
    out = {kind: list(elements) for kind, elements in mesh.elements.items()}
    for shell in mesh.shells:
        count = SHELLS[shell.kind]
        three = [nodes_of[shell.number, corner] for corner in range(count)]
        corners = count if count <= 4 else count // 2
        nodes = [each[0] for each in three[:corners]] + [each[2] for each in three[:corners]]
        if count > 4:
            nodes += [each[0] for each in three[corners:]] + [each[2] for each in three[corners:]]
            nodes += [each[1] for each in three[:corners]]
        out.setdefault(SOLID_OF[shell.kind], []).append(nodes)
    return out


def _numbers(mesh: Mesh) -> dict[str, list[int]]:
    """Numbers of the elements, in the order of `_solids`."""
    out = {kind: list(numbers) for kind, numbers in mesh.element_numbers.items()}
    for shell in mesh.shells:
        out.setdefault(SOLID_OF[shell.kind], []).append(shell.number)
    return out


def _temperatures(
    mesh: Mesh, layers: Mapping[int, tuple[int, ...]], knots: Mapping[int, Knot]
) -> dict[int, float] | None:
    """Nodes through the thickness have the temperature of the node of shells."""
    if mesh.temperatures is None:
        return None
    out = dict(mesh.temperatures)
    for node, nodes in (*layers.items(), *((node, knot.nodes) for node, knot in knots.items())):
        out |= dict.fromkeys(nodes, mesh.temperatures.get(node, 0.0))
    return out
