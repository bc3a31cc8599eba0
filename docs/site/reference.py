"""Reference pages made from the records and commands themselves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from importlib import import_module
from typing import Any

import click


def key_page() -> str:
    """Every key of every element: what it takes, its default and meaning."""
    from nivel.files.assembly import Assembly
    from nivel.files.schema import schema

    lines = [
        "# Every key",
        "",
        "This page is made from the records that read machine files, so that nothing is missing and nothing is out of date. "
        "What the keys mean together stands in [machine files](machine-files.md).",
        "",
        f"At the top of a file there are {', '.join(f'`{key}`' for key in schema()['properties'])}.",
        "",
    ]
    found = sections()
    for section, records in found.items():
        if len(records) > 1:
            lines += [f"## {section}", ""]
        for record in records:
            lines += _table(record, section if len(records) == 1 else "", 2 if len(records) == 1 else 3)
    lines += _table(Assembly, "assemblies", 2)
    lines += ["## Parts of elements", ""]
    for part in parts_of(record for records in found.values() for record in records):
        lines += _table(part, "", 3)
    return "\n".join(lines)


def sections() -> dict[str, list[type]]:
    """The records of every section of a machine file."""
    from nivel import MachineRecord
    from nivel.elements.circuits import COMPONENTS
    from nivel.elements.circuits.fluids import Fluid, Gas
    from nivel.elements.control import BLOCKS
    from nivel.elements.forces import FORCES
    from nivel.machine.uses.references import SECTIONS

    # what is told apart by its type when it is read does not stand in the annotation
    kinds: dict[str, list[type]] = {
        "forces": FORCES.records,
        "control": BLOCKS.records,
        "fluids": [Fluid, Gas],
        "hydraulics": COMPONENTS.records,
    }
    names = (*SECTIONS, "assembly", "simulation")
    return {name: kinds.get(name) or list(_records(MachineRecord.model_fields[name].annotation)) for name in names}


def parts_of(records: Iterable[type]) -> list[type]:
    """Records in the fields of these, in the order of their names."""
    seen = set(records)
    return sorted({part for record in seen for part in _parts(record)} - seen, key=lambda part: part.__name__)


def read_before(record: Any) -> dict[str, str]:
    """Keys of the file that other keys take the place of before a record is made, with their meanings."""
    known = {field.alias or name for name, field in record.model_fields.items()}
    written = _definitions().get(record.__name__, {}).get("properties", {})
    return {key: text["description"] for key, text in written.items() if key not in known and "description" in text}


@cache
def _definitions() -> dict[str, Any]:
    from nivel.files.schema import schema

    return schema()["$defs"]


def kind_of(record: Any) -> str:
    """The word for `type:` of a record; empty where it has none or several."""
    kind = record.model_fields["type"].default if "type" in record.model_fields else None
    return kind if isinstance(kind, str) else ""


def _records(annotation: Any) -> Iterator[type]:
    """The record classes in a type."""
    from nivel.elements.kind import RecordAt
    from nivel.machine.core.record import Record

    if isinstance(annotation, type) and issubclass(annotation, Record):
        yield annotation
        return
    for each in getattr(annotation, "__metadata__", ()):
        if isinstance(each, RecordAt):  # of a section that few machines have
            module, _, name = each.place.partition(":")
            yield from _records(getattr(import_module(module), name))
    for each in getattr(annotation, "__args__", ()):
        yield from _records(each)


def _parts(record: type) -> Iterator[type]:
    """Records in the fields of a record, and in theirs."""
    for field in record.model_fields.values():  # type: ignore[attr-defined]
        for part in _records(field.annotation):
            yield part
            if part is not record:
                yield from _parts(part)


def _table(record: Any, section: str, level: int) -> list[str]:
    from nivel.machine.core.record import words_of

    kind = kind_of(record)
    alone = bool(record.collection)  # an element is known by its type, a part of one by its name
    title = section or (f"`type: {kind}`" if kind and alone else record.__name__)
    text = " ".join((record.__doc__ or "").split("\n\n")[0].split())
    lines = [f"{'#' * level} {title}", "", text, "", "| key | takes | default | meaning |", "|---|---|---|---|"]
    for name, field in record.model_fields.items():
        if name in ("name", "type") and section != "":
            continue
        key = field.alias or name
        default = "must be given" if field.is_required() else _default(field)
        takes = words_of(field).replace("|", "or")
        lines.append(f"| `{key}` | {takes} | {default} | {(field.description or '').replace('|', 'or')} |")
    lines += [f"| `{key}` | text | | {meaning} |" for key, meaning in read_before(record).items()]
    return [*lines, ""]


def _default(field: Any) -> str:
    value = field.get_default(call_default_factory=True)
    if value is None or value in ((), {}):
        return ""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, int | float):
        return f"`{value:g}`"
    if isinstance(value, tuple):
        return f"`[{', '.join(map(str, value))}]`".replace(".0", "")
    return f"`{value}`" if isinstance(value, str) else ""


def command_page() -> str:
    """Every command of the program with its options."""
    from nivel.cli import COMMANDS, main

    lines = ["# Command line", "", "`nivel COMMAND --help` prints the same.", ""]
    context = click.Context(main)
    for name in COMMANDS:
        command = main.get_command(context, name)
        assert command is not None
        arguments = " ".join(
            each.make_metavar(click.Context(command)) for each in command.params if isinstance(each, click.Argument)
        )
        lines += [f"## nivel {name}", "", f"```text\nnivel {name} {arguments} [OPTIONS]\n```", ""]
        lines += [" ".join((command.help or "").replace("\b", "").split()), ""]
        options = [each for each in command.params if isinstance(each, click.Option) and not each.hidden]
        if options:
            lines += ["| option | meaning |", "|---|---|"]
        for each in options:
            words = ", ".join(f"`{word}`" for word in each.opts)
            lines.append(f"| {words} | {' '.join((each.help or '').split()).replace('|', 'or')} |")
        lines.append("")
    return "\n".join(lines)
