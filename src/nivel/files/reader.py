"""Machine files: from YAML to records, with every fault and its place."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath

from nivel.files.known import Known
from nivel.files.outline import FORMAT
from nivel.files.overrides import prefix_of
from nivel.files.scope import read_scope
from nivel.files.sources import Sources, read_text
from nivel.files.tree import Path, Tree, read_tree
from nivel.machine.machine_record import MachineRecord
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
    return read_scope(text, file, Sources(allow_code).inside(file), overrides=overrides or {}, known=known)


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
