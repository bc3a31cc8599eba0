"""Angles of the joints of a tree: their joint coordinates count whole turns, so nobody need follow them from step to step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from nivel.kernels.bodies.coordinate import ALONG, CROSS_FIRST, CROSS_SECOND, LAST_ANGLE
from nivel.kernels.record.record import U1, U2, Coordinates
from nivel.system.states.joint_start import Node
from nivel.system.states.tree_nodes import tree_joint
from nivel.system.system import Array
from nivel.system.tables import index_array

# what an angle is for a joint that carries its first body
BACKWARDS: Final = {CROSS_FIRST: CROSS_SECOND, CROSS_SECOND: CROSS_FIRST}


@dataclass(frozen=True)
class Turns:
    """`counted` angles (coordinate, position in y), each being sign q + offset, as rows of `number`; `followed` are all others."""

    counted: U2
    number: Array
    followed: U1


def turns(coordinates: Coordinates, nodes: Sequence[Node], q: Array) -> Turns:
    """How the angles of `coordinates`, whose `reference` is that at the start, follow from joint coordinates, q at the start.

    Angles that every evaluation measures, and places along beams, are followed as in all coordinates.
    """
    carried = {frozenset((node.near, node.far)): node for node in nodes}
    counted, numbers, followed = [], [], []
    active = set(coordinates.active.tolist())
    for k, (kind, first, second, _) in enumerate(coordinates.what.tolist()):
        if kind > LAST_ANGLE:
            followed += [k] if kind == ALONG else []
            continue
        node = carried.get(frozenset((first, second)))
        place = None if node is None or k in active else _place(kind, node, first == node.near)
        if node is None or place is None:
            followed.append(k)
            continue
        sign, position = 1.0 if first == node.near else -1.0, node.position + place
        counted.append((k, position))
        numbers.append((sign, coordinates.reference[k] - sign * q[position]))
    return Turns(index_array(counted, 2), np.array(numbers, dtype=float).reshape(-1, 2), index_array(followed, 1))


def _place(kind: int, node: Node, forwards: bool) -> int | None:
    """Where among the positions of the node's joint an angle of this kind stands; a joint that is `forwards` carries its second body."""
    return tree_joint(node.kind).angles.get(kind if forwards else BACKWARDS.get(kind, kind))
