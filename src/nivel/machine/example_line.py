"""The line that would be right where a list or a mapping was expected and something else stands."""

import re
from collections.abc import Mapping
from typing import Any, Final

from nivel.machine.units.unit import UNITS
from nivel.words.vocabulary import plain

# of fields that are lists: an entry that shows what is meant
_LISTS: Final = {
    "gravity": "[0, 0, -9.81]",
    "axis": "[0, 0, 1]",
    "x_axis": "[1, 0, 0]",
    "axes": "[[0, 1, 0], [0, 0, 1]]",
    "bodies": "[ground, BODY]",
    "markers": "[FIRST, SECOND]",
    "points": "[[0, 0, 0], [1, 0, 0]]",
    "vector": "[10 N, 0, 0]",
    "times": "[0, 1, 2]",
    "values": "[0, 5, 0]",
    "cut": "[JOINT]",
    "euler_parameters": "[1, 0, 0, 0]",
    "euler": "[30 deg, 0, 0]",
    "joints": "[FIRST, SECOND]",
}
_MAPPINGS: Final = {
    "orientation": "{euler: [0, 0, 90 deg], sequence: xyz}",
    "shape": "{type: box, from: [0, 0, 0], to: [1, 0, 0], width: 5 cm, height: 5 cm}",
    "start": "{angle: 30 deg}",
    "start_rates": "{angle: 2 rad/s}",
    "simulation": "{duration: 5 s, step: 1 ms}",
    "baumgarte": "{alpha: 10, beta: 10}",
    "section": "{type: circle, radius: 1 cm}",
    "material": "{youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}",
}
_COUNTS: Final = {"bodies": 2, "markers": 2, "joints": 2}  # entries of lists; three of others
_WORDS: Final = {"coordinate": "JOINT.angle"}
# of sections: the key of an element that a single value most likely means
_MAIN_KEYS: Final = {"inputs": "rest", "sensors": "value", "states": "rate", "events": "when"}
_OF_COORDINATES: Final = {"coordinatevalues": "start", "coordinaterates": "start_rates"}  # what they are read as
_ANGULAR: Final = r"\b(?:deg|rad|rev|rpm)\b|°"
_DIRECTIONS: Final = {
    **{"x": "[1, 0, 0]", "y": "[0, 1, 0]", "z": "[0, 0, 1]"},
    **{"-x": "[-1, 0, 0]", "-y": "[0, -1, 0]", "-z": "[0, 0, -1]"},
}


def list_line(field: str, given: Any) -> str:
    """``; write `gravity: [0, 0, -9.81]` …`` for a field that is a list; empty where nothing better is known."""
    entries = _entries(field, given)
    if field == "gravity" and entries is None:
        size = _size(given) or "9.81"
        return f"; gravity has a direction: write `gravity: [0, 0, -{size}]` where z points up, `[0, -{size}, 0]` where y does"
    line = entries or _LISTS.get(field)
    if field == "angular_velocity" and line is None and isinstance(given, int | float | str):
        line = f"[0, 0, {given}]"
    if field in ("point", "points") and line is None and isinstance(given, str):
        return f"; it is a place in numbers; where two markers are known by name write `markers: [FIRST, {given}]`"
    return f"; write `{field}: {line}`" if line else ""


def mapping_line(field: str, given: Any) -> str:
    """As `list_line`, of a field that is a mapping."""
    if field == "shape" and isinstance(given, str):
        return f"; write `shape: {{type: {given}, …}}`"
    if field in _OF_COORDINATES:
        return _coordinates_line(_OF_COORDINATES[field], given)
    if field == "orientation" and isinstance(given, int | float | str) and re.match(r"-?[\d.]", str(given)):
        return f"; write `orientation: {{axis: [0, 0, 1], angle: {given}}}`"
    if field == "orientation" and isinstance(given, list | tuple) and len(given) == 4:
        return f"; write `orientation: {{euler_parameters: {_listed(given)}}}`, scalar first"
    if field == "orientation" and isinstance(given, list | tuple) and len(given) == 3:
        return f"; write `orientation: {{euler: {_listed(given)}, sequence: xyz}}`, or another sequence of axes"
    return f"; write `{field}: {_MAPPINGS[field]}`" if field in _MAPPINGS else ""


def _coordinates_line(field: str, given: Any) -> str:
    """The values of joint coordinates, of which the name was left out."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        return f"; write `{field}: {_MAPPINGS[field]}`"
    angle, way = f"`{field}: {{angle: {given}}}`", f"`{field}: {{displacement: {given}}}`"
    if not isinstance(given, str):
        return f"; write {angle} of a revolute, {way} of a translational joint"
    return f"; write {angle if re.search(_ANGULAR, given) else way}"


def element_line(section: str, name: str, given: Any) -> str:
    """As `list_line`, of an element of a section: ``; write `lever: {rest: 0}` ``."""
    key = _MAIN_KEYS.get(section)
    if section == "markers" and isinstance(given, list | tuple) and len(given) == 3:
        return f"; write `{name}: {{body: BODY, position: {_listed(given)}}}`"
    if isinstance(given, str):
        given = re.sub(r"\.position\.([xyz])\b", r".\1", given)  # places are read as BODY.x, velocities as BODY.vx
        given = re.sub(r"\.velocity\.([xyz])\b", r".v\1", given)
    return f"; write `{name}: {{{key}: {given}}}`" if key and not isinstance(given, list | tuple) else ""


def missing_line(field: str) -> str:
    """As `list_line`, of a field that is not given: ``: write `coordinate: JOINT.angle` ``."""
    line = _LISTS.get(field) or _MAPPINGS.get(field) or _WORDS.get(field)
    return f"; write `{field}: {line}`" if line else ""


def _entries(field: str, given: Any) -> str | None:
    """What was given, as a list, where that is what was meant."""
    if isinstance(given, Mapping) and given and set(given) <= set("xyz"):
        return _listed([given.get(axis, 0) for axis in "xyz"])
    if (
        isinstance(given, Mapping)
        and len(given) == _COUNTS.get(field, 3)
        and all(each is None for each in given.values())
    ):
        return _listed(list(given))  # braces in place of brackets
    if not isinstance(given, str):
        return None
    letter = given.strip().removeprefix("+").casefold()
    if field in ("axis", "x_axis") and letter in _DIRECTIONS:
        return _DIRECTIONS[letter]
    words = given.replace(",", " ").split()
    if field in ("bodies", "markers", "joints") and len(words) == 2:
        return _listed(words)
    if field == "bodies" and len(words) == 1:
        return f"[ground, {words[0]}]"
    if field in ("point", "position") and plain(given) in ("origin", "centre", "center", "zero"):
        return "[0, 0, 0]"
    return _listed(words) if len(words) == 3 and not any(word in UNITS for word in words) else None


def _listed(entries: list[Any] | tuple[Any, ...]) -> str:
    return f"[{', '.join(map(str, entries))}]"


def _size(given: Any) -> str:
    """The size of gravity that was given as a number, with its unit."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        return ""
    size = str(given).strip().lstrip("+-").strip()
    return size if size[:1].isdigit() else ""
