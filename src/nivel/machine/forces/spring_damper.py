"""A spring and damper along the line between two points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Damping, ForceValue, NotNegativeLength, Stiffness
from nivel.machine.forces.between import Between
from nivel.machine.forces.characteristic import ForceTable
from nivel.machine.forces.element import OUTPUTS
from nivel.machine.forces.spring import problems_of_spring
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.time_function import SpringForce


class SpringDamper(Between):
    """Tension stiffness · (length - free_length) + damping · rate + preload, in N, between two points.

    A `table` stands in place of the stiffness, a `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "length", "rate")

    type: Literal["spring-damper"] = "spring-damper"
    stiffness: Maybe[Stiffness] = Field(default=None)
    damping: Damping = Field(default=0.0)
    free_length: Maybe[NotNegativeLength] = Field(default=None, description="at which the spring has no force")
    preload: ForceValue = Field(default=0.0, description="added to the tension")
    table: Maybe[OneRecord[ForceTable]] = Field(default=None, description="of the spring, in place of `stiffness`")
    law: Maybe[SpringForce] = Field(default=None, description="the tension; may use `length` and `rate`")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from self.problems_of_line()
        yield from problems_of_spring(self, "free_length")
        springs = self.law is None and (self.stiffness is not None or self.table is not None)
        if springs and self.free_length is None:
            yield Problem((), "`free_length` is missing: the length at which the spring has no force")
