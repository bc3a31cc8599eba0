"""Bushings and contacts in numbers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from nivel.kernels.forces import bushing, contact
from nivel.kernels.function import OUTPUT
from nivel.kernels.record import NONE
from nivel.machine.body import Body
from nivel.machine.forces import Bushing, Contact
from nivel.machine.placement import frame_from_axes
from nivel.machine.shape import Box, Cylinder, Sphere
from nivel.machine.solids import box_size, length
from nivel.system.builder import SystemBuilder
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.forces.restitution import damping_of_restitution


def add_bushing(draft: SystemBuilder, force: Bushing) -> None:
    """An elastic connection in six directions."""
    first = force_outputs(
        draft,
        force.name,
        *magnitude_and_power("N"),
        *((f"force_{axis}", "N", f"force on the second body along {axis} of the first marker") for axis in "xyz"),
        *((f"torque_{axis}", "N m", f"torque on the second body about {axis} of the first marker") for axis in "xyz"),
    )
    matrices = [*force.stiffness_matrix.ravel().tolist(), *force.damping_matrix.ravel().tolist()]
    work = [0.0] * (bushing.EFFORT + 6 - len(matrices))
    draft.elements.add(bushing.apply, [first, *draft.ends(force.ends)], [*matrices, *work])


def add_contact(draft: SystemBuilder, force: Contact) -> None:
    """A shape against a plane, or two spheres."""
    first = force_outputs(
        draft,
        force.name,
        *magnitude_and_power("N"),
        ("depth", "m", "deepest overlap"),
        ("normal_force", "N", "normal force"),
        ("rate", "m/s", "rate of the deepest overlap"),
    )
    if force.bodies is not None:
        bodies = [draft.machine.body_named[name] for name in force.bodies]
        kind = contact.SPHERES
        markers = [_shape_marker(draft, body) for body in bodies]
        size = [_radius(body) for body in bodies]
        curvature = sum(1.0 / radius for radius in size)
    else:
        assert force.body is not None  # the record was checked
        assert force.plane is not None
        body = draft.machine.body_named[force.body]
        markers = [_shape_marker(draft, body), draft.end(force.plane)]
        kind, size = _shape(contact, body)
        curvature = 1.0 / size[0]
    stiffness = force.stiffness
    if force.materials is not None:
        # Hertz: K = 4/3 E* √R, 1/E* = Σ (1 - ν²)/E, 1/R = Σ 1/r
        compliance = sum((1.0 - each.poisson_ratio**2) / each.young_modulus for each in force.materials)
        stiffness = 4.0 / 3.0 / compliance / math.sqrt(curvature)
    law = NONE
    if force.law is not None:
        law = draft.function(
            force.law, {"depth": (OUTPUT, first + contact.DEPTH, 0), "rate": (OUTPUT, first + contact.RATE, 0)}
        )
    loss = damping_of_restitution(force.restitution) if force.restitution is not None else 0.0
    numbers = [stiffness or 0.0, force.exponent, loss, force.friction]
    numbers += [force.friction_transition_speed or 1.0, *size, *[0.0] * (3 - len(size))]
    numbers += [0.0] * (contact.NUMBERS - len(numbers))
    points = contact.POINTS if kind in (contact.BOX, contact.CYLINDER) else 1
    draft.elements.add(contact.apply, [first, kind, *markers, law], numbers, contact.POINTS, tuple(range(points)))


def _radius(body: Body) -> float:
    assert isinstance(body.shape, Sphere)  # the record was checked
    return body.shape.radius


def _shape(contact: Any, body: Body) -> tuple[int, list[float]]:
    """Kind and sizes of a body's shape for the contact kernel."""
    match body.shape:
        case Sphere():
            return contact.SPHERE, [body.shape.radius]
        case Box():
            return contact.BOX, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return contact.CYLINDER, [body.shape.radius, 0.5 * length(body.shape)]
    raise ValueError(f"body {body.name} has no shape that can touch")


def _shape_marker(draft: SystemBuilder, body: Body) -> int:
    """Marker at the centre of the shape; z along a cylinder."""
    shape = body.shape
    assert isinstance(shape, Sphere | Box | Cylinder)  # the record was checked
    axes = np.eye(3)
    if isinstance(shape, Cylinder):
        axes = frame_from_axes(np.eye(3)["xyz".index(shape.along or "x")])
    return draft.place((body.name, np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), axes))


KINDS = (
    ForceKind(Bushing, add_bushing, (bushing.apply,)),
    ForceKind(Contact, add_contact, (contact.apply,)),
)
