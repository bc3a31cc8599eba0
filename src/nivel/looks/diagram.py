"""The machine as a block diagram: bodies and joints, what acts on them, circuits and control, and which of them hang together.

The page lays it out. A click on a box shows the lines of the machine file that it comes from.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

import yaml

from nivel.files.nodes import NotYamlError, compose
from nivel.lazy import Struct, field

KINDS: Final = {
    "bodies": "body",
    "beams": "body",
    "joints": "joint",
    "couplings": "element",
    "drivers": "element",
    "forces": "element",
    "hydraulics": "circuit",
    "inputs": "input",
    "states": "block",
    "control": "block",
    "sensors": "block",
    "events": "block",
}
LARGEST: Final = 120  # boxes that can be read in one picture
GROUND: Final = "ground"
_SYMBOL: Final = re.compile(r"(?<![\w.])([^\W\d][\w-]*)\.[^\W\d]\w*")
PLAIN: Final = (
    "name",
    "source",
    "file",
    "function",
    "units",
    "type",
    "label",
    "ports",
    "looks",
)  # keys whose texts name no element


class DiagramBox(Struct, frozen=False):
    """An element, or all components of circuits that neither act on bodies nor read signals. kind : how it is drawn.

    words : what it is. joins : numbers of the boxes that it connects or acts on. reads : numbers of those whose signals it reads.
    line, lines : where its lines in the machine file begin, and their text; 0 and empty where it does not stand there.
    """

    name: str
    kind: str
    words: str
    joins: list[int] = field(default_factory=list)
    reads: list[int] = field(default_factory=list)
    line: int = 0
    lines: str = ""


def block_diagram(record: Mapping[str, Any], source: str) -> list[DiagramBox]:
    """The boxes of a machine record as JSON; empty for a single body, and where they are too many to be read.

    source : text of the machine's file.
    """
    elements = [(section, each) for section in KINDS for each in record.get(section) or ()]
    names = {str(each["name"]) for section, each in elements if section != "hydraulics"}
    names |= {GROUND, *(marker["name"] for marker in record.get("markers") or ())}
    shown = [each for each in elements if each[0] != "hydraulics" or _acts(each[1], names)]
    places = _places(source)
    boxes = [DiagramBox(GROUND, "body", "")]
    numbers = {GROUND: 0}
    for section, element in shown:
        name = str(element["name"])
        numbers.setdefault(name, len(boxes))
        line, lines = places.get((section, name), (0, ""))
        boxes.append(DiagramBox(name, _kind(section, element), _words(section, element), line=line, lines=lines))
    circuit = len(boxes)
    if len(shown) < len(elements):
        numbers = {str(each["name"]): circuit for section, each in elements if section == "hydraulics"} | numbers
        boxes.append(DiagramBox("circuit", "circuit", f"{len(elements) - len(shown)} components"))
    numbers |= {marker["name"]: numbers[marker["body"]] for marker in record.get("markers") or ()}
    for own, (section, element) in enumerate(shown, start=1):
        joins, reads = [], []
        for key, text in _texts(element):
            if text in numbers:
                joins.append(numbers[text])
            else:
                signals = [numbers[name] for name in _SYMBOL.findall(text) if name in numbers]
                (joins if key.startswith("coordinate") else reads).extend(signals)
        if section == "hydraulics" and circuit < len(boxes):
            boxes[circuit].joins.append(own)
        boxes[own].joins = [number for number in dict.fromkeys(joins) if number != own]
        boxes[own].reads = [number for number in dict.fromkeys(reads) if number not in (own, *boxes[own].joins)]
    linked = {number for box in boxes for number in (*box.joins, *box.reads)}
    return boxes if 3 <= len(boxes) <= LARGEST and linked else []


def _acts(component: Mapping[str, Any], names: set[str]) -> bool:
    """Whether a component of a circuit names an element outside of circuits."""
    return any(text in names or names & set(_SYMBOL.findall(text)) for _, text in _texts(component))


def _kind(section: str, element: Mapping[str, Any]) -> str:
    return "sampled" if section == "control" and element.get("sample_time") else KINDS[section]


def _words(section: str, element: Mapping[str, Any]) -> str:
    period = element.get("sample_time") if section == "control" else None
    kind = str(element.get("type", "" if section == "bodies" else section.removesuffix("s")))
    return f"{kind} · {1e3 * period:.4g} ms" if period else kind


def _texts(value: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """(key, text) of all texts of an element that may name others."""
    if isinstance(value, str) and key not in PLAIN:
        yield key, value
    elif isinstance(value, Mapping):
        for inner, text in value.items():
            if inner not in PLAIN:
                yield from _texts(text, str(inner))
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from _texts(inner, key)


def _places(source: str) -> dict[tuple[str, str], tuple[int, str]]:
    """(first line, text) of each element, by section and name; of the file itself, not of those that it includes."""
    try:
        root = compose(source)
    except NotYamlError:
        return {}
    begins: list[tuple[int, tuple[str, str]]] = []
    if not isinstance(root, yaml.MappingNode):
        return {}
    for section, content in root.value:
        begins.append((section.start_mark.line, ("", "")))
        entries = content.value if isinstance(content.value, list) else []
        for entry in entries:
            if isinstance(entry, tuple):
                begins.append((entry[0].start_mark.line, (section.value, str(entry[0].value))))
            elif isinstance(entry, yaml.MappingNode):
                names = [str(value.value) for key, value in entry.value if key.value == "name"]
                begins += [(entry.start_mark.line, (section.value, name)) for name in names]
    lines = source.splitlines()
    ends = [line for line, _ in begins[1:]] + [len(lines) + 1]
    texts = ("\n".join(lines[line - 1 : max(line, end - 1)]) for (line, _), end in zip(begins, ends, strict=True))
    return {path: (line, text.rstrip()) for (line, path), text in zip(begins, texts, strict=True)}
