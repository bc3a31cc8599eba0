"""A motor on a joint coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import PositiveEffort, PositiveGain
from nivel.machine.forces.element import OUTPUTS, ForceElement
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.coordinate_function import CoordinateEffortFunction, CoordinateSpeed
from nivel.machine.uses.coordinate_reference import CoordinateReference


class Motor(ForceElement):
    """An effort on a joint coordinate, given or that of a controller that holds a speed; at most `limit`.

    It acts on the second body in the sense of the coordinate, and the counter-effort on the first.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "value", "rate")

    type: Literal["motor"] = "motor"
    coordinate: CoordinateReference
    effort: Maybe[CoordinateEffortFunction] = Field(default=None, description="force or torque")
    speed: Maybe[CoordinateSpeed] = Field(default=None, description="held with the effort gain · (speed - rate)")
    gain: Maybe[PositiveGain] = Field(default=None, description="effort per missing speed")
    limit: Maybe[PositiveEffort] = Field(default=None, description="greatest magnitude of the effort")

    def problems(self) -> Iterator[Problem]:
        if self.effort is None and self.speed is None:
            yield Problem((), "a motor needs an `effort`, or a `speed` and a `gain`")
        if self.effort is not None and self.speed is not None:
            yield superfluous("speed", "stands in place of `effort`; give one of them")
        if self.speed is not None and self.gain is None:
            yield Problem((), "`gain` is missing: effort per missing speed")
        if self.speed is None and self.gain is not None:
            yield superfluous("gain", "belongs to a `speed`, and none is given")
