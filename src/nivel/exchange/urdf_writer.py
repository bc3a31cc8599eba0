"""URDF of the tree of a machine's rigid bodies."""

import numpy as np

from nivel.exchange.kinematic_tree import Branch, KinematicTree, Motion, kinematic_tree
from nivel.exchange.mechanism import Frame
from nivel.exchange.xml_writer import Geometry, Lines, geometries, words
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord

WORLD = "world"
WAY = 1e4  # [m or rad] the other end of a way that has one end


def urdf(machine: MachineRecord, folder: str) -> tuple[str, dict[str, bytes], list[str]]:
    """The document, the meshes that belong to it by file name, and the notes. folder : of meshes. Raises ModelError."""
    tree, out, meshes = kinematic_tree(machine), Lines(), {}
    out.start("robot", name=machine.name)
    out.element("link", name=WORLD)
    _frames(out, tree, GROUND, WORLD)
    for branch in tree.branches:
        _link(out, tree, branch, folder, meshes)
        _joints(out, tree, branch)
        _frames(out, tree, branch.body.name, branch.body.name)
    out.end()
    for joint in tree.loops:
        tree.notes.leave("joints that close loops: a URDF is a tree", joint.name)
    for at in ("stiffness", "armature"):
        for coordinate, numbers in tree.at.items():
            if getattr(numbers, at):
                tree.notes.leave(f"{at} of joints", coordinate)
    for name, *_ in tree.motors:
        tree.notes.leave("motors", name)
    if any(machine.gravity):
        tree.notes.leave("gravity, which is no part of URDF")
    out.comment([f"Written by nivel from the machine {machine.name}.", *tree.notes.lines()])
    return out.text(), meshes, tree.notes.lines()


def _angles(axes: np.ndarray) -> tuple[float, float, float]:
    """Roll, pitch and yaw about fixed axes."""
    pitch = np.arctan2(-axes[2, 0], np.hypot(axes[0, 0], axes[1, 0]))
    if np.hypot(axes[0, 0], axes[1, 0]) < 1e-12:  # x is vertical: all of the turn is roll
        return float(np.arctan2(-axes[1, 2], axes[1, 1])), float(pitch), 0.0
    return float(np.arctan2(axes[2, 1], axes[2, 2])), float(pitch), float(np.arctan2(axes[1, 0], axes[0, 0]))


def _origin(out: Lines, frame: Frame) -> None:
    if np.any(frame.origin) or np.abs(frame.axes - np.eye(3)).max() > 1e-16:
        out.element("origin", xyz=words(frame.origin), rpy=words(_angles(frame.axes)))


def _link(out: Lines, tree: KinematicTree, branch: Branch, folder: str, meshes: dict[str, bytes]) -> None:
    body, properties = branch.body, mass_properties(branch.body)
    i = properties.inertia
    out.start("link", name=body.name)
    out.start("inertial")
    _origin(out, Frame(origin=properties.centre_of_mass))
    out.element("mass", value=float(properties.mass))
    moments = {"ixx": i[0, 0], "ixy": i[0, 1], "ixz": i[0, 2], "iyy": i[1, 1], "iyz": i[1, 2], "izz": i[2, 2]}
    out.element("inertia", **{key: float(value) for key, value in moments.items()})
    out.end()
    for each in geometries(body, folder, meshes, tree.notes):
        out.start("visual")
        _origin(out, each.place)
        out.start("geometry")
        out.element(**_solid(each))
        out.end()
        if each.colour is not None:
            out.start("material", name=f"{body.name}_colour")
            out.element("color", rgba=words((*each.colour, 1.0)))
            out.end()
        out.end()
    out.end()


def _solid(each: Geometry) -> dict[str, str]:
    if each.kind == "mesh":
        return {"tag": "mesh", "filename": each.file}
    if each.kind == "box":
        return {"tag": "box", "size": words(each.sizes)}
    if each.kind == "sphere":
        return {"tag": "sphere", "radius": words(each.sizes)}
    return {"tag": each.kind, "radius": words(each.sizes[:1]), "length": words(each.sizes[1:])}


def _joints(out: Lines, tree: KinematicTree, branch: Branch) -> None:
    """The joint from the parent, of several motions one joint after the other; links between them have no mass.

    A joint of a URDF is at the origin of its child, whose frame is that of the body: where the two differ there is one link more.
    """
    parent = WORLD if branch.parent == GROUND else branch.parent
    body, motions = branch.body.name, branch.motions
    name = branch.joint.name if branch.joint is not None else f"{body}_free"
    if not motions:
        kind = "fixed" if branch.joint is not None and not branch.ball else "floating"
        if branch.ball:
            tree.notes.leave("spherical joints: the link is floating", name)
        _joint(out, name, kind, parent, body, branch.place)
        return
    at_joint = Frame(origin=branch.point)
    steps = [name if len(motions) == 1 else f"{name}_{each.coordinate.partition('.')[2]}" for each in motions]
    moved = bool(np.any(branch.point))
    before, place = parent, branch.place @ at_joint
    for k, (step, motion) in enumerate(zip(steps, motions, strict=True)):
        last = k == len(motions) - 1
        after = body if last and not moved else f"{step}_link"
        if after != body:
            out.element("link", name=after)
        _joint(out, step, "", before, after, place, tree, motion)
        before, place = after, Frame()
    if moved:
        _joint(out, f"{name}_offset", "fixed", before, body, at_joint.inverse)


def _joint(
    out: Lines,
    name: str,
    kind: str,
    parent: str,
    child: str,
    place: Frame,
    tree: KinematicTree | None = None,
    motion: Motion | None = None,
) -> None:
    at = tree.at[motion.coordinate] if tree is not None and motion is not None else None
    limited = at is not None and (at.lower is not None or at.upper is not None)
    if motion is not None:
        kind = ("revolute" if limited else "continuous") if motion.kind == "turn" else "prismatic"
    out.start("joint", name=name, type=kind)
    out.element("parent", link=parent)
    out.element("child", link=child)
    _origin(out, place)
    if motion is not None and at is not None and tree is not None:
        out.element("axis", xyz=words(motion.axis))
        if kind != "continuous":
            lower, upper = (-WAY if at.lower is None else at.lower), (WAY if at.upper is None else at.upper)
            out.element("limit", lower=words([lower]), upper=words([upper]), effort="0", velocity="0")
        if at.damping or at.friction:
            out.element("dynamics", damping=words([at.damping]), friction=words([at.friction]))
        for first, second, factor, offset in tree.follows:
            if first == motion.coordinate:
                out.element("mimic", joint=_name_of(tree, second), multiplier=words([factor]), offset=words([offset]))
    out.end()


def _name_of(tree: KinematicTree, coordinate: str) -> str:
    joint, _, which = coordinate.partition(".")
    branch = next((each for each in tree.branches if each.joint is not None and each.joint.name == joint), None)
    return joint if branch is None or len(branch.motions) == 1 else f"{joint}_{which}"


def _frames(out: Lines, tree: KinematicTree, body: str, link: str) -> None:
    """Markers as links without mass."""
    for name, frame in tree.markers_on(body):
        if name == WORLD or name in tree.machine.body_named:
            tree.notes.leave("markers with the name of a body", name)
            continue
        out.element("link", name=name)
        _joint(out, f"{name}_frame", "fixed", link, name, frame)
