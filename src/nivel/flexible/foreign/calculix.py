"""Rows that CalculiX makes itself: rotations of rigid groups, incompatible modes of C3D8I, and solids in place of beams."""

import re
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.foreign.matrix import FormatError, Label
from nivel.flexible.foreign.mesh import SHELLS, Mesh
from nivel.flexible.model import solid_shapes as shapes
from nivel.flexible.model.model import Array, Whole
from nivel.flexible.model.solid_elements import SolidBlock
from nivel.flexible.model.solid_shapes import SolidShape

INCOMPATIBLE = "C3D8I"
# elements that CalculiX replaces by solids whose nodes are in no file
EXPANDED = re.compile(r"(S\d|M3D|CPS|CPE|CAX|B\d|T\dD|PIPE)")


def refuse_expanded(mesh: Mesh) -> None:
    """Raise FormatError with the line where the mesh has beams, membranes or plane elements."""
    for kind, line in mesh.types.items():
        if EXPANDED.match(kind) and kind not in SHELLS:
            raise FormatError(
                f"{kind}: CalculiX computes with a solid in place of this element, and its matrices have the nodes of that, which no "
                "file has; model it by solids such as C3D20R or C3D8I, or take matrices of another program",
                line,
            )


def rigid_rows(labels: Sequence[Label], mesh: Mesh) -> tuple[Label, ...]:
    """The labels with rotations of rigid groups as directions 4 … 6 of their reference nodes.

    CalculiX has them as displacements of another node: the one behind ROT NODE, or a new one for each group that names none, with
    the next numbers. Raises FormatError.
    """
    given, turns = {node for node, _ in labels}, {}
    new = int(mesh.numbers.max())
    known = set(mesh.numbers.tolist())
    for group in mesh.rigid:
        rotation = group.rotation
        if rotation is None:
            new += 1
            rotation = new
        missing = [node for node in (group.reference, group.rotation) if node is not None and node not in known]
        if missing:
            raise FormatError(f"*{group.keyword}: there is no node {missing[0]}", group.line)
        if rotation in given and group.reference in given:
            turns[rotation] = group.reference
    return tuple((turns[node], axis + 3) if node in turns else (node, axis) for node, axis in labels)


def internal_nodes(labels: Sequence[Label], mesh: Mesh) -> set[int]:
    """Numbers, above those of all nodes, of the incompatible modes of C3D8I: displacements that vanish at the nodes."""
    if INCOMPATIBLE not in mesh.types:
        return set()
    return {node for node, _ in labels if node > mesh.numbers[-1]}


def incompatible_rows(labels: Sequence[Label], mesh: Mesh) -> Mapping[int, NDArray[np.int64]]:
    """(3, 3) rows of the incompatible modes of each element C3D8I, by its number: [mode, direction]; empty where they have none.

    CalculiX gives each of these elements three nodes, in the order of their numbers.
    """
    nodes, numbers = sorted(internal_nodes(labels, mesh)), sorted(mesh.element_numbers.get(INCOMPATIBLE, []))
    row = {label: k for k, label in enumerate(labels)}
    rows = [row.get((node, axis), -1) for node in nodes for axis in (1, 2, 3)]
    if len(nodes) != 3 * len(numbers) or -1 in rows:
        return {}
    return dict(zip(numbers, np.array(rows, dtype=np.int64).reshape(-1, 3, 3), strict=True))


KINDS: Final[Mapping[str, SolidShape]] = {
    "C3D4": shapes.TETRAHEDRON_4,
    "C3D6": shapes.WEDGE_6,
    "C3D8": shapes.HEXAHEDRON_8,
    "C3D8I": shapes.HEXAHEDRON_8,
    "C3D8R": shapes.HEXAHEDRON_8_CENTRE,
    "C3D10": shapes.TETRAHEDRON_10,
    "C3D15": shapes.WEDGE_15,
    "C3D20": shapes.HEXAHEDRON_20,
}


def blocks_of(
    mesh: Mesh, place: Mapping[int, int], position: Array, inner: Mapping[int, Whole] | None = None
) -> dict[str, SolidBlock]:
    """The solids of a mesh by type. place : of the nodes in `position` (n, 3) [m], by number; inner : `calculix.incompatible_rows`."""
    out = {}
    for kind, elements in mesh.elements.items():
        shape = KINDS[kind if kind in KINDS else kind.rstrip("HMRT")]
        nodes = np.array([[place[node] for node in element] for element in elements], dtype=np.int64)
        rows = np.array([inner[k] for k in mesh.element_numbers[kind]]) if inner and kind == INCOMPATIBLE else None
        out[kind] = SolidBlock(shape, nodes, position, kind == INCOMPATIBLE, rows)
    return out


def first_inverted(blocks: Mapping[str, SolidBlock]) -> str:
    """How many elements are turned inside out, and which is the first of them; empty where none is."""
    for kind, block in blocks.items():
        bad = block.inverted()
        if len(bad):
            return f"{len(bad)} of {len(block.nodes)} elements {kind} are turned inside out (the first is number {bad[0] + 1} of the file)"
    return ""
