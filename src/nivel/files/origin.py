"""Origin of a machine, so that a fault found later in its record is told with the place where the user wrote it."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from nivel.errors import Fault
from nivel.files.reader import locate, stands_in
from nivel.machine.settings.run import SimulationSettings

SETTING = re.compile(
    r"`(\w+)(?:`|: ([^`]*)`)"
)  # in messages, which name a setting as `step`, or with what it is as `step: 1 ms`

OUTSIDE = " (set from outside the file)"


@dataclass(frozen=True)
class Origin:
    """Where the values of a machine were set: in a file, from outside of it, or as arguments of a run.

    source : text of the `file`, empty for machines from records. outside : paths of values set from outside of the file, such as
    ``bodies.crank.mass``. given : simulation settings that are arguments of a run, and what was given. values : what was set from
    outside of the file, by path. allow_code : whether laws may be Python functions.
    """

    source: str = ""
    file: str = ""
    outside: frozenset[str] = frozenset()
    given: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)
    allow_code: bool = False

    def with_settings(self, settings: Mapping[str, Any]) -> Origin:
        """The same with these simulation settings given for a run."""
        return replace(self, given={**self.given, **settings})

    def edited(self) -> Origin:
        """Of a machine whose elements were replaced: no file says any more what it is."""
        return replace(self, source="", outside=frozenset(), values={})

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
            return replace(fault, message=f"{fault.message}{OUTSIDE}")
        asked = self._asked(fault)
        if asked is not None:
            return asked
        if not self.source:
            return fault
        line, column = locate(self.source, fault.path)
        return replace(fault, file=self.file, line=line, column=column)

    def _asked(self, fault: Fault) -> Fault | None:
        """A clash of something with a setting from outside of the file, told at that setting; None where there is no such setting.

        With other settings every setting that the message names has a part in the clash; else one whose value it names.
        """
        element = fault.path.removeprefix("simulation.")
        about_settings = element != fault.path
        for name, value in SETTING.findall(fault.message):
            outside = f"simulation.{name}" in self.outside
            if (outside and (about_settings or value)) or (
                name in self.given and (about_settings or value == self.given[name])
            ):
                message = f"`{element}`: {fault.message}{self._place(fault.path)}{OUTSIDE if outside else ''}"
                return replace(fault, path=f"simulation.{name}" if outside else name, message=message)
        return None

    def _place(self, path: str) -> str:
        """Where the file has `path`, to be said after a message; nothing where there is no file, or it was set from outside."""
        if not self.source or path in self.outside:
            return ""
        if path.startswith("simulation.") and not stands_in(self.source, path):
            return f"; the file leaves `{path.removeprefix('simulation.')}` at its default"
        line, column = locate(self.source, path)
        return f" ({self.file}:{line}:{column})"

    def of_settings(self, fault: Fault, given: Collection[str]) -> Fault:
        """A fault of the simulation settings; one of several settings that do not go together is that of the one that was `given`, and
        says where the file has the other."""
        if fault.path:
            return replace(fault, path=f"simulation.{fault.path}")
        named = [word for word, _ in SETTING.findall(fault.message) if word in SimulationSettings.model_fields]
        mine, others = [word for word in named if word in given], [word for word in named if word not in given]
        if not mine:
            return replace(fault, path="simulation")
        place = self._place(f"simulation.{others[0]}") if others else ""
        return replace(fault, path=f"simulation.{mine[0]}", message=fault.message + place)
