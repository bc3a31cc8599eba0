"""A spring and damper on a joint coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import (
    COORDINATE,
    COORDINATE_EFFORT,
    CoordinateDamping,
    CoordinateEffort,
    CoordinateStiffness,
    CoordinateValue,
    columns_of_coordinate,
)
from nivel.machine.forces.characteristic import EffortTable
from nivel.machine.forces.element import OUTPUTS, ForceElement
from nivel.machine.forces.spring import problems_of_spring
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.coordinate_function import CoordinateLaw
from nivel.machine.uses.coordinate_reference import CoordinateReference

_check_columns = columns_of_coordinate({"deflections": COORDINATE, "efforts": COORDINATE_EFFORT})


class JointSpringDamper(ForceElement):
    """Effort stiffness · (coordinate - free_value) + damping · rate + preload, in N or N m, that resists.

    A `table` stands in place of the stiffness, a `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "value", "rate")

    type: Literal["joint-spring-damper"] = "joint-spring-damper"
    coordinate: CoordinateReference
    stiffness: Maybe[CoordinateStiffness] = Field(default=None)
    damping: CoordinateDamping = Field(default=0.0)
    free_value: CoordinateValue = Field(default=0.0, description="of the coordinate where the spring has no effort")
    preload: CoordinateEffort = Field(default=0.0, description="added to the effort that resists")
    table: Annotated[Maybe[OneRecord[EffortTable]], BeforeValidator(_check_columns)] = Field(
        default=None, description="of the spring, in place of `stiffness`"
    )
    law: Maybe[CoordinateLaw] = Field(default=None, description="the effort that resists; may use `value` and `rate`")

    def problems(self) -> Iterator[Problem]:
        yield from problems_of_spring(self, "free_value")
