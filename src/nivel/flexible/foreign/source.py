"""Finite-element models of other programs, from their matrices and nodes."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from nivel.errors import Fault, ModelError, refuse
from nivel.flexible.checks.findings import unsymmetric
from nivel.flexible.foreign import stress as calculix
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
from nivel.flexible.model.records import LENGTHS, MASSES
from nivel.flexible.model.selection import NodeSets
from nivel.lazy import Struct


class Followers(Struct):
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


def matrix_model(located: Located) -> tuple[FiniteElementModel, NodeSets]:
    """The model of the `matrices` of a model file in SI units, and its node sets.

    Raises ModelError.
    """
    return _Reading(located).model()


class _Reading:
    """Matrices of a model file, their mesh, its shells as solids, and the node and direction of each row (`labels`). Raises ModelError."""

    def __init__(self, located: Located) -> None:
        given = located.record.matrices
        assert given is not None
        self.located, self.given = located, given
        self.length, self.mass_unit = LENGTHS[given.units.length], MASSES[given.units.mass]
        self.mesh: Mesh = self._opened("nodes", given.nodes, read_mesh)
        self.shells: Expansion | None = None
        if given.format == "calculix" and self.mesh.shells:
            self._in_nodes(lambda: calculix.refuse_expanded(self.mesh))
            self.shells = self._in_nodes(lambda: expansion(self.mesh))
        try:
            self._read()
        except ModelError:
            if given.format == "calculix":  # nodes of the solids in place of beams stand there many times
                self._in_nodes(lambda: calculix.refuse_expanded(self.mesh))
            raise
        if given.format == "calculix":
            self._in_nodes(self._bind)
        if self.shells is not None:
            self.mesh = self.shells.mesh

    def _bind(self) -> None:
        """Rotations of rigid groups become directions of their reference nodes. Raises FormatError."""
        if any(node > self.mesh.numbers[-1] for node, _ in self.labels):  # of the solids in place of shells
            calculix.refuse_expanded(self.mesh)
        self.labels = calculix.rigid_rows(self.labels, self.mesh)
        self.stiffness, self.mass = (
            FileMatrix(each.matrix, calculix.rigid_rows(each.labels or (), self.mesh))
            for each in (self.stiffness, self.mass)
        )

    def _in_nodes(self, do: Callable[[], Any]) -> Any:
        """What `do` returns; its FormatError as a ModelError with the line of the mesh."""
        try:
            return do()
        except FormatError as error:
            raise _fault(error, self.located.beside(self.given.nodes), "nodes") from None

    def _opened(self, key: str, name: str, reader: Callable[[Path], Any]) -> Any:
        """What `reader` makes of the file under `key`."""
        path = self.located.beside(name)
        if not path.is_file():
            raise self._refusal(f"there is no file `{path}`", key)
        try:
            return reader(path)
        except FormatError as error:
            raise _fault(error, path, key) from None
        except OSError as error:
            raise self._refusal(f"`{path}` cannot be read: {error.strerror}", key) from None

    def _refusal(self, message: str, *keys: str) -> ModelError:
        return ModelError(self.located.fault(("matrices", *keys), message, at_key=not keys))

    def _read(self) -> None:
        """The matrices, and the labels of their rows."""
        given, freedoms = self.given, None
        if given.freedoms is not None:
            freedoms = self._opened(
                "freedoms", given.freedoms, partial(read_freedoms, repeated=self.shells is not None)
            )
            if self.shells is not None:
                freedoms = self._in_nodes(partial(self.shells.labels, freedoms))
        match given.format:
            case "nastran" | "op4":
                reader = read_dmig if given.format == "nastran" else read_op4
                self.stiffness, self.mass = self._named("stiffness", reader), self._named("mass", reader)
            case _:
                readers = {"abaqus": read_abaqus, "matrix-market": read_matrix_market}
                reader = readers.get(given.format, partial(read_calculix, freedoms=freedoms or ()))
                if given.format == "calculix" and freedoms is None:
                    raise self._refusal("CalculiX matrices need their `freedoms`, the .dof file")
                self.stiffness = self._opened("stiffness", given.stiffness, reader)
                if given.mass is None:
                    raise self._refusal("`mass` is missing: the file of the mass matrix")
                self.mass = self._opened("mass", given.mass, reader)
        if self.stiffness.labels is not None:
            self.labels = tuple(sorted({*self.stiffness.labels, *(self.mass.labels or ())}))
            return
        self.labels = freedoms or self._by_counting(self.stiffness.matrix.shape[0])
        for key, each in (("stiffness", self.stiffness), ("mass", self.mass)):
            if each.matrix.shape[0] != len(self.labels):
                message = f"the matrix has {each.matrix.shape[0]} rows, and `freedoms` names {len(self.labels)}"
                raise self._refusal(message, key)
        self.stiffness, self.mass = (FileMatrix(each.matrix, self.labels) for each in (self.stiffness, self.mass))

    def _named(self, key: str, reader: Callable[[Path], dict[str, FileMatrix]]) -> FileMatrix:
        """A matrix of a file that may have several: the one that is named, or one with a usual name."""
        given = self.given
        own_file = given.mass if key == "mass" else None
        found = self._opened("stiffness" if own_file is None else "mass", own_file or given.stiffness, reader)
        wanted = given.stiffness_name if key == "stiffness" else given.mass_name
        if wanted is not None:
            if wanted.upper() not in found:
                message = (
                    f"there is no matrix `{wanted}`; there {'is' if len(found) == 1 else 'are'} {', '.join(found)}"
                )
                raise self._refusal(message, f"{key}_name")
            return found[wanted.upper()]
        usual = [name for name in (STIFFNESS_NAMES if key == "stiffness" else MASS_NAMES) if name in found]
        if usual or (len(found) == 1 and given.mass is not None):
            return found[usual[0] if usual else next(iter(found))]
        raise self._refusal(f"which of the matrices {', '.join(found)} is the {key}? Give `{key}_name`")

    def _by_counting(self, rows: int) -> tuple[Label, ...]:
        """Freedoms node by node in ascending order of their numbers, three or six each."""
        numbers = self.mesh.numbers
        nodes = len(numbers)
        if rows not in (3 * nodes, 6 * nodes):
            message = f"the matrix has {rows} rows; {nodes} nodes have {3 * nodes} degrees of freedom, or {6 * nodes} with rotations"
            raise self._refusal(f"{message}{_hole(numbers)}; give a table of `freedoms`")
        return tuple((int(node), axis) for node in numbers for axis in range(1, rows // nodes + 1))

    def _check_nodes(self) -> None:
        """Refuse rows and elements of nodes that do not exist, and directions that are none."""
        numbers, faults = self.mesh.numbers, []
        known, place = set(numbers.tolist()), ("matrices", "nodes")
        missing = sorted({node for node, _ in self.labels} - known - self.inside)
        if missing:
            names = ", ".join(map(str, missing[:8])) + (" …" if len(missing) > 8 else "")
            message = f"the matrices have rows of nodes that are not among the {len(known)} nodes here: {names}{_hole(numbers)}"
            faults.append(self.located.fault(place, f"{message}; take the mesh that the matrices were made with"))
        unknown = sorted({node for kind in self.mesh.elements.values() for element in kind for node in element} - known)
        if unknown:
            message = (
                f"elements of the mesh have nodes that do not exist: {', '.join(map(str, unknown[:8]))}{_hole(numbers)}"
            )
            faults.append(self.located.fault(place, f"{message}; write the mesh again, with all its nodes"))
        refuse(faults)

    @property
    def inside(self) -> set[int]:
        """Numbers of rows without a node: incompatible modes, and stretches of knots of shells."""
        stretches = set() if self.shells is None else {knot.stretch for knot in self.shells.knots.values()}
        return calculix.internal_nodes(self.labels, self.mesh) | stretches

    def model(self) -> tuple[FiniteElementModel, NodeSets]:
        """The model, and its node sets."""
        self._check_nodes()
        mesh, labels, length, inside = self.mesh, self.labels, self.length, self.inside
        used = sorted({node for node, _ in labels} - inside)
        place = {node: k for k, node in enumerate(used)}
        freedoms = np.full((len(used), 6), -1, dtype=np.int64)
        for row, (node, axis) in enumerate(labels):
            if node not in inside:
                freedoms[place[node], axis - 1] = row
        position = mesh.places[np.searchsorted(mesh.numbers, used)] * length
        scale = sp.diags_array(np.where(np.array([axis for _, axis in labels]) > 3, length, 1.0))
        # K in N/m for translations: mass/s²; a turn brings a length
        K, M = (scale @ each.ordered(labels) @ scale * self.mass_unit for each in (self.stiffness, self.mass))
        self._check_matrices(sp.csc_array(K), sp.csc_array(M))
        mass = from_matrix(position, freedoms, sp.csc_array(M))
        motion, stands_for = sp.csr_array(sp.eye_array(len(labels))), {}
        if self.shells is not None:
            following = followers(self.shells, labels, position, freedoms, place, length)
            freedoms = np.concatenate([freedoms, following.freedoms])
            position = np.concatenate([position, following.position])
            motion = sp.csr_array(sp.vstack([motion, following.motion]))
            place |= {node: len(used) + k for k, node in enumerate(following.numbers)}
            used, stands_for = [*used, *following.numbers], following.stands_for
        dropped = len(mesh.numbers) - len(used)
        notes = (f"{dropped} nodes of the mesh have no rows in the matrices and were left out",) if dropped else ()
        incompatible = len(calculix.internal_nodes(labels, mesh))
        notes += (
            (f"{incompatible} incompatible modes of elements C3D8I are rows without a node",) if incompatible else ()
        )
        notes += mesh.notes if self.shells is None else (*mesh.notes, *self.shells.notes)
        sets = {
            name: np.array(sorted({place[node] for node in members if node in place}), dtype=np.int64)
            for name, members in mesh.sets.items()
        }
        model = FiniteElementModel(
            name=self.located.record.name,
            node_ids=np.array(used, dtype=np.int64),
            position=position,
            freedoms=freedoms,
            stiffness=sp.csc_array(K),
            mass=mass,
            expansion=motion,
            stands_for=stands_for,
            notes=notes,
        )
        return self._in_nodes(lambda: self._with_solids(model, place)), sets

    def _with_solids(self, model: FiniteElementModel, place: Mapping[int, int]) -> FiniteElementModel:
        """The model with its solids: their stress, and pictures. Raises FormatError too."""
        mesh, blocks = self.mesh, {}
        if all(node in place for kind in mesh.elements.values() for element in kind for node in element):
            blocks = calculix.blocks_of(mesh, place, model.position, calculix.incompatible_rows(self.labels, mesh))
        if bad := calculix.first_inverted(blocks):
            raise self._refusal(f"{bad}: their nodes are in another order, or a node was moved", "nodes")
        pressure = self.mass_unit / self.length  # mass / (length s²)
        return with_elements(model, mesh, blocks, place, pressure, self.length)

    def _check_matrices(self, K: Sparse, M: Sparse) -> None:
        faults = []
        for key, matrix in (("stiffness", K), ("mass", M)):
            problem = unsymmetric(matrix, key) if np.all(np.isfinite(matrix.data)) else ""
            if not np.all(np.isfinite(matrix.data)):
                problem = f"the {key} matrix has entries that are not finite numbers"
            if problem:
                faults.append(self.located.fault(("matrices", key), problem))
        held = np.flatnonzero(np.abs(K.diagonal()) > HELD)
        if len(held):
            node, axis = self.labels[held[0]]
            message = f"{len(held)} rows are held by boundary conditions (node {node}, direction {axis}, for one: "
            message += f"{K.diagonal()[held[0]]:.3g}); remove all supports before the matrices are written"
            faults.append(self.located.fault(("matrices", "stiffness"), message))
        refuse(faults)


def _fault(error: FormatError, path: Path, key: str) -> ModelError:
    return ModelError(Fault(str(error.file or path), int(error.line), 1, f"matrices.{key}", error.message))


def _hole(numbers: Whole) -> str:
    """Where the numbering of nodes has a hole."""
    gaps = np.flatnonzero(np.diff(numbers) > 1)
    if not len(gaps):
        return ""
    before = int(numbers[gaps[0]])
    more = f" and {len(gaps) - 1} more" if len(gaps) > 1 else ""
    return f"; the numbers of the nodes have a hole after {before} (the next is {int(numbers[gaps[0] + 1])}){more}"
