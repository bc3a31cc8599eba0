"""Joints of a spanning tree that move a body: those on its way to the ground, and where it slides along a beam those of nodes."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from nivel.kernels.record.record import POINT_ON_BEAM, Record
from nivel.system.beams.tangent import rail_of
from nivel.system.joints.rails import stretches

# where sliders are, (node of the tree, at which nodes of its beam), and the nodes of the tree that move a body then
Way = tuple[frozenset[tuple[int, int]], frozenset[int]]


class Carrying:
    """What carries the bodies of a tree."""

    def __init__(self, record: Record) -> None:
        self._ways: dict[int, tuple[Way, ...]] = {}
        for n, (child, parent, *_) in enumerate(record.tree.node.tolist()):
            rail = rail_of(record, n)
            turned = record.tree.node[n, 2] != POINT_ON_BEAM
            self._ways[child] = self._sliding(n, stretches(rail, turned=turned)) if rail else self._hanging(n, parent)

    def of(self, body: int) -> frozenset[int]:
        """All nodes of the tree that may ever move a body."""
        return frozenset().union(*(nodes for _, nodes in self._of(body)))

    def pairs(self, bodies: Iterable[int]) -> set[tuple[int, int]]:
        """Nodes of the tree, the earlier one first, that move one of these bodies each at one and the same place of all sliders."""
        return {pair for _, nodes in self._together(bodies) for pair in combinations(sorted(nodes), 2)}

    def _of(self, body: int) -> tuple[Way, ...]:
        return self._ways.get(body, ((frozenset(), frozenset()),))

    def _hanging(self, n: int, parent: int) -> tuple[Way, ...]:
        return tuple((where, nodes | {n}) for where, nodes in self._of(parent))

    def _sliding(self, n: int, places: Iterable[tuple[int, ...]]) -> tuple[Way, ...]:
        out: list[Way] = []
        for k, nodes in enumerate(places):
            out += self._together(nodes, (frozenset({(n, k)}), frozenset({n})))
        return tuple(out)

    def _together(self, bodies: Iterable[int], own: Way = (frozenset(), frozenset())) -> set[Way]:
        ways = {own}
        for body in bodies:
            ways = {_both(a, b) for a in ways for b in self._of(body) if _agree(a, b)}
        return ways


def _agree(a: Way, b: Way) -> bool:
    """Whether no slider is at two places."""
    places = dict(a[0])
    return all(places.get(slider, k) == k for slider, k in b[0])


def _both(a: Way, b: Way) -> Way:
    return a[0] | b[0], a[1] | b[1]
