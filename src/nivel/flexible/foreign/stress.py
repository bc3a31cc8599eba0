"""Stress of a deck: its solids with the elasticity of their sections, held against the energy of the stiffness matrix."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.foreign.elasticity import Law, in_plane, turned
from nivel.flexible.foreign.matrix import FormatError, Label
from nivel.flexible.foreign.mesh import POINTS, SHELLS, SOLIDS, Mesh, Section
from nivel.flexible.model import solid_shapes as shapes
from nivel.flexible.model.model import Array, FiniteElementModel, Sparse, Whole
from nivel.flexible.model.solid_elements import SolidBlock, SolidElements, surface
from nivel.flexible.model.solid_shapes import SolidShape

# Rows that CalculiX makes itself: rotations of rigid groups, incompatible modes of C3D8I, and solids in place of beams.

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


MEAN: Final = ("C3D8", INCOMPATIBLE)  # elements of one temperature
C3D20: Final = "C3D20"
TOLD: Final = {
    C3D20: "stress of elements C3D20 is that of 2 × 2 × 2 points, where it is most accurate; CalculiX takes 3 × 3 × 3 points",
    "C3D6": "stress of elements C3D6 is that of their two points; CalculiX 2.20 exchanges nodes above and below in its result file",
}  # where nodal stress is another one than in a result file of CalculiX
# share by which energies of uniform strains may differ, and of C3D20 beside knots, which disturb them
SAME_ENERGY, LIKE_ENERGY = (0.01, 0.3)


class UnknownStressError(Exception):
    """Why the stress of a mesh is not known, in words."""


def with_elements(
    model: FiniteElementModel,
    mesh: Mesh,
    blocks: Mapping[str, SolidBlock],
    place: Mapping[int, int],
    pressure: float,
    length: float,
) -> FiniteElementModel:
    """The model with the solids of its mesh, their faces for pictures, and why their stress is not known, if it is not.

    blocks : of `blocks_of`; empty where nodes have no rows. pressure : [Pa] and length [m] the units of the mesh. Raises FormatError for
    constants of elasticity that are those of no material.
    """
    if not mesh.elements:
        return _without_stress(model, "the mesh has no solids") if mesh.types else model
    nodes = sorted({node for kind in mesh.elements.values() for element in kind for node in element})
    if blocks:
        model = model.changed(triangles=surface(blocks.values()), solids=_tetrahedra(blocks))
    lacking = [node for node in nodes if node not in place or np.any(model.freedoms[place[node], :3] < 0)]
    if lacking:
        return _without_stress(
            model,
            f"node {lacking[0]} of its elements lacks rows in the matrices, as nodes of *RIGID BODY, *EQUATION, *TIE and *BOUNDARY do; "
            "leave the tie to `interfaces` here",
        )
    try:
        elastic = elastic_blocks(mesh, blocks, place, pressure, length)
    except UnknownStressError as error:
        return _without_stress(model, str(error))
    elements = _with_modes_of(model.stiffness, SolidElements(elastic, model.freedoms[:, :3], model.position))
    loose = bool(mesh.planes) and C3D20 in mesh.elements
    other = _other_energy(elements, model, springs=mesh.springs, tolerance=LIKE_ENERGY if loose else SAME_ENERGY)
    if other:
        return _without_stress(model, other)
    told = [text for kind, text in TOLD.items() if kind in mesh.elements]
    return model.changed(elements=elements, volume=elements.volume, notes=(*model.notes, *_steps(elements), *told))


def _without_stress(model: FiniteElementModel, why: str) -> FiniteElementModel:
    return model.changed(notes=(*model.notes, f"stress is not known: {why}"))


def elastic_blocks(
    mesh: Mesh, blocks: Mapping[str, SolidBlock], place: Mapping[int, int], pressure: float, length: float
) -> tuple[SolidBlock, ...]:
    """The blocks of `blocks_of` with their elasticity, those of a section each.

    pressure : [Pa] and length [m] the units of the mesh. Raises FormatError for constants that are those of no material, and
    UnknownStressError.
    """
    if mesh.stressless:
        raise UnknownStressError(mesh.stressless[0])
    other = [kind for kind in mesh.types if kind not in SOLIDS.keys() | SHELLS.keys() | POINTS]
    if other or mesh.shells:
        raise UnknownStressError(
            f"the mesh has elements {other[0] if other else mesh.shells[0].kind}, whose stress is not known"
        )
    section_of = {number: section for section in mesh.sections for number in section.members(mesh.element_sets)}
    temperature = None
    if mesh.temperatures is not None:
        temperature = np.array([mesh.temperatures.get(node, 0.0) for node in place])
    out = []
    for kind, block in blocks.items():
        groups: dict[Section | None, list[int]] = {}
        for k, number in enumerate(mesh.element_numbers.get(kind) or [0] * len(block.nodes)):
            groups.setdefault(section_of.get(number), []).append(k)
        for section, members in groups.items():
            law = _law(mesh, section, mesh.element_numbers[kind][members[0]])
            axes = "" if section is None or law.kind == "ISO" else section.orientation
            part = replace(block.part(members), material=f"{law.name} {axes}".strip())
            at = None if temperature is None or len(law.rows) < 2 else _temperatures(part, kind, temperature)
            D = law.stiffness(at)
            D = pressure * (D if D.ndim == 4 else D[None, None])
            if section is not None and law.kind != "ISO":
                planes = (
                    [mesh.planes[mesh.element_numbers[kind][k]] for k in members]
                    if section.thickness is not None
                    else []
                )
                D = turned(D, _axes(mesh, part, section, planes, length))
                if not np.all(np.isfinite(D)):
                    what = "its points coincide, or elements have strain on its axis"
                    raise UnknownStressError(f"*ORIENTATION {section.orientation} has no axes: {what}")
            out.append(replace(part, elasticity=D))
    return tuple(out)


def _axes(
    mesh: Mesh, block: SolidBlock, section: Section, planes: Sequence[tuple[Array, Array]], length: float
) -> Array:
    """(e or 1, points or 1, 3, 3) the axes of the material of a section, in rows. Raises UnknownStressError.

    planes : of shells, whose x axis is projected onto them, or z where x is normal to them within 0.1°, and whose z axis is their normal.
    """
    name, at = section.orientation, np.zeros((1, 1, 3))
    axes = mesh.orientations.get(name)
    if name and (axes is None or axes.problem):
        raise UnknownStressError(axes.problem if axes else f"there is no *ORIENTATION {name} (line {section.line})")
    if planes:
        at = np.array([point for point, _ in planes])[:, None]
    elif axes is not None and axes.cylindrical:
        at = _at_points(block, block.position[block.nodes]) / length
    out = np.broadcast_to(np.eye(3), (*at.shape[:2], 3, 3)) if axes is None else axes.axes(at)
    return out if not planes else in_plane(out, np.array([normal for _, normal in planes])[:, None])


def _law(mesh: Mesh, section: Section | None, number: int) -> Law:
    """The law of the elements of a section. Raises UnknownStressError."""
    if section is None and (mesh.sections or len(mesh.laws) != 1):
        raise UnknownStressError(
            f"element {number} has no material; write `*SOLID SECTION, ELSET=…, MATERIAL=…` for a set with it"
        )
    if section is not None and section.problem:
        raise UnknownStressError(section.problem)
    name = next(iter(mesh.laws)) if section is None else section.material
    if name not in mesh.laws:
        raise UnknownStressError(f"there is no *MATERIAL {name}, which the section of element {number} names")
    law = mesh.laws[name]
    if law.problem or not law.kind:
        raise UnknownStressError(f"material {name}: {law.problem or 'it has no *ELASTIC'}")
    return law


def _temperatures(block: SolidBlock, kind: str, temperature: Array) -> Array:
    """(e or 1, points or 1) where the elements have strain, as CalculiX has them: the mean of linear hexahedra, of others by their shape
    functions; from those (n,) of all nodes."""
    at_nodes = temperature[block.nodes]
    if np.ptp(at_nodes) == 0.0:
        return at_nodes[:1, :1]
    if kind in MEAN:
        return at_nodes.mean(axis=1, keepdims=True)
    return _at_points(block, at_nodes[..., None])[..., 0]


def _at_points(block: SolidBlock, values: Array) -> Array:
    """(e, points, k) by the shape functions, from values (e, n, k) at the nodes."""
    return np.stack([np.einsum("n,enk->ek", block.shape.functions(at), values) for at in block.shape.points], axis=1)


def _with_modes_of(K: Sparse, elements: SolidElements) -> SolidElements:
    """The incompatible modes as the program has them that wrote K: CalculiX up to 2.20 does not scale their slopes.

    That of both which stores the energy of K in a motion of these modes alone.
    """
    rows = [block.inner.ravel() for block in elements.blocks if block.inner is not None]
    if not rows:
        return elements
    motion = np.zeros((max(K.shape[0], int(elements.freedoms.max()) + 1), 1))
    motion[np.concatenate(rows)] = np.random.default_rng(2).normal(size=(sum(map(len, rows)), 1))
    stored = 0.5 * float((motion[: K.shape[0]].T @ (K @ motion[: K.shape[0]]))[0, 0])
    plain = replace(elements, blocks=tuple(replace(block, patched=False) for block in elements.blocks))
    return min((elements, plain), key=lambda each: abs(float(each.strain_energy(motion)[0]) - stored))


def _other_energy(elements: SolidElements, model: FiniteElementModel, *, springs: bool, tolerance: float) -> str:
    """Why the elasticity of the elements is another one than that of the stiffness matrix; empty where it is not.

    In a uniform strain elements of every formulation store the energy of their volume (the patch test of Irons): so in strains along all
    axes and in mixtures of them both must have the same energy, but for springs.
    """
    strains = np.concatenate([np.eye(6), np.random.default_rng(6).uniform(-1.0, 1.0, size=(6, 6))])
    slopes = strains[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
    K, motion = model.stiffness, model.expansion
    uniform = np.zeros((motion.shape[0], len(strains)))
    nodes = np.all(elements.freedoms >= 0, axis=1)
    uniform[elements.freedoms[nodes]] = np.einsum(
        "sab,nb->nas", slopes, elements.position[nodes] - elements.position.mean(axis=0)
    )
    uniform = uniform[: K.shape[0]]
    stored = 0.5 * np.einsum("is,is->s", uniform, K @ uniform)
    share = elements.strain_energy(motion @ uniform) / np.maximum(stored, 1e-300)
    worst = int(np.argmax(np.abs(share - 1.0) if not springs else share - 1.0))
    if abs(share[worst] - 1.0) <= tolerance or (springs and share[worst] < 1.0):
        return ""
    return (
        f"in a uniform strain the elements of the deck store {share[worst]:.4g} times the energy of the stiffness matrix, so that it is of "
        "another elasticity, thickness or unit than the deck"
    )


def _steps(elements: SolidElements) -> tuple[str, ...]:
    """That stress is averaged between materials, where it is."""
    parts = elements.by_material
    if len(parts) == 1:
        return ()
    shared = int(np.count_nonzero(np.bincount(np.concatenate([part.stations for part in parts])) > 1))
    if not shared:
        return ()
    return (
        f"stress at {shared} nodes between materials is the mean of all elements around, as in CalculiX; stress has steps there",
    )


def _tetrahedra(blocks: Mapping[str, SolidBlock]) -> Whole:
    """Nodes of a mesh of tetrahedra of one kind, for export; of other meshes none."""
    nodes = [block.nodes for block in blocks.values()]
    return nodes[0] if len(nodes) == 1 and nodes[0].shape[1] in (4, 10) else np.zeros((0, 4), dtype=np.int64)
