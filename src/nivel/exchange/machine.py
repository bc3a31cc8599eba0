"""From a mechanism to the data of a machine file."""

import math
from typing import Any, Final

import numpy as np

from nivel.errors import Fault, refuse
from nivel.exchange import bodies as words
from nivel.exchange import joint_forces
from nivel.exchange.contacts import contacts_of, meet
from nivel.exchange.looks import Drawing
from nivel.exchange.mechanism import MOST_LINKS, WORLD, Connection, Frame, Inertial, Mechanism
from nivel.exchange.translation import Translation, number, triple, turn
from nivel.machine.core.placement import frame_from_axes

NEARLY: Final = 2e-6  # [rad] between axes that a machine may take as parallel
ROUND_OFF: Final = 1e-15  # [rad]
MOST_TOUCHING: Final = 60  # contacts: implicit methods have those that stick in their matrices, which are full
MANY: Final = f"with more than {MOST_TOUCHING} contacts the method is dopri5, whose steps cost less than those of implicit ones then"
LIGHT: Final = "a link without mass between joints has 1e-15 of the mass that it carries: exact to round-off in relative coordinates"


def machine_of(mechanism: Mechanism, file: str, drawing: Drawing) -> Translation:
    """The machine that a mechanism is. Raises ModelError with all links and joints that cannot be translated."""
    mechanism.file = file
    _check(mechanism)
    refuse(mechanism.faults)
    words.offset(mechanism)
    starts = joint_forces.start_values(mechanism)
    if _is_tree(mechanism) and _has_free_root(mechanism):  # which the assembly would turn
        for each in mechanism.connections:
            if each.name in starts:
                words.move_to(mechanism, each, starts[each.name])
    meet(mechanism, drawing)
    data: dict[str, Any] = {"name": _title(mechanism.name)}
    bodies, looks_of_ground = _bodies(mechanism, drawing)
    joints = {
        mechanism.names.name("joint", each.name): _joint(each, mechanism)
        for each in mechanism.connections
        if not each.lumps
    }
    refuse(mechanism.faults)
    if not bodies:
        refuse([Fault(file, 1, 1, "", "nothing in this model moves: every link is fixed to the ground")])
    joint_forces.add_starts(mechanism, starts, joints)
    couplings, forces, inputs, states = {}, {}, {}, {}
    at_joint: dict[str, float] = {}
    for each in mechanism.connections:
        coupling = joint_forces.coupling_of(each, mechanism)
        if coupling is not None:
            couplings[mechanism.names.new(f"{each.name}_mimic", "coupling")] = coupling
        moved = words.carried(mechanism, each)
        effective = words.inertia_about(
            mechanism, moved, each.point, each.axes[0] if each.coordinate == "angle" else None
        )
        at_joint[each.name] = effective + each.armature
        if not each.lumps:
            joint = mechanism.names.name("joint", each.name)
            joints[joint] |= joint_forces.parts_of(each, effective + each.armature, mechanism)
            for made in ("stop", "friction"):
                mechanism.names.new(f"{joint}_{made}", "force")
        for suffix, force in joint_forces.spring_of(each, mechanism).items():
            forces[mechanism.names.new(f"{each.name}_{suffix}", "force")] = force
    for span in mechanism.spans:
        joints[mechanism.names.name("joint", span.name)] = joint_forces.span_joint(span, mechanism)
        at_joint[span.name] = words.between(mechanism, [link for link, _ in span.ends])
    for name, terms in mechanism.sums:
        of = {name: joint_forces.coordinate_of(each, mechanism) for name, each in mechanism.measured.items()}
        coupling = {
            "type": "linear",
            "coordinates": [of[joint] for joint, _ in terms],
            "factors": [number(f) for _, f in terms],
        }
        couplings[mechanism.names.new(name, "coupling")] = coupling
    for actuator in mechanism.actuators:
        control = mechanism.names.name("input", actuator.name)
        made = joint_forces.actuated(actuator, control, mechanism)
        inputs, states = inputs | made["inputs"], states | made["states"]
        forces |= {mechanism.names.new(name, "force"): force for name, force in made["forces"].items()}
    for tendon in mechanism.tendons:
        effective = 1.0 / sum(factor**2 / max(at_joint[joint], 1e-12) for joint, factor in tendon.terms)
        made = joint_forces.pulled(tendon, effective, mechanism)
        forces |= {mechanism.names.new(name, "force"): force for name, force in made.items()}
    for rope in mechanism.ropes:
        forces[mechanism.names.new(rope.name, "force")] = joint_forces.rope_force(rope, mechanism)
    for link, point, vector in mechanism.lifts:
        if mechanism.groups[link].first != WORLD:
            at = words.marker_frame(mechanism, link) @ Frame(origin=point)
            force = {"type": "force", "body": mechanism.body(link), "position": triple(at.origin)}
            forces[mechanism.names.new(f"{link}_gravcomp", "force")] = force | {
                "vector": [number(each) for each in vector]
            }
    markers = _markers(mechanism)
    solids, contacts = contacts_of(mechanism, drawing)
    markers, forces = markers | solids, forces | contacts
    changed = mechanism.names.changed(("body", "marker", "joint", "input"))
    if changed:
        mechanism.notes.change("names that nivel does not take were changed", "; ".join(changed))
        data["description"] = f"Names in {mechanism.format}: {'; '.join(changed)}."
    sections = {
        "surroundings": looks_of_ground,
        "gravity": [number(each) for each in mechanism.gravity],
        "bodies": bodies,
        "markers": markers,
        "joints": joints,
        "couplings": couplings,
        "forces": forces,
        "inputs": inputs,
        "states": states,
    }
    data |= {name: section for name, section in sections.items() if section}
    if _is_tree(mechanism) and _nearly_parallel(mechanism):
        data["assembly"] = {"parallel": 0.0}
        mechanism.notes.change("axes that are parallel to six digits only stay as they are: `assembly: {parallel: 0}`")
    settings: dict[str, Any] = {} if mechanism.step is None or contacts else {"step": mechanism.step}
    if any(LIGHT in each for each in mechanism.notes.changed):
        settings["coordinates"] = "relative"
    if len(contacts) > MOST_TOUCHING:
        settings["integrator"] = "dopri5"
        mechanism.notes.change(MANY)
    data |= {"simulation": settings} if settings else {}
    if losses := mechanism.notes.losses():
        data["left_out"] = losses
    return Translation(file, mechanism.format, data, mechanism.notes, drawing.made, _lines(mechanism))


