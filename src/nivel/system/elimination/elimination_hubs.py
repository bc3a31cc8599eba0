"""Bodies that the rows of a joint wait for when the tangent is eliminated, so that a hub with many joints makes no fill.

The pivots of the rows of some joints are regular when these rows, restricted to the bodies eliminated so far, are independent. A row that
is a matter of its bodies alone does not change when they move together, so G_a = -G_p X: the rows of one joint are as independent on one of
its two bodies alone as on both. Along a tree each joint therefore waits for its outer body only. What closes a loop is independent of the
joints of the loop only on all of its bodies together, and waits for all: the idea of the articulated body (Featherstone 2008, §7), for any
order of elimination.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping

GROUND = -1


def waiting(bodies: Mapping[int, Collection[int]], grounded: Collection[int] = ()) -> dict[int, set[int]]:
    """Groups of bodies that each group of constraints waits for: `after` of `nivel.system.elimination.factor_plan.plan_factor`.

    bodies : the bodies of each group of constraints. grounded : groups that also refer to the ground, in which alone a constraint on the
    absolute motion of two or more bodies differs from one on their relative motion; groups with one body do so anyway.
    """
    ends = {g: set(of) | ({GROUND} if g in grounded or len(of) == 1 else set()) for g, of in bodies.items()}
    outer, inner = _tree(ends)
    return {g: {outer[g]} if g in outer else _loop(of, inner) for g, of in ends.items()}


def _tree(ends: Mapping[int, set[int]]) -> tuple[dict[int, int], dict[int, int | None]]:
    """Outer body of each joint of a spanning tree, breadth first from the ground; and the next body inwards from each (None: a root)."""
    meeting: dict[int, list[int]] = {}
    for g, of in ends.items():
        for body in of:
            meeting.setdefault(body, []).append(g)
    outer: dict[int, int] = {}
    inner: dict[int, int | None] = {}
    for root in sorted(meeting):  # the ground, if any joint has it, is the first
        if root in inner:
            continue
        inner[root] = None
        queue = deque([root])
        while queue:
            body = queue.popleft()
            for g in meeting[body]:
                (other,) = ends[g] - {body} if len(ends[g]) == 2 else (body,)
                if other not in inner:
                    inner[other] = body
                    outer[g] = other
                    queue.append(other)
    return outer, inner


def _loop(ends: Collection[int], inner: Mapping[int, int | None]) -> set[int]:
    """Bodies on the ways between the ends, up to where all ways have met; all up to the roots if they never do."""
    ways = [_way(body, inner) for body in ends]
    common = set.intersection(*(set(way) for way in ways)) if ways else set()
    meeting = next((body for body in ways[0] if body in common), None) if ways else None
    loop = {body for way in ways for body in (way if meeting is None else way[: way.index(meeting) + 1])}
    return loop - {GROUND}


def _way(body: int, inner: Mapping[int, int | None]) -> list[int]:
    way = []
    following: int | None = body
    while following is not None:
        way.append(following)
        following = inner[following]
    return way
