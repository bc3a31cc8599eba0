"""Ropes over pulleys between two ends: straight from point to point, or around wheels; the unstressed length is a state of a winch."""

import itertools
from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, StateFact, add_outputs, of_force
from nivel.elements.forces import heavy_ropes, wound_ropes
from nivel.elements.forces.wound_ropes import PART, WIDTH, RopeRow, paid_out, stick_and_slip, tangent, tension_in
from nivel.elements.kind import Kind
from nivel.elements.rows import element
from nivel.errors import Fault, ModelError
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.lazy import Struct
from nivel.machine.core.coefficient import Damping, NotNegativeNumber, PositiveNumber, Stiffness
from nivel.machine.core.element import Acts, BetweenMany, Inequalities, Marker
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Direction, Length, PositiveLength, Quantity, Velocity, listed

MassPerLength = Annotated[OneNumber, Quantity("mass per length", positive=True)]
Speed = Annotated[OneFunction, varying("velocity")]


class Rope(BetweenMany):
    """A rope from the first point over pulleys at those between to the last, straight from one to the next, and around wheels
    where these have `radii`.

    Its tension is stiffness · (s - length) + damping · (ṡ - speed), s being the way along the points; it never pushes. With a `speed`
    its first end is on a winch: the unstressed length is a state, which begins at `length` and changes by the speed.
    Pulleys have no friction, and the rope no mass, unless they are given.
    An end with a radius is a drum, on which the rope is fixed and `wound`.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("tension"),
        Output("stretch", "m"),
        Output("last_tension", "N", "tension at the last end"),  # with `friction` or mass
    )
    where = "the rope goes"

    inequalities: ClassVar[Inequalities] = (
        # the mass of a rope pulls at its ends where it is slack
        Acts(
            ("is slack", "is taut"),
            "stretch",
            lambda own, of: of["stretch"],
            lambda own, of: of["magnitude"],
            applies=lambda own: own.mass_per_length is None,
        ),
    )

    type: Literal["rope"] = "rope"
    stiffness: Stiffness = Field("of the whole rope")
    damping: Damping = Field("of the whole rope", default=0.0)
    length: Maybe[PositiveLength] = Field(
        "unstressed, at the start", default=None, absent="the way as placed, of a rope with `radii`"
    )
    radii: Annotated[Maybe[ManyNumbers[Length]], BeforeValidator(listed)] = Field(
        "of the wheels at the points, 0 for none: positive where the rope runs right-handed about `axis`, else negative",
        default=None,
    )
    axis: Maybe[Direction] = Field(
        "of all wheels; global, as placed; with `markers` by default the z axis of the first one that has a radius",
        default=None,
    )
    wound: Annotated[Maybe[ManyNumbers[NotNegativeNumber]], BeforeValidator(listed)] = Field(
        "turns on the drums at the first and the last end, as placed; the rope is fixed behind them. Or for each point: "
        "whole turns on a wheel between the ends come on top of the arc",
        default=None,
    )
    friction: Maybe[PositiveNumber] = Field(
        "coefficient of friction on the wheels between the ends, on which the rope sticks or slips",
        default=None,
        absent="none, of wheels that turn freely on the rope",
    )
    mass_per_length: Maybe[MassPerLength] = Field(
        "of a rope around wheels without friction", default=None, absent="no mass"
    )
    start_speed: Velocity = Field(
        "of the mass at the start, along the rope from its first end to its last", default=0.0
    )
    speed: Maybe[Speed] = Field("by which a winch pays rope out, negative: hauls it in", default=None)

    def problems(self) -> Iterator[Problem]:
        if self.length is None and self.radii is None:
            yield Problem((), "`length` is missing: the unstressed length of the rope")
        yield from self._problems_of_wheels()
        yield from super().problems()
        if self.markers is not None:
            yield from self._problems_of_way("markers", self.markers)
        elif self.bodies is not None and self.points is not None and len(self.bodies) != len(self.points):
            counts = f"{len(self.bodies)} bodies, {len(self.points)} points"
            yield Problem(("points",), f"one point for each body is needed; there are {counts}")
        elif self.bodies is not None and self.points is not None:
            yield from self._problems_of_way("points", tuple(zip(self.bodies, self.points, strict=True)))

    def _problems_of_wheels(self) -> Iterator[Problem]:
        if self.start_speed and self.mass_per_length is None:
            yield superfluous("start_speed", "belongs to `mass_per_length`: without mass a rope runs as its ends do")
        if self.mass_per_length is not None and self.friction is not None:
            yield superfluous(
                "friction", "goes without `mass_per_length`: a heavy rope runs over its wheels without friction"
            )
        if self.mass_per_length is not None and not self.stiffness:
            yield Problem(("stiffness",), "`stiffness` is zero: a rope with `mass_per_length` needs one")
        if self.radii is None:
            for name in ("axis", "wound", "friction", "mass_per_length"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "belongs to `radii`, one for each point")
            return
        count = len(self.markers or self.points or ())
        if self.friction is not None and not any(self.radii[1:-1]):
            yield superfluous("friction", "belongs to a wheel between the ends, and none has a radius")
        if self.friction is not None and not self.stiffness:
            yield Problem(("stiffness",), "`stiffness` is zero: a rope with `friction` needs one")
        if len(self.radii) != count:
            yield Problem(("radii",), f"one radius for each point is needed, 0 for a point; there are {count} points")
        elif not any(self.radii):
            yield superfluous("radii", "are all zero: such a rope runs from point to point")
        if self.markers is None and self.axis is None:
            yield Problem((), "`axis` is missing: the direction of the axes of the wheels, e.g. `axis: [0, 1, 0]`")
        yield from self._problems_of_turns(count)

    def _problems_of_turns(self, count: int) -> Iterator[Problem]:
        if self.wound is None or self.radii is None or len(self.radii) != count:
            return
        if len(self.wound) not in (2, count):
            yield Problem(("wound",), f"turns at both ends, or one number for each of the {count} points, are needed")
            return
        radii = self.radii if len(self.wound) == count else (self.radii[0], self.radii[-1])
        for k, (turns, radius) in enumerate(zip(self.wound, radii, strict=True)):
            if turns and not radius:
                where = (
                    "at this end there is no drum" if k in (0, len(radii) - 1) else "at this point there is no wheel"
                )
                yield Problem(("wound", k), f"{where}; give its radius in `radii`, or 0 turns")
            elif turns % 1.0 and 0 < k < len(radii) - 1:
                said = "a wheel between the ends has whole turns on top of the arc that follows from the points"
                yield Problem(("wound", k), f"{said}; give {int(turns)}")

    def turns_at(self, k: int) -> float:
        """Turns that are wound on the drum at an end, or come on top of the arc of a wheel between the ends."""
        count = len(self.ends)
        if self.wound is None:
            return 0.0
        if len(self.wound) == count:
            return self.wound[k]
        return self.wound[0] if k == 0 else self.wound[-1] if k == count - 1 else 0.0

    def _problems_of_way(self, name: str, way: tuple[object, ...]) -> Iterator[Problem]:
        if len(way) < 2:
            yield Problem((name,), f"a rope needs two {name} at least, got {len(way)}")
        for k in range(1, len(way)):
            if way[k] == way[k - 1] and not isinstance(way[k], Marker):
                said = f"the marker `{way[k]}`" if name == "markers" else "this point"
                yield Problem((name, k), f"{said} follows itself; the rope goes from one to another")


@element
def apply(machine, k, index, n, t):
    """Tension of a rope from point to point; s = Σ distances."""
    record = record_at(machine)
    coordinates, out, first = record.coordinates, record.outputs.value, index[RopeRow.OUTPUT]
    length, speed = paid_out(machine, k, t, 0.0 * coordinates.value[index[RopeRow.ALONG]])
    stretch, rate = -length, -speed
    for j in range(np.int64(index[RopeRow.COUNT])):
        q = index[RopeRow.ALONG + j]
        stretch += coordinates.value[q]
        rate += coordinates.rate[q]
    tension = tension_in(machine, k, stretch, rate, speed)
    power = 0.0 * stretch
    for j in range(np.int64(index[RopeRow.COUNT])):
        power += add_coordinate_force(machine, index[RopeRow.ALONG + j], -tension)
    out[first], out[first + 1], out[first + 2] = tension, power, stretch


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
    head = _numbered(builder, rope, rope.length)
    row = RopeRow.of(rope, **head, count=len(distances), along=distances, unstressed=rope.length)
    builder.add(apply, row, memory=1, surfaces=(0,))


def _numbered(builder: SystemBuilder, rope: Rope, unstressed: float) -> dict[str, int]:
    """The first output, the state of the length and the function of the winch's speed, or NONE."""
    plain = rope.friction is None and rope.mass_per_length is None
    first = add_outputs(builder, rope, without=("last_tension",) if plain else ())
    if rope.speed is None:
        return {"output": first, "length": NONE, "speed": NONE}
    fact = StateFact(f"{rope.name}.length", "m", f"unstressed length of {rope.name}", unstressed, scale=unstressed)
    return {"output": first, "length": builder.own_state(fact), "speed": builder.function(rope.speed)}


