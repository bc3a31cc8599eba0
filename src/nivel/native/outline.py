"""Outline of a module: its statements, what they bind, and what each of them names."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple


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
