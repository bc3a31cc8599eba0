"""Messages of a page, read strictly: a message is one of the records of `records.FROM_PAGE`, whole and within bounds, or it is refused."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, fields
from typing import Any, Final, get_args, get_origin, get_type_hints

from nivel.view.records import FROM_PAGE, FROM_SERVER, Command, Drive, Hold, Move, Reset, Shown, Take, Want

LARGEST: Final = 2048  # bytes of a message
LARGEST_NUMBER: Final = 2**32 - 1
LONGEST_NAME: Final = 512
MOST_NUMBERS: Final = 64  # of a list
_RECORDS: Final = {get_type_hints(record)["type"].__args__[0]: record for record in FROM_PAGE}


class NotUnderstoodError(Exception):
    """The message is none that a page sends."""


def read_message(content: str | bytes) -> Shown | Want | Move | Reset | Drive | Hold | Take | Command:
    """The record in a message.

    Raises NotUnderstoodError.
    """
    if not isinstance(content, str) or len(content) > LARGEST:
        raise NotUnderstoodError("a short text was expected")
    try:
        data = json.loads(content)
    except (ValueError, RecursionError):
        raise NotUnderstoodError("this is not JSON") from None
    kind = data.get("type") if isinstance(data, dict) else None
    record = _RECORDS.get(kind) if isinstance(kind, str) else None
    if record is None or set(data) != {field.name for field in fields(record)}:
        raise NotUnderstoodError("there is no such message")
    hints = get_type_hints(record)
    return record(**{name: _value(hints[name], value) for name, value in data.items()})


def _value(hint: Any, value: Any) -> Any:
    if hint is int:
        if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= LARGEST_NUMBER:
            raise NotUnderstoodError("a number from zero on was expected")
    elif hint is float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise NotUnderstoodError("a number was expected")
        value = _float(value)
    elif get_origin(hint) is list:
        if not isinstance(value, list) or len(value) > MOST_NUMBERS:
            raise NotUnderstoodError("a short list was expected")
        value = [_value(get_args(hint)[0], each) for each in value]
    elif not isinstance(value, str) or len(value) > LONGEST_NAME:
        raise NotUnderstoodError("a name was expected")
    return value


def _float(value: float) -> float:
    try:
        value = float(value)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        raise NotUnderstoodError("a finite number was expected")
    return value


def said(record: Any) -> str:
    """A record of the server as the text of a message."""
    if not isinstance(record, FROM_SERVER):
        raise TypeError(f"{type(record).__name__} is not a message of the server")
    return json.dumps(asdict(record), allow_nan=False)
