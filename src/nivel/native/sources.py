"""Sources on which machine code depends.

Of rooms that hold nothing but compiled code (`WHOLE`) it is the text of a module and of all modules that it imports. Elsewhere a kernel
stands beside records, descriptions and pictures: there it is the text of the compiled function, of everything of its module that this
names, directly or not, and of what these import.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import sysconfig
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from nivel.native import store
from nivel.native.outline import Need, either, outline_of

_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)|import[ \t]+([\w.]+))", re.MULTILINE
)
_NAME = re.compile(r"(\w+)(?:[ \t]+as[ \t]+\w+)?")
_COMMENT = re.compile(r"#[^\n]*")
PACKAGE = Path(__file__).resolve().parent.parent
# of Numba's side of this package, what is only about finding, keeping and loading machine code does not change it
PASSIVE = (
    *(f"nivel.native.{name}" for name in ("library", "store", "workers", "sources", "outline", "shipped", "processor")),
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
