"""Outputs of FMUs as functions: what a machine in numbers needs to know of a unit."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.machine.units.tree import TIME


@dataclass(frozen=True)
class FmuFacts:
    """A unit as a block uses it: name of the block, file of the unit, and its variables that are inputs, outputs and parameters with
    values."""

    block: str
    file: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    parameters: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class FmuOutput:
    """The value of one output of a unit after a sample. inputs : paths of the signals that it is called with."""

    facts: FmuFacts
    number: int
    inputs: tuple[str, ...]

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals that it depends on, each once."""
        return tuple(dict.fromkeys(path for path in self.inputs if path != TIME))
