"""Bushings and contacts in numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.kernels.elements.touch import LOST
from nivel.kernels.forces import (
    bushing,
    contact,
    ellipsoid_contact,
    friction_work,
    height_contact,
    height_pose,
    hull_contact,
    round_contact,
    surface_distance,
)
from nivel.kernels.record.function import OUTPUT
from nivel.kernels.record.record import NONE
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Ellipsoid, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import box_size, extrusion_corners, length, mesh_surface
from nivel.machine.core.placement import frame_from_axes
from nivel.machine.forces import Bushing, Contact, Contacts, Material, Stop
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction, check_smooth
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import ExpressionError
from nivel.system.builder import SystemBuilder
from nivel.system.forces.ellipsoids import numbers_of_ellipsoids, numbers_over_plane
from nivel.system.forces.friction_works import WORK, add_friction_work
from nivel.system.forces.frictions import add_patch
from nivel.system.forces.height_fields import numbers_of_heights
from nivel.system.forces.hulls import hull_of, part_of, row_of
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.forces.restitution import damping_of_restitution

# Points of a shape that may touch, where they are more than one.
POINTS = {contact.BOX: 8, contact.CYLINDER: 8, contact.CAPSULE: 2}
MOST_CORNERS = 1000


def add_bushing(builder: SystemBuilder, force: Bushing) -> None:
    """An elastic connection in six directions."""
    first = force_outputs(
        builder,
        force.name,
        *magnitude_and_power("N"),
        *((f"force_{axis}", "N", f"force on the second body along {axis} of the first marker") for axis in "xyz"),
        *((f"torque_{axis}", "N m", f"torque on the second body about {axis} of the first marker") for axis in "xyz"),
    )
    matrices = [*force.stiffness_matrix.ravel().tolist(), *force.damping_matrix.ravel().tolist()]
    work = [0.0] * (bushing.EFFORT + 6 - len(matrices))
    builder.elements.add(bushing.apply, [first, *builder.ends(force.ends)], [*matrices, *work])


def add_contact(builder: SystemBuilder, force: Contact) -> None:
    """A shape against a plane, two spheres, or two hulls."""
    first = force_outputs(
        builder,
        force.name,
        *magnitude_and_power("N"),
        ("depth", "m", "deepest overlap"),
        ("normal_force", "N", "normal force"),
        ("rate", "m/s", "rate of the deepest overlap"),
        ("friction_force", "N", "friction force"),
        ("slip_speed", "m/s", "sliding speed"),
        ("friction_power", "W", "power that friction turns to heat"),
        ("surface_power", "W", "power of the moving surface"),
        ("sticks", "1", "1 where friction holds, else 0"),
        *((axis, "m", f"{axis} of the middle of the normal forces; 0 without contact") for axis in "xyz"),
        *((f"normal_{axis}", "1", f"{axis} of the normal towards the first body") for axis in "xyz"),
        *((f"friction_{axis}", "N", f"friction on the first body along {axis}") for axis in "xyz"),
        *((WORK,) if force.friction_work else ()),
    )
    if force.friction_work and not force.sticks:
        add_friction_work(builder, force.name, first + LOST)
    if force.foundation_modulus is not None:
        _add_hulls(builder, force, first)
        return
    more: list[float] = []
    several, family = False, contact.apply
    if force.bodies is not None:
        bodies = [builder.machine.body_named[name] for name in force.bodies]
        markers = [_shape_marker(builder, body) for body in bodies]
        if all(isinstance(body.shape, Sphere) for body in bodies):
            kind, size = contact.SPHERES, [_radius(body) for body in bodies]
            curvature = sum(1.0 / radius for radius in size)
        elif any(isinstance(body.shape, Ellipsoid) for body in bodies):
            kind, size, curvature, family = contact.ROUND, [], 0.0, ellipsoid_contact.apply
            more = numbers_of_ellipsoids(force, bodies, sum(_ball(body) for body in bodies))
        else:
            kind, size, curvature, family = contact.ROUND, [], 0.0, round_contact.apply
            more, several = _round_numbers(force, bodies)
    else:
        assert force.body is not None  # the record was checked
        assert force.plane is not None
        body = builder.machine.body_named[force.body]
        markers = [_shape_marker(builder, body), builder.end(force.plane)]
        kind, size, curvature = contact.ROUND, [], 0.0
        if isinstance(body.shape, Ellipsoid):
            family, more = ellipsoid_contact.apply, numbers_over_plane(body.shape)
        else:
            kind, size = _shape(contact, body)
            curvature = 1.0 / size[0]
    stiffness = force.stiffness if force.materials is None else hertzian(force.materials, curvature)
    law = NONE
    if force.law is not None:
        symbols = {"depth": (OUTPUT, first + contact.DEPTH, 0), "rate": (OUTPUT, first + contact.RATE, 0)}
        # every point that touches asks for it
        law = builder.function(force.law, symbols, switching=False)
    loss = damping_of_restitution(force.restitution) if force.restitution is not None else 0.0
    numbers = [stiffness or 0.0, force.exponent, loss, 0.0 if force.sticks else force.friction]
    numbers += [force.friction_transition_speed or 1.0, *size, *[0.0] * (3 - len(size))]
    numbers.append(0.0 if force.bodies is not None else _ball(builder.machine.body_named[str(force.body)]))
    numbers += [0.0] * (contact.NUMBERS - len(numbers))
    numbers += more
    points = 2 if several else POINTS.get(kind, 1)
    corners: list[float] = []
    if kind == contact.HULL:
        touching = builder.machine.body_named[str(force.body)]
        corners = (_corners(touching) if force.heights is None else _corners_of_parts(touching)).ravel().tolist()
        points = len(corners) // 3
    if force.heights is not None:
        ground = numbers_of_heights(force.heights)
        ball = size[0] if kind in (contact.SPHERE, contact.CAPSULE) else 0.0
        numbers += [
            float(kind),
            float(len(ground)),
            ball,
            *[0.0] * (height_contact.GROUND - height_contact.END),
            *ground,
        ]
        kind, family = contact.ROUND, height_contact.apply
    numbers += corners
    patch = [NONE, 0, 0]
    if force.sticks:
        patch = add_patch(builder, force, (markers[0], markers[1]), first, points > 1)
    frame = markers[1] if force.bodies is None else builder.frame(force.bodies[1])
    columns = [first, kind, *markers, law, points, *patch, *_surface(builder, force, frame)]
    memory = points + (height_pose.KEPT if family is height_contact.apply else 0)
    builder.elements.add(family, columns, numbers, memory, tuple(range(points)))


def tangent_stiffness(machine: MachineRecord, force: Contact | Contacts | Stop, load: float) -> float | None:
    """About the stiffness [N/m or N m/rad] of a contact at one point or an end stop under a `load` [N or N m], or of a foundation over a
    whole side of the smaller body; None with a law of its own."""
    if isinstance(force, Stop | Contacts):
        return force.exponent * load / (load / force.stiffness) ** (1.0 / force.exponent)
    if force.foundation_modulus is not None:
        hulls = [hull_of(machine.body_named[name]) for name in force.bodies or ()]
        sides = [sorted(np.ptp(hull.corners, axis=0)) for hull in hulls]
        return force.foundation_modulus * min(float(side[1] * side[2]) for side in sides)
    stiffness = force.stiffness
    if force.materials is not None:
        names = force.bodies or (force.body,)
        shapes = [machine.body_named[name].shape for name in names if name is not None]
        curvature = sum(1.0 / shape.radius for shape in shapes if isinstance(shape, Sphere))
        stiffness = hertzian(force.materials, curvature)
    # F = K d^n: dF/dd = n F/d
    return None if stiffness is None else force.exponent * load / (load / stiffness) ** (1.0 / force.exponent)


def hertzian(materials: Sequence[Material], curvature: float) -> float:
    """K [N/m^1.5] of a force K depth^1.5 between spheres, 4/3 E* √R: 1/E* = Σ (1 - ν²)/E, curvature 1/R = Σ 1/r [1/m] (Hertz 1881)."""
    compliance = sum((1.0 - each.poisson_ratio**2) / each.youngs_modulus for each in materials)
    return 4.0 / 3.0 / compliance / math.sqrt(curvature)


def _add_hulls(builder: SystemBuilder, force: Contact, first: int) -> None:
    assert force.bodies is not None  # the record was checked
    bodies = [builder.machine.body_named[name] for name in force.bodies]
    hulls = hull_of(bodies[0], part_of(force, bodies, 0)), hull_of(bodies[1], part_of(force, bodies, 1))
    markers = [builder.place((body.name, hull.middle, np.eye(3))) for body, hull in zip(bodies, hulls, strict=True)]
    patch = add_patch(builder, force, (markers[0], markers[1]), first, True) if force.sticks else [NONE, 0, 0]
    frame = builder.frame(bodies[1].name) if force.surface_velocity is not None else NONE
    columns, numbers = row_of(hulls, force, [*patch, *_surface(builder, force, frame)])
    builder.elements.add(hull_contact.apply, [first, *markers, *columns], numbers, 1, (0,))


def _surface(builder: SystemBuilder, force: Contact, frame: int) -> list[int]:
    """Columns of the surface that moves over the second body, in axes of the marker `frame`."""
    if force.surface_velocity is None and force.surface_spin is None:
        return [NONE, 0, NONE]
    given = [*(force.surface_velocity or (0.0, 0.0, 0.0)), force.surface_spin or 0.0]
    smooth = all(_is_smooth(each) for each in given)
    numbers = [builder.function(each, motion=smooth) for each in given]
    return [numbers[0], int(smooth), frame]


def _is_smooth(function: TimeFunction) -> bool:
    """Whether the rate of a function is known: one of time alone, without corners."""
    if isinstance(function, PythonLaw):
        return False
    try:
        check_smooth(function)
    except ExpressionError:
        return False
    return True


def _ball(body: Body) -> float:
    """[m] radius of a ball about the marker of a shape that holds it."""
    match body.shape:
        case Sphere():
            return body.shape.radius
        case Box():
            return 0.5 * math.hypot(*box_size(body.shape))
        case Cylinder():
            return math.hypot(body.shape.radius, 0.5 * length(body.shape))
        case Capsule():
            return body.shape.radius + 0.5 * length(body.shape)
        case Ellipsoid():
            return max(body.shape.semi_axes)
        case Extrusion() | Mesh():
            return float(np.linalg.norm(_corners(body), axis=1).max())
    raise ValueError(f"body {body.name} has no shape that can touch")


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
        case Capsule():
            return contact.CAPSULE, [body.shape.radius, 0.5 * length(body.shape)]
        case Extrusion() | Mesh():
            return contact.HULL, [1.0]  # its size is that of its corners
    raise ValueError(f"body {body.name} has no shape that can touch")


def _corners(body: Body) -> NDArray[np.float64]:
    """(n, 3) [m] corners of the convex hull of an extrusion or a mesh, in the body frame: nothing else of it can touch a plane.

    Raises ModelError where there are more than MOST_CORNERS.
    """
    from scipy.spatial import ConvexHull, QhullError

    assert isinstance(body.shape, Extrusion | Mesh)  # the record was checked
    points = mesh_surface(body.shape)[0] if isinstance(body.shape, Mesh) else extrusion_corners(body.shape)
    try:
        corners = points[ConvexHull(points).vertices]
    except QhullError:  # a flat mesh has no hull
        corners = np.unique(points, axis=0)
    if len(corners) > MOST_CORNERS:
        message = (
            f"the hull of the mesh has {len(corners)} corners, and at most {MOST_CORNERS} can touch a plane: give the body a coarser mesh; "
            f"`looks` may still draw the fine one"
        )
        raise ModelError(Fault("", 0, 0, f"bodies.{body.name}.shape", message))
    return corners


def _corners_of_parts(body: Body) -> NDArray[np.float64]:
    """The same of all convex parts, each once: on ground that is not flat others than those of the hull may touch."""
    if not isinstance(body.shape, Mesh) or body.shape.parts is None:
        return _corners(body)
    parts = [hull_of(body, part + 1) for part in range(len(body.shape.parts))]
    return np.unique(np.concatenate([each.corners + each.middle for each in parts]).round(9), axis=0)


def _round_numbers(force: Contact, bodies: Sequence[Body]) -> tuple[list[float], bool]:
    """Numbers of `nivel.kernels.forces.round_contact` for two bodies of which one is a sphere or a capsule, and whether it lies on two
    points."""
    # a sphere before a capsule: it has one point
    first = next((k for k, body in enumerate(bodies) if isinstance(body.shape, Sphere)), None)
    if first is None:
        first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Capsule))
    own, other = bodies[first].shape, bodies[1 - first]
    assert isinstance(own, Sphere | Capsule)  # the record was checked
    half = 0.0 if isinstance(own, Sphere) else 0.5 * length(own)
    core, (kind, numbers) = 0.0, _distance_numbers(other, part_of(force, bodies, 1 - first))
    if isinstance(other.shape, Capsule):
        core = other.shape.radius
    ball = own.radius + half + _ball(other)
    return [float(first), own.radius, half, core, ball, float(kind), *numbers], half > 0.0


def _distance_numbers(body: Body, part: int | None) -> tuple[int, list[float]]:
    """Kind and numbers of a shape for `nivel.kernels.forces.surface_distance`, in the axes of its marker."""
    match body.shape:
        case Box():
            return surface_distance.BOX, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return surface_distance.CYLINDER, [body.shape.radius, 0.5 * length(body.shape)]
        case Capsule():
            return surface_distance.SEGMENT, [0.5 * length(body.shape)]
        case Extrusion() | Mesh():
            hull = hull_of(body, part)
            corners, faces = hull.corners + hull.middle, hull.faces.copy()
            faces[:, 3] += faces[:, :3] @ hull.middle
            ends = corners[hull.edges].reshape(-1, 6)
            counts = [float(len(each)) for each in (corners, faces, ends)]
            return surface_distance.HULL, [*counts, *corners.ravel(), *faces.ravel(), *ends.ravel()]
    raise ValueError(f"body {body.name} has no shape that can touch")


def _shape_marker(builder: SystemBuilder, body: Body) -> int:
    """Marker at the centre of the shape, z along a cylinder; at the body frame of a hull, whose corners are given there."""
    shape = body.shape
    if isinstance(shape, Extrusion | Mesh):
        return builder.place((body.name, np.zeros(3), np.eye(3)))
    assert isinstance(shape, Sphere | Ellipsoid | Box | Cylinder | Capsule)  # the record was checked
    axes = np.eye(3)
    if isinstance(shape, Cylinder | Capsule):
        axes = frame_from_axes(np.eye(3)["xyz".index(shape.along or "x")])
    return builder.place((body.name, np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), axes))


KINDS = (
    ForceKind(Bushing, add_bushing, (bushing.apply,)),
    ForceKind(
        Contact,
        add_contact,
        (
            *(contact.apply, hull_contact.apply, round_contact.apply, ellipsoid_contact.apply, height_contact.apply),
            friction_work.apply,
        ),
    ),
)
