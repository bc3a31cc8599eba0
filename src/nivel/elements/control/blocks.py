"""Blocks of signals: algebra, limits, tables, switches."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BeforeValidator

from nivel.elements.kind import Kind
from nivel.machine.control.block import Block, Condition, Input, Matrix, Number, Numbers, Pair
from nivel.machine.control.part import Part, beyond, limited
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import ManyFunctions
from nivel.machine.laws.varying_value import Interpolation, Table
from nivel.machine.units.formula import Formula, formula, linear, sum_of
from nivel.machine.units.quantity import listed
from nivel.machine.units.tree import Lookup as Curve
from nivel.machine.units.tree import Node, Operation, Signal


class SignalBlock(Block):
    """A function of time and symbols under a name: a set-point, a measured value, a law in Python."""

    type: Literal["signal"] = "signal"
    value: Input = Field("expression of `time` and symbols, table, or law in Python")

    def computation(self) -> tuple[Part, ...]:
        return (self.present(self.output, self.value, key="value"),)


class OfInput(Block):
    """A block with one input."""

    quantities = ("value", "input")

    input: Input = Field("expression of `time` and symbols")

    @property
    def taken(self) -> Part:
        """The input, or its sample."""
        return self.present("input", self.input, key="input")

    @property
    def input_path(self) -> str:
        return self.path("input")


class Gain(OfInput):
    """gain · input."""

    type: Literal["gain"] = "gain"
    gain: Number

    def computation(self) -> tuple[Part, ...]:
        return self.taken, self.present(self.output, linear((self.gain, self.input_path)))


class Sum(Block):
    """Σ factor · input."""

    type: Literal["sum"] = "sum"
    inputs: Annotated[ManyFunctions[Input], BeforeValidator(listed)] = Field("expressions of `time` and symbols")
    factors: Maybe[Numbers] = Field("one for each input; default 1", default=None)

    def computation(self) -> tuple[Part, ...]:
        names = [f"input_{k + 1}" for k in range(len(self.inputs))]
        factors = self.factors or (1.0,) * len(names)
        taken = [self.present(name, each, key="inputs") for name, each in zip(names, self.inputs, strict=True)]
        total = linear(*((factor, self.path(name)) for factor, name in zip(factors, names, strict=True)))
        return (*taken, self.present(self.output, total))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.inputs:
            yield Problem(("inputs",), "a sum needs at least one input")
        if self.factors is not None and len(self.factors) != len(self.inputs):
            message = f"there are {len(self.inputs)} inputs and {len(self.factors)} factors; each input has one"
            yield Problem(("factors",), message)


class Limit(OfInput):
    """The input, cut off at both limits."""

    type: Literal["limit"] = "limit"
    limits: Pair = Field("lower and upper limit")

    def computation(self) -> tuple[Part, ...]:
        return self.taken, self.present(self.output, limited(self.input_path, self.limits))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from refuse_order(self.limits)


class DeadZone(OfInput):
    """How far the input is outside of a band: zero within, its distance from the band outside."""

    type: Literal["dead-zone"] = "dead-zone"
    band: Pair = Field("lower and upper end")

    def computation(self) -> tuple[Part, ...]:
        return self.taken, self.present(self.output, beyond(self.input_path, self.band))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from refuse_order(self.band, "band")


class Switch(Block):
    """`then` while the condition holds, else `otherwise`."""

    type: Literal["switch"] = "switch"
    when: Condition = Field("comparison such as `boom.angle > 0.5`, or a value that is positive")
    then: Input = Field("expression of `time` and symbols")
    otherwise: Input = Field("expression of `time` and symbols")

    def computation(self) -> tuple[Part, ...]:
        parts = {"condition": self.when, "then": self.then, "otherwise": self.otherwise}
        keys = {"condition": "when"}
        taken = [self.present(name, each, key=keys.get(name, name)) for name, each in parts.items()]
        choice = formula("if(condition, then, otherwise)", **{name: self.path(name) for name in parts})
        return (*taken, self.present(self.output, choice))


class Lookup(OfInput):
    """A table over the input; beyond its ends the end values hold."""

    type: Literal["lookup"] = "lookup"
    points: Numbers = Field("values of the input, increasing")
    values: Numbers = Field("what the table gives there")
    interpolation: Interpolation = Field("straight lines, or a natural cubic spline", default="linear")

    def computation(self) -> tuple[Part, ...]:
        table = Table(self.points, self.values, self.interpolation, self.input_path)
        return self.taken, self.present(self.output, table)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if len(self.points) != len(self.values) or len(self.points) < 2:
            counts = f"got {len(self.points)} and {len(self.values)}"
            yield Problem(("values",), f"a table needs as many values as points, two or more; {counts}")
        elif _falls(self.points):
            yield Problem(("points",), "points increase strictly")
        elif self.interpolation == "cubic" and len(self.points) < 3:
            yield Problem(("points",), "a cubic table needs three points or more")


class Map(Block):
    """Values over a grid of two or three inputs: straight lines, or tensor products of natural cubic splines, along each input.

    With w_i the curve through 1 at point i and 0 at the others, Σ_i Σ_j w_i(x) w_j(y) values[i][j]: both interpolations are linear in
    the values. Beyond its ends an input counts as at its end.
    """

    type: Literal["map"] = "map"
    inputs: Annotated[ManyFunctions[Input], BeforeValidator(listed)] = Field("two or three expressions")
    points: Matrix = Field("a list for each input, increasing")
    values: Matrix = Field(
        "a row for each point of the first input, a column for each of the last; of three inputs a row for each pair of "
        "points of the first two, among which the second counts faster"
    )
    interpolation: Literal["linear", "cubic"] = Field("straight lines, or natural cubic splines", default="linear")

    def computation(self) -> tuple[Part, ...]:
        names = [f"input_{k + 1}" for k in range(len(self.inputs))]
        taken = [self.present(name, each, key="inputs") for name, each in zip(names, self.inputs, strict=True)]
        *outer, last = [Signal(self.path(name)) for name in names]
        level = [self._curve(last, self.points[-1], row) for row in self.values]
        for argument, points in zip(reversed(outer), reversed(self.points[:-1]), strict=True):
            n = len(points)
            weights = [self._curve(argument, points, [float(i == k) for k in range(n)]) for i in range(n)]
            level = [
                sum_of([Operation("*", *each) for each in zip(weights, level[k : k + n], strict=True)])
                for k in range(0, len(level), n)
            ]
        return *taken, self.present(self.output, Formula(level[0]))

    def _curve(self, argument: Signal, points: Sequence[float], values: Sequence[float]) -> Node:
        return Curve(argument, self.interpolation, tuple(points), tuple(values))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        count, fewest = len(self.inputs), 2 if self.interpolation == "linear" else 3
        if count not in (2, 3):
            yield Problem(("inputs",), f"a map has two or three inputs, got {count}; of one take a `lookup`")
        elif len(self.points) != count:
            yield Problem(("points",), f"a list for each of the {count} inputs was expected, got {len(self.points)}")
        elif wrong := [each for each in self.points if len(each) < fewest or _falls(each)]:
            yield Problem(("points",), f"{fewest} or more points that increase were expected, got {list(wrong[0])}")
        else:
            *outer, columns = map(len, self.points)
            if len(self.values) != math.prod(outer) or {len(row) for row in self.values} != {columns}:
                yield Problem(("values",), f"{math.prod(outer)} rows of {columns} values were expected")


def _falls(points: Sequence[float]) -> bool:
    return any(after <= before for before, after in pairwise(points))


def refuse_order(limits: tuple[float, float], key: str = "limits") -> Iterator[Problem]:
    """Limits of which the first is not the lower one."""
    lower, upper = limits
    if not lower < upper:
        yield Problem(
            (key,), f"the lower limit comes first and is less than the upper one; got {lower:g} and {upper:g}"
        )


KINDS = tuple(map(Kind, (SignalBlock, Gain, Sum, Limit, DeadZone, Switch, Lookup, Map)))
