"""A finite-element model: nodes, freedoms, stiffness, mass, and what knows of stress.

Mass of a finite-element model: what moves where, so that inertia needs no look at elements.
Two kinds. `PointMass` is a cloud of points that carry mass; every invariant of a flexible body is then a plain sum over
points, and all identities between the invariants hold to round-off. nivel's own beams and solids are of this kind, with
consistent and with lumped mass. `MatrixMass` is a matrix of another program of which no more is known.
"""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from nivel.lazy import Struct, field, replace
from nivel.machine.core.vectors import Array, Whole

# a scipy.sparse.csr_array or csc_array with two dimensions; SciPy's own types know neither their shape nor their elements
Sparse = Any


class PointMass(Struct):
    """Points that carry mass.

    position : (p, 3) [m]
    shape : (3 p, N) displacement of the points for the N freedoms of the model, x, y, z of the first point first
    weight : (p, p) [kg] symmetric; diagonal where masses are at points, else the scalar mass matrix ∫ ρ N_a N_b dV

    The kinetic energy is ½ Σ_pq weight_pq v_p · v_q. `shape` moves the points rigidly for rigid motions of the nodes.
    Beams: points at the four Gauss stations of an element and, at each, four points of its section that have the mass
    and the moments of inertia of the section: rotary inertia and torsion included, exactly the consistent mass matrix.
    Solids: the points are the nodes.
    """

    position: Array
    shape: Sparse
    weight: Sparse

    @property
    def matrix(self) -> Sparse:
        """(N, N) [kg, kg m, kg m²]"""
        weight = sp.csr_array(sp.kron(self.weight, sp.eye_array(3)))
        return sp.csc_array(self.shape.T @ weight @ self.shape)

    def transformed(self, transformation: Sparse) -> "PointMass":
        """The same with freedoms q, where those of now are `transformation` q."""
        return replace(self, shape=sp.csr_array(self.shape @ transformation))

    def scaled(self, factor: float) -> "PointMass":
        """The same with all masses times `factor`."""
        return replace(self, weight=self.weight * factor)


class MatrixMass(Struct):
    """A mass matrix of which no more is known, (N, N).

    position : (n, 3) [m] nodes; freedoms : (n, 6) numbers of the rows of x, y, z and the turns about x, y, z of every
    node, -1 where there is none.
    transformation : (N, N') what the matrix is multiplied with from both sides (interfaces that tie nodes), or None.
    """

    position: Array
    freedoms: NDArray[np.int64]
    full: Sparse
    transformation: Sparse | None = None

    @property
    def matrix(self) -> Sparse:
        """(N', N')"""
        if self.transformation is None:
            return self.full
        return sp.csc_array(self.transformation.T @ self.full @ self.transformation)

    def transformed(self, transformation: Sparse) -> "MatrixMass":
        """The same with freedoms q, where those of now are `transformation` q."""
        before = self.transformation
        return replace(self, transformation=transformation if before is None else sp.csr_array(before @ transformation))


Mass = PointMass | MatrixMass


def from_matrix(position: Array, freedoms: NDArray[np.int64], matrix: Sparse) -> Mass:
    """A PointMass where `matrix` is one: x, y and z of nodes have the same mass and nothing couples them; else a MatrixMass."""
    rows_without_node = matrix.shape[0] > np.count_nonzero(freedoms >= 0)
    if np.any(freedoms[:, 3:] >= 0) or np.any(freedoms[:, :3] < 0) or rows_without_node:
        return MatrixMass(position, freedoms, matrix)
    blocks = [[matrix[freedoms[:, a]][:, freedoms[:, b]] for b in range(3)] for a in range(3)]
    scalar = sp.csr_array((blocks[0][0] + blocks[1][1] + blocks[2][2]) / 3.0)
    scale = np.abs(scalar.data).max() if scalar.nnz else 0.0
    for a in range(3):
        for b in range(3):
            rest = blocks[a][b] - scalar if a == b else blocks[a][b]
            if rest.nnz and np.abs(rest.data).max() > 1e-9 * scale:
                return MatrixMass(position, freedoms, matrix)
    return PointMass(position, at_nodes(freedoms, matrix.shape[0]), scalar)


def at_nodes(freedoms: NDArray[np.int64], count: int) -> Sparse:
    """(3 n, count): the displacements of the nodes as points; a direction without a freedom does not move."""
    rows = np.flatnonzero(freedoms[:, :3].ravel() >= 0)
    columns = freedoms[:, :3].ravel()[rows]
    return sp.csr_array((np.ones(len(rows)), (rows, columns)), shape=(3 * len(freedoms), count))


def lumped(mass: Mass) -> PointMass:
    """Mass at the nodes alone: every node gets the sum of its row of the translational mass, scaled to the same total.

    Rows whose sum is not positive (corners of quadratic elements) are avoided by taking the diagonal scaled to the total
    (Hinton, Rock & Zienkiewicz 1976). Rotary inertia of the nodes is left out.
    """
    if isinstance(mass, PointMass):
        sums = np.asarray(mass.weight.sum(axis=1)).ravel()
        total = sums.sum()
        if sums.min() <= 0.0:
            sums = mass.weight.diagonal()
            sums = sums * (total / sums.sum())
        return replace(mass, weight=sp.csr_array(sp.diags_array(sums)))
    scalar = scalar_part(mass)
    sums = np.asarray(scalar.sum(axis=1)).ravel()
    shape = at_nodes(mass.freedoms, mass.full.shape[0])
    point = PointMass(mass.position, shape, sp.csr_array(sp.diags_array(sums)))
    return point if mass.transformation is None else point.transformed(mass.transformation)


