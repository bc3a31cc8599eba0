"""From records to a machine file."""

import re
from collections.abc import Mapping
from typing import Any

import yaml

from nivel.files.outline import FORMAT
from nivel.files.tree import INTEGER, NOT_FINITE, NULL, NUMBER, TRUTH
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.core.record import Record
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.uses.references import SECTIONS


def write_machine(record: MachineRecord) -> str:
    """YAML that `parse_machine` reads back to an equal record. Defaults are left out; everything is SI."""
    data = _plain(record)
    for section in SECTIONS:
        if section in data:
            data[section] = {element.pop("name"): element for element in data[section]}
    return _dumped({"format": FORMAT, **data})


def write_data(data: Mapping[str, Any]) -> str:
    """YAML of the data of a machine file: each element of a section in one line, bodies and what they look like in several."""
    plain: dict[str, Any] = {}
    for section, content in data.items():
        if section == "surroundings":
            plain[section] = _Column([_Line(each) for each in content])
        elif section == "bodies":
            plain[section] = {name: _body_lines(body) for name, body in content.items()}
        elif section in SECTIONS:
            plain[section] = {name: _Line(element) for name, element in content.items()}
        else:
            plain[section] = _Line(content) if isinstance(content, Mapping) else content
    return _dumped(plain)


def _body_lines(body: Mapping[str, Any]) -> dict[str, Any]:
    out: dict[str, Any] = {key: _Line(each) if isinstance(each, Mapping) else each for key, each in body.items()}
    return out | ({"looks": _Column([_Line(each) for each in body["looks"]])} if "looks" in body else {})


def _dumped(data: Mapping[str, Any]) -> str:
    return yaml.dump(
        dict(data), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=120, default_flow_style=False
    )


def _plain(value: Any) -> Any:
    """Records as mappings without defaults, tuples as lists; what holds Python text takes several lines."""
    match value:
        case Inertia(xy=0.0, xz=0.0, yz=0.0):
            return [value.xx, value.yy, value.zz]
        case Record():
            return _fields(value)
        case Table() | nivel.elements.circuits.curves.Curve():
            return _Line(value.written())
        case dict() if any(isinstance(each, Record) for each in value.values()):
            return {key: _plain(each) for key, each in value.items()}
        case PythonLaw():
            return {key: entry for key, entry in value.written().items() if entry != ""}
        case Expression(text):
            return text
        case tuple():
            entries = [_plain(entry) for entry in value]
            return _Column(entries) if any(map(_is_tall, entries)) else entries
    return value


def _fields(record: Record) -> dict[str, Any]:
    plain = {}
    for name, field in type(record).model_fields.items():
        value = getattr(record, name)
        is_default = value == field.get_default(call_default_factory=True) and not _says(value)
        if name == "type" or name in type(record).always or name in _said(record) or not is_default:
            plain[field.alias or name] = _plain(value)
    kind = {"type": plain.pop("type")} if "type" in plain else {}
    in_lines = isinstance(record, MachineRecord | Body | SimulationSettings) or any(map(_is_tall, plain.values()))
    return {**kind, **plain} if in_lines else _Line({**kind, **plain})


def _said(record: Record) -> set[str]:
    """Fields that mean something where they are given, also with their defaults."""
    return record.model_fields_set & type(record).where_given


def _says(value: object) -> bool:
    return isinstance(value, Record) and bool(_said(value))


class _Line(dict[str, Any]):
    """A mapping to be written in one line, between braces."""


class _Column(list[Any]):
    """A list to be written with one entry below the other."""


def _is_tall(plain: Any) -> bool:
    return type(plain) is dict or isinstance(plain, _Column)


class _Dumper(yaml.SafeDumper):
    """Lists in one line; texts quoted where the reader would take them for something else."""

    yaml_implicit_resolvers: dict[Any, Any] = {}  # noqa: RUF012  (PyYAML's own rule is that of YAML 1.1)

    def represent_sequence(self, tag: str, sequence: Any, flow_style: bool | None = None) -> yaml.SequenceNode:
        return super().represent_sequence(tag, sequence, flow_style=True)


def _represent_line(dumper: _Dumper, value: _Line) -> yaml.MappingNode:
    return dumper.represent_mapping("tag:yaml.org,2002:map", value.items(), flow_style=True)


def _represent_column(dumper: _Dumper, value: _Column) -> yaml.SequenceNode:
    return super(_Dumper, dumper).represent_sequence("tag:yaml.org,2002:seq", value, flow_style=False)


def _represent_text(dumper: _Dumper, value: str) -> yaml.ScalarNode:
    return dumper.represent_scalar("tag:yaml.org,2002:str", value, style="|" if "\n" in value else None)


def _represent_float(dumper: _Dumper, value: float) -> yaml.ScalarNode:
    text = repr(value)
    text = text if text == "-0.0" else text.removesuffix(".0")  # -0 would be read as 0
    return dumper.represent_scalar(f"tag:yaml.org,2002:{'int' if INTEGER.fullmatch(text) else 'float'}", text)


_Dumper.add_representer(float, _represent_float)
_Dumper.add_representer(_Line, _represent_line)
_Dumper.add_representer(_Column, _represent_column)
_Dumper.add_representer(str, _represent_text)
_RULES = (("null", NULL), ("bool", TRUTH), ("int", INTEGER), ("float", NUMBER), ("float", NOT_FINITE))
for _tag, _pattern in _RULES:
    _Dumper.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", re.compile(rf"(?:{_pattern.pattern})\Z"), None)
