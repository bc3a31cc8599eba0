"""Controllers: PID, with filter, feed-forward and anti-windup, and cascades of loops."""

import math
from collections.abc import Iterator
from typing import Literal

from nivel.elements.control.blocks import refuse_order
from nivel.elements.kind import Kind
from nivel.machine.control.block import Block, Input, NotNegativeTime, Number, Pair, PositiveNumber
from nivel.machine.control.part import Part, limited
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import Duration


class Pid(Block):
    """kp (β r - y) + ki ∫(r - y) + kd of the filtered -ẏ + feedforward, cut off at the limits; the integral does not wind up there.

    Given the `input` r - y alone, all three act on it. At a limit the integral is led back with the tracking time (Åström & Hägglund,
    Advanced PID Control, 2006, §3.5; sampled: §13.3 with the integral by forward and the derivative by backward differences).
    """

    quantities = ("value", "error", "integral", "unlimited")

    type: Literal["pid"] = "pid"
    input: Maybe[Input] = Field("the error, set-point less measured value", default=None)
    reference: Maybe[Input] = Field("the set-point r, in place of `input`; with `measured`", default=None)
    measured: Maybe[Input] = Field("the measured value y, in place of `input`", default=None)
    kp: Number = Field("proportional gain", default=0.0)
    ki: Number = Field("integral gain, per second", default=0.0)
    kd: Number = Field("derivative gain, seconds", default=0.0)
    limits: Maybe[Pair] = Field("lower and upper limit of the value", default=None)
    feedforward: Maybe[Input] = Field("what is added before the limits", default=None)
    set_point_weight: Number = Field("β, the share of the set-point in the proportional part", default=1.0)
    filter_time: Maybe[NotNegativeTime] = Field(
        "time constant of the derivative's filter; default a tenth of kd/kp", default=None
    )
    tracking_time: Maybe[Duration] = Field(
        "with which the integral is led back at a limit; default √(kp/ki · kd/kp), or kp/ki", default=None
    )
    start: Number = Field("value of the integral at the start", default=0.0)

    @property
    def filter(self) -> float:
        """Time constant of the filter [s]."""
        return self.filter_time if self.filter_time is not None else 0.1 * abs(self.kd / self.kp)

    @property
    def tracking(self) -> float:
        """Tracking time [s], of sampled ones at least one period."""
        if self.tracking_time is not None:
            return self.tracking_time
        integral = abs(self.kp / self.ki)
        time = math.sqrt(integral * abs(self.kd / self.kp)) if self.kd else integral
        return max(time, self.period)

    def computation(self) -> tuple[Part, ...]:
        parts = [*self._taken()]
        y, minus = (self.path("measured"), 1.0) if self.input is None else (self.path("error"), -1.0)
        error, integral = self.path("error"), self.path("integral")
        weight = self.kp * self.set_point_weight
        terms = [(weight, self.path("reference")), (-self.kp, y)] if self.input is None else [(self.kp, error)]
        if self.kd:
            parts += self._derivative_parts(y, minus)
            terms.append((1.0, self.path("derivative")))
        if self.ki:
            terms.append((1.0, integral))
        if self.feedforward is not None:
            terms.append((1.0, self.path("feedforward")))
        if self.limits is None:
            parts.append(self.present(self.output, linear(*terms)))
        else:
            parts.append(self.present("unlimited", linear(*terms)))
            parts.append(self.present(self.output, limited(self.path("unlimited"), self.limits)))
        if self.ki:
            parts.append(self._integral_part(error, integral))
        return tuple(parts)

    def _taken(self) -> Iterator[Part]:
        if self.input is not None:
            yield self.present("error", self.input, key="input")
        else:
            assert self.reference is not None  # the record was checked
            assert self.measured is not None
            yield self.present("reference", self.reference, key="reference")
            yield self.present("measured", self.measured, key="measured")
            yield self.present("error", linear((1.0, self.path("reference")), (-1.0, self.path("measured"))))
        if self.feedforward is not None:
            yield self.present("feedforward", self.feedforward, key="feedforward")

    def _derivative_parts(self, y: str, minus: float) -> Iterator[Part]:
        """-kd s/(T_f s + 1) of y, or of minus y. Sampled: D_k = a D_{k-1} + (1 - a) K_d (y_{k-1} - y_k)/T, a = T_f/(T_f + T)."""
        before, own, gain = self.path("before"), self.path("derivative"), minus * self.kd
        if self.is_sampled:
            share = self.filter / (self.filter + self.period)
            slope = (1.0 - share) * gain / self.period
            yield self.present("derivative", linear((share, own), (slope, before), (-slope, y)))
            yield Part("before", "memory", linear((1.0, y)), begins=linear((1.0, y)))
        else:
            rate = linear((1.0 / self.filter, y), (-1.0 / self.filter, before))
            yield Part("before", "state", rate, begins=linear((1.0, y)))
            yield self.present("derivative", linear((gain / self.filter, before), (-gain / self.filter, y)))

    def _integral_part(self, error: str, integral: str) -> Part:
        back = []
        if self.limits is not None:
            back = [(1.0 / self.tracking, self.path(self.output)), (-1.0 / self.tracking, self.path("unlimited"))]
        rate = linear((self.ki, error), *back)
        after = linear((1.0, integral), *((self.period * factor, path) for factor, path in rate.terms))
        return self.remembered("integral", rate, after, self.start)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.input is None and (self.reference is None or self.measured is None):
            yield Problem((), "a controller needs its `input`, the error, or `reference` and `measured`")
        for key in ("reference", "measured"):
            if self.input is not None and getattr(self, key) is not None:
                yield superfluous(key, "stands in place of `input`; give one of them")
        if not (self.kp or self.ki or self.kd):
            yield Problem((), "all gains are zero; give `kp`, `ki` or `kd`")
        if self.kd and not self.kp and self.filter_time is None:
            yield Problem((), "`filter_time` is missing: time constant of the derivative's filter")
        if self.kd and not self.is_sampled and self.filter_time == 0.0:
            yield Problem(
                ("filter_time",), "a continuous derivative needs a filter; a time greater than zero was expected"
            )
        if self.limits is not None:
            yield from refuse_order(self.limits)
            if self.ki and not self.kp and self.tracking_time is None:
                yield Problem((), "`tracking_time` is missing: with which the integral is led back at a limit")


