"""YAML as plain data that remembers where everything stands.

The number rule is YAML 1.2's (core schema): `1e3` and `1e-3` are numbers; `12:30`, `no` and `on` are texts. Keys are
always texts. Aliases work; merge keys, tags and keys that stand twice are refused.
"""

from __future__ import annotations

import re
from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any, ClassVar, Final, NamedTuple

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from nivel.errors import Fault, ModelError

Path = tuple[str | int, ...]

NULL: Final = re.compile(r"~|null|Null|NULL|")
TRUTH: Final = re.compile(r"true|True|TRUE|false|False|FALSE")
INTEGER: Final = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
NUMBER: Final = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
NOT_FINITE: Final = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")

_MOST_NODES = 200_000
_PREFIX = "tag:yaml.org,2002:"
_PLAIN_TAGS = {_PREFIX + "str", _PREFIX + "map", _PREFIX + "seq"}


class Place(NamedTuple):
    """Line and column, from 1."""

    line: int
    column: int


@dataclass
class Tree:
    """The content of a file: `data` of dicts, lists and scalars; `places` of values and `keys` by path; `faults`
    found on the way.

    A path under one of `outside` was set from outside the file and has no place in it.
    """

    file: str
    data: Any = None
    places: dict[Path, Place] = field(default_factory=dict)
    keys: dict[Path, Place] = field(default_factory=dict)
    faults: list[Fault] = field(default_factory=list)
    outside: set[Path] = field(default_factory=set)

    def fault(self, path: Path, message: str, *, at_key: bool = False) -> Fault:
        """`message` with the place of `path`, or of the nearest element around it that stands in the file."""
        words = ".".join(map(str, path))
        if any(path[:end] in self.outside for end in range(len(path) + 1)):
            return Fault(self.file, 0, 0, words, f"{message} (set from outside the file)")
        for end in range(len(path), -1, -1):
            place = (self.keys if at_key else self.places).get(path[:end]) or self.places.get(path[:end])
            if place is not None:
                return Fault(self.file, *place, words, message)
        return Fault(self.file, 1, 1, words, message)


def read_tree(text: str, file: str) -> Tree:
    """The tree of a YAML text.

    Raises ModelError where the text is not YAML.
    """
    tree = Tree(file)
    try:
        root = _compose(text)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise ModelError(_syntax_fault(error, text, file)) from None
    if root is not None:
        _Reader(tree).value(root, ())
    return tree


def read_value(text: str) -> Any:
    """A single value as it would stand in a file: `22 kg`, `5`, `[0, 0, 1]`.

    Raises ModelError.
    """
    tree = read_tree(text, "")
    if tree.faults:
        raise ModelError(tree.faults)
    return tree.data


_Base: Any = yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader


class _Loader(_Base):
    """Gives every plain scalar as a text: PyYAML's own rule is that of YAML 1.1."""

    yaml_implicit_resolvers: ClassVar[dict[str, Any]] = {}


def _compose(text: str) -> Node | None:
    loader = _Loader(text)
    try:
        return loader.get_single_node()
    finally:
        loader.dispose()


def _syntax_fault(error: Exception, text: str, file: str) -> Fault:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    place = Place(mark.line + 1, mark.column + 1) if mark is not None else _place_of_character(error, text)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "nested too deeply"
    context = getattr(error, "context", None)
    hint = "; indent with spaces, not tabs" if "'\\t'" in str(problem) else ""
    return Fault(file, *place, "", f"this is not YAML: {problem}{f' {context}' if context else ''}{hint}")


def _place_of_character(error: Exception, text: str) -> Place:
    """Place of a character that YAML does not allow."""
    at = getattr(error, "position", None) or getattr(error, "start", None)
    before = text[:at] if isinstance(at, int) else ""
    return Place(before.count("\n") + 1, len(before) - (before.rfind("\n") + 1) + 1)


class _Reader:
    """Walks the nodes of a document and fills a Tree."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.open: set[int] = set()  # nodes around the present one: an alias to one of them has no end
        self.count = 0
        self.tree.data = None

    def value(self, node: Node, path: Path) -> None:
        self.tree.places[path] = Place(node.start_mark.line + 1, node.start_mark.column + 1)
        self.tree.data = self.read(node, path)

    def read(self, node: Node, path: Path) -> Any:
        self.count += 1
        if self.count > _MOST_NODES:
            raise ModelError(self.tree.fault(path, f"the file has more than {_MOST_NODES} entries"))
        if node.tag not in _PLAIN_TAGS:
            self.report(path, f"the tag `{node.tag.replace(_PREFIX, '!!')}` is not used in machine files")
        if isinstance(node, ScalarNode):
            return self.scalar(node, path)
        if id(node) in self.open:
            self.report(path, "this alias leads back to itself")
            return None
        self.open.add(id(node))
        data = self.mapping(node, path) if isinstance(node, MappingNode) else self.sequence(node, path)
        self.open.discard(id(node))
        return data

    def mapping(self, node: MappingNode, path: Path) -> dict[str, Any]:
        data: dict[str, Any] = {}
        for key_node, value_node in node.value:
            place = Place(key_node.start_mark.line + 1, key_node.start_mark.column + 1)
            if not isinstance(key_node, ScalarNode):
                self.tree.faults.append(
                    Fault(self.tree.file, *place, ".".join(map(str, path)), "a key must be a single word")
                )
                continue
            key = key_node.value
            if key in data:
                first = self.tree.keys[(*path, key)].line
                words = ".".join(map(str, (*path, key)))
                message = f"`{key}` stands here a second time; the first is in line {first}"
                self.tree.faults.append(Fault(self.tree.file, *place, words, message))
                continue
            self.tree.keys[(*path, key)] = place
            self.tree.places[(*path, key)] = _place_of_value(key_node, value_node)
            data[key] = self.read(value_node, (*path, key))
        return data

    def sequence(self, node: Node, path: Path) -> list[Any]:
        assert isinstance(node, SequenceNode)
        data = []
        for at, entry in enumerate(node.value):
            self.tree.places[(*path, at)] = Place(entry.start_mark.line + 1, entry.start_mark.column + 1)
            data.append(self.read(entry, (*path, at)))
        return data

    def scalar(self, node: ScalarNode, path: Path) -> Hashable:
        text = node.value
        if node.style:  # quoted, or a block of text
            return text
        if NULL.fullmatch(text):
            return None
        if TRUTH.fullmatch(text):
            return text.lower() == "true"
        if INTEGER.fullmatch(text):
            return _integer(text)
        if NUMBER.fullmatch(text):
            return float(text)
        if NOT_FINITE.fullmatch(text):
            return float(text.replace(".", "", 1).lower())
        return text

    def report(self, path: Path, message: str) -> None:
        self.tree.faults.append(self.tree.fault(path, message))


def _place_of_value(key: Node, value: Node) -> Place:
    """Where a reader looks: at the value if it starts in the line of its key, else at the key."""
    mark = value.start_mark if value.start_mark.line == key.start_mark.line else key.start_mark
    return Place(mark.line + 1, mark.column + 1)


def _integer(text: str) -> int | float:
    if text[:2] in ("0o", "0x"):
        return int(text[2:], 8 if text[1] == "o" else 16)
    return int(text) if len(text) < 300 else float(text)  # Python refuses to read integers of thousands of digits
