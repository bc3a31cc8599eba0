"""Contacts of ellipsoids in numbers: the other body as a polytope with a radius, or as an ellipsoid."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import numpy as np

from nivel.kernels.forces.ellipsoid_contact import ELLIPSOID, POLYTOPE
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Ellipsoid, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import length
from nivel.machine.core.placement import frame_from_axes
from nivel.machine.forces import Contact
from nivel.system.forces.hulls import hull_of, part_of


def numbers_over_plane(ellipsoid: Ellipsoid) -> list[float]:
    """Numbers of `nivel.kernels.forces.ellipsoid_contact` against the half-space below z = 0: a face alone."""
    return [0.0, *ellipsoid.semi_axes, inf, float(POLYTOPE), 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]


def numbers_of_ellipsoids(force: Contact, bodies: Sequence[Body], ball: float) -> list[float]:
    """The same of two bodies, of which one is an ellipsoid. ball [m] : sum of the radii of balls around both."""
    first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Ellipsoid))
    own, other = bodies[first].shape, bodies[1 - first]
    assert isinstance(own, Ellipsoid)
    kind, core, numbers = POLYTOPE, 0.0, []
    match other.shape:
        case Ellipsoid():
            kind, numbers = ELLIPSOID, list(other.shape.semi_axes)
        case Sphere():
            core, numbers = other.shape.radius, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        case Capsule():
            ends = [0.0, 0.0, -0.5 * length(other.shape), 0.0, 0.0, 0.5 * length(other.shape)]
            core, numbers = other.shape.radius, [2.0, 0.0, 1.0, *ends, *ends]
        case Box() | Cylinder() | Extrusion() | Mesh():
            numbers = _polytope(other, part_of(force, bodies, 1 - first))
    return [float(first), *own.semi_axes, ball, float(kind), core, *numbers]


def _polytope(body: Body, part: int | None) -> list[float]:
    """Counts of corners, faces and edges, then these, in the axes of the body's marker."""
    hull = hull_of(body, part)
    # a box and a cylinder have their marker in the middle, a cylinder z along it
    is_centred = isinstance(body.shape, Box | Cylinder)
    shift = np.zeros(3) if is_centred else hull.middle
    axes = np.eye(3)
    if isinstance(body.shape, Cylinder):
        axes = frame_from_axes(np.eye(3)["xyz".index(body.shape.along or "x")])
    corners, faces = hull.corners @ axes + shift, hull.faces.copy()
    faces[:, :3] = faces[:, :3] @ axes
    faces[:, 3] += faces[:, :3] @ shift
    ends = corners[hull.edges].reshape(-1, 6)
    counts = [float(len(each)) for each in (corners, faces, ends)]
    return [*counts, *corners.ravel().tolist(), *faces.ravel().tolist(), *ends.ravel().tolist()]
