"""YAML as plain data that remembers where everything stands.

The number rule is YAML 1.2's (core schema): `1e3` and `1e-3` are numbers; `12:30`, `no` and `on` are texts. Keys are
always texts. Aliases work; merge keys, tags and keys that stand twice are refused.
"""

import math
import re
from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import Any, Final

import yaml

from nivel.errors import Fault, ModelError, refuse
from nivel.files.nodes import DEEPEST, MOST, TOO_DEEP, TOO_MANY, NotYamlError, Place, compose, cut_at_comma
from nivel.lazy import Struct, field
from nivel.machine.units.quantity import FAULT

Path = tuple[str | int, ...]

NULL: Final = re.compile(r"~|null|Null|NULL|")
TRUTH: Final = re.compile(r"true|True|TRUE|false|False|FALSE")
INTEGER: Final = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
NUMBER: Final = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
NOT_FINITE: Final = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")

_PREFIX = "tag:yaml.org,2002:"


class Tree(Struct, frozen=False):
    """The content of a file: `data` of dicts, lists and scalars; `places` of values and of `keys` by path; `faults`.

    What stands under one of `files` came from that file. A path under one of `outside` was set from outside the file
    and has no place in it. What is wrong under one of `broken` follows from a fault that has been reported. Names that
    start with one of `unread` would come from files that could not be read. `for_parts`: values to be set in the part of
    an assembly, by its name.
    """

    file: str
    data: Any = None
    places: dict[Path, Place] = field(default_factory=dict)
    keys: dict[Path, Place] = field(default_factory=dict)
    faults: list[Fault] = field(default_factory=list)
    files: dict[Path, str] = field(default_factory=dict)
    outside: set[Path] = field(default_factory=set)
    broken: set[Path] = field(default_factory=set)
    unread: set[str] = field(default_factory=set)
    for_parts: dict[str, dict[str, object]] = field(default_factory=dict)

    def fault(self, path: Path, message: str, *, at_key: bool = False) -> Fault:
        """`message` with the place of `path`, or of the nearest element around it that stands in the file."""
        words = ".".join(map(str, path))
        if self.is_outside(path):
            return Fault(self.file, 0, 0, words, f"{message} (set from outside the file)")
        for end in range(len(path), -1, -1):
            place = (self.keys if at_key else self.places).get(path[:end]) or self.places.get(path[:end])
            if place is not None:
                return Fault(self.file_of(path[:end]), *place, words, message + self._outside_of(path))
        return Fault(self.file, 1, 1, words, message)

    def _outside_of(self, path: Path) -> str:
        """What of the element at `path` was set from outside the file, to be said after a message on it."""
        inner = sorted({".".join(map(str, each[len(path) :])) for each in self.outside if each[: len(path)] == path})
        names = ", ".join(f"`{each}`" for each in inner)
        return f" ({names} set from outside the file)" if names and path else ""

    def report(self, path: Path, message: str, *, at_key: bool = False, breaks: Path | None = None) -> None:
        """Collect the fault, and let nothing that follows from it be reported, there or under `breaks`."""
        self.faults.append(self.fault(path, message, at_key=at_key))
        self.broken |= {path} if breaks is None else {path, breaks}

    def take(self, problems: Iterable[Mapping[str, Any]], place: Callable[[Path], Path] = lambda path: path) -> None:
        """Collect the faults of a record, as pydantic has them, but those that follow from others. place : in the file, of one in it."""
        for each in problems:
            path = place(each["loc"])
            if each["type"] == FAULT and not self.is_broken(path):
                self.faults.append(self.fault(path, each["msg"], at_key=bool(each.get("ctx", {}).get("at_key"))))

    def is_outside(self, path: Path) -> bool:
        """Whether what stands at `path` was set from outside the file."""
        return any(path[:end] in self.outside for end in range(len(path) + 1))

    def is_broken(self, path: Path) -> bool:
        """Whether a fault at `path` follows from another that has been reported."""
        return any(path[:end] in self.broken for end in range(len(path) + 1))

    def file_of(self, path: Path) -> str:
        """The file in which `path` stands."""
        for end in range(len(path), 0, -1):
            if path[:end] in self.files:
                return self.files[path[:end]]
        return self.file

    def place_of(self, path: Path) -> str:
        """Where `path` stands, for people: ``parts.yaml:4:3``."""
        fault = self.fault(path, "")
        return f"{fault.file}:{fault.line}:{fault.column}" if fault.line else "what is set from outside the file"

    def copy_places(self, origin: Path, target: Path) -> None:
        """What stands at `target` and under it was made of what stands at `origin`."""
        for places in (self.places, self.keys):
            for path in [path for path in places if path[: len(origin)] == origin]:
                places[(*target, *path[len(origin) :])] = places[path]

    def graft(self, other: "Tree", moves: Mapping[Path, Path]) -> None:
        """Take over the places of parts of `other`. `moves`: paths there, all of one length, and what they are here."""
        length = len(next(iter(moves), ()))
        for mine, theirs in ((self.places, other.places), (self.keys, other.keys)):
            for path, place in theirs.items():
                if path[:length] in moves:
                    mine[(*moves[path[:length]], *path[length:])] = place
        for origin, target in moves.items():
            self.files[target] = other.file_of(origin)
        for path, file in other.files.items():
            if path[:length] in moves:
                self.files[(*moves[path[:length]], *path[length:])] = file
        for mine, theirs in ((self.outside, other.outside), (self.broken, other.broken)):
            mine |= {(*moves[path[:length]], *path[length:]) for path in theirs if path[:length] in moves}


