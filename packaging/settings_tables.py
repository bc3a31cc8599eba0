"""Tables of settings in pages of the documentation, from the records."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Final

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from settings_keywords import Keywords, absent_of, all_keywords, kind_of, meaning_of, option_of

TABLE: Final = re.compile(r"(<!-- table of (\w+): (\w+) -->\n\n).*?(\n\n<!-- end of table -->)", re.DOTALL)
SHORT, LONG = 30, 100  # characters of lists in a column, and behind a meaning; longer ones stand elsewhere


def with_tables(page: str) -> str:
    """A page whose tables between `<!-- table of keys: RunSettingsDict -->`, or of options, and `<!-- end of table -->` are current."""
    return TABLE.sub(lambda found: f"{found[1]}{_table(found[2], found[3]).replace('|  ', '| ')}{found[4]}", page)


def _table(of: str, name: str) -> str:
    (its,) = [each for each in all_keywords() if each.name == name]
    return "\n".join(_keys(its.fields) if of == "keys" else _options(its))


def _keys(fields: Mapping[str, FieldInfo]) -> Iterator[str]:
    """Rows for the keys of a section of a machine file."""
    yield "| key | unit | default | allowed | meaning |\n|---|---|---|---|---|"
    for name, field in fields.items():
        yield f"| `{name}` | {kind_of(field).unit} | {_default(field)} | {_allowed(field, SHORT)} | {meaning_of(field)} |"


def _options(keywords: Keywords) -> Iterator[str]:
    """Rows for the options of a command."""
    yield "| option | default | for |\n|---|---|---|"
    for name, field in keywords.fields.items():
        if option := option_of(name, field):
            words = f": {_allowed(field, LONG)}" if kind_of(field).words else ""
            default = "of the file" if keywords.of_file else _default(field)
            yield f"| `{option.split()[0]}` | {default} | {meaning_of(field)}{words} |"


def _default(field: FieldInfo) -> str:
    value, absent = field.default, absent_of(field)
    if absent or isinstance(value, bool) or value in (None, (), "", {}):
        return absent
    if isinstance(value, BaseModel):
        return ""
    return f"`{value}`" if isinstance(value, str) else f"{value:g}".replace("e-0", "e-")


def _allowed(field: FieldInfo, longest: int) -> str:
    """Words, where they are no longer than so many characters, or bounds."""
    words, kind = ", ".join(f"`{word}`" for word in kind_of(field).words), kind_of(field)
    if words:
        return words if len(words) <= longest else "see below"
    if kind.type.startswith("Mapping"):
        return "a mapping, see below"
    bounds = {
        key: getattr(mark, key) for mark in field.metadata for key in ("ge", "gt", "le", "lt") if hasattr(mark, key)
    }
    if {"gt", "lt"} <= bounds.keys():
        return f"between {bounds['gt']:g} and {bounds['lt']:g}"
    return "greater than 0" if kind.unit else ""
