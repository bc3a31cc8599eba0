"""The JSON schema of study files, for editors that complete and check while one types."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

from nivel.files.study_file import FORMAT
from nivel.machine.core.record import Record
from nivel.machine.study import StudyRecord
from nivel.machine.study.analyses import SETTINGS
from nivel.machine.study.output import OUTPUTS
from nivel.machine.study.parameter import PARAMETERS

_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def study_schema() -> dict[str, Any]:
    """JSON schema (2020-12) of the YAML form: lists in place of `type: values`, and the settings of each analysis."""
    study = deepcopy(StudyRecord.model_json_schema(by_alias=True, mode="validation"))
    definitions, properties = study["$defs"], study["properties"]
    for record in (*PARAMETERS[1:], *OUTPUTS):
        definitions[record.__name__]["required"] = ["type", *_without_type(definitions[record.__name__])]
    parameter = properties["parameters"]["additionalProperties"]
    properties["parameters"]["additionalProperties"] = {"anyOf": [{"type": "array"}, parameter]}
    study["allOf"] = [_settings(name, record, definitions) for name, record in SETTINGS.items()]
    study["properties"] = {"format": {"const": FORMAT, "description": "version of the file format"}, **properties}
    study["required"] = ["format", *study.get("required", [])]
    return {"$schema": _DRAFT, **study, "title": "nivel study"}


def _without_type(definition: dict[str, Any]) -> list[str]:
    return [word for word in definition.get("required", []) if word != "type"]


def _settings(name: str, record: type[Record], definitions: dict[str, Any]) -> dict[str, Any]:
    """Settings of the analysis `name`, which is the default where it is `run`."""
    its = record.model_json_schema(by_alias=True, mode="validation")
    definitions |= its.pop("$defs", {})
    definitions[record.__name__] = its
    its.pop("required", None)
    condition: dict[str, Any] = {"properties": {"analysis": {"const": name}}}
    if name != "run":
        condition["required"] = ["analysis"]
    return {"if": condition, "then": {"properties": {"settings": {"$ref": f"#/$defs/{record.__name__}"}}}}
