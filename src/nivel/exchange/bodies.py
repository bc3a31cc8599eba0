"""Bodies of a mechanism: links that fixed joints connect become one, with a marker at each of the frames that were lumped."""

from collections.abc import Iterable
from typing import Any, Final

import numpy as np

from nivel.exchange.mechanism import WORLD, Array, Connection, Frame, Group, Inertial, Link, Mechanism
from nivel.exchange.translation import triple, turn
from nivel.machine.bodies.inertia import impossible, point_mass_inertia
from nivel.machine.core.orientation import Orientation, rotation_matrix

FLOOR: Final = 1e-11  # of the largest principal moment: the least one that a moment by round-off is raised to
# of the largest moment: by so much a moment may be negative or too large by the round-off of its file
ROUND_OFF: Final = 1e-6
MASSLESS: Final = 1e-15  # of the mass that a link without mass carries: the mass that it gets


def lumped(mechanism: Mechanism, group: Group) -> Inertial | None:
    """Mass, centre and inertia of a group in the frame of its first link; None without any mass.

    The numbers of a single link are those of its file.
    """
    home = mechanism.links[group.first].place
    parts = []
    for name in group.links:
        link = mechanism.links[name]
        if link.inertial is None or (link.inertial.mass == 0.0 and not np.any(link.inertial.inertia)):
            continue
        if name == group.first:
            parts.append(link.inertial)
        else:
            into = home.inverse @ link.place
            centre = into.axes @ link.inertial.centre + into.origin
            parts.append(Inertial(link.inertial.mass, centre, into.axes @ link.inertial.inertia @ into.axes.T))
    return parts[0] if len(parts) == 1 else together(parts)


def between(mechanism: Mechanism, links: Iterable[str]) -> float:
    """[kg] the mass against which a force between two links works; what stands on the ground has none."""
    moving = [lumped(mechanism, group) for link in links if (group := mechanism.groups[link]).first != WORLD]
    return 1.0 / max(sum(1.0 / each.mass for each in moving if each is not None), 1e-12)


@np.errstate(over="ignore", invalid="ignore")  # what is not finite is a fault of the link
def together(parts: Iterable[Inertial]) -> Inertial | None:
    """Several in one frame as one; None where there is no mass."""
    parts = list(parts)
    mass = sum(each.mass for each in parts)
    if not mass > 0.0:
        return None
    centre = sum((each.mass * each.centre for each in parts), np.zeros(3)) / mass
    inertia = sum(
        (each.inertia + point_mass_inertia(each.mass, each.centre - centre) for each in parts), np.zeros((3, 3))
    )
    return Inertial(mass, centre, inertia)


def possible(inertial: Inertial, link: Link, mechanism: Mechanism) -> Inertial:
    """The same with an inertia that a body can have: what is impossible by round-off is raised, other tensors are faults."""
    if not np.isfinite(inertial.inertia).all():
        message = "inertia of the link: it is not finite; a mass, a moment or a place is too large"
        mechanism.fault(link.line, f'<link name="{link.name}">', message)
        return Inertial(1.0, np.zeros(3), np.eye(3))
    if not impossible(inertial.inertia):
        return inertial
    moments, axes = np.linalg.eigh(inertial.inertia)
    scale = float(np.abs(moments).max())
    if scale <= 0.0:
        least = 1e-9 * inertial.mass  # a mass at a point: a ball of about 50 µm
        message = "no inertia is given beside the mass: a moment of 1e-9 m² times the mass is written"
        mechanism.notes.change(message, link.name, link.line)
        return Inertial(inertial.mass, inertial.centre, least * np.eye(3))
    raised = np.maximum(moments, FLOOR * scale) if moments[0] >= -ROUND_OFF * scale else moments
    if why := impossible(axes @ np.diag(raised) @ axes.T):
        mechanism.fault(link.line, f'<link name="{link.name}">', f"inertia of the link: {why}")
        return Inertial(inertial.mass, inertial.centre, np.eye(3))
    message = (
        "a principal moment of inertia was zero or negative by round-off: it is raised to 1e-11 of the largest one"
    )
    mechanism.notes.change(message, link.name, link.line)
    return Inertial(inertial.mass, inertial.centre, axes @ np.diag(raised) @ axes.T)