def read_tree(text: str, file: str) -> Tree:
    """The tree of a YAML text.

    Raises ModelError where the text is not YAML.
    """
    tree = Tree(file)
    try:
        root = compose(text)
    except NotYamlError as error:
        raise ModelError(Fault(file, *error.place, "", error.message)) from None
    if root is not None:
        _Reader(tree).value(root, ())
    return tree


def read_value(text: str) -> Any:
    """A single value as it would stand in a file: `22 kg`, `5`, `[0, 0, 1]`.

    Raises ModelError.
    """
    tree = read_tree(text, "")
    refuse(tree.faults)
    return tree.data


class _Reader:
    """Walks the nodes of a document and fills a Tree."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.open: set[int] = set()  # nodes around the present one: an alias to one of them has no end
        self.count = 0
        self.tree.data = None

    def value(self, node: Any, path: Path) -> None:
        self.tree.places[path] = node.start_mark
        self.tree.data = self.read(node, path)

    def read(self, node: Any, path: Path) -> Any:
        self.count += 1
        if self.count > MOST:  # through aliases
            raise ModelError(self.tree.fault(path, TOO_MANY))
        if len(path) > DEEPEST:  # through aliases of aliases
            raise ModelError(self.tree.fault(path[:3], TOO_DEEP))
        if node.tag is not None:
            self.report(path, f"the tag `{node.tag.replace(_PREFIX, '!!')}` is not used in machine files")
        if isinstance(node, yaml.ScalarNode):
            return self.scalar(node)
        if id(node) in self.open:
            self.report(path, "this alias leads back to itself")
            return None
        if node.flow_style and (whole := cut_at_comma(node)):
            self.tree.report(path, f'inside [ ] and {{ }} a comma ends a value; put it in quotes: `"{whole}"`')
            return {} if isinstance(node, yaml.MappingNode) else []
        self.open.add(id(node))
        data = self.mapping(node, path) if isinstance(node, yaml.MappingNode) else self.sequence(node, path)
        self.open.discard(id(node))
        return data

    def mapping(self, node: Any, path: Path) -> dict[str, Any]:
        data: dict[str, Any] = {}
        for key_node, value_node in node.value:
            place: Place = key_node.start_mark
            if not isinstance(key_node, yaml.ScalarNode):
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
            at = value_node.start_mark
            self.tree.places[(*path, key)] = at if at.line == place.line else place
            data[key] = self.read(value_node, (*path, key))
        return data

    def sequence(self, node: Any, path: Path) -> list[Any]:
        data = []
        for at, entry in enumerate(node.value):
            self.tree.places[(*path, at)] = entry.start_mark
            data.append(self.read(entry, (*path, at)))
        return data

    def scalar(self, node: Any) -> Hashable:
        text = node.value
        if node.style:
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


def _integer(text: str) -> int | float:
    if len(text) > 300:  # Python refuses to read and write integers of thousands of digits
        return math.inf
    return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
