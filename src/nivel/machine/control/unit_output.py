"""Outputs of units, which are FMUs and C functions, as functions: what a machine in numbers needs to know of a unit."""

from __future__ import annotations

from nivel.lazy import dataclass
from nivel.machine.units.tree import TIME


@dataclass(frozen=True)
class UnitFacts:
    """A unit as a block uses it: name of the block, file of the unit, and its variables that are inputs and outputs.

    own_process, time_limit : whether it runs in a process of its own, and how long [s] a call may take there.
    """

    block: str
    file: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    own_process: bool
    time_limit: float


@dataclass(frozen=True)
class FmuFacts(UnitFacts):
    """An FMU, with values of its parameters."""

    parameters: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class CFacts(UnitFacts):
    """A C function, with its name and the start of its state."""

    function: str = ""
    state: tuple[float, ...] = ()


@dataclass(frozen=True)
class UnitOutput:
    """The value of one output of a unit after a sample. inputs : paths of the signals that it is called with."""

    facts: UnitFacts
    number: int
    inputs: tuple[str, ...]

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals that it depends on, each once."""
        return tuple(dict.fromkeys(path for path in self.inputs if path != TIME))
