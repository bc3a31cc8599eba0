"""The records of `records.py` and `local.py` for the page: `python -m nivel.view.typescript FILE` writes them.

A test checks that FILE is current."""

import sys
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Final, Literal, Union, get_args, get_origin, get_type_hints

from nivel.view import local, records

PLAIN: Final = {str: "string", int: "number", float: "number", bool: "boolean", NoneType: "null"}
NUMBERS: Final = ("PROTOCOL", "PACKAGE", "FRAME", "SAMPLES", "COLUMN", "TABLE", "MOVES")


def typescript() -> str:
    """All records as TypeScript interfaces, the numbers of the protocol as constants, and what either side may say as unions."""
    lines = ["// Written by `python -m nivel.view.typescript` from records.py and local.py. Do not edit.", ""]
    lines += [f"export const {name} = {getattr(records, name)};" for name in NUMBERS]
    for record in (*vars(records).values(), *vars(local).values()):
        if isinstance(record, type) and is_dataclass(record):
            lines += ["", *_interface(record)]
    for name, members in (("FromServer", records.FROM_SERVER), ("FromPage", records.FROM_PAGE + records.WITHIN_PAGE)):
        lines += ["", f"export type {name} = {' | '.join(member.__name__ for member in members)};"]
    return "\n".join([*lines, ""])


def _interface(record: type) -> list[str]:
    hints = get_type_hints(record)
    said = " ".join((record.__doc__ or "").split())
    members = [f"  {each.name}: {_type(hints[each.name])};" for each in fields(record)]
    return [f"/** {said} */", f"export interface {record.__name__} {{", *members, "}"]


def _type(hint: Any) -> str:
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Literal:
        return " | ".join(f'"{word}"' if isinstance(word, str) else str(word) for word in arguments)
    if origin is list:
        inner = _type(arguments[0])
        return f"({inner})[]" if "|" in inner else f"{inner}[]"
    if origin is tuple:
        return f"[{', '.join(map(_type, arguments))}]"
    if origin in (Union, UnionType):
        return " | ".join(map(_type, arguments))
    return PLAIN.get(hint) or hint.__name__


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(typescript(), encoding="utf-8")