def _add_wound(builder: SystemBuilder, rope: Rope, radii: tuple[float, ...]) -> None:
    """A rope around wheels: without more, with friction, or with a mass that runs past one of the places, with the same tension on both
    sides of it at the start."""
    way = way_around(rope, radii, [builder.as_placed(end) for end in rope.ends])
    # all markers have the axes of the wheels as placed
    markers = [builder.place(builder.seen_from(body, centre, way.axes)) for body, centre in way.places]
    unstressed, count = way.length if rope.length is None else rope.length, len(markers)
    head = _numbered(builder, rope, unstressed)
    places = [
        [radius, arc, fixed, *[0.0] * (WIDTH - 3)]
        for radius, arc, fixed in zip(radii, way.arcs, way.fixed, strict=True)
    ]
    family, memory, columns, numbers = wound_ropes.apply, 1 + count, [], []
    if rope.mass_per_length is not None:
        family, p = heavy_ropes.apply, _passed(radii, [body for body, _ in way.places])
        rims = [abs(r) * max(arc, 0.0) for r, arc in zip(radii, way.arcs, strict=True)]
        before = sum(way.lengths[:p]) + sum(rims[: max(p, 1)])
        behind = way.length - before - 0.5 * (way.length - unstressed)
        travel = StateFact(f"{rope.name}.travel", "m", f"way that {rope.name} has run", 0.0, scale=unstressed)
        run = StateFact(f"{rope.name}.run", "m/s", f"speed at which {rope.name} runs", rope.start_speed, scale=1.0)
        columns, numbers = [p, builder.own_state(travel), builder.own_state(run)], [rope.mass_per_length, behind]
    elif rope.friction is not None:
        family, memory, numbers = stick_and_slip, memory + 2 * len(way.parts), [rope.friction, way.length]
        for part, share in zip(way.parts, way.shares, strict=True):
            numbers += [rope.stiffness * way.length / share, *part, *[0.0] * (PART - 3)]
    head |= {"count": count, "axis": markers[first_wheel(radii)], "along": [*markers, *columns]}
    row = RopeRow.of(rope, **head, unstressed=unstressed, places=[*itertools.chain(*places), *numbers])
    builder.add(family, row, memory=memory, surfaces=() if family is stick_and_slip else (0,))


