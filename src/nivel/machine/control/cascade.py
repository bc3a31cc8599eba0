"""Position controllers in cascade, as of electric drives: position P, then speed PI."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from nivel.machine.control.algebra import refuse_order
from nivel.machine.control.block import Block, Input, Number, Pair, PositiveNumber
from nivel.machine.control.laws import limited
from nivel.machine.control.part import Part
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.units.linear_function import linear
from nivel.machine.units.quantity import Duration


class Cascade(Block):
    """Wished speed w = position_gain (r - y) + speed_reference, within the speed limit; then a PI controller of the speed.

    value = speed_gain (w - ẏ + ∫(w - ẏ)/T) + feedforward, within the limits, at which the integral is led back with the time T.
    """

    quantities = ("value", "error", "wished_speed", "speed_error", "integral")

    type: Literal["cascade"] = "cascade"
    reference: Maybe[Input] = Field(default=None, description="commanded position r")
    measured: Maybe[Input] = Field(default=None, description="position y")
    measured_speed: Input = Field(description="its rate ẏ")
    speed_reference: Input = Field(
        default=0.0, description="commanded speed, or with a `reference` its rate, fed forward"
    )
    position_gain: Maybe[PositiveNumber] = Field(default=None, description="speed per position error, 1/s")
    speed_gain: PositiveNumber = Field(description="value per speed error")
    integral_time: Maybe[Duration] = Field(default=None, description="T; without it there is no integral")
    speed_limit: Maybe[PositiveNumber] = Field(default=None, description="greatest magnitude of the commanded speed")
    feedforward: Maybe[Input] = Field(default=None, description="what is added before the limits, such as a weight")
    limits: Maybe[Pair] = Field(default=None, description="lower and upper limit of the value")
    start: Number = Field(default=0.0, description="value of the integral at the start")

    def computation(self) -> tuple[Part, ...]:
        parts, terms = [*self._outer()], [(self.speed_gain, self.path("speed_error"))]
        if self.feedforward is not None:
            parts.append(self.present("feedforward", self.feedforward, key="feedforward"))
            terms.append((1.0, self.path("feedforward")))
        if self.integral_time is not None:
            terms.append((1.0, self.path("integral")))
        if self.limits is None:
            parts.append(self.present(self.output, linear(*terms)))
        else:
            parts.append(self.present("unlimited", linear(*terms)))
            parts.append(self.present(self.output, limited(self.path("unlimited"), self.limits)))
        if self.integral_time is not None:
            parts.append(self._integral(max(self.integral_time, self.period)))
        return tuple(parts)

    def _outer(self) -> Iterator[Part]:
        """Position error, commanded speed within its limit, speed error."""
        yield self.present("speed", self.measured_speed, key="measured_speed")
        yield self.present("speed_reference", self.speed_reference, key="speed_reference")
        terms = [(1.0, self.path("speed_reference"))]
        if self.reference is not None and self.measured is not None:
            yield self.present("reference", self.reference, key="reference")
            yield self.present("measured", self.measured, key="measured")
            yield self.present("error", linear((1.0, self.path("reference")), (-1.0, self.path("measured"))))
            terms.append((self.position_gain or 0.0, self.path("error")))
        if self.speed_limit is None:
            yield self.present("wished_speed", linear(*terms))
        else:
            yield self.present("unlimited_speed", linear(*terms))
            limits = (-self.speed_limit, self.speed_limit)
            yield self.present("wished_speed", limited(self.path("unlimited_speed"), limits))
        yield self.present("speed_error", linear((1.0, self.path("wished_speed")), (-1.0, self.path("speed"))))

    def _integral(self, time: float) -> Part:
        integral = self.path("integral")
        terms = [(self.speed_gain / time, self.path("speed_error"))]
        if self.limits is not None:
            terms += [(1.0 / time, self.path(self.output)), (-1.0 / time, self.path("unlimited"))]
        after = linear((1.0, integral), *((self.period * factor, path) for factor, path in terms))
        return self.remembered("integral", linear(*terms), after, self.start)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        outer = ("reference", "measured", "position_gain")
        given = [key for key in outer if getattr(self, key) is not None]
        if given and len(given) < len(outer):
            missing = ", ".join(f"`{key}`" for key in outer if key not in given)
            yield Problem((), f"of a position controller {missing} is missing; leave all three out for one of speed")
        if not given and not self.speed_reference:
            yield superfluous(
                "speed_gain",
                "has nothing to follow: give `reference`, `measured` and `position_gain`, or `speed_reference`",
            )
        if self.limits is not None:
            yield from refuse_order(self.limits)
