"""Blocks that remember: delays, averages, rates, hysteresis, values that are held."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import ClassVar, Literal

from nivel.elements.control.blocks import OfInput
from nivel.elements.kind import Kind
from nivel.machine.control.block import MOST_DELAYED, Condition, Number, Pair, PositiveNumber
from nivel.machine.control.part import VALUE, Part
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, Maybe
from nivel.machine.units.formula import formula, linear
from nivel.machine.units.quantity import Duration


class Delay(OfInput):
    """The input of some time ago, the dead time of a line or of a computer."""

    delays: ClassVar[bool] = True

    type: Literal["delay"] = "delay"
    time: Duration = Field("dead time, also between samples")
    start: Number = Field("value until the first sample comes out", default=0.0)

    def computation(self) -> tuple[Part, ...]:
        return self.taken, *self.late(VALUE, "input", self.time + self.latency, self.start, "waiting")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: a delay holds samples; for a smooth lag take a low-pass")
            return
        count = (self.time + self.latency) / self.sample_time
        if count > MOST_DELAYED:
            message = f"{count:.4g} samples would wait; up to {MOST_DELAYED} are taken: take a longer `sample_time`"
            yield Problem(("time",), message)


class MovingAverage(OfInput):
    """The mean of the last samples of the input."""

    type: Literal["moving-average"] = "moving-average"
    samples: int = Field("how many", ge=2, le=MOST_DELAYED)
    start: Number = Field("what stands for samples before the start", default=0.0)

    def computation(self) -> tuple[Part, ...]:
        names = [f"waiting_{k + 1}" for k in range(self.samples - 1)]
        paths = [self.input_path, *map(self.path, names)]
        waiting = [
            Part(name, "memory", linear((1.0, before)), self.start) for before, name in zip(paths, names, strict=False)
        ]
        mean = linear(*((1.0 / self.samples, path) for path in paths))
        return self.taken, *waiting, self.present(self.output, mean, start=self.start)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: a moving average is one of samples; else take a low-pass")


class RateLimit(OfInput):
    """The input, followed no faster than a rate."""

    type: Literal["rate-limit"] = "rate-limit"
    rate: Maybe[PositiveNumber] = Field("greatest change per second, up and down", default=None)
    rates: Maybe[Pair] = Field("in place of `rate`: fastest fall (negative) and fastest rise", default=None)
    time_constant: Maybe[Duration] = Field("of a continuous one, with which it follows slow inputs", default=None)
    start: Maybe[Number] = Field("value before the first sample; default the input then", default=None)

    def computation(self) -> tuple[Part, ...]:
        fall, rise = self.rates or (-(self.rate or 0.0), self.rate or 0.0)
        own = self.path(self.output)
        if self.is_sampled:
            steps = {"fall": fall * self.period, "rise": rise * self.period}
            text = "before + min(max(target - before, fall), rise)"
            change = formula(text, before=self.path("before"), target=self.input_path, **steps)
            return (
                self.taken,
                *self._began(Part("before", "memory", linear((1.0, own)))),
                self.present(self.output, change),
            )
        text = "min(max((target - value)/time_constant, fall), rise)"
        names = {"value": own, "target": self.input_path}
        rate = formula(text, **names, time_constant=self.time_constant or 1.0, fall=fall, rise=rise)
        return self.taken, *self._began(Part(self.output, "state", rate))

    def _began(self, part: Part) -> tuple[Part]:
        """The part with its start, or with the input at the beginning."""
        begins = linear((1.0, self.input_path)) if self.start is None else None
        return (replace(part, start=self.start or 0.0, begins=begins),)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if (self.rate is None) == (self.rates is None):
            yield Problem((), "a rate limit needs `rate`, or `rates` for fall and rise")
        if self.rates is not None and not self.rates[0] < 0.0 < self.rates[1]:
            yield Problem(("rates",), "the fastest fall is negative and comes first, the fastest rise is positive")
        if self.sample_time is None and self.time_constant is None:
            yield Problem(
                (), "`sample_time` is missing, or for a continuous one the `time_constant` with which it follows"
            )


class Hysteresis(OfInput):
    """On from where the input is greater than `on` until it is less than `off`."""

    type: Literal["hysteresis"] = "hysteresis"
    on: Number = Field("input above which it switches on")
    off: Number = Field("input below which it switches off")
    values: Pair = Field("value when off, and when on", default=(0.0, 1.0))
    start: Literal["off", "on"] = Field("until the first sample says otherwise", default="off")

    def computation(self) -> tuple[Part, ...]:
        low, high = self.values
        began = 1.0 if self.start == "on" else 0.0
        text = "if(value > above, 1, if(value < below, 0, before))"
        is_on = formula(text, before=self.path("on"), value=self.input_path, above=self.on, below=self.off)
        value = linear((high - low, self.path("on")), offset=low)
        return (
            self.taken,
            Part("on", "sample", is_on, began, holds=True),
            self.present(self.output, value, start=low + began * (high - low)),
        )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.off > self.on or math.isclose(self.off, self.on):
            yield Problem(("off",), f"`off` is less than `on`; got {self.off:g} and {self.on:g}")
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: it looks at its input at samples")


class Hold(OfInput):
    """The input, and while a condition holds the value that it had before: a sensor that is dead, a valve that is stuck."""

    quantities = ("value", "input", "condition")

    type: Literal["hold"] = "hold"
    when: Condition = Field("comparison such as `time > 3 s`, or a value that is positive: an input, a state")

    def computation(self) -> tuple[Part, ...]:
        names = {name: self.path(name) for name in ("condition", "input")}
        kept = formula("if(condition, own, input)", own=self.path(self.output), **names)
        condition = self.present("condition", self.when, key="when")
        return self.taken, condition, Part(self.output, "sample", kept)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: it keeps a sample of its input, such as `sample_time: 1 ms`")


KINDS = tuple(map(Kind, (Delay, MovingAverage, RateLimit, Hysteresis, Hold)))
