"""Relative coordinates: the spanning tree of an assembled machine, its joint coordinates, and the rows that are left."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from nivel.elements.joints.joint import Joint
from nivel.kernels.bodies.coordinate import ALONG
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import COMPLETE, NONE, Bodies, Constraints, Frames, Hooks, Markers, Record, Saddle
from nivel.kernels.record.record import Friction as FrictionTables
from nivel.kernels.tree import tree_outputs
from nivel.known import Friction, OnBeam, TransmissionLoss
from nivel.machine.bodies.inertia import mass_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.elimination.topology import FREE, Edge, SpanningTree, empty_tree, spanning_tree
from nivel.system.saddle import solver_tables
from nivel.system.states.joint_start import Bent, Node, Poses, carried_frames, joint_start, poses
from nivel.system.states.joint_start import Frames as OwnFrames
from nivel.system.states.tree_nodes import (
    BETWEEN_FRAMES,
    is_turning,
    joint_node,
    motions,
    number_of,
    placed,
    positions_in,
    tree_joint,
    turns,
    units_of,
    velocities_in,
    velocity_names,
    width_of,
)
from nivel.system.system import Array, StateMap, System
from nivel.system.tables import index_array, longer, work_arrays

# rows that are whitened together
LARGEST_BUNDLE = 6
Index = NDArray[np.uint32]


def tree_of(machine: MachineRecord, settings: SimulationSettings, *, heavy_first: bool = False) -> SpanningTree:
    """Spanning tree of `machine`. Joints that the settings name stay constraints, and those whose reaction loads a friction; those that
    slide along beams also with formulations other than newton-euler.

    heavy_first : see `nivel.system.elimination.topology.spanning_tree`.
    """
    number = {body.name: k for k, body in enumerate(machine.bodies)} | {"ground": len(machine.bodies)}
    slides = settings.formulation == "newton-euler"
    edges = [
        Edge(joint.name, joint.type, number[first], number[second], _rail(joint, number) if slides else ())
        for joint, (first, second) in ((joint, bodies_of(machine, joint)) for joint in machine.joints)
    ]
    loading = {
        resolve(force.coordinate, machine.joints)[0]
        for force in machine.forces
        if isinstance(force, Friction) and force.normal_load is None
    }
    loading |= {force.coupling for force in machine.forces if isinstance(force, TransmissionLoss)}
    weight = [mass_of(body) for body in machine.bodies]
    return spanning_tree(len(machine.bodies), edges, {*settings.cut, *loading}, weight, heavy_first=heavy_first)


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers and state in the joint coordinates of the spanning tree."""
    nodes = placed([joint_node(machine, absolute.record, branch) for branch in tree_of(machine, settings).branches])
    # the freedoms of the tree less those of the machine (points that do not turn included) are the independent rows that are left
    independent = velocities_in(nodes) - (6 * absolute.body_count - rank)
    return in_tree(machine, absolute, poses(absolute, y), nodes, independent)


