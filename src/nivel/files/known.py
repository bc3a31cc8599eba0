"""Elements of a machine that is known already: what is written alike in another reading of its file is the same record there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from nivel.files.outline import section_of
from nivel.files.tree import Tree
from nivel.machine.core.record import Record
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.references import SECTIONS

Element = tuple[str, str]  # section and name


@dataclass(frozen=True)
class Known:
    """texts : the elements of the file itself, as they are written. records : what they are. types : of its joints. parameters : what
    their expressions may name."""

    texts: Mapping[Element, str]
    records: Mapping[Element, Record]
    types: Mapping[str, str]
    parameters: Mapping[str, str]

    @classmethod
    def of(cls, tree: Tree, parameters: Parameters, record: MachineRecord) -> Known:
        """Those of `record`, which was read from `tree` with these parameters."""
        texts = _texts(tree)
        made = {(section, each.name): each for section in SECTIONS for each in getattr(record, section)}
        records = {element: made[element] for element in texts if element in made}
        return cls(texts, records, _types(tree), _values(parameters))

    def alike(self, tree: Tree, parameters: Parameters) -> dict[Element, Record]:
        """The elements of another reading that are written alike and name no parameter of another value; none where elements were added
        or left out, or joints are of other types, on which all coordinates depend."""
        texts = _texts(tree)
        if tree.faults or list(texts) != list(self.texts) or _types(tree) != self.types:
            return {}
        values = _values(parameters)
        other = [
            name for name in values.keys() | self.parameters.keys() if values.get(name) != self.parameters.get(name)
        ]
        return {
            element: self.records[element]
            for element, text in texts.items()
            if text == self.texts[element] and element in self.records and not any(name in text for name in other)
        }


def _texts(tree: Tree) -> dict[Element, str]:
    """`True` and `1`, `0.0` and `-0.0` are not alike."""
    return {(section, name): repr(given) for section in SECTIONS for name, given in section_of(tree, section).items()}


def _types(tree: Tree) -> dict[str, str]:
    joints = section_of(tree, "joints").items()
    return {name: repr(joint.get("type")) for name, joint in joints if isinstance(joint, Mapping)}


def _values(parameters: Mapping[str, Any]) -> dict[str, str]:
    return {name: repr(value) for name, value in parameters.items()}
