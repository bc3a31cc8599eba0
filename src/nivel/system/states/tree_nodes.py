"""The nodes of a spanning tree: what each kind has in the state, and where that stands."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nivel.kernels.bodies.coordinate import ALONG
from nivel.kernels.record import record as kernels
from nivel.kernels.record.record import NONE, Record
from nivel.machine.machine_record import MachineRecord
from nivel.system.elimination.topology import FREE, SLIDERS, Branch
from nivel.system.states.joint_start import Node

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
    "point-on-beam": (kernels.POINT_ON_BEAM, ("m",) + ("1",) * 4, 4),
    "keyed-on-beam": (kernels.KEYED_ON_BEAM, ("m", "1", "1"), 3),
    "cylindrical-on-beam": (kernels.CYLINDRICAL_ON_BEAM, ("m", "1"), 2),
    "translational-on-beam": (kernels.TRANSLATIONAL_ON_BEAM, ("m",), 1),
    # between frames of a flexible body; nodes of kind "modal" have its modes
    "outward": (kernels.OUTWARD, (), 0),
}


# those that end with Euler parameters, and three velocities of these
TURNING = ("spherical", "free", "point-on-beam")


def units_of(node: Node) -> tuple[str, ...]:
    """Units of the positions of a node."""
    return ("kg^0.5 m",) * node.modes if node.kind == "modal" else KINDS[node.kind][1]


def number_of(node: Node) -> int:
    """The kernels' number of its kind."""
    return kernels.MODAL if node.kind == "modal" else KINDS[node.kind][0]


def width_of(node: Node) -> int:
    """Velocities of a node."""
    return node.modes if node.kind == "modal" else KINDS[node.kind][2]


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
    if kind in SLIDERS:
        return Node(branch.child, branch.parent, branch.joint, kind, NONE, far, 0, 0, along=_along(old, far))
    return Node(branch.child, branch.parent, branch.joint, kind, near, far, 0, 0)


def _along(old: Record, slider: int) -> int:
    """The coordinate that is the place of a marker along its beam."""
    what = old.coordinates.what
    return int(np.flatnonzero((what[:, 0] == ALONG) & (what[:, 1] == slider))[0])
