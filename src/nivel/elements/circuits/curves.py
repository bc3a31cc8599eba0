"""Curves and tables of catalogues: of spools, of machines, of hoses."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.known import SystemBuilder
from nivel.lazy import Struct
from nivel.machine.core.coefficient import Area, Numbers, Pressure, Volume
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, Given, ManyNumbers, OneNumber
from nivel.machine.laws.varying_value import Table, read_table
from nivel.machine.units import unit
from nivel.machine.units.quantity import Quantity, fault, listed, parameters_of, shown

SMOOTH = ("linear", "cubic", "monotone")


class Curve(Struct):
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


class CurveOf(Struct):
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
            "description": f"{unit.KINDS[self.kind][0]} over `{self.over}`: a table, inline or from a CSV file",
        }


Pressures = Annotated[ManyNumbers[Pressure], BeforeValidator(listed)]
Speeds = Annotated[
    ManyNumbers[Annotated[OneNumber, Quantity("angular velocity", positive=True)]], BeforeValidator(listed)
]


def rising(key: str, values: Sequence[float]) -> Iterator[Problem]:
    for at in range(1, len(values)):
        if values[at] <= values[at - 1]:
            yield Problem((key, at), f"{key} increase; {values[at]:g} does not come after {values[at - 1]:g}")
            return


def as_many(key: str, values: Sequence[float], over: str, count: int) -> Iterator[Problem]:
    if len(values) != count:
        yield Problem((key,), f"{count} {key} were expected, one for each of {over}, got {len(values)}")


class EfficiencyMap(Checked):
    """Efficiencies at points of speed, difference of pressure and setting, all magnitudes.

    `volumetric` and `mechanical` have one number for each point; the setting changes first, then the pressure, then the speed.
    """

    speeds: Speeds = Field("of the shaft, increasing")
    pressures: Pressures = Field("difference of pressure, increasing")
    settings: Numbers = Field("share of the displacement, increasing", default=(1.0,))
    volumetric: Numbers = Field("volumetric efficiency of each point")
    mechanical: Numbers = Field("hydraulic-mechanical efficiency of each point")

    @property
    def shape(self) -> tuple[int, int, int]:
        """Points along speeds, pressures and settings."""
        return len(self.speeds), len(self.pressures), len(self.settings)

    def points(self) -> tuple[np.ndarray, ...]:
        """(ω [rad/s], Δp [Pa], ε, η_v, η_hm), each of the `shape`."""
        axes = np.meshgrid(self.speeds, self.pressures, self.settings, indexing="ij")
        return (*axes, *(np.reshape(each, self.shape) for each in (self.volumetric, self.mechanical)))

    def problems(self) -> Iterator[Problem]:
        for key in ("speeds", "pressures", "settings"):
            yield from rising(key, getattr(self, key))
        if any(not 0.0 < each <= 1.0 for each in self.settings):
            yield Problem(("settings",), "settings above 0 and up to 1 were expected")
        count = int(np.prod(self.shape))
        over = "all speeds, pressures and settings"
        for key in ("volumetric", "mechanical"):
            yield from as_many(key, getattr(self, key), over, count)
            if any(not 0.0 < each <= 1.0 for each in getattr(self, key)):
                yield Problem((key,), "efficiencies above 0 and up to 1 were expected")


MOST_POINTS = 6  # of the growth of a hose


class HoseExpansion(Checked):
    """What a hose grows by over the pressure above that of the air: straight lines from none, and on beyond the last point."""

    pressures: Pressures = Field("above that of the air, increasing")
    volumes: ManyNumbers[Any]

    def problems(self) -> Iterator[Problem]:
        yield from rising("pressures", self.pressures)
        yield from as_many("volumes", self.volumes, "`pressures`", len(self.pressures))
        yield from rising("volumes", self.volumes)
        if not 1 <= len(self.pressures) <= MOST_POINTS:
            yield Problem(("pressures",), f"1 to {MOST_POINTS} points were expected, got {len(self.pressures)}")


class VolumeExpansion(HoseExpansion):
    """Growth of a whole volume."""

    volumes: Annotated[ManyNumbers[Volume], BeforeValidator(listed)] = Field("that it grows by")


class LengthExpansion(HoseExpansion):
    """Growth of each length of a hose, as catalogues state it."""

    volumes: Annotated[ManyNumbers[Area], BeforeValidator(listed)] = Field("that each length grows by: cm^3/m")


def hose_points(expansion: HoseExpansion | None, length: float) -> list[float]:
    """POINTS … of `Circuit.room`: the growth of a hose of this length [m], or of a whole one."""
    if expansion is None:
        return []
    pairs = zip(expansion.pressures, expansion.volumes, strict=True)
    points = [number for p, volume in pairs for number in (p + ATMOSPHERE, volume * length)]
    return [float(len(expansion.pressures)), *points]


def held_curve(builder: SystemBuilder, curve: Table) -> int:
    """A table with its end values beyond its ends."""
    inner = curve.coefficients().tolist()
    rows = [[curve.values[0], 0.0, 0.0, 0.0], *inner, [curve.values[-1], 0.0, 0.0, 0.0]]
    return builder.functions.add_table([curve.times[0] - 1.0, *curve.times], np.array(rows))
