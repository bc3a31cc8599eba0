"""An instance of a part: its elements with a prefix before every name, and before every mention of one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from nivel.files.substitution import Linear, NotRepresentableError, same, substituted
from nivel.machine.core.record import GROUND, Record, entry
from nivel.machine.laws.time_function import Expression, PythonLaw, Table

# fields that hold names of elements, `JOINT.COORDINATE`, or lists of them; where they hold numbers these stay
MENTIONS: Final = (
    "body",
    "bodies",
    "marker",
    "markers",
    "relative_to",
    "plane",
    "planes",
    "between",
    "joints",
    "coordinate",
    "against",
    "coupling",
    "coordinates",
    "force",
    "distance",
    "angle",
    "event",
    "ports",
    "valves",
    "fluid",
)

Elements = Mapping[str, Sequence[Record]]


def renamed(elements: Elements, prefix: str) -> dict[str, tuple[Record, ...]]:
    """`elements` by section, with `prefix` before all their names. `ground` stays `ground`.

    Raises NotRepresentableError where the prefix cannot be written in an expression.
    """
    if not prefix:
        return {section: tuple(records) for section, records in elements.items()}
    return {section: tuple(_element(record, prefix) for record in records) for section, records in elements.items()}


def _element(record: Record, prefix: str) -> Record:
    name = entry(record, "name")
    try:
        return _record(record, prefix, {"name": f"{prefix}{name}"})
    except NotRepresentableError as error:
        raise NotRepresentableError(f"{record.collection}.{name}: {error}") from None


def _record(record: Record, prefix: str, changes: dict[str, Any]) -> Record:
    """`record` with `changes` and with all its mentions renamed."""
    for field in sorted(record.model_fields_set - {"name"}):
        value = getattr(record, field)
        new = _mention(value, prefix) if field in MENTIONS else _value(value, prefix)
        if new is not value:
            changes[field] = new
    return record.replace(**changes) if changes else record


def _mention(value: Any, prefix: str) -> Any:
    if isinstance(value, str):
        return value if value == GROUND else f"{prefix}{value}"
    if isinstance(value, tuple):
        return tuple(_mention(each, prefix) for each in value)
    if isinstance(value, dict):
        return {key: _mention(each, prefix) for key, each in value.items()}
    return _value(value, prefix)


def _value(value: Any, prefix: str) -> Any:
    """What is no mention itself: functions with signals, records with mentions in them."""
    match value:
        case Expression() if value.signals and "-" in prefix:
            raise NotRepresentableError(
                f"names that start with `{prefix}` cannot be used in `{value.text}`, where `-` is a minus sign; "
                "give a `prefix` without it"
            )
        case Expression() | Table() | PythonLaw():
            return substituted(value, lambda path: _prefixed(path, prefix))
        case Record():
            return _record(value, prefix, {})
        case tuple() if any(isinstance(each, Expression | Table | PythonLaw | Record) for each in value):
            return tuple(_value(each, prefix) for each in value)
    return value


def _prefixed(path: str, prefix: str) -> Linear:
    return same(f"{prefix}{path}")
