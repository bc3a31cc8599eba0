"""Units of a machine, which are FMUs and C functions: machine code of others that its control calls."""

from typing import Any

from nivel.lazy import nivel
from nivel.machine.control.part import CFacts, FmuFacts, UnitFacts
from nivel.system.signals.unit import OwnUnit, Unit


def unit_of(facts: UnitFacts) -> Unit[Any, Any]:
    """The unit that a block asks for. Raises ModelError where its file is none."""
    if facts.own_process:
        return nivel.system.signals.own_process.UnitProcess(facts)
    return unit_here(facts)


def unit_here(facts: UnitFacts) -> OwnUnit[Any, Any]:
    """The unit of a block in this process. Raises ModelError where its file is none."""
    if isinstance(facts, CFacts):
        return nivel.system.signals.c_instance.CInstance(facts)
    assert isinstance(facts, FmuFacts)
    return nivel.system.signals.fmu_instance.FmuInstance(facts)
