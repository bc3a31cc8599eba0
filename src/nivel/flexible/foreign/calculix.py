"""Rows that CalculiX makes itself: rotations of rigid groups, incompatible modes of C3D8I, and solids in place of beams."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.foreign.matrix import FormatError, Label
from nivel.flexible.foreign.mesh import Mesh
from nivel.flexible.foreign.sections import SHELLS

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
