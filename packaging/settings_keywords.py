"""Keywords of the Python interface and options of the command line, as a module that imports nothing heavy, from the records."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from json import dumps
from os import PathLike
from types import NoneType, UnionType
from typing import Annotated, Any, Final, Literal, NamedTuple, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from nivel import methods
from nivel.machine.core.record import Record
from nivel.machine.given import Shown
from nivel.machine.settings.analyses import InverseSettings, KinematicsSettings, LineariseSettings, StaticsSettings
from nivel.machine.settings.run import ENDLESS, SimulationSettings
from nivel.machine.settings.sweep import COMMON, Axes, SweepSettings
from nivel.machine.units.quantity import Quantity
from nivel.machine.units.unit import KINDS

HEAD: Final = '''"""Settings of the analyses as keywords of Python, with the option of the command line and its help.

Written by `python packaging/write_settings.py` from the records in `nivel/machine/settings`. Do not edit.
"""

# fmt: off
# ruff: noqa: E501, I001
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Annotated, Any, TypedDict

from nivel.methods import {aliases}
'''


class Kind(NamedTuple):
    """What a field takes: type of the keyword, what the command line calls such a value (none: no option), SI unit, and words if it is
    one of some."""

    type: str
    metavar: str = ""
    unit: str = ""
    words: tuple[str, ...] = ()


class Keywords(NamedTuple):
    """A mapping of keywords: name, meaning, fields by name, whether a default is that of the machine file, and the mappings before it
    whose fields it has, in their order, before its own."""

    name: str
    meaning: str
    fields: Mapping[str, FieldInfo]
    of_file: bool = False
    bases: tuple[str, ...] = ()


ENDS: Final = "EndSettingsDict"  # of the fields that a machine without an end lacks
PLAIN: Final = {
    float: Kind("float | str", "NUMBER"),
    int: Kind("int | str", "NUMBER"),
    bool: Kind("bool"),
    PathLike[str]: Kind("str | PathLike[str]", "FILE"),
    str: Kind("str", "TEXT"),
}


def all_keywords() -> tuple[Keywords, ...]:
    """The mappings of all analyses."""
    run, sweep = SimulationSettings.model_fields, SweepSettings.model_fields
    steps = "Settings of a machine that is moved step by step."
    return (
        Keywords("RunSettingsDict", "Settings of a run.", run, True, bases=(ENDS, "StepSettingsDict")),
        Keywords("StepSettingsDict", steps, _without(run, ENDLESS), True),
        Keywords(
            "CompareSettingsDict",
            "Settings of a comparison: axes of its grid, and settings of all runs.",
            Axes.model_fields | {name: run[name] for name in COMMON},
            True,
        ),
        Keywords("SweepSettingsDict", "Settings of a sweep over machines.", sweep),
        Keywords(
            "MachineSweepSettingsDict",
            "Settings of a sweep over values of a machine, and of its runs.",
            sweep | run,
            True,
            bases=("SweepSettingsDict", "RunSettingsDict"),
        ),
        Keywords("StaticsSettingsDict", "Settings of statics.", StaticsSettings.model_fields),
        Keywords("KinematicsSettingsDict", "Settings of kinematics.", KinematicsSettings.model_fields),
        Keywords("InverseSettingsDict", "Settings of inverse dynamics.", InverseSettings.model_fields),
        Keywords("LineariseSettingsDict", "Settings of a linear model.", LineariseSettings.model_fields),
    )


def module() -> str:
    """Text of the module `nivel.settings`."""
    ends = {name: field for name, field in SimulationSettings.model_fields.items() if name in ENDLESS}
    found = (
        Keywords(ENDS, "Settings of what has an end.", ends, True),
        *sorted(all_keywords(), key=lambda each: bool(each.bases)),
    )
    of = {each.name: each.fields for each in found}
    aliases = {
        kind_of(field).type.rpartition(" ")[2]
        for each in found
        for field in each.fields.values()
        if kind_of(field).words
    }
    lines = [HEAD.format(aliases=", ".join(sorted(aliases)))]
    for each in found:
        own = _without(each.fields, {name for base in each.bases for name in of[base]})
        lines += [
            "",
            f"class {each.name}({', '.join(each.bases or ['TypedDict'])}, total=False):",
            f'    """{each.meaning}"""',
            "",
        ]
        lines += [f"    {name}: {_annotation(name, field, each.of_file)}" for name, field in own.items()]
        lines += [""] if own else []
    return "\n".join(lines)


def _annotation(name: str, field: FieldInfo, of_file: bool) -> str:
    """Type, option and help."""
    kind, option = kind_of(field), option_of(name, field)
    type_ = f"{kind.type} | None" if kind.type != "Any" else "Any"
    said = ", ".join(dumps(text, ensure_ascii=False) for text in (option, _help(field, of_file)))
    return f"Annotated[{type_}, {said}]" if option else type_


def _help(field: FieldInfo, of_file: bool) -> str:
    """The meaning as a sentence; of one of some words without its end, where they will be listed."""
    text, kind, absent = meaning_of(field), kind_of(field), absent_of(field)
    if not of_file and not absent and type(field.default) in (int, float) and field.default:
        absent = f"{field.default:g}".replace("e-0", "e-")
    end = ":" if kind.words else f"; default: {absent}." if absent else "."
    return f"{text[:1].upper()}{text[1:]}{end}"


def meaning_of(field: FieldInfo) -> str:
    """What a setting or its option is for, without its default; an option that takes something away says so."""
    its, text = field.json_schema_extra, (field.description or "").removesuffix(f"; default: {absent_of(field)}")
    return f"no {text}" if isinstance(its, Shown) and its.option.startswith("--no-") else text


def option_of(name: str, field: FieldInfo) -> str:
    """The option of a setting, `--from VALUE`; empty where it has none."""
    its, metavar = field.json_schema_extra, kind_of(field).metavar
    if isinstance(its, Shown) and its.option:
        return its.option
    return f"--{name.replace('_', '-')} {metavar}".rstrip() if metavar or kind_of(field).type == "bool" else ""


def absent_of(field: FieldInfo) -> str:
    """What holds where a setting is not given."""
    its = field.json_schema_extra
    return its.absent if isinstance(its, Shown) else ""


def kind_of(field: FieldInfo) -> Kind:
    """What a field takes."""
    return _kind(field.annotation, field.metadata)


def _kind(annotation: Any, marks: Sequence[Any] = ()) -> Kind:
    found = [*_parts(annotation), *marks]
    quantities = [each.kind for each in found if isinstance(each, Quantity)]
    if quantities:
        kind = quantities[0] if isinstance(quantities[0], str) else ""
        return Kind("float | str", "TIME" if kind == "time" else "VALUE", KINDS[kind][1] if kind else "")
    for each in found:
        origin = get_origin(each) or each
        if origin is Literal:
            (alias,) = [name for name, value in vars(methods).items() if value == each]
            return Kind(alias, "NAME", words=get_args(each))
        if origin is tuple:
            one = _kind(get_args(each)[0])
            metavar = f"{'NAME' if one.type == 'str' else one.metavar}S"
            return Kind(f"Sequence[{one.type}] | {one.type}", metavar, one.unit, one.words)
        if isinstance(origin, type) and issubclass(origin, (Record, Mapping)):
            return Kind("Mapping[str, Any]")
    return next((kind for plain, kind in PLAIN.items() if plain in found), Kind("Any"))


def _parts(annotation: Any) -> Iterator[Any]:
    """The alternatives of a type, and what they are annotated with; not None."""
    if get_origin(annotation) in (Union, UnionType):
        for each in get_args(annotation):
            yield from _parts(each)
    elif get_origin(annotation) is Annotated:
        base, *marks = get_args(annotation)
        yield from (*_parts(base), *marks)
    elif annotation is not NoneType:
        yield annotation


def _without(fields: Mapping[str, FieldInfo], names: Collection[str]) -> dict[str, FieldInfo]:
    return {name: field for name, field in fields.items() if name not in names}
