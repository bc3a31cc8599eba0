"""The library that wheels bring along: all entries in machine code, one file for each level of a family of processors.

`manifest.json` beside it says of which sources each entry was made. An entry whose sources have changed since is not taken from it.
"""

from __future__ import annotations

import ctypes
import json
import platform
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from nivel.native.entry import Entry
from nivel.native.sources import fingerprint
from nivel.native.store import processor_flags

FOLDER = Path(__file__).parent / "shipped"
MANIFEST = "manifest.json"


class Level(NamedTuple):
    """Processors that a library is for. machine : their family, as `platform.machine()` names it. flags : what a processor must have
    beyond the level below, as Linux names it. target : what LLVM compiles for (processor, features, system).
    """

    machine: str
    flags: frozenset[str]
    target: tuple[str, str, str]


# the best level of a family first
LEVELS = {
    "x86-64-v4": Level(
        "x86_64",
        frozenset({"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl", "avx2", "fma", "bmi2"}),
        ("x86-64-v4", "", "x86_64-unknown-linux-gnu"),
    ),
    "x86-64-v3": Level(
        "x86_64",
        frozenset({"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"}),
        ("x86-64-v3", "", "x86_64-unknown-linux-gnu"),
    ),
    # every processor on which Linux calls itself so has floating point and vectors of 128 bits
    "armv8-a": Level("aarch64", frozenset(), ("generic", "+fp-armv8,+neon", "aarch64-unknown-linux-gnu")),
}


def address_in_library(entry: Entry) -> int | None:
    """Address of an entry in the library; None where there is no library that fits, or the entry's sources are others."""
    library = _library()
    if library is None or not fits(entry):
        return None
    return ctypes.cast(getattr(library, entry.symbol), ctypes.c_void_p).value


def fits(entry: Entry) -> bool:
    """Whether the library has this entry, of its present sources."""
    return _library() is not None and manifest()["entries"].get(entry.name) == fingerprint(entry.name.partition(":")[0])


@cache
def level() -> str:
    """The level of the library that is used; empty: none."""
    return next((name for name in manifest()["levels"] if _runs_here(LEVELS[name])), "")


def _runs_here(level: Level) -> bool:
    return level.machine == platform.machine() and processor_flags() >= level.flags


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
    has_all = all(made.get(entry.name) == fingerprint(entry.name.partition(":")[0]) for entry in entries)
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
