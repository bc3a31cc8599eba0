"""Functions that belong to a joint coordinate: in metres or newtons where it is a length, in radians or newton metres
where it is an angle.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from nivel.lazy import dataclass
from nivel.machine.core import coefficient
from nivel.machine.laws.time_function import OneFunction, TimeFunction, Varying, written


@dataclass(frozen=True)
class OfCoordinateFunction:
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
        return coefficient.kind_for(given.get("coordinate"), self.kinds)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        serialization = core_schema.plain_serializer_function_ser_schema(written)
        return core_schema.with_info_plain_validator_function(self.read, serialization=serialization)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return Varying(self.kinds, self.local, self.smooth).__get_pydantic_json_schema__(schema, handler)


CoordinateLaw = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE_EFFORT, local=("value", "rate"))]
CoordinateEffortFunction = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE_EFFORT)]
CoordinateSpeed = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE_RATE)]
CoordinateAcceleration = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE_ACCELERATION)]
CoordinatePosition = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE)]
CoordinateMotion = Annotated[OneFunction, OfCoordinateFunction(coefficient.COORDINATE, smooth=True)]
