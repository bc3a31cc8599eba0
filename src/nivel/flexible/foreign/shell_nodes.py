"""Followers among the nodes of shells: a node of shells follows its nodes through the thickness, and nodes of a knot follow it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import scipy.sparse as sp

from nivel.flexible.foreign.matrix import Label
from nivel.flexible.foreign.shells import Expansion
from nivel.flexible.model.mass import Sparse
from nivel.flexible.model.model import Array, Whole
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
        stands_for |= {
            place[middle]: ends for middle in layers[1:-1]
        }  # free, so that the thickness can change as a plate bends
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
