"""Values set from outside the file: `--set bodies.crank.mass="22 kg"`."""

from collections.abc import Mapping
from copy import deepcopy
from difflib import get_close_matches
from itertools import pairwise
from math import isfinite
from numbers import Real
from typing import Any

from nivel.errors import Fault, ModelError
from nivel.files.outline import FILE_WORDS, TOP_WORDS, section_of
from nivel.files.tree import Path, Tree, read_value
from nivel.machine.core.record import unknown_word
from nivel.machine.parameters import resolve
from nivel.machine.units.tree import Number
from nivel.machine.uses.references import SECTIONS

# moments of inertia about the body's axes, as places in a list
MOMENTS = ("xx", "yy", "zz")
# vectors of bodies that are zero where they are not written
RATES = ("velocity", "angular_velocity", "angular_velocity_body")


def in_order(overrides: Mapping[str, object]) -> tuple[dict[str, object], dict[str, object], dict[str, object]]:
    """Those about the file and what it includes; those that name files of mass properties; and the others. Each group
    can be set once the files are read that the group before names.
    """
    groups: tuple[dict[str, object], ...] = ({}, {}, {})
    for path, value in overrides.items():
        steps = [step.strip() for step in path.split(".")]
        groups[0 if steps[0] in ("format", "include") else 1 if steps[-1] == "mass_properties" else 2][path] = value
    return groups[0], groups[1], groups[2]


def override(
    tree: Tree, overrides: Mapping[str, object], *, words: tuple[str, ...] = (*TOP_WORDS, *FILE_WORDS)
) -> None:
    """Put `overrides` into `tree`: path with dots → value, texts as they would stand in the file. `words`: its sections.

    What is about an element of an assembly's part is left in `tree.for_parts`. Faults go to `tree.faults`.
    """
    for path, value in overrides.items():
        try:
            steps = _with_section(tree.data, [step.strip() for step in path.split(".")], words)
            assembly = _assembly(tree, steps)
            if assembly is None:
                _set(tree, path, steps, read_value(value) if isinstance(value, str) else deepcopy(value), words)
            else:
                name, inner = assembly
                tree.for_parts.setdefault(name, {})[inner] = value
        except ModelError as error:
            messages = "; ".join(fault.message for fault in error.faults)
            tree.faults.append(Fault(tree.file, 0, 0, path, f"{messages} (set from outside the file)"))


def with_units(tree: Tree, overrides: Mapping[str, object]) -> dict[str, object]:
    """`overrides`, in which numbers are in SI units: those of parameters get the unit that these have in the file."""
    places = {path: [step.strip() for step in path.split(".")] for path in overrides}
    numbers = [path for path, value in overrides.items() if isinstance(value, Real) and not isinstance(value, bool)]
    of_parameters = [path for path in numbers if len(places[path]) == 2 and places[path][0] == "parameters"]
    if not of_parameters:
        return dict(overrides)
    known, _ = resolve(section_of(tree, "parameters"))
    out = dict(overrides)
    for path in of_parameters:
        value, present = float(overrides[path]), known.get(places[path][1])  # type: ignore[arg-type]
        if present is not None and present.dimension is not None and isfinite(value):
            out[path] = Number(value, present.dimension)
    return out


def _with_section(data: Any, steps: list[str], words: tuple[str, ...]) -> list[str]:
    """`steps` with their section before them, where they begin with the name of an element."""
    if steps[0] in words or not isinstance(data, dict):
        return steps
    named = {section: list(data[section]) for section in SECTIONS if isinstance(data.get(section), dict)}
    sections = [section for section, names in named.items() if steps[0] in names]
    if len(sections) > 1:
        listed = " or ".join(f"`{section}.{'.'.join(steps)}`" for section in sections)
        raise ModelError(f"several elements are called `{steps[0]}`: write {listed}")
    if sections:
        return [sections[0], *steps]
    names = [str(name) for each in named.values() for name in each]
    if steps[0] and len(steps) > 1 and get_close_matches(steps[0], names) and not get_close_matches(steps[0], words):
        raise ModelError(unknown_word(steps[0], names, "element"))
    return steps


