"""Where a machine comes from, so that a fault found later in its record is told with the place where the user wrote it."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from nivel.errors import Fault
from nivel.files.reader import locate
from nivel.machine import SimulationSettings

SETTING = re.compile(r"`(\w+)[:`]")  # in messages


@dataclass(frozen=True)
class Origin:
    """Where the values of a machine were set: in a file, from outside of it, or as arguments of a run.

    source : text of the `file`, empty for machines from records. outside : paths of values set from outside of the file, such as
    ``bodies.crank.mass``. given : simulation settings that are arguments of a run.
    """

    source: str = ""
    file: str = ""
    outside: frozenset[str] = frozenset()
    given: frozenset[str] = frozenset()

    def with_settings(self, settings: Collection[str]) -> Origin:
        """The same with these simulation settings given for a run."""
        return replace(self, given=self.given | frozenset(settings))

    @property
    def settings_outside(self) -> frozenset[str]:
        """Names of the simulation settings that were set from outside of the file."""
        return frozenset(path.split(".")[1] for path in self.outside if path.startswith("simulation."))

    def placed(self, faults: Iterable[Fault]) -> list[Fault]:
        """`faults` with the places of their elements in the file, if there is one, or how they came from outside of it."""
        return [self._placed(fault) for fault in faults]

    def _placed(self, fault: Fault) -> Fault:
        if fault.line or not fault.path:
            return fault
        words = fault.path.split(".")
        if words[0] == "simulation" and words[1:2] and words[1] in self.given:
            return replace(fault, path=".".join(words[1:]))
        if any(".".join(words[:end]) in self.outside for end in range(1, len(words) + 1)):
            return replace(fault, message=f"{fault.message} (set from outside the file)")
        if not self.source:
            return fault
        line, column = locate(self.source, fault.path)
        return replace(fault, file=self.file, line=line, column=column)

    def of_settings(self, fault: Fault, given: Collection[str]) -> Fault:
        """A fault of the simulation settings; one of several settings that do not go together is that of the one that was `given`, and
        says where the file has the other."""
        if fault.path:
            return replace(fault, path=f"simulation.{fault.path}")
        named = [word for word in SETTING.findall(fault.message) if word in SimulationSettings.model_fields]
        mine, others = [word for word in named if word in given], [word for word in named if word not in given]
        if not mine:
            return replace(fault, path="simulation")
        message = fault.message
        if others and self.source and f"simulation.{others[0]}" not in self.outside:
            line, column = locate(self.source, f"simulation.{others[0]}")
            message += f" ({self.file}:{line}:{column})"
        return replace(fault, path=f"simulation.{mine[0]}", message=message)
