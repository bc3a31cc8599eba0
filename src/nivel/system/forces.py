"""Forces in numbers: for every kind, the family of kernels that computes it and the columns that it fills there.

A new kind of force is its words (`nivel.machine.forces`), its kernel (`nivel.kernels.forces`) and its entry of FORCES.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Final

import numpy as np
from scipy.optimize import bisect

from nivel.kernels.coordinate import CROSS_SECOND, DISTANCE, LAST_ANGLE, ROTATION
from nivel.kernels.function import COORDINATE, RATE
from nivel.kernels.record import NONE
from nivel.machine.body import Body
from nivel.machine.coordinate_reference import resolve
from nivel.machine.forces import (
    Bushing,
    Characteristic,
    Contact,
    Friction,
    JointSpringDamper,
    Motor,
    PairForce,
    PointForce,
    SpringDamper,
    Stop,
    Torque,
    TorsionalSpringDamper,
)
from nivel.machine.inertia import box_size, length
from nivel.machine.placement import frame_from_axes
from nivel.machine.shape import Box, Cylinder, Sphere
from nivel.system.draft import Draft


def _outputs(draft: Draft, name: str, *entries: tuple[str, str, str]) -> int:
    """Index of the first output of the force `name`: (output, units, in words)."""
    named = [(f"force.{name}.{output}", units, f"{words} of {name}") for output, units, words in entries]
    return draft.outputs.add(*named)


def _magnitude_and_power(units: str) -> tuple[tuple[str, str, str], tuple[str, str, str]]:
    return ("magnitude", units, "magnitude"), ("power", "W", "power into the machine")


def _is_angle(draft: Draft, coordinate: int) -> bool:
    return draft.coordinates.what[coordinate][0] <= LAST_ANGLE


def add_load(draft: Draft, force: PointForce | Torque) -> None:
    """A force or torque on one body."""
    load = import_module("nivel.kernels.forces.load")
    units = "N" if isinstance(force, PointForce) else "N m"
    first = _outputs(draft, force.name, *_magnitude_and_power(units))
    point, body = np.zeros(3), force.body
    if isinstance(force, PointForce):
        point = np.array(force.position or (0.0, 0.0, 0.0), dtype=float)
        if force.marker is not None:
            record = next(marker for marker in draft.machine.markers if marker.name == force.marker)
            body, point = record.body, np.array(record.position, dtype=float)
    assert body is not None  # the record was checked
    marker = draft.place((body, point, np.eye(3)))
    functions = [draft.function(component) for component in force.vector]
    kind = load.FORCE if isinstance(force, PointForce) else load.TORQUE
    axes = marker if force.axes == "body" else NONE
    draft.elements.add("load", [first, kind, marker, axes, *functions, NONE, NONE])


def add_pair(draft: Draft, force: PairForce) -> None:
    """A force between two points, along their line or as a vector."""
    i, j = draft.ends(force.ends)
    coordinate = draft.coordinates.use(draft.coordinates.add(DISTANCE, i, j))
    entries = (*_magnitude_and_power("N"), ("length", "m", "length"), ("rate", "m/s", "rate of the length"))
    first = _outputs(draft, force.name, *entries)
    if force.vector is None:
        assert force.magnitude is not None  # the record was checked
        law = draft.function(force.magnitude, {"length": (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
        draft.elements.add("motor", [first, coordinate, law], [0.0, math.inf])
        return
    functions = [draft.function(component) for component in force.vector]
    load = import_module("nivel.kernels.forces.load")
    axes = i if force.axes == "first" else NONE
    draft.elements.add("load", [first, load.FORCE, j, axes, *functions, i, coordinate])


def add_spring_damper(draft: Draft, force: SpringDamper) -> None:
    """A spring and damper between two points."""
    coordinate = draft.coordinates.use(draft.coordinates.add(DISTANCE, *draft.ends(force.ends)))
    _add_spring(draft, force, coordinate, "length", force.free_length or 0.0)


def add_torsional_spring_damper(draft: Draft, force: TorsionalSpringDamper) -> None:
    """A torsional spring and damper between two markers."""
    coordinate = draft.coordinates.use(draft.coordinates.add(ROTATION, *draft.ends(force.ends)))
    _add_spring(draft, force, coordinate, "angle", force.free_angle)


def add_joint_spring_damper(draft: Draft, force: JointSpringDamper) -> None:
    """A spring and damper on a joint coordinate."""
    _add_spring(draft, force, draft.coordinate(force.coordinate), "value", force.free_value)


def _add_spring(
    draft: Draft,
    force: SpringDamper | TorsionalSpringDamper | JointSpringDamper,
    coordinate: int,
    symbol: str,
    free: float,
) -> None:
    angle = _is_angle(draft, coordinate)
    first = _outputs(
        draft,
        force.name,
        ("magnitude", "N m" if angle else "N", "effort that resists the coordinate"),
        ("power", "W", "power into the machine"),
        (symbol, "rad" if angle else "m", symbol),
        ("rate", "rad/s" if angle else "m/s", f"rate of the {symbol}"),
    )
    table, energy, law = NONE, NONE, NONE
    if force.table is not None:
        table, energy = _characteristic(draft, force.table)
    if force.law is not None:
        law = draft.function(force.law, {symbol: (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
    numbers = [force.stiffness or 0.0, force.damping, free, force.preload]
    draft.elements.add("spring", [first, coordinate, table, energy, law], numbers)


def _characteristic(draft: Draft, table: Characteristic) -> tuple[int, int]:
    """Tables of the effort over the deflection, and of the energy stored since zero deflection."""
    x, effort = (np.array(column, dtype=float) for column in table.points)
    slope = np.diff(effort) / np.diff(x)
    slope = np.append(slope, slope[-1])
    nothing = np.zeros(len(x))
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (effort[1:] + effort[:-1]) * np.diff(x))])
    # the piece that holds zero, or the end piece that goes on to it
    at = int(np.clip(np.searchsorted(x, 0.0, side="right") - 1, 0, len(x) - 1))
    energy -= energy[at] - effort[at] * x[at] + 0.5 * slope[at] * x[at] ** 2
    force = draft.functions.add_table(x.tolist(), np.column_stack([effort, slope, nothing, nothing]))
    stored = draft.functions.add_table(x.tolist(), np.column_stack([energy, effort, 0.5 * slope, nothing]))
    return force, stored


def damping_of_restitution(restitution: float) -> float:
    """x with ln((1 + x)/(1 - e x)) = x (1 + e), see `nivel.kernels.forces.impact`; zero for e = 1."""
    e = restitution
    if e >= 1.0 - 1e-9:
        return 0.0

    def excess(x: float) -> float:
        return math.log1p(x) - math.log1p(-e * x) - x * (1.0 + e)

    # negative just above the root at zero (-(1 - e²) x²/2), infinite at 1/e
    largest = 1.0 / e
    gap = 1e-3 * largest
    while excess(largest - gap) <= 0.0:
        gap *= 1e-3
        if gap < 1e-15 * largest:
            return largest
    root: Any = bisect(excess, 1e-6 * (1.0 - e), largest - gap, xtol=1e-15)
    return float(root)


def add_stop(draft: Draft, force: Stop) -> None:
    """Limit stops on a joint coordinate."""
    coordinate = draft.coordinate(force.coordinate)
    angle = _is_angle(draft, coordinate)
    first = _outputs(
        draft,
        force.name,
        ("magnitude", "N m" if angle else "N", "effort on the coordinate"),
        ("power", "W", "power into the machine"),
        ("depth", "rad" if angle else "m", "overlap"),
    )
    lower = -math.inf if force.lower is None else force.lower
    upper = math.inf if force.upper is None else force.upper
    numbers = [lower, upper, force.stiffness, force.exponent, damping_of_restitution(force.restitution)]
    draft.elements.add("stop", [first, coordinate], numbers, memory=2)


def add_motor(draft: Draft, force: Motor) -> None:
    """An effort on a joint coordinate."""
    coordinate = draft.coordinate(force.coordinate)
    angle = _is_angle(draft, coordinate)
    first = _outputs(
        draft,
        force.name,
        ("magnitude", "N m" if angle else "N", "effort on the coordinate"),
        ("power", "W", "power into the machine"),
        ("value", "rad" if angle else "m", "coordinate"),
        ("rate", "rad/s" if angle else "m/s", "rate of the coordinate"),
    )
    command = force.effort if force.effort is not None else force.speed
    assert command is not None  # the record was checked
    limit = math.inf if force.limit is None else force.limit
    numbers = [0.0 if force.speed is None else force.gain or 0.0, limit]
    draft.elements.add("motor", [first, coordinate, draft.function(command)], numbers)


def add_bushing(draft: Draft, force: Bushing) -> None:
    """An elastic connection in six directions."""
    bushing = import_module("nivel.kernels.forces.bushing")
    first = _outputs(
        draft,
        force.name,
        *_magnitude_and_power("N"),
        *((f"force_{axis}", "N", f"force on the second body along {axis} of the first marker") for axis in "xyz"),
        *((f"torque_{axis}", "N m", f"torque on the second body about {axis} of the first marker") for axis in "xyz"),
    )
    matrices = [*force.stiffness_matrix.ravel().tolist(), *force.damping_matrix.ravel().tolist()]
    work = [0.0] * (bushing.EFFORT + 6 - len(matrices))
    draft.elements.add("bushing", [first, *draft.ends(force.ends)], [*matrices, *work])


def add_contact(draft: Draft, force: Contact) -> None:
    """A shape against a plane, or two spheres."""
    contact = import_module("nivel.kernels.forces.contact")
    first = _outputs(
        draft,
        force.name,
        *_magnitude_and_power("N"),
        ("depth", "m", "deepest overlap"),
        ("normal_force", "N", "normal force"),
    )
    if force.bodies is not None:
        bodies = [_body(draft, name) for name in force.bodies]
        kind = contact.SPHERES
        markers = [_shape_marker(draft, body) for body in bodies]
        size = [_radius(body) for body in bodies]
        curvature = sum(1.0 / radius for radius in size)
    else:
        assert force.body is not None  # the record was checked
        assert force.plane is not None
        body = _body(draft, force.body)
        markers = [_shape_marker(draft, body), draft.end(force.plane)]
        kind, size = _shape(contact, body)
        curvature = 1.0 / size[0]
    stiffness = force.stiffness
    if force.materials is not None:
        # Hertz: K = 4/3 E* √R, 1/E* = Σ (1 - ν²)/E, 1/R = Σ 1/r
        compliance = sum((1.0 - each.poisson_ratio**2) / each.young_modulus for each in force.materials)
        stiffness = 4.0 / 3.0 / compliance / math.sqrt(curvature)
    assert stiffness is not None  # the record was checked
    numbers = [stiffness, force.exponent, damping_of_restitution(force.restitution), force.friction]
    numbers += [force.friction_transition_speed or 1.0, *size, *[0.0] * (3 - len(size))]
    numbers += [0.0] * (contact.NUMBERS - len(numbers))
    draft.elements.add("contact", [first, kind, *markers], numbers, memory=contact.POINTS)


def _body(draft: Draft, name: str) -> Body:
    return next(body for body in draft.machine.bodies if body.name == name)


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


def _shape_marker(draft: Draft, body: Body) -> int:
    """Marker at the centre of the shape; z along a cylinder."""
    shape = body.shape
    assert shape is not None  # the record was checked
    axes = np.eye(3)
    if isinstance(shape, Cylinder):
        axes = frame_from_axes(np.eye(3)["xyz".index(shape.along or "x")])
    return draft.place((body.name, np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), axes))


def add_friction(draft: Draft, force: Friction) -> None:
    """Friction in a joint coordinate: an extra row, see `nivel.kernels.friction`."""
    friction = import_module("nivel.kernels.friction")
    joint, _ = resolve(force.coordinate, draft.machine.joints)
    coordinate = draft.coordinate(force.coordinate)
    angle = _is_angle(draft, coordinate)
    entries = [
        ("magnitude", "N m" if angle else "N", "effort on the coordinate"),
        ("power", "W", "power into the machine"),
        ("normal_load", "N", "normal load"),
    ]
    state = NONE
    if force.model == "lugre":
        entries.append(("bristle", "m", "deflection of the bristles"))
        state = draft.elements.states
        draft.elements.states += 1
    first = _outputs(draft, force.name, *entries)
    model = {"coulomb": friction.COULOMB, "stiction": friction.STICTION, "lugre": friction.LUGRE}[force.model]
    loaded_by = NONE if force.normal_load is not None else [each.name for each in draft.machine.joints].index(joint)
    radius = force.radius or 0.0
    kind, seen_from, to, _ = draft.coordinates.what[coordinate]
    frame = to if kind == CROSS_SECOND else seen_from
    index = [coordinate, model, loaded_by, int(angle), state, first, frame]
    numbers = [
        force.coefficient,
        force.static,
        force.stribeck_speed or 1.0,
        force.transition_speed or 1.0,
        force.viscous,
        force.bristle_stiffness or 0.0,
        force.bristle_damping,
        radius if angle else 1.0,
        force.collar_radius / radius if angle else 0.0,
        2.0 / force.bearing_length if force.bearing_length else 0.0,
        1.0 / radius if radius and not angle else 0.0,
        force.normal_load if force.normal_load is not None else force.preload,
    ]
    draft.frictions.append((index, numbers))


@dataclass(frozen=True)
class ForceKind:
    """How a kind of force becomes numbers, and the families of kernels (`nivel.kernels.forces`) that it may need."""

    add: Callable[[Draft, Any], None]
    families: tuple[str, ...]


FORCES: Final[dict[str, ForceKind]] = {
    "force": ForceKind(add_load, ("load",)),
    "torque": ForceKind(add_load, ("load",)),
    "pair-force": ForceKind(add_pair, ("load", "motor")),
    "spring-damper": ForceKind(add_spring_damper, ("spring",)),
    "torsional-spring-damper": ForceKind(add_torsional_spring_damper, ("spring",)),
    "joint-spring-damper": ForceKind(add_joint_spring_damper, ("spring",)),
    "stop": ForceKind(add_stop, ("stop",)),
    "motor": ForceKind(add_motor, ("motor",)),
    "bushing": ForceKind(add_bushing, ("bushing",)),
    "contact": ForceKind(add_contact, ("contact",)),
    "friction": ForceKind(add_friction, ()),
}


def family_addresses(families: list[str]) -> dict[str, int]:
    """Address of the compiled function of every family."""
    return {name: int(import_module(f"nivel.kernels.forces.{name}").apply.address) for name in families}
