"""Unknowns of implicit methods in groups that depend on each other as a whole: what the plan of their matrix is made of."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.bodies.coordinate import ALONG, LEAN_X, LEAN_Y, TWIST
from nivel.kernels.elements import friction as columns
from nivel.kernels.record.record import MODAL, NONE, POINT_ON_BEAM, Record
from nivel.lazy import nivel
from nivel.system.builder import NOTHING
from nivel.system.system import System

# where sliders are, (node of the tree, at which nodes of its beam), and the nodes of the tree that move a body then
Way = tuple[frozenset[tuple[int, int]], frozenset[int]]


class Carrying:
    """What carries the bodies of a tree."""

    def __init__(self, record: Record) -> None:
        self._ways: dict[int, tuple[Way, ...]] = {}
        for n, (child, parent, *_) in enumerate(record.tree.node.tolist()):
            rail = nivel.system.beam_tables.rail_of(record, n)
            turned = record.tree.node[n, 2] != POINT_ON_BEAM
            self._ways[child] = (
                self._sliding(n, nivel.elements.joints.on_beams.stretches(rail, turned=turned))
                if rail
                else tuple((where, nodes | {n}) for where, nodes in self._of(parent))
            )

    def of(self, body: int) -> frozenset[int]:
        """All nodes of the tree that may ever move a body."""
        return frozenset().union(*(nodes for _, nodes in self._of(body)))

    def pairs(self, bodies: Iterable[int]) -> set[tuple[int, int]]:
        """Nodes of the tree, the earlier one first, that move one of these bodies each at one and the same place of all sliders."""
        return {pair for _, nodes in self._together(bodies) for pair in combinations(sorted(nodes), 2)}

    def _of(self, body: int) -> tuple[Way, ...]:
        return self._ways.get(body, ((frozenset(), frozenset()),))

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


Index = NDArray[np.integer]


def unknown_groups(
    system: System, velocities: int, row: Index, part: Index, coordinates: str
) -> tuple[list[int], list[bool], set[tuple[int, int]]]:
    """Sizes of the groups of unknowns, which are constraints, and which depend on each other: bodies, then modes of flexible ones (or all
    joint velocities as one), states of elements, joints, efforts of frictions with stiction."""
    record = system.record
    states, stiction = len(record.elements.state), frictions_with_stiction(system)
    normalised = {f"{name}.euler_parameters": body for body, name in enumerate(system.bodies)}
    owners = [system.row_owner[k] if k < system.machine_rows else system.rows[k] for k in row]
    joints = list(dict.fromkeys(owners))
    if coordinates == "relative":
        return _groups_of_tree(system, row, part)
    count = system.body_count
    modes = [int(last - first) for first, last in record.flexible.mode]
    moving = count + len(modes)
    velocities_of_body = [system.equations.velocities] * count
    of_joints = [owners.count(joint) for joint in joints]
    sizes = [*velocities_of_body, *modes, *[1] * states, *of_joints, *[1] * len(stiction)]
    constraint = [k >= moving + states for k in range(len(sizes))]
    number = {joint: moving + states + k for k, joint in enumerate(joints)}
    couples = {(body, count + f) for f, body in enumerate(record.flexible.body.tolist())}
    couples |= {(normalised[system.rows[k]], number[system.rows[k]]) for k in row if k >= system.machine_rows}
    bodies_of: dict[int, set[int]] = {}
    rows_of: dict[int, set[int]] = {}
    for k, _, _, body in part.tolist():
        bodies_of.setdefault(number[owners[k]], set()).add(body)
        rows_of.setdefault(number[owners[k]], set()).add(int(row[k]))
    for joint, bodies in bodies_of.items():
        couples |= {(body, joint) for body in _moved_by(system, bodies)}
        for together in _together(system, rows_of[joint], bodies):
            couples |= set(combinations(sorted(_moved_by(system, together)), 2))
    for each in system.coupled:
        groups = _moved_by(system, each.bodies) | {moving + state for state in each.states}
        couples |= set(combinations(sorted(groups), 2))
    couples |= _of_frictions(system, moving, number, partial(_moved_by, system))
    return sizes, constraint, couples


def _of_frictions(
    system: System, moving: int, number: Mapping[str, int], moved_by: Callable[[Iterable[int]], set[int]]
) -> set[tuple[int, int]]:
    """What depends on each other by frictions: efforts, what moves their bodies, and what their loads follow.

    moving : groups of velocities; states follow them. number : group of each joint that is a constraint. moved_by : the groups of
    velocities that move bodies.
    """
    first_effort = moving + len(system.record.elements.state) + len(number)
    effort = {k: first_effort + place for place, k in enumerate(frictions_with_stiction(system))}
    couples: set[tuple[int, int]] = set()
    for k, (bodies, states_of_load, joint) in enumerate(_frictions(system)):
        depending = [*(moving + state for state in states_of_load), *([number[joint]] if joint in number else [])]
        depending += [effort[k]] if k in effort else []
        first, count = system.record.friction.columns[k, [columns.FIRST, columns.COUNT]]
        if first == k:
            couples |= set(combinations([effort[k + a] for a in range(count)], 2))
        couples |= {(body, group) for body in moved_by(bodies) for group in depending}
        couples |= set(combinations(depending, 2))
    return couples


def integrals(system: System, constraint: list[bool]) -> list[int]:
    """Numbers of the groups that are states on which nothing depends; states stand before the groups of a `constraint`."""
    end = constraint.index(True) if True in constraint else len(constraint)
    return [end - len(system.states) + k for k, fact in enumerate(system.states) if fact.integral]


def _groups_of_tree(system: System, row: Index, part: Index) -> tuple[list[int], list[bool], set[tuple[int, int]]]:
    """The same of joint coordinates: velocities of the joint that carries each body, states of elements, joints that are cut.

    A velocity moves the bodies outwards of it, and its row has the forces on these; two of them meet where they have a body in common, or
    bodies between which a force or a joint that is cut acts.
    """
    record, nodes = system.record, system.record.tree.node.tolist()
    moving, states = len(nodes), len(record.elements.state)
    carrying = Carrying(record)
    owners = [system.row_owner[k] for k in row]
    joints = list(dict.fromkeys(owners))
    sizes = [last - first for *_, first, last in nodes] + [1] * states + [owners.count(joint) for joint in joints]
    sizes += [1] * len(frictions_with_stiction(system))
    constraint = [k >= moving + states for k in range(len(sizes))]
    bodies_of: dict[int, set[int]] = {}
    rows_of: dict[int, set[int]] = {}
    for k, _, _, body in part.tolist():
        joint = moving + states + joints.index(owners[k])
        bodies_of.setdefault(joint, set()).add(body)
        rows_of.setdefault(joint, set()).add(int(row[k]))
    couples: set[tuple[int, int]] = set()
    for child, *_ in nodes:
        couples |= carrying.pairs([child])
    together = {each for joint, bodies in bodies_of.items() for each in _together(system, rows_of[joint], bodies)}
    for bodies in {*(each.bodies for each in system.coupled), *together}:
        couples |= carrying.pairs(bodies)
    for each in system.coupled:
        own = sorted(moving + state for state in each.states)
        couples |= {(node, state) for body in each.bodies for node in carrying.of(body) for state in own}
        couples |= set(combinations(own, 2))
    for joint, bodies in bodies_of.items():
        couples |= {(node, joint) for body in bodies for node in carrying.of(body)}
    number = {joint: moving + states + k for k, joint in enumerate(joints)}

    def moved_by(bodies: Iterable[int]) -> set[int]:
        return {node for body in bodies for node in carrying.of(body)}

    for bodies, _, loading in _frictions(system):
        couples |= carrying.pairs(bodies)
        if loading and loading not in number:
            # the reaction of a joint that carries a body follows from everything
            return sizes, constraint, set(combinations(range(len(sizes)), 2))
    couples |= _of_frictions(system, moving, number, moved_by)
    return sizes, constraint, couples


def _together(system: System, rows: Iterable[int], bodies: Iterable[int]) -> Iterator[frozenset[int]]:
    """Sets of the `bodies` of these rows that their second derivatives join: all; but of the nodes that a slider may come by, it is at
    some neighbours at a time, and those that carry it go with it."""
    record = system.record
    coordinates, combination = record.coordinates, record.constraints.combination.tolist()
    terms = [
        int(record.constraints.term[n, 0])
        for row, first, last, *_ in combination
        if row in rows
        for n in range(first, last)
    ]
    ends = {
        q: record.markers.body[coordinates.part_marker[slice(*coordinates.start[q : q + 2])]].tolist() for q in terms
    }
    sliding = {
        q: int(q if coordinates.what[q, 0] == ALONG else coordinates.what[q, 3])
        for q in terms
        if ALONG <= coordinates.what[q, 0] <= TWIST
    }
    if not sliding or not set(rows) <= {row for row, *_ in combination}:
        yield frozenset(bodies)
        return
    always = {body for q in terms for body in (ends[q][:1] if q in sliding else ends[q])}
    yield frozenset(always)
    carried = set(record.tree.slider[:, 1].tolist())
    turned = any(coordinates.what[q, 0] in (LEAN_X, LEAN_Y, TWIST) for q in terms)
    for rail in {tuple(ends[q][1:]) for q, along in sliding.items() if along not in carried}:
        for nodes in nivel.elements.joints.on_beams.stretches(rail, turned=turned):
            yield frozenset(always.union(nodes))


def _moved_by(system: System, bodies: Iterable[int]) -> set[int]:
    """Groups of velocities that move these bodies, or frames at interfaces: of bodies, and behind them of the modes of flexible ones."""
    flexible, count = system.record.flexible, system.body_count
    flexible_of = {int(v): int(f) for f, v in flexible.frame} | {int(b): f for f, b in enumerate(flexible.body)}
    groups: set[int] = set()
    for body in bodies:
        if body in flexible_of:
            groups |= {int(flexible.body[flexible_of[body]]), count + flexible_of[body]}
        elif body != count:
            groups.add(body)
    return groups


def frictions_with_stiction(system: System) -> list[int]:
    """Numbers of the frictions whose efforts are unknowns."""
    if not system.frictions:
        return []
    return np.flatnonzero(
        np.isin(system.record.friction.columns[:, columns.MODEL], (columns.STICTION, columns.PATCH))
    ).tolist()


def _frictions(system: System) -> list[tuple[set[int], set[int], str]]:
    """Bodies, states, and the joint or coupling whose reaction is the load (empty: none), of each friction."""
    if not system.frictions:
        return []
    record = system.record
    out = []
    for index in record.friction.columns.tolist():
        start = record.coordinates.start[index[columns.COORDINATE] :]
        ends = record.coordinates.part_marker[start[0] : start[1]]
        bodies, loading = set(record.markers.body[ends].tolist()), ""
        if index[columns.JOINT] != NONE:
            loading = system.joints[index[columns.JOINT]]
        elif index[columns.ROW] != NONE:
            loading = system.row_owner[index[columns.ROW]]
        given = system.friction_loads.get(len(out), NOTHING)
        states = {index[columns.STATE]} - {NONE} | given.states
        out.append((bodies | given.bodies, states, loading))
    return out


# Names of the unknowns of implicit methods: what moves in a joint or a body, the states of forces, the rows of constraints, the efforts
# of frictions with stiction.

POSITIONS = tuple(f"{axis} of its position" for axis in "xyz")
TURNS = tuple(f"its turn about its {axis} axis" for axis in "xyz")


def unknown_name(system: System, number: int) -> str:
    """Unknown `number` of the iteration in words: a joint and its coordinate, a body and its direction, a friction, a constraint row."""
    record = system.record
    n, states = len(record.residual.vdot), len(record.newton.state)
    if number >= n + states + len(record.residual.row):
        return f"the effort of {system.frictions[record.residual.stiction[number - n - states - len(record.residual.row)]]}"
    if number >= n + states:
        return f"the constraint {system.rows[record.residual.row[number - n - states]]}"
    if number >= n:
        return f"the state {system.states[number - n].name}"
    if not len(record.tree.node):
        width = system.equations.velocities
        if number >= width * system.body_count:
            return f"the mode {system.modes[number - width * system.body_count]}"
        rates = tuple(f"its rotation coordinate {k}" for k in range(1, width - 2))
        directions = POSITIONS + (TURNS if len(system.map.turns) else rates)
        return f"{system.bodies[number // width]}, {directions[number % width]}"
    nodes = record.tree.node.tolist()
    of_node = next(node for node in nodes if node[4] <= number < node[5])
    child, _, kind, joint, first, _ = of_node
    if kind == MODAL:
        flexible = record.flexible.body.tolist().index(child)
        return f"the mode {system.modes[int(record.flexible.mode[flexible, 0]) + number - first]}"
    if joint >= len(system.joints):
        # an interface that carries its body stands for it
        body = next((node[0] for node in nodes if node[2] == MODAL and node[1] == child), child)
        return f"{system.bodies[body]}, free in space"
    name = system.tree_names[number]
    if name in system.layout.coordinates["joint_coordinate"]:
        return f"the joint {system.joints[joint]}, coordinate {name}"
    return f"the joint {system.joints[joint]}"
