"""Outline of a machine file: `format`, sections of named elements, and words for the whole machine."""

from collections.abc import Mapping
from typing import Any, Final

from nivel.errors import Fault, ModelError
from nivel.files.tree import Tree
from nivel.lazy import Struct
from nivel.machine.core.record import Record, field_words, unknown_word
from nivel.machine.example_line import element_line
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import shown
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.references import SECTIONS

FORMAT: Final = 1
VALUES: Final = ("parameters", "functions")  # sections of what has no keys of its own
# sections of keys that elements share, and the key that names one
SETS: Final = {"tyres": "tyre", "ground": "ground", "catalogue": "part"}
# whose elements name one
SHARING: Final = {"tyres": ("forces",), "ground": ("forces",), "catalogue": ("hydraulics", "fluids", "forces")}
# types of forces that name a set, and keys of `ground` that they do not have
NAMING: Final = {
    "tyre": ("soil",),
    "contact": ("grip", "soil"),
    "blade": ("grip",),
    "soil-wheel": ("grip",),
    "track": (),
}
TOP_WORDS: Final = ("format", *VALUES, *SETS, *field_words(MachineRecord))
FILE_WORDS: Final = ("include", "assemblies")  # words of files that a record does not have
NAMED: Final = (*SECTIONS, *VALUES, *SETS, "assemblies")  # what maps names to something
ABOUT: Final = ("name", "description")  # what a file says about itself
WHOLE: Final = tuple(word for word in field_words(MachineRecord) if word not in (*SECTIONS, *ABOUT))


def check_start(tree: Tree) -> None:
    """Refuse what is no machine file at all, and other formats.

    Raises ModelError.
    """
    if tree.data is None:
        raise ModelError(
            [*tree.faults, Fault(tree.file, 1, 1, "", "the file is empty; `nivel new` writes one to start from")]
        )
    if not isinstance(tree.data, dict):
        message = f"a machine file is a mapping that starts with `format: {FORMAT}`, not {shown(tree.data)}"
        raise ModelError([*tree.faults, tree.fault((), message)])
    if "machine" in tree.data and not {"bodies", "beams"} & tree.data.keys():
        message = f"this is a study, not a machine: `nivel sweep {tree.file}` computes its variants"
        raise ModelError([*tree.faults, tree.fault((), message)])
    if not {"bodies", "beams"} & tree.data.keys() and {"reduction", "frame", "solid", "matrices"} & tree.data.keys():
        message = f"this is the model of a flexible body, not a machine: `nivel reduce {tree.file}` makes the body"
        raise ModelError([*tree.faults, tree.fault((), message)])
    take_format(tree, FORMAT)


def take_format(tree: Tree, known: int, *, needed: bool = False) -> None:
    """Take `format` out of the file. Raises ModelError where it is another one, which may mean something else by the rest; where it is no
    number, only if it is `needed`."""
    if "format" not in tree.data:
        tree.faults.append(tree.fault((), f"`format: {known}` is missing"))
        return
    given = tree.data.pop("format")
    if given != known or isinstance(given, bool):
        tree.faults.append(tree.fault(("format",), _other_format(given, known)))
        if needed or (isinstance(given, int | float) and not isinstance(given, bool)):
            raise ModelError(tree.faults)


def _other_format(given: Any, known: int) -> str:
    """Message on a `format` that is not the known one: from the future, or not a format at all."""
    message = f"this nivel reads format {known}, not {shown(given)}"
    if isinstance(given, int) and not isinstance(given, bool) and given > known:
        return f"{message}, which belongs to a newer nivel: `pip install --upgrade nivel`"
    return f"{message}; write `format: {known}`"


def check_sections(tree: Tree) -> None:
    """Collect faults of the sections and of unknown words. What is at fault is emptied, so that the rest can be read."""
    for word in [word for word in tree.data if word not in (*TOP_WORDS, *FILE_WORDS)]:
        message = unknown_word(word, (*TOP_WORDS, *FILE_WORDS), "key")
        tree.faults.append(tree.fault((word,), message, at_key=True))
        del tree.data[word]
    for section in NAMED:
        _check_section(tree, section)


def _check_section(tree: Tree, section: str) -> None:
    content = tree.data.get(section)
    if not isinstance(content, dict):
        if content is not None:
            hint = "" if section in VALUES else _as_mapping(content)
            message = f"a mapping from names to what they are was expected, got {shown(content)}{hint}"
            tree.faults.append(tree.fault((section,), message))
            tree.unread.add("")
        if section in tree.data:
            tree.data[section] = {}
        return
    if section not in VALUES:
        for name in content:
            _check_element(tree, content, section, name)


def _as_mapping(content: Any) -> str:
    """How the first entry of a list is written in a mapping."""
    first = content[0] if isinstance(content, list) and content else None
    if isinstance(first, str):
        return f"; write `{first}: {{…}}` in place of `- {first}`"
    if isinstance(first, dict) and isinstance(first.get("name"), str):
        return f"; the name is the key: write `{first['name']}: {{…}}` in place of `- name: {first['name']}`"
    return "; write `NAME: {…}` in place of `- …`" if isinstance(first, dict) else ""


def _check_element(tree: Tree, content: dict[str, Any], section: str, name: str) -> None:
    """An element is a mapping; nothing (`crank:` alone) is an empty one."""
    element = content[name]
    if isinstance(element, dict):
        if element.pop("name", None) is not None:
            message = f"the name is the key `{name}`; `name` must not be given"
            tree.faults.append(tree.fault((section, name, "name"), message))
        return
    content[name] = {}
    if element is not None:
        tree.report(
            (section, name), f"a mapping was expected, got {shown(element)}{element_line(section, name, element)}"
        )


def section_of(tree: Tree, section: str) -> dict[str, Any]:
    """The content of a section that has been checked; empty where the file has none."""
    return tree.data.get(section) or {}


def as_part(tree: Tree, only: tuple[str, ...] | None, example: str) -> None:
    """Leave what `tree`, read for another file, brings to that file: the sections `only`, or all.

    What concerns a whole machine is refused, unless the other file says which sections it takes. `example` shows how.
    """
    for word in [word for word in tree.data if word in WHOLE]:
        del tree.data[word]
        if only is None:
            message = (
                f"`{word}` belongs to the main file, which uses this one; remove it here, or say there which sections "
                f"to take: {example}"
            )
            tree.faults.append(tree.fault((word,), message, at_key=True))
    for word in ABOUT:
        tree.data.pop(word, None)
    if only is not None:
        for section in [word for word in tree.data if word in NAMED and word not in (*only, *VALUES)]:
            del tree.data[section]


Element = tuple[str, str]  # section and name


class Known(Struct):
    """texts : the elements of the file itself, as they are written. records : what they are. types : of its joints. parameters : what
    their expressions may name."""

    texts: Mapping[Element, str]
    records: Mapping[Element, Record]
    types: Mapping[str, str]
    parameters: Mapping[str, str]

    @classmethod
    def of(cls, tree: Tree, parameters: Parameters, record: MachineRecord) -> "Known":
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
