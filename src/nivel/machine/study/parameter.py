"""Parameters of a study: the values of a number of the machine, its range, or its distribution."""

import re
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Final, Literal, Self, get_args

from pydantic import BeforeValidator

from nivel.errors import Fault, ModelError
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.settings.values import Count
from nivel.machine.study.any_quantity import AnyQuantity, si, unlike
from nivel.machine.units.quantity import Quantity, fault, listed, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.words.wording import shown, unknown_word

INFINITE: Final = float("inf")
OF_FILE: Final = "the value in the machine file"


class Values(Checked):
    """Values one by one: numbers, texts with units, words, or a column of a table."""

    type: Literal["values"] = "values"
    values: Annotated[tuple[Any, ...], BeforeValidator(listed)] = Field("the values", default=())
    csv: str = Field("table (CSV, MAT, Parquet) with the values, beside the study file", default="")
    column: str = Field("column of this table", default="")
    units: str = Field("unit of the column", default="", absent="that of its heading, else SI")

    def problems(self) -> Iterator[Problem]:
        """No values, or values of different kinds."""
        if not self.values:
            yield Problem((), "at least one value is needed: `values: [1 kg, 2 kg]`, or `csv: FILE`, with its `column`")
        elif other := unlike(each if _has_digits(each) else 0 for each in self.values):
            yield Problem(("values", other[0]), other[1])


def _has_digits(value: Any) -> bool:
    """Whether a value is a quantity rather than a word, which may be the name of a unit too."""
    return not isinstance(value, str) or any(each.isdigit() for each in value)


