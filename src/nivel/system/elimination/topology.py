"""The graph of a machine: bodies joined by joints, a spanning tree of it, and the joints that are cut to open its loops.

Only joints whose relative motion can be written with joint coordinates carry a body in the tree; all others, and those that close a loop,
stay constraints. The tree keeps as many constraint rows as it can, so the fewest are left (a maximum spanning tree, Prim 1957). Of joints
with equally many rows it takes the one nearest to the ground first: the rows that are left act through short paths.

A joint that slides along a beam carries its body on all nodes of the beam. It may be the root of what no other joint carries from the
ground, in place of one that is free in space, as long as no node of the beam hangs on its body itself.
"""

import heapq
from collections.abc import Collection, Sequence
from typing import Final

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.kernels.record.record import NONE, Constraints, Tree
from nivel.lazy import Struct
from nivel.system.tables import zeros

FREE: Final = -1


def carries(kind: str) -> bool:
    """Whether a joint of this kind may carry a body on another one."""
    return JOINTS[kind].tree is not None and not JOINTS[kind].rail


class Edge(Struct):
    """A joint between two bodies, by their numbers; the ground is the body after the last. rail : the nodes of a beam along which the first
    body may slide, where it may be carried by them."""

    name: str
    type: str
    first: int
    second: int
    rail: tuple[int, ...] = ()


class Branch(Struct):
    """How a body hangs in the tree: on `parent` by joint number `joint`, or FREE of it. turned : its joint's first body is the child. A
    slider hangs on nodes of its beam, and has the ground for its parent."""

    child: int
    parent: int
    joint: int
    turned: bool


class SpanningTree(Struct):
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
    """Tree of `bodies` bodies and the ground.

    kept : joints that stay constraints. weight : of the bodies, equal where they differ by round-off, as nodes of a beam do; what hangs on
    nothing gets its root at the heaviest. heavy_first : the tree carries heavy bodies first, whatever the rows, so loops are cut where
    forces are small.
    """
    weight = [float(f"{each:.9g}") for each in weight]
    around: list[list[int]] = [[] for _ in range(bodies + 1)]
    for k, edge in enumerate(edges):
        if carries(edge.type) and edge.name not in kept:
            around[edge.first].append(k)
            around[edge.second].append(k)
    branches: list[Branch] = []
    reached = [False] * (bodies + 1)
    lighter = (
        [min((weight[b] for b in (e.first, e.second) if b < bodies), default=0.0) for e in edges] if heavy_first else []
    )
    rank = [
        (-lighter[k] if heavy_first else 0.0, -len(JOINTS[edge.type].composition.rows)) for k, edge in enumerate(edges)
    ]
    _grow(bodies, 0, edges, around, reached, branches, rank)
    island = _islands(bodies, edges, around)
    roots = _sliding_roots(edges, kept, island, rank)
    sliding = {island[edges[k].first] for k in roots}
    for body in sorted(range(bodies), key=lambda b: -weight[b] if len(weight) else b):
        if not reached[body] and island[body] not in sliding:
            branches.append(Branch(body, bodies, FREE, turned=False))
            _grow(body, 1, edges, around, reached, branches, rank)
    while roots:
        k = next(k for k in roots if all(reached[node] for node in edges[k].rail))
        roots.remove(k)
        branches.append(Branch(edges[k].first, bodies, k, turned=True))
        _grow(edges[k].first, 1, edges, around, reached, branches, rank)
    carriers = {branch.joint for branch in branches}
    return SpanningTree(tuple(branches), tuple(k for k in range(len(edges)) if k not in carriers))


def _islands(bodies: int, edges: Sequence[Edge], around: Sequence[Sequence[int]]) -> list[int]:
    """For each body (then the ground) the number of the island of bodies that carry each other, the ground's being 0."""
    island = [-1] * (bodies + 1)
    for number, root in enumerate([bodies, *range(bodies)]):
        left = [root] if island[root] < 0 else []
        while left:
            body = left.pop()
            if island[body] < 0:
                island[body] = number
                left += [other for k in around[body] for other in (edges[k].first, edges[k].second)]
    return island


def _sliding_roots(
    edges: Sequence[Edge], kept: Collection[str], island: Sequence[int], rank: Sequence[tuple[float, int]]
) -> list[int]:
    """Joints whose first body is the root of its island and slides on nodes of others, none of which hangs on it: those of lowest rank."""
    chosen: list[int] = []
    hangs_on: dict[int, set[int]] = {}

    def depends(a: int, b: int) -> bool:
        return a == b or any(depends(c, b) for c in hangs_on.get(a, ()))

    for k in sorted(
        (k for k, edge in enumerate(edges) if edge.rail and edge.name not in kept), key=lambda k: (rank[k], k)
    ):
        own, rails = island[edges[k].first], {island[node] for node in edges[k].rail}
        if own != 0 and own not in hangs_on and not any(depends(rail, own) for rail in rails):
            hangs_on[own] = rails
            chosen.append(k)
    return chosen


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


def empty_tree(
    constraints: Constraints,
    nodes: int = 0,
    columns: int = 0,
    positions: int = 0,
    bundle: int = 0,
    bodies: int = 0,
    sliders: int = 0,
) -> Tree:
    """Work arrays for a tree of so many nodes, columns, positions, rows in its largest bundle, bodies (with the ground and frames at
    interfaces), sliders on beams; tables are empty."""
    empty = np.zeros(0, dtype=np.uint32)
    return Tree(
        node=empty.reshape(0, 6),
        place=empty.reshape(0, 2),
        number=np.zeros((nodes, 7)),
        first=np.zeros((nodes, 3, 3)),
        marker=empty,
        turning=empty,
        rows=constraints,
        carried=empty.reshape(0, 2),
        reaction=empty.reshape(0, 3),
        part=empty.reshape(0, 4),
        part_start=empty,
        path=empty.reshape(0, 2),
        path_start=empty,
        row_blocks=empty,
        bundle=np.zeros(1, dtype=np.uint32),
        counted=empty.reshape(0, 2),
        turn=np.zeros((0, 2)),
        slider=empty.reshape(0, 2),
        slider_of=empty,
        **zeros("theta own_theta", nodes, 4),
        own=np.zeros((nodes, 3)),
        size=np.ones(1),
        positions=np.array([positions], dtype=np.uint32),
        axes=np.zeros((3, 3)),
        **zeros("arm alpha0 Rddot0", bodies, 3),
        **zeros("column U", columns, 6),
        element=np.full((sliders, 2), NONE, dtype=np.uint32),
        frame=np.zeros((sliders, 28)),
        jump=np.zeros((sliders, 6)),
        before=np.zeros((sliders, 12)),
        inertia=np.zeros((bodies, 27)),
        **zeros("Dinv root change", columns),
        **zeros("wrench delta", bodies, 6),
        load=np.zeros((bundle, bodies, 6)),
        **zeros("state moved", positions),
        small=np.zeros((6, 7)),
    )
