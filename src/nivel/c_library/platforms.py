"""Systems that machines are exported for."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from typing import NamedTuple

from nivel.c_library.exported import refusal
from nivel.native import library
from nivel.native.entry import Entry
from nivel.native.processor import LEVELS
from nivel.words.wording import unknown_word


class Platform(NamedTuple):
    """What a binary is for. folders : its names in FMI 3.0 and 2.0. target : what LLVM compiles for; compiler : command of the C compiler,
    where that is not the one of this system.
    """

    folders: tuple[str, str]
    suffix: str
    target: tuple[str, str, str]
    compiler: str


PLATFORMS = {
    "x86_64-linux": Platform(
        ("x86_64-linux", "linux64"), ".so", ("x86-64-v3", "", "x86_64-unknown-linux-gnu"), "x86_64-linux-gnu-gcc"
    ),
    "x86_64-windows": Platform(
        ("x86_64-windows", "win64"), ".dll", ("x86-64-v3", "", "x86_64-w64-windows-gnu"), "x86_64-w64-mingw32-gcc"
    ),
    "aarch64-linux": Platform(
        ("aarch64-linux", "aarch64-linux"), ".so", LEVELS["armv8-a"].target, "aarch64-linux-gnu-gcc"
    ),
}
HERE = {"Linux": "linux", "Windows": "windows"}


def this_platform() -> str:
    """The name of the platform on which this runs, as FMI has it; one that is not in PLATFORMS has no units."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    return f"{machine}-{HERE.get(platform.system(), platform.system().lower())}"


def known_platform(name: str) -> str:
    """The name of a platform; empty: of this one. Raises ModelError where machines are not exported for it."""
    chosen = name or this_platform()
    if chosen not in PLATFORMS:
        raise refusal(unknown_word(chosen, list(PLATFORMS), "platform"))
    return chosen


def object_codes(entries: Sequence[Entry], name: str) -> dict[str, bytes]:
    """Object files by symbol for a platform; for this one they are those of runs. Raises CompilationError."""
    if name == this_platform():
        return {entry.symbol: library.object_code(entry) for entry in entries}
    return library.object_codes_for(entries, PLATFORMS[name].target)
