"""Description of a kind of force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from nivel.kernels.record.hook import Family
from nivel.machine.forces import ForceElement
from nivel.system.builder import SystemBuilder


@dataclass(frozen=True)
class ForceKind:
    """words : its record. add(builder, record) : gives the tables of a machine its numbers. families : kernels that it may need."""

    words: type[ForceElement]
    add: Callable[[SystemBuilder, Any], None]
    families: tuple[Family, ...]

    @property
    def type(self) -> str:
        """The word for it in machine files."""
        return str(self.words.model_fields["type"].default)