def in_tree(
    machine: MachineRecord,
    absolute: System,
    own: Poses,
    nodes: list[Node],
    rank: int,
    bent: Mapping[int, Bent] | None = None,
) -> tuple[System, Array]:
    """Numbers and state in the coordinates of `nodes`.

    own : poses of the bodies' own frames. rank : independent ones of the rows that are left. bent : the nodes that are no joints.
    """
    old, positions, columns = absolute.record, positions_in(nodes), velocities_in(nodes)
    frames = carried_frames(old.markers, nodes, len(own.R))
    start = joint_start(own, old.markers, frames, nodes, machine, tree_joint, old.coordinates, bent)
    carried = {machine.joints[node.joint].name for node in nodes if node.joint != FREE}
    left = np.array([owner not in carried for owner in absolute.row_owner], dtype=bool)
    rows = np.flatnonzero(left).astype(np.uint32)
    constraints, reports = _chosen(old, left)
    parts = _parts(old, rows)
    paths = _paths(nodes, parts, len(rows) + len(old.friction.columns))
    blocks, path_tables = _blocks(nodes, paths, positions)
    angles = turns(old.coordinates, nodes, start.q)
    active = _active(old, nodes)
    measured = index_array(sorted({*active.tolist(), *angles.followed.tolist()}), 1)
    in_use = _markers_in_use(old, nodes, measured)
    sliders = [n for n, node in enumerate(nodes) if node.along >= 0]
    own_motions = motions(nodes)
    address = np.array([*old.hooks.address, *(motion.address for motion in own_motions)], dtype=np.uint64)
    address[COMPLETE] = _completion(machine, sliding=bool(sliders)).address
    bundle = int(np.diff(path_tables["bundle"]).max(initial=0))
    record = old._replace(
        coordinates=old.coordinates._replace(active=active, followed=angles.followed),
        bodies=_bodies_in(frames, old),
        markers=_markers_in(frames, old.markers),
        constraints=constraints,
        saddle=_saddle(rows, blocks, [absolute.row_owner[row] for row in rows], columns),
        outputs=old.outputs._replace(combination=reports),
        friction=_friction(old, blocks, len(rows), columns),
        tree=empty_tree(old.constraints, len(nodes), columns, positions, bundle, len(own.R), len(sliders))._replace(
            node=_node_table(nodes, positions, own_motions),
            place=index_array([(node.position, node.velocity) for node in nodes], 2),
            number=start.number,
            first=start.first,
            theta=start.theta,
            own=-np.einsum("bji,bj->bi", frames.axes, frames.origin)[: absolute.body_count],
            own_theta=start.own_theta,
            size=np.array([absolute.size]),
            rows=_chosen(old, ~left)[0],
            marker=in_use,
            turning=np.isin(in_use, _with_axes(old, constraints, measured)).astype(np.uint32),
            slider=index_array([(n, nodes[n].along) for n in sliders], 2),
            slider_of=index_array([sliders.index(n) if n in sliders else NONE for n in range(len(nodes))], 1),
            counted=angles.counted,
            turn=angles.number,
            part=index_array(parts, 4),
            part_start=np.searchsorted([part[0] for part in parts], np.arange(len(paths) + 1)).astype(np.uint32),
            **path_tables,
            **_reactions(old, nodes),
        ),
        frames=Frames(*(np.zeros((absolute.body_count + 1, width)) for width in (3, 4, 3, 3))),
        hooks=Hooks(address),
    )
    # Euler parameters that follow from axes go on from here
    for node in (node for node in nodes if node.kind not in BETWEEN_FRAMES and tree_joint(node.kind).turn is None):
        record.bodies.theta[node.child] = start.turned[node.child]
    x = absolute.start_of_states
    names = velocity_names(absolute, nodes)
    system = replace(absolute, record=record, state_map=_map(nodes, positions, len(x)), tree_names=names)
    return system.known_rank(rank), np.concatenate([start.q, start.v, x])


def _completion(machine: MachineRecord, *, sliding: bool) -> Family:
    """What completes frames: for accelerations found by the residual, or by a recursion over rigid or flexible bodies."""
    if machine.shares_mass or sliding:
        return tree_outputs.complete_implicit
    return tree_outputs.complete_flexible if machine.is_flexible else tree_outputs.complete


def has_sliders(machine: MachineRecord, settings: SimulationSettings) -> bool:
    """Whether a joint that slides along a beam carries a body in relative coordinates. The nodes of beams are bodies of `machine`."""
    if not any(isinstance(joint, OnBeam) for joint in machine.joints):
        return False
    carrying = (machine.joints[branch.joint] for branch in tree_of(machine, settings).branches if branch.joint != FREE)
    return any(isinstance(joint, OnBeam) for joint in carrying)


def _rail(joint: Joint, number: Mapping[str, int]) -> tuple[int, ...]:
    return tuple(number[node] for node in joint.nodes) if isinstance(joint, OnBeam) else ()


def bodies_of(machine: MachineRecord, joint: Joint) -> tuple[str, str]:
    """Names of the first and the second body of a joint."""
    if joint.markers is None:
        assert joint.bodies is not None  # the record was checked
        return joint.bodies
    first, second = (machine.marker_named[m].body if isinstance(m, str) else m.body for m in joint.markers)
    return first, second


