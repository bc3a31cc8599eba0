"""Imports of the package: no circle of files, late ones by `nivel.lazy` only, few small files. The numbers may only fall."""

import ast
import configparser
import re
import sys
from functools import cache
from pathlib import Path

import nivel

ROOT = Path(__file__).parent.parent
SOURCE = ROOT / "src"
SMALL = 60  # lines of a file, below which its head is most of what one reads
# What there is at most of it: lower these when there is less.
MOST_SMALL_FILES = 136
LARGEST_IMPORT_SHARE = 0.07
# where machine code is made, a library that is not installed is met on one side only
OWN_LATE_IMPORTS = ("nivel.native", "nivel.kernels.core", "nivel.kernels.algebra.analytic")
STANDARD = sys.stdlib_module_names
# the side of machine code that needs Numba and the side that does not call each other
KNOWN_CIRCLE = "nivel.native."


@cache
def sources() -> dict[str, str]:
    """Name of each module → its text."""
    names = {path: ".".join(path.relative_to(SOURCE).with_suffix("").parts) for path in SOURCE.rglob("*.py")}
    return {name.removesuffix(".__init__"): path.read_text(encoding="utf-8") for path, name in names.items()}


@cache
def trees() -> dict[str, ast.Module]:
    """Name of each module → its syntax tree."""
    return {name: ast.parse(text) for name, text in sources().items()}


def is_for_types(node):
    """Whether a statement is there for type checkers only."""
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def imports(node, inside=False):
    """(import statement, whether it stands inside a function) of all below a node that run."""
    for child in ast.iter_child_nodes(node):
        if is_for_types(child):
            for other in child.orelse:
                yield from imports(other, inside)
        elif isinstance(child, ast.Import | ast.ImportFrom):
            yield child, inside
        else:
            yield from imports(child, inside or isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef))


def chains(tree):
    """Names that are written in full behind `nivel.`, as `nivel.lazy` has them."""
    parts_of_others = set()
    for node in ast.walk(tree):
        parts, inner = [], node
        while isinstance(inner, ast.Attribute) and inner not in parts_of_others:
            parts_of_others.add(inner)
            parts.append(inner.attr)
            inner = inner.value
        if parts and isinstance(inner, ast.Name) and inner.id == "nivel":
            yield ".".join(["nivel", *reversed(parts)])


def module_of(name, modules):
    """The module that a full name stands in; None where it is none of the package."""
    while name and name not in modules:
        name = name.rpartition(".")[0]
    return name or None


@cache
def arrows() -> dict[str, set[str]]:
    """Module → modules that it imports, at once or late. The root package is loaded before all of them, so it is none of the ends."""
    modules, out = sources(), {}
    for name, tree in trees().items():
        targets = set()
        for node, _ in imports(tree):
            if isinstance(node, ast.Import):
                targets |= {module_of(each.name, modules) for each in node.names}
            else:
                targets |= {module_of(f"{node.module}.{each.name}", modules) for each in node.names}
        if name != "nivel.lazy":
            targets |= {module_of(chain, modules) for chain in chains(tree)}
        out[name] = set() if name == "nivel" else targets - {None, "nivel", name}
    return out


def circles(graph):
    """Sets of modules that reach each other (Tarjan 1972)."""
    number, low, stack, out = {}, {}, [], []

    def visit(node):
        number[node] = low[node] = len(number)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in number:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], number[other])
        if low[node] == number[node]:
            members = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            out.extend([sorted(members)] if len(members) > 1 else [])

    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(10_000)
    try:
        for node in sorted(graph):
            if node not in number:
                visit(node)
    finally:
        sys.setrecursionlimit(limit)
    return out


def test_circles_are_found():
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}) == [["b", "c"]]
    assert circles({"a": {"b"}, "b": set()}) == []


def test_no_files_import_each_other_in_a_circle():
    found = [circle for circle in circles(arrows()) if not all(name.startswith(KNOWN_CIRCLE) for name in circle)]
    assert not found, found


def stands_in(name, rooms):
    """The narrowest of the rooms (or modules) in which a module stands; None where there is none."""
    return max((room for room in rooms if f"{name}.".startswith(f"{room}.")), key=len, default=None)


