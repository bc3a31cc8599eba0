"""Writers of models for other programs, XML documents with the geometry of bodies as primitives in their frames and as meshes: URDF of the
tree of a machine's rigid bodies, MJCF of its rigid part."""

from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.exchange.kinematic_tree import Branch, KinematicTree, Motion, kinematic_tree
from nivel.exchange.mechanism import Array, Frame
from nivel.exchange.translation import Notes
from nivel.files.mesh_file import stl_content
from nivel.lazy import Struct
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Mesh, Shape, Sphere, Tube, digits_of
from nivel.machine.bodies.solids import axes_of, box_size, length, mesh_surface
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.joint_frames import joint_frames


class Lines:
    """Lines of a document, indented by the elements that are open."""

    def __init__(self) -> None:
        self._lines: list[str] = ['<?xml version="1.0"?>']
        self._open: list[str] = []

    def comment(self, lines: Iterable[str]) -> None:
        """A comment of several lines, before the first element."""
        text = "\n     ".join(each.replace("--", "- -") for each in lines)
        self._lines.insert(1, f"<!-- {text}\n-->")

    def add(self, inner: "Lines") -> None:
        """The elements of another document, inside of the one that is open."""
        self._lines += [f"{self._indent}{line}" for line in inner._lines[1:]]

    def element(self, tag: str, **attributes: object) -> None:
        """An element without content; attributes that are None are left out."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}/>")

    def start(self, tag: str, **attributes: object) -> None:
        """The beginning of an element."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}>")
        self._open.append(tag)

    def end(self) -> None:
        """The end of the element that is open."""
        tag = self._open.pop()
        self._lines.append(f"{self._indent}</{tag}>")

    def text(self) -> str:
        """The document."""
        return "\n".join(self._lines) + "\n"

    @property
    def _indent(self) -> str:
        return "  " * len(self._open)