def scalar_part(mass: MatrixMass) -> Sparse:
    """(n, n) [kg] mean of the x, y and z parts of the translational mass of nodes."""
    points = at_nodes(mass.freedoms, mass.full.shape[0])
    return sp.csr_array(sum(S @ mass.full @ S.T for S in (points[a::3] for a in range(3))) / 3.0)


def rigid_modes(position: Array, freedoms: NDArray[np.int64], count: int, about: Array | None = None) -> Array:
    """(count, 6): displacements for unit translations along x, y, z and unit turns about axes through `about`.

    position : (n, 3) [m]; freedoms : (n, 6) row of each freedom of the nodes, -1 where there is none; about : (3,) [m],
    default the origin.
    """
    R = np.zeros((count, 6))
    x = position - (0.0 if about is None else about)
    has = freedoms >= 0
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        R[freedoms[has[:, a], a], a] = 1.0
        R[freedoms[has[:, 3 + a], 3 + a], 3 + a] = 1.0
        # a turn about a moves c by x_b and b by -x_c
        R[freedoms[has[:, c], c], 3 + a] = x[has[:, c], b]
        R[freedoms[has[:, b], b], 3 + a] = -x[has[:, b], c]
    return R


AXES = ("x", "y", "z", "rx", "ry", "rz")


class Elements(Protocol):
    """Elements whose stress is known. Displacements are (F, n): of all freedoms of the nodes, n fields at once."""

    def station_nodes(self) -> Whole:
        """(s,) the node at which each stress station is."""
        ...

    def station_labels(self) -> tuple[str, ...]:
        """What tells the stations at one node apart; empty where there is one at each node."""
        ...

    def stress(self, displacement: Array) -> Array:
        """(s, 6, n) [Pa] stress xx, yy, zz, xy, yz, zx at the stations."""
        ...

    def strain(self, displacement: Array) -> Array:
        """(s, 6, n) strain in the same order; shear as γ = 2 ε."""
        ...

    def geometric_stiffness(self, displacement: Array, modes: Array) -> Array:
        """(k, n, n) ∫ ∇φ_iᵀ σ ∇φ_j dV of the stress that each displacement (F, k) causes, for `modes` (F, n); symmetric."""
        ...


class FiniteElementModel(Struct):
    """A linear elastic body that nothing holds.

    node_ids : (n,) numbers by which people know the nodes; position : (n, 3) [m]
    freedoms : (n, 6) numbers of the freedoms x, y, z, rx, ry, rz of the nodes among all F; -1 where a node has none.
    stiffness : (N, N) and mass: of the N independent freedoms.
    expansion : (F, N) all freedoms from the independent ones: the identity until surfaces are tied to reference nodes.
    Its first N rows are then the independent ones, if nodes follow others from the start, as those of shells.
    stands_for : of nodes that follow others, or that others follow: the places of the nodes that are tied in their place.
    names : of nodes, by name → place among the nodes.
    triangles : (t, 3), lines : (l, 2) places of nodes, for pictures. solids : (e, 4 or 10) tetrahedra, for export.
    volume : [m³] of the meshed solid, or None. notes : what was assumed while reading, for the report.
    """

    name: str
    node_ids: Whole
    position: Array
    freedoms: Whole
    stiffness: Sparse
    mass: Mass
    expansion: Sparse
    names: Mapping[str, int] = field(default_factory=dict)
    stands_for: Mapping[int, tuple[int, ...]] = field(default_factory=dict)
    elements: Elements | None = None
    triangles: Whole = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    lines: Whole = field(default_factory=lambda: np.zeros((0, 2), dtype=np.int64))
    solids: Whole = field(default_factory=lambda: np.zeros((0, 4), dtype=np.int64))
    volume: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number N of independent freedoms."""
        return self.stiffness.shape[0]

    @property
    def size(self) -> float:
        """[m] diagonal of the box around the nodes."""
        return float(np.linalg.norm(np.ptp(self.position, axis=0)))

    def rigid_modes(self, about: Array | None = None) -> Array:
        """(N, 6) of the independent freedoms: unit translations and turns about axes through `about` (default the origin).

        The independent freedoms are nodes' freedoms: their rows of the expansion are rows of the identity.
        """
        full = rigid_modes(self.position, self.freedoms, self.expansion.shape[0], about)
        return full[self.independent]

    @property
    def independent(self) -> Whole:
        """(N,) which of all freedoms the independent ones are."""
        if self.expansion.shape[0] == self.expansion.shape[1] == self.expansion.nnz:
            return np.arange(self.count)
        counts = np.diff(self.expansion.indptr)
        single = np.flatnonzero(counts == 1)
        at = self.expansion.indptr[single]
        plain = single[self.expansion.data[at] == 1.0]
        column = self.expansion.indices[self.expansion.indptr[plain]]
        out = np.full(self.count, -1, dtype=np.int64)
        out[column[::-1]] = plain[::-1]
        return out

    def node_motion(self, vectors: Array) -> Array:
        """(n, 6, k) displacements and turns of the nodes for (N, k) fields; NaN where a node has no such freedom."""
        full = self.expansion @ vectors
        out = np.full((*self.freedoms.shape, vectors.shape[1]), np.nan)
        has = self.freedoms >= 0
        out[has] = full[self.freedoms[has]]
        return out

    def changed(self, **changes) -> "FiniteElementModel":
        """A copy in which `changes` hold."""
        return replace(self, **changes)


def numbered(has: NDArray[np.bool_]) -> Whole:
    """(n, 6) consecutive numbers of the freedoms that nodes have, node by node."""
    out = np.full(has.shape, -1, dtype=np.int64)
    out[has] = np.arange(np.count_nonzero(has))
    return out
