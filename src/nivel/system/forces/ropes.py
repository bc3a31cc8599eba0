"""Ropes in numbers: distances from marker to marker or ways around wheels, and the unstressed length, a state where there is a winch."""

from __future__ import annotations

import itertools

import numpy as np

from nivel.elements.kind import Kind
from nivel.elements.states import StateFact
from nivel.errors import Fault, ModelError
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces import capstan_rope, heavy_rope, wound_rope
from nivel.kernels.forces import rope as straight
from nivel.kernels.forces.wound_rope import WIDTH, tangent
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.machine.core.between import GlobalPoint
from nivel.machine.forces.rope import Rope
from nivel.machine.machine_record import MachineRecord
from nivel.system.builder import GROUND, SystemBuilder
from nivel.system.forces.outputs import force_outputs, magnitude_and_power
from nivel.system.joints.interfaces import marker_place
from nivel.system.joints.joint_frames import Placed, seen_from
from nivel.system.tables import Array


def add(builder: SystemBuilder, rope: Rope) -> None:
    """A rope."""
    if rope.radii is not None:
        _add_wound(builder, rope, rope.radii)
        return
    assert rope.length is not None  # the record was checked
    markers = [builder.end(end) for end in rope.ends]
    distances = [
        builder.coordinates.use(builder.coordinates.add(DISTANCE, i, j)) for i, j in itertools.pairwise(markers)
    ]
    columns = [*_numbered(builder, rope, rope.length), len(distances), *distances]
    numbers = [rope.stiffness, rope.damping, rope.length]
    builder.elements.add(straight.apply, columns, numbers, memory=1, surfaces=(0,))


def _numbered(builder: SystemBuilder, rope: Rope, unstressed: float) -> tuple[int, int, int]:
    """The first output, the state of the length and the function of the winch's speed, or NONE."""
    last = (
        [("last_tension", "N", "tension at the last end")]
        if rope.friction is not None or rope.mass_per_length is not None
        else []
    )
    first = force_outputs(builder, rope.name, *magnitude_and_power("N", "tension"), ("stretch", "m", "stretch"), *last)
    if rope.speed is None:
        return first, NONE, NONE
    fact = StateFact(f"{rope.name}.length", "m", f"unstressed length of {rope.name}", unstressed, scale=unstressed)
    return first, builder.own_state(fact), builder.function(rope.speed)


def _add_wound(builder: SystemBuilder, rope: Rope, radii: tuple[float, ...]) -> None:
    """A rope around wheels."""
    machine = builder.machine
    way = way_as_placed(machine, rope, radii)
    # all markers have the axes of the wheels as placed
    markers = [builder.place(seen_from(machine, body, centre, way.axes)) for body, centre in way.places]
    carrier = markers[first_wheel(radii)]
    unstressed = way.length if rope.length is None else rope.length
    numbers = [rope.stiffness, rope.damping, unstressed]
    for radius, arc, fixed in zip(radii, way.arcs, way.fixed, strict=True):
        numbers += [radius, arc, fixed, *[0.0] * (WIDTH - 3)]
    columns = [*_numbered(builder, rope, unstressed), len(markers), carrier, *markers]
    if rope.mass_per_length is not None:
        _add_mass(builder, rope, rope.mass_per_length, way, columns, numbers)
        return
    if rope.friction is None:
        builder.elements.add(wound_rope.apply, columns, numbers, memory=1 + len(markers), surfaces=(0,))
        return
    numbers += [rope.friction, way.length]
    for part, share in zip(way.parts, way.shares, strict=True):
        numbers += [rope.stiffness * way.length / share, *part, *[0.0] * (capstan_rope.PART - 3)]
    builder.elements.add(capstan_rope.apply, columns, numbers, memory=1 + 2 * len(way.parts) + len(markers))


def _add_mass(
    builder: SystemBuilder, rope: Rope, mass_per_length: float, way: Way, columns: list[int], numbers: list[float]
) -> None:
    """The same with a mass that runs past one of the places, with the same tension on both sides of it at the start."""
    assert rope.radii is not None
    p, unstressed, count = _passed(rope.radii, [body for body, _ in way.places]), numbers[2], len(rope.radii)
    rims = [abs(r) * max(arc, 0.0) for r, arc in zip(rope.radii, way.arcs, strict=True)]
    before = sum(way.lengths[:p]) + sum(rims[: max(p, 1)])
    behind = way.length - before - 0.5 * (way.length - unstressed)
    travel = StateFact(f"{rope.name}.travel", "m", f"way that {rope.name} has run", 0.0, scale=unstressed)
    run = StateFact(f"{rope.name}.run", "m/s", f"speed at which {rope.name} runs", rope.start_speed, scale=1.0)
    columns = [*columns, p, builder.own_state(travel), builder.own_state(run)]
    builder.elements.add(
        heavy_rope.apply, columns, [*numbers, mass_per_length, behind], memory=1 + count, surfaces=(0,)
    )


def _passed(radii: tuple[float, ...], bodies: list[str]) -> int:
    """The place past which the mass of a rope runs: a wheel between the ends, rather on the ground and in the middle; else a drum."""
    inner = [k for k in range(1, len(radii) - 1) if radii[k]]
    middle = 0.5 * (len(radii) - 1)
    if inner:
        return min(inner, key=lambda k: (bodies[k] != GROUND, abs(k - middle)))
    return 0 if radii[0] else len(radii) - 1


