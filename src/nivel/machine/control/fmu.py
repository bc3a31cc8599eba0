"""Blocks that are FMUs: units of other programs, for co-simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.control.block import Number
from nivel.machine.control.unit import UnitBlock
from nivel.machine.control.unit_output import FmuFacts
from nivel.machine.core.record import Record
from nivel.machine.given import Field, Given


def _given_parameters(value: Any) -> Any:
    return (
        [{"variable": name, "value": given} for name, given in value.items()] if isinstance(value, Mapping) else value
    )


class FmuParameter(Record):
    """A parameter of a unit with its value."""

    variable: str
    value: Number


Parameters = Given[
    tuple[FmuParameter, ...], tuple[FmuParameter, ...], Mapping[str, float | str] | Sequence[FmuParameter]
]


class FmuBlock(UnitBlock):
    """An FMU of FMI 2.0 or 3.0 for co-simulation, which is sampled. The first output is the value of the block, others have names.

    At its first sample the unit is initialised, at each further one it makes a step from the sample before with the inputs of then.
    """

    what: ClassVar[str] = "an FMU"

    type: Literal["fmu"] = "fmu"
    parameters: Annotated[Parameters, BeforeValidator(_given_parameters)] = Field(
        default=(), description="parameter of the unit → number, in the units of the FMU"
    )

    @property
    def facts(self) -> FmuFacts:
        return FmuFacts(*self.used, parameters=tuple((each.variable, each.value) for each in self.parameters))
