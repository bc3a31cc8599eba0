"""Processors: what this one can do, the levels that machine code is compiled for, and the level that the user asks for.

``NIVEL_PROCESSOR_LEVEL`` names a level. Machine code is then for every processor of this level, and on all of them the same.
"""

import os
import platform
from functools import cache
from pathlib import Path
from typing import Final, NamedTuple

from nivel.native.workers import UNKNOWN_LEVEL, CompilationError

VARIABLE: Final = "NIVEL_PROCESSOR_LEVEL"


class Level(NamedTuple):
    """Processors that machine code is for.

    machine : their family, as `platform.machine()` names it. flags : what a processor must have beyond the level below, as Linux names it.
    target : what LLVM compiles for (processor, features, system). comes_with_wheels : whether wheels have a library for it.
    """

    machine: str
    flags: frozenset[str]
    target: tuple[str, str, str]
    comes_with_wheels: bool = True


# the best level of a family first
LEVELS: Final = {
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
    "x86-64-v2": Level(
        "x86_64",
        frozenset({"cx16", "lahf_lm", "popcnt", "sse4_1", "sse4_2", "ssse3"}),
        ("x86-64-v2", "", "x86_64-unknown-linux-gnu"),
        comes_with_wheels=False,
    ),
    # every processor on which Linux calls itself so has floating point and vectors of 128 bits
    "armv8-a": Level("aarch64", frozenset(), ("generic", "+fp-armv8,+neon", "aarch64-unknown-linux-gnu")),
}


@cache
def asked_level() -> str:
    """The level that the user asks for; empty: none. Raises CompilationError where there is none of this name, or not on this processor."""
    name = os.environ.get(VARIABLE, "")
    possible = [each for each in LEVELS if runs_here(LEVELS[each])]
    if name and name not in possible:
        why = "this processor cannot run that" if name in LEVELS else "there is no such level"
        here = f"write one of {', '.join(possible)}, or" if possible else "no level is known for this processor;"
        message = f"the environment variable {VARIABLE} is `{name}`; {why}: {here} leave the variable out"
        raise CompilationError(message, UNKNOWN_LEVEL)
    return name


def target() -> tuple[str, str, str] | None:
    """What LLVM compiles for (processor, features, system), by the level asked for; None: for this processor, with all that it can do."""
    return LEVELS[asked_level()].target if asked_level() else None


def described() -> str:
    """What machine code depends on: the level asked for, else this processor."""
    if asked_level():
        return asked_level()
    return "\n".join(_cpuinfo(key) for key in ("model name", "flags", "Features")) or platform.processor()


def runs_here(level: Level) -> bool:
    """Whether this processor has all that a level needs."""
    return level.machine == platform.machine() and processor_flags() >= level.flags


def processor_flags() -> frozenset[str]:
    """What this processor can do, as Linux names it."""
    return frozenset(_cpuinfo("flags").partition(":")[2].split())


@cache
def lane_count() -> int:
    """Numbers that one instruction computes with: doubles of a vector of this processor, or of the level asked for; 4 at least."""
    best = asked_level() or next((name for name in LEVELS if runs_here(LEVELS[name])), "")
    return 8 if best == "x86-64-v4" else 4


@cache
def _cpuinfo(key: str) -> str:
    """The first line of /proc/cpuinfo that begins with `key`."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return ""
    return next((line for line in lines if line.startswith(key)), "")
