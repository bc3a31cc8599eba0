"""A torsional spring and damper between two markers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import TorqueValue, TorsionalDamping, TorsionalStiffness
from nivel.machine.forces.between import BetweenMarkers
from nivel.machine.forces.characteristic import TorqueTable
from nivel.machine.forces.element import OUTPUTS
from nivel.machine.forces.spring import problems_of_spring
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.time_function import SpringTorque
from nivel.machine.units.quantity import Angle


class TorsionalSpringDamper(BetweenMarkers):
    """Torque stiffness · (angle - free_angle) + damping · rate + preload, in N m, that resists the angle.

    The angle is that of the second marker about the z axis of the first. A `table` stands in place of the stiffness, a
    `law` in place of all of it.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "angle", "rate")

    turns: ClassVar[bool] = True

    type: Literal["torsional-spring-damper"] = "torsional-spring-damper"
    stiffness: Maybe[TorsionalStiffness] = Field(default=None)
    damping: TorsionalDamping = Field(default=0.0)
    free_angle: Angle = Field(default=0.0, description="at which the spring has no torque")
    preload: TorqueValue = Field(default=0.0, description="added to the torque that resists")
    table: Maybe[OneRecord[TorqueTable]] = Field(default=None, description="of the spring, in place of `stiffness`")
    law: Maybe[SpringTorque] = Field(default=None, description="the torque that resists; may use `angle` and `rate`")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problems_of_spring(self, "free_angle")
