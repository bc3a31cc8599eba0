"""A rope over pulleys between two ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.between import End, GlobalPoint
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Damping, NotNegativeNumber, PositiveNumber, Stiffness
from nivel.machine.core.element import OUTPUTS, Acts, ForceElement, Inequalities
from nivel.machine.core.marker import ManyMarkers, Marker
from nivel.machine.core.record import BodyName
from nivel.machine.given import Field, ManyNames, ManyNumbers, ManyPlaces, Maybe, OneNumber
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Direction, Length, Position, PositiveLength, Quantity, Velocity, listed

MassPerLength = Annotated[OneNumber, Quantity("mass per length", positive=True)]
Speed = Annotated[OneFunction, varying("velocity")]


class Rope(ForceElement):
    """A rope from the first point over pulleys at those between to the last, straight from one to the next, and around wheels
    where these have `radii`.

    Its tension is stiffness · (s - length) + damping · (ṡ - speed), s being the way along the points; it never pushes. With a `speed`
    its first end is on a winch: the unstressed length is a state, which begins at `length` and changes by the speed.
    Pulleys have no friction, and the rope no mass, unless they are given.
    An end with a radius is a drum, on which the rope is fixed and `wound`.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "stretch", "last_tension")  # the latter with `friction` or mass

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
    markers: Annotated[Maybe[ManyMarkers], BeforeValidator(listed)] = Field(
        default=None,
        description="ends, and pulleys between them, in order: names or markers; a marker may stand there again",
    )
    bodies: Annotated[Maybe[ManyNames[BodyName]], BeforeValidator(listed)] = Field(
        default=None, description="one for each point, in place of `markers`; a body may stand there again"
    )
    points: Annotated[Maybe[ManyPlaces[Position]], BeforeValidator(listed)] = Field(
        default=None, description="ends, and pulleys between them, in order: global, as placed"
    )
    stiffness: Stiffness = Field(description="of the whole rope")
    damping: Damping = Field(default=0.0, description="of the whole rope")
    length: Maybe[PositiveLength] = Field(
        default=None, description="unstressed, at the start", absent="the way as placed, of a rope with `radii`"
    )
    radii: Annotated[Maybe[ManyNumbers[Length]], BeforeValidator(listed)] = Field(
        default=None,
        description="of the wheels at the points, 0 for none: positive where the rope runs right-handed about `axis`, else negative",
    )
    axis: Maybe[Direction] = Field(
        default=None,
        description="of all wheels; global, as placed; with `markers` by default the z axis of the first one that has a radius",
    )
    wound: Annotated[Maybe[ManyNumbers[NotNegativeNumber]], BeforeValidator(listed)] = Field(
        default=None,
        description="turns on the drums at the first and the last end, as placed; the rope is fixed behind them. Or for each point: "
        "whole turns on a wheel between the ends come on top of the arc",
    )
    friction: Maybe[PositiveNumber] = Field(
        default=None,
        description="coefficient of friction on the wheels between the ends, on which the rope sticks or slips",
        absent="none, of wheels that turn freely on the rope",
    )
    mass_per_length: Maybe[MassPerLength] = Field(
        default=None, description="of a rope around wheels without friction", absent="no mass"
    )
    start_speed: Velocity = Field(
        default=0.0, description="of the mass at the start, along the rope from its first end to its last"
    )
    speed: Maybe[Speed] = Field(default=None, description="by which a winch pays rope out, negative: hauls it in")

    @property
    def ends(self) -> tuple[End, ...]:
        """The ends, and the pulleys between them, in order."""
        if self.markers is not None:
            return self.markers
        assert self.bodies is not None  # the record was checked
        assert self.points is not None
        return tuple(GlobalPoint(body, point) for body, point in zip(self.bodies, self.points, strict=True))

    def problems(self) -> Iterator[Problem]:
        if self.length is None and self.radii is None:
            yield Problem((), "`length` is missing: the unstressed length of the rope")
        yield from self._problems_of_wheels()
        if self.markers is not None:
            for name in ("bodies", "points"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `markers`, which say where the rope goes")
            yield from self._problems_of_way("markers", self.markers)
        elif self.bodies is None or self.points is None:
            yield Problem(
                (), "`markers`, or `bodies` and one of `points` for each, are needed to say where the rope goes"
            )
        elif len(self.bodies) != len(self.points):
            message = (
                f"one point for each body is needed; there are {len(self.bodies)} bodies, {len(self.points)} points"
            )
            yield Problem(("points",), message)
        else:
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
