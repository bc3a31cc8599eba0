"""Springs and dampers one behind the other between two points, without mass between them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.machine.core.between import Between
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Damping, NotNegativeLength, Stiffness, Truth
from nivel.machine.core.element import OUTPUTS
from nivel.machine.given import Field, ManyNumbers, Maybe
from nivel.machine.units.quantity import listed

MOST_PARTS: Final = 6
LENGTHS: Final = tuple(f"length_{k + 1}" for k in range(MOST_PARTS))  # of each part, as far as there are so many


class SpringSeries(Between):
    """Parts in series along the line between two points: spring and damper side by side in each, one tension in all of them."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "length", "rate", *LENGTHS)

    type: Literal["spring-series"] = "spring-series"
    stiffness: Annotated[ManyNumbers[Stiffness], BeforeValidator(listed)] = Field(
        description="of each part, from the first point to the second; 0: a damper alone"
    )
    damping: Annotated[Maybe[ManyNumbers[Damping]], BeforeValidator(listed)] = Field(
        default=None, description="of each part", absent="none"
    )
    free_length: Annotated[ManyNumbers[NotNegativeLength], BeforeValidator(listed)] = Field(
        description="of each part, at which its spring has no force; of a part with a damper also its length at the start"
    )
    only_pulls: Truth = Field(default=False, description="it is slack where it would push, as with a rope in it")

    @property
    def dampings(self) -> tuple[float, ...]:
        """Of each part."""
        return self.damping or (0.0,) * len(self.stiffness)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from self.problems_of_line()
        count = len(self.stiffness)
        if not 2 <= count <= MOST_PARTS:
            yield Problem(
                ("stiffness",),
                f"2 to {MOST_PARTS} parts in series were expected, got {count}; one part is a spring-damper",
            )
        for name in ("damping", "free_length"):
            given = getattr(self, name)
            if given is not None and len(given) != count:
                yield Problem((name,), f"one number for each of the {count} parts is needed, got {len(given)}")
                return
        for k, (stiffness, damping) in enumerate(zip(self.stiffness, self.dampings, strict=True)):
            if not stiffness and not damping:
                yield Problem(
                    ("stiffness", k), f"part {k + 1} has neither stiffness nor damping: nothing is held through it"
                )
        if self.only_pulls and all(self.dampings):
            yield Problem(
                ("only_pulls",),
                "every part has a damper; what may be slack needs one part with stiffness alone, as a rope is",
            )
