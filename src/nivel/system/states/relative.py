"""Relative coordinates: the spanning tree of an assembled machine, its joint coordinates, and the rows that are left."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from nivel.kernels import record as kernels
from nivel.kernels.record import COMPLETE, NONE, Constraints, Markers, Record, Saddle
from nivel.kernels.record import Friction as FrictionTables
from nivel.machine.coordinate_reference import resolve
from nivel.machine.forces import Friction
from nivel.machine.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings import SimulationSettings
from nivel.system.elimination import plan
from nivel.system.states.joint_start import Node, joint_start
from nivel.system.system import Array, StateMap, System
from nivel.system.tables import index_array
from nivel.system.topology import FREE, Edge, SpanningTree, spanning_tree
from nivel.system.tree_tables import empty_tree

# numbers of the kernels' kinds of nodes, positions and velocities of each, and units of the positions
KINDS = {
    "revolute": (kernels.REVOLUTE, ("1",), 1),
    "translational": (kernels.TRANSLATIONAL, ("m",), 1),
    "cylindrical": (kernels.CYLINDRICAL, ("1", "m"), 2),
    "screw": (kernels.SCREW, ("1",), 1),
    "universal": (kernels.UNIVERSAL, ("1", "1"), 2),
    "spherical": (kernels.SPHERICAL, ("1",) * 4, 3),
    "planar": (kernels.PLANAR, ("m", "m", "1"), 3),
    "fixed": (kernels.FIXED, (), 0),
    "free": (kernels.FREE, ("m",) * 3 + ("1",) * 4, 6),
}


Index = NDArray[np.uint32]


def tree_of(machine: MachineRecord, settings: SimulationSettings) -> SpanningTree:
    """Spanning tree of `machine`. Joints that the settings name stay constraints, and those whose reaction loads a friction."""
    number = {body.name: k for k, body in enumerate(machine.bodies)} | {"ground": len(machine.bodies)}
    edges = [
        Edge(joint.name, joint.type, number[first], number[second])
        for joint, (first, second) in ((joint, _bodies_of(machine, joint)) for joint in machine.joints)
    ]
    loading = {
        resolve(force.coordinate, machine.joints)[0]
        for force in machine.forces
        if isinstance(force, Friction) and force.normal_load is None
    }
    weight = [body.mass or 0.0 for body in machine.bodies]
    return spanning_tree(len(machine.bodies), edges, {*settings.cut, *loading}, weight)


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers and state in the joint coordinates of the spanning tree."""
    old = absolute.record
    tree = tree_of(machine, settings)
    markers = _with_free_markers(old, tree)
    nodes = _nodes(machine, old, tree)
    columns = sum(KINDS[node.kind][2] for node in nodes)
    positions = sum(len(KINDS[node.kind][1]) for node in nodes)
    nodes = [replace(node, velocity=positions + node.velocity) for node in nodes]
    carried = {machine.joints[node.joint].name for node in nodes if node.joint != FREE}
    left = np.array([owner not in carried for owner in absolute.row_owner], dtype=bool)
    rows = np.flatnonzero(left).astype(np.uint32)
    constraints, reports = _chosen(old, left)
    own_rows, _ = _chosen(old, ~left)
    start = joint_start(absolute, y, markers, nodes, machine)
    parts = _parts(old, rows)
    count = len(rows) + len(old.friction.columns)
    touched: list[set[int]] = [set() for _ in range(count)]
    for row, _, _, body in parts:
        touched[row].add(body)
    branch_of = {node.child: n for n, node in enumerate(nodes)}
    blocks, path, path_start = _blocks(nodes, [_path(nodes, branch_of, bodies) for bodies in touched], positions)
    saddle = _saddle(old, rows, blocks, [absolute.row_owner[row] for row in rows], columns)
    record = old._replace(
        markers=markers,
        constraints=constraints,
        saddle=saddle,
        outputs=old.outputs._replace(combination=reports),
        friction=_friction(old, blocks, len(rows), columns),
        tree=empty_tree(old.constraints, len(nodes), columns, positions)._replace(
            node=_node_table(nodes, positions),
            place=index_array([(node.position, node.velocity) for node in nodes], 2),
            size=np.array([absolute.size]),
            rows=own_rows,
            marker=_markers_in_use(old, nodes),
            number=start.number,
            theta=start.theta,
            part=index_array(parts, 4),
            part_start=_starts([part[0] for part in parts], count),
            path=path,
            path_start=path_start,
            **_reactions(absolute, machine, nodes),
        ),
    )
    record.hooks.address[COMPLETE] = import_module("nivel.kernels.carried").complete.address
    x = np.zeros(len(old.elements.state) + 2)
    system = replace(absolute, record=record, state_map=_map(nodes, positions, len(x)))
    # the freedoms of the tree less those of the machine (points that do not turn included) are the independent rows that are left
    independent = columns - (6 * absolute.body_count - rank)
    return system.known_rank(independent), np.concatenate([start.q, start.v, x])


