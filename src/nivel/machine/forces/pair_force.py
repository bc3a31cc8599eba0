"""A given force between two points and its counter-force."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.between import Between
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.element import OUTPUTS
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import ForceComponent, SpringForce, ThreeFunctions
from nivel.machine.units.quantity import listed

Vector = Annotated[ThreeFunctions[ForceComponent], BeforeValidator(listed)]


class PairForce(Between):
    """A force on the second point and the opposite one on the first: a `magnitude` along the line between, or a
    `vector`.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "length", "rate")

    type: Literal["pair-force"] = "pair-force"
    magnitude: Maybe[SpringForce] = Field(
        default=None, description="along the line, pushing apart; may use `length` and `rate`"
    )
    vector: Maybe[Vector] = Field(default=None, description="on the second point, opposite on the first")
    axes: Literal["global", "first"] = Field(
        default="global", description="axes of the vector: global, or those of the first marker"
    )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.magnitude is None and self.vector is None:
            yield Problem((), "a pair-force needs a `magnitude` along the line, or a `vector`")
        if self.magnitude is not None:
            if self.vector is not None:
                yield superfluous("vector", "stands in place of `magnitude`; give one of them")
            elif self.axes != "global":
                yield superfluous("axes", "belongs to a `vector`, and none is given")
            yield from self.problems_of_line()
