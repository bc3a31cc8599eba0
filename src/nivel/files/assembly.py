"""An entry of `assemblies:`: a part file that is placed, mirrored, given parameters, and whose elements get a prefix."""

import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationError

from nivel.files.include import FileName, Sections
from nivel.files.outline import section_of
from nivel.files.placed import NotRepresentableError, placed
from nivel.files.placement import Placement
from nivel.files.substitution import renamed
from nivel.files.tree import Tree
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.record import Record, entry, unknown_word
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.machine_record import MachineRecord
from nivel.machine.parameters import resolve
from nivel.machine.units.quantity import FAULT, Position, fault, shown
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.references import SECTIONS

_PREFIX = re.compile(r"([^\W\d_][\w-]*)?")


def _prefix(value: Any) -> Any:
    if not isinstance(value, str) or not _PREFIX.fullmatch(value):
        raise fault(f"the start of a name, such as `left_`, was expected, got {shown(value)}")
    return value


def _values(value: Any) -> Any:
    if not isinstance(value, Mapping):
        raise fault(f"a mapping from parameters to values was expected, got {shown(value)}")
    return dict(value)


class Assembly(Record):
    """A part of a machine that stands in a file of its own, and where it goes."""

    file: FileName
    position: Position = Field("of the part's origin", default=(0.0, 0.0, 0.0))
    orientation: Maybe[OneRecord[Orientation]] = Field("of the part's axes", default=None)
    mirror: Literal["x", "y", "z", "none"] = Field(
        "axis of the part along which it is mirrored, before it is placed", default="none"
    )
    parameters: Annotated[dict[str, Any], BeforeValidator(_values)] = Field(
        "values for parameters of the part, in place of its own", default={}
    )
    prefix: Annotated[str, BeforeValidator(_prefix)] = Field(
        "start of the names of all its elements; default the assembly's name and `_`", default=""
    )
    only: Sections | None = Field("sections that are taken; default all", default=None)


def read_assembly(tree: Tree, name: str, given: Any, parameters: Parameters) -> Assembly | None:
    """The entry `name` of `assemblies:`; None where it has faults, which go to `tree.faults`."""
    path = ("assemblies", name)
    data = {"prefix": f"{name}_", **given} if isinstance(given, dict) else given
    try:
        assembly = Assembly.model_validate(data, context={"parameters": parameters})
    except ValidationError as error:
        for line in error.errors(include_url=False):
            where = path if line["loc"] == ("prefix",) and "prefix" not in given else (*path, *line["loc"])
            if line["type"] == FAULT and not tree.is_broken(path):
                tree.faults.append(tree.fault(where, line["msg"], at_key=bool(line.get("ctx", {}).get("at_key"))))
        return None
    return None if tree.is_broken(path) else assembly


def given_parameters(part: Tree, user: Tree, name: str, assembly: Assembly) -> None:
    """Put the values that `assembly` gives in place of the part's parameters. They may use those of its `user`."""
    own = section_of(part, "parameters")
    outer = section_of(user, "parameters")
    fresh = {key: f"given_{key}" for key in assembly.parameters}
    while any(each in outer for each in fresh.values()):
        fresh = {key: f"{each}_" for key, each in fresh.items()}
    values, faults = resolve({**outer, **{fresh[key]: value for key, value in assembly.parameters.items()}})
    for key, word in fresh.items():
        path, value = ("assemblies", name, "parameters", key), values.get(word)
        if key not in own:
            part.faults.append(user.fault(path, unknown_word(key, list(own), "parameter"), at_key=True))
        elif word in faults:
            part.faults.append(user.fault(path, faults[word]))
        if key not in own or value is None:
            continue
        own[key] = value
        part.graft(user, {path: ("parameters", key)})


def made_by(tree: Tree, name: str, assembly: Assembly, part: MachineRecord) -> dict[str, dict[str, Record]] | None:
    """The elements of `part` as `assembly` makes them, by section and name; None where they cannot be, which is
    reported.
    """
    try:
        elements = elements_of(part, assembly)
    except NotRepresentableError as error:
        tree.report(("assemblies", name), str(error))
        return None
    return {section: {str(entry(each, "name")): each for each in records} for section, records in elements.items()}


def elements_of(part: MachineRecord, assembly: Assembly) -> dict[str, tuple[Record, ...]]:
    """The elements of `part` by section, placed and with the prefix of `assembly`. Raises NotRepresentableError."""
    elements = {section: getattr(part, section) for section in SECTIONS}
    placement = Placement.of(assembly.position, assembly.orientation, assembly.mirror)
    return renamed(placed(elements, placement), assembly.prefix)
