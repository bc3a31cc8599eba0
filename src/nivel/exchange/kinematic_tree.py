"""Kinematic tree of a machine, as other programs write one: each body in the one before it where all joint coordinates are zero, and the
elementary motions between the two; joints that close loops stand beside it.
"""

from collections import defaultdict
from collections.abc import Iterator
from typing import Final

import numpy as np

from nivel.elements.forces.actuators import Motor, Stop
from nivel.elements.forces.friction import Friction
from nivel.elements.forces.springs import JointSpringDamper
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.errors import Fault, refuse
from nivel.exchange.mechanism import Array, Frame
from nivel.exchange.translation import Notes
from nivel.files.joint_parts import rotors_of
from nivel.lazy import Struct, field
from nivel.machine.bodies.body import Body
from nivel.machine.core.element import Marker
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.record import GROUND
from nivel.machine.laws.time_function import Expression
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.joint_frames import joint_frames

# joints that are better in the tree than closing a loop come first
IN_TREE: Final = ("fixed", "planar", "cylindrical", "screw", "translational", "universal", "revolute", "spherical")


class Motion(Struct):
    """One elementary motion of a body: `turn` about or `slide` along an axis (3,) in the frame of the body, by a joint coordinate."""

    kind: str
    axis: Array
    coordinate: str  # as JOINT.COORDINATE


class Branch(Struct, frozen=False):
    """A body in the tree. parent : name of the body before it. place : its frame in that of the parent, all coordinates zero.

    joint : between the two; None of a free body. motions : in the order from the parent. ball : whether it is a spherical joint. point : of
    the joint, in the frame of the body.
    """

    body: Body
    parent: str
    place: Frame
    joint: Joint | None = None
    motions: list[Motion] = field(default_factory=list)
    ball: bool = False
    point: Array = field(default_factory=lambda: np.zeros(3))


class AtCoordinate(Struct, frozen=False):
    """What acts at a joint coordinate. friction : effort. armature : rotor inertia. placed : its value as the bodies are placed."""

    damping: float = 0.0
    stiffness: float = 0.0
    free: float = 0.0
    friction: float = 0.0
    armature: float = 0.0
    lower: float | None = None
    upper: float | None = None


class KinematicTree(Struct, frozen=False):
    """branches : parents before their children. loops : joints beside the tree. at : what acts at coordinates. follows : coordinate, other
    one, factor and offset. motors : (name, coordinate, factor, limit). notes : what has no place here."""

    machine: MachineRecord
    branches: list[Branch] = field(default_factory=list)
    loops: list[Joint] = field(default_factory=list)
    at: dict[str, AtCoordinate] = field(default_factory=lambda: defaultdict(AtCoordinate))
    follows: list[tuple[str, str, float, float]] = field(default_factory=list)
    motors: list[tuple[str, str, float, float | None]] = field(default_factory=list)
    notes: Notes = field(default_factory=Notes)

    def children(self, name: str) -> Iterator[Branch]:
        """Bodies whose parent is `name`."""
        return (each for each in self.branches if each.parent == name)

    def markers_on(self, name: str) -> Iterator[tuple[str, Frame]]:
        """Names and frames of the markers on a body."""
        for marker in self.machine.markers:
            if marker.body == name and marker.interface is None:
                yield str(marker.name), _frame(marker)


def kinematic_tree(machine: MachineRecord) -> KinematicTree:
    """The tree of a machine of rigid bodies. Raises ModelError with every joint and body that has no place in one."""
    tree = KinematicTree(machine)
    rotors = _rotors(tree)
    faults = [
        Fault.at(
            f"joints.{joint.name}", f"a joint of type {joint.type} cannot be written; there are {', '.join(IN_TREE)}"
        )
        for joint in machine.joints
        if joint.type not in IN_TREE and joint.type != "variable-distance"
    ]
    bodies = {body.name: body for body in machine.bodies if body.name not in rotors}
    for body in bodies.values():
        if body.flexible is not None or body.point_mass:
            what = "a flexible body" if body.flexible is not None else "a point mass"
            faults.append(Fault.at(f"bodies.{body.name}", f"{what} cannot be written; rigid bodies can"))
    faults += [Fault.at(f"beams.{beam.name}", "a beam cannot be written; rigid bodies can") for beam in machine.beams]
    refuse(faults)
    _grow(tree, bodies, rotors)
    _collect(tree, rotors)
    return tree


