"""SDF: links and joints of a model, each with a pose relative to another frame; joints may close loops."""

from typing import Final

import numpy as np

from nivel.exchange.contacts import LEFT, add_solid
from nivel.exchange.looks import look_of
from nivel.exchange.mechanism import WORLD, Array, Connection, Frame, Inertial, Link, Look, Mechanism, Surface, turned
from nivel.exchange.translation import Notes
from nivel.exchange.urdf import digits
from nivel.files.xml_source import Document, Element
from nivel.lazy import Struct, field, nivel

KINDS: Final = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "translational",
    "fixed": "fixed",
    "ball": "spherical",
    "universal": "universal",
    "screw": "screw",
    "revolute2": "revolute",
}
KNOWN: Final = ("pose", "link", "joint", "frame", "static", "self_collide", "enable_wind", "allow_auto_disable")
GRAVITY: Final = (0.0, 0.0, -9.8)
GRIPS: Final = 10.0  # friction in place of one without limit
LIMITLESS: Final = f"friction below zero is without limit: {GRIPS:g} is written"
MODEL: Final = "__model__"
THE_WORLD: Final = "world"
NEWER: Final = 1.7  # from this version on, axes are in the frame of the joint unless they say otherwise


class Poses(Struct, frozen=False):
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
        before = (pose.get("relative_to") if pose is not None else "") or default
        self.given[name] = (before, pose_of(element, self.document), element)

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
        turn = np.array([qw, qx, qy, qz])
        length = float(np.linalg.norm(turn))
        axes = nivel.machine.core.orientation.matrix_from_euler_parameters(turn / length) if length else np.eye(3)
        return Frame(axes, np.array([x, y, z]))
    x, y, z, *angles = document.numbers(pose, "", (0.0,) * 6)
    if pose.get("degrees") in ("true", "1"):
        angles = [float(np.deg2rad(each)) for each in angles]
    return Frame(turned(*angles), np.array([x, y, z]))


def read_sdf(document: Document, base: str | None, contacts: str = "all") -> Mechanism:
    """The mechanism of an SDF document. base : `fixed` welds links that no joint carries to the world; default as the file says. contacts :
    `all`, `floor` (what stands still) or `none`. Raises ModelError with all faults."""
    root, notes = document.root, Notes()
    world = root.first("world") or root
    models = [*root.all("model"), *(world.all("model") if world is not root else ())]
    x, y, z = document.numbers(world.first("gravity"), "", GRAVITY)
    given = world.get("name") if len(models) > 1 else models[0].get("name") if models else ""
    mechanism = Mechanism(given or "model", "SDF", (x, y, z), notes=notes)
    if not models:
        document.fault(world, "there is no <model>")
    if world.first("gravity") is None:
        notes.change("gravity is not given: that of SDF, 9.8 m/s² against the z axis, is written")
    for model in models:
        model_of = _Model(
            model, document, mechanism, f"{model.get('name')}::" if len(models) > 1 else "", _version(root)
        )
        model_of.read(base, contacts)
    document.raise_faults()
    if contacts != "none":
        _add_includes(world, mechanism)
    mechanism.stands = world is root and not any(WORLD in each.bodies for each in mechanism.connections)
    return mechanism


def _add_includes(world: Element, mechanism: Mechanism) -> None:
    """The ground plane of Gazebo, and notes of other files."""
    for element in world.all("include"):
        uri = _text(element, "uri")
        if uri.rstrip("/").endswith("ground_plane"):
            add_solid(mechanism, "ground_plane", WORLD, Look("plane", Frame()), Surface(), "ground_plane", element.line)
        elif not uri.rstrip("/").endswith("sun"):
            mechanism.notes.leave("models that the world includes", uri, element.line, acts=True)


def _version(root: Element) -> float:
    try:
        return float(".".join(root.get("version", "1.9").split(".")[:2]))
    except ValueError:
        return NEWER


