"""Description of a kind of force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from nivel.kernels.record.hook import Family
from nivel.machine.forces import ForceElement
from nivel.machine.machine_record import MachineRecord
from nivel.system.builder import SystemBuilder


@dataclass(frozen=True)
class ForceKind:
    """words : its record. add(builder, record) : gives the tables of a machine its numbers. families : kernels that it may need.
    families_of(machine, record) : those that an element needs, where they are not all.
    """

    words: type[ForceElement]
    add: Callable[[SystemBuilder, Any], None]
    families: tuple[Family, ...]
    families_of: Callable[[MachineRecord, Any], tuple[Family, ...]] | None = None

    def needed(self, machine: MachineRecord, force: Any) -> tuple[Family, ...]:
        """The kernels that an element of `machine` needs."""
        return self.families if self.families_of is None else self.families_of(machine, force)

    @property
    def type(self) -> str:
        """The word for it in machine files."""
        return str(self.words.model_fields["type"].default)
