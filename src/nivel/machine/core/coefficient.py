"""Quantities of force elements: stiffness, damping and the like, with their bounds.

What belongs to a joint coordinate is in metres or in radians: `OfCoordinate` asks the record's field `coordinate`,
which must stand before, what kind it is; so does `OfCoordinateFunction` for what may vary.
"""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, Final, Literal

from pydantic import (
    AfterValidator,
    BeforeValidator,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    ValidationError,
    ValidationInfo,
)
from pydantic_core import CoreSchema, core_schema

from nivel.lazy import Struct
from nivel.machine.given import ManyNumbers, OneNumber
from nivel.machine.laws.time_function import OneFunction, TimeFunction, Varying, written
from nivel.machine.units.quantity import (
    UNREAD,
    Quantity,
    fault,
    line_of,
    listed,
    parameters_of,
    read_quantity,
    shown,
    told,
    unread,
)
from nivel.machine.units.unit import KINDS
from nivel.machine.uses.coordinate_reference import kind_of
from nivel.words.arguments import plain

THINNEST: Final = 1e-9  # [m] of a section; fourth powers of smaller numbers, and of larger ones, are lost in round-off
THICKEST: Final = 1e6

Bound = Literal["", "positive", "not negative"]

# kinds of what belongs to a coordinate: where it is a length, where it is an angle
COORDINATE: Final = ("length", "angle")
COORDINATE_RATE: Final = ("velocity", "angular velocity")
COORDINATE_ACCELERATION: Final = ("acceleration", "angular acceleration")
COORDINATE_EFFORT: Final = ("force", "torque")
COORDINATE_STIFFNESS: Final = ("stiffness", "torsional stiffness")
COORDINATE_INTEGRAL: Final = ("stiffness per time", "torsional stiffness per time")
COORDINATE_DAMPING: Final = ("damping", "torsional damping")


def _where(holds: Callable[[float], bool], expected: str) -> Callable[[float], float]:
    """A bound of numbers: one of which it does not hold is refused, with what was `expected`."""

    def check(value: float) -> float:
        if not holds(value):
            raise fault(f"{expected} was expected, got `{value:g}`")
        return value

    return check


_not_negative = _where(lambda value: not value < 0, "zero or more")
_fraction = _where(lambda value: 0 < value <= 1, "a number above 0 and up to 1")
_poisson_ratio = _where(lambda value: -1 < value <= 0.5, "a number above -1 and up to 0.5")
_exponent = _where(lambda value: not value < 1, "a number of 1 or more")


def _size_of_section(value: float) -> float:
    if not THINNEST <= value <= THICKEST:
        raise fault(
            f"{value:.3g} m is no size of a beam's section: between {THINNEST:g} and {THICKEST:g} m was expected"
        )
    return value


def _truth(value: Any) -> bool:
    if not isinstance(value := plain(value), bool):
        raise fault(f"true or false was expected, got {shown(value)}")
    return value


def kind_for(reference: object, kinds: tuple[str, str]) -> str | tuple[str, str]:
    """The first of `kinds` where the coordinate `reference` is a length, the second where it is an angle, both where
    its text does not say.
    """
    kind = kind_of(reference)
    return kinds if kind is None else kinds[0] if kind == "length" else kinds[1]


class OfCoordinate(Struct):
    """Annotation of a float field of a record with a `coordinate`: a quantity of the first of `kinds` for a length, of
    the second for an angle.
    """

    kinds: tuple[str, str]
    bound: Bound = ""

    def read(self, value: Any, info: ValidationInfo) -> float:
        with told(value, parameters_of(info)):
            kind = kind_for((info.data or {}).get("coordinate"), self.kinds)
            number = read_quantity(value, kind, parameters_of(info))
        if self.bound == "positive" and number <= 0:
            raise fault(f"a value greater than zero was expected, got {shown(value)}")
        return _not_negative(number) if self.bound == "not negative" else number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        number: dict[str, Any] = {"type": "number"}
        if self.bound:
            number["exclusiveMinimum" if self.bound == "positive" else "minimum"] = 0
        meaning = " or ".join(f"{KINDS[each][0]} in {KINDS[each][1]}" for each in self.kinds)
        return {"anyOf": [number, {"type": "string"}], "description": meaning}


