"""URDF: links and joints of a tree, each joint placed in the link before it."""

from typing import Any, Final

import numpy as np

from nivel.exchange.contacts import LEFT, add_solid
from nivel.exchange.looks import look_of
from nivel.exchange.mechanism import WORLD, Connection, Frame, Inertial, Link, Look, Mechanism, Surface, turned
from nivel.exchange.translation import Notes
from nivel.files.xml_source import Document, Element

KINDS: Final = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "translational",
    "fixed": "fixed",
    "planar": "planar",
}
GRAVITY: Final = (0.0, 0.0, -9.81)
# of other programs, beside the model
FOREIGN: Final = {
    "transmission": "transmissions",
    "gazebo": "elements of Gazebo",
    "ros2_control": "elements of ros2_control",
}


def read_urdf(document: Document, base: str | None, contacts: str = "all") -> Mechanism:
    """The mechanism of a URDF document. base : `fixed` or `free`; default fixed. contacts : `none` leaves them out. Raises ModelError with
    all faults."""
    root = document.root
    name = root.get("name") or "robot"
    mechanism = Mechanism(name, "URDF", GRAVITY)
    notes = mechanism.notes
    colours = {each.get("name"): colour for each in root.all("material") if (colour := _colour(each, document))}
    surfaces, touching = _surfaces(root, document)
    for element in root.all("link"):
        link = _link(element, document, colours, notes)
        if link.name in mechanism.links:
            document.fault(element, f"the name `{link.name}` stands twice")
        mechanism.links[link.name] = link
        if contacts != "none":
            own = name if contacts == "floor" or link.name not in touching else ""
            _add_solids(element, document, mechanism, surfaces.get(link.name, Surface()), own)
        elif next(element.all("collision"), None) is not None:
            notes.leave(LEFT, link.name, element.line, acts=True)
    mechanism.stands = base == "free"
    for child in root.children:
        if child.tag not in ("link", "joint", "material"):
            notes.leave(FOREIGN.get(child.tag, f"elements <{child.tag}>"), child.get("name"), child.line)
    parents: dict[str, Element] = {}
    for element in root.all("joint"):
        child = _named(element, "child", document)
        if child in parents:
            document.fault(element, f"the link `{child}` is the child of two joints; a URDF is a tree")
        parents[child] = element
        _named(element, "parent", document)
    if not mechanism.links:
        document.fault(root, "there is no <link>")
    document.raise_faults()
    _place(mechanism, parents, document)
    document.raise_faults()
    seen: set[str] = set()
    for element in root.all("joint"):
        joint = _joint(element, mechanism, document)
        if joint is None:
            continue
        if joint.name in seen:
            document.fault(element, f"the name `{joint.name}` stands twice")
        seen.add(joint.name)
        mechanism.connections.append(joint)
    document.raise_faults()
    if base != "free":
        for top in (name for name in mechanism.links if name not in parents):
            mechanism.connections.append(Connection(f"{top}_base", "fixed", (WORLD, top), np.zeros(3)))
    notes.change("gravity is no part of URDF: 9.81 m/s² against the z axis is written")
    return mechanism


def _named(joint: Element, tag: str, document: Document) -> str:
    element = joint.first(tag)
    name = element.get("link") if element is not None else ""
    if not name:
        document.fault(joint, f'`<{tag} link="…"/>` is missing')
    return name


def frame_of(element: Element | None, document: Document) -> Frame:
    """The frame that the <origin> of an element gives."""
    origin = element.first("origin") if element is not None else None
    if origin is None:
        return Frame()
    roll, pitch, yaw = document.numbers(origin, "rpy", (0.0, 0.0, 0.0))
    return Frame(turned(roll, pitch, yaw), np.array(document.numbers(origin, "xyz", (0.0, 0.0, 0.0))))


def _colour(material: Element | None, document: Document) -> str:
    """`#rrggbb` of a material, or an empty text."""
    colour = material.first("color") if material is not None else None
    if colour is None:
        return ""
    return digits(document.numbers(colour, "rgba", (0.5, 0.5, 0.5, 1.0)))


def digits(colour: Any) -> str:
    """`#rrggbb` for red, green and blue from 0 to 1."""
    return "#" + "".join(f"{round(255 * min(max(float(part), 0.0), 1.0)):02x}" for part in tuple(colour)[:3])


def _link(element: Element, document: Document, colours: dict[str, str], notes: Notes) -> Link:
    link = Link(element.get("name"), Frame(), line=element.line)
    if not link.name:
        document.fault(element, '`name="…"` is missing')
    inertial = element.first("inertial")
    if inertial is not None:
        link.inertial = _inertial(inertial, document)
    for visual in element.all("visual"):
        material = visual.first("material")
        colour = _colour(material, document) or colours.get(material.get("name") if material is not None else "", "")
        look = look_of(visual, frame_of(visual, document), colour, document, 0.0)
        if isinstance(look, Look):
            link.looks.append(look)
        elif look:
            notes.leave(f"looks: geometry <{look}>", link.name, visual.line)
    return link