def broken(graph, contract):
    """Arrows of a graph that a contract of `.importlinter` does not allow. Layers that `|` divides do not import each other."""
    if contract["type"] == "forbidden":
        sources_, forbidden = contract["source_modules"].split(), contract["forbidden_modules"].split()
        return [
            (name, other)
            for name, others in graph.items()
            for other in others
            if stands_in(name, sources_) and stands_in(other, forbidden)
        ]
    layers = [line for line in contract["layers"].splitlines() if line.strip()]
    rank = {room.strip(): k for k, line in enumerate(layers) for room in re.split("[:|]", line)}
    apart = {room.strip() for line in layers if "|" in line for room in line.split("|")}
    out = []
    for name, others in graph.items():
        here = stands_in(name, rank)
        for other in others:
            there = stands_in(other, rank)
            if here is None or there is None or here == there:
                continue
            if rank[there] < rank[here] or (rank[there] == rank[here] and {here, there} <= apart):
                out.append((name, other))
    return out


def contracts():
    """The contracts of `.importlinter` by name."""
    parser = configparser.ConfigParser()
    parser.read(ROOT / ".importlinter")
    return {parser[name]["name"]: parser[name] for name in parser.sections() if "type" in parser[name]}


def test_arrows_upwards_are_found():
    layers = {"type": "layers", "layers": "a.high\na.left | a.right\na.one : a.two\na.low"}
    allowed = {"a.high.x": {"a.low"}, "a.one": {"a.two"}, "a.two": {"a.one"}, "b": {"a.high"}}
    assert broken(allowed, layers) == []
    upwards = {"a.low.y": {"a.high.x"}, "a.left": {"a.right.z"}}
    assert broken(upwards, layers) == [("a.low.y", "a.high.x"), ("a.left", "a.right.z")]
    forbidden = {"type": "forbidden", "source_modules": "a.low", "forbidden_modules": "a.high"}
    assert broken(upwards, forbidden) == [("a.low.y", "a.high.x")]


def test_late_imports_keep_the_contracts():
    """`lint-imports` sees import statements alone; here names behind `nivel.lazy` count as well."""
    assert len(contracts()) > 8
    found = {name: broken(arrows(), contract) for name, contract in contracts().items()}
    assert not any(found.values()), found


def test_functions_import_nothing_but_what_the_system_may_lack():
    """Late imports are names of `nivel.lazy`; a function imports modules of the standard library only, which not all systems have."""
    found = []
    for name, tree in trees().items():
        if name.startswith(OWN_LATE_IMPORTS):
            continue
        for node, inside in imports(tree):
            names = (
                [each.name for each in node.names]
                if isinstance(node, ast.Import)
                else [f"{node.module}.{node.names[0].name}"]
            )
            late = [each for each in names if inside and each != "nivel" and each.partition(".")[0] not in STANDARD]
            found += [f"{name}:{node.lineno} {each}" for each in late]
    assert not found, found


def test_late_names_stand_for_modules_of_the_package():
    """What is written in full behind `nivel.` in a file that takes it from `nivel.lazy` is in a module that exists and is loaded late; in
    the interface of Python also a public name of the package."""
    modules = sources()
    for name, tree in trees().items():
        if not re.search(r"^from nivel\.lazy import .*\bnivel\b", modules[name], re.MULTILINE):
            continue
        for chain in chains(tree):
            module = module_of(chain, modules)
            public = name == "nivel.api" and chain.split(".")[1] in nivel.__all__
            assert public or module not in (None, "nivel"), f"{name}: {chain}"


def test_few_files_are_small():
    small = sorted(name for name, text in sources().items() if text.count("\n") < SMALL)
    assert len(small) <= MOST_SMALL_FILES, small


def test_few_lines_are_imports():
    lines = sum(text.count("\n") for text in sources().values())
    nodes = [
        node for tree in trees().values() for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)
    ]
    count = sum(node.end_lineno - node.lineno + 1 for node in nodes)
    assert count <= LARGEST_IMPORT_SHARE * lines, count / lines
