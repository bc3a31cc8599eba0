"""Values of a machine that are far from those of real machines: what stands there, what is usual, and what to write."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Finding, ModelError
from nivel.known import Contact
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_of, mass_properties
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import (
    axes_of,
    box_size,
    centroid,
    length,
    mesh_surface,
    share_of_hull,
    squared_gyration,
)
from nivel.machine.control.part import signals_read
from nivel.machine.core.element import End
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.record import Record
from nivel.machine.given import Usual, usual_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.uses.references import SECTIONS

# Of its hull a body fills no less than this share where the hull may touch in its place.
HOLLOW: Final = 0.9
# Bodies of machines are shorter [m] and lighter [kg].
LONGEST: Final = 100.0
HEAVIEST: Final = 1e6
# Keys that act by another one alone, in all kinds that have both.
_EFFICIENCIES: Final = ("volumetric_efficiency", "mechanical_efficiency")
BELONGS_TO: Final = {
    "critical_ratio": ("sonic_conductance",),
    "damping_ratio": ("frequency",),
    "discharge_coefficient": ("diameter", "area", "notches"),
    "friction_model": ("friction",),
    "friction_transition_speed": ("friction",),
    "nominal_pressure": _EFFICIENCIES,
    "nominal_speed": _EFFICIENCIES,
}

# Ropes of steel break at 1 to 3 % of strain, those of fibres at 3 to 30 %, and work at less than half of it.
STRAIN: Final = 0.1
# [N] stiffness times length; below it stands rubber, which may be stretched to several times its length.
RUBBER: Final = 1e4
Place = tuple[str, NDArray[np.float64], NDArray[np.float64]]


def remarks(machine: MachineRecord) -> Iterator[Finding]:
    """Everything that is unusual in a machine."""
    yield from _of_fields(machine, "")
    for section in SECTIONS:
        for element in getattr(machine, section):
            yield from _of_fields(element, f"{section}.{element.name}")
    if machine.hydraulics:
        yield from nivel.judge.before.circuits.volume_remarks(machine)
    yield from _hollow(machine)
    yield from _immense(machine)
    yield from _narrow(machine)
    yield from resting_remarks(machine)
    for force in machine.forces:
        yield from (Finding(f"forces.{force.name}.{key}", text) for key, text in force.remarks(machine))
    if machine.hydraulics:
        yield from nivel.judge.before.circuits.circuit_remarks(machine.hydraulics)
    yield from _unread(machine)
    for section in SECTIONS:
        for element in getattr(machine, section):
            yield from _idle(element, f"{section}.{element.name}")


def _idle(element: Record, place: str) -> Iterator[Finding]:
    """Keys that were given and have no effect, since what they belong to was not."""
    fields, given = type(element).model_fields, element.model_fields_set
    for key in given & BELONGS_TO.keys():
        others = [each for each in BELONGS_TO[key] if each in fields]
        if others and given.isdisjoint(others):
            message = f"`{key}` has no effect without {' or '.join(f'`{each}`' for each in others)}; leave it out"
            yield Finding(f"{place}.{key}", message)
    if getattr(element, "type", "") == "rate-limit" and {"time_constant", "sample_time"} <= given:
        yield Finding(f"{place}.time_constant", "`time_constant` has no effect with a `sample_time`; leave it out")
    for name in given:
        value = getattr(element, name)
        several = value if isinstance(value, tuple) else (value,)
        for at, each in value.items() if isinstance(value, Mapping) else enumerate(several):
            if isinstance(each, Record):
                yield from _idle(each, f"{place}.{name}" if each is value else f"{place}.{name}.{at}")


def _unread(machine: MachineRecord) -> Iterator[Finding]:
    read = {path for each in machine.functions for path in each.function.signals} if machine.inputs else set()
    read |= {path for block in machine.control for part in block.parts for path in signals_read(part.function)}
    for given in machine.inputs:
        path = f"{given.name}.value"
        if path not in read:
            message = f"nothing reads `{path}`, so this input has no effect; write it where it acts, or leave it out"
            yield Finding(f"inputs.{given.name}", message)


@cache
def unit_of(usual: Usual) -> float:
    """The unit of a range in SI units."""
    return read_quantity(f"1*({usual.unit})", ANY, {})


def excess(value: float, usual: Usual) -> float:
    """By how many times the magnitude of `value`, in SI units, is beyond a range; up to 1 within it. Zero is usual."""
    size = abs(value) / unit_of(usual)
    return max(size / usual.most, usual.least / size) if size > 0.0 else 0.0


def in_words(value: float, usual: Usual) -> str:
    """``2500 bar, and 0.01 to 700 bar is usual``."""
    span = f"{usual.least:g} to {usual.most:g}" if usual.least else f"up to {usual.most:g}"
    return f"{value / unit_of(usual):.6g} {usual.unit}, and {span} {usual.unit} is usual"


def _of_fields(record: Record, place: str) -> Iterator[Finding]:
    """What is unusual in the fields of a record, and of those that it holds."""
    start = f"{place}." if place else ""
    kind: Any = type(record)
    for name, key, usual in _usual_in(kind):
        value = getattr(record, name)
        if usual is not None:
            yield from _of_value(value, usual, f"{start}{key}", key)
        elif isinstance(value, Record):
            yield from _of_fields(value, f"{start}{key}")


@cache
def _usual_in(kind: type[Record]) -> tuple[tuple[str, str, Usual | None], ...]:
    """(name, key, what is usual) of all fields of a kind of record."""
    return tuple((name, field.alias or name, usual_of(field)) for name, field in kind.model_fields.items())


def _of_value(value: Any, usual: Usual, place: str, key: str) -> Iterator[Finding]:
    numbers = value if isinstance(value, tuple) else (value,)
    shares = [(excess(each, usual), each) for each in numbers if isinstance(each, float | int)]
    share, worst = max(shares, default=(0.0, 0.0))
    if share > 1.0:
        message = f"`{key}` is {in_words(worst, usual)}; for example `{key}: {usual.example}`"
        yield Finding(place, message, share)


def _hollow(machine: MachineRecord) -> Iterator[Finding]:
    """Contacts of bodies of which the hull touches, and is much more than the body."""
    for force in machine.forces:
        if not isinstance(force, Contact) or force.bodies is None:
            continue
        for name in force.bodies:
            shape = machine.touching[name].shape
            if not isinstance(shape, Extrusion | Mesh) or (isinstance(shape, Mesh) and shape.parts is not None):
                continue
            share = share_of_hull(shape)
            if share < HOLLOW:
                advice = "divide it into bodies with `fixed` joints, or take a mesh with `convex_parts`"
                advice = "give the shape `convex_parts: 8`" if isinstance(shape, Mesh) else advice
                message = f"`{name}` is concave, and its hull touches, of which it fills {100 * share:.0f} %; {advice}"
                yield Finding(f"forces.{force.name}", message)


def _immense(machine: MachineRecord) -> Iterator[Finding]:
    """Bodies that are larger or heavier than those of machines, as where the file of a mesh is in millimetres."""
    for body in machine.bodies:
        shape = body.shape
        if shape is None or body.point_mass or body.flexible is not None:
            continue
        if isinstance(shape, Mesh):
            extent = float(np.ptp(mesh_surface(shape)[0], axis=0).max())
        else:
            extent = math.sqrt(12.0 * float(np.max(squared_gyration(shape))))  # of a bar its length
        mass = mass_of(body)
        if extent <= LONGEST and mass <= HEAVIEST:
            continue
        smaller = f"{extent / 1000.0:.4g} m" + (f" and {mass / 1e9:.4g} kg" if body.density is not None else "")
        advice = f"with `unit: {shape.unit:g} mm` of its file" if isinstance(shape, Mesh) else "in millimetres"
        message = (
            f"`{body.name}` is {extent:.4g} m long and has a mass of {mass:.4g} kg; is it given in millimetres? Lengths divided by 1000, "
            f"{advice}, make {smaller}"
        )
        yield Finding(f"bodies.{body.name}.shape", message)


def _narrow(machine: MachineRecord) -> Iterator[Finding]:
    """Balls on ground with heights that curves more than they do."""
    for force in machine.forces:
        if not isinstance(force, Contact) or force.heights is None or force.body is None:
            continue
        shape = machine.touching[force.body].shape
        radius = getattr(shape, "radius", None)
        curvature = force.heights.greatest_curvature
        if not isinstance(shape, Sphere | Capsule) or radius is None or radius * curvature <= 1.0:
            continue
        message = (
            f"a valley of the ground curves with a radius of {1.0 / curvature:.3g} m, less than the {radius:.3g} m of "
            f"`{force.body}`, which touches one side at a time there, and jumps between them; write smoother heights, or a smaller radius"
        )
        yield Finding(f"forces.{force.name}.heights", message)


# Of its size a body touches within this share.
TOUCHES = 1e-6


def resting_remarks(machine: MachineRecord) -> Iterator[Finding]:
    """A contact without overlap has no force, so its body slides before friction can hold it."""
    if machine.simulation.start == "equilibrium":
        return
    for force in machine.forces:
        if not isinstance(force, Contact) or not force.sticks or not force.static > force.friction:
            continue
        if force.body is None or force.plane is None or force.heights is not None or force.stiffness is None:
            continue
        body = machine.body_named.get(force.body)
        if body is None:  # a shape of a marker
            continue
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
        yield Finding(
            f"forces.{force.name}",
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


def stretched_ropes(machine: MachineRecord, place: Callable[[End], Place]) -> Iterator[Finding]:
    """Each rope whose way as placed is more than 10 % longer than its unstressed length: a slip of a number, or of the sign of a radius.

    place : of an end, its body, global point (3,) and axes (3, 3) as placed.
    """
    ropes: list[Any] = [each for each in machine.forces if each.type == "rope"]
    for rope in ropes:
        if rope.length is None or rope.stiffness * rope.length < RUBBER:
            continue
        placed = [place(end) for end in rope.ends]
        way = nivel.elements.forces.ropes.length_of(rope, placed)
        if way > (1.0 + STRAIN) * rope.length:
            yield Finding(
                f"forces.{rope.name}",
                f"its way as placed is {way:.4g} m, {100.0 * (way / rope.length - 1.0):.3g} % longer than `length`, so the run begins with "
                f"a tension of {rope.stiffness * (way - rope.length):.3g} N{_other_side(rope, placed)}",
            )


def _other_side(rope: Any, placed: Sequence[Place]) -> str:
    """The radius whose other sign makes the way a usual one, if there is one."""
    radii, length = rope.radii or (), rope.length or 0.0
    for k, radius in enumerate(radii):
        other = (*radii[:k], -radius, *radii[k + 1 :])
        try:
            way = nivel.elements.forces.ropes.way_around(rope, other, placed).length if radius else 0.0
        except ModelError:  # on that side it would lie within another wheel
            continue
        if radius and way <= (1.0 + STRAIN) * length:
            written = ", ".join(f"{each:g}" for each in other)
            return f"; on the other side of the wheel at point {k + 1} it would be {way:.4g} m: `radii: [{written}]`"
    return ""