def _passed(radii: tuple[float, ...], bodies: list[str]) -> int:
    """The place past which the mass of a rope runs: a wheel between the ends, rather on the ground and in the middle; else a drum."""
    inner = [k for k in range(1, len(radii) - 1) if radii[k]]
    middle = 0.5 * (len(radii) - 1)
    if inner:
        return min(inner, key=lambda k: (bodies[k] != "ground", abs(k - middle)))
    return 0 if radii[0] else len(radii) - 1


class Way(Struct):
    """The way of a rope around wheels as its bodies are placed.

    axes (3, 3) : global, z along those of the wheels. places : body and centre (3,) of each. arcs [rad], fixed [rad] : of each place, the
    latter the direction in which the rope is fixed on a drum. length [m] : in all. lengths [m] : of each free part. parts : of each free
    one L - ρ α and α, as `nivel.elements.forces.wound_ropes` has them. shares [m] : of the length that each has, with half of the arcs
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


def way_around(rope: Rope, radii: tuple[float, ...], placed: Sequence[tuple[str, Array, Array]]) -> Way:
    """The way of a rope between its ends, of each the body, its global point (3,) and global axes (3, 3), around wheels of these radii.

    Raises ModelError where wheels lie in each other.
    """
    axis = np.array(rope.axis, dtype=float) if rope.axis is not None else placed[first_wheel(radii)][2][:, 2]
    axis = axis / np.linalg.norm(axis)
    axes = _with_z(axis)
    centres = [axes.T @ centre for _, centre, _ in placed]
    parts = []
    for k, (a, b) in enumerate(itertools.pairwise(centres)):
        rho = radii[k + 1] - radii[k]
        d = b - a
        if not np.hypot(d[0], d[1]) > abs(rho):
            within = f"the wheels at points {k + 1} and {k + 2} of {rope.name}"
            raise ModelError(
                Fault.at(
                    f"forces.{rope.name}",
                    f"{within} lie in each other, seen along their axis: no rope runs between them",
                )
            )
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


def length_of(rope: Rope, placed: Sequence[tuple[str, Array, Array]]) -> float:
    """[m] of the way of a rope between its ends as these are placed."""
    if rope.radii is not None:
        return way_around(rope, rope.radii, placed).length
    points = np.array([point for _, point, _ in placed])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def first_wheel(radii: tuple[float, ...]) -> int:
    """Number of the first place with a wheel, whose body carries the axis."""
    return next(k for k, radius in enumerate(radii) if radius)


def _with_z(axis: Array) -> Array:
    """Axes (3, 3) of which z is `axis` (3,), a unit vector."""
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(axis)))], axis)
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(axis, x), axis])


KINDS = (Kind(Rope, add, (apply, wound_ropes.apply, stick_and_slip, heavy_ropes.apply)),)