def words(values: Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces."""
    return " ".join(repr(float(each)).removesuffix(".0") for each in values)


def _attributes(attributes: dict[str, object]) -> str:
    given = ((name.rstrip("_"), value) for name, value in attributes.items() if value is not None)
    return "".join(f" {name}={quoteattr(_shown(value))}" for name, value in given)


def _shown(value: object) -> str:
    return repr(value).removesuffix(".0") if isinstance(value, float) else escape(str(value))


class Geometry(Struct):
    """kind : box, cylinder, capsule, sphere or mesh. place : of its middle, round ones along z. sizes : lengths; radius, length; radius.

    file : of a mesh. colour : red, green, blue from 0 to 1, or None.
    """

    kind: str
    place: Frame
    sizes: tuple[float, ...] = ()
    file: str = ""
    colour: tuple[float, float, float] | None = None


def geometries(body: Body, folder: str, meshes: dict[str, bytes], notes: Notes) -> Iterator[Geometry]:
    """What is drawn of a body; files of meshes go to `meshes`."""
    for shape in (*((body.shape,) if body.shape is not None else ()), *body.looks):
        drawn = _geometry(shape, body.name, folder, meshes)
        if drawn is None:
            notes.leave(f"looks: shapes of type {shape.type}", body.name)
        else:
            yield drawn


def _geometry(shape: Shape, name: str, folder: str, meshes: dict[str, bytes]) -> Geometry | None:
    colour = None
    if shape.colour is not None:
        digits = digits_of(shape.colour).removeprefix("#")
        colour = (int(digits[0:2], 16) / 255, int(digits[2:4], 16) / 255, int(digits[4:6], 16) / 255)
    match shape:
        case Mesh():
            file, count = f"{folder}/{name}.stl", 2
            while file in meshes:
                file, count = f"{folder}/{name}_{count}.stl", count + 1
            meshes[file] = stl_content(*mesh_surface(shape))
            return Geometry("mesh", Frame(), file=file, colour=colour)
        case Sphere():
            return Geometry("sphere", _at(shape.centre), (shape.radius,), colour=colour)
        case Box():
            return Geometry("box", _at(shape.centre), tuple(map(float, box_size(shape))), colour=colour)
        case Cylinder() | Capsule() | Tube():
            radius = shape.outer_radius if isinstance(shape, Tube) else shape.radius
            along, next_one, last = axes_of(shape.along)
            place = Frame(np.eye(3)[:, [next_one, last, along]], _at(shape.centre).origin)
            kind = "capsule" if isinstance(shape, Capsule) else "cylinder"
            return Geometry(kind, place, (radius, float(length(shape))), colour=colour)
    return None


def _at(centre: tuple[float, float, float] | None) -> Frame:
    origin: Array = np.array(centre or (0.0, 0.0, 0.0))
    return Frame(origin=origin)


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


APART: float = 0.1  # [m] between the two points that hold the axis of a revolute joint in a loop


def mjcf(machine: MachineRecord, folder: str) -> tuple[str, dict[str, bytes], list[str]]:
    """The document, the meshes that belong to it by file name, and the notes. folder : of meshes. Raises ModelError."""
    tree = kinematic_tree(machine)
    writer = _Writer(tree, folder)
    text = writer.document()
    return text, writer.meshes, tree.notes.lines()


class _Writer:
    def __init__(self, tree: KinematicTree, folder: str) -> None:
        self.tree, self.folder, self.out = tree, folder, Lines()
        self.meshes: dict[str, bytes] = {}
        self.names: dict[str, str] = {}  # of motions, by coordinate

    def document(self) -> str:
        """The whole document."""
        machine, out = self.tree.machine, Lines()
        self.out.start("worldbody")
        self._markers(GROUND)
        for branch in self.tree.children(GROUND):
            self._body(branch)
        self.out.end()
        self._equalities()
        self._actuators()
        out.start("mujoco", model=machine.name)
        out.element("compiler", angle="radian", autolimits="true", inertiafromgeom="false", balanceinertia="false")
        step = machine.simulation.step
        out.element("option", gravity=words(machine.gravity), timestep=float(step) if isinstance(step, float) else None)
        if self.meshes:
            out.start("asset")
            for file in self.meshes:
                out.element("mesh", name=_mesh_name(file), file=file, inertia="shell")
            out.end()
        out.add(self.out)
        out.end()
        out.comment([f"Written by nivel from the machine {machine.name}.", *self.tree.notes.lines()])
        return out.text()

    def _body(self, branch: Branch) -> None:
        out, body = self.out, branch.body
        out.start("body", name=body.name, pos=words(branch.place.origin), quat=_quaternion(branch.place))
        if branch.joint is None and branch.parent == GROUND:
            out.element("freejoint", name=f"{body.name}_free")
        if branch.ball and branch.joint is not None:
            out.element("joint", name=branch.joint.name, type="ball", pos=words(branch.point))
        for motion in branch.motions:
            self._joint(branch, motion.kind, motion.axis, motion.coordinate)
        properties = mass_properties(body)
        i = properties.inertia
        tensor = words([i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])
        out.element("inertial", pos=words(properties.centre_of_mass), mass=properties.mass, fullinertia=tensor)
        for each in geometries(body, self.folder, self.meshes, self.tree.notes):
            colour = None if each.colour is None else words((*each.colour, 1.0))
            common = {"contype": 0, "conaffinity": 0, "group": 1, "rgba": colour}
            if each.kind == "mesh":
                out.element("geom", type="mesh", mesh=_mesh_name(each.file), **common)
                continue
            halves = [each.sizes[0], 0.5 * each.sizes[1]] if len(each.sizes) == 2 else list(each.sizes)
            size = words([0.5 * size for size in each.sizes] if each.kind == "box" else halves)
            out.element(
                "geom",
                type=each.kind,
                size=size,
                pos=words(each.place.origin) if np.any(each.place.origin) else None,
                quat=_quaternion(each.place),
                **common,
            )
        self._markers(body.name)
        for child in self.tree.children(body.name):
            self._body(child)
        out.end()

    def _joint(self, branch: Branch, kind: str, axis: np.ndarray, coordinate: str) -> None:
        joint, _, which = coordinate.partition(".")
        name = joint if len(branch.motions) == 1 else f"{joint}_{which}"
        self.names[coordinate] = name
        at = self.tree.at[coordinate]
        ends = None
        if at.lower is not None or at.upper is not None:
            ends = words((-WAY if at.lower is None else at.lower, WAY if at.upper is None else at.upper))
        self.out.element(
            "joint",
            name=name,
            type="hinge" if kind == "turn" else "slide",
            pos=words(branch.point) if np.any(branch.point) else None,
            axis=words(axis),
            range=ends,
            damping=at.damping or None,
            stiffness=at.stiffness or None,
            springref=at.free or None,
            frictionloss=at.friction or None,
            armature=at.armature or None,
        )

    def _markers(self, body: str) -> None:
        for name, frame in self.tree.markers_on(body):
            self.out.element("site", name=name, pos=words(frame.origin), quat=_quaternion(frame))

    def _equalities(self) -> None:
        out, notes = self.out, self.tree.notes
        lines = [joint for joint in self.tree.loops if joint.type in ("spherical", "revolute", "fixed")]
        for joint in self.tree.loops:
            if joint not in lines:
                notes.leave(f"joints of type {joint.type} that close a loop", joint.name)
        follows = [each for each in self.tree.follows if each[0] in self.names and each[1] in self.names]
        if not lines and not follows:
            return
        out.start("equality")
        for joint in lines:
            self._loop(joint)
        for first, second, factor, offset in follows:
            out.element(
                "joint", joint1=self.names[first], joint2=self.names[second], polycoef=words((offset, factor, 0, 0, 0))
            )
        out.end()
        notes.change("joints that close loops and couplings are equalities, which are soft in MuJoCo")

    def _loop(self, joint: Joint) -> None:
        """Points that stay together: one, of a revolute joint two on its axis, of a fixed joint a weld."""
        (first, at_first, axes_first), (second, at_second, axes_second) = joint_frames(self.tree.machine, joint)
        names = {"body1": _world(first), "body2": _world(second)}
        if joint.type == "fixed":
            relative = Frame(axes_first, at_first) @ Frame(axes_second, at_second).inverse
            pose = words([*relative.origin, *euler_parameters_from_matrix(relative.axes)])
            self.out.element("weld", name=joint.name, **names, relpose=pose)
            return
        self.out.element("connect", name=joint.name, **names, anchor=words(at_first))
        if joint.type == "revolute":
            self.out.element(
                "connect", name=f"{joint.name}_axis", **names, anchor=words(at_first + APART * axes_first[:, 2])
            )

    def _actuators(self) -> None:
        motors = [each for each in self.tree.motors if each[1] in self.names]
        if not motors:
            return
        self.out.start("actuator")
        for name, coordinate, factor, limit in motors:
            force = None if limit is None else words((-limit / abs(factor), limit / abs(factor)))
            self.out.element(
                "motor", name=name, joint=self.names[coordinate], gear=words((factor, 0, 0, 0, 0, 0)), forcerange=force
            )
        self.out.end()


def _world(body: str) -> str:
    return "world" if body == GROUND else body


def _mesh_name(file: str) -> str:
    return file.rpartition("/")[2].removesuffix(".stl")


def _quaternion(frame: Frame) -> str | None:
    if np.abs(frame.axes - np.eye(3)).max() < 1e-16:
        return None
    return words(euler_parameters_from_matrix(frame.axes))