def _add_solids(element: Element, document: Document, mechanism: Mechanism, surface: Surface, model: str) -> None:
    link = element.get("name")
    for k, each in enumerate(element.all("collision")):
        look = look_of(each, frame_of(each, document), "", document, 0.0)
        add_solid(mechanism, each.get("name") or f"collision_{k + 1}", link, look, surface, model, each.line)


def _surfaces(root: Element, document: Document) -> tuple[dict[str, Surface], set[str]]:
    """Surfaces of links by name, and the links that touch others of their robot, as <gazebo reference="…"> says."""
    found: dict[str, Surface] = {}
    touching = set()
    for element in root.all("gazebo"):
        link = element.get("reference")
        given = {
            tag: document.number(element.first(tag), "", 0.0)
            for tag in ("mu1", "mu2", "kp", "kd")
            if element.first(tag)
        }
        friction = min((given[tag] for tag in ("mu1", "mu2") if tag in given), default=1.0)
        found[link] = Surface(friction, given.get("kp"), given.get("kd"))
        own = element.first("selfCollide") or element.first("self_collide")
        touching |= {link} if own is not None and own.text.strip() in ("true", "1") else set()
    return found, touching


def _inertial(element: Element, document: Document) -> Inertial:
    at, tensor, mass = frame_of(element, document), element.first("inertia"), element.first("mass")
    value = document.number(mass, "value", 0.0)
    if value < 0.0:
        document.fault(mass or element, f"the mass is {value:g}; zero or more was expected")
    xx, yy, zz, xy, xz, yz = (document.number(tensor, key, 0.0) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if np.any(at.axes != np.eye(3)):
        inertia = at.axes @ inertia @ at.axes.T
    return Inertial(value, at.origin, inertia)


def _place(mechanism: Mechanism, parents: dict[str, Element], document: Document) -> None:
    """Put every link where all joint coordinates are zero."""
    links = mechanism.links
    placed = links.keys() - parents.keys()
    for end in links:
        name, chain = end, dict[str, str]()  # link → the one before it, up to one that is placed
        while name not in placed:
            joint = parents[name]
            before = chain[name] = _named(joint, "parent", document)
            if before not in links:
                document.fault(joint, f"there is no link `{before}`")
                break
            if before in chain:
                document.fault(joint, f"the links lead back to `{before}`; a URDF is a tree")
                break
            name = before
        for link, before in reversed(chain.items()):
            if before in links:
                links[link].place = links[before].place @ frame_of(parents[link], document)
            placed.add(link)
    for child, joint in parents.items():
        if child not in mechanism.links:
            document.fault(joint, f"there is no link `{child}`")


def _joint(element: Element, mechanism: Mechanism, document: Document) -> Connection | None:
    """The joint; None of a floating one, whose link is free."""
    kind = element.get("type")
    bodies = (_named(element, "parent", document), _named(element, "child", document))
    at = mechanism.links[bodies[1]].place
    given = Connection(element.get("name"), KINDS.get(kind, "fixed"), bodies, at.origin, line=element.line)
    if not given.name:
        document.fault(element, '`name="…"` is missing')
    if kind == "floating":
        mechanism.notes.change("floating joints: the link is free", given.name, element.line)
        return None
    if kind not in KINDS:
        document.fault(element, f'type="{kind}" is not known; there are {", ".join((*KINDS, "floating"))}')
    if given.kind == "fixed":
        return given
    axis = document.numbers(element.first("axis"), "xyz", (1.0, 0.0, 0.0))
    given.axes = (at.axes @ np.array(axis),)
    _add_forces(given, element, kind, document, mechanism.notes)
    return given


def _add_forces(joint: Connection, element: Element, kind: str, document: Document, notes: Notes) -> None:
    limit, dynamics, mimic = element.first("limit"), element.first("dynamics"), element.first("mimic")
    if limit is not None:
        if kind != "continuous":
            joint.lower, joint.upper = document.number(limit, "lower", 0.0), document.number(limit, "upper", 0.0)
        joint.effort = document.number(limit, "effort", 0.0) or None
        if document.number(limit, "velocity", 0.0):
            notes.leave("limits of speed", joint.name, limit.line)
    joint.damping = document.number(dynamics, "damping", 0.0)
    joint.friction = document.number(dynamics, "friction", 0.0)
    for value, what in ((joint.damping, "damping"), (joint.friction, "friction")):
        if value < 0.0 and dynamics is not None:
            document.fault(dynamics, f"the {what} is {value:g}; zero or more was expected")
    if mimic is not None:
        factor, offset = document.number(mimic, "multiplier", 1.0), document.number(mimic, "offset", 0.0)
        joint.mimic = (mimic.get("joint"), factor, offset)
    for tag in ("calibration", "safety_controller"):
        if element.first(tag) is not None:
            notes.leave(f"elements <{tag}>", joint.name, element.line)
