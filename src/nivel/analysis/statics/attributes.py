"""Attributes of a statics run that are known before its first state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.statics.settings import StaticsSettings
from nivel.machine.machine_record import MachineRecord


def statics_attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: StaticsSettings
) -> dict[str, str | float | int]:
    """The attributes of the result, see `nivel.integrate.loop.sink.Header`; the coordinates are those that were taken."""
    taken = "relative" if len(prepared.motion.system.record.tree.node) else "absolute"
    shown: Any = _Shown({**settings.as_dict(), "coordinates": taken})
    attributes = run_attributes(machine, source, prepared, shown)
    return {**attributes, "analysis": "statics"}


@dataclass(frozen=True)
class _Shown:
    """Settings as `run_attributes` asks for them."""

    settings: dict[str, object]

    def as_dict(self) -> dict[str, object]:
        return self.settings
