"""Model files: from YAML to a ModelRecord, with every fault and its place."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path as FilePath
from typing import Any, Final

from pydantic import ValidationError

from nivel.errors import Fault, ModelError, refuse
from nivel.files.outline import take_format
from nivel.files.overrides import override
from nivel.files.sources import read_text
from nivel.files.tree import Path, Tree, read_tree
from nivel.flexible.model.records import ModelRecord
from nivel.machine.core.record import field_words
from nivel.machine.parameters import resolve
from nivel.machine.units.quantity import shown
from nivel.machine.units.tree import Parameters

FORMAT: Final = 1
TOP_WORDS: Final = ("format", "parameters", *field_words(ModelRecord))


class Located:
    """A model as it was read: `record`, the `parameters`, and the place of every key for faults that are found later."""

    def __init__(self, record: ModelRecord, parameters: Parameters, tree: Tree) -> None:
        self.record = record
        self.parameters = parameters
        self._tree = tree

    def fault(self, path: Path, message: str, *, at_key: bool = False) -> Fault:
        """`message` with the place of `path` in the file."""
        return self._tree.fault(path, message, at_key=at_key)

    def with_record(self, record: ModelRecord) -> "Located":
        """Another record with the same places of keys."""
        return Located(record, self.parameters, self._tree)

    def beside(self, name: str) -> FilePath:
        """The file `name` seen from the folder of the model file."""
        return FilePath(self._tree.file).parent / name


def read_model(path: str | FilePath, *, overrides: Mapping[str, object] | None = None) -> Located:
    """The model in the YAML file at `path`. `overrides`: values by path, e.g. ``{"reduction.modes": 12}``.

    Raises ModelError with everything that is wrong, each with file, line and column.
    """
    return parse_model(read_text(path), str(path), overrides=overrides)


def parse_model(text: str, file: str = "model.yaml", *, overrides: Mapping[str, object] | None = None) -> Located:
    """The model in the YAML `text`; files that it names are seen from the folder of `file`.

    Raises ModelError.
    """
    tree = read_tree(text, file)
    if not isinstance(tree.data, dict):
        what = "the file is empty" if tree.data is None else f"got {shown(tree.data)}"
        raise ModelError(
            [*tree.faults, Fault(file, 1, 1, "", f"a mapping with `format: {FORMAT}` was expected; {what}")]
        )
    if {"bodies", "joints", "simulation"} & tree.data.keys():
        message = f"this is a machine, not the model of a flexible body: `nivel run {file}` simulates it"
        raise ModelError([*tree.faults, tree.fault((), message)])
    override(tree, overrides or {}, words=TOP_WORDS)
    take_format(tree, FORMAT, needed=True)
    parameters = _parameters(tree)
    data = {"name": FilePath(file).stem or "body", **tree.data}
    try:
        record = ModelRecord.model_validate(data, context={"parameters": parameters})
    except ValidationError as error:
        tree.take(error.errors(include_url=False), partial(_in_file, tree.data))
        raise ModelError(tree.faults) from None
    refuse(tree.faults)
    return Located(record, parameters, tree)


def _parameters(tree: Tree) -> Parameters:
    given = tree.data.pop("parameters", None)
    if given is None:
        return {}
    if not isinstance(given, dict):
        tree.report(("parameters",), f"a mapping from names to numbers was expected, got {shown(given)}")
        return {}
    values, faults = resolve(given)
    tree.faults += [tree.fault(("parameters", name), message) for name, message in faults.items()]
    return values


def _in_file(content: Any, location: tuple[int | str, ...]) -> Path:
    """A place in the record as one in the file: what pydantic puts in for the kinds of a union is left out."""
    path: list[int | str] = []
    data: Any = content
    for step in location:
        if (isinstance(data, dict) and step in data) or (isinstance(data, list) and step in range(len(data))):
            data = data[step]  # type: ignore[index, call-overload]
        elif step is not location[-1] or not isinstance(step, str) or step[:1].isupper() or "[" in step:
            continue
        path.append(step)
    return tuple(path)
