"""The graph of a machine: bodies joined by joints, a spanning tree of it, and the joints that are cut to open its loops.

Only joints whose relative motion can be written with joint coordinates carry a body in the tree; all others, and those that close a loop,
stay constraints. The tree keeps as many constraint rows as it can, so the fewest are left (a maximum spanning tree, Prim 1957). Of joints
with equally many rows it takes the one nearest to the ground first: the rows that are left act through short paths.
"""

from __future__ import annotations

import heapq
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final

# constraint rows of the joints that may carry a body
CARRIERS: Final[dict[str, int]] = {
    "revolute": 5,
    "translational": 5,
    "cylindrical": 4,
    "screw": 5,
    "universal": 4,
    "spherical": 3,
    "planar": 3,
    "fixed": 6,
}
FREE: Final = -1


@dataclass(frozen=True)
class Edge:
    """A joint between two bodies, by their numbers; the ground is the body after the last."""

    name: str
    type: str
    first: int
    second: int


@dataclass(frozen=True)
class Branch:
    """How a body hangs in the tree: on `parent` by joint number `joint`, or FREE of it. turned : its joint's first body is the child."""

    child: int
    parent: int
    joint: int
    turned: bool


@dataclass(frozen=True)
class SpanningTree:
    """Branches from the ground outwards, every parent before its children; numbers of the joints that stay constraints."""

    branches: tuple[Branch, ...]
    cut: tuple[int, ...]


def spanning_tree(
    bodies: int,
    edges: Sequence[Edge],
    kept: Collection[str] = (),
    weight: Sequence[float] = (),
    *,
    heavy_first: bool = False,
) -> SpanningTree:
    """Tree of `bodies` bodies and the ground. kept : joints that stay constraints. weight : of the bodies; what hangs on nothing gets its
    root at the heaviest. heavy_first : the tree carries heavy bodies first, whatever the rows, so loops are cut where forces are small.
    """
    around: list[list[int]] = [[] for _ in range(bodies + 1)]
    for k, edge in enumerate(edges):
        if edge.type in CARRIERS and edge.name not in kept:
            around[edge.first].append(k)
            around[edge.second].append(k)
    branches: list[Branch] = []
    reached = [False] * (bodies + 1)
    lighter = (
        [min((weight[b] for b in (e.first, e.second) if b < bodies), default=0.0) for e in edges] if heavy_first else []
    )
    rank = [(-lighter[k] if heavy_first else 0.0, -CARRIERS.get(edge.type, 0)) for k, edge in enumerate(edges)]
    _grow(bodies, 0, edges, around, reached, branches, rank)
    for body in sorted(range(bodies), key=lambda b: -weight[b] if len(weight) else b):
        if not reached[body]:
            branches.append(Branch(body, bodies, FREE, turned=False))
            _grow(body, 1, edges, around, reached, branches, rank)
    carriers = {branch.joint for branch in branches}
    return SpanningTree(tuple(branches), tuple(k for k in range(len(edges)) if k not in carriers))


def _grow(
    root: int,
    depth: int,
    edges: Sequence[Edge],
    around: Sequence[Sequence[int]],
    reached: list[bool],
    branches: list[Branch],
    rank: Sequence[tuple[float, int]],
) -> None:
    """Add all that hangs on `root`: always the joint of lowest rank next, of these the one nearest to the root."""
    heap: list[tuple[tuple[float, int], int, int, int]] = []

    def offer(body: int, at: int) -> None:
        reached[body] = True
        for k in around[body]:
            heapq.heappush(heap, (rank[k], at, k, body))

    offer(root, depth)
    while heap:
        _, at, k, parent = heapq.heappop(heap)
        turned = edges[k].second == parent
        child = edges[k].first if turned else edges[k].second
        if not reached[child]:
            branches.append(Branch(child, parent, k, turned))
            offer(child, at + 1)
