"""Mutations of compiled functions: a sign, an operator, an index or a number of one line changed, chosen by a seed."""

import ast
import random
from dataclasses import dataclass

# decorators of what is compiled
COMPILERS = ("leaf", "stage", "shared", "entry", "address", "family", "element")
# folders of the package whose functions are changed
FOLDERS = ("kernels", "elements", "integrate")
SIGNS = {ast.Add: "-", ast.Sub: "+"}
OPERATORS = {
    ast.Mult: "/",
    ast.Div: "*",
    ast.Lt: ">=",
    ast.LtE: ">",
    ast.Gt: "<=",
    ast.GtE: "<",
    ast.Eq: "!=",
    ast.NotEq: "==",
}
WRITTEN = {
    **{ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"},
    **{ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="},
}  # fmt: skip
# numbers below this guard divisions or are round-off, where half as much again changes nothing
SMALLEST = 1e-5


@dataclass(frozen=True)
class Mutation:
    """In `file` of the package the line `number` (from 1), which reads `before`, becomes `after`."""

    kind: str
    file: str
    number: int
    function: str
    before: str
    after: str


def functions(tree):
    """All functions of a module that are compiled."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and any(_name(each) in COMPILERS for each in node.decorator_list):
            yield node


def _name(decorator):
    return getattr(decorator.func if isinstance(decorator, ast.Call) else decorator, "id", "")


def _changes(function):
    """(kind, line, first and last byte, what is written there instead) of all that can be changed in a function."""
    indices = {
        id(part) for node in ast.walk(function) if isinstance(node, ast.Subscript) for part in ast.walk(node.slice)
    }
    for node in (each for statement in function.body for each in ast.walk(statement)):
        if isinstance(node, ast.BinOp) and type(node.op) in SIGNS | OPERATORS and id(node) not in indices:
            kind = "sign" if type(node.op) in SIGNS else "operator"
            yield kind, node.left, node.right, WRITTEN[type(node.op)], (SIGNS | OPERATORS)[type(node.op)]
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in OPERATORS:
            yield "operator", node.left, node.comparators[0], WRITTEN[type(node.ops[0])], OPERATORS[type(node.ops[0])]
        elif isinstance(node, ast.Constant) and type(node.value) is int and id(node) in indices:
            yield "index", node, None, "", str(node.value - 1 if node.value else 1)
        elif isinstance(node, ast.Constant) and type(node.value) is float and abs(node.value) > SMALLEST:
            yield "constant", node, None, "", repr(1.5 * node.value)


def mutations(package, file):
    """All mutations of a file; `file` as it is below the package."""
    text = (package / file).read_text(encoding="utf-8")
    lines = text.splitlines()
    for function in functions(ast.parse(text)):
        for kind, left, right, written, instead in _changes(function):
            last = left if right is None else right
            if left.lineno != last.end_lineno:
                continue
            line = lines[left.lineno - 1].encode()
            first, end = (
                (left.col_offset, left.end_col_offset) if right is None else (left.end_col_offset, right.col_offset)
            )
            # brackets stand beside the operator
            new = instead if right is None else line[first:end].decode().replace(written, instead, 1)
            after = (line[:first] + new.encode() + line[end:]).decode()
            yield Mutation(kind, file, left.lineno, function.name, line.decode().strip(), after.strip())


def chosen(package, count, seed):
    """So many mutations, the same for the same sources and seed: kinds in turn, no two on one line."""
    files = sorted(path for folder in FOLDERS for path in (package / folder).rglob("*.py"))
    every = [each for path in files for each in mutations(package, path.relative_to(package).as_posix())]
    generator = random.Random(seed)
    kinds = sorted({each.kind for each in every})
    found = {}
    while len(found) < count:
        each = generator.choice([one for one in every if one.kind == kinds[len(found) % len(kinds)]])
        found.setdefault((each.file, each.number), each)
    return list(found.values())


def mutated(package, mutation):
    """The text of the file with the mutation."""
    lines = (package / mutation.file).read_text(encoding="utf-8").splitlines(keepends=True)
    line = lines[mutation.number - 1]
    assert line.strip() == mutation.before
    lines[mutation.number - 1] = line.replace(mutation.before, mutation.after)
    return "".join(lines)
