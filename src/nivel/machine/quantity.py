"""Numbers as people write them: `0.25`, `10 cm`, `30 rpm`, `2*length + 5 mm`. Fields of records hold them as SI floats.

The field types at the end (`Length`, `Mass`, …) are floats to the type checker. When a record is made they read a
number, which is SI, or a text with units and arithmetic, whose dimension must be the field's. Parameters of a machine
file come in through the validation context: ``{"parameters": {"radius": Number(0.25)}}``.
"""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real
from typing import Annotated, Any

from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from nivel.machine.arithmetic import (
    ExpressionError,
    FaultyParameterError,
    Node,
    Parameters,
    bind,
    evaluate,
    given,
    uses_time,
)
from nivel.machine.dimension import KINDS, Dimension, counts_turns, described, is_angular, without_angle
from nivel.machine.grammar import parse
from nivel.machine.measure import measure

FAULT = "nivel"  # type of the validation errors that carry a finished sentence
REPORTED = "nivel_reported"  # type of those that follow from a fault reported elsewhere


def fault(message: str, *, at_key: bool = False) -> PydanticCustomError:
    """A validation error whose text is `message`, ready for people; `at_key`: not the value is wrong but its key."""
    return PydanticCustomError(FAULT, "{message}", {"message": message, "at_key": at_key})


def reported() -> PydanticCustomError:
    """A validation error to be passed over in silence: its cause has been reported."""
    return PydanticCustomError(REPORTED, "follows from another fault")


def parameters_of(info: ValidationInfo) -> Parameters:
    """The parameters of the machine file being read; none where records are made in Python."""
    return (info.context or {}).get("parameters", {})


def bound_tree(text: str, parameters: Parameters) -> Node:
    """The tree of `text` with parameters, constants and units put in.

    Raises ExpressionError, FaultyParameterError.
    """
    return bind(parse(text), parameters)


def check_kind(text: str, its: Dimension | None, kind: str) -> None:
    """Refuse a quantity of dimension `its`, written as `text`, that is not of `kind`. A bare number always is.

    Raises ExpressionError.
    """
    article, unit, wanted = KINDS[kind]
    if its is None:
        return
    expected = f"{article} ({unit})" if unit != "1" else article
    # Angles vanish where SI lets them (rad/s × m = m/s), but where one is asked for, another power of it is a mistake.
    if without_angle(its) != without_angle(wanted) or (is_angular(its) and is_angular(wanted) and its != wanted):
        raise ExpressionError(f"`{text}` is {described(its)}; {expected} was expected")
    if is_angular(wanted) and counts_turns(its):
        raise ExpressionError(f"`{text}` counts turns; {expected} was expected: write `rev/s`, `rpm` or `rad/s`")


def read_quantity(value: object, kind: str, parameters: Parameters) -> float:
    """`value` as a finite SI number of `kind`, a key of KINDS.

    Raises ExpressionError, FaultyParameterError.
    """
    if isinstance(value, str):
        tree = bound_tree(value, parameters)
        if uses_time(tree):
            raise ExpressionError("`time` may only be used in the components of forces and torques")
        its = measure(tree)
        number = evaluate(tree)
        check_kind(value.strip(), its, kind)
        return number
    if isinstance(value, Real) and not isinstance(value, bool):
        return given(value)
    if hasattr(value, "item") and getattr(value, "shape", None) == ():  # a NumPy scalar or array without axes
        return read_quantity(value.item(), kind, parameters)  # type: ignore[attr-defined]
    article, unit, _ = KINDS[kind]
    expected = f"{article} ({unit})" if unit != "1" else article
    raise ExpressionError(f"{expected} was expected, got {shown(value)}")


def shown(value: object) -> str:
    """`value` in a message: as in the file, and short."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, int) and abs(value) > 1e40:
        return "a number of more than 40 digits"  # Python does not write integers of thousands of digits
    text = str(value)
    return f"`{text}`" if len(text) <= 40 else f"`{text[:37]}…`"


@dataclass(frozen=True)
class Quantity:
    """Annotation of a float field: it is a quantity of `kind`, and possibly bounded below by zero."""

    kind: str
    positive: bool = False

    @property
    def unit(self) -> str:
        """The SI unit, for documentation."""
        return KINDS[self.kind][1]

    def read(self, value: Any, info: ValidationInfo) -> float:
        try:
            number = read_quantity(value, self.kind, parameters_of(info))
        except FaultyParameterError:
            raise reported() from None
        except ExpressionError as problem:
            raise expression_fault(problem, value) from None
        if self.positive and number <= 0:
            raise fault(f"{KINDS[self.kind][0]} greater than zero was expected, got {shown(value)}")
        return number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        article, unit, _ = KINDS[self.kind]
        meaning = article if unit == "1" else f"{article} in {unit}, or with a unit"
        number: dict[str, Any] = {"type": "number"}
        if self.positive:
            number["exclusiveMinimum"] = 0
        return {"anyOf": [number, {"type": "string"}], "description": meaning}


def expression_fault(problem: ExpressionError, value: object) -> PydanticCustomError:
    """`problem` with the text that it is in, unless the message shows it already."""
    message = str(problem)
    if isinstance(value, str) and f"`{value.strip()}`" not in message:
        message = f"{shown(value.strip())}: {message}"
    return fault(message)


def listed(value: Any) -> Any:
    """NumPy arrays as lists, so that they may stand for vectors and matrices."""
    return value.tolist() if hasattr(value, "tolist") and getattr(value, "ndim", 0) > 0 else value


Scalar = Annotated[float, Quantity("number")]
Length = Annotated[float, Quantity("length")]
PositiveLength = Annotated[float, Quantity("length", positive=True)]
Mass = Annotated[float, Quantity("mass", positive=True)]
Density = Annotated[float, Quantity("density", positive=True)]
Duration = Annotated[float, Quantity("time", positive=True)]
Angle = Annotated[float, Quantity("angle")]
Velocity = Annotated[float, Quantity("velocity")]
AngularVelocity = Annotated[float, Quantity("angular velocity")]
Acceleration = Annotated[float, Quantity("acceleration")]
InertiaComponent = Annotated[float, Quantity("inertia")]
Rate = Annotated[float, Quantity("rate", positive=True)]

Direction = Annotated[tuple[Scalar, Scalar, Scalar], BeforeValidator(listed)]
Position = Annotated[tuple[Length, Length, Length], BeforeValidator(listed)]
VelocityVector = Annotated[tuple[Velocity, Velocity, Velocity], BeforeValidator(listed)]
AngularVelocityVector = Annotated[tuple[AngularVelocity, AngularVelocity, AngularVelocity], BeforeValidator(listed)]
AccelerationVector = Annotated[tuple[Acceleration, Acceleration, Acceleration], BeforeValidator(listed)]
