"""The nodes of a spanning tree: what each kind has in the state, and where that stands."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.elements.joints.in_trees import FREE_BODY
from nivel.elements.joints.kind import TreeJoint
from nivel.kernels.bodies.coordinate import ALONG, CROSS_FIRST, CROSS_SECOND, LAST_ANGLE
from nivel.kernels.record import record as kernels
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE, U1, U2, Coordinates, Record
from nivel.kernels.tree.joints import BY_ADDRESS
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.system.elimination.topology import FREE, Branch
from nivel.system.states.joint_start import Node
from nivel.system.system import Array, System
from nivel.system.tables import index_array

BETWEEN_FRAMES: Final = {"outward": kernels.OUTWARD, "modal": kernels.MODAL}  # of a flexible body


def tree_joint(kind: str) -> TreeJoint:
    """How a node of a kind carries its body: a joint, or "free" in space."""
    found = FREE_BODY if kind == "free" else JOINTS[kind].tree
    assert found is not None  # others stay constraints
    return found


def units_of(node: Node) -> tuple[str, ...]:
    """Units of the positions of a node."""
    return ("kg^0.5 m",) * node.modes if node.kind in BETWEEN_FRAMES else tree_joint(node.kind).units


def width_of(node: Node) -> int:
    """Velocities of a node."""
    return node.modes if node.kind in BETWEEN_FRAMES else tree_joint(node.kind).velocities


def velocity_names(absolute: System, nodes: Sequence[Node]) -> tuple[str, ...]:
    """What the velocities of all nodes are rates of: `JOINT.angle`, `BODY.x` of a body that no joint holds, modal coordinates."""
    record, out = absolute.record, []
    # an interface that carries its body stands for it
    bodies = {node.parent: node.child for node in nodes if node.kind == "modal"}
    for node in nodes:
        if node.kind in BETWEEN_FRAMES:
            if node.modes:
                first = int(record.flexible.mode[record.flexible.body.tolist().index(node.child), 0])
                out += absolute.modes[first : first + node.modes]
            continue
        free = node.joint == FREE
        owner = absolute.bodies[bodies.get(node.child, node.child)] if free else absolute.joints[node.joint]
        backwards = node.near != NONE and node.near != record.joints.first_marker[node.joint]
        out += [f"{owner}.{name}" for name in tree_joint(node.kind).names(backwards=backwards)]
    return tuple(out)


def is_turning(node: Node) -> bool:
    """Whether its positions end with Euler parameters, and its velocities with ω̄."""
    return node.kind not in BETWEEN_FRAMES and tree_joint(node.kind).turning


def motions(nodes: Sequence[Node]) -> list[Family]:
    """Motions of joints that the kernels have no number of."""
    kinds = dict.fromkeys(node.kind for node in nodes if node.kind not in BETWEEN_FRAMES)
    return [motion for kind in kinds if isinstance(motion := tree_joint(kind).motion, Family)]


def number_of(node: Node, own: Sequence[Family]) -> int:
    """The kernels' number of its kind; own : the motions that have none, in the order of their addresses."""
    if node.kind in BETWEEN_FRAMES:
        return BETWEEN_FRAMES[node.kind]
    motion = tree_joint(node.kind).motion
    return BY_ADDRESS + own.index(motion) if isinstance(motion, Family) else motion


def positions_in(nodes: list[Node]) -> int:
    """Positions of all nodes."""
    return sum(len(units_of(node)) for node in nodes)


def velocities_in(nodes: list[Node]) -> int:
    """Velocities of all nodes."""
    return sum(width_of(node) for node in nodes)


def placed(nodes: list[Node]) -> list[Node]:
    """The nodes with the places of their positions and velocities in the state."""
    position, velocity, out = 0, positions_in(nodes), []
    for node in nodes:
        out.append(replace(node, position=position, velocity=velocity))
        position += len(units_of(node))
        velocity += width_of(node)
    return out


def joint_node(machine: MachineRecord, old: Record, branch: Branch) -> Node:
    """The node of a branch, without its place in the state."""
    kind, near, far = "free", NONE, NONE
    if branch.joint != FREE:
        kind, near = machine.joints[branch.joint].type, int(old.joints.first_marker[branch.joint])
        near, far = (near + 1, near) if branch.turned else (near, near + 1)
    if kind in JOINTS and JOINTS[kind].rail:
        return Node(branch.child, branch.parent, branch.joint, kind, NONE, far, 0, 0, along=_along(old, far))
    return Node(branch.child, branch.parent, branch.joint, kind, near, far, 0, 0)


def _along(old: Record, slider: int) -> int:
    """The coordinate that is the place of a marker along its beam."""
    what = old.coordinates.what
    return int(np.flatnonzero((what[:, 0] == ALONG) & (what[:, 1] == slider))[0])


# what an angle is for a joint that carries its first body
BACKWARDS: Final = {CROSS_FIRST: CROSS_SECOND, CROSS_SECOND: CROSS_FIRST}


class Turns(Struct):
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
