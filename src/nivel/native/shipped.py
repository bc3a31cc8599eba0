"""The library that wheels bring along: all entries in machine code, one file for each level of a family of processors.

`manifest.json` beside it says of which sources each entry was made. An entry whose sources have changed since is not taken from it.
"""

import ctypes
import json
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from nivel.native.entry import Entry
from nivel.native.processor import LEVELS, asked_level, runs_here
from nivel.native.sources import fingerprint

FOLDER = Path(__file__).parent / "shipped"
MANIFEST = "manifest.json"


def address_in_library(entry: Entry) -> int | None:
    """Address of an entry in the library; None where there is no library that fits, or the entry's sources are others."""
    library = _library()
    if library is None or not fits(entry):
        return None
    return ctypes.cast(getattr(library, entry.symbol), ctypes.c_void_p).value


def fits(entry: Entry) -> bool:
    """Whether the library has this entry, of its present sources."""
    return _library() is not None and manifest()["entries"].get(entry.name) == fingerprint(entry.name)


@cache
def level() -> str:
    """The level of the library that is used: the best one, or that which the user asks for; empty: none."""
    possible = [name for name in manifest()["levels"] if runs_here(LEVELS[name])]
    return next((name for name in possible if asked_level() in ("", name)), "")


@cache
def manifest() -> dict[str, Any]:
    """Levels that are there, best first, and the digest of the sources of every entry."""
    try:
        found = json.loads((FOLDER / MANIFEST).read_text(encoding="utf-8"))
    except OSError:
        return {"levels": [], "entries": {}}
    found["levels"] = [name for name in LEVELS if name in found["levels"]]
    return found


def file_of(name: str) -> str:
    """Name of the library of a level."""
    return f"libnivel-{name}.so"


def unit_for(system: str, entries: Iterable[Entry]) -> Path | None:
    """The binary of FMUs for a system, `x86_64-linux`, that came with the library and has these entries, of their present sources."""
    path = FOLDER / unit_file_of(system)
    made = manifest()["entries"]
    has_all = all(made.get(entry.name) == fingerprint(entry.name) for entry in entries)
    return path if has_all and path.exists() else None


def unit_file_of(system: str) -> str:
    """Name of the binary of FMUs for a system."""
    return f"unit-{system}.bin"


@cache
def _library() -> ctypes.CDLL | None:
    if not level():
        return None
    try:
        return ctypes.CDLL(str(FOLDER / file_of(level())))
    except OSError as problem:
        print(f"the library of this installation is not used: {problem}", file=sys.stderr)
        return None