def _bodies_in(frames: OwnFrames, old: Record) -> Bodies:
    """What is fixed to the bodies, in the frames of these coordinates, and work arrays of their own."""
    bodies, count = old.bodies, len(old.bodies.mass)
    F, o = frames.axes[:count], frames.origin[:count]
    centre = np.einsum("bji,bj->bi", F, bodies.centre_b - o)
    inertia = np.einsum("bji,bjk,bkl->bil", F, bodies.inertia_b, F)
    square = np.einsum("bi,bi->b", centre, centre)
    steiner = square[:, None, None] * np.eye(3) - np.einsum("bi,bj->bij", centre, centre)
    fixed = {
        # frames at interfaces, behind the ground, have none
        "centre_b": longer(np.vstack([centre, np.zeros((1, 3))]), len(frames.axes)),
        "inertia_b": np.ascontiguousarray(inertia),
        "inertia_origin_b": np.ascontiguousarray(inertia + bodies.mass[:, None, None] * steiner),
    }
    work = {name: longer(array, len(frames.axes)) for name, array in work_arrays(bodies).items()}
    new = bodies._replace(**fixed, **work)
    for name in ("R", "Rdot", "omega", "omega_b", "c"):
        getattr(new, name)[count] = 0.0
    return new


def _markers_in(frames: OwnFrames, markers: Markers) -> Markers:
    F, o = frames.axes[markers.body], frames.origin[markers.body]
    return markers._replace(
        position_b=np.ascontiguousarray(np.einsum("kji,kj->ki", F, markers.position_b - o)),
        frame_b=np.ascontiguousarray(np.einsum("kji,kjl->kil", F, markers.frame_b)),
        **{name: getattr(markers, name).copy() for name in ("u", "r", "A", "rdot", "bias")},
    )


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
    chosen = [(place[row], *rest) for row, *rest in _on_bodies(old) if row in place]
    return sorted(chosen)  # type: ignore[arg-type]


def _on_bodies(old: Record) -> list[tuple[int, int, int, int]]:
    """Row, part, marker and its body of all blocks; further blocks of flexible bodies stand for their modes."""
    blocks, bodies = old.saddle.block.tolist(), len(old.bodies.mass)
    return [(row, part, m, int(old.markers.body[m])) for row, part, m, body in blocks if body < bodies]


def _paths(nodes: list[Node], parts: list[tuple[int, int, int, int]], count: int) -> list[tuple[int, ...]]:
    """For each row the nodes between its bodies and the ground, outermost first: nodes are numbered from the ground outwards."""
    branch_of = {node.child: n for n, node in enumerate(nodes)}
    found: list[set[int]] = [set() for _ in range(count)]
    for row, _, _, body in parts:
        at = body
        while at in branch_of and branch_of[at] not in found[row]:
            found[row].add(branch_of[at])
            at = nodes[branch_of[at]].parent
    return [tuple(sorted(path, reverse=True)) for path in found]


def _blocks(
    nodes: list[Node], paths: list[tuple[int, ...]], first_velocity: int
) -> tuple[list[tuple[int, ...]], dict[str, Index]]:
    """Blocks of W, one a row and column of its path, the last column of a node first; tables of paths and bundles."""
    blocks: list[tuple[int, ...]] = []
    table: list[tuple[int, int]] = []
    lengths: list[int] = []
    for row, path in enumerate(paths):
        before = len(blocks)
        for n in path:
            table.append((n, len(blocks)))
            first = nodes[n].velocity - first_velocity
            blocks += [(row, NONE, 0, column) for column in reversed(range(first, first + width_of(nodes[n])))]
        lengths.append(len(blocks) - before)
    bundle = [k for k, path in enumerate(paths) if k == 0 or path != paths[k - 1] or k % LARGEST_BUNDLE == 0]
    return blocks, {
        "path": index_array(table, 2),
        "path_start": np.cumsum([0, *(len(path) for path in paths)]).astype(np.uint32),
        "row_blocks": index_array(lengths, 1),
        "bundle": index_array([*bundle, len(paths)], 1),
    }