def _lines(mechanism: Mechanism) -> dict[str, tuple[int, str]]:
    """Where the elements that a link or a joint became come from, by their names."""
    out = {}
    for kind, tag, each in (
        *(("body", "link", each) for each in mechanism.links.values()),
        *(("joint", "joint", each) for each in mechanism.connections),
    ):
        name = mechanism.names.of.get((kind, each.name))
        at = (each.line or 1, f'<{tag if mechanism.format != "MJCF" else kind} name="{each.name}">')
        ends = (
            ("", "_stop", "_friction", "_spring", "_damper", "_rotor", "_rotor_gear", "_mimic")
            if tag == "joint"
            else ("",)
        )
        out |= {} if name is None else {f"{name}{end}": at for end in ends}
    return out


def _is_tree(mechanism: Mechanism) -> bool:
    second = [mechanism.groups[each.bodies[1]].first for each in mechanism.connections if not each.lumps]
    return len(second) == len(set(second))


def _has_free_root(mechanism: Mechanism) -> bool:
    """Whether a body that carries others is the second of no joint."""
    second = {mechanism.groups[each.bodies[1]].first for each in mechanism.connections if not each.lumps}
    return any(mechanism.groups[each.bodies[0]].first not in second | {WORLD} for each in mechanism.connections)


def _nearly_parallel(mechanism: Mechanism) -> bool:
    """Whether axes differ by what a machine takes as the digits of an export, and by more than round-off."""
    axes = [axis / np.linalg.norm(axis) for each in mechanism.connections for axis in each.axes]
    if not axes:
        return False
    z = np.array(axes)
    off = np.linalg.norm(np.cross(z[:, None], z[None, :]), axis=2)
    return bool(np.any((off > ROUND_OFF) & (off < NEARLY)))


def _title(name: str) -> str:
    kept = "".join("_" if each in '/\\<>:"|?*' or not each.isprintable() else each for each in name).strip()
    return kept[:100] or "model"


def _check(mechanism: Mechanism) -> None:
    if len(mechanism.links) > MOST_LINKS:
        mechanism.fault(1, "", f"{len(mechanism.links)} links; up to {MOST_LINKS} are translated")
    for each in mechanism.connections:
        where = f'<joint name="{each.name}">'
        unknown = [link for link in each.bodies if link != WORLD and link not in mechanism.links]
        for link in unknown:
            mechanism.fault(each.line, where, f"there is no link `{link}`")
        if each.bodies[0] == each.bodies[1]:
            mechanism.fault(each.line, where, f"the joint connects `{each.bodies[0]}` with itself")
        if not all(0.0 < float(axis @ axis) < math.inf for axis in each.axes):
            mechanism.fault(each.line, where, "the axis has no direction: it is zero, or as good as that")


