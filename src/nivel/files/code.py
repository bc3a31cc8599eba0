"""Code that a machine file names: units of control in C or FMUs, and laws in Python, which are read for people who allow it only."""

from collections.abc import Iterator
from typing import Any, Final

from nivel.errors import ModelError
from nivel.files.outline import section_of
from nivel.files.sources import Sources, resolved
from nivel.files.tree import Path, Tree
from nivel.lazy import nivel

# another word for the time between samples, as states have it
EVERY, SAMPLE_TIME = "every", "sample_time"
LIBRARIES: Final = (".c", ".so", ".dll", ".dylib")
UNITS: Final = ("fmu", "c")
NAMED: Final = ("inputs", "outputs", "parameters")


def read_unit_blocks(tree: Tree, sources: Sources) -> None:
    """Check the file of each block of the types `fmu` and `c`, and put its whole path into the block. Faults go to `tree.faults`."""
    for name, block in section_of(tree, "control").items():
        if isinstance(block, dict) and block.get("type") in UNITS:
            _read(tree, sources, ("control", name), block)


def _read(tree: Tree, sources: Sources, path: Path, block: dict[str, Any]) -> None:
    if EVERY in block:
        if SAMPLE_TIME in block:
            tree.report((*path, EVERY), f"give `{EVERY}` or `{SAMPLE_TIME}`, not both", at_key=True)
        block[SAMPLE_TIME] = block.pop(EVERY)
        _move(tree, (*path, EVERY), (*path, SAMPLE_TIME))
    if "file" not in block:
        return
    given = block["file"]
    if not sources.allow_code:
        what = given if isinstance(given, str) else "a file"
        message = f"this block runs the machine code of {what}; say --allow-code if you trust it"
        tree.report((*path, "file"), message, breaks=path)
        return
    found = sources.content(tree, (*path, "file"), given, breaks=path)
    if found is None:
        return
    content, file = found
    if block["type"] == "fmu":
        _look_up(tree, path, block, content, file)
    elif not file.endswith(LIBRARIES):
        message = f"a shared library ({', '.join(LIBRARIES[1:])}) or a C file (.c) was expected, got `{given}`"
        tree.report((*path, "file"), message, breaks=path)
    block["file"] = str(resolved(file))


def _look_up(tree: Tree, path: Path, block: dict[str, Any], content: bytes, file: str) -> None:
    """Whether the file is an FMU with the variables that the block names."""
    # archives take some milliseconds to import
    try:
        description = nivel.files.fmu_file.read_description(content, file)
    except ModelError as error:
        for fault in error.faults:
            tree.report((*path, "file"), f"`{file}`: {fault.message}", breaks=path)
        return
    for key, message in nivel.files.fmu_file.unknown_variables(
        description, *(_variables(block, each) for each in NAMED)
    ):
        tree.report((*path, key), message, breaks=path)


def _variables(block: dict[str, Any], key: str) -> list[str]:
    """Variables of the unit that a key of a block names; of outputs by one's own name, and in records of a written machine, what stands
    there."""
    given = block.get(key) or {}
    if isinstance(given, dict):
        return [str(each) for each in (given.values() if key == "outputs" else given)]
    if not isinstance(given, list):
        return []
    return [str(each.get("variable")) if isinstance(each, dict) else str(each) for each in given]


WITH_LAWS: Final = ("drivers", "forces", "hydraulics", "states", "control", "sensors", "events")


def read_python_laws(tree: Tree, sources: Sources) -> None:
    """Put the text of `python: laws.py` into each law, as `source` and `file`. Faults go to `tree.faults`."""
    for section in WITH_LAWS:
        for path, law in list(mappings_with(("python", "source"), section_of(tree, section), (section,))):
            _read_law(tree, sources, path, law)


def read_python_code(tree: Tree, sources: Sources, section: str, what: str) -> None:
    """The same for all mappings of one section of another file; `what` they are is said where code is not allowed."""
    for path, given in list(mappings_with(("python", "source"), tree.data.get(section), (section,))):
        _read_law(tree, sources, path, given, what)


def mappings_with(keys: tuple[str, ...], value: Any, path: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Every mapping under `value`, which stands at `path`, that has one of the keys, and where it stands."""
    if isinstance(value, dict):
        if not value.keys().isdisjoint(keys):
            yield path, value
        for key, entry in value.items():
            yield from mappings_with(keys, entry, (*path, key))
    elif isinstance(value, list):
        for at, entry in enumerate(value):
            yield from mappings_with(keys, entry, (*path, at))


def _read_law(tree: Tree, sources: Sources, path: Path, law: dict[str, Any], what: str = "law") -> None:
    if "source" in law:
        if "python" in law:
            tree.report((*path, "python"), "give `python` (a file) or `source` (its text), not both", at_key=True)
        elif not sources.allow_code:
            _refuse(tree, (*path, "source"), what, "its `source`")
        return
    given = law["python"]
    if not sources.allow_code:
        _refuse(tree, (*path, "python"), what, str(given) if isinstance(given, str) else "a file")
        return
    found = sources.text(tree, (*path, "python"), given, breaks=path)
    if found is None:
        return
    del law["python"]
    law["source"], law["file"] = found
    for place in ("source", "file"):
        _move(tree, (*path, "python"), (*path, place))


def _refuse(tree: Tree, path: Path, what: str, where: str) -> None:
    message = f"this {what} runs Python code from {where}; say --allow-code if you trust it"
    tree.report(path, message, breaks=path[:-1])


def _move(tree: Tree, origin: Path, target: Path) -> None:
    """What stands at `target` came from `origin`."""
    for places in (tree.places, tree.keys):
        if origin in places:
            places[target] = places[origin]
    if tree.is_outside(origin):
        tree.outside.add(target)
