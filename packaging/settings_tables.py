"""Tables of settings in pages of the documentation, from the records."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from settings_keywords import Keywords, absent_of, all_keywords, kind_of, meaning_of, option_of

TABLE: Final = re.compile(r"(<!-- table of (\w+): (\w+) -->\n\n).*?(\n\n<!-- end of table -->)", re.DOTALL)
MOST_WORDS: Final = 6  # longer lists stand elsewhere


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
        yield f"| `{name}` | {kind_of(field).unit} | {_default(field)} | {_allowed(field)} | {meaning_of(field)} |"


def _options(keywords: Keywords) -> Iterator[str]:
    """Rows for the options of a command."""
    yield "| option | default | for |\n|---|---|---|"
    for name, field in keywords.fields.items():
        if option := option_of(name, field):
            words = f": {_allowed(field)}" if kind_of(field).words else ""
            default = "of the file" if keywords.of_file else _default(field)
            yield f"| `{option.split()[0]}` | {default} | {meaning_of(field)}{words} |"


def _default(field: FieldInfo) -> str:
    value, absent = field.default, absent_of(field)
    if absent or isinstance(value, bool) or value in (None, (), "", {}):
        return absent
    if isinstance(value, BaseModel):
        return "see below"
    return f"`{value}`" if isinstance(value, str) else f"{value:g}".replace("e-0", "e-")


def _allowed(field: FieldInfo) -> str:
    """Words, keys of a part, or bounds."""
    words, record = kind_of(field).words, _record_of(field)
    if words:
        return ", ".join(f"`{word}`" for word in words) if len(words) <= MOST_WORDS else "see below"
    if record is not None:
        return f"`{{{', '.join(f'{key}: …' for key in record.model_fields)}}}`"
    bounds = {
        key: getattr(mark, key) for mark in field.metadata for key in ("ge", "gt", "le", "lt") if hasattr(mark, key)
    }
    if {"gt", "lt"} <= bounds.keys():
        return f"between {bounds['gt']:g} and {bounds['lt']:g}"
    return "greater than 0" if kind_of(field).unit else ""


def _record_of(field: FieldInfo) -> Any:
    """The record that a field takes; None where it takes none."""
    kinds = [field.annotation, *getattr(field.annotation, "__args__", ())]
    return next((each for each in kinds if isinstance(each, type) and issubclass(each, BaseModel)), None)
