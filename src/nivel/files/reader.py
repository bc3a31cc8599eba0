"""Machine files: from YAML to records, with every fault and its place."""

import re
from collections.abc import Collection, Mapping
from pathlib import Path as FilePath
from typing import Any

from nivel.errors import Fault
from nivel.files.outline import FORMAT, Known
from nivel.files.overrides import prefix_of
from nivel.files.scope import Scope
from nivel.files.sources import Sources, read_text
from nivel.files.tree import Path, Tree, read_tree
from nivel.lazy import Struct, all_kept, field, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.uses.references import SECTIONS

__all__ = ["FORMAT", "locate", "parse_machine", "read_machine", "read_text"]


def read_machine(
    path: str | FilePath, *, overrides: Mapping[str, object] | None = None, allow_code: bool = False
) -> MachineRecord:
    """The machine in the YAML file at `path`. `overrides`: values by path, e.g. ``{"bodies.crank.mass": "22 kg"}``.

    allow_code : laws of forces, drivers, sensors and events may be Python functions, which run with all your rights.
    Raises ModelError with everything that is wrong, each with file, line and column.
    """
    return parse_machine(read_text(path), str(path), overrides=overrides, allow_code=allow_code)


@all_kept()
def parse_machine(
    text: str,
    file: str = "machine.yaml",
    *,
    overrides: Mapping[str, object] | None = None,
    allow_code: bool = False,
    known: Known | None = None,
) -> MachineRecord:
    """The machine in the YAML `text`, with all files it names, seen from the folder of `file`.

    Messages show the name `file`; its stem is the machine's default name. `known`: of another reading of the same file.
    Raises ModelError.
    """
    return Scope(text, file, Sources(allow_code).inside(file), overrides or {}).record(known)


def locate(text: str, path: str) -> tuple[int, int]:
    """Line and column, from 1, of the element `path` (`joints.hinge.axis`) in `text`, or of what is around it.

    Of an element that an assembly makes it is the place of the assembly, of one from another file that of `include`.
    """
    tree = read_tree(text, "")
    names = path.split(".") if path else []
    steps = _origin(tree, tuple(int(step) if step.isdecimal() else step for step in names))
    fault = tree.fault(steps, "")
    return fault.line, fault.column


def stands_in(text: str, path: str) -> bool:
    """Whether `text` itself says something at `path`, such as ``simulation.step``."""
    return tuple(path.split(".")) in read_tree(text, "").places


def _origin(tree: Tree, steps: Path) -> Path:
    """`steps`, or the path of what brings the element that they lead to into the file."""
    if len(steps) < 2 or steps[0] not in SECTIONS or steps[:2] in tree.places or not isinstance(tree.data, dict):
        return steps
    assemblies = tree.data.get("assemblies")
    prefixes = (
        {name: prefix_of(name, given) for name, given in assemblies.items()} if isinstance(assemblies, dict) else {}
    )
    fitting = [name for name, prefix in prefixes.items() if str(steps[1]).startswith(prefix)]
    if fitting:
        return ("assemblies", max(fitting, key=lambda each: len(prefixes[each])))
    return ("include",) if "include" in tree.data else steps


# in messages, which name a setting as `step`, or with what it is as `step: 1 ms`
SETTING = re.compile(r"`(\w+)(?:`|: ([^`]*)`)")

OUTSIDE = " (set from outside the file)"


class Origin(Struct):
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

    def with_settings(self, settings: Mapping[str, Any]) -> "Origin":
        """The same with these simulation settings given for a run."""
        return replace(self, given={**self.given, **settings})

    def edited(self) -> "Origin":
        """Of a machine whose elements were replaced: no file says any more what it is."""
        return replace(self, source="", outside=frozenset(), values={})

    @property
    def files(self) -> list[FilePath]:
        """Files that are read, and must not be written over."""
        return [FilePath(self.file)] if self.file else []

    @property
    def settings_outside(self) -> frozenset[str]:
        """Names of the simulation settings that were set from outside of the file."""
        return frozenset(path.split(".")[1] for path in self.outside if path.startswith("simulation."))

    def placed(self, fault: Fault) -> Fault:
        """`fault` with the place of its element in the file, if there is one, or how it came from outside of it."""
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