class _Model:
    """One model of a document, whose names have a prefix in the mechanism where there are several."""

    def __init__(self, element: Element, document: Document, mechanism: Mechanism, prefix: str, version: float) -> None:
        home = pose_of(element, document)
        self.element, self.document, self.mechanism = element, document, mechanism
        self.prefix, self.version = prefix, version
        self.poses = Poses(document, placed={THE_WORLD: Frame(), "": home, MODEL: home})
        self.attached: dict[str, str] = {}

    def read(self, base: str | None, contacts: str) -> None:
        """Add links and joints to the mechanism."""
        model, mechanism, first = self.element, self.mechanism, len(self.mechanism.connections)
        self._add_poses()
        for element in model.all("link"):
            name = element.get("name")
            if not name:
                self.document.fault(element, '`name="…"` is missing')
                continue
            mechanism.links[self.prefix + name] = _link(element, self.prefix, self.poses, self.document, mechanism)
            if contacts != "none":
                self._add_solids(element, contacts)
            elif next(element.all("collision"), None) is not None:
                mechanism.notes.leave(LEFT, name, element.line, acts=True)
        for element in model.all("joint"):
            mechanism.connections += self._joints(element)
        self._add_gears()
        if base == "fixed" or _text(model, "static") in ("true", "1"):
            carried = {each.bodies[1] for each in mechanism.connections}
            tops = [name for each in model.all("link") if (name := self.prefix + each.get("name")) not in carried]
            mechanism.connections += [Connection(f"{top}_base", "fixed", (WORLD, top), np.zeros(3)) for top in tops]
        if base == "free":
            mechanism.connections[first:] = [
                each for each in mechanism.connections[first:] if not (each.kind == "fixed" and WORLD in each.bodies)
            ]
        for child in model.children:
            if child.tag not in KNOWN:
                acts = child.tag in ("model", "include")
                mechanism.notes.leave(f"elements <{child.tag}> of the model", child.get("name"), child.line, acts=acts)

    def _add_poses(self) -> None:
        model, poses, document = self.element, self.poses, self.document
        for element in model.all("link"):
            if element.get("name") in poses.given:
                document.fault(element, f"the name `{element.get('name')}` stands twice")
            poses.add(element.get("name"), element, MODEL)
        for element in model.all("joint"):
            name = element.get("name")
            taken = name in poses.given
            if name in poses.of_joints or (taken and self.version >= NEWER):
                document.fault(element, f"the name `{name}` stands twice")
            poses.of_joints[name] = f"joint {name}" if taken else name
            poses.add(poses.of_joints[name], element, _text(element, "child"))
            self.attached.setdefault(poses.of_joints[name], _text(element, "child"))
        for element in model.all("frame"):
            poses.add(element.get("name"), element, element.get("attached_to") or MODEL)
            self.attached[element.get("name")] = element.get("attached_to")

    def _add_solids(self, element: Element, contacts: str) -> None:
        link, model = element.get("name"), self.element.get("name")
        touching = "true" in (_text(self.element, "self_collide"), _text(element, "self_collide"))
        own = "" if touching and contacts == "all" else model
        for k, each in enumerate(element.all("collision")):
            look = look_of(each, pose_of(each, self.document), "", self.document, 1.0)
            surface, given = each.first("surface"), each.get("name") or f"collision_{k + 1}"
            add_solid(self.mechanism, given, self.prefix + link, look, self._surface(surface), own, each.line)

    def _surface(self, element: Element | None) -> Surface:
        friction, contact = _inner(element, "friction", "ode"), _inner(element, "contact", "ode")
        given = [_value(friction, tag, 1.0, self.document) for tag in ("mu", "mu2")]
        if min(given) < 0.0:
            self.mechanism.notes.change(LIMITLESS, self.element.get("name"), element.line if element else 0)
        mu = min(each if each >= 0.0 else GRIPS for each in given)
        kp, kd = (_value(contact, tag, 0.0, self.document) for tag in ("kp", "kd"))
        if element is not None and _value(element.first("bounce"), "restitution_coefficient", 0.0, self.document):
            self.mechanism.notes.leave("restitution of surfaces", self.element.get("name"), element.line, acts=True)
        return Surface(mu, kp or None, kd or None)

    def _link_of(self, name: str, element: Element, tag: str) -> str:
        """The link of the mechanism that a joint names, itself or by a frame."""
        if name == THE_WORLD:
            return WORLD
        for _ in range(len(self.attached) + 1):
            if self.prefix + name in self.mechanism.links or name not in self.attached:
                break
            name = self.attached[name]
        if self.prefix + name not in self.mechanism.links:
            included = "; models that a model includes are not read" if "::" in name else ""
            self.document.fault(element, f"<{tag}>: there is no link `{name}`{included}")
        return self.prefix + name

    def _joints(self, element: Element) -> list[Connection]:
        """The joint, or the two that a `revolute2` is."""
        document, kind = self.document, element.get("type")
        if kind == "gearbox":
            return []
        bodies = (
            self._link_of(_text(element, "parent"), element, "parent"),
            self._link_of(_text(element, "child"), element, "child"),
        )
        if kind not in KINDS:
            known = ", ".join((*KINDS, "gearbox"))
            document.fault(element, f'type="{kind}" cannot be translated; there are {known}')
        if document.faults:
            return []
        name = self.prefix + element.get("name")
        at = self.poses.place(self.poses.of_joints[element.get("name")])
        joint = Connection(name, KINDS[kind], bodies, at.origin, line=element.line)
        axes = [each for each in (element.first("axis"), element.first("axis2")) if each is not None]
        wanted = {"revolute": 1, "translational": 1, "screw": 1, "universal": 2}.get(joint.kind, 0) + (
            kind == "revolute2"
        )
        if len(axes) < wanted:
            document.fault(element, f"a {kind} joint needs {'<axis> and <axis2>' if wanted == 2 else '<axis>'}")
            return []
        joint.axes = tuple(_direction(each, at, self.poses, document, self.version) for each in axes[:wanted])
        if joint.kind == "screw":
            pitch = element.first("screw_thread_pitch")
            old = _value(element, "thread_pitch", 0.0, document)  # its unit was rad/m, against the sense of the axis
            joint.pitch = (
                document.number(pitch, "", 1.0) if pitch is not None else (-2.0 * np.pi / old if old else None)
            )
        joints = [joint]
        if kind == "revolute2":
            between = f"{name}_between"
            self.mechanism.links[between] = Link(between, at, line=element.line)
            second = Connection(
                f"{name}_2", "revolute", (between, bodies[1]), at.origin, (joint.axes[1],), line=element.line
            )
            joint.bodies, joint.axes, joints = (bodies[0], between), (joint.axes[0],), [joint, second]
        for each, axis in zip(joints, axes, strict=False):
            if each.coordinate:
                _add_forces(each, axis, document, self.mechanism.notes, self.prefix)
        return joints

    def _add_gears(self) -> None:
        """Gearboxes as joints that follow each other: θ₂ = -ratio θ₁, the angles of child and parent from the body of reference."""
        for element in (each for each in self.element.all("joint") if each.get("type") == "gearbox"):
            ends = [self.prefix + _text(element, tag) for tag in ("parent", "child")]
            home = self.prefix + _text(element, "gearbox_reference_body")
            at = self.poses.place(self.poses.of_joints[element.get("name")])
            found: list[tuple[Connection, float]] = []
            for link, tag in zip(ends, ("axis", "axis2"), strict=True):
                axis = element.first(tag) or element.first("axis")
                joints = (each for each in self.mechanism.connections if set(each.bodies) == {home, link})
                joint = next((each for each in joints if each.coordinate == "angle"), None)
                if joint is None or axis is None:
                    continue
                along = float(_direction(axis, at, self.poses, self.document, self.version) @ joint.axes[0])
                found.append((joint, np.sign(along) * (1.0 if joint.bodies[0] == home else -1.0)))
            if len(found) < len(ends) or found[1][0].mimic is not None:
                self.mechanism.notes.leave(
                    "gearboxes without two hinges on one body", element.get("name"), element.line, acts=True
                )
                continue
            (first, one), (second, other) = found
            second.mimic = (first.name, -_value(element, "gearbox_ratio", 1.0, self.document) * one * other, 0.0)