def _rotors(tree: KinematicTree) -> dict[str, str]:
    """Bodies that are only the rotor of a coordinate, by name, with the coupling that drives them."""
    rotors = rotors_of(tree.machine)
    for rotor, (_, coordinate) in rotors.items():
        inertia = tree.machine.body_named[rotor].inertia
        assert inertia is not None
        tree.at[coordinate].armature += inertia.xx
    return {rotor: coupling for rotor, (coupling, _) in rotors.items()}


def _full(machine: MachineRecord, reference: str) -> str:
    return ".".join(resolve(reference, machine.joints))


def _grow(tree: KinematicTree, bodies: dict[str, Body], rotors: dict[str, str]) -> None:
    """Choose the joints of the tree, and walk through it from the ground and from free bodies."""
    root = {name: name for name in (GROUND, *bodies)}

    def top(name: str) -> str:
        while root[name] != name:
            name = root[name]
        return name

    joints: dict[str, list[tuple[Joint, str]]] = defaultdict(list)
    known = [each for each in tree.machine.joints if each.name not in rotors and each.type in IN_TREE]
    for joint in sorted(known, key=lambda each: IN_TREE.index(each.type)):
        first, second = (frame[0] for frame in joint_frames(tree.machine, joint))
        if top(first) == top(second):
            tree.loops.append(joint)
            continue
        root[top(second)] = top(first)
        joints[first].append((joint, second))
        joints[second].append((joint, first))
    seen: set[str] = set()
    for start in (GROUND, *bodies):
        if start in seen:
            continue
        if start != GROUND:
            position, axes = tree.machine.placed[start]
            tree.branches.append(Branch(bodies[start], GROUND, Frame(axes, position)))
        pending = [start]
        seen.add(start)
        while pending:
            name = pending.pop(0)
            for joint, other in joints[name]:
                if other not in seen:
                    seen.add(other)
                    tree.branches.append(_branch(tree.machine, joint, name, bodies[other]))
                    pending.append(other)


def _branch(machine: MachineRecord, joint: Joint, parent: str, body: Body) -> Branch:
    (first, at_first, axes_first), (_, at_second, axes_second) = joint_frames(machine, joint)
    one, two = Frame(axes_first, at_first), Frame(axes_second, at_second)
    arm = two.axes[:, 2]
    if joint.type == "universal":  # zero where x of the first is along the arm of the second
        two = Frame(np.column_stack([two.axes[:, 2], -two.axes[:, 1], two.axes[:, 0]]), two.origin)
    forward = parent == first
    outer, inner = (one, two) if forward else (two, one)
    place = outer @ inner.inverse
    # axes of the joint in the frame of the body, all coordinates zero
    x, y, z = inner.axes.T
    second_arm = arm if forward else one.axes @ two.axes.T @ arm
    motions = [
        Motion(kind, axis if forward else -axis, f"{joint.name}.{coordinate}")
        for kind, axis, coordinate in {
            "revolute": [("turn", z, "angle")],
            "translational": [("slide", z, "displacement")],
            "cylindrical": [("slide", z, "displacement"), ("turn", z, "angle")],
            "screw": [("slide", z, "displacement"), ("turn", z, "angle")],
            "universal": [("turn", z, "angle_1"), ("turn", second_arm, "angle_2")],
            "planar": [("slide", x, "x"), ("slide", y, "y"), ("turn", z, "angle")],
        }.get(joint.type, [])
    ]
    return Branch(
        body, parent, place, joint, motions if forward else motions[::-1], joint.type == "spherical", inner.origin
    )