def _bodies(mechanism: Mechanism, drawing: Drawing) -> tuple[dict[str, Any], list[Any]]:
    """Data of all bodies by name, and what is drawn on the ground."""
    bodies: dict[str, Any] = {}
    on_ground: list[Any] = []
    joined = {mechanism.groups[name].first for each in mechanism.connections if not each.lumps for name in each.bodies}
    loose = {group.first for group in mechanism.groups.values()} - joined
    for first, group in {group.first: group for group in mechanism.groups.values()}.items():
        drawn = [
            shape
            for name in group.links
            for shape in drawing.shapes(mechanism.links[name], words.marker_frame(mechanism, name), mechanism.notes)
        ]
        if first == WORLD:
            on_ground = drawn
            for name in group.links:
                if mechanism.links[name].inertial is not None:
                    mechanism.notes.leave(
                        "mass of links on the ground, which does not move", name, mechanism.links[name].line
                    )
            continue
        link, inertial = mechanism.links[first], words.lumped(mechanism, group)
        if inertial is None:
            if first in loose:
                mechanism.notes.leave("links without mass and without joints", link.name, link.line)
                continue
            inertial = _light(mechanism, first)
        else:
            inertial = words.possible(inertial, link, mechanism)
        body: dict[str, Any] = {"position": triple(link.place.origin), **turn(link.place.axes)}
        body |= {"mass": inertial.mass, "centre_of_mass": triple(inertial.centre), "inertia": _inertia(inertial)}
        body = {key: value for key, value in body.items() if key not in ("position", "centre_of_mass") or any(value)}
        bodies[mechanism.names.name("body", first)] = body | ({"looks": drawn} if drawn else {})
    return bodies, on_ground


def _light(mechanism: Mechanism, first: str) -> Inertial:
    """Mass and inertia of a link that has none and moves: by what it carries."""
    link = mechanism.links[first]
    beyond = [
        name
        for each in mechanism.connections
        if mechanism.groups[each.bodies[0]].first == first and not each.lumps
        for name in words.carried(mechanism, each)
    ]
    mass = words.inertia_about(mechanism, beyond, np.zeros(3), None)
    if mass <= 0.0:
        message = "the link moves and has no mass; give it `<inertial>`, or connect it by a fixed joint"
        mechanism.fault(link.line, f'<link name="{link.name}">', message)
        mass = 1.0
    else:
        mechanism.notes.change(LIGHT, link.name, link.line)
    return Inertial(words.MASSLESS * mass, np.zeros(3), words.MASSLESS * mass * np.eye(3))


def _inertia(inertial: Inertial) -> Any:
    i = inertial.inertia
    products = {"xy": float(i[0, 1]), "xz": float(i[0, 2]), "yz": float(i[1, 2])}
    moments = {"xx": float(i[0, 0]), "yy": float(i[1, 1]), "zz": float(i[2, 2])}
    if not any(products.values()):
        return list(moments.values())
    return moments | {key: value for key, value in products.items() if value}


def _joint(each: Connection, mechanism: Mechanism) -> dict[str, Any]:
    bodies = [mechanism.body(name) for name in each.bodies]
    rotor = {"rotor_inertia": number(each.armature)} if each.armature else {}
    if each.placed or each.frames is not None:
        return {"type": each.kind, "markers": _joint_markers(each, mechanism), **rotor}
    out: dict[str, Any] = {"type": each.kind, "bodies": bodies, "point": triple(each.point)}
    if len(each.axes) == 1:
        out["axis"] = triple(each.axes[0])
    elif each.axes:
        out["axes"] = [triple(axis) for axis in each.axes]
    if each.pitch is not None:
        out["pitch"] = number(each.pitch)
    return out | rotor


def _joint_markers(each: Connection, mechanism: Mechanism) -> list[dict[str, Any]]:
    """The two markers of a joint whose coordinate is not zero where the links stand: z along its axis."""
    if each.frames is not None:
        places = [Frame() if name == WORLD else mechanism.links[name].place for name in each.bodies]
        frames = [place @ frame for place, frame in zip(places, each.frames, strict=True)]
    else:
        first = Frame(frame_from_axes(each.axes[0]), each.point)
        if each.kind == "revolute":
            second = Frame(first.axes @ words.elementary_turn(np.array([0.0, 0.0, 1.0]), each.placed), each.point)
        else:
            second = Frame(first.axes, each.point + each.placed * first.axes[:, 2])
        frames = [first, second]
    out = []
    for name, frame in zip(each.bodies, frames, strict=True):
        first = mechanism.groups[name].first
        inside = frame if first == WORLD else mechanism.links[first].place.inverse @ frame
        out.append({"body": mechanism.body(name), "position": triple(inside.origin), **turn(inside.axes)})
    return out


def _markers(mechanism: Mechanism) -> dict[str, Any]:
    out = {}
    for name, group in mechanism.groups.items():
        if name not in (WORLD, group.first):
            out[mechanism.names.name("marker", name)] = words.marker_on(name, Frame(), mechanism)
            mechanism.notes.change("links on fixed joints are parts of their bodies, their frames are markers", name)
    for name, link, inside in mechanism.sites:
        out[mechanism.names.name("marker", name)] = words.marker_on(link, inside, mechanism)
    return out
