"""SDF: links and joints of a model, each with a pose relative to another frame; joints may close loops."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from nivel.exchange.mechanism import WORLD, Array, Connection, Frame, Inertial, Link, Look, Mechanism, turned
from nivel.exchange.translation import Notes
from nivel.exchange.urdf import digits
from nivel.files.xml_source import Document, Element
from nivel.lazy import dataclass, field, nivel

KINDS: Final = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "translational",
    "fixed": "fixed",
    "ball": "spherical",
    "universal": "universal",
    "screw": "screw",
}
GRAVITY: Final = (0.0, 0.0, -9.8)
MODEL: Final = "__model__"
THE_WORLD: Final = "world"
NEWER: Final = 1.7  # from this version on, axes are in the frame of the joint unless they say otherwise


@dataclass
class Poses:
    """Frames of a model by name: what each is attached to, its own pose, and its element. Those of joints are relative to their child.

    of_joints : names of the frames of joints, which may have the name of a link before SDF 1.7.
    """

    document: Document
    given: dict[str, tuple[str, Frame, Element]] = field(default_factory=dict)
    placed: dict[str, Frame] = field(default_factory=dict)
    of_joints: dict[str, str] = field(default_factory=dict)

    def add(self, name: str, element: Element, default: str) -> None:
        """A frame whose <pose> is relative to `default` unless it says otherwise."""
        pose = element.first("pose")
        self.given[name] = (
            (pose.get("relative_to") if pose is not None else "") or default,
            pose_of(element, self.document),
            element,
        )

    def place(self, name: str) -> Frame:
        """The global frame. Faults go to the document."""
        chain: list[str] = []
        while name not in self.placed and name not in (MODEL, THE_WORLD, ""):
            if name in chain:
                self.document.fault(self.given[name][2], f"the poses lead back to `{name}`")
                break
            if name not in self.given:
                at = self.given[chain[-1]][2] if chain else self.document.root
                self.document.fault(at, f"there is no frame `{name}`")
                break
            chain.append(name)
            name = self.given[name][0]
        frame = self.placed.get(name, self.placed[MODEL])
        for each in reversed(chain):
            frame = frame @ self.given[each][1]
            self.placed[each] = frame
        return frame


def pose_of(element: Element, document: Document) -> Frame:
    """The frame of the <pose> of an element."""
    pose = element.first("pose")
    if pose is None:
        return Frame()
    if pose.get("rotation_format") == "quat_xyzw":
        x, y, z, qx, qy, qz, qw = document.numbers(pose, "", (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0))
        return Frame(_axes_of((qw, qx, qy, qz)), np.array([x, y, z]))
    x, y, z, *angles = document.numbers(pose, "", (0.0,) * 6)
    if pose.get("degrees") in ("true", "1"):
        angles = [float(np.deg2rad(each)) for each in angles]
    return Frame(turned(*angles), np.array([x, y, z]))


def _axes_of(parameters: tuple[float, ...]) -> Array:
    length = float(np.linalg.norm(parameters))
    return (
        nivel.machine.core.orientation.matrix_from_euler_parameters(np.array(parameters) / length)
        if length
        else np.eye(3)
    )


def read_sdf(document: Document, base: str | None) -> Mechanism:
    """The mechanism of an SDF document with one model. base : `fixed` welds links that no joint carries to the world; default as the
    file says. Raises ModelError with all faults."""
    root, notes = document.root, Notes()
    world = root.first("world") or root
    models = [*root.all("model"), *(world.all("model") if world is not root else ())]
    x, y, z = document.numbers(world.first("gravity"), "", GRAVITY)
    mechanism = Mechanism(models[0].get("name") if models else "model", "SDF", (x, y, z), notes=notes)
    if len(models) != 1:
        document.fault(world, f"{len(models)} models stand here; one is translated: save each in a file of its own")
    if world.first("gravity") is None:
        notes.change("gravity is not given: that of SDF, 9.8 m/s² against the z axis, is written")
    document.raise_faults()
    model = models[0]
    _model(model, document, mechanism, base, _version(root))
    document.raise_faults()
    for child in model.children:
        if child.tag not in (
            "pose",
            "link",
            "joint",
            "frame",
            "static",
            "self_collide",
            "enable_wind",
            "allow_auto_disable",
        ):
            notes.leave(f"elements <{child.tag}> of the model", child.get("name"), child.line)
    return mechanism


def _version(root: Element) -> float:
    try:
        return float(".".join(root.get("version", "1.9").split(".")[:2]))
    except ValueError:
        return NEWER


def _model(model: Element, document: Document, mechanism: Mechanism, base: str | None, version: float) -> None:
    poses = Poses(document, placed={THE_WORLD: Frame(), "": pose_of(model, document), MODEL: pose_of(model, document)})
    for element in model.all("link"):
        if element.get("name") in poses.given:
            document.fault(element, f"the name `{element.get('name')}` stands twice")
        poses.add(element.get("name"), element, MODEL)
    for element in model.all("joint"):
        name = element.get("name")
        taken = name in poses.given
        if name in poses.of_joints or (taken and version >= NEWER):
            document.fault(element, f"the name `{name}` stands twice")
        poses.of_joints[name] = f"joint {name}" if taken else name
        poses.add(poses.of_joints[name], element, _text(element, "child"))
    for element in model.all("frame"):
        poses.add(element.get("name"), element, element.get("attached_to") or MODEL)
    for element in model.all("link"):
        name = element.get("name")
        if not name:
            document.fault(element, '`name="…"` is missing')
            continue
        mechanism.links[name] = _link(element, poses, document, mechanism.notes)
    for element in model.all("joint"):
        joint = _joint(element, poses, document, mechanism, version)
        if joint is not None:
            mechanism.connections.append(joint)
    static = model.first("static")
    if base == "fixed" or (static is not None and static.text.strip() in ("true", "1")):
        for top in mechanism.roots():
            mechanism.connections.append(Connection(f"{top}_base", "fixed", (WORLD, top), np.zeros(3)))
    if base == "free":
        mechanism.connections[:] = [
            each for each in mechanism.connections if not (each.kind == "fixed" and WORLD in each.bodies)
        ]


def _text(element: Element | None, tag: str) -> str:
    child = element.first(tag) if element is not None else None
    return child.text.strip() if child is not None else ""


def _value(element: Element | None, tag: str, default: float, document: Document) -> float:
    child = element.first(tag) if element is not None else None
    if child is not None and child.text.strip().lower().lstrip("+-") in ("inf", "infinity") and np.isinf(default):
        return default
    return document.number(child, "", default)


def _link(element: Element, poses: Poses, document: Document, notes: Notes) -> Link:
    name = element.get("name")
    link = Link(name, poses.place(name), line=element.line)
    inertial = element.first("inertial")
    if inertial is None:
        link.inertial = Inertial(1.0, np.zeros(3), np.eye(3))
        notes.change("a link without <inertial> has that of SDF: 1 kg, 1 kg m² about each axis", name, element.line)
    else:
        at, tensor = pose_of(inertial, document), inertial.first("inertia")
        xx, yy, zz = (_value(tensor, key, 1.0, document) for key in ("ixx", "iyy", "izz"))
        xy, xz, yz = (_value(tensor, key, 0.0, document) for key in ("ixy", "ixz", "iyz"))
        inertia = at.axes @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ at.axes.T
        link.inertial = Inertial(_value(inertial, "mass", 1.0, document), at.origin, inertia)
        if link.inertial.mass < 0.0:
            document.fault(inertial, f"the mass is {link.inertial.mass:g}; zero or more was expected")
    if _text(element, "gravity") in ("false", "0"):
        document.fault(element, "a link without gravity cannot be translated; remove <gravity>")
    for visual in element.all("visual"):
        look = _look(visual, document, notes, name)
        if look is not None:
            link.looks.append(look)
    for child in element.children:
        if child.tag == "collision":
            notes.leave("collision geometry; a contact is a force of type `contact`", name, child.line, acts=True)
        elif child.tag in ("sensor", "light", "velocity_decay", "audio_source", "projector", "particle_emitter"):
            notes.leave(f"elements <{child.tag}> of links", name, child.line)
    return link


def _look(visual: Element, document: Document, notes: Notes, name: str) -> Look | None:
    geometry, material = visual.first("geometry"), visual.first("material")
    solid = geometry.children[0] if geometry is not None and geometry.children else None
    if solid is None:
        return None
    colour = material.first("diffuse") if material is not None else None
    painted = digits(document.numbers(colour, "", (0.5, 0.5, 0.5, 1.0))) if colour is not None else ""
    common: dict[str, Any] = {"place": pose_of(visual, document), "colour": painted, "line": visual.line}
    match solid.tag:
        case "box":
            return Look("box", sizes=document.numbers(solid.first("size"), "", (1.0, 1.0, 1.0)), **common)
        case "cylinder" | "capsule":
            sizes = _value(solid, "radius", 0.5, document), _value(solid, "length", 1.0, document)
            return Look("cylinder" if solid.tag == "cylinder" else "capsule", sizes=sizes, **common)
        case "sphere":
            return Look("sphere", sizes=(_value(solid, "radius", 0.5, document),), **common)
        case "mesh":
            x, y, z = document.numbers(solid.first("scale"), "", (1.0, 1.0, 1.0))
            return Look("mesh", file=_text(solid, "uri"), scale=(x, y, z), **common)
    notes.leave(f"looks: geometry <{solid.tag}>", name, solid.line)
    return None


def _joint(
    element: Element, poses: Poses, document: Document, mechanism: Mechanism, version: float
) -> Connection | None:
    name, kind = element.get("name"), element.get("type")
    parent, child = _text(element, "parent"), _text(element, "child")
    bodies = (WORLD if parent == THE_WORLD else parent), child
    for each, tag in zip(bodies, ("parent", "child"), strict=True):
        if each != WORLD and each not in mechanism.links:
            document.fault(element, f"<{tag}>: there is no link `{each}`")
    if kind not in KINDS:
        document.fault(element, f'type="{kind}" cannot be translated; there are {", ".join(KINDS)}')
    if document.faults:
        return None
    at = poses.place(poses.of_joints[name])
    joint = Connection(name, KINDS[kind], bodies, at.origin, line=element.line)
    axes = [each for each in (element.first("axis"), element.first("axis2")) if each is not None]
    wanted = {"revolute": 1, "translational": 1, "screw": 1, "universal": 2}.get(joint.kind, 0)
    if len(axes) < wanted:
        document.fault(element, f"a {kind} joint needs {'<axis> and <axis2>' if wanted == 2 else '<axis>'}")
        return None
    joint.axes = tuple(_direction(each, at, poses, document, version) for each in axes[:wanted])
    if joint.kind == "screw":
        pitch = element.first("screw_thread_pitch")
        old = _value(element, "thread_pitch", 0.0, document)  # its unit was rad/m, against the sense of the axis
        joint.pitch = document.number(pitch, "", 1.0) if pitch is not None else (-2.0 * np.pi / old if old else None)
    if joint.coordinate:
        _add_forces(joint, axes[0], document, mechanism.notes)
    return joint


def _direction(axis: Element, at: Frame, poses: Poses, document: Document, version: float) -> Array:
    xyz = axis.first("xyz")
    direction = np.array(document.numbers(xyz, "", (0.0, 0.0, 1.0)))
    seen_from = xyz.get("expressed_in") if xyz is not None else ""
    if seen_from:
        return poses.place(seen_from).axes @ direction
    if _text(axis, "use_parent_model_frame") in ("true", "1") or version < 1.5:
        return poses.place(MODEL).axes @ direction
    return at.axes @ direction


def _add_forces(joint: Connection, axis: Element, document: Document, notes: Notes) -> None:
    limit, dynamics = axis.first("limit"), axis.first("dynamics")
    if limit is not None:
        lower, upper = _value(limit, "lower", -np.inf, document), _value(limit, "upper", np.inf, document)
        joint.lower = lower if np.isfinite(lower) else None
        joint.upper = upper if np.isfinite(upper) else None
        effort = _value(limit, "effort", -1.0, document)
        joint.effort = effort if effort > 0.0 else None
        if _value(limit, "velocity", -1.0, document) > 0.0:
            notes.leave("limits of speed", joint.name, limit.line)
    joint.damping = _value(dynamics, "damping", 0.0, document)
    joint.friction = _value(dynamics, "friction", 0.0, document)
    joint.stiffness = _value(dynamics, "spring_stiffness", 0.0, document)
    joint.free = _value(dynamics, "spring_reference", 0.0, document)
    mimic = axis.first("mimic")
    if mimic is not None:
        factor, offset = _value(mimic, "multiplier", 1.0, document), _value(mimic, "offset", 0.0, document)
        joint.mimic = (mimic.get("joint"), factor, offset - factor * _value(mimic, "reference", 0.0, document))
