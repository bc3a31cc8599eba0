"""Parameters of a study: the values of a number of the machine, its range, or its distribution."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, GetCoreSchemaHandler
from pydantic_core import CoreSchema

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.given import Field
from nivel.machine.settings.values import Count
from nivel.machine.study.any_quantity import AnyQuantity, si, unlike
from nivel.machine.units.quantity import fault, listed
from nivel.words.wording import shown

INFINITE: Final = float("inf")
OF_FILE: Final = "the value in the machine file"


class Values(Checked):
    """Values one by one: numbers, texts with units, words, or a column of a table."""

    type: Literal["values"] = "values"
    values: Annotated[tuple[Any, ...], BeforeValidator(listed)] = Field(default=(), description="the values")
    csv: str = Field(default="", description="table (CSV, MAT, Parquet) with the values, beside the study file")
    column: str = Field(default="", description="column of this table")
    units: str = Field(default="", description="unit of the column", absent="that of its heading, else SI")

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
        return False

    def with_nominal(self, value: float) -> Self:
        """The same with the value [SI] in the machine file, where it is needed."""
        return self


class Range(Between):
    """Evenly spaced values from one to another; any value between them where variants are drawn."""

    type: Literal["range"]
    low: AnyQuantity = Field(key="from", description="first value")
    high: AnyQuantity = Field(key="to", description="last value")
    count: Count | None = Field(default=None, description="number of values, both ends included")
    spacing: Literal["linear", "logarithmic"] = Field(
        default="linear", description="equal differences, or equal ratios"
    )

    def problems(self) -> Iterator[Problem]:
        """As of all bounds, and ratios of numbers that are not positive."""
        yield from super().problems()
        if self.spacing == "logarithmic" and not si(self.low) > 0.0:
            message = f"with `spacing: logarithmic` a value above zero was expected, got {shown(self.low)}"
            yield Problem(("from",), message)


class Uniform(Between):
    """Every value between two bounds with the same probability."""

    type: Literal["uniform"]
    low: AnyQuantity = Field(key="from", description="least value")
    high: AnyQuantity = Field(key="to", description="greatest value")


class Triangular(Between):
    """A density that rises from zero at one bound to a peak, and falls to zero at the other."""

    quantities: ClassVar[tuple[str, ...]] = ("low", "peak", "high")
    type: Literal["triangular"]
    low: AnyQuantity = Field(key="from", description="least value")
    high: AnyQuantity = Field(key="to", description="greatest value")
    peak: AnyQuantity | None = Field(default=None, description="most probable value", absent="halfway")

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
    type: Literal["normal"]
    mean: AnyQuantity | None = Field(default=None, description="mean", absent=OF_FILE)
    deviation: AnyQuantity = Field(description="standard deviation")
    low: AnyQuantity | None = Field(default=None, key="from", description="least value", absent="none")
    high: AnyQuantity | None = Field(default=None, key="to", description="greatest value", absent="none")

    def problems(self) -> Iterator[Problem]:
        """As of all bounds, and a deviation that is none."""
        yield from super().problems()
        if not si(self.deviation) > 0.0:
            yield Problem(("deviation",), f"a deviation above zero was expected, got {shown(self.deviation)}")

    @property
    def needs_nominal(self) -> bool:
        return self.mean is None

    def with_nominal(self, value: float) -> Self:
        return self.replace(mean=value) if self.needs_nominal else self


def _one_or_two(value: Any) -> Any:
    value = listed(value)
    if isinstance(value, list | tuple) and len(value) != 2:
        raise fault(f"one quantity, or two, below and above, were expected; got {len(value)}: write `[0.1 mm, 0.2 mm]`")
    return value


class Tolerance(Between):
    """A nominal value with its tolerance: ± one number, or [below, above]."""

    quantities: ClassVar[tuple[str, ...]] = ("nominal", "below", "above")
    type: Literal["tolerance"]
    nominal: AnyQuantity | None = Field(default=None, description="nominal value", absent=OF_FILE)
    tolerance: Annotated[tuple[AnyQuantity, AnyQuantity] | AnyQuantity, BeforeValidator(_one_or_two)] = Field(
        description="greatest deviation from it, or [below, above]"
    )
    distribution: Literal["normal", "uniform", "triangular"] = Field(
        default="normal",
        description="distribution in the tolerance; normal: three standard deviations, cut off at the tolerance",
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
    def needs_nominal(self) -> bool:
        return self.nominal is None

    def with_nominal(self, value: float) -> Self:
        return self.replace(nominal=value) if self.needs_nominal else self

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


class _AnyParameter:
    """A record of one of PARAMETERS, told apart by its `type`."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        kinds: Any = reduce(or_, PARAMETERS)
        return handler.generate_schema(Annotated[kinds, Field(discriminator="type"), BeforeValidator(_with_type)])


if TYPE_CHECKING:
    StudyParameter = Values | Range | Uniform | Normal | Triangular | Tolerance
else:
    StudyParameter = _AnyParameter
