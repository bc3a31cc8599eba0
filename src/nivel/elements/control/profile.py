"""Set-points that go from place to place: with a limited speed and acceleration, or smooth by times."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BeforeValidator

from nivel.elements.kind import Kind
from nivel.machine.control.block import Block, Number, Numbers, PositiveNumber
from nivel.machine.control.part import Part, PartFunction
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, ManyNumbers, OneNumber
from nivel.machine.laws.varying_value import Table, expression_of
from nivel.machine.units.formula import Formula, formula, sum_of
from nivel.machine.units.quantity import Quantity, listed
from nivel.machine.units.tree import Call, Time
from nivel.machine.units.tree import Number as Constant

Times = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("time")]], BeforeValidator(listed)]

# A top speed held for less than this share of speeding up is not held at all.
ROUND_OFF = 1e-9


class Trapezoid(Block):
    """From one value to another with a limited speed and acceleration; `NAME.rate` is its speed."""

    quantities = ("value", "rate")

    type: Literal["trapezoid"] = "trapezoid"
    first: Number = Field("value before", default=0.0)
    last: Number = Field("value after")
    begin: Annotated[OneNumber, Quantity("time")] = Field("time at which it starts to move", default=0.0)
    speed: PositiveNumber = Field("greatest speed, per second")
    acceleration: PositiveNumber = Field("of speeding up and slowing down, per second squared")

    @property
    def _times(self) -> tuple[float, float, float]:
        """Top speed, towards the last value; time to reach it; from the begin to when slowing down begins."""
        way = self.last - self.first
        top = min(self.speed, math.sqrt(abs(way) * self.acceleration))
        return math.copysign(top, way), top / self.acceleration, abs(way) / top

    def computation(self) -> tuple[Part, ...]:
        if self.first == self.last:
            return self.present(self.output, self.first, start=self.first), self.present("rate", 0.0)
        return self.present(self.output, self._place(), start=self.first), self.present("rate", self._rate())

    def _place(self) -> Formula:
        """Parabolas where it speeds up and slows down, a straight line between them."""
        top, rise, whole = self._times
        end = "if(end - time < rise, last - half*(end - time)^2, first + top*(time - begin - rise/2))"
        return formula(
            f"if(time <= begin, first, if(time >= end, last, if(time - begin < rise, first + half*(time - begin)^2, {end})))",
            **{"first": self.first, "last": self.last, "begin": self.begin, "end": self.begin + whole + rise},
            **{"top": top, "rise": rise, "half": 0.5 * math.copysign(self.acceleration, top)},
        )

    def _rate(self) -> Table:
        """Straight lines up to the top speed and down again."""
        top, rise, whole = self._times
        level = {whole: top} if whole > rise * (1.0 + ROUND_OFF) else {}
        corners = {0.0: 0.0, rise: top, **level, whole + rise: 0.0}
        return Table(tuple(self.begin + each for each in corners), tuple(corners.values()))


class Waypoints(Block):
    """Rests at each value, and goes between two times from one to the next: smooth to the second derivative (quintic)."""

    quantities = ("value", "rate")

    type: Literal["waypoints"] = "waypoints"
    times: Times = Field(
        "arrival at the first value, departure, arrival at the second, departure, …; or one time for each value"
    )
    values: Numbers

    @property
    def moves(self) -> list[tuple[float, float, float]]:
        """(begin, end, change) of each move."""
        changes = [after - before for before, after in pairwise(self.values)]
        each = len(self.times) == len(self.values)
        spans = pairwise(self.times) if each else zip(self.times[::2], self.times[1::2], strict=True)
        return [(*span, change) for span, change in zip(spans, changes, strict=True) if change]

    def computation(self) -> tuple[Part, ...]:
        value = self._over_moves("step", self.values[0])
        return self.present(self.output, value, start=self.values[0]), self.present(
            "rate", self._over_moves("step_rate")
        )

    def _over_moves(self, function: str, start: float = 0.0) -> PartFunction:
        """start + the sum over all moves of a function of time with the two ends of each."""
        if not self.moves:
            return start
        ends = ((begin, 0.0, end, change) for begin, end, change in self.moves)
        calls = [Call(function, (Time(), *map(Constant, each))) for each in ends]
        return expression_of(sum_of([Constant(start), *calls]))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        count = len(self.values)
        if count < 2:
            yield Problem(("values",), f"two values or more were expected, got {count}")
        elif len(self.times) not in (count, 2 * (count - 1)):
            message = (
                f"{count} values go with {count} times, one for each, or with {2 * (count - 1)}: departure and arrival of each move; "
                f"got {len(self.times)}"
            )
            yield Problem(("times",), message)
        elif any(after < before for before, after in pairwise(self.times)) or any(
            begin == end for begin, end, _ in self.moves
        ):
            yield Problem(("times",), "times increase")


KINDS = tuple(map(Kind, (Trapezoid, Waypoints)))
