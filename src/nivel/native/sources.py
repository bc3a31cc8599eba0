"""Sources on which machine code depends: the text of all modules that an entry's module imports, directly or not."""

from __future__ import annotations

import ast
import hashlib
import re
import sysconfig
from functools import cache
from importlib.util import find_spec
from pathlib import Path

_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)|import[ \t]+([\w.]+))", re.MULTILINE
)
_NAME = re.compile(r"\w+")
PACKAGE = Path(__file__).resolve().parent.parent
# of Numba's side of this package, what is only about finding, keeping and loading machine code does not change it
PASSIVE = (
    *(f"nivel.native.{name}" for name in ("library", "store", "workers", "sources", "shipped", "processor")),
    # and what is said of integrators, beside their steps, does not either
    "nivel.integrate.facts",
)


@cache
def fingerprint(module: str) -> str:
    """A digest of the text of `modules`."""
    digest = hashlib.sha256()
    for name, path in sorted(modules(module).items()):
        digest.update(f"{name}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def look_again() -> None:
    """Forget what was read: files may have changed."""
    for function in (fingerprint, _imported, _file):
        function.cache_clear()


def modules(module: str) -> dict[str, Path]:
    """A module, all modules that it imports but installed ones, and what translates them; by name, with their files."""
    found: dict[str, Path] = {}
    to_read = [module, "nivel.native.with_numba.translate"]
    while to_read:
        name = to_read.pop()
        if name in found or name.startswith(PASSIVE) or (path := _file(name)) is None:
            continue
        found[name] = path
        to_read += [each for each in _imported(path) if _is_own(each.partition(".")[0])]
    return found


@cache
def _is_own(package: str) -> bool:
    """Whether this is nivel, or neither Python's own nor installed: somebody's kernels."""
    if package == "nivel":
        return True
    path = _file(package)
    if path is None:
        return False
    folder = path.parent.parent if path.name == "__init__.py" else path.parent
    # `pip install --target` installs into a folder of any name
    if {"site-packages", "dist-packages"} & {*path.parts} or next(folder.glob("*.dist-info"), None) is not None:
        return False
    return not any(Path(sysconfig.get_path(each)) in path.parents for each in ("stdlib", "platstdlib"))


@cache
def _imported(path: Path) -> tuple[str, ...]:
    """Names that the module imports; of `from a import b` both a and a.b, which may be a module."""
    text = path.read_text(encoding="utf-8")
    if not path.is_relative_to(PACKAGE):
        return tuple(imports(text))
    # parsing all of nivel would take a third of a second
    names: list[str] = []
    for package, what, plain in _IMPORT.findall(text):
        names += [plain] if plain else [package, *(f"{package}.{each}" for each in _NAME.findall(what))]
    return tuple(names)


def imports(text: str) -> list[str]:
    """The same of any text. Raises ImportError where it imports relatively to its package."""
    names: list[str] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names += [each.name for each in node.names]
        elif isinstance(node, ast.ImportFrom):
            if node.level:
                raise ImportError(
                    f"line {node.lineno}: modules of kernels import by full names, not from `{'.' * node.level}`"
                )
            names += [str(node.module), *(f"{node.module}.{each.name}" for each in node.names)]
    return names


@cache
def _file(module: str) -> Path | None:
    """The file of a module; None for what is none, and for compiled ones."""
    parent, _, last = module.rpartition(".")
    if parent:
        above = _file(parent)
        if above is None or above.name != "__init__.py":
            return None
        folder = above.parent
        return next((p for p in (folder / last / "__init__.py", folder / f"{last}.py") if p.is_file()), None)
    spec = find_spec(module)
    return Path(spec.origin) if spec is not None and spec.origin is not None and spec.origin.endswith(".py") else None
