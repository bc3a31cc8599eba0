"""What machine code depends on: the text of all modules that an entry's module imports, directly or not."""

from __future__ import annotations

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
# of Numba's side of this package, what is only about finding, keeping and loading machine code does not change it
PASSIVE = tuple(f"nivel.native.{name}" for name in ("library", "store", "workers", "sources", "shipped"))


@cache
def fingerprint(module: str) -> str:
    """A digest of the text of `modules`."""
    digest = hashlib.sha256()
    for name, path in sorted(modules(module).items()):
        digest.update(f"{name}\0".encode() + path.read_bytes())
    return digest.hexdigest()


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
    installed = [Path(sysconfig.get_path(each)) for each in ("stdlib", "platstdlib", "purelib", "platlib")]
    return path is not None and not any(folder in path.parents for folder in installed)


@cache
def _imported(path: Path) -> tuple[str, ...]:
    """Names that the module imports; of `from a import b` both a and a.b, which may be a module."""
    names: list[str] = []
    for package, what, plain in _IMPORT.findall(path.read_text(encoding="utf-8")):
        names += [plain] if plain else [package, *(f"{package}.{each}" for each in _NAME.findall(what))]
    return tuple(names)


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
