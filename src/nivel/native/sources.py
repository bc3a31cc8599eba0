"""Sources on which machine code depends.

Of rooms that hold nothing but compiled code (`WHOLE`) it is the text of a module and of all modules that it imports. Elsewhere a kernel
stands beside records, descriptions and pictures: there it is the text of the compiled function, of everything of its module that this
names, directly or not, and of what these import.
"""

import ast
import hashlib
import json
import os
import re
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from nivel.native import store

# Outline of a module: its statements, what they bind, and what each of them names.


class Need(NamedTuple):
    """A name of a module that is needed; empty: all of the module."""

    module: str
    name: str = ""


class Uses(ast.NodeVisitor):
    """What a statement uses. attributes : of all its names, empty where a name stands by itself. imported : names that it imports."""

    def __init__(self, statement: ast.stmt) -> None:
        self.attributes: dict[str, set[str]] = {}
        self.imported: dict[str, Need] = {}
        self.visit(statement)

    def visit_Attribute(self, node: ast.Attribute) -> None:
        if isinstance(node.value, ast.Name):
            self.attributes.setdefault(node.value.id, set()).add(node.attr)
        else:
            self.visit(node.value)

    def visit_Name(self, node: ast.Name) -> None:
        self.attributes.setdefault(node.id, set()).add("")

    def visit_Import(self, node: ast.Import) -> None:
        for each in node.names:
            package, _, last = each.name.rpartition(".")
            if each.asname and package:
                self.imported[each.asname] = Need(package, last)
            else:
                self.imported[each.asname or each.name.partition(".")[0]] = Need(each.name)

    def visit_ImportFrom(self, node: ast.ImportFrom) -> None:
        if node.level:
            dots = "." * node.level
            raise ImportError(f"line {node.lineno}: modules of kernels import by full names, not from `{dots}`")
        for each in node.names:
            self.imported[each.asname or each.name] = Need(str(node.module), each.name)


class Outline:
    """Statements of a module. uses : of each of them. binding : numbers of those that make or change what has a name."""

    def __init__(self, text: str) -> None:
        self.statements = ast.parse(text).body
        self.uses = [Uses(each) for each in self.statements]
        self._lines = text.splitlines()
        self.binding: dict[str, list[int]] = {}
        for number, statement in enumerate(self.statements):
            for name in _bound(statement):
                self.binding.setdefault(name, []).append(number)
        constants = {name for each in self.statements if isinstance(each, ast.Assign) for name in _bound(each)}
        for number, (statement, uses) in enumerate(zip(self.statements, self.uses, strict=True)):
            if not isinstance(statement, ast.Assign | ast.AnnAssign | ast.FunctionDef | ast.ClassDef):
                for name in constants & uses.attributes.keys():  # which it may change
                    self.binding[name].append(number)
        outside = [
            uses
            for statement, uses in zip(self.statements, self.uses, strict=True)
            if not isinstance(statement, ast.FunctionDef | ast.ClassDef)
        ]
        self._imported = {name: need for uses in outside for name, need in uses.imported.items()}

    def text(self, number: int) -> str:
        """A statement as it is written, with its decorators."""
        statement = self.statements[number]
        first = min([statement.lineno, *(each.lineno for each in getattr(statement, "decorator_list", ()))])
        return "\n".join(self._lines[first - 1 : statement.end_lineno])

    def definition(self, need: Need) -> tuple[dict[str, str], list[Need]]:
        """Texts that define a name, by their order in the module, and what these name. An unknown name may be anything in it."""
        if need.name in self._imported:
            return self._import(need.name, self._imported[need.name], {""})
        numbers = self.binding.get(need.name, range(len(self.statements)))
        texts = {f"{number:06}": self.text(number) for number in numbers}
        needs: list[Need] = []
        for number in numbers:
            uses = self.uses[number]
            imported = self._imported | uses.imported
            for name, attributes in uses.attributes.items():
                if name in imported:
                    more = self._import(name, imported[name], attributes)
                    texts |= more[0]
                    needs += more[1]
                elif name in self.binding:
                    needs.append(Need(need.module, name))
            needs += [each for target in uses.imported.values() for each in either(target)]
        return texts, needs

    def _import(self, name: str, target: Need, attributes: Iterable[str]) -> tuple[dict[str, str], list[Need]]:
        return {name: f"{name} = {target}"}, either(target, attributes)


def either(target: Need, attributes: Iterable[str] = ("",)) -> list[Need]:
    """Of `from a import b` b of a, and a.b, which may be a module. attributes : of this, that are used."""
    if not target.name:
        return [Need(target.module)]
    return [target, *(Need(f"{target.module}.{target.name}", each) for each in attributes)]


@cache
def outline_of(path: Path) -> Outline:
    """The outline of a file."""
    return Outline(path.read_text(encoding="utf-8"))


def _bound(statement: ast.stmt) -> Iterator[str]:
    """Names that a statement makes, or whose attributes or items it sets; not those that it imports."""
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        yield statement.name
        return
    for node in ast.walk(statement):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.Attribute | ast.Subscript) and isinstance(node.ctx, ast.Store):
            base = node.value
            while isinstance(base, ast.Attribute | ast.Subscript):
                base = base.value
            if isinstance(base, ast.Name):
                yield base.id