def _bodies_of(machine: MachineRecord, joint: Joint) -> tuple[str, str]:
    """Names of the first and the second body of a joint."""
    if joint.markers is None:
        assert joint.bodies is not None  # the record was checked
        return joint.bodies
    named = {marker.name: marker for marker in machine.markers}
    first, second = (named[m].body if isinstance(m, str) else m.body for m in joint.markers)
    return first, second


def _with_free_markers(old: Record, tree: SpanningTree) -> Markers:
    """The markers, and for each free body the ground's frame and its own."""
    count = len(old.bodies.mass)
    bodies = [b for branch in tree.branches if branch.joint == FREE for b in (count, branch.child)]
    added, all_markers = len(bodies), len(old.markers.body) + len(bodies)
    return Markers(
        body=np.append(old.markers.body, np.array(bodies, dtype=np.uint32)).astype(np.uint32),
        position_b=np.vstack([old.markers.position_b, np.zeros((added, 3))]),
        frame_b=np.concatenate([old.markers.frame_b, np.tile(np.eye(3), (added, 1, 1))]),
        u=np.zeros((all_markers, 3)),
        r=np.zeros((all_markers, 3)),
        A=np.zeros((all_markers, 3, 3)),
        rdot=np.zeros((all_markers, 3)),
        bias=np.zeros((all_markers, 3)),
    )


def _nodes(machine: MachineRecord, old: Record, tree: SpanningTree) -> list[Node]:
    nodes: list[Node] = []
    position, velocity, marker = 0, 0, len(old.markers.body)
    for branch in tree.branches:
        kind = "free" if branch.joint == FREE else machine.joints[branch.joint].type
        first = marker if branch.joint == FREE else int(old.joints.first_marker[branch.joint])
        nodes.append(
            Node(branch.child, branch.parent, branch.joint, kind, branch.turned, first, first + 1, position, velocity)
        )
        position += len(KINDS[kind][1])
        velocity += KINDS[kind][2]
        marker += 2 if branch.joint == FREE else 0
    return nodes


def _chosen(old: Record, rows: NDArray[np.bool_]) -> tuple[Constraints, Index]:
    """The tables of the rows chosen, and the reports of their combinations."""
    c = old.constraints
    combined = rows[c.combination[:, 0]] if len(c.combination) else np.zeros(0, dtype=bool)
    chosen = c._replace(
        s=c.s[rows[c.s[:, 2]]],
        d1=c.d1[rows[c.d1[:, 4]]],
        d2=c.d2[rows[c.d2[:, 3]]],
        combination=c.combination[combined],
        offset=c.offset[combined],
        motion=np.zeros(int(combined.sum())),
    )
    return chosen, old.outputs.combination[combined]


def _parts(old: Record, rows: Index) -> list[tuple[int, int, int, int]]:
    """Row of the saddle (then of friction), part, marker and body of all parts of the rows that are left, in the order of rows."""
    place = {int(row): k for k, row in enumerate(rows)}
    every = len(old.constraints.C)
    place |= {every + k: len(rows) + k for k in range(len(old.friction.columns))}
    chosen = [(place[int(row)], *map(int, rest)) for row, *rest in old.saddle.block if int(row) in place]
    return sorted(chosen)  # type: ignore[arg-type]


def _path(nodes: list[Node], branch_of: dict[int, int], bodies: set[int]) -> list[int]:
    """Nodes between some bodies and the ground, outermost first: nodes are numbered from the ground outwards."""
    found: set[int] = set()
    for body in bodies:
        at = body
        while at in branch_of and branch_of[at] not in found:
            found.add(branch_of[at])
            at = nodes[branch_of[at]].parent
    return sorted(found, reverse=True)


