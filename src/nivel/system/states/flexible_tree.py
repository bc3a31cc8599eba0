"""Relative coordinates with flexible bodies: joint coordinates of the spanning tree, and modal coordinates behind that of each carrier.

The machine with modes in absolute coordinates comes first (`nivel.system.states.floating`): its markers are on frames at interfaces, which
are bodies to the joints of the tree. What the tree has more is named in `nivel.kernels.tree.flexible_tree`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from nivel.kernels.record.record import NONE, Record
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.elimination.topology import FREE
from nivel.system.flexible import Bending, bending_bodies, modal_tree
from nivel.system.states.floating import carried_markers, with_modes
from nivel.system.states.joint_start import Bent, Node, Poses, poses
from nivel.system.states.relative import in_tree, tree_of
from nivel.system.states.tree_nodes import joint_node, placed, velocities_in
from nivel.system.system import Array, System


class _Expanded(Struct):
    """Nodes of the tree with those between the frames of flexible bodies; flexible body of each modal node, frame of each outward one
    (0 elsewhere); the frame that carries each flexible body, or NONE; extra frames, each on a body that hangs on nothing, or on a marker
    that its modes do not move: these markers, and the frames that they are on."""

    nodes: list[Node]
    link: list[int]
    carrier: list[int]
    extra: list[int]
    held: dict[int, int]


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The machine with modes, undeformed at the start, in joint and modal coordinates.

    Raises ModelError naming every marker of a flexible body that is at no interface of it.
    """
    bending = bending_bodies(machine)
    bent, start = with_modes(absolute, y, rank, bending, carried_markers(absolute, machine, bending))
    return _arranged(machine, bent, start, rank, settings, bending)