def carried(mechanism: Mechanism, connection: Connection) -> list[str]:
    """Links beyond a connection, seen from its first body: those that move with its coordinate."""
    found: list[str] = []
    seen = {mechanism.groups[connection.bodies[0]].first, WORLD}
    pending = [mechanism.groups[connection.bodies[1]]]
    outgoing: dict[str, list[Connection]] = {}
    for each in mechanism.connections:
        outgoing.setdefault(mechanism.groups[each.bodies[0]].first, []).append(each)
    while pending:
        group = pending.pop()
        if group.first in seen:
            continue
        seen.add(group.first)
        found += group.links
        pending += [mechanism.groups[each.bodies[1]] for each in outgoing.get(group.first, ())]
    return found


def inertia_about(mechanism: Mechanism, links: Iterable[str], point: Array, axis: Array | None) -> float:
    """[kg m²] moment of links about a global axis through a point, or [kg] their mass where no axis is given."""
    total = 0.0
    for name in links:
        link = mechanism.links[name]
        if link.inertial is None:
            continue
        if axis is None:
            total += link.inertial.mass
            continue
        unit = axis / np.linalg.norm(axis)
        arm = link.place.axes @ link.inertial.centre + link.place.origin - point
        total += float(unit @ (link.place.axes @ link.inertial.inertia @ link.place.axes.T) @ unit)
        total += link.inertial.mass * float(arm @ arm - (arm @ unit) ** 2)
    return total


def marker_frame(mechanism: Mechanism, name: str) -> Frame:
    """The frame of a link in that of its body."""
    place, first = mechanism.links[name].place, mechanism.groups[name].first
    return place if first == WORLD else mechanism.links[first].place.inverse @ place


def marker_on(link: str, inside: Frame, mechanism: Mechanism) -> dict[str, Any]:
    """The marker of a machine file whose frame `inside` is given in a link."""
    frame = inside if link == WORLD else marker_frame(mechanism, link) @ inside
    place = {"position": triple(frame.origin)} if np.any(frame.origin) else {}
    return {"body": mechanism.body(link), **place, **turn(frame.axes)}


def offset(mechanism: Mechanism) -> None:
    """Move what joints carry that follow another one with an offset: to where both agree while the other one is at zero."""
    for each in mechanism.connections:
        other = next((joint for joint in mechanism.connections if each.mimic and joint.name == each.mimic[0]), None)
        if each.mimic is None or other is None or each.kind not in ("revolute", "translational"):
            continue
        wanted = each.mimic[1] * other.placed + each.mimic[2]
        move_to(mechanism, each, wanted)


def move_to(mechanism: Mechanism, each: Connection, wanted: float) -> None:
    """Place what a revolute or translational joint carries where its coordinate is `wanted`."""
    if wanted != each.placed:
        axis = each.axes[0] / np.linalg.norm(each.axes[0])
        carry(mechanism, each, axis, wanted - each.placed, set(carried(mechanism, each)))
        each.placed = wanted


def carry(mechanism: Mechanism, each: Connection, axis: Array, way: float, beyond: set[str]) -> None:
    """Move the links `beyond` a joint by `way` about a unit axis through its point, or along that of a translational one."""
    turned = elementary_turn(axis, way) if each.kind != "translational" else np.eye(3)
    shift = each.point - turned @ each.point if each.kind != "translational" else way * axis
    motion = Frame(turned, shift)
    for name in beyond:
        mechanism.links[name].place = motion @ mechanism.links[name].place
    for other in mechanism.connections:
        if other is not each and other.bodies[0] in beyond:
            other.point = motion.axes @ other.point + motion.origin
            other.axes = tuple(motion.axes @ axis for axis in other.axes)


def elementary_turn(axis: Array, angle: float) -> Array:
    """(3, 3) rotation about a unit axis."""
    x, y, z = axis.tolist()
    return rotation_matrix(Orientation(axis=(x, y, z), angle=angle))
