"""Contacts in numbers: of each pair of shapes the family that finds its points, and the numbers of this."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.elements.forces.actuators import Stop
from nivel.elements.forces.friction import WORK, add_friction_work, add_patch
from nivel.elements.kind import Kind
from nivel.elements.restitution import damping_of_restitution
from nivel.errors import Fault, ModelError
from nivel.kernels.elements.touch import DEPTH, LOST, RATE
from nivel.kernels.forces import (
    contact_law,
    friction_work,
    ground_contact,
    height_field,
    height_pose,
    hull_contact,
    round_contact,
    surface_distance,
)
from nivel.kernels.record.function import OUTPUT
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass, scipy
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Ellipsoid, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import box_size, extrusion_corners, length, mesh_surface
from nivel.machine.bodies.touching import Touching
from nivel.machine.core.placement import frame_from_axes
from nivel.machine.forces.contact import Contact, Material
from nivel.machine.forces.contacts import Contacts
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction, check_smooth
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import ExpressionError
from nivel.system.builder import SystemBuilder
from nivel.system.forces.hulls import hull_of, part_of, polytope_of, row_of
from nivel.system.forces.outputs import force_outputs, magnitude_and_power

MOST_CORNERS = 1000


def add_contact(builder: SystemBuilder, force: Contact) -> None:
    """A shape against ground, or two shapes."""
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
    family, bodies = family_of(builder.machine, force), _bodies(builder.machine, force)
    markers = [_shape_marker(builder, body) for body in bodies]
    if force.plane is not None:
        markers.append(builder.end(force.plane))
    points = PAIRS[family](force, bodies)
    law = NONE
    if force.law is not None:
        symbols = {"depth": (OUTPUT, first + DEPTH, 0), "rate": (OUTPUT, first + RATE, 0)}
        # every point that touches asks for it
        law = builder.function(force.law, symbols, switching=False)
    patch = [NONE, 0, 0]
    if force.sticks:
        patch = add_patch(builder, force, (markers[0], markers[1]), first, points.count > 1)
    frame = markers[1] if force.bodies is None else builder.frame(bodies[1].body)
    columns = [first, *markers, points.count, law, *patch, *_surface(builder, force, frame), *points.columns]
    numbers = law_numbers(force, _stiffness(builder.machine, force), points.radius)
    memory = points.count + (height_pose.KEPT if family is ground_contact.apply_over_heights else 0)
    builder.elements.add(family, columns, numbers + points.numbers, memory, tuple(range(points.count)))


def law_numbers(force: Contact | Contacts, stiffness: float | None, radius: float) -> list[float]:
    """Numbers of `nivel.kernels.forces.contact_law`, with a ball of this radius [m] about the marker of the shape."""
    loss = damping_of_restitution(force.restitution) if force.restitution is not None else 0.0
    if isinstance(force, Contact) and force.damping is not None:
        loss = -force.damping
    sticks = isinstance(force, Contact) and force.sticks
    friction, transition = 0.0 if sticks else force.friction, force.friction_transition_speed or 1.0
    numbers = [stiffness or 0.0, force.exponent, loss, friction, transition, radius]
    return numbers + [0.0] * (contact_law.NUMBERS - len(numbers))


def family_of(machine: MachineRecord, force: Contact) -> Family:
    """What finds the points of a contact."""
    shapes = [body.shape for body in _bodies(machine, force)]
    if force.foundation_modulus is not None:
        return hull_contact.apply
    if force.heights is not None:
        return ground_contact.apply_over_heights
    if any(isinstance(shape, Ellipsoid) for shape in shapes):
        return round_contact.apply_to_ellipsoids
    if force.bodies is None:
        return ground_contact.apply
    if all(isinstance(shape, Sphere) for shape in shapes):
        return ground_contact.apply_to_spheres
    return round_contact.apply


@dataclass(frozen=True)
class Points:
    """Points of a pair: how many, radius [m] of the balls that hold both shapes, and what its family has behind the law."""

    count: int
    radius: float
    columns: list[int]
    numbers: list[float]


def _over_plane(force: Contact, bodies: Sequence[Touching]) -> Points:
    kind, count, size = _ground_shape(bodies[0], _corners)
    return Points(count, _ball(bodies[0]), [kind], size)


def _over_heights(force: Contact, bodies: Sequence[Touching]) -> Points:
    assert force.heights is not None
    kind, count, size = _ground_shape(bodies[0], _corners_of_parts)
    work = [0.0] * (ground_contact.GROUND - contact_law.NUMBERS)
    numbers = [*work, *height_field.numbers_of(force.heights.heights, force.heights.size)]
    return Points(count, _ball(bodies[0]), [kind, contact_law.NUMBERS + len(numbers)], numbers + size)


def _of_spheres(force: Contact, bodies: Sequence[Touching]) -> Points:
    radii = [_ball(body) for body in bodies]
    return Points(1, sum(radii), [], radii)


def _of_round(force: Contact, bodies: Sequence[Touching]) -> Points:
    # a sphere before a capsule: it has one point
    first = next((k for k, body in enumerate(bodies) if isinstance(body.shape, Sphere)), None)
    if first is None:
        first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Capsule))
    own, other = bodies[first].shape, bodies[1 - first]
    assert isinstance(own, Sphere | Capsule)  # the record was checked
    half = 0.0 if isinstance(own, Sphere) else 0.5 * length(own)
    kind, numbers = _distance_numbers(other, part_of(force, bodies, 1 - first))
    core = other.shape.radius if isinstance(other.shape, Capsule) else 0.0
    balls = own.radius + half + _ball(other)
    return Points(2 if half > 0.0 else 1, balls, [], [float(first), own.radius, half, core, float(kind), *numbers])


def _of_ellipsoid(force: Contact, bodies: Sequence[Touching]) -> Points:
    first = next(k for k, body in enumerate(bodies) if isinstance(body.shape, Ellipsoid))
    own, core, kind, balls = bodies[first].shape, 0.0, round_contact.POLYTOPE, math.inf
    assert isinstance(own, Ellipsoid)
    # the half-space below z = 0: a face alone
    numbers = [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    if force.bodies is not None:
        other, balls = bodies[1 - first], sum(_ball(body) for body in bodies)
        match other.shape:
            case Ellipsoid():
                kind, numbers = round_contact.ELLIPSOID, list(other.shape.semi_axes)
            case Sphere():
                core, numbers = other.shape.radius, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            case Capsule():
                ends = [0.0, 0.0, -0.5 * length(other.shape), 0.0, 0.0, 0.5 * length(other.shape)]
                core, numbers = other.shape.radius, [2.0, 0.0, 1.0, *ends, *ends]
            case _:
                numbers = polytope_of(other, part_of(force, bodies, 1 - first))
    return Points(1, balls, [], [float(first), *own.semi_axes, float(kind), core, *numbers])


# by what finds the points
PAIRS: Final[dict[Family, Callable[[Contact, Sequence[Touching]], Points]]] = {
    ground_contact.apply: _over_plane,
    ground_contact.apply_to_spheres: _of_spheres,
    ground_contact.apply_over_heights: _over_heights,
    round_contact.apply: _of_round,
    round_contact.apply_to_ellipsoids: _of_ellipsoid,
}


def _bodies(machine: MachineRecord, force: Contact) -> list[Touching]:
    """What touches: one shape on ground, or two."""
    return [machine.touching[name] for name in force.bodies or (str(force.body),)]


def _stiffness(machine: MachineRecord, force: Contact) -> float | None:
    """K of a force K depth^n; None with a law of its own, and of a foundation."""
    if force.materials is None:
        return force.stiffness
    shapes = [body.shape for body in _bodies(machine, force)]
    return hertzian(force.materials, sum(1.0 / shape.radius for shape in shapes if isinstance(shape, Sphere)))


def tangent_stiffness(machine: MachineRecord, force: Contact | Contacts | Stop, load: float) -> float | None:
    """About the stiffness [N/m or N m/rad] of a contact at one point or an end stop under a `load` [N or N m], or of a foundation over a
    whole side of the smaller body; None with a law of its own."""
    if isinstance(force, Contact) and force.foundation_modulus is not None:
        sides = [sorted(np.ptp(hull_of(body).corners, axis=0)) for body in _bodies(machine, force)]
        return force.foundation_modulus * min(float(side[1] * side[2]) for side in sides)
    stiffness = _stiffness(machine, force) if isinstance(force, Contact) else force.stiffness
    # F = K d^n: dF/dd = n F/d
    return None if stiffness is None else force.exponent * load / (load / stiffness) ** (1.0 / force.exponent)


def hertzian(materials: Sequence[Material], curvature: float) -> float:
    """K [N/m^1.5] of a force K depth^1.5 between spheres, 4/3 E* √R: 1/E* = Σ (1 - ν²)/E, curvature 1/R = Σ 1/r [1/m] (Hertz 1881)."""
    compliance = sum((1.0 - each.poisson_ratio**2) / each.youngs_modulus for each in materials)
    return 4.0 / 3.0 / compliance / math.sqrt(curvature)


def _add_hulls(builder: SystemBuilder, force: Contact, first: int) -> None:
    assert force.bodies is not None  # the record was checked
    bodies = _bodies(builder.machine, force)
    hulls = hull_of(bodies[0], part_of(force, bodies, 0)), hull_of(bodies[1], part_of(force, bodies, 1))
    markers = [builder.place(body.at(hull.middle, np.eye(3))) for body, hull in zip(bodies, hulls, strict=True)]
    patch = add_patch(builder, force, (markers[0], markers[1]), first, True) if force.sticks else [NONE, 0, 0]
    frame = builder.frame(bodies[1].body) if force.surface_velocity is not None else NONE
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


def _ball(body: Touching) -> float:
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
    raise ValueError(f"{body.name} has no shape that can touch")


def _ground_shape(body: Touching, corners: Callable[[Touching], NDArray[np.float64]]) -> tuple[int, int, list[float]]:
    """Kind, number of points and numbers of a shape for `nivel.kernels.forces.ground_contact`; `corners` of an extrusion or a mesh."""
    match body.shape:
        case Sphere():
            return ground_contact.SPHERE, 1, [body.shape.radius]
        case Box():
            return ground_contact.BOX, 8, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return ground_contact.CYLINDER, 8, [body.shape.radius, 0.5 * length(body.shape)]
        case Capsule():
            return ground_contact.CAPSULE, 2, [body.shape.radius, 0.5 * length(body.shape)]
        case Extrusion() | Mesh():
            found = corners(body)
            return ground_contact.HULL, len(found), found.ravel().tolist()
    raise ValueError(f"{body.name} has no shape that can touch")


def _corners(body: Touching) -> NDArray[np.float64]:
    """(n, 3) [m] corners of the convex hull of an extrusion or a mesh, in the frame of the shape: nothing else of it can touch a plane.

    Raises ModelError where there are more than MOST_CORNERS.
    """
    assert isinstance(body.shape, Extrusion | Mesh)  # the record was checked
    points = mesh_surface(body.shape)[0] if isinstance(body.shape, Mesh) else extrusion_corners(body.shape)
    try:
        corners = points[scipy.spatial.ConvexHull(points).vertices]
    except scipy.spatial.QhullError:  # a flat mesh has no hull
        corners = np.unique(points, axis=0)
    if len(corners) > MOST_CORNERS:
        message = (
            f"the hull of the mesh has {len(corners)} corners, and at most {MOST_CORNERS} can touch a plane: give the body a coarser mesh; "
            f"`looks` may still draw the fine one"
        )
        raise ModelError(Fault("", 0, 0, body.place, message))
    return corners


def _corners_of_parts(body: Touching) -> NDArray[np.float64]:
    """The same of all convex parts, each once: on ground that is not flat others than those of the hull may touch."""
    if not isinstance(body.shape, Mesh) or body.shape.parts is None:
        return _corners(body)
    parts = [hull_of(body, part + 1) for part in range(len(body.shape.parts))]
    return np.unique(np.concatenate([each.corners + each.middle for each in parts]).round(9), axis=0)


def _distance_numbers(body: Touching, part: int | None) -> tuple[int, list[float]]:
    """Kind and numbers of a shape for `nivel.kernels.forces.surface_distance`, in the axes of its marker."""
    match body.shape:
        case Box():
            return surface_distance.BOX, [0.5 * side for side in box_size(body.shape)]
        case Cylinder():
            return surface_distance.CYLINDER, [body.shape.radius, 0.5 * length(body.shape)]
        case Capsule():
            return surface_distance.SEGMENT, [0.5 * length(body.shape)]
        case Extrusion() | Mesh():
            return surface_distance.HULL, polytope_of(body, part)
    raise ValueError(f"{body.name} has no shape that can touch")


def _shape_marker(builder: SystemBuilder, body: Touching) -> int:
    """Marker at the centre of the shape, z along a cylinder; at the frame of a hull, whose corners are given there."""
    shape = body.shape
    if isinstance(shape, Extrusion | Mesh):
        return builder.place(body.at(np.zeros(3), np.eye(3)))
    assert isinstance(shape, Sphere | Ellipsoid | Box | Cylinder | Capsule)  # the record was checked
    axes = np.eye(3)
    if isinstance(shape, Cylinder | Capsule):
        axes = frame_from_axes(np.eye(3)["xyz".index(shape.along or "x")])
    return builder.place(body.at(np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), axes))


KINDS = (
    Kind(
        Contact,
        add_contact,
        (*PAIRS, hull_contact.apply, friction_work.apply),
        lambda machine, force: (family_of(machine, force), *([friction_work.apply] * force.friction_work)),
    ),
)