def _collect(tree: KinematicTree, rotors: dict[str, str]) -> None:
    """What acts at coordinates, what follows, and notes of everything else."""
    machine, notes = tree.machine, tree.notes
    for coupling in machine.couplings:
        if coupling.name in rotors.values():
            continue
        terms = coupling.terms if not getattr(coupling, "value", None) else ()
        if len(terms) != 2:
            notes.leave("couplings of other than two coordinates, or that are not linear", coupling.name)
            continue
        (first, one), (second, two) = ((_full(machine, reference), factor) for reference, factor in terms)
        held = one * placed_value(machine, first) + two * placed_value(machine, second)
        tree.follows.append((first, second, -two / one, held / one))
    for branch in tree.branches:
        if branch.joint is not None and branch.joint.type == "screw":
            assert branch.joint.pitch is not None  # the record was checked
            name, factor = branch.joint.name, branch.joint.pitch / (2.0 * np.pi)
            held = placed_value(machine, f"{name}.displacement") - factor * placed_value(machine, f"{name}.angle")
            tree.follows.append((f"{name}.displacement", f"{name}.angle", factor, held))
    in_tree = {motion.coordinate for branch in tree.branches for motion in branch.motions}
    for force in machine.forces:
        if not _takes(tree, force, in_tree):
            notes.leave(f"forces of type {force.type}", force.name)
    for section in ("drivers", "hydraulics", "states", "control", "sensors", "events"):
        for element in getattr(machine, section):
            notes.leave(section, element.name)
    if machine.surroundings:
        notes.leave("surroundings")
    for joint in machine.joints:
        if joint.start is not None or joint.start_rates is not None:
            notes.leave("start values of joints", joint.name)
        if joint.type == "variable-distance":
            notes.leave("joints of type variable-distance, which constrain nothing", joint.name)


def _takes(tree: KinematicTree, force: object, in_tree: set[str]) -> bool:
    """Whether a force is one of the numbers at a coordinate of the tree, which then has it."""
    coordinate = getattr(force, "coordinate", None)
    full = _full(tree.machine, coordinate) if isinstance(coordinate, str) else ""
    if full not in in_tree:
        return False
    at = tree.at[full]
    match force:
        case JointSpringDamper(law=None, table=None, preload=0.0) if not (at.stiffness and force.stiffness):
            at.damping += force.damping
            if force.stiffness:
                at.stiffness, at.free = force.stiffness, force.free_value
        case Stop() if at.lower is None and at.upper is None:
            at.lower, at.upper = force.lower, force.upper
            tree.notes.change(
                "stops are limits, whose stiffness and restitution are left to the other program", force.name
            )
        case Friction(normal_load=float() as load) if not at.friction:
            at.friction = force.coefficient * load * (force.radius or 1.0)
            tree.notes.change("friction is dry friction by one number", force.name)
        case Motor(effort=Expression(text)) if (found := _of_input(text, tree.machine)) is not None:
            tree.motors.append((force.name, full, found, force.limit))
        case _:
            return False
    return True


def _of_input(text: str, machine: MachineRecord) -> float | None:
    """The factor of an effort that is an input, or a number times an input."""
    factor, star, signal = text.partition("*")
    name = (signal if star else factor).strip().removesuffix(".value")
    if name not in {each.name for each in machine.inputs}:
        return None
    try:
        return float(factor) if star else 1.0
    except ValueError:
        return None


def placed_value(machine: MachineRecord, coordinate: str) -> float:
    """The value of a joint coordinate as the file places the bodies."""
    name, _, which = coordinate.partition(".")
    joint = next(each for each in machine.joints if each.name == name)
    assert which in JOINTS[joint.type].coordinates
    one, two = (
        (Frame() if body == GROUND else Frame(machine.placed[body][1], machine.placed[body][0])) @ Frame(axes, point)
        for body, point, axes in joint_frames(machine, joint)
    )
    between = one.inverse @ two
    if which in ("x", "y", "displacement"):
        return float(between.origin["xyz".find(which) if which != "displacement" else 2])
    if which == "angle":
        return float(np.arctan2(between.axes[1, 0], between.axes[0, 0]))
    if which == "angle_1":
        arm = between.axes[:, 2]
        return float(np.arctan2(arm[1], arm[0]))
    arm = between.inverse.axes[:, 2]
    return float(-np.arctan2(arm[1], arm[0]))


def _frame(marker: Marker) -> Frame:
    position, axes = marker_frame(marker)
    return Frame(axes, np.array(position, dtype=float))
