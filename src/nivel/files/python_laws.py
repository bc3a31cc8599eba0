"""Laws that are Python functions: their text comes into the machine only for people who allow it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from nivel.files.outline import section_of
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree

WITH_LAWS: Final = ("drivers", "forces", "hydraulics", "states", "control", "sensors", "events")


def read_python_laws(tree: Tree, sources: Sources) -> None:
    """Put the text of `python: laws.py` into each law, as `source` and `file`. Faults go to `tree.faults`."""
    for section in WITH_LAWS:
        for path, law in list(_laws(section_of(tree, section), (section,))):
            _read(tree, sources, path, law)


def read_python_code(tree: Tree, sources: Sources, section: str, what: str) -> None:
    """The same for all mappings of one section of another file; `what` they are is said where code is not allowed."""
    for path, given in list(_laws(tree.data.get(section), (section,))):
        _read(tree, sources, path, given, what)


def _laws(value: Any, path: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Every mapping under `value` that holds Python code or names a file of it."""
    if isinstance(value, dict):
        if "python" in value or "source" in value:
            yield path, value
        for key, entry in value.items():
            yield from _laws(entry, (*path, key))
    elif isinstance(value, list):
        for at, entry in enumerate(value):
            yield from _laws(entry, (*path, at))


def _read(tree: Tree, sources: Sources, path: Path, law: dict[str, Any], what: str = "law") -> None:
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
    found = sources.text(tree, (*path, "python"), given)
    if found is None:
        tree.broken.add(path)
        return
    del law["python"]
    law["source"], law["file"] = found
    for place in ("source", "file"):
        _move(tree, (*path, "python"), (*path, place))


def _refuse(tree: Tree, path: Path, what: str, where: str) -> None:
    tree.report(path, f"this {what} runs Python code from {where}; say --allow-code if you trust it")
    tree.broken.add(path[:-1])


def _move(tree: Tree, origin: Path, target: Path) -> None:
    """What stands at `target` came from `origin`."""
    for places in (tree.places, tree.keys):
        if origin in places:
            places[target] = places[origin]
    if tree.is_outside(origin):
        tree.outside.add(target)
