"""Rooms of the package (folders and modules in `src/nivel`), and digests of what the types in a room depend on.

A digest covers the sources of the room and of every room that it imports, directly or not, the settings of pyright, and the versions of
pyright and of the libraries without which nivel does not run. `tests/types.json` keeps the digests under which pyright found no fault:
`python tests/all.py --keep-types` writes it, and a checkout whose sources are those has nothing to check.
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
KEPT = Path(__file__).parent / "types.json"
# where pytest's cache holds the digests of its last run without a fault
RIGHT = "nivel/types"


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


def kept_digests():
    """Digests of the rooms whose types were right; none where there is no such file."""
    return json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
