"""Outputs of a study: a number of each variant, and the limits between which it should be."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, get_args

from pydantic import BeforeValidator, GetCoreSchemaHandler
from pydantic_core import CoreSchema

from nivel.errors import Fault, ModelError
from nivel.machine.core.checked import Checked, Problem
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.study.any_quantity import AnyQuantity, si, unlike
from nivel.machine.units.quantity import Quantity, fault, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.words.wording import shown, unknown_word

Moment = Annotated[OneNumber, Quantity("time")]
NAME = "name of a result, such as hinge.angle"
Reduction = Literal["max", "min", "peak", "rms", "mean", "integral"]
# numbers of an analysis that have no history: of a linear model, its sampled loops, and statics
SCALAR: Final = re.compile(
    r"mode\.\d+\.(frequency|damping_ratio|real|imaginary)|stable|largest_real_part|buckling\.\d+"
    r"|loop\..+\.(gain|phase|delay)_margin"
)
CALL: Final = re.compile(r"(\w+)\((.+)\)")


class StudyOutput(Checked):
    """A number of each variant. Limits are kept as they were written."""

    at_least: AnyQuantity | None = Field(default=None, description="least value within limits", absent="none")
    at_most: AnyQuantity | None = Field(default=None, description="greatest value within limits", absent="none")

    def problems(self) -> Iterator[Problem]:
        """Limits of different kinds, and limits between which there is nothing."""
        if self.at_least is None or self.at_most is None:
            return
        if other := unlike((self.at_least, self.at_most)):
            yield Problem(("at_most",), other[1])
        elif si(self.at_least) > si(self.at_most):
            message = f"a limit of at least {shown(self.at_least)} was expected, got {shown(self.at_most)}"
            yield Problem(("at_most",), message)

    @property
    def limits(self) -> tuple[float | None, float | None]:
        """Least and greatest value within limits, in SI units; None where there is none."""
        least, most = self.at_least, self.at_most
        return None if least is None else si(least), None if most is None else si(most)


class Reduced(StudyOutput):
    """One number of a history: largest, smallest, largest magnitude, root of the mean square, mean, or integral over time."""

    type: Reduction
    of: str = Field(description=NAME)
    start: Maybe[Moment] = Field(default=None, key="from", description="begin", absent="the begin of the result")
    end: Maybe[Moment] = Field(default=None, key="to", description="end", absent="the end of the result")

    def problems(self) -> Iterator[Problem]:
        """As of all outputs, and an end before the begin."""
        yield from super().problems()
        if self.start is not None and self.end is not None and not self.start < self.end:
            yield Problem(("to",), f"a time after {self.start:g} s was expected, got {self.end:g} s")


class FinalValue(StudyOutput):
    """The last value of a history."""

    type: Literal["final"]
    of: str = Field(description=NAME)


class AtTime(StudyOutput):
    """The value of a history at a time, between two frames by a cubic."""

    type: Literal["at-time"]
    of: str = Field(description=NAME)
    time: Moment = Field(description="the time")


class AtEvent(StudyOutput):
    """The value of a history where an event comes for the first time."""

    type: Literal["at-event"]
    of: str = Field(description=NAME)
    event: str = Field(description="name of an event")


class EventTime(StudyOutput):
    """The time at which an event comes for the first time."""

    type: Literal["event-time"]
    event: str = Field(description="name of an event")


class ScalarOutput(StudyOutput):
    """A number of an analysis that has no history: of a linear model, as `mode.1.frequency`, or of statics, as `buckling.1`."""

    type: Literal["value"]
    of: str = Field(description="name of a number, such as mode.1.frequency or stable")


class PythonOutput(StudyOutput):
    """What a Python function returns for a result, in SI units."""

    type: Literal["python"]
    python: str = Field(default="", description="file of the function, beside the study file")
    source: str = Field(default="", description="text of such a file, in place of `python`")
    file: str = Field(default="", description="name of the file that messages show")
    function: str = Field(description="its name; it takes the result and returns a number")
    units: str = Field(default="", description="unit of the number, for tables and plots")

    def problems(self) -> Iterator[Problem]:
        """As of all outputs, and no function."""
        yield from super().problems()
        if not self.source:
            yield Problem((), "the text of the function is missing: write `python: outputs.py`")


OUTPUTS: tuple[type[StudyOutput], ...] = (
    Reduced,
    FinalValue,
    AtTime,
    AtEvent,
    EventTime,
    ScalarOutput,
    PythonOutput,
)


def _from_words(given: Any) -> Any:
    if not isinstance(given, str):
        return given
    try:
        return said_output(given)
    except ModelError as error:
        raise fault("; ".join(each.message for each in error.faults)) from None


class _AnyOutput:
    """A record of one of OUTPUTS, told apart by its `type`, or in words (`said_output`)."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        kinds: Any = reduce(or_, OUTPUTS)
        return handler.generate_schema(Annotated[kinds, Field(discriminator="type"), BeforeValidator(_from_words)])


if TYPE_CHECKING:
    Output = Reduced | FinalValue | AtTime | AtEvent | EventTime | ScalarOutput | PythonOutput
else:
    Output = _AnyOutput


def said_output(words: str) -> Output:
    """An output in words: ``max(hinge.angle)`` and other reductions, ``hinge.angle at 0.5 s``, ``time(lift)`` of the first event of a
    name, a number such as ``mode.1.frequency``, or a name of a result alone, which is its last value. Raises ModelError for other words."""
    words = words.strip()
    if call := CALL.fullmatch(words):
        word, inner = call[1], call[2].strip()
        if word == "time":
            return EventTime(type="event-time", event=inner)
        if word not in get_args(Reduction):
            raise ModelError(Fault.at(words, unknown_word(word, [*get_args(Reduction), "time"], "reduction")))
        return Reduced(type=word, of=inner)  # type: ignore[arg-type]
    if SCALAR.fullmatch(words):
        return ScalarOutput(type="value", of=words)
    name, at, moment = words.rpartition(" at ")
    if not at:
        return FinalValue(type="final", of=words)
    try:
        time = float(read_quantity(moment, "time", {}))
    except (ExpressionError, TypeError, ValueError) as problem:
        raise ModelError(Fault.at(words, f"a time was expected after `at`, as `0.5 s`: {problem}")) from None
    return AtTime(type="at-time", of=name.strip(), time=time)
