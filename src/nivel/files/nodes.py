"""YAML text as a tree of nodes with their places, from the events of PyYAML's parser (libyaml where there is one).

PyYAML's own composer recurses in C without a limit, and deep nesting ends the process; this one stops at DEEPEST.
"""

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, Final, NamedTuple

import yaml
from yaml import events

DEEPEST: Final = 60
MOST: Final = 200_000  # values of a file
TOO_MANY: Final = (
    f"the file has more than {MOST} values; long tables belong in a CSV file, which a machine file names: "
    "`{csv: cycle.csv, column: boom}`"
)
TOO_DEEP: Final = "this is nested too deeply for a machine file"


class Place(NamedTuple):
    """Line and column, from 1."""

    line: int
    column: int


class NotYamlError(Exception):
    """The text is not YAML, or not the part of YAML that machine files use."""

    def __init__(self, message: str, place: Place) -> None:
        self.message = message
        self.place = place
        super().__init__(message)


Node = yaml.Node
_Loader: Any = yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader


@lru_cache(maxsize=8)
def compose(text: str) -> Node | None:
    """The root node of the one document in `text`; None if there is nothing in it. The `start_mark` of nodes is a Place. They are only
    read: the last texts are kept.

    Raises NotYamlError.
    """
    try:
        return _Composer(yaml.parse(text, Loader=_Loader)).document()
    except yaml.YAMLError as error:
        raise _restated(error, text) from None
    except UnicodeEncodeError as error:
        raise NotYamlError(f"this is not YAML: {error.reason}", _place_of_character(error.start, text)) from None


class _Composer:
    """Puts events together. Sequences and mappings that are still open stand in the Python stack."""

    def __init__(self, stream: Iterator[Any]) -> None:
        self.stream = stream
        self.anchors: dict[str, Node] = {}
        self.count = 0

    def document(self) -> Node | None:
        next(self.stream)  # the start of the stream
        if isinstance(next(self.stream), events.StreamEndEvent):
            return None
        root = self.node(next(self.stream), 0)
        next(self.stream)  # the end of the document
        following = next(self.stream)
        if not isinstance(following, events.StreamEndEvent):
            raise NotYamlError("a machine file is one document; another document starts here", _place(following))
        return root

    def node(self, event: Any, depth: int) -> Node:
        place: Any = _place(event)
        if depth > DEEPEST:
            raise NotYamlError(TOO_DEEP, place)
        if isinstance(event, events.AliasEvent):
            if event.anchor not in self.anchors:
                message = f"this is not YAML: the alias `*{event.anchor}` has no anchor `&{event.anchor}` before it"
                raise NotYamlError(message, place)
            return self.anchors[event.anchor]
        if isinstance(event, events.ScalarEvent):
            return self.anchored(event, yaml.ScalarNode(event.tag, event.value, place, style=event.style))
        kind = yaml.MappingNode if isinstance(event, events.MappingStartEvent) else yaml.SequenceNode
        node = self.anchored(event, kind(event.tag, [], place, flow_style=bool(event.flow_style)))
        while not isinstance(first := next(self.stream), events.CollectionEndEvent):
            if kind is yaml.MappingNode:
                node.value.append((self.node(first, depth + 1), self.entry(next(self.stream), depth + 1)))
            else:
                node.value.append(self.entry(first, depth + 1))
        return node

    def entry(self, event: Any, depth: int) -> Node:
        """A value of a list or a mapping, of which there are not too many: a file is refused before all of it is read."""
        self.count += 1
        if self.count > MOST:
            raise NotYamlError(TOO_MANY, _place(event))
        return self.node(event, depth)

    def anchored(self, event: Any, node: Node) -> Node:
        if event.anchor is not None:
            self.anchors[event.anchor] = node
        return node


def _place(event: Any) -> Place:
    return Place(event.start_mark.line + 1, event.start_mark.column + 1)


def _restated(error: yaml.YAMLError, text: str) -> NotYamlError:
    """PyYAML's error with its place, and a hint for tabs."""
    place = _place_of_error(error, text)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "it cannot be read"
    if "nesting" in problem:  # libyaml, from 0.2.6, has a limit of its own and comes to it first where lists are deep
        return NotYamlError(TOO_DEEP, place)
    context = getattr(error, "context", None)
    lines = text.splitlines()
    line = lines[place.line - 1] if place.line <= len(lines) else ""
    if line[place.column - 1 : place.column] == "\t":
        hint = "; indent with spaces, not tabs"
    else:
        hint = _unit_behind_list(line) or _no_key(lines[: place.line])
    return NotYamlError(f"this is not YAML: {problem}{f' {context}' if context else ''}{hint}", place)


def _no_key(lines: list[str]) -> str:
    """A hint for `mass:2 kg` and `mass = 2 kg` in the line before the last, and for `a: 1, b: 2` in the last one."""
    if lines and re.match(r"\s*[\w-]+: [^{\['\"]*,\s*[\w-]+:", lines[-1]):
        return "; two keys stand in two lines, or in braces: `{a: 1, b: 2}`"
    found = re.fullmatch(r"\s*([\w-]+)\s*[:=]\s*([^:=]+?)\s*", lines[-2]) if len(lines) > 1 else None
    if found and not re.search(r":\s", lines[-2]):
        return f"; write line {len(lines) - 1} as `{found[1]}: {found[2]}`"
    return ""


def _unit_behind_list(line: str) -> str:
    """A hint for `[500, 0, 0] mm`."""
    found = re.search(r"\[([^\[\]]*)\]\s+([^\W\d_]+)\s*$", line)
    if found is None:
        return ""
    entries = [each.strip() for each in found[1].split(",")]
    each_with_unit = ", ".join(entry if entry == "0" else f"{entry} {found[2]}" for entry in entries)
    return f"; a unit stands behind each number: `[{each_with_unit}]`"


def _place_of_error(error: yaml.YAMLError, text: str) -> Place:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    if mark is not None:
        return Place(mark.line + 1, mark.column + 1)
    return _place_of_character(getattr(error, "position", 0) or 0, text)


def _place_of_character(at: int, text: str) -> Place:
    before = text[:at]
    return Place(before.count("\n") + 1, len(before) - (before.rfind("\n") + 1) + 1)


def cut_at_comma(node: Any) -> str:
    """The first expression whose parentheses are closed behind a comma only, as a whole; empty where there is none."""
    open_parts: list[str] = []
    for text in _texts_between_commas(node):
        if open_parts or text.count("(") > text.count(")"):
            open_parts.append(text)
            whole = ", ".join(open_parts)
            if whole.count("(") <= whole.count(")"):
                return whole
    return ""


def _texts_between_commas(node: Any) -> list[str]:
    """What stands between the commas, without keys; a value that was cut goes on in keys that have no value."""
    if isinstance(node, yaml.SequenceNode):
        return [_plain_text(entry) for entry in node.value]
    return [_plain_text(key) if _plain_text(value) == "" else _plain_text(value) for key, value in node.value]


def _plain_text(node: Node) -> str:
    return node.value if isinstance(node, yaml.ScalarNode) and not node.style else "…"