class Cascade(Block):
    """Wished speed w = position_gain (r - y) + speed_reference, within the speed limit; then a PI controller of the speed.

    value = speed_gain (w - ẏ + ∫(w - ẏ)/T) + feedforward, within the limits, at which the integral is led back with the time T.
    """

    quantities = ("value", "error", "wished_speed", "speed_error", "integral")

    type: Literal["cascade"] = "cascade"
    reference: Maybe[Input] = Field("commanded position r", default=None)
    measured: Maybe[Input] = Field("position y", default=None)
    measured_speed: Input = Field("its rate ẏ")
    speed_reference: Input = Field("commanded speed, or with a `reference` its rate, fed forward", default=0.0)
    position_gain: Maybe[PositiveNumber] = Field("speed per position error, 1/s", default=None)
    speed_gain: PositiveNumber = Field("value per speed error")
    integral_time: Maybe[Duration] = Field("T; without it there is no integral", default=None)
    speed_limit: Maybe[PositiveNumber] = Field("greatest magnitude of the commanded speed", default=None)
    feedforward: Maybe[Input] = Field("what is added before the limits, such as a weight", default=None)
    limits: Maybe[Pair] = Field("lower and upper limit of the value", default=None)
    start: Number = Field("value of the integral at the start", default=0.0)

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


KINDS = tuple(map(Kind, (Pid, Cascade)))
