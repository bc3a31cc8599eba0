"""Curves of catalogues: a table of one quantity over the position of a spool or over a current."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from nivel.machine.given import Given
from nivel.machine.laws.table import Table, read_table
from nivel.machine.units.dimension import KINDS
from nivel.machine.units.quantity import fault, parameters_of, shown

SMOOTH = ("linear", "cubic", "monotone")


@dataclass(frozen=True)
class Curve:
    """A table whose values are not negative. It is none of the functions of a machine: only its own component reads it."""

    table: Table

    @property
    def points(self) -> tuple[float, ...]:
        """Where it is known, increasing."""
        return self.table.times

    @property
    def values(self) -> tuple[float, ...]:
        """What it is there, SI."""
        return self.table.values

    def __call__(self, at: float) -> float:
        """Its value; beyond its ends, that at the end."""
        return self.table(at)

    def written(self) -> dict[str, Any]:
        """The curve as a mapping of a machine file."""
        return self.table.written()


SomeCurve = Given[Curve, Curve, Curve | Table | Mapping[str, Any]]


@dataclass(frozen=True)
class CurveOf:
    """Annotation of a field that is a Curve of a quantity of `kind` over the symbol `over`."""

    kind: str
    over: str

    def read(self, value: Any, info: ValidationInfo) -> Curve:
        value = value.table if isinstance(value, Curve) else value
        if not isinstance(value, Table) and not (isinstance(value, dict) and ("points" in value or "times" in value)):
            example = f"{{of: {self.over}, points: [0, 1], values: [0, …]}}"
            raise fault(f"a curve over `{self.over}` such as {example} was expected, got {shown(value)}")
        table = read_table(value, self.kind, parameters_of(info), (self.over,))
        if table.of != self.over:
            raise fault(f"a curve over `{self.over}` was expected: write `of: {self.over}`, got `of: {table.of}`")
        if table.interpolation not in SMOOTH:
            raise fault(f"a curve is linear, cubic or monotone, not {table.interpolation}")
        if min(table.values) < 0.0:
            raise fault(f"a curve without negative values was expected, got {min(table.values):g}")
        return Curve(table)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        written = core_schema.plain_serializer_function_ser_schema(Curve.written)
        return core_schema.with_info_plain_validator_function(self.read, serialization=written)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        numbers = {"type": "array", "items": {"anyOf": [{"type": "number"}, {"type": "string"}]}}
        inline = {"of": {"const": self.over}, "points": numbers, "values": numbers}
        text = {"type": "string"}
        filed = {"of": {"const": self.over}, "csv": text, "column": text, "time": text, "units": text}
        more = {"interpolation": {"enum": list(SMOOTH)}}
        return {
            "anyOf": [
                {
                    "type": "object",
                    "properties": {**given, **more},
                    "required": ["of", *required],
                    "additionalProperties": False,
                }
                for given, required in ((inline, ("points", "values")), (filed, ("csv",)))
            ],
            "description": f"{KINDS[self.kind][0]} over `{self.over}`: a table, inline or from a CSV file",
        }
