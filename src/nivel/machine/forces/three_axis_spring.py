"""A spring and damper with a stiffness along each global axis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Damping, ForceValue, Stiffness
from nivel.machine.forces.between import Between
from nivel.machine.forces.element import OUTPUTS
from nivel.machine.given import Field, ThreeNumbers
from nivel.machine.units.quantity import Position, listed

ThreeStiffnesses = Annotated[ThreeNumbers[Stiffness], BeforeValidator(listed)]
ThreeDampings = Annotated[ThreeNumbers[Damping], BeforeValidator(listed)]
ThreeForces = Annotated[ThreeNumbers[ForceValue], BeforeValidator(listed)]


class ThreeAxisSpring(Between):
    """Along each global axis, a force stiffness · (displacement - free_displacement) + damping · rate + preload, in N, draws two points
    together. The displacement is that of the second point from the first.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, *(f"force_{axis}" for axis in "xyz"))

    type: Literal["three-axis-spring"] = "three-axis-spring"
    stiffness: ThreeStiffnesses = Field(default=(0.0, 0.0, 0.0), description="along global x, y, z")
    damping: ThreeDampings = Field(default=(0.0, 0.0, 0.0), description="along global x, y, z")
    free_displacement: Position = Field(
        default=(0.0, 0.0, 0.0), description="of the second point from the first, at which the springs have no force"
    )
    preload: ThreeForces = Field(
        default=(0.0, 0.0, 0.0), description="added to the forces that draw the points together"
    )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not any((*self.stiffness, *self.damping, *self.preload)):
            yield Problem((), "a three-axis-spring needs a `stiffness`, a `damping` or a `preload` along some axis")
