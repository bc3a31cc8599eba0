"""Blocks that are computed by others: FMUs, functions in C and in Python."""

import re
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ValidationInfo

from nivel.elements.kind import Kind
from nivel.machine.control.block import Block, Input, Number, Numbers, names_in
from nivel.machine.control.part import VALUE, CFacts, FmuFacts, Part, UnitFacts, UnitOutput
from nivel.machine.core.record import Name, Problem, Record, entry
from nivel.machine.given import Field, Given, OneNumber
from nivel.machine.laws.python_law import PythonLaw, read_python_law, returned_count
from nivel.machine.units.quantity import Quantity, fault, parameters_of, shown


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

    file: str = Field("name of the file, beside the machine file")
    inputs: Annotated[Inputs, BeforeValidator(_given_inputs)] = Field("input of the unit → signal", default=())
    outputs: Annotated[Outputs, BeforeValidator(_given_outputs)] = Field(
        "outputs of the unit, or names of one's own → outputs of the unit"
    )
    process: Literal["shared", "own"] = Field(
        "`own`: in a process of its own, so that a crash or a hang ends only the run", default="shared"
    )
    time_limit: Annotated[OneNumber, Quantity("time", positive=True)] = Field(
        "computing time that a call may take; of units with `process: own`", default=10.0
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
        "parameter of the unit → number, in the units of the FMU", default=()
    )

    @property
    def facts(self) -> FmuFacts:
        return FmuFacts(*self.used, parameters=tuple((each.variable, each.value) for each in self.parameters))


class CBlock(UnitBlock):
    """A C function that is called at each sample: ``int f(double time, const double *inputs, double *state, double *outputs)``.

    Inputs and outputs are in the order of the block. What it returns besides zero ends the run. The first output is the value of the
    block, others have names.
    """

    what: ClassVar[str] = "a C function"

    type: Literal["c"] = "c"
    function: str = Field("name of the function in the file")
    state: Numbers = Field("memory of the function: its values at the start", default=())

    @property
    def facts(self) -> CFacts:
        return CFacts(*self.used, function=self.function, state=self.state)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not re.fullmatch(r"[A-Za-z_]\w*", self.function, flags=re.ASCII):
            yield Problem(("function",), f"the name of a C function was expected, got `{self.function}`")


def _read_law(value: Any, info: ValidationInfo) -> PythonLaw:
    if not isinstance(value, PythonLaw | Mapping):
        raise fault(
            f"a Python function was expected, such as `{{python: laws.py, function: observer, arguments: [time]}}`, got {shown(value)}"
        )
    return read_python_law(value, parameters_of(info), results=None)


def _listed(value: Any) -> Any:
    return [{"name": name, "start": start} for name, start in value.items()] if isinstance(value, Mapping) else value


class UserState(Record):
    """A state of a user's block."""

    name: Name
    start: Number = Field(default=0.0)


class UserBlock(Block):
    """A Python function that returns the value, and for each of its states the rate, or of a sampled block the value after the sample."""

    type: Literal["python"] = "python"
    law: Annotated[Any, BeforeValidator(_read_law)] = Field(
        "function of `time`, symbols (also `NAME.STATE`) and numbers"
    )
    states: Annotated[
        Given[tuple[UserState, ...], tuple[UserState, ...], Mapping[str, float | str] | Sequence[UserState]],
        BeforeValidator(_listed),
    ] = Field("name → value at the start", default=())

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        return (VALUE, *names_in(entry(given, "states")))

    def computation(self) -> tuple[Part, ...]:
        results = [self.law, *(self._result(k + 1) for k in range(len(self.states)))]
        if self.states:
            results[0] = self._result(0)
        states = [
            self.remembered(state.name, law, law, state.start)
            for state, law in zip(self.states, results[1:], strict=True)
        ]
        return *states, self.present(self.output, results[0], key="law")

    def _result(self, number: int) -> PythonLaw:
        """The law of one of the numbers that the function returns."""
        names = ", ".join(f"x{k}" for k in range(len(self.law.arguments)))
        name = f"{self.law.function}_result_{number}"
        text = (
            f"{self.law.source.rstrip()}\n\n\ndef {name}({names}):\n    return {self.law.function}({names})[{number}]\n"
        )
        return replace(self.law, source=text, function=name)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        wanted, got = 1 + len(self.states), returned_count(self.law)
        if got is not None and got != wanted:
            what = (
                "the value"
                if wanted == 1
                else f"the value and {'the next value' if self.is_sampled else 'the rate'} of each state"
            )
            yield Problem(("law",), f"`{self.law.function}` returns {got} numbers; {wanted} were expected: {what}")
        for state in self.states:
            if state.name in (VALUE, "computed"):
                yield Problem(("states",), f"the state `{state.name}` has a meaning already; choose another name")


KINDS = tuple(map(Kind, (FmuBlock, CBlock, UserBlock)))