def columns_of_coordinate(kinds: Mapping[str, tuple[str, str]]) -> Callable[[Any, ValidationInfo], Any]:
    """Validator of a table, before it is read, in a record with a `coordinate`: the entries of each column are of the
    first of its `kinds` for a length, of the second for an angle.
    """

    def check(table: Any, info: ValidationInfo) -> Any:
        lines = []
        for column, its in kinds.items() if isinstance(table, Mapping) else ():
            kind = kind_for((info.data or {}).get("coordinate"), its)
            entries = listed(table.get(column))
            for at, entry in enumerate(entries if isinstance(entries, list | tuple) else ()):
                try:
                    read_quantity(entry, kind, parameters_of(info))
                except UNREAD as problem:
                    lines.append(line_of((column, at), unread(problem, entry, parameters_of(info))))
        if lines:
            raise ValidationError.from_exception_data("table", lines)
        return table

    return check


Truth = Annotated[bool, BeforeValidator(_truth)]

NotNegative = AfterValidator(_not_negative)
PositiveAngle = Annotated[OneNumber, Quantity("angle", positive=True)]
PositiveNumber = Annotated[OneNumber, Quantity("number", positive=True)]
NotNegativeNumber = Annotated[OneNumber, Quantity("number"), NotNegative]
NotNegativeLength = Annotated[OneNumber, Quantity("length"), NotNegative]
SectionLength = Annotated[OneNumber, Quantity("length", positive=True), AfterValidator(_size_of_section)]
PositiveForce = Annotated[OneNumber, Quantity("force", positive=True)]
NotNegativeForce = Annotated[OneNumber, Quantity("force"), NotNegative]
ForceValue = Annotated[OneNumber, Quantity("force")]
TorqueValue = Annotated[OneNumber, Quantity("torque")]
PositiveSpeed = Annotated[OneNumber, Quantity("velocity", positive=True)]
NotNegativeSpeed = Annotated[OneNumber, Quantity("velocity"), NotNegative]
Stiffness = Annotated[OneNumber, Quantity("stiffness"), NotNegative]
FoundationModulus = Annotated[OneNumber, Quantity("foundation modulus", positive=True)]
Damping = Annotated[OneNumber, Quantity("damping"), NotNegative]
TorsionalStiffness = Annotated[OneNumber, Quantity("torsional stiffness"), NotNegative]
TorsionalDamping = Annotated[OneNumber, Quantity("torsional damping"), NotNegative]
StiffnessPerLoad = Annotated[OneNumber, Quantity("stiffness per load", positive=True)]
DampingPerLoad = Annotated[OneNumber, Quantity("damping per load"), NotNegative]
NotNegativePressure = Annotated[OneNumber, Quantity("pressure"), NotNegative]
Volume = Annotated[OneNumber, Quantity("volume", positive=True)]
VolumeFlow = Annotated[OneNumber, Quantity("volume flow", positive=True)]
Displacement = Annotated[OneNumber, Quantity("displacement", positive=True)]
Leakage = Annotated[OneNumber, Quantity("leakage"), NotNegative]
SonicConductance = Annotated[OneNumber, Quantity("leakage", positive=True)]
Temperature = Annotated[OneNumber, Quantity("temperature", positive=True)]
ThermalConductance = Annotated[OneNumber, Quantity("thermal conductance"), NotNegative]
HeatCapacity = Annotated[OneNumber, Quantity("heat capacity", positive=True)]
ThermalExpansion = Annotated[OneNumber, Quantity("thermal expansion"), NotNegative]
HeatTransfer = Annotated[OneNumber, Quantity("heat transfer coefficient"), NotNegative]
Area = Annotated[OneNumber, Quantity("area", positive=True)]
NotNegativeDuration = Annotated[OneNumber, Quantity("time"), NotNegative]
Viscosity = Annotated[OneNumber, Quantity("kinematic viscosity", positive=True)]
Frequency = Annotated[OneNumber, Quantity("frequency", positive=True)]
NotNegativeTorque = Annotated[OneNumber, Quantity("torque"), NotNegative]
Share = Annotated[OneNumber, Quantity("number"), AfterValidator(_fraction)]
Pressure = Annotated[OneNumber, Quantity("pressure", positive=True)]
PoissonRatio = Annotated[OneNumber, Quantity("number"), AfterValidator(_poisson_ratio)]
Restitution = Annotated[OneNumber, Quantity("number"), AfterValidator(_fraction)]
Exponent = Annotated[OneNumber, Quantity("number"), AfterValidator(_exponent)]

