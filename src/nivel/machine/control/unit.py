"""Base of blocks that are units of other programs: machine code that is called once a sample."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.control.block import Block, Input, names_in
from nivel.machine.control.part import VALUE, Part
from nivel.machine.control.unit_output import UnitFacts, UnitOutput
from nivel.machine.core.checked import Problem
from nivel.machine.core.record import Name, Record
from nivel.machine.given import Field, Given, OneNumber
from nivel.machine.units.quantity import Quantity


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


def _own_name(variable: Any) -> Any:
    """A name for a variable whose own one may have dots and brackets."""
    return re.sub(r"\W+", "_", variable).strip("_") if isinstance(variable, str) else variable


class UnitInput(Record):
    """An input of a unit, and the signal that it gets."""

    name: Name
    variable: str
    signal: Input


class UnitOutputName(Record):
    """An output of a unit by its own name and that in the unit."""

    name: Name
    variable: str


Inputs = Given[tuple[UnitInput, ...], tuple[UnitInput, ...], Mapping[str, Any] | Sequence[UnitInput]]
Outputs = Given[
    tuple[UnitOutputName, ...], tuple[UnitOutputName, ...], Mapping[str, str] | Sequence[str] | Sequence[UnitOutputName]
]


class UnitBlock(Block):
    """A unit, which is sampled. The first output is the value of the block, others have names. what : its kind, for messages."""

    what: ClassVar[str]

    file: str = Field(description="name of the file, beside the machine file")
    inputs: Annotated[Inputs, BeforeValidator(_given_inputs)] = Field(
        default=(), description="input of the unit → signal"
    )
    outputs: Annotated[Outputs, BeforeValidator(_given_outputs)] = Field(
        description="outputs of the unit, or names of one's own → outputs of the unit"
    )
    process: Literal["shared", "own"] = Field(
        default="shared", description="`own`: in a process of its own, so that a crash or a hang ends only the run"
    )
    time_limit: Annotated[OneNumber, Quantity("time", positive=True)] = Field(
        default=10.0, description="computing time that a call may take; of units with `process: own`"
    )

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        found = given.get("outputs") if isinstance(given, Mapping) else getattr(given, "outputs", ())
        return (VALUE, *names_in(_given_outputs(found)))

    @property
    @abstractmethod
    def facts(self) -> UnitFacts:
        """The unit as the block uses it."""

    @property
    def used(self) -> tuple[str, str, tuple[str, ...], tuple[str, ...], bool, float]:
        """What facts of all kinds begin with."""
        names = tuple(tuple(each.variable for each in every) for every in (self.inputs, self.outputs))
        return self.name, self.file, names[0], names[1], self.process == "own", self.time_limit

    def computation(self) -> tuple[Part, ...]:
        taken = [Part(f"{each.name}_in", "sample", each.signal, key=f"inputs.{each.variable}") for each in self.inputs]
        paths = tuple(self.path(part.name) for part in taken)
        outputs = [
            Part(name, "sample", UnitOutput(self.facts, k, paths), holds=True, key="file")
            for k, name in enumerate((self.output, *(each.name for each in self.outputs[1:])))
        ]
        return *taken, *outputs

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.sample_time is None:
            yield Problem(
                (), f"`sample_time` is missing: {self.what} makes steps of this length, such as `sample_time: 1 ms`"
            )
        if not self.outputs:
            yield Problem(("outputs",), "an output was expected; the first one is the value of the block")
        taken = {VALUE, "computed", *(f"{each.name}_in" for each in self.inputs)}
        for each in self.outputs:
            if each.name in taken:
                yield Problem(
                    ("outputs",),
                    f"the output `{each.name}` has a name that is taken; write `outputs: {{y: {each.variable}}}`",
                )
            taken.add(each.name)
