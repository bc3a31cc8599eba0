"""Whether the bodies and markers that a machine mentions exist. Reads raw data too: one fault hides no other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from nivel.machine.record import GROUND, Record, entry

Place = tuple[str | int, ...]
SECTIONS = ("bodies", "markers", "joints", "forces")


def reference_faults(machine: Any) -> Iterator[tuple[Place, str]]:
    """Place and message of every name that is used twice or mentioned in vain. `machine` is a record, or what it is
    made of.
    """
    for section in SECTIONS:
        yield from _twice(section, _elements(machine, section))
    bodies = {name: name for name in _names(machine, "bodies")} | {GROUND: GROUND}
    markers = {
        str(name): entry(each, "body") for each in _elements(machine, "markers") if (name := entry(each, "name"))
    }
    for at, marker in enumerate(_elements(machine, "markers")):
        yield from _unknown(entry(marker, "body"), bodies, "body", ("markers", at, "body"))
        if isinstance(marker, Mapping | Record) and entry(marker, "name") is None:
            yield ("markers", at), "`name` is missing"
    for at, joint in enumerate(_elements(machine, "joints")):
        yield from _of_joint(joint, bodies, markers, ("joints", at))
    for at, force in enumerate(_elements(machine, "forces")):
        yield from _unknown(entry(force, "body"), bodies, "body", ("forces", at, "body"))
        marker = entry(force, "marker")
        yield from _unknown(marker, markers, "marker", ("forces", at, "marker"))
        if isinstance(marker, str) and markers.get(marker) == GROUND:
            yield ("forces", at, "marker"), f"the marker `{marker}` is on `{GROUND}`: a force there moves nothing"


def _of_joint(
    joint: Any, bodies: Mapping[str, str], markers: Mapping[str, Any], place: Place
) -> Iterator[tuple[Place, str]]:
    for at, body in enumerate(_list(entry(joint, "bodies"))):
        yield from _unknown(body, bodies, "body", (*place, "bodies", at))
    ends = _list(entry(joint, "markers"))
    for at, end in enumerate(ends):
        if isinstance(end, str):
            yield from _unknown(end, markers, "marker", (*place, "markers", at))
        else:
            yield from _unknown(entry(end, "body"), bodies, "body", (*place, "markers", at, "body"))
    on = [markers.get(end) if isinstance(end, str) else entry(end, "body") for end in ends]
    if len(on) == 2 and isinstance(on[0], str) and on[0] == on[1]:
        yield (*place, "markers"), f"both markers are on `{on[0]}`; a joint needs two different bodies"


def _unknown(name: Any, known: Mapping[str, Any], what: str, place: Place) -> Iterator[tuple[Place, str]]:
    if not isinstance(name, str) or name in known:
        return
    near = get_close_matches(name, known, n=1, cutoff=0.6)
    if near:
        hint = f"; did you mean `{near[0]}`?"
    else:
        hint = f"; there {'are' if len(known) > 1 else 'is'} {', '.join(known)}" if known else f"; there are no {what}s"
    yield place, f"there is no {what} `{name}`{hint}"


def _twice(section: str, elements: Sequence[Any]) -> Iterator[tuple[Place, str]]:
    seen: set[str] = set()
    for at, element in enumerate(elements):
        name = entry(element, "name")
        if isinstance(name, str) and name in seen:
            yield (section, at, "name"), f"the name `{name}` stands twice in {section}"
        elif isinstance(name, str):
            seen.add(name)


def _names(machine: Any, section: str) -> list[str]:
    return [name for each in _elements(machine, section) if isinstance(name := entry(each, "name"), str)]


def _elements(machine: Any, section: str) -> Sequence[Any]:
    return _list(entry(machine, section))


def _list(value: Any) -> Sequence[Any]:
    return value if isinstance(value, list | tuple) else ()