def arrange_deformed(
    machine: MachineRecord, absolute: System, q: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same at rest, at positions and modal coordinates q of absolute coordinates."""
    bending = bending_bodies(machine)
    bent, start = with_modes(absolute, absolute.start, rank, bending, carried_markers(absolute, machine, bending))
    start[:] = 0.0
    start[: len(q)] = q
    return _arranged(machine, bent, start, rank, settings, bending)


def _arranged(
    machine: MachineRecord,
    absolute: System,
    y: Array,
    rank: int,
    settings: SimulationSettings,
    bending: Sequence[Bending],
) -> tuple[System, Array]:
    modes, count = len(absolute.modes), absolute.body_count
    expanded = _expanded(machine, absolute, settings)
    record = _holding(absolute.record, expanded.held)
    absolute = replace(absolute, record=record)
    p = y[7 * count : 7 * count + modes]
    bodies = np.concatenate([y[: 7 * count], y[7 * count + modes : 13 * count + modes]])
    own = _with_frames(record, poses(absolute, bodies), p, expanded.extra)
    independent = velocities_in(expanded.nodes) - (6 * count + modes - rank)
    system, start = in_tree(machine, absolute, own, expanded.nodes, independent, _bent(record, expanded, p))
    parents = {node.parent for node in expanded.nodes}
    heavy = [node.kind == "outward" and node.child in parents for node in expanded.nodes]
    most = max(len(each.reduced.eigenvalues) for each in bending)
    bundle = len(system.record.tree.load)
    modal = modal_tree(expanded.link, expanded.carrier, heavy, modes, most, bundle)
    # what modes are measured by goes with their places in the state
    order = [np.arange(*record.flexible.mode[f]) for node, f in _linked(expanded) if node.kind == "modal"]
    sizes = absolute.gradient_sizes[np.concatenate(order).astype(np.int64)]
    return replace(system, record=system.record._replace(modal=modal), gradient_sizes=sizes), start


def _linked(expanded: _Expanded) -> zip[tuple[Node, int]]:
    """The nodes, each with its flexible body or frame."""
    return zip(expanded.nodes, expanded.link, strict=True)


def _expanded(machine: MachineRecord, absolute: System, settings: SimulationSettings) -> _Expanded:
    record, count = absolute.record, absolute.body_count
    flexible, body_of = record.flexible, record.markers.body
    number = {int(b): f for f, b in enumerate(flexible.body)}
    frames = [(int(f), int(v)) for f, v in flexible.frame]
    nodes: list[Node] = []
    link: list[int] = []
    carrier, extra = [NONE] * len(number), []
    held: dict[int, int] = {}
    for branch in tree_of(machine, settings).branches:
        node, child = joint_node(machine, record, branch), branch.child
        if node.near != NONE:
            node = replace(node, parent=int(body_of[node.near]))
        if child in number:
            f = number[child]
            if branch.joint == FREE or int(body_of[node.far]) == child:
                node = replace(node, child=count + 1 + len(frames) + len(extra))
                extra.append(child)
                if branch.joint != FREE:
                    held[node.far] = node.child
            else:
                node = replace(node, child=int(body_of[node.far]))
                carrier[f] = node.child - count - 1
            first, last = flexible.mode[f]
            nodes += [node, replace(_between("modal", child, node.child), modes=int(last - first))]
            link += [0, f]
            outward = [k for k, (body, v) in enumerate(frames) if body == f and v != node.child]
            nodes += [_between("outward", frames[k][1], child) for k in outward]
            link += outward
        else:
            nodes.append(node)
            link.append(0)
    return _Expanded(placed(nodes), link, carrier, extra, held)


def _holding(record: Record, held: Mapping[int, int]) -> Record:
    """With markers on the frames that they hold."""
    body = record.markers.body.copy()
    for marker, frame in held.items():
        body[marker] = frame
    return record._replace(markers=record.markers._replace(body=body))


def _between(kind: str, child: int, parent: int) -> Node:
    return Node(child, parent, FREE, kind, NONE, NONE, 0, 0)


def _with_frames(record: Record, own: Poses, p: Array, extra: list[int]) -> Poses:
    """With the frames at interfaces of bodies bent by p, whose modes are at rest, and one more at each body of `extra`."""
    flexible = record.flexible
    body = [int(flexible.body[f]) for f, _ in flexible.frame]
    place, turn = _nodes_of(record, p)
    A = own.A[body]
    arm = np.einsum("kij,kj->ki", A, place)
    moved = np.asarray(np.cross(own.omega[body], arm), dtype=np.float64)
    return Poses(
        np.vstack([own.R, own.R[body] + arm, own.R[extra]]),
        own.theta,
        np.concatenate([own.A, A @ Rotation.from_rotvec(turn).as_matrix().reshape(-1, 3, 3), own.A[extra]]),
        np.vstack([own.Rdot, own.Rdot[body] + moved, own.Rdot[extra]]),
        np.vstack([own.omega, own.omega[body], own.omega[extra]]),
    )


def _nodes_of(record: Record, p: Array) -> tuple[Array, Array]:
    """Places (N, 3) [m] of the frames at interfaces, and rotation vectors (N, 3), axes of their bodies."""
    flexible = record.flexible
    motion = np.zeros((len(flexible.frame), 6))
    for k, (f, _) in enumerate(flexible.frame):
        first, last = flexible.mode[f]
        q, n = p[first:last], int(last - first)
        most = flexible.shape.shape[2]
        K = flexible.of_load[k * most : k * most + n].reshape(n, 6, most)[:, :, :n]
        motion[k] = flexible.shape[k, :, :n] @ q - 0.5 * np.einsum("jik,j,k->i", K, q, q)
    return flexible.place_b + motion[:, :3], motion[:, 3:]


def _bent(record: Record, expanded: _Expanded, p: Array) -> dict[int, Bent]:
    """Modal coordinates and turns of the nodes that are no joints."""
    _, turn = _nodes_of(record, p)
    out: dict[int, Bent] = {}
    for n, (node, link) in enumerate(_linked(expanded)):
        if node.kind == "modal":
            first, last = record.flexible.mode[link]
            k = expanded.carrier[link]
            out[n] = Bent(p[first:last], _parameters(-turn[k]) if k != NONE else _parameters(np.zeros(3)))
        elif node.kind == "outward":
            out[n] = Bent(np.zeros(0), _parameters(turn[link]))
    return out


def _parameters(rotation_vector: Array) -> Array:
    """Euler parameters, scalar first."""
    return Rotation.from_rotvec(rotation_vector).as_quat(scalar_first=True)
