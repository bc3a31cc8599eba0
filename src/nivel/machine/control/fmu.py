"""Blocks that are FMUs: units of other programs, for co-simulation."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from nivel.machine.control.block import Block, Input, Number, names_in
from nivel.machine.control.fmu_output import FmuFacts, FmuOutput
from nivel.machine.control.part import VALUE, Part
from nivel.machine.core.checked import Problem
from nivel.machine.core.record import Name, Record
from nivel.machine.given import Field, Given


def _given_inputs(value: Any) -> Any:
    if not isinstance(value, Mapping):
        return value
    return [{"name": _own_name(name), "variable": name, "signal": signal} for name, signal in value.items()]


def _given_outputs(value: Any) -> Any:
    if isinstance(value, Mapping):
        return [{"name": name, "variable": variable} for name, variable in value.items()]
    if isinstance(value, list | tuple):
        return [{"name": _own_name(each), "variable": each} if isinstance(each, str) else each for each in value]
    return value


def _given_parameters(value: Any) -> Any:
    return (
        [{"variable": name, "value": given} for name, given in value.items()] if isinstance(value, Mapping) else value
    )


def _own_name(variable: Any) -> Any:
    """A name for a variable whose own one may have dots and brackets."""
    return re.sub(r"\W+", "_", variable).strip("_") if isinstance(variable, str) else variable


class FmuInput(Record):
    """An input of a unit, and the signal that it gets."""

    name: Name
    variable: str
    signal: Input


class FmuOutputName(Record):
    """An output of a unit by its own name and that in the unit."""

    name: Name
    variable: str


class FmuParameter(Record):
    """A parameter of a unit with its value."""

    variable: str
    value: Number


Inputs = Given[tuple[FmuInput, ...], tuple[FmuInput, ...], Mapping[str, Any] | Sequence[FmuInput]]
Outputs = Given[
    tuple[FmuOutputName, ...], tuple[FmuOutputName, ...], Mapping[str, str] | Sequence[str] | Sequence[FmuOutputName]
]
Parameters = Given[
    tuple[FmuParameter, ...], tuple[FmuParameter, ...], Mapping[str, float | str] | Sequence[FmuParameter]
]


class FmuBlock(Block):
    """An FMU of FMI 2.0 or 3.0 for co-simulation, which is sampled. The first output is the value of the block, others have names.

    At its first sample the unit is initialised, at each further one it makes a step from the sample before with the inputs of then.
    """

    type: Literal["fmu"] = "fmu"
    file: str = Field(description="name of the file, beside the machine file")
    inputs: Annotated[Inputs, BeforeValidator(_given_inputs)] = Field(
        default=(), description="input of the unit → signal"
    )
    outputs: Annotated[Outputs, BeforeValidator(_given_outputs)] = Field(
        description="outputs of the unit, or names of one's own → outputs of the unit"
    )
    parameters: Annotated[Parameters, BeforeValidator(_given_parameters)] = Field(
        default=(), description="parameter of the unit → number, in the units of the FMU"
    )

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        found = given.get("outputs") if isinstance(given, Mapping) else getattr(given, "outputs", ())
        return (VALUE, *names_in(_given_outputs(found)))

    @property
    def facts(self) -> FmuFacts:
        """The unit as the block uses it."""
        return FmuFacts(
            self.name,
            self.file,
            tuple(each.variable for each in self.inputs),
            tuple(each.variable for each in self.outputs),
            tuple((each.variable, each.value) for each in self.parameters),
        )

    def computation(self) -> tuple[Part, ...]:
        taken = [Part(f"{each.name}_in", "sample", each.signal, key=f"inputs.{each.variable}") for each in self.inputs]
        paths = tuple(self.path(part.name) for part in taken)
        outputs = [
            Part(name, "sample", FmuOutput(self.facts, k, paths), holds=True, key="file")
            for k, name in enumerate((self.output, *(each.name for each in self.outputs[1:])))
        ]
        return *taken, *outputs

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem(
                (), "`sample_time` is missing: an FMU makes steps of this length, such as `sample_time: 1 ms`"
            )
        if not self.outputs:
            yield Problem(("outputs",), "an output of the FMU was expected; the first one is the value of the block")
        taken = {VALUE, "computed", *(f"{each.name}_in" for each in self.inputs)}
        for each in self.outputs:
            if each.name in taken:
                yield Problem(
                    ("outputs",),
                    f"the output `{each.name}` has a name that is taken; write `outputs: {{y: {each.variable}}}`",
                )
            taken.add(each.name)
