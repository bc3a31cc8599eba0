"""Boxes and cylinders that just touch a slope, on which static friction alone would hold them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Cylinder
from nivel.machine.bodies.solids import axes_of, box_size, centroid, length
from nivel.machine.core.placement import marker_frame
from nivel.machine.forces import Contact
from nivel.machine.machine_record import MachineRecord

# Of its size a body touches within this share.
TOUCHES = 1e-6


def resting_remarks(machine: MachineRecord) -> Iterator[tuple[str, str]]:
    """(name of the contact, message): a contact without overlap has no force, so its body slides before friction can hold it."""
    if machine.simulation.start == "equilibrium":
        return
    for force in machine.forces:
        if not isinstance(force, Contact) or not force.sticks or not force.static > force.friction:
            continue
        if force.body is None or force.plane is None or force.heights is not None or force.stiffness is None:
            continue
        body = machine.body_named[force.body]
        marker = machine.marker_named[force.plane] if isinstance(force.plane, str) else force.plane
        if marker.body != "ground" or not isinstance(body.shape, Box | Cylinder) or _moves(body):
            continue
        point, axes = marker_frame(marker)
        n = axes[:, 2]
        pressed = -float(n @ np.array(machine.gravity))
        across = float(np.linalg.norm(np.array(machine.gravity) + pressed * n))
        if not force.friction * pressed < across < force.static * pressed:
            continue
        reach = _reach(body.shape, machine.placed[body.name][1].T @ n)
        centre = machine.placed[body.name][0] + machine.placed[body.name][1] @ centroid(body.shape)
        if abs(float(n @ (centre - point)) - reach) > TOUCHES * reach:
            continue
        load = mass_properties(body).mass * pressed / 4
        depth = (load / force.stiffness) ** (1.0 / force.exponent)
        yield (
            force.name,
            f"`{body.name}` just touches the slope: without overlap there is no force, so it begins to slide, and kinetic friction does "
            f"not stop it; to have it rest, place it {depth:.2g} m deeper (four points that carry its weight)",
        )


def _moves(body: Body) -> bool:
    given = (body.velocity, body.angular_velocity, body.angular_velocity_body)
    return any(np.any(np.array(each or 0.0)) for each in given)


def _reach(shape: Box | Cylinder, n: NDArray[np.float64]) -> float:
    """[m] from the centre of a shape to where it is farthest along n, a unit vector in the body frame."""
    if isinstance(shape, Box):
        return 0.5 * float(np.abs(n) @ np.array(box_size(shape)))
    along = float(n[axes_of(shape.along)[0]])
    return 0.5 * length(shape) * abs(along) + shape.radius * float(np.sqrt(max(1.0 - along * along, 0.0)))
