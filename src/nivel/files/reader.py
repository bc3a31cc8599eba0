"""Machine files: from YAML to records, with every fault and its place."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any, Final

from pydantic import ValidationError

from nivel.errors import Fault, ModelError
from nivel.files.overrides import override
from nivel.files.tree import Path, Tree, read_tree
from nivel.machine import MachineRecord
from nivel.machine.parameters import resolve
from nivel.machine.quantity import FAULT, shown
from nivel.machine.references import SECTIONS

FORMAT: Final = 1


def read_machine(path: str | FilePath, *, overrides: Mapping[str, object] | None = None) -> MachineRecord:
    """The machine in the YAML file at `path`. `overrides`: values by path, e.g. ``{"bodies.crank.mass": "22 kg"}``.

    Raises ModelError with everything that is wrong, each with file, line and column.
    """
    return parse_machine(read_text(path), str(path), overrides=overrides)


def parse_machine(
    text: str, file: str = "machine.yaml", *, overrides: Mapping[str, object] | None = None
) -> MachineRecord:
    """The machine in the YAML `text`. Messages show the name `file`; its stem is the machine's default name.

    Raises ModelError.
    """
    tree = read_tree(text, file)
    override(tree, overrides or {})
    broken = _check_outline(tree)
    parameters, faults = resolve(_section(tree, "parameters"))
    tree.faults += [tree.fault(("parameters", name), message) for name, message in faults.items()]
    names = {section: list(_section(tree, section)) for section in SECTIONS}
    try:
        record = MachineRecord.model_validate(_as_lists(tree), context={"parameters": parameters})
    except ValidationError as error:
        for line in error.errors(include_url=False):
            path = _path_in_file(line["loc"], names)
            if line["type"] == FAULT and path[:2] not in broken:
                at_key = bool(line.get("ctx", {}).get("at_key"))
                tree.faults.append(tree.fault(path, line["msg"], at_key=at_key))
        raise ModelError(tree.faults) from None
    if tree.faults:
        raise ModelError(tree.faults)
    return record


def locate(text: str, path: str) -> tuple[int, int]:
    """Line and column, from 1, of the element `path` (`joints.hinge.axis`) in `text`, or of what is around it."""
    tree = read_tree(text, "")
    names = path.split(".") if path else []
    steps = tuple(int(step) if step.isdecimal() else step for step in names)
    fault = tree.fault(steps, "")
    return fault.line, fault.column


def read_text(path: str | FilePath) -> str:
    """The text of the file at `path`.

    Raises ModelError where it cannot be read, or is not UTF-8.
    """
    file = str(path)
    try:
        content = FilePath(path).read_bytes()
    except FileNotFoundError:
        raise ModelError(Fault(file, 0, 0, file, "there is no such file")) from None
    except IsADirectoryError:
        raise ModelError(Fault(file, 0, 0, file, "this is a directory; a machine file was expected")) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ModelError(Fault(file, 0, 0, file, f"the file cannot be read: {reason}")) from None
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, error.start - (before.rfind(b"\n") + 1) + 1
        message = f"the file is not UTF-8 text: the byte 0x{content[error.start]:02x} stands here; save it as UTF-8"
        raise ModelError(Fault(file, line, column, "", message)) from None


def _check_outline(tree: Tree) -> set[Path]:
    """Refuse what is no machine file at all; collect faults of the sections. Returns the elements that are none.

    Raises ModelError.
    """
    if tree.data is None:
        raise ModelError(
            [*tree.faults, Fault(tree.file, 1, 1, "", "the file is empty; `nivel new` writes one to start from")]
        )
    if not isinstance(tree.data, dict):
        message = f"a machine file is a mapping that starts with `format: {FORMAT}`, not {shown(tree.data)}"
        raise ModelError([*tree.faults, tree.fault((), message)])
    _check_format(tree)
    return set().union(*(_check_section(tree, section) for section in (*SECTIONS, "parameters")))


def _check_format(tree: Tree) -> None:
    if "format" not in tree.data:
        tree.faults.append(tree.fault((), f"`format: {FORMAT}` is missing"))
        return
    given = tree.data.pop("format")
    if given != FORMAT or isinstance(given, bool):
        message = f"this nivel reads format {FORMAT}, not {shown(given)}"
        raise ModelError([*tree.faults, tree.fault(("format",), message)])


def _check_section(tree: Tree, section: str) -> set[Path]:
    """A section is a mapping of names to mappings. What is not is reported and emptied, so that the rest can be read;
    elements to which that happened are returned.
    """
    content = tree.data.get(section)
    if not isinstance(content, dict):
        if content is not None:
            message = f"a mapping from names to what they are was expected, got {shown(content)}"
            tree.faults.append(tree.fault((section,), message))
        if section in tree.data:
            tree.data[section] = {}
        return set()
    if section == "parameters":
        return set()
    return {(section, name) for name in content if not _check_element(tree, content, section, name)}


def _check_element(tree: Tree, content: dict[str, Any], section: str, name: str) -> bool:
    """Whether the element is a mapping; nothing (`crank:` alone) is an empty one."""
    element = content[name]
    if isinstance(element, dict):
        if element.pop("name", None) is not None:
            message = f"the name is the key `{name}`; `name` must not be given"
            tree.faults.append(tree.fault((section, name, "name"), message))
        return True
    content[name] = {}
    if element is not None:
        tree.faults.append(tree.fault((section, name), f"a mapping was expected, got {shown(element)}"))
    return element is None


def _section(tree: Tree, section: str) -> dict[str, Any]:
    return tree.data.get(section) or {}


def _as_lists(tree: Tree) -> dict[str, Any]:
    """The data of the record: lists of elements with names, instead of mappings by name."""
    data = {"name": FilePath(tree.file).stem or "machine", **tree.data}
    data.pop("parameters", None)
    if "simulation" in data and data["simulation"] is None:
        del data["simulation"]
    for section in SECTIONS:
        if section in data:
            data[section] = [{"name": name, **element} for name, element in data[section].items()]
    data.setdefault("bodies", [])
    return data


def _path_in_file(location: tuple[int | str, ...], names: Mapping[str, list[str]]) -> Path:
    """A place in the record as a place in the file: names instead of numbers in the sections."""
    if len(location) < 2 or location[0] not in names or not isinstance(location[1], int):
        return location
    rest = () if location[2:] == ("name",) else location[2:]
    return (location[0], names[str(location[0])][location[1]], *rest)