_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)|import[ \t]+([\w.]+))", re.MULTILINE
)
_NAME = re.compile(r"(\w+)(?:[ \t]+as[ \t]+\w+)?")
_COMMENT = re.compile(r"#[^\n]*")
PACKAGE = Path(__file__).resolve().parent.parent
# of Numba's side of this package, what is only about finding, keeping and loading machine code does not change it
PASSIVE = (
    *(f"nivel.native.{name}" for name in ("library", "store", "workers", "sources", "shipped", "processor")),
    # and what is said of integrators, beside their steps, does not either
    "nivel.integrate.facts",
)
WHOLE = ("nivel.kernels", "nivel.integrate", "nivel.motion", "nivel.native")
TRANSLATION = "nivel.native.with_numba.translate"


@cache
def fingerprint(entry: str) -> str:
    """A digest of the `parts` of an entry, or of all of a module."""
    if entry in (known := _kept()["digests"]):
        return str(known[entry])
    digest = hashlib.sha256()
    for name, text in sorted(parts(entry).items()):
        digest.update(f"{name}\0".encode() + text)
    return digest.hexdigest()


def keep(entries: Iterable[str]) -> None:
    """Write the digests of these entries, where they are of this package, for later processes, which need not read the sources."""
    kept = _kept()
    new = [each for each in entries if each.startswith("nivel.") and each not in kept["digests"]]
    if not new:
        return
    files = {str(file) for each in new for file in modules(each).values()}
    kept["files"] = sorted({*kept["files"], *files, *(os.path.dirname(file) for file in files), __file__})
    kept["digests"] |= {each: fingerprint(each) for each in new}
    kept["stamp"] = _stamp(kept["files"])
    with suppress(OSError), store.whole(_index()) as draft:
        draft.write_text(json.dumps(kept), encoding="utf-8")


@cache
def _kept() -> dict[str, Any]:
    """Digests that were kept, with the files and folders that they were made of, as long as none of these has changed."""
    with suppress(OSError, ValueError, LookupError, TypeError):
        found = json.loads(_index().read_text(encoding="utf-8"))
        if found["stamp"] == _stamp(found["files"]):
            return dict(found)
    return {"digests": {}, "files": []}


def _index() -> Path:
    """The file of digests of the package at this place."""
    return store.folder() / f"digests-{hashlib.sha256(str(PACKAGE).encode()).hexdigest()[:16]}.json"


def _stamp(files: Iterable[str]) -> str:
    """What is another one when one of these files or folders is written. Raises OSError where one is gone."""
    facts = [(file, (its := os.stat(file)).st_mtime_ns, its.st_size) for file in files]
    return hashlib.sha256(repr(facts).encode()).hexdigest()


def look_again() -> None:
    """Forget what was read: files may have changed."""
    for function in (fingerprint, _kept, _imported, _content, _own_file, outline_of, file_of):
        function.cache_clear()


def parts(entry: str) -> dict[str, bytes]:
    """What an entry `module:function` depends on, and what translates it: by module its text, or what is needed of that."""
    module, _, path = entry.partition(":")
    out: dict[str, bytes] = {}
    needed: dict[str, dict[str, str]] = {}
    seen: set[Need] = set()
    to_read = [Need(module, path.partition(".")[0]), Need(TRANSLATION)]
    while to_read:
        need = to_read.pop()
        if need in seen or need.module.startswith(PASSIVE) or (file := _own_file(need.module)) is None:
            continue
        seen.add(need)
        if _is_whole(need.module):
            if need.module not in out:
                out[need.module] = _content(file)
                to_read += _imported(file)
        elif not need.name or file_of(f"{need.module}.{need.name}") is None:
            texts, needs = outline_of(file).definition(need)
            needed.setdefault(need.module, {}).update(texts)
            to_read += needs
    return out | {name: "\n".join(texts[key] for key in sorted(texts)).encode() for name, texts in needed.items()}


def modules(entry: str) -> dict[str, Path]:
    """The files of the modules on which an entry depends, by their names."""
    return {name: file for name in parts(entry) if (file := file_of(name)) is not None}


def _is_whole(module: str) -> bool:
    """Whether a module holds nothing but compiled code."""
    return any(module == room or module.startswith(f"{room}.") for room in WHOLE)


@cache
def _is_own(package: str) -> bool:
    """Whether this is nivel, or neither Python's own nor installed: somebody's kernels."""
    if package == "nivel":
        return True
    path = file_of(package)
    if path is None:
        return False
    folder = path.parent.parent if path.name == "__init__.py" else path.parent
    # `pip install --target` installs into a folder of any name
    if {"site-packages", "dist-packages"} & {*path.parts} or next(folder.glob("*.dist-info"), None) is not None:
        return False
    return not any(Path(sysconfig.get_path(each)) in path.parents for each in ("stdlib", "platstdlib"))


@cache
def _own_file(module: str) -> Path | None:
    """The file of a module; None for what is none, compiled, of Python or installed."""
    return file_of(module) if _is_own(module.partition(".")[0]) else None


@cache
def _content(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _imported(path: Path) -> tuple[Need, ...]:
    """What a module of a whole room imports."""
    needs: list[Need] = []
    # parsing all of nivel would take a third of a second
    for package, what, plain in _IMPORT.findall(_content(path).decode()):
        names = _NAME.findall(_COMMENT.sub("", what))
        needs += [Need(plain)] if plain else [need for name in names for need in either(Need(package, name))]
    return tuple(needs)


@cache
def file_of(module: str) -> Path | None:
    """The file of a module; None for what is none, and for compiled ones."""
    parent, _, last = module.rpartition(".")
    if parent:
        above = file_of(parent)
        if above is None or above.name != "__init__.py":
            return None
        folder = above.parent
        return next((p for p in (folder / last / "__init__.py", folder / f"{last}.py") if p.is_file()), None)
    spec = find_spec(module)
    return Path(spec.origin) if spec is not None and spec.origin is not None and spec.origin.endswith(".py") else None