def _saddle(rows: Index, blocks: list[tuple[int, ...]], owners: list[str], columns: int) -> Saddle:
    own = sum(block[0] < len(rows) for block in blocks)
    groups: dict[str, list[int]] = {}
    for k, owner in enumerate(owners):
        groups.setdefault(owner, []).append(k)
    return solver_tables(rows, index_array(blocks, 4), own, list(groups.values()), 1, 0, columns)


def _friction(old: Record, blocks: list[tuple[int, ...]], rows: int, columns: int) -> FrictionTables:
    of_row = [block[0] for block in blocks]
    starts = np.searchsorted(of_row, range(rows, rows + len(old.friction.columns) + 1))
    return old.friction._replace(
        block=index_array(list(pairwise(starts.tolist())), 2), change=np.zeros((len(old.friction.columns), columns, 1))
    )


def _active(old: Record, nodes: list[Node]) -> Index:
    """Coordinates that every evaluation needs: not those that only rows of sliders are made of which carry bodies."""
    what = old.coordinates.what[old.coordinates.active]
    sliders = [node.far for node in nodes if node.along >= 0]
    return old.coordinates.active[~((what[:, 0] > ALONG) & np.isin(what[:, 1], np.array(sliders, dtype=np.int64)))]


def _markers_in_use(old: Record, nodes: list[Node], measured_there: Index) -> Index:
    """Markers that every evaluation needs: not those of joints that carry bodies, unless a coordinate in use is measured between them."""
    carrying = {marker for node in nodes for marker in (node.near, node.far)}
    measured = _ends(old, measured_there)
    return index_array([k for k in range(len(old.markers.body)) if k not in carrying or k in measured], 1)


def _with_axes(old: Record, left: Constraints, measured: Index) -> Index:
    """Markers whose axes an evaluation may need, or more: those of rows with axes, of coordinates, and all that forces name by number."""
    of_rows = [left.d1[:, [0, 2]], left.d2[:, [0, 2]], np.array(sorted(_ends(old, measured)), dtype=np.uint32)]
    return np.concatenate([table.ravel() for table in (*of_rows, old.elements.columns, old.friction.columns)])


def _ends(old: Record, coordinates: Index) -> set[int]:
    """Markers that these coordinates look at."""
    start, markers = old.coordinates.start, old.coordinates.part_marker
    return {int(marker) for k in coordinates for marker in markers[start[k] : start[k + 1]]}


def _reactions(old: Record, nodes: list[Node]) -> dict[str, Index]:
    """Rows of the joint that carries each body, with their parts on it."""
    spans: list[tuple[int, int]] = []
    table: list[tuple[int, int, int]] = []
    on_body = {(row, body): (part, marker) for row, part, marker, body in _on_bodies(old)}
    for node in nodes:
        begin = len(table)
        if node.joint != FREE:
            first, last = old.joints.rows[node.joint].astype(int)
            table += [(row, *on_body[row, node.child]) for row in range(first, last)]
        spans.append((begin, len(table)))
    return {"carried": index_array(spans, 2), "reaction": index_array(table, 3)}


def _node_table(nodes: list[Node], positions: int, own_motions: Sequence[Family]) -> Index:
    first = [node.velocity - positions for node in nodes]
    rows = [
        (n.child, n.parent, number_of(n, own_motions), NONE if n.joint == FREE else n.joint, k, k + width_of(n))
        for n, k in zip(nodes, first, strict=True)
    ]
    return index_array(rows, 6)


def _map(nodes: list[Node], positions: int, rest: int) -> StateMap:
    plain, turns = [], []
    units: list[str] = []
    rates: list[str] = []
    for node in nodes:
        of_positions, count = units_of(node), width_of(node)
        units += of_positions
        turning = 3 if is_turning(node) else 0
        moving = count - turning
        plain += [(node.position + i, node.velocity + i) for i in range(moving)]
        rates += [f"{unit}/s" for unit in of_positions[:moving]] + ["1/s"] * turning
        if turning:
            turns.append((node.position + moving, node.velocity + moving))
    assert len(units) == positions
    return StateMap(index_array(plain, 2), index_array(turns, 2), (*units, *rates, *[""] * rest))