class Between(Checked):
    """A number between bounds. Quantities are kept as they were written, and all measure the same."""

    quantities: ClassVar[tuple[str, ...]] = ("low", "high")
    middle: ClassVar[str] = ""  # field whose value is that in the machine file where it is not given
    low: AnyQuantity | None = None
    high: AnyQuantity | None = None

    @property
    def given(self) -> Mapping[str, Any]:
        """The quantities that are given, by field."""
        return {name: value for name in self.quantities if (value := getattr(self, name)) is not None}

    def problems(self) -> Iterator[Problem]:
        """Quantities of different kinds, and bounds in the wrong order."""
        given, fields = self.given, type(self).model_fields
        keys = {name: fields[name].alias or name for name in given}
        if other := unlike(given.values()):
            yield Problem((keys[list(given)[other[0]]],), other[1])
        elif "low" in given and "high" in given and not si(given["low"]) < si(given["high"]):
            message = f"an upper bound above {shown(given['low'])} was expected, got {shown(given['high'])}"
            yield Problem((keys["high"],), message)

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value in SI units; infinite where there is none. Of a tolerance the nominal value has to be known."""
        return (-INFINITE if self.low is None else si(self.low), INFINITE if self.high is None else si(self.high))

    @property
    def needs_nominal(self) -> bool:
        """Whether the value in the machine file is needed."""
        return bool(self.middle) and getattr(self, self.middle) is None

    def with_nominal(self, value: float) -> Self:
        """The same with the value [SI] in the machine file, where it is needed."""
        return self.replace(**{self.middle: value}) if self.needs_nominal else self


class Range(Between):
    """Evenly spaced values from one to another; any value between them where variants are drawn."""

    type: Literal["range"]
    low: AnyQuantity = Field("first value", key="from")
    high: AnyQuantity = Field("last value", key="to")
    count: Count | None = Field("number of values, both ends included", default=None)
    spacing: Literal["linear", "logarithmic"] = Field("equal differences, or equal ratios", default="linear")

    def problems(self) -> Iterator[Problem]:
        """As of all bounds, and ratios of numbers that are not positive."""
        yield from super().problems()
        if self.spacing == "logarithmic" and not si(self.low) > 0.0:
            message = f"with `spacing: logarithmic` a value above zero was expected, got {shown(self.low)}"
            yield Problem(("from",), message)


class Uniform(Between):
    """Every value between two bounds with the same probability."""

    type: Literal["uniform"]
    low: AnyQuantity = Field("least value", key="from")
    high: AnyQuantity = Field("greatest value", key="to")


class Triangular(Between):
    """A density that rises from zero at one bound to a peak, and falls to zero at the other."""

    quantities: ClassVar[tuple[str, ...]] = ("low", "peak", "high")
    type: Literal["triangular"]
    low: AnyQuantity = Field("least value", key="from")
    high: AnyQuantity = Field("greatest value", key="to")
    peak: AnyQuantity | None = Field("most probable value", default=None, absent="halfway")

    def problems(self) -> Iterator[Problem]:
        """As of all bounds, and a peak outside of them."""
        found = list(super().problems())
        yield from found
        low, high = self.bounds
        if not found and self.peak is not None and not low <= si(self.peak) <= high:
            message = f"a value from {shown(self.low)} to {shown(self.high)} was expected, got {shown(self.peak)}"
            yield Problem(("peak",), message)


class Normal(Between):
    """Normal distribution, cut off at bounds if there are any."""

    quantities: ClassVar[tuple[str, ...]] = ("mean", "deviation", "low", "high")
    middle: ClassVar[str] = "mean"
    type: Literal["normal"]
    mean: AnyQuantity | None = Field("mean", default=None, absent=OF_FILE)
    deviation: AnyQuantity = Field("standard deviation")
    low: AnyQuantity | None = Field("least value", default=None, key="from", absent="none")
    high: AnyQuantity | None = Field("greatest value", default=None, key="to", absent="none")

    def problems(self) -> Iterator[Problem]:
        """As of all bounds, and a deviation that is none."""
        yield from super().problems()
        if not si(self.deviation) > 0.0:
            yield Problem(("deviation",), f"a deviation above zero was expected, got {shown(self.deviation)}")


def _one_or_two(value: Any) -> Any:
    value = listed(value)
    if isinstance(value, list | tuple) and len(value) != 2:
        raise fault(f"one quantity, or two, below and above, were expected; got {len(value)}: write `[0.1 mm, 0.2 mm]`")
    return value


class Tolerance(Between):
    """A nominal value with its tolerance: ± one number, or [below, above]."""

    quantities: ClassVar[tuple[str, ...]] = ("nominal", "below", "above")
    middle: ClassVar[str] = "nominal"
    type: Literal["tolerance"]
    nominal: AnyQuantity | None = Field("nominal value", default=None, absent=OF_FILE)
    tolerance: Annotated[tuple[AnyQuantity, AnyQuantity] | AnyQuantity, BeforeValidator(_one_or_two)] = Field(
        "greatest deviation from it, or [below, above]"
    )
    distribution: Literal["normal", "uniform", "triangular"] = Field(
        "distribution in the tolerance; normal: three standard deviations, cut off at the tolerance", default="normal"
    )

    @property
    def below(self) -> Any:
        """Greatest deviation downwards, as written."""
        return self.tolerance[0] if isinstance(self.tolerance, tuple) else self.tolerance

    @property
    def above(self) -> Any:
        """Greatest deviation upwards, as written."""
        return self.tolerance[1] if isinstance(self.tolerance, tuple) else self.tolerance

    def problems(self) -> Iterator[Problem]:
        """Quantities of different kinds, and no tolerance at all."""
        if other := unlike(self.given.values()):
            yield Problem(("tolerance",), other[1])
        elif min(si(self.below), si(self.above)) < 0.0 or not si(self.below) + si(self.above) > 0.0:
            yield Problem(("tolerance",), f"a deviation above zero was expected, got {shown(self.tolerance)}")

    @property
    def bounds(self) -> tuple[float, float]:
        if self.nominal is None:
            return -INFINITE, INFINITE
        return si(self.nominal) - si(self.below), si(self.nominal) + si(self.above)

    @property
    def is_lost(self) -> bool:
        """Whether the tolerance is less than the last digit of the nominal value that a computer has."""
        low, high = self.bounds
        return self.nominal is not None and not low < high


PARAMETERS: Final[tuple[type[Checked], ...]] = (Values, Range, Uniform, Normal, Triangular, Tolerance)
TYPES: Final = tuple(each.model_fields["type"].annotation.__args__[0] for each in PARAMETERS)  # type: ignore[union-attr]


def _with_type(value: Any) -> Any:
    """A list is one of values; without a type, `values` or `csv` say it."""
    value = listed(value)
    if isinstance(value, list | tuple):
        return {"type": "values", "values": value}
    if isinstance(value, Mapping) and "type" not in value and {"values", "csv"} & value.keys():
        return {"type": "values", **value}
    if not isinstance(value, Mapping | Checked):
        raise fault(f"a list of values or a mapping was expected, got {shown(value)}: write `[1 kg, 2 kg]`")
    return value


StudyParameter = Annotated[
    Values | Range | Uniform | Normal | Triangular | Tolerance, Field(discriminator="type"), BeforeValidator(_with_type)
]


# Outputs of a study: a number of each variant, and the limits between which it should be.

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

    at_least: AnyQuantity | None = Field("least value within limits", default=None, absent="none")
    at_most: AnyQuantity | None = Field("greatest value within limits", default=None, absent="none")

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
    of: str = Field(NAME)
    start: Maybe[Moment] = Field("begin", default=None, key="from", absent="the begin of the result")
    end: Maybe[Moment] = Field("end", default=None, key="to", absent="the end of the result")

    def problems(self) -> Iterator[Problem]:
        """As of all outputs, and an end before the begin."""
        yield from super().problems()
        if self.start is not None and self.end is not None and not self.start < self.end:
            yield Problem(("to",), f"a time after {self.start:g} s was expected, got {self.end:g} s")


class FinalValue(StudyOutput):
    """The last value of a history."""

    type: Literal["final"]
    of: str = Field(NAME)


class AtTime(StudyOutput):
    """The value of a history at a time, between two frames by a cubic."""

    type: Literal["at-time"]
    of: str = Field(NAME)
    time: Moment = Field("the time")


class AtEvent(StudyOutput):
    """The value of a history where an event comes for the first time."""

    type: Literal["at-event"]
    of: str = Field(NAME)
    event: str = Field("name of an event")


class EventTime(StudyOutput):
    """The time at which an event comes for the first time."""

    type: Literal["event-time"]
    event: str = Field("name of an event")


class ScalarOutput(StudyOutput):
    """A number of an analysis that has no history: of a linear model, as `mode.1.frequency`, or of statics, as `buckling.1`."""

    type: Literal["value"]
    of: str = Field("name of a number, such as mode.1.frequency or stable")


class PythonOutput(StudyOutput):
    """What a Python function returns for a result, in SI units."""

    type: Literal["python"]
    python: str = Field("file of the function, beside the study file", default="")
    source: str = Field("text of such a file, in place of `python`", default="")
    file: str = Field("name of the file that messages show", default="")
    function: str = Field("its name; it takes the result and returns a number")
    units: str = Field("unit of the number, for tables and plots", default="")

    def problems(self) -> Iterator[Problem]:
        """As of all outputs, and no function."""
        yield from super().problems()
        if not self.source:
            yield Problem((), "the text of the function is missing: write `python: outputs.py`")


OUTPUTS: tuple[type[StudyOutput], ...] = (Reduced, FinalValue, AtTime, AtEvent, EventTime, ScalarOutput, PythonOutput)


def _from_words(given: Any) -> Any:
    if not isinstance(given, str):
        return given
    try:
        return said_output(given)
    except ModelError as error:
        raise fault("; ".join(each.message for each in error.faults)) from None


Output = Annotated[
    Reduced | FinalValue | AtTime | AtEvent | EventTime | ScalarOutput | PythonOutput,
    Field(discriminator="type"),
    BeforeValidator(_from_words),
]


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
