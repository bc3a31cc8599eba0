"""Values of settings of analyses: numbers between bounds, times from zero on, coordinates, lists of names."""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, TypeVar, get_args

from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler, WrapValidator
from pydantic_core import CoreSchema, core_schema

from nivel.errors import retold
from nivel.lazy import Struct, replace
from nivel.machine.core.record import Record
from nivel.machine.given import Given, OneNumber
from nivel.machine.units.quantity import Quantity, Whole, fault, shown
from nivel.methods import StaticCoordinates
from nivel.words.arguments import plain

Settings = TypeVar("Settings", bound=Record)


def settings_of(record: type[Settings], analysis: str, given: Mapping[str, Any]) -> Settings:
    """Settings of an analysis; None stands for what was not given. Raises ModelError with everything that is wrong."""
    with retold(lambda fault: replace(fault, path=f"{analysis}.{fault.path}")):
        return record(**{name: value for name, value in given.items() if value is not None})


class Between(Struct):
    """Annotation of a number, or a whole one, from `low` to `high`, as messages write these. Texts are read as numbers."""

    low: str
    high: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        kind, name = (int, "a whole number") if source is int else (float, "a number")

        def read(value: Any) -> float:
            try:
                number = kind(plain(value))
            except (TypeError, ValueError, OverflowError):
                number = None
            if number is None or not float(self.low) <= number <= float(self.high):
                raise fault(f"{name} from {self.low} to {self.high} was expected, got {shown(value)}")
            return number

        return core_schema.no_info_plain_validator_function(read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"type": "number", "minimum": float(self.low), "maximum": float(self.high)}


def _count(value: Any) -> Any:
    if isinstance(value, int) and value < 1:
        raise fault(f"a whole number of at least 1 was expected, got {shown(value)}")
    return value


def static_coordinates(coordinates: str) -> str:
    """Coordinates of a run for another analysis: `independent` are chosen anew."""
    return coordinates if coordinates in get_args(StaticCoordinates) else "auto"


def _not_negative(value: Any, read: Callable[[Any], float]) -> float:
    if (number := read(value)) < 0.0:
        raise fault(f"a time greater than zero was expected, got {shown(value)}")
    return number


def _static(value: Any) -> Any:
    known = get_args(StaticCoordinates)
    if value not in known:
        raise fault(f"'{value}' is not one of {', '.join(known)}")
    return value


def _listed(value: Any) -> Any:
    return [each.strip() for each in value.split(",")] if isinstance(value, str) else value


Time = Annotated[OneNumber, Quantity("time"), WrapValidator(_not_negative)]  # zero: the start alone
Modes = Annotated[Given[int, int, int | str], Between("0", "1000")]
Positions = Annotated[Given[int, int, int | str], Between("2", "10000000")]
# of an analysis that was given no number, at first
POSITIONS = 361
FEWEST_POSITIONS = f"{POSITIONS}, or as many more as show the motion between them"
OfStatics = Annotated[StaticCoordinates, BeforeValidator(_static)]
Way = Annotated[OneNumber, Quantity(("angle", "length"))]  # of a joint coordinate
Count = Annotated[Whole, BeforeValidator(_count)]
Names = Annotated[tuple[str, ...], BeforeValidator(_listed)]
