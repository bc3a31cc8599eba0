"""Study files: from YAML to a StudyRecord, with every fault and its place, and their JSON schema for editors."""

from collections.abc import Iterable, Mapping
from copy import deepcopy
from pathlib import Path as FilePath
from typing import Any, Final

from pydantic import ValidationError

from nivel.errors import Fault, ModelError
from nivel.files.code import read_python_code
from nivel.files.csv_tables import column_values, with_table
from nivel.files.outline import take_format
from nivel.files.overrides import override
from nivel.files.sources import Sources, beside
from nivel.files.tree import Path, Tree, read_tree
from nivel.lazy import Struct
from nivel.machine.core.record import Record, field_words, without_problems
from nivel.machine.settings.analyses import SETTINGS
from nivel.machine.study.parameter import OUTPUTS, PARAMETERS
from nivel.machine.study.study_record import StudyRecord
from nivel.machine.units.quantity import shown

FORMAT: Final = 1
TOP_WORDS: Final = ("format", *field_words(StudyRecord))
EXAMPLE: Final = "a mapping with `format: 1` and `machine: FILE.yaml` was expected"


class StudyFile(Struct):
    """A study as it was read, and where everything stands in its file.

    file : its name. text : what stands in it. allow_code : whether its functions, and those of its machine, may be run.
    """

    record: StudyRecord
    tree: Tree
    file: str
    text: str
    allow_code: bool = False

    @property
    def machine_file(self) -> str:
        """Name of the machine file."""
        return beside(self.file, self.record.machine)

    def fault(self, path: Path, message: str, *, at_key: bool = False) -> Fault:
        """`message` with the place of `path`, such as ``("parameters", "bodies.rod.mass", "from")``, in the file."""
        return self.tree.fault(path, message, at_key=at_key)

    def placed(self, path: Path, faults: Iterable[Fault]) -> list[Fault]:
        """Faults of the machine with what stands at `path`, told there, with what the machine's reader says of them."""
        return [self.fault(path, each.message) for each in faults]


def study_and_faults(
    text: str, file: str, *, overrides: Mapping[str, object] | None = None, allow_code: bool = False
) -> tuple[StudyFile | None, list[Fault]]:
    """The study of a text, without its entries that are wrong by themselves, and all that is wrong in it; None where nothing can be held
    against a machine. Raises ModelError where it is no study of this format."""
    tree = read_tree(text, file)
    if not isinstance(tree.data, dict):
        what = "the file is empty" if tree.data is None else f"got {shown(tree.data)}"
        raise ModelError([*tree.faults, Fault(file, 1, 1, "", f"{EXAMPLE}; {what}")])
    if "bodies" in tree.data or "joints" in tree.data:
        message = (
            f"this is a machine, not a study: `nivel run {file}` simulates it; a study names it, as `machine: {file}`"
        )
        raise ModelError([*tree.faults, tree.fault((), message)])
    override(tree, overrides or {}, words=TOP_WORDS)
    take_format(tree, FORMAT, needed=True)
    sources = Sources(allow_code).inside(file)
    read_python_code(tree, sources, "outputs", "output")
    _read_columns(tree, sources)
    data = {"name": FilePath(file).stem.removesuffix(".study") or "study", **tree.data}
    try:
        record = StudyRecord.model_validate(data)
    except ValidationError as error:
        tree.take(error.errors(include_url=False))
        record = _right_part(data)
    study = None if record is None else StudyFile(record, tree, file, text, allow_code)
    return study, tree.faults


def _right_part(data: dict[str, Any]) -> StudyRecord | None:
    """The record of the entries that are right by themselves; None without a machine."""
    kept: dict[Any, Any] = {key: dict(value) if isinstance(value, dict) else value for key, value in data.items()}
    while True:
        try:
            return without_problems(StudyRecord, kept)
        except ValidationError as error:
            places = {line["loc"][:2] for line in error.errors(include_url=False)}
        if any(place[:1] in ((), ("machine",)) for place in places):
            return None
        for section, *entry in places:
            inside = kept.get(section)
            if entry and isinstance(inside, dict) and entry[0] in inside:
                del inside[entry[0]]
            elif kept.pop(section, None) is None:
                return None


def _read_columns(tree: Tree, sources: Sources) -> None:
    """Put the column of `csv: table.csv` into each parameter, as `values`. Faults go to `tree.faults`."""
    parameters = tree.data.get("parameters")
    for name, given in parameters.items() if isinstance(parameters, dict) else ():
        path = ("parameters", name)
        if not isinstance(given, dict) or "csv" not in given:
            continue
        if "values" in given:
            tree.report((*path, "csv"), "give `values` or `csv`, not both", at_key=True)
            continue
        values = with_table(tree, sources, path, given, column_values)
        if values is not None:
            given["values"] = values
            tree.places[(*path, "values")] = tree.places[(*path, "csv")]


_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def study_schema() -> dict[str, Any]:
    """JSON schema (2020-12) of the YAML form: lists in place of `type: values`, and the settings of each analysis."""
    study = deepcopy(StudyRecord.model_json_schema(by_alias=True, mode="validation"))
    definitions, properties = study["$defs"], study["properties"]
    for record in (*PARAMETERS[1:], *OUTPUTS):
        required = definitions[record.__name__].get("required", [])
        definitions[record.__name__]["required"] = ["type", *(word for word in required if word != "type")]
    parameter = properties["parameters"]["additionalProperties"]
    properties["parameters"]["additionalProperties"] = {"anyOf": [{"type": "array"}, parameter]}
    study["allOf"] = [_settings(name, record, definitions) for name, record in SETTINGS.items()]
    study["properties"] = {"format": {"const": FORMAT, "description": "version of the file format"}, **properties}
    study["required"] = ["format", *study.get("required", [])]
    return {"$schema": _DRAFT, **study, "title": "nivel study"}


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
