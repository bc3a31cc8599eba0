"""Rooms of the package (folders and modules in `src/nivel`), and digests of what dear checks of the whole code depend on.

*Types in a room*: the sources of the room and of every room that it imports, directly or not, and the settings of pyright. *Kernels as
plain Python*: the sources of the rooms that make the arrays of kernels or work on them, and of the tests with all that they import. Both:
the versions of pyright, Numba and the libraries without which nivel does not run.

`tests/checked.json` keeps the digests of what passed: `python tests/all.py --keep-checks` writes it, and a checkout whose sources are
those has nothing to check. The full tests check everything in any case.
"""

import ast
import hashlib
import json
import re
import tomllib
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

ROOT = Path(__file__).parent.parent
KEPT = Path(__file__).parent / "checked.json"
# where pytest's cache holds the digests of the last run without a fault
TYPES, KERNELS = "nivel/types", "nivel/kernels"
# rooms that make the arrays of kernels or work on them
OF_KERNELS = ("native", "kernels", "motion", "integrate", "elements", "system", "machine", "flexible", "analysis")


def rooms_of(package):
    """{name: sources, sorted} of the folders and modules of a package."""
    found = {}
    for path in sorted([*package.rglob("*.py"), *package.rglob("*.pyi")]):
        found.setdefault(path.relative_to(package).parts[0].partition(".")[0], []).append(path)
    return found


def imported(path, package):
    """First parts below `package` of all names that a source imports from it; `__init__` for the package itself."""
    names = set()
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    parts = [name.split(".") for name in names]
    return {part[1] if len(part) > 1 else "__init__" for part in parts if part[0] == package.name}


def closures(rooms, package):
    """{name of a room: names of all rooms that it depends on}; what `package` itself offers comes from its `__init__`."""
    direct = {}
    for name, paths in rooms.items():
        needed = set().union(*(imported(path, package) for path in paths))
        direct[name] = {each if each in rooms else "__init__" for each in needed} & rooms.keys()
    out = {}
    for name in rooms:
        reached, ahead = {name}, [name]
        while ahead:
            more = direct[ahead.pop()] - reached
            reached |= more
            ahead += more
        out[name] = reached
    return out


def surroundings(settings):
    """Settings of pyright and versions of what is installed, as a text."""
    project = tomllib.loads(settings.read_text(encoding="utf-8"))
    needed = project["tool"].get("hatch", {}).get("metadata", {}).get("hooks", {}).get("custom", {})
    names = [re.match(r"[\w-]+", text)[0] for text in needed.get("dependencies", [])]
    return json.dumps([project["tool"]["pyright"], [[name, installed(name)] for name in ("pyright", "numba", *names)]])


def installed(name):
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def digests_of_types(package, settings):
    """{name of a room: digest of all that its types depend on}."""
    rooms, around = rooms_of(package), surroundings(settings)

    @cache
    def own(name):
        digest = hashlib.sha256()
        for path in rooms[name]:
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
        return digest.hexdigest()

    return {
        name: hashlib.sha256(
            " ".join([around, *(f"{each} {own(each)}" for each in sorted(reached))]).encode()
        ).hexdigest()
        for name, reached in closures(rooms, package).items()
    }


def imported_tests(paths, tests):
    """Sources in the folder `tests` that are at `paths` or below, and those there that they import, directly or not."""
    stems = {}
    for path in tests.rglob("*.py"):
        stems.setdefault(path.stem, []).append(path)
    reached = {file for path in paths for file in (path.rglob("*.py") if path.is_dir() else [path])}
    ahead = list(reached)
    while ahead:
        tree = ast.parse(ahead.pop().read_bytes())
        names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
        names |= {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        more = {path for name in names for part in name.split(".") for path in stems.get(part, [])} - reached
        reached |= more
        ahead += more
    return sorted(reached)


def digest_of_kernels(package, settings, tests, paths):
    """Digest of all that kernels as plain Python depend on, in tests at `paths`."""
    rooms = rooms_of(package)
    sources = [path for name in OF_KERNELS for path in rooms.get(name, [])] + imported_tests(paths, tests)
    digest = hashlib.sha256(surroundings(settings).encode())
    for path in sources:
        digest.update(hashlib.sha256(path.name.encode() + b"\0" + path.read_bytes()).digest())
    return digest.hexdigest()


def kept(check):
    """What `tests/checked.json` has of a check: {room: digest}; nothing where there is no such file."""
    return json.loads(KEPT.read_text(encoding="utf-8")).get(check, {}) if KEPT.exists() else {}