@dataclass(frozen=True)
class Way:
    """The way of a rope around wheels as its bodies are placed.

    axes (3, 3) : global, z along those of the wheels. places : body and centre (3,) of each. arcs [rad], fixed [rad] : of each place, the
    latter the direction in which the rope is fixed on a drum. length [m] : in all. lengths [m] : of each free part. parts : of each free
    one L - ρ α and α, as `nivel.kernels.forces.capstan_rope` has them. shares [m] : of the length that each has, with half of the arcs
    at its ends.
    """

    axes: Array
    places: list[tuple[str, Array]]
    arcs: list[float]
    fixed: list[float]
    length: float
    lengths: list[float]
    parts: list[tuple[float, float]]
    shares: list[float]


def way_as_placed(machine: MachineRecord, rope: Rope, radii: tuple[float, ...]) -> Way:
    """The way of a rope. Raises ModelError where wheels lie in each other, or axes of markers differ from those of the wheels."""
    placed = [_global(machine, rope, k) for k in range(len(radii))]
    axis = np.array(rope.axis, dtype=float) if rope.axis is not None else placed[first_wheel(radii)][2][:, 2]
    axis = axis / np.linalg.norm(axis)
    axes = _with_z(axis)
    centres = [axes.T @ centre for _, centre, _ in placed]
    parts = []
    for k, (a, b) in enumerate(itertools.pairwise(centres)):
        rho = radii[k + 1] - radii[k]
        d = b - a
        if not np.hypot(d[0], d[1]) > abs(rho):
            raise ModelError(Fault("", 0, 0, f"forces.{rope.name}", _inside(rope, k)))
        length, ux, uy = tangent(d[0], d[1], rho)
        parts.append((float(np.hypot(length, d[2])), complex(ux, uy)))
    arcs, fixed = [0.0] * len(radii), [0.0] * len(radii)
    for k in range(1, len(radii) - 1):
        turned = float(np.angle(parts[k][1] / parts[k - 1][1])) * np.sign(radii[k])
        # from a quarter turn short of touching to what is left of a whole one
        arc = (turned + 0.5 * np.pi) % (2.0 * np.pi) - 0.5 * np.pi + 2.0 * np.pi * rope.turns_at(k)
        arcs[k] = arc if radii[k] else 0.0
    for k in (0, len(radii) - 1):
        if radii[k]:
            sign, arcs[k] = np.sign(radii[k]), 2.0 * np.pi * rope.turns_at(k)
            touched = float(np.angle(-1j * sign * parts[min(k, len(parts) - 1)][1]))
            fixed[k] = touched + (-sign if k == 0 else sign) * arcs[k]
    lengths = [part for part, _ in parts]
    length = sum(lengths) + sum(abs(r) * max(arc, 0.0) for r, arc in zip(radii, arcs, strict=True))
    # α goes on from part to part, by the arc of the wheel between them, so that their difference is that arc
    angles = [float(np.angle(parts[0][1]))]
    for k in range(1, len(parts)):
        turned = float(np.angle(parts[k][1] / parts[k - 1][1]))
        angles.append(angles[-1] + (float(np.sign(radii[k])) * arcs[k] if radii[k] else turned))
    ways = [
        (part - (radii[k + 1] - radii[k]) * angle, angle)
        for k, ((part, _), angle) in enumerate(zip(parts, angles, strict=True))
    ]
    rims = [abs(r) * max(arc, 0.0) for r, arc in zip(radii, arcs, strict=True)]
    ends = [1.0 if k in (0, len(radii) - 1) else 0.5 for k in range(len(radii))]
    shares = [part + ends[k] * rims[k] + ends[k + 1] * rims[k + 1] for k, (part, _) in enumerate(parts)]
    return Way(axes, [(body, centre) for body, centre, _ in placed], arcs, fixed, length, lengths, ways, shares)


def length_as_placed(machine: MachineRecord, rope: Rope) -> float:
    """[m] of the way of a rope as its bodies are placed."""
    if rope.radii is not None:
        return way_as_placed(machine, rope, rope.radii).length
    points = np.array([_global(machine, rope, k)[1] for k in range(len(rope.ends))])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def first_wheel(radii: tuple[float, ...]) -> int:
    """Number of the first place with a wheel, whose body carries the axis."""
    return next(k for k, radius in enumerate(radii) if radius)


def _inside(rope: Rope, k: int) -> str:
    return f"the wheels at points {k + 1} and {k + 2} of {rope.name} lie in each other, seen along their axis: no rope runs between them"


def _global(machine: MachineRecord, rope: Rope, k: int) -> Placed:
    """Body, global point (3,) and global axes (3, 3) of a place as its body is placed."""
    end = rope.ends[k]
    if isinstance(end, GlobalPoint):
        return end.body, np.array(end.point, dtype=float), np.eye(3)
    body, point, axes = marker_place(machine, machine.marker_named[end] if isinstance(end, str) else end)
    if body == "ground":
        return body, point, axes
    position, A = machine.placed[body]
    return body, position + A @ point, A @ axes


def _with_z(axis: Array) -> Array:
    """Axes (3, 3) of which z is `axis` (3,), a unit vector."""
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(axis)))], axis)
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(axis, x), axis])


KINDS = (Kind(Rope, add, (straight.apply, wound_rope.apply, capstan_rope.apply, heavy_rope.apply)),)