def _blocks(
    nodes: list[Node], paths: list[list[int]], first_velocity: int
) -> tuple[list[tuple[int, ...]], Index, Index]:
    """Blocks of W, one a row and column of its path, last column of a node first; path table with the first block of each node."""
    blocks: list[tuple[int, ...]] = []
    table: list[tuple[int, int]] = []
    for row, path in enumerate(paths):
        for n in path:
            table.append((n, len(blocks)))
            first = nodes[n].velocity - first_velocity
            columns = range(first, first + KINDS[nodes[n].kind][2])
            blocks += [(row, NONE, 0, column) for column in reversed(columns)]
    starts = np.cumsum([0, *(len(path) for path in paths)]).astype(np.uint32)
    return blocks, index_array(table, 2), starts


def _saddle(old: Record, rows: Index, blocks: list[tuple[int, ...]], owners: list[str], columns: int) -> Saddle:
    own = [block for block in blocks if block[0] < len(rows)]
    groups: dict[str, list[int]] = {}
    for k, owner in enumerate(owners):
        groups.setdefault(owner, []).append(k)
    elimination = plan(list(groups.values()), [block[0] for block in own], [block[3] for block in own])
    count = len(rows)
    return Saddle(
        row=rows,
        block=index_array(blocks, 4),
        blocks=np.array([len(own)], dtype=np.uint32),
        **vars(elimination),
        shift=np.zeros(count),
        W=np.zeros((len(blocks), 1)),
        G=np.zeros((0, 0, 0)),
        z=np.zeros((columns, 1)),
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
        Dinv=np.zeros(count),
        y=np.zeros(count),
        b=np.zeros(count),
        dense=np.zeros((0, 0)),
        null=np.zeros((0, 0)),
        pivot=np.zeros(0, dtype=np.uint32),
        target=np.zeros(count),
    )


def _friction(old: Record, blocks: list[tuple[int, ...]], rows: int, columns: int) -> FrictionTables:
    of_row = [block[0] for block in blocks]
    starts = np.searchsorted(of_row, range(rows, rows + len(old.friction.columns) + 1))
    return old.friction._replace(
        block=index_array(list(pairwise(starts.tolist())), 2),
        change=np.zeros((len(old.friction.columns), columns, 1)),
    )


def _starts(rows: list[int], count: int) -> Index:
    return np.searchsorted(rows, np.arange(count + 1)).astype(np.uint32)


def _markers_in_use(old: Record, nodes: list[Node]) -> Index:
    """Markers that every evaluation needs: not those of joints that carry bodies, unless a coordinate in use is measured between them."""
    carrying = {marker for node in nodes for marker in (node.first, node.second)}
    measured = set(old.coordinates.what[old.coordinates.active, 1:3].ravel().tolist())
    return index_array([k for k in range(len(old.markers.body)) if k not in carrying or k in measured], 1)


def _reactions(absolute: System, machine: MachineRecord, nodes: list[Node]) -> dict[str, Index]:
    """Rows of the joint that carries each body, with their parts on it."""
    old, spans, table = absolute.record, [], []
    on_body: dict[tuple[int, int], tuple[int, int]] = {}
    for row, part, marker, body in old.saddle.block.astype(int):
        on_body[row, body] = (part, marker)
    for node in nodes:
        begin = len(table)
        if node.joint != FREE:
            first, last = old.joints.rows[node.joint].astype(int)
            table += [(row, *on_body[row, node.child]) for row in range(first, last)]
        spans.append((begin, len(table)))
    return {"carried": index_array(spans, 2), "reaction": index_array(table, 3)}


def _node_table(nodes: list[Node], positions: int) -> Index:
    first = [node.velocity - positions for node in nodes]
    rows = [
        (n.child, n.parent, n.first, n.second, KINDS[n.kind][0], int(n.turned), k, k + KINDS[n.kind][2])
        for n, k in zip(nodes, first, strict=True)
    ]
    return index_array(rows, 8)


def _map(nodes: list[Node], positions: int, rest: int) -> StateMap:
    plain, turns = [], []
    units: list[str] = []
    rates: list[str] = []
    for node in nodes:
        _, of_positions, count = KINDS[node.kind]
        units += of_positions
        turning = 3 if node.kind in ("spherical", "free") else 0
        moving = count - turning
        plain += [(node.position + i, node.velocity + i) for i in range(moving)]
        rates += [f"{unit}/s" for unit in of_positions[:moving]] + ["1/s"] * turning
        if turning:
            turns.append((node.position + moving, node.velocity + moving))
    assert len(units) == positions
    return StateMap(index_array(plain, 2), index_array(turns, 2), (*units, *rates, *[""] * rest))
