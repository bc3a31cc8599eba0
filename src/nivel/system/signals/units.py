"""Units of a machine, which are FMUs and C functions: machine code of others that its control calls."""

from __future__ import annotations

from typing import Any, Protocol

from nivel.kernels.core.block import Handle
from nivel.kernels.record.hook import Family
from nivel.lazy import nivel
from nivel.machine.control.part import CFacts, FmuFacts, UnitFacts


class Unit(Protocol):
    """The unit of a block as a machine in numbers has it."""

    @property
    def handle(self) -> Handle:
        """Its record, which its law is called with."""
        ...

    @property
    def law(self) -> Family:
        """What calls it."""
        ...

    @property
    def failure(self) -> str:
        """What went wrong in the run, as a sentence without a full stop; empty where nothing did."""
        ...

    @property
    def arrays(self) -> list[Any]:
        """What a saved state has of it besides what the unit itself saves."""
        ...

    def begin(self) -> None:
        """A new instance for a run. Raises ModelError where it cannot be had."""
        ...

    def end(self) -> None:
        """Free the instance of the last run."""
        ...

    def state(self) -> bytes:
        """The state that the unit saves itself. Raises ModelError where it cannot."""
        ...

    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where the unit refuses it."""
        ...


class OwnUnit(Unit, Protocol):
    """A unit that can be called without compiled kernels, as its process does where it has one of its own."""

    def go(self, begin: float, step: float | None, inputs: bytes) -> bytes:
        """Outputs at the time `begin` [s] at which it begins, or a step later; the failure is set where there are none."""
        ...


def unit_of(facts: UnitFacts) -> Unit:
    """The unit that a block asks for. Raises ModelError where its file is none."""
    if facts.own_process:
        return nivel.system.signals.own_process.UnitProcess(facts)
    return unit_here(facts)


def unit_here(facts: UnitFacts) -> OwnUnit:
    """The unit of a block in this process. Raises ModelError where its file is none."""
    if isinstance(facts, CFacts):
        return nivel.system.signals.c_instance.CInstance(facts)
    assert isinstance(facts, FmuFacts)
    return nivel.system.signals.fmu_instance.FmuInstance(facts)
