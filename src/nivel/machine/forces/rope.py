"""A rope over pulleys between two ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from nivel.machine.checked import Problem
from nivel.machine.coefficient import Damping, Stiffness
from nivel.machine.forces.between import End
from nivel.machine.forces.element import OUTPUTS, ForceElement
from nivel.machine.marker import MarkerPlace
from nivel.machine.quantity import PositiveLength, listed
from nivel.machine.time_function import TimeFunction, varying

Speed = Annotated[TimeFunction, varying("velocity")]


class Rope(ForceElement):
    """A massless rope from the first marker over pulleys at those between to the last, straight from one to the next.

    Its tension is stiffness · (s - length) + damping · (ṡ - speed), s being the way along the markers; it never pushes. With a `speed`
    its first end is on a winch: the unstressed length is a state, which begins at `length` and changes by the speed.
    Pulleys have no friction and no radius.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "stretch")

    type: Literal["rope"] = "rope"
    markers: Annotated[tuple[MarkerPlace, ...], BeforeValidator(listed)] = Field(
        description="ends, and pulleys between them, in order: names or markers; a marker may stand there again"
    )
    stiffness: Stiffness = Field(description="of the whole rope")
    damping: Damping = Field(default=0.0, description="of the whole rope")
    length: PositiveLength = Field(description="unstressed, at the start")
    speed: Speed | None = Field(default=None, description="by which a winch pays rope out, negative: hauls it in")

    @property
    def ends(self) -> tuple[End, ...]:
        """The markers."""
        return self.markers

    def problems(self) -> Iterator[Problem]:
        if len(self.markers) < 2:
            yield Problem(("markers",), f"a rope needs two markers at least, got {len(self.markers)}")
        for k in range(1, len(self.markers)):
            if isinstance(self.markers[k], str) and self.markers[k] == self.markers[k - 1]:
                yield Problem(
                    ("markers", k), f"the marker `{self.markers[k]}` follows itself; the rope goes from one to another"
                )
