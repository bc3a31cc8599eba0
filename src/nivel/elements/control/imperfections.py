"""Imperfections of measuring and of sending: noise, quantisation, a bus with a cycle, jitter and lost messages."""

import math
from collections.abc import Iterator, Mapping, Sequence
from random import Random
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.elements.control.blocks import OfInput, refuse_order
from nivel.elements.kind import Kind
from nivel.machine.control.block import WHOLE, Block, Input, NotNegativeTime, Number, Pair, PositiveNumber, names_in
from nivel.machine.control.part import VALUE, Part
from nivel.machine.core.record import Name, Problem, Record, entry
from nivel.machine.given import Field, Given, Maybe, OneNumber, TwoNumbers
from nivel.machine.laws.time_function import SomeFunction
from nivel.machine.units.formula import Formula, formula, linear, sum_of
from nivel.machine.units.quantity import Duration, Quantity, fault, listed, shown
from nivel.machine.units.tree import Call, Operation, Time
from nivel.machine.units.tree import Number as Constant

Frequencies = Annotated[TwoNumbers[Annotated[OneNumber, Quantity("frequency")]], BeforeValidator(listed)]

WAVES: Final = 64
MODULUS: Final = (
    2**31 - 1
)  # of the random numbers of a bus, with the factor 16807: Park & Miller, Comm. ACM 31 (1988), p. 1192
FACTOR: Final = 16807


class Noise(Block):
    """Noise with a constant spectral density within a band of frequencies and none outside; a seed makes it the same in every run.

    √(2/n) σ Σ sin(2π f_k t + φ_k) with random phases and a random frequency in each of n = 64 parts of the band (Shinozuka & Jan,
    J. Sound Vib. 25 (1972), p. 111): the mean square is σ², the distribution nearly that of Gauss. As a function of time it is smooth
    and does not depend on steps or methods.
    """

    type: Literal["noise"] = "noise"
    deviation: PositiveNumber = Field("standard deviation σ, the root of the mean square")
    band: Frequencies = Field("lowest and highest frequency")
    seed: Number = Field("whole number; another one gives other noise", default=1.0)

    def computation(self) -> tuple[Part, ...]:
        draw = Random(int(self.seed)).random
        low, high = self.band
        width, amplitude = (high - low) / WAVES, math.sqrt(2.0 / WAVES) * self.deviation
        waves = []
        for k in range(WAVES):
            omega, phase = 2.0 * math.pi * (low + (k + draw()) * width), 2.0 * math.pi * draw()
            angle = Operation("+", Operation("*", Constant(omega), Time()), Constant(phase))
            waves.append(Operation("*", Constant(amplitude), Call("sin", (angle,))))
        return (self.present(self.output, Formula(sum_of(waves))),)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        low, high = self.band
        if not 0.0 <= low < high:
            yield Problem(("band",), f"a band is from a frequency to a higher one, got {low:g} and {high:g} Hz")
        elif self.sample_time and high * self.sample_time > 0.5 * (1.0 + WHOLE):
            message = f"samples of every {self.sample_time:g} s have frequencies up to {0.5 / self.sample_time:g} Hz"
            yield Problem(("band",), f"{message}, got {high:g} Hz")
        if self.seed != int(self.seed):
            yield Problem(("seed",), f"a whole number was expected, got {self.seed:g}")


class Quantiser(OfInput):
    """The nearest multiple of a step, within limits: what a converter or an encoder of so many bits gives."""

    type: Literal["quantiser"] = "quantiser"
    step: PositiveNumber = Field("between two values")
    limits: Maybe[Pair] = Field("lowest and highest value", default=None)

    def computation(self) -> tuple[Part, ...]:
        text, numbers = "step*floor(value/step + 0.5)", {"step": self.step}
        if self.limits is not None:
            text, numbers = (
                f"min(max({text}, lower), upper)",
                {**numbers, "lower": self.limits[0], "upper": self.limits[1]},
            )
        return self.taken, self.present(self.output, formula(text, value=self.input_path, **numbers))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.limits is not None:
            yield from refuse_order(self.limits)
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: a converter gives samples, such as `sample_time: 1 ms`")


class BusSignal(Record):
    """A signal on a bus."""

    name: Name
    value: Input


def _given_signals(value: Any) -> Any:
    return [{"name": name, "value": each} for name, each in value.items()] if isinstance(value, Mapping) else value


def _named_signals(value: Any) -> Any:
    if isinstance(value, str) or (isinstance(value, Sequence) and any(isinstance(signal, str) for signal in value)):
        raise fault(f"signals with names were expected, as in `inputs: {{angle: hinge.angle}}`; got {shown(value)}")
    return _given_signals(value)


