"""Friction in joints in numbers."""

from __future__ import annotations

from nivel.elements.kind import Kind
from nivel.elements.states import StateFact
from nivel.kernels.bodies.coordinate import ALONG, CROSS_SECOND
from nivel.kernels.bodies.patch_coordinate import PATCH
from nivel.kernels.elements import friction
from nivel.kernels.record.record import NONE
from nivel.machine.forces.contact import Contact
from nivel.machine.forces.friction import Friction
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.builder import GROUND, SystemBuilder
from nivel.system.forces.friction_works import add_friction_work
from nivel.system.forces.outputs import effort_and_power, force_outputs, is_angle


def add_friction(builder: SystemBuilder, force: Friction) -> None:
    """Friction in a joint coordinate: an extra row, see `nivel.kernels.elements.friction`."""
    joint, _ = resolve(force.coordinate, builder.machine.joints)
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    entries = [
        *effort_and_power(angle, "effort on the coordinate"),
        ("normal_load", "N", "normal load"),
    ]
    state = NONE
    if force.model == "lugre":
        entries.append(("bristle", "m", "deflection of the bristles"))
        assert force.bristle_stiffness is not None  # the record was checked
        # deflection of the bristles in steady sliding
        scale = force.coefficient / force.bristle_stiffness
        name = f"{force.name}.bristle"
        state = builder.own_state(StateFact(name, "m", f"deflection of the bristles of {force.name}", 0.0, scale))
    first = force_outputs(builder, force.name, *entries)
    model = {"coulomb": friction.COULOMB, "stiction": friction.STICTION, "lugre": friction.LUGRE}[force.model]
    loaded_by = NONE if force.normal_load is not None else [each.name for each in builder.machine.joints].index(joint)
    radius = force.radius or 0.0
    kind, seen_from, to, _ = builder.coordinates.what[coordinate]
    frame = to if kind == CROSS_SECOND else seen_from
    # what slides on a beam has its bearing with it: `to` is only the first of the nodes
    bearing = seen_from if kind == ALONG else _bearing(builder, seen_from, to)
    index = [coordinate, model, loaded_by, int(angle), state, first, frame, bearing, NONE, NONE]
    numbers = [
        force.coefficient,
        force.static,
        1.0 if force.stribeck_speed is None else force.stribeck_speed,
        force.transition_speed or 1.0,
        force.viscous,
        force.bristle_stiffness or 0.0,
        force.bristle_damping,
        radius if angle else 1.0,
        force.collar_radius / radius if angle else 0.0,
        2.0 / force.bearing_length if force.bearing_length else 0.0,
        1.0 / radius if radius and not angle else 0.0,
        force.normal_load if force.normal_load is not None else force.preload,
        0.0,
    ]
    builder.frictions.append((index, numbers))
    builder.friction_names.append(force.name)


def add_patch(builder: SystemBuilder, contact: Contact, ends: tuple[int, int], output: int, spins: bool) -> list[int]:
    """Frictions along two tangents and, where the contact `spins`, about the normal. ends : markers of the two bodies. output : first one
    of the contact. Returns the first friction, how many there are, and the first coordinate: see `nivel.kernels.elements.patch`."""
    first, count = len(builder.frictions), 3 if spins else 2
    coordinates = [builder.coordinates.add(PATCH, *ends, axis) for axis in range(count)]
    work = add_friction_work(builder, contact.name, NONE) if contact.friction_work else NONE
    for axis, coordinate in enumerate(coordinates):
        index = [coordinate, friction.PATCH, NONE, int(axis == 2), work, output, *ends, first, count]
        numbers = [contact.friction, contact.static, 0.0, 1.0, *[0.0] * 3, 1.0, *[0.0] * 5]
        builder.frictions.append((index, numbers))
        builder.friction_names.append(f"{contact.name}.{('slip_x', 'slip_y', 'spin')[axis]}")
    return [first, count, coordinates[0]]


def _bearing(builder: SystemBuilder, first: int, second: int) -> int:
    """Which of two markers is at the bearing: that of the second body, unless this is the ground and the first is not."""
    ground = builder.body(GROUND)
    return first if builder.markers.body[second] == ground != builder.markers.body[first] else second


KINDS = (Kind(Friction, add_friction, ()),)