Lengths = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("length")]], BeforeValidator(listed)]
Angles = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("angle")]], BeforeValidator(listed)]
Forces = Annotated[ManyNumbers[ForceValue], BeforeValidator(listed)]
Torques = Annotated[ManyNumbers[TorqueValue], BeforeValidator(listed)]
Numbers = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("number")]], BeforeValidator(listed)]

CoordinateValue = Annotated[OneNumber, OfCoordinate(COORDINATE)]
CoordinateEffort = Annotated[OneNumber, OfCoordinate(COORDINATE_EFFORT)]
PositiveEffort = Annotated[OneNumber, OfCoordinate(COORDINATE_EFFORT, "positive")]
CoordinateStiffness = Annotated[OneNumber, OfCoordinate(COORDINATE_STIFFNESS, "not negative")]
CoordinateDamping = Annotated[OneNumber, OfCoordinate(COORDINATE_DAMPING, "not negative")]
CoordinateIntegral = Annotated[OneNumber, OfCoordinate(COORDINATE_INTEGRAL, "not negative")]
PositiveGain = Annotated[OneNumber, OfCoordinate(COORDINATE_DAMPING, "positive")]
PositiveCoordinateStiffness = Annotated[OneNumber, OfCoordinate(COORDINATE_STIFFNESS, "positive")]
NotNegativeValue = Annotated[OneNumber, OfCoordinate(COORDINATE, "not negative")]
CoordinateRate = Annotated[OneNumber, OfCoordinate(COORDINATE_RATE)]
NotNegativeRate = Annotated[OneNumber, OfCoordinate(COORDINATE_RATE, "not negative")]


class OfCoordinateFunction(Struct):
    """Annotation of a field that is a TimeFunction, of the first of `kinds` for a length, of the second for an angle.

    What is known of the coordinate stands in the fields before this one: `coordinate`, or `along` or `about` an axis.
    """

    kinds: tuple[str, str]
    local: tuple[str, ...] = ()
    smooth: bool = False

    def read(self, value: Any, info: ValidationInfo) -> TimeFunction:
        kind = self._kind(info.data or {})
        return Varying(kind, self.local, self.smooth).read(value, info)

    def _kind(self, given: Mapping[str, Any]) -> str | tuple[str, str]:
        if given.get("along") is not None:
            return self.kinds[0]
        if given.get("about") is not None:
            return self.kinds[1]
        return kind_for(given.get("coordinate"), self.kinds)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        serialization = core_schema.plain_serializer_function_ser_schema(written)
        return core_schema.with_info_plain_validator_function(self.read, serialization=serialization)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return Varying(self.kinds, self.local, self.smooth).__get_pydantic_json_schema__(schema, handler)


CoordinateLaw = Annotated[OneFunction, OfCoordinateFunction(COORDINATE_EFFORT, local=("value", "rate"))]
CoordinateEffortFunction = Annotated[OneFunction, OfCoordinateFunction(COORDINATE_EFFORT)]
CoordinateSpeed = Annotated[OneFunction, OfCoordinateFunction(COORDINATE_RATE)]
CoordinateAcceleration = Annotated[OneFunction, OfCoordinateFunction(COORDINATE_ACCELERATION)]
CoordinatePosition = Annotated[OneFunction, OfCoordinateFunction(COORDINATE)]
CoordinateMotion = Annotated[OneFunction, OfCoordinateFunction(COORDINATE, smooth=True)]
