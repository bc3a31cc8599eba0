"""A position servo on a joint coordinate."""

from __future__ import annotations

from typing import ClassVar, Literal

from nivel.machine.core.coefficient import CoordinateDamping, CoordinateIntegral, CoordinateStiffness, PositiveEffort
from nivel.machine.forces.element import OUTPUTS, ForceElement
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.coordinate_function import CoordinatePosition
from nivel.machine.uses.coordinate_reference import CoordinateReference


class Servo(ForceElement):
    """Effort stiffness · error + damping · d(error)/dt + integral · ∫ error dt, at most `limit`, with error = target - coordinate.

    The rate of the target is known where it is a smooth function of time; else it counts as zero, and `damping` resists all motion.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "value", "rate", "error")

    type: Literal["servo"] = "servo"
    coordinate: CoordinateReference
    target: CoordinatePosition = Field(description="length or angle that the coordinate shall have")
    stiffness: CoordinateStiffness = Field(description="effort per error (proportional gain)")
    damping: CoordinateDamping = Field(default=0.0, description="effort per rate of the error (derivative gain)")
    integral: CoordinateIntegral = Field(default=0.0, description="effort per error and second (integral gain)")
    limit: Maybe[PositiveEffort] = Field(default=None, description="greatest magnitude of the effort")
