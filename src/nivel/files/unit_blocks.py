"""Blocks that are FMUs and C functions: their files are read only for people who allow it, and variables of FMUs are looked up."""

from __future__ import annotations

from typing import Any, Final

from nivel.errors import ModelError
from nivel.files.outline import section_of
from nivel.files.sources import Sources, resolved
from nivel.files.tree import Path, Tree

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
        for places in (tree.places, tree.keys):
            if (*path, EVERY) in places:
                places[*path, SAMPLE_TIME] = places[*path, EVERY]
    if "file" not in block:
        return
    given = block["file"]
    if not sources.allow_code:
        what = given if isinstance(given, str) else "a file"
        tree.report((*path, "file"), f"this block runs the machine code of {what}; say --allow-code if you trust it")
        tree.broken.add(path)
        return
    found = sources.content(tree, (*path, "file"), given)
    if found is None:
        tree.broken.add(path)
        return
    content, file = found
    if block["type"] == "fmu":
        _look_up(tree, path, block, content, file)
    elif not file.endswith(LIBRARIES):
        tree.report(
            (*path, "file"),
            f"a shared library ({', '.join(LIBRARIES[1:])}) or a C file (.c) was expected, got `{given}`",
        )
        tree.broken.add(path)
    block["file"] = str(resolved(file))


def _look_up(tree: Tree, path: Path, block: dict[str, Any], content: bytes, file: str) -> None:
    """Whether the file is an FMU with the variables that the block names."""
    # archives take some milliseconds to import
    from nivel.files.fmu_file import read_description, unknown_variables

    try:
        description = read_description(content, file)
    except ModelError as error:
        for fault in error.faults:
            tree.report((*path, "file"), f"`{file}`: {fault.message}")
        tree.broken.add(path)
        return
    for key, message in unknown_variables(description, *(_variables(block, each) for each in NAMED)):
        tree.report((*path, key), message)
        tree.broken.add(path)


def _variables(block: dict[str, Any], key: str) -> list[str]:
    """Variables of the unit that a key of a block names; of outputs by one's own name, and in records of a written machine, what stands
    there."""
    given = block.get(key) or {}
    if isinstance(given, dict):
        return [str(each) for each in (given.values() if key == "outputs" else given)]
    if not isinstance(given, list):
        return []
    return [str(each.get("variable")) if isinstance(each, dict) else str(each) for each in given]
