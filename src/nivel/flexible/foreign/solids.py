"""Elements of the meshes of other programs whose stress can be recovered, as blocks of one shape."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from nivel.flexible.foreign.calculix import INCOMPATIBLE
from nivel.flexible.foreign.mesh import Mesh
from nivel.flexible.model import solid_shapes as shapes
from nivel.flexible.model.model import Array, Whole
from nivel.flexible.model.solid_elements import SolidBlock
from nivel.flexible.model.solid_shapes import SolidShape

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
