"""Contacts of many spheres in numbers."""

from __future__ import annotations

import numpy as np

from nivel.elements.forces.friction import WORK, add_friction_work
from nivel.elements.kind import Kind
from nivel.kernels.forces import friction_work, heap
from nivel.kernels.record.record import NONE
from nivel.machine.bodies.shape import Sphere
from nivel.machine.forces.contacts import Contacts
from nivel.machine.machine_record import MachineRecord
from nivel.system.builder import SystemBuilder
from nivel.system.forces.contacts import law_numbers
from nivel.system.forces.outputs import force_outputs, magnitude_and_power

# From so many spheres on pairs are found by cells, which are so many times as large as the largest sphere.
MANY, CELL = 128, 1.25


def spheres_between(machine: MachineRecord, force: Contacts) -> list[str]:
    """Names of the bodies that touch each other."""
    return list(force.between) or [body.name for body in machine.bodies if isinstance(body.shape, Sphere)]


def add_contacts(builder: SystemBuilder, force: Contacts) -> None:
    """One row for all pairs, with a place to remember for each: of every sphere those with the planes, then with the spheres before it."""
    first = force_outputs(
        builder,
        force.name,
        *magnitude_and_power("N"),
        ("depth", "m", "deepest overlap"),
        ("normal_force", "N", "sum of the normal forces"),
        ("friction_force", "N", "sum of the friction forces"),
        ("friction_power", "W", "power that friction turns to heat"),
        ("count", "1", "number of pairs that touch"),
        *((WORK,) if force.friction_work else ()),
    )
    if force.friction_work:
        add_friction_work(builder, force.name, first + heap.LOST_POWER)
    names = spheres_between(builder.machine, force)
    markers, radii = [], []
    for name in names:
        shape = builder.machine.body_named[name].shape
        assert isinstance(shape, Sphere)  # the record was checked
        markers.append(builder.place((name, np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), np.eye(3))))
        radii.append(shape.radius)
    planes = [builder.end(plane) for plane in force.planes]
    numbers = law_numbers(force, force.stiffness, 0.0)
    cell, size = CELL * 2.0 * max(radii), 0
    if len(names) >= MANY:
        size = 1 << (2 * len(names) - 1).bit_length()
    numbers += [cell, cell - 2.0 * max(radii), size, 0.0, *radii]
    if size:
        numbers += [0.0] * (size + (4 + heap.KEPT_OF_EACH) * len(names))
    places = len(names) * len(planes) + len(names) * (len(names) - 1) // 2
    law = [first, NONE, NONE, 0, NONE, NONE, 0, 0, NONE, 0, NONE]
    columns = [*law, len(names), len(planes), *markers, *planes]
    builder.elements.add(heap.apply, columns, [float(number) for number in numbers], places, tuple(range(places)))


KINDS = (Kind(Contacts, add_contacts, (heap.apply, friction_work.apply)),)
