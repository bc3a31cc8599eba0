"""Values set from outside the file: `--set bodies.crank.mass="22 kg"`."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from typing import Any, Final

from nivel.errors import Fault, ModelError
from nivel.files.tree import Path, Tree, read_value
from nivel.machine import MachineRecord
from nivel.machine.record import field_words, unknown_word
from nivel.machine.references import SECTIONS

TOP_WORDS: Final = ("format", "parameters", *field_words(MachineRecord))


def override(tree: Tree, overrides: Mapping[str, object]) -> None:
    """Put `overrides` into `tree`: path with dots → value, texts as they would stand in the file.

    Faults go to `tree.faults`.
    """
    for path, value in overrides.items():
        try:
            _set(tree, path, read_value(value) if isinstance(value, str) else deepcopy(value))
        except ModelError as error:
            messages = "; ".join(fault.message for fault in error.faults)
            tree.faults.append(Fault(tree.file, 0, 0, path, f"{messages} (set from outside the file)"))


def _set(tree: Tree, dotted: str, value: Any) -> None:
    steps = [step.strip() for step in dotted.split(".")]
    if not all(steps):
        raise ModelError(f"`{dotted}` is not a path such as `bodies.crank.mass` or `simulation.step`")
    if steps[0] not in TOP_WORDS:
        raise ModelError(unknown_word(steps[0], TOP_WORDS, "section"))
    if not isinstance(tree.data, dict):
        return  # reported when the file is read
    container, path = tree.data, ()
    for step in steps[:-1]:
        container, path = _enter(container, path, step)
    path = _put(container, path, steps[-1], value)
    for places in (tree.places, tree.keys):
        for inner in [each for each in places if each[: len(path)] == path]:
            del places[inner]
    tree.outside.add(path)


def _enter(container: Any, path: Path, step: str) -> tuple[Any, Path]:
    """What stands under `step`; an empty mapping where nothing stands yet."""
    key = _key(container, path, step)
    if container[key] is None:
        container[key] = {}
    return container[key], (*path, key)


def _put(container: Any, path: Path, step: str, value: Any) -> Path:
    key = _key(container, path, step)
    container[key] = value
    return (*path, key)


def _key(container: Any, path: Path, step: str) -> str | int:
    """The key or index `step` in `container`, made if it may be new."""
    place = ".".join(map(str, path))
    if isinstance(container, list):
        if not step.isdecimal() or int(step) >= len(container):
            raise ModelError(
                f"`{place}` is a list of {len(container)}; its entries are 0 to {len(container) - 1}, not `{step}`"
            )
        return int(step)
    if not isinstance(container, dict):
        raise ModelError(f"`{place}` is a single value and has no `{step}`")
    if step not in container and len(path) == 1 and path[0] in (*SECTIONS, "parameters"):
        raise ModelError(f"in `{place}`, {unknown_word(step, list(container), 'name')}")
    container.setdefault(step, None)
    return step