class Bus(Block):
    """Signals that are sent together once a cycle and arrive later: `NAME.SIGNAL`, of which the first is also `NAME.value`.

    Signals are read at multiples of the cycle, and arrive at the first sample that is not before `latency` + `jitter` u, with random u
    from 0 to 1. At the start all are there, as on a bus that has been running.
    """

    delays: ClassVar[bool] = True

    type: Literal["bus"] = "bus"
    inputs: Annotated[
        Given[tuple[BusSignal, ...], tuple[BusSignal, ...], Mapping[str, SomeFunction] | Sequence[BusSignal]],
        BeforeValidator(_named_signals),
    ] = Field("name → signal")
    cycle: Duration = Field("time between messages, a whole number of samples")
    jitter: NotNegativeTime = Field("largest random part of the time from sending to arrival", default=0.0)
    lost: Number = Field("share of the messages that never arrive, 0 to 1", default=0.0)
    seed: Number = Field("whole number from 1; another one gives other times", default=1.0)

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        return (VALUE, *names_in(_given_signals(entry(given, "inputs"))))

    @property
    def ticks(self) -> int:
        """Samples in a cycle."""
        return round(self.cycle / self.period)

    def computation(self) -> tuple[Part, ...]:
        # `tick` counts the samples of a cycle; at the start it is a whole cycle, with which everything passes
        n, tick, late, luck = self.ticks, self.path("tick"), self.path("late"), self.path("luck")
        numbers = {"factor": FACTOR, "modulus": MODULUS, "n": n, "tick": tick}
        drawn = "factor*before - modulus*floor(factor*before/modulus)"  # exact in doubles
        sends = f"if(tick < 0.5 or tick > n - 0.5, {drawn}, own)"
        counted = formula("if(tick > n - 0.5, 1, if(tick > n - 1.5, 0, tick + 1))", tick=tick, n=n)
        begun = float(1 + int(self.seed) % (MODULUS - 1))
        other = float(1 + FACTOR * int(begun) * int(begun) % (MODULUS - 1))
        parts = [
            Part("tick", "memory", counted, float(n), holds=True),
            Part("late", "sample", formula(sends, before=late, own=late, **numbers), begun, holds=True),
            Part("luck", "sample", formula(sends, before=luck, own=luck, **numbers), other, holds=True),
        ]
        for each in self.inputs:
            given, sent = (self.path(f"{each.name}_{word}") for word in ("given", "sent"))
            takes = formula("if(tick < 0.5 or tick > n - 0.5, given, own)", tick=tick, n=n, given=given, own=sent)
            come = "tick > n - 0.5 or tick + whole >= latency + jitter*late/modulus and luck >= lost*modulus"
            arrives = formula(
                f"if({come}, sent, own)",
                **{"tick": tick, "n": n, "late": late, "luck": luck, "sent": sent, "own": self.path(each.name)},
                **{"whole": WHOLE, "modulus": MODULUS, "lost": self.lost},
                **{"latency": self.latency / self.period, "jitter": self.jitter / self.period},
            )
            parts.append(self.present(f"{each.name}_given", each.value, key="inputs"))
            parts += [Part(f"{each.name}_sent", "sample", takes), Part(each.name, "sample", arrives)]
        first = linear((1.0, self.path(self.inputs[0].name)))
        return *parts, self.present(VALUE, first)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: messages are sent and arrive at samples")
            return
        if not self.inputs or VALUE in names_in(self.inputs):
            yield Problem(
                ("inputs",), "signals with names other than `value` were expected, such as `{speed: hinge.angle_rate}`"
            )
        if self.ticks < 1 or abs(self.ticks * self.sample_time - self.cycle) > WHOLE * self.cycle:
            yield Problem(("cycle",), f"{self.cycle:g} s is no whole number of samples of {self.sample_time:g} s")
        elif self.latency + self.jitter > self.cycle - self.sample_time * (1.0 - WHOLE):
            message = "messages arrive before the next is sent: `latency` and `jitter` together are a sample shorter than `cycle`"
            yield Problem(("jitter" if self.jitter else "latency",), message)
        if self.seed != int(self.seed) or self.seed < 1.0:
            yield Problem(("seed",), f"a whole number from 1 was expected, got {self.seed:g}")
        if not 0.0 <= self.lost <= 1.0:
            yield Problem(("lost",), f"a share from 0 to 1 was expected, got {self.lost:g}")


KINDS = tuple(map(Kind, (Noise, Quantiser, Bus)))
