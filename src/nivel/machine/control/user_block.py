"""Blocks whose law is a Python function with states of its own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationInfo

from nivel.machine.control.block import Block, Number, names_in
from nivel.machine.control.part import VALUE, Part
from nivel.machine.core.checked import Problem
from nivel.machine.core.record import Name, Record, entry
from nivel.machine.given import Field, Given
from nivel.machine.laws.python_law import PythonLaw, read_python_law, returned_count
from nivel.machine.units.quantity import fault, parameters_of, shown


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
        description="function of `time`, symbols (also `NAME.STATE`) and numbers"
    )
    states: Annotated[
        Given[tuple[UserState, ...], tuple[UserState, ...], Mapping[str, float | str] | Sequence[UserState]],
        BeforeValidator(_listed),
    ] = Field(default=(), description="name → value at the start")

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
