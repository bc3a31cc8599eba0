"""A finite-element model: nodes, freedoms, stiffness, mass, and what knows of stress."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.model.mass import Mass, Sparse, rigid_modes
from nivel.lazy import dataclass, field, replace

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

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


@dataclass(frozen=True)
class FiniteElementModel:
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

    def changed(self, **changes) -> FiniteElementModel:
        """A copy in which `changes` hold."""
        return replace(self, **changes)


def numbered(has: NDArray[np.bool_]) -> Whole:
    """(n, 6) consecutive numbers of the freedoms that nodes have, node by node."""
    out = np.full(has.shape, -1, dtype=np.int64)
    out[has] = np.arange(np.count_nonzero(has))
    return out