def _inner(element: Element | None, *tags: str) -> Element | None:
    """The element at the end of a way of tags."""
    for tag in tags:
        element = element.first(tag) if element is not None else None
    return element


def _text(element: Element | None, tag: str) -> str:
    child = element.first(tag) if element is not None else None
    return child.text.strip() if child is not None else ""


def _value(element: Element | None, tag: str, default: float, document: Document) -> float:
    child = element.first(tag) if element is not None else None
    if child is not None and child.text.strip().lower().lstrip("+-") in ("inf", "infinity") and np.isinf(default):
        return default
    return document.number(child, "", default)


def _link(element: Element, prefix: str, poses: Poses, document: Document, mechanism: Mechanism) -> Link:
    notes, name = mechanism.notes, prefix + element.get("name")
    link = Link(name, poses.place(element.get("name")), line=element.line)
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
        lift = -link.inertial.mass * np.array(mechanism.gravity)
        mechanism.lifts.append((name, link.inertial.centre, lift))
        notes.change("a link without gravity has a force at its centre of mass", name, element.line)
    for visual in element.all("visual"):
        material = visual.first("material")
        diffuse = material.first("diffuse") if material is not None else None
        parts = 3 if diffuse is not None and len(diffuse.text.split()) == 3 else 4
        colour = digits(document.numbers(diffuse, "", (0.5,) * parts)) if diffuse is not None else ""
        look = look_of(visual, pose_of(visual, document), colour, document, 1.0)
        if isinstance(look, Look):
            link.looks.append(look)
        elif look:
            notes.leave(f"looks: geometry <{look}>", name, visual.line)
    for child in element.children:
        if child.tag in ("sensor", "light", "velocity_decay", "audio_source", "projector", "particle_emitter"):
            notes.leave(f"elements <{child.tag}> of links", name, child.line)
    return link


def _direction(axis: Element, at: Frame, poses: Poses, document: Document, version: float) -> Array:
    xyz = axis.first("xyz")
    direction = np.array(document.numbers(xyz, "", (0.0, 0.0, 1.0)))
    seen_from = xyz.get("expressed_in") if xyz is not None else ""
    if seen_from:
        return poses.place(seen_from).axes @ direction
    if _text(axis, "use_parent_model_frame") in ("true", "1") or version < 1.5:
        return poses.place(MODEL).axes @ direction
    return at.axes @ direction


def _add_forces(joint: Connection, axis: Element, document: Document, notes: Notes, prefix: str) -> None:
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
        joint.mimic = (prefix + mimic.get("joint"), factor, offset - factor * _value(mimic, "reference", 0.0, document))