def _assembly(tree: Tree, steps: list[str]) -> tuple[str, str] | None:
    """The assembly that makes the element which `steps` lead to, and the path in its part; None if this file has the
    element itself.
    """
    if len(steps) < 3 or steps[0] not in SECTIONS or not isinstance(tree.data, dict):
        return None
    own, assemblies = tree.data.get(steps[0]), tree.data.get("assemblies")
    if not isinstance(assemblies, dict) or (isinstance(own, dict) and steps[1] in own):
        return None
    prefixes = {name: prefix_of(name, given) for name, given in assemblies.items()}
    fitting = [name for name, prefix in prefixes.items() if steps[1].startswith(prefix) and steps[1] != prefix]
    if not fitting:
        return None
    name = max(fitting, key=lambda each: len(prefixes[each]))
    return name, ".".join([steps[0], steps[1].removeprefix(prefixes[name]), *steps[2:]])


def prefix_of(name: str, given: Any) -> str:
    """What stands before the names of the elements that the assembly `name` makes."""
    prefix = given.get("prefix") if isinstance(given, dict) else None
    return prefix if isinstance(prefix, str) else f"{name}_"


def _set(tree: Tree, dotted: str, steps: list[str], value: Any, words: tuple[str, ...]) -> None:
    if not all(steps):
        raise ModelError(f"`{dotted}` is not a path such as `bodies.crank.mass` or `simulation.step`")
    if steps[0] not in words:
        raise ModelError(unknown_word(steps[0], words, "section"))
    if not isinstance(tree.data, dict):
        return  # reported when the file is read
    container, path = tree.data, ()
    for step, following in pairwise(steps):
        container, path = _enter(container, path, step, following)
    path = _put(container, path, steps[-1], value)
    for places in (tree.places, tree.keys):
        for inner in [each for each in places if each[: len(path)] == path]:
            del places[inner]
    tree.outside.add(path)


def _enter(container: Any, path: Path, step: str, following: str) -> tuple[Any, Path]:
    """What stands under `step`; where nothing stands yet an empty mapping, or the list in which `following` is a place."""
    key = _key(container, path, step)
    if container[key] is None:
        container[key] = _unwritten(container, path, step) if following.isdecimal() else {}
    return container[key], (*path, key)


def _unwritten(container: Any, path: Path, step: str) -> list[float]:
    """The entries of a list that is not written, where they are known to be zero."""
    if path == () and step == "gravity":
        return [0.0, 0.0, 0.0]
    if len(path) == 2 and path[0] == "bodies" and step in RATES:
        return [0.0, 0.0, 0.0]
    del container[step]
    place = ".".join(map(str, (*path, step)))
    raise ModelError(
        f"`{place}` is not written in the file, so it has no entries: write `{step}: [0, 0, 0]` with its values"
    )


def _put(container: Any, path: Path, step: str, value: Any) -> Path:
    key = _key(container, path, step)
    container[key] = value
    return (*path, key)


def _key(container: Any, path: Path, step: str) -> str | int:
    """The key or index `step` in `container`, made if it may be new."""
    place = ".".join(map(str, path))
    if isinstance(container, list):
        if path[-1:] == ("inertia",) and len(container) == 3 and step in MOMENTS:
            return MOMENTS.index(step)
        if not step.isdecimal() or int(step) >= len(container):
            raise ModelError(
                f"`{place}` is a list of {len(container)}; its entries are 0 to {len(container) - 1}, not `{step}`"
            )
        return int(step)
    if not isinstance(container, dict):
        raise ModelError(f"`{place}` is a single value and has no `{step}`")
    if step not in container and len(path) == 1 and path[0] in (*SECTIONS, "parameters", "functions", "assemblies"):
        raise ModelError(f"in `{place}`, {unknown_word(step, list(container), 'name')}")
    container.setdefault(step, None)
    return step
