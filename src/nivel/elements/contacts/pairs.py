"""Contacts in numbers: of each pair of shapes the family that finds its points, and the numbers of this."""

import math
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from nivel.elements.contacts import ellipsoids, ground, height_way, heights, hulls, rounds
from nivel.elements.contacts.contact import WORK, Contact
from nivel.elements.contacts.law import Points, law_numbers
from nivel.elements.contacts.shapes import hull_of, part_of, shape_marker
from nivel.elements.facts import add_outputs
from nivel.elements.forces.friction import ROUND_FACE, add_friction_work, add_patch, rub_off
from nivel.elements.kind import Kind
from nivel.kernels.elements.touch import DEPTH, LOST, RATE
from nivel.kernels.record.function import OUTPUT
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE
from nivel.known import Contacts, MachineRecord, Material, Stop, SystemBuilder
from nivel.machine.bodies.shape import Cylinder, Ellipsoid, Sphere
from nivel.machine.bodies.touching import Touching
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction, check_smooth
from nivel.machine.units.tree import ExpressionError


def add_contact(builder: SystemBuilder, force: Contact) -> None:
    """A shape against ground, or two shapes."""
    first = add_outputs(builder, force, without=() if force.friction_work else (WORK,))
    if force.friction_work and not force.sticks:
        add_friction_work(builder, force.name, first + LOST)
    if force.foundation_modulus is not None:
        _add_hulls(builder, force, first)
        return
    family, bodies = family_of(builder.machine, force), _bodies(builder.machine, force)
    markers = [shape_marker(builder, body) for body in bodies]
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
        # points of a cylinder are on its rims, and stand for its faces
        share = ROUND_FACE if isinstance(bodies[0].shape, Cylinder) else 1.0
        patch = add_patch(builder, force, (markers[0], markers[1]), first, points.count > 1, share)
    frame = markers[1] if force.bodies is None else builder.frame(bodies[1].body)
    columns = [first, *markers, points.count, law, *patch, *_surface(builder, force, frame), *points.columns]
    numbers = law_numbers(force, _stiffness(builder.machine, force), points.radius)
    memory = points.count + (height_way.KEPT if family is heights.apply_over_heights else 0)
    builder.elements.add(family, columns, numbers + points.numbers, memory, tuple(range(points.count)))


def family_of(machine: MachineRecord, force: Contact) -> Family:
    """What finds the points of a contact."""
    shapes = [body.shape for body in _bodies(machine, force)]
    if force.foundation_modulus is not None:
        return hulls.apply
    if force.heights is not None:
        return heights.apply_over_heights
    if any(isinstance(shape, Ellipsoid) for shape in shapes):
        return ellipsoids.apply_to_ellipsoids
    if force.bodies is None:
        return ground.apply
    if all(isinstance(shape, Sphere) for shape in shapes):
        return ground.apply_to_spheres
    return rounds.apply


# by what finds the points
PAIRS: Final[dict[Family, Callable[[Contact, Sequence[Touching]], Points]]] = {
    ground.apply: ground.points_over_plane,
    ground.apply_to_spheres: ground.points_of_spheres,
    heights.apply_over_heights: heights.points_over_heights,
    rounds.apply: rounds.points_of_round,
    ellipsoids.apply_to_ellipsoids: ellipsoids.points_of_ellipsoid,
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
    pair = hull_of(bodies[0], part_of(force, bodies, 0)), hull_of(bodies[1], part_of(force, bodies, 1))
    markers = [builder.place(body.at(hull.middle, np.eye(3))) for body, hull in zip(bodies, pair, strict=True)]
    patch = add_patch(builder, force, (markers[0], markers[1]), first, True) if force.sticks else [NONE, 0, 0]
    frame = builder.frame(bodies[1].body) if force.surface_velocity is not None else NONE
    columns, numbers = hulls.row_of(pair, force, [*patch, *_surface(builder, force, frame)])
    builder.elements.add(hulls.apply, [first, *markers, *columns], numbers, 1, (0,))


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


KINDS = (
    Kind(
        Contact,
        add_contact,
        (*PAIRS, hulls.apply, rub_off),
        lambda machine, force: (family_of(machine, force), *([rub_off] * force.friction_work)),
    ),
)
