"""Finite-element models of other programs, from their matrices and nodes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from nivel.errors import Fault, ModelError, refuse
from nivel.flexible.checks.checks import unsymmetric
from nivel.flexible.foreign import calculix
from nivel.flexible.foreign.matrix import (
    FileMatrix,
    FormatError,
    Label,
    read_abaqus,
    read_calculix,
    read_freedoms,
    read_matrix_market,
)
from nivel.flexible.foreign.mesh import Mesh
from nivel.flexible.foreign.nastran import read_dmig, read_op4
from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.foreign.shells import Expansion, expansion
from nivel.flexible.foreign.stress import with_elements
from nivel.flexible.model.model import Array, FiniteElementModel, Sparse, Whole, from_matrix
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.records import LENGTHS, MASSES, Matrices
from nivel.flexible.model.selection import NodeSets
from nivel.lazy import dataclass


@dataclass(frozen=True)
class Followers:
    """Nodes whose displacements follow from rows of the matrices.

    numbers : of the f nodes; position : (f, 3) [m]; motion : (3 f, N) displacements x, y, z of each from the N rows.
    freedoms : (f, 6) of each, numbered after the N rows; they have no turns.
    stands_for : by place among all nodes, with the followers last: places of the nodes that an interface takes in its place. Nodes in
    the middle of the thickness are never tied.
    """

    numbers: tuple[int, ...]
    position: Array
    motion: Sparse
    freedoms: Whole
    stands_for: Mapping[int, tuple[int, ...]]


def followers(
    shells: Expansion,
    labels: Sequence[Label],
    position: Array,
    freedoms: Whole,
    place: Mapping[int, int],
    length: float,
) -> Followers:
    """The followers of expanded shells.

    labels : of the rows; position : (n, 3) [m] and freedoms (n, 6) of the nodes that have rows, in the order of `place`.
    length : [m] unit of the mesh.
    """
    numbers: list[int] = []
    rows: list[dict[int, float]] = []
    stands_for: dict[int, tuple[int, ...]] = {}
    for node, layers in shells.layers.items():
        if layers[0] not in place:  # held by a rigid group of the deck
            continue
        bottom, top = freedoms[place[layers[0]], :3], freedoms[place[layers[-1]], :3]
        offset = shells.offsets[node]  # of the node above the middle
        rows += [{int(b): 0.5 - offset, int(t): 0.5 + offset} for b, t in zip(bottom, top, strict=True)]
        ends = (place[layers[0]], place[layers[-1]])
        stands_for[len(position) + len(numbers)] = ends
        # free, so that the thickness can change as a plate bends
        stands_for |= {place[middle]: ends for middle in layers[1:-1]}
        numbers.append(node)
    at = {number: k for k, number in enumerate(shells.mesh.numbers.tolist())}
    stretch_row = {node: k for k, (node, axis) in enumerate(labels) if axis == 4}
    for node, knot in shells.knots.items():
        own = freedoms[place[node]]
        for each in knot.nodes:
            arm = (shells.mesh.places[at[each]] - shells.mesh.places[at[node]]) * length
            rows += _knot_rows(own, stretch_row[knot.stretch], arm)
            stands_for[len(position) + len(numbers)] = (place[node],)
            numbers.append(each)
    places = shells.mesh.places[[at[number] for number in numbers]].reshape(-1, 3) * length
    own_freedoms = np.full((len(numbers), 6), -1, dtype=np.int64)
    own_freedoms[:, :3] = len(labels) + np.arange(3 * len(numbers)).reshape(-1, 3)
    return Followers(tuple(numbers), places, _matrix(rows, len(labels)), own_freedoms, stands_for)


def _knot_rows(own: Whole, stretch: int, arm: Array) -> list[dict[int, float]]:
    """Displacements u + θ × r + e r from the rows `own` (6,) of u and θ; a turn that has no row is about a line of nodes."""
    x, y, z = arm
    turned = ((0.0, z, -y), (-z, 0.0, x), (y, -x, 0.0))
    out = []
    for axis in range(3):
        row = {int(own[axis]): 1.0, stretch: float(arm[axis])}
        row |= {int(own[3 + k]): float(value) for k, value in enumerate(turned[axis]) if own[3 + k] >= 0}
        out.append(row)
    return out


def _matrix(rows: Sequence[Mapping[int, float]], count: int) -> Sparse:
    entries = [(k, column, value) for k, row in enumerate(rows) for column, value in row.items() if value != 0.0]
    i, j, values = zip(*entries, strict=True)
    return sp.csr_array((np.array(values), (np.array(i), np.array(j))), shape=(len(rows), count))


HELD = 1e30  # a diagonal element from which on a row is one of a support (Abaqus writes 1e36)
STIFFNESS_NAMES, MASS_NAMES = ("KAAX", "KAA", "KGG", "KXX"), ("MAAX", "MAA", "MGG", "MXX")


@dataclass(frozen=True)
class _Read:
    stiffness: FileMatrix
    mass: FileMatrix
    labels: tuple[Label, ...]


def matrix_model(located: Located) -> tuple[FiniteElementModel, NodeSets]:
    """The model of the `matrices` of a model file in SI units, and its node sets.

    Raises ModelError.
    """
    given = located.record.matrices
    assert given is not None
    mesh = _opened(located, "nodes", given.nodes, read_mesh)
    shells: Expansion | None = None
    if given.format == "calculix" and mesh.shells:
        _in_nodes(located, given, lambda: calculix.refuse_expanded(mesh))
        shells = _in_nodes(located, given, lambda: expansion(mesh))
    try:
        read = _matrices(located, given, mesh, shells)
    except ModelError:
        if given.format == "calculix":  # nodes of the solids in place of beams stand there many times
            _in_nodes(located, given, lambda: calculix.refuse_expanded(mesh))
        raise
    if given.format == "calculix":
        read = _in_nodes(located, given, lambda: _of_calculix(read, mesh))
    if shells is not None:
        mesh = shells.mesh
    _check_nodes(located, mesh, read, shells)
    length, mass = LENGTHS[given.units.length], MASSES[given.units.mass]
    return _model(located, given, mesh, read, shells, length, mass)


def _of_calculix(read: _Read, mesh: Mesh) -> _Read:
    """With the rotations of rigid groups as directions of their reference nodes. Raises FormatError."""
    if any(node > mesh.numbers[-1] for node, _ in read.labels):  # of the solids in place of shells
        calculix.refuse_expanded(mesh)
    labels = calculix.rigid_rows(read.labels, mesh)
    stiffness, mass = (
        FileMatrix(each.matrix, calculix.rigid_rows(each.labels or (), mesh)) for each in (read.stiffness, read.mass)
    )
    return _Read(stiffness, mass, labels)


def _in_nodes(located: Located, given: Matrices, do: Callable[[], Any]) -> Any:
    """What `do` returns; its FormatError as a ModelError with the line of the mesh."""
    try:
        return do()
    except FormatError as error:
        raise _fault(error, located.beside(given.nodes), "nodes") from None


def _opened(located: Located, key: str, name: str, reader: Callable[[Path], Any]) -> Any:
    """What `reader` makes of the file under `key`. Raises ModelError."""
    path = located.beside(name)
    place = ("matrices", key)
    if not path.is_file():
        raise ModelError(located.fault(place, f"there is no file `{path}`"))
    try:
        return reader(path)
    except FormatError as error:
        raise _fault(error, path, key) from None
    except OSError as error:
        raise ModelError(located.fault(place, f"`{path}` cannot be read: {error.strerror}")) from None


def _fault(error: FormatError, path: Path, key: str) -> ModelError:
    return ModelError(Fault(str(error.file or path), int(error.line), 1, f"matrices.{key}", error.message))


def _matrices(located: Located, given: Matrices, mesh: Mesh, shells: Expansion | None) -> _Read:
    freedoms = None
    if given.freedoms is not None:
        reader = partial(read_freedoms, repeated=shells is not None)
        freedoms = _opened(located, "freedoms", given.freedoms, reader)
        if shells is not None:
            freedoms = _in_nodes(located, given, partial(shells.labels, freedoms))
    match given.format:
        case "nastran" | "op4":
            reader = read_dmig if given.format == "nastran" else read_op4
            stiffness = _named(located, given, "stiffness", reader)
            mass = _named(located, given, "mass", reader)
        case "abaqus" | "matrix-market":
            reader = read_abaqus if given.format == "abaqus" else read_matrix_market
            stiffness = _opened(located, "stiffness", given.stiffness, reader)
            mass = _opened(located, "mass", _mass_file(located, given), reader)
        case "calculix":
            if freedoms is None:
                raise ModelError(
                    located.fault(("matrices",), "CalculiX matrices need their `freedoms`, the .dof file", at_key=True)
                )
            stiffness = _opened(located, "stiffness", given.stiffness, lambda path: read_calculix(path, freedoms))
            mass = _opened(located, "mass", _mass_file(located, given), lambda path: read_calculix(path, freedoms))
    if stiffness.labels is not None:
        labels = tuple(sorted({*stiffness.labels, *(mass.labels or ())}))
        return _Read(stiffness, mass, labels)
    labels = freedoms or _by_counting(located, stiffness.matrix.shape[0], mesh)
    for key, each in (("stiffness", stiffness), ("mass", mass)):
        if each.matrix.shape[0] != len(labels):
            message = f"the matrix has {each.matrix.shape[0]} rows, and `freedoms` names {len(labels)}"
            raise ModelError(located.fault(("matrices", key), message))
    return _Read(FileMatrix(stiffness.matrix, labels), FileMatrix(mass.matrix, labels), labels)


def _mass_file(located: Located, given: Matrices) -> str:
    if given.mass is None:
        raise ModelError(located.fault(("matrices",), "`mass` is missing: the file of the mass matrix", at_key=True))
    return given.mass


def _named(located: Located, given: Matrices, key: str, reader: Callable[[Path], dict[str, FileMatrix]]) -> FileMatrix:
    """A matrix of a file that may have several: the one that is named, or one with a usual name."""
    own_file = given.mass if key == "mass" else None
    place = "mass" if own_file is not None else "stiffness"
    found = _opened(located, place, own_file or given.stiffness, reader)
    wanted = given.stiffness_name if key == "stiffness" else given.mass_name
    if wanted is not None:
        if wanted.upper() not in found:
            message = f"there is no matrix `{wanted}`; there {'is' if len(found) == 1 else 'are'} {', '.join(found)}"
            raise ModelError(located.fault(("matrices", f"{key}_name"), message))
        return found[wanted.upper()]
    usual = [name for name in (STIFFNESS_NAMES if key == "stiffness" else MASS_NAMES) if name in found]
    if usual or (len(found) == 1 and given.mass is not None):
        return found[usual[0] if usual else next(iter(found))]
    message = f"which of the matrices {', '.join(found)} is the {key}? Give `{key}_name`"
    raise ModelError(located.fault(("matrices",), message, at_key=True))


def _by_counting(located: Located, rows: int, mesh: Mesh) -> tuple[Label, ...]:
    """Freedoms node by node in ascending order of their numbers, three or six each."""
    nodes = len(mesh.numbers)
    if rows not in (3 * nodes, 6 * nodes):
        message = f"the matrix has {rows} rows; {nodes} nodes have {3 * nodes} degrees of freedom, or {6 * nodes} with rotations"
        raise ModelError(
            located.fault(("matrices",), f"{message}{_hole(mesh.numbers)}; give a table of `freedoms`", at_key=True)
        )
    return tuple((int(node), axis) for node in mesh.numbers for axis in range(1, rows // nodes + 1))


def _hole(numbers: Whole) -> str:
    """Where the numbering of nodes has a hole."""
    gaps = np.flatnonzero(np.diff(numbers) > 1)
    if not len(gaps):
        return ""
    before = int(numbers[gaps[0]])
    more = f" and {len(gaps) - 1} more" if len(gaps) > 1 else ""
    return f"; the numbers of the nodes have a hole after {before} (the next is {int(numbers[gaps[0] + 1])}){more}"


def _check_nodes(located: Located, mesh: Mesh, read: _Read, shells: Expansion | None) -> None:
    """Refuse rows and elements of nodes that do not exist, and directions that are none. Raises ModelError."""
    known = set(mesh.numbers.tolist())
    missing = sorted({node for node, _ in read.labels} - known - _inside(read, mesh, shells))
    faults = []
    if missing:
        names = ", ".join(map(str, missing[:8])) + (" …" if len(missing) > 8 else "")
        message = f"the matrices have rows of nodes that are not among the {len(known)} nodes here: {names}{_hole(mesh.numbers)}"
        faults.append(
            located.fault(("matrices", "nodes"), f"{message}; take the mesh that the matrices were made with")
        )
    unknown = sorted({node for kind in mesh.elements.values() for element in kind for node in element} - known)
    if unknown:
        names = ", ".join(map(str, unknown[:8]))
        message = f"elements of the mesh have nodes that do not exist: {names}{_hole(mesh.numbers)}"
        faults.append(located.fault(("matrices", "nodes"), f"{message}; write the mesh again, with all its nodes"))
    refuse(faults)


def _inside(read: _Read, mesh: Mesh, shells: Expansion | None) -> set[int]:
    """Numbers of rows without a node: incompatible modes, and stretches of knots of shells."""
    stretches = set() if shells is None else {knot.stretch for knot in shells.knots.values()}
    return calculix.internal_nodes(read.labels, mesh) | stretches


def _model(
    located: Located,
    given: Matrices,
    mesh: Mesh,
    read: _Read,
    shells: Expansion | None,
    length: float,
    mass_unit: float,
) -> tuple[FiniteElementModel, NodeSets]:
    inside = _inside(read, mesh, shells)
    used = sorted({node for node, _ in read.labels} - inside)
    place = {node: k for k, node in enumerate(used)}
    freedoms = np.full((len(used), 6), -1, dtype=np.int64)
    for row, (node, axis) in enumerate(read.labels):
        if node not in inside:
            freedoms[place[node], axis - 1] = row
    position = mesh.places[np.searchsorted(mesh.numbers, used)] * length
    scale = sp.diags_array(np.where(np.array([axis for _, axis in read.labels]) > 3, length, 1.0))
    # K in N/m for translations: mass/s²; a turn brings a length
    K = scale @ read.stiffness.ordered(read.labels) @ scale * mass_unit
    M = scale @ read.mass.ordered(read.labels) @ scale * mass_unit
    _check_matrices(located, sp.csc_array(K), sp.csc_array(M), read.labels)
    mass = from_matrix(position, freedoms, sp.csc_array(M))
    motion, stands_for = sp.csr_array(sp.eye_array(len(read.labels))), {}
    if shells is not None:
        following = followers(shells, read.labels, position, freedoms, place, length)
        freedoms = np.concatenate([freedoms, following.freedoms])
        position = np.concatenate([position, following.position])
        motion = sp.csr_array(sp.vstack([motion, following.motion]))
        place |= {node: len(used) + k for k, node in enumerate(following.numbers)}
        used, stands_for = [*used, *following.numbers], following.stands_for
    dropped = len(mesh.numbers) - len(used)
    notes = (f"{dropped} nodes of the mesh have no rows in the matrices and were left out",) if dropped else ()
    incompatible = len(calculix.internal_nodes(read.labels, mesh))
    notes += (f"{incompatible} incompatible modes of elements C3D8I are rows without a node",) if incompatible else ()
    notes += mesh.notes if shells is None else (*mesh.notes, *shells.notes)
    sets = {
        name: np.array(sorted({place[node] for node in members if node in place}), dtype=np.int64)
        for name, members in mesh.sets.items()
    }
    model = FiniteElementModel(
        name=located.record.name,
        node_ids=np.array(used, dtype=np.int64),
        position=position,
        freedoms=freedoms,
        stiffness=sp.csc_array(K),
        mass=mass,
        expansion=motion,
        stands_for=stands_for,
        notes=notes,
    )
    return _in_nodes(located, given, lambda: _with_solids(located, model, mesh, read, place, length, mass_unit)), sets


def _with_solids(
    located: Located,
    model: FiniteElementModel,
    mesh: Mesh,
    read: _Read,
    place: Mapping[int, int],
    length: float,
    mass_unit: float,
) -> FiniteElementModel:
    """The model with its solids: their stress, and pictures. Raises FormatError and ModelError."""
    if any(node not in place for kind in mesh.elements.values() for element in kind for node in element):
        blocks = {}
    else:
        blocks = calculix.blocks_of(mesh, place, model.position, calculix.incompatible_rows(read.labels, mesh))
    bad = calculix.first_inverted(blocks)
    if bad:
        raise ModelError(
            located.fault(("matrices", "nodes"), f"{bad}: their nodes are in another order, or a node was moved")
        )
    return with_elements(model, mesh, blocks, place, mass_unit / length, length)  # a pressure is mass / (length s²)


def _check_matrices(located: Located, K: Sparse, M: Sparse, labels: tuple[Label, ...]) -> None:
    faults = []
    for key, matrix in (("stiffness", K), ("mass", M)):
        if not np.all(np.isfinite(matrix.data)):
            faults.append(located.fault(("matrices", key), f"the {key} matrix has entries that are not finite numbers"))
            continue
        problem = unsymmetric(matrix, key)
        if problem:
            faults.append(located.fault(("matrices", key), problem))
    held = np.flatnonzero(np.abs(K.diagonal()) > HELD)
    if len(held):
        node, axis = labels[held[0]]
        message = f"{len(held)} rows are held by boundary conditions (node {node}, direction {axis}, for one: {K.diagonal()[held[0]]:.3g})"
        faults.append(
            located.fault(("matrices", "stiffness"), f"{message}; remove all supports before the matrices are written")
        )
    refuse(faults)
