"""Springs that meet in a node without mass."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.machine.core.between import End, GlobalPoint
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import NotNegativeLength, Truth
from nivel.machine.core.element import OUTPUTS, ForceElement
from nivel.machine.core.marker import ManyMarkers
from nivel.machine.core.record import BodyName
from nivel.machine.given import Field, ManyNames, ManyNumbers, ManyPlaces, Maybe, OneNumber
from nivel.machine.units.quantity import Position, Quantity, listed

MOST_SPRINGS: Final = 8
TENSIONS: Final = tuple(f"tension_{k + 1}" for k in range(MOST_SPRINGS))  # of each spring, as far as there are so many
PositiveStiffness = Annotated[OneNumber, Quantity("stiffness", positive=True)]


class SpringNode(ForceElement):
    """Springs from points of bodies to one node without mass, which is where they balance."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "x", "y", "z", *TENSIONS)

    type: Literal["spring-node"] = "spring-node"
    node: Position = Field(description="where about it is at the start: global; it is found from there")
    markers: Annotated[Maybe[ManyMarkers], BeforeValidator(listed)] = Field(
        default=None, description="where each spring is held: names or markers"
    )
    bodies: Annotated[Maybe[ManyNames[BodyName]], BeforeValidator(listed)] = Field(
        default=None, description="one for each spring, in place of `markers`; a body may stand there again"
    )
    points: Annotated[Maybe[ManyPlaces[Position]], BeforeValidator(listed)] = Field(
        default=None, description="where each spring is held: global, as placed"
    )
    stiffness: Annotated[ManyNumbers[PositiveStiffness], BeforeValidator(listed)] = Field(description="of each spring")
    free_length: Annotated[ManyNumbers[NotNegativeLength], BeforeValidator(listed)] = Field(
        description="of each spring, at which it has no force"
    )
    only_pulls: Truth = Field(default=False, description="the springs never push, as ropes")

    @property
    def ends(self) -> tuple[End, ...]:
        """Where the springs are held."""
        if self.markers is not None:
            return self.markers
        assert self.bodies is not None  # the record was checked
        assert self.points is not None
        return tuple(GlobalPoint(body, point) for body, point in zip(self.bodies, self.points, strict=True))

    def problems(self) -> Iterator[Problem]:
        count = len(self.stiffness)
        if not 3 <= count <= MOST_SPRINGS:
            yield Problem(
                ("stiffness",),
                f"3 to {MOST_SPRINGS} springs that meet were expected, got {count}; two are a `spring-series`",
            )
        if len(self.free_length) != count:
            yield Problem(
                ("free_length",), f"one length for each of the {count} springs is needed, got {len(self.free_length)}"
            )
        if self.markers is not None:
            for name in ("bodies", "points"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `markers`, which say where the springs are held")
            held, name = len(self.markers), "markers"
        elif self.bodies is None or self.points is None:
            yield Problem(
                (), "`markers`, or `bodies` and one of `points` for each, are needed to say where the springs are held"
            )
            return
        else:
            held, name = len(self.points), "points"
            if len(self.bodies) != held:
                yield Problem(
                    ("bodies",),
                    f"one body for each point is needed; there are {len(self.bodies)} bodies, {held} points",
                )
        if held != count:
            yield Problem((name,), f"one of the {name} for each of the {count} springs is needed, got {held}")
        elif self.points is not None and self.markers is None:
            for k, point in enumerate(self.points):
                if point == self.node:
                    yield Problem(
                        ("points", k), "this point is where the node is; the spring between them has no direction"
                    )
