"""The binary of a unit: the one that the wheel brought along for all machines, or one that is compiled for this machine."""

from __future__ import annotations

import hashlib
import os
import platform
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from nivel.c_library.exported import Exported, refusal
from nivel.native import library, shipped, store
from nivel.native.workers import CompilationError

SOURCES = (("nivel.c_library", "nivel_machine.h"), ("nivel.fmu", "nivel_fmu.c"))


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
        ("aarch64-linux", "aarch64-linux"), ".so", shipped.LEVELS["armv8-a"].target, "aarch64-linux-gnu-gcc"
    ),
}
HERE = {"Linux": "linux", "Windows": "windows"}


def this_platform() -> str:
    """The name of the platform on which this runs, as FMI has it; one that is not in PLATFORMS has no units."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    return f"{machine}-{HERE.get(platform.system(), platform.system().lower())}"


def binary(machine: Exported, name: str) -> bytes:
    """The shared library of a unit for a platform. Raises ModelError where there is no compiler for it."""
    if (found := shipped.unit_for(name, machine.used)) is not None:
        return found.read_bytes()
    here, chosen = name == this_platform(), PLATFORMS[name]
    compiler = _compiler(chosen, here=here)
    try:
        objects = (
            {entry.symbol: library.object_code(entry) for entry in machine.used}
            if here
            else library.object_codes_for(machine.used, chosen.target)
        )
    except CompilationError as problem:
        raise refusal(f"an FMU for {name} is made of object files, and {problem}") from None
    sources = {**own_sources(), "entries.c": entries_source("entries", machine.codes).encode()}
    sources["tables.c"] = tables_source({"entries": "1"}).encode()
    made_of = hashlib.sha256(b"\0".join([*sources.values(), *(objects[each] for each in sorted(objects))])).hexdigest()
    kept = store.path_of("unit", name, str(shutil.which(compiler)), made_of)
    if (found := store.read(kept)) is None:
        found = _compiled(name, compiler, sources, objects)
        store.write(kept, found)
    return found


def _compiled(name: str, compiler: str, sources: Mapping[str, bytes], objects: Mapping[str, bytes]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        for file, content in {**sources, **{f"{symbol}.o": code for symbol, code in objects.items()}}.items():
            (Path(folder) / file).write_bytes(content)
        target = Path(folder) / f"unit{PLATFORMS[name].suffix}"
        try:
            link([compiler], Path(folder), [*(f"{symbol}.o" for symbol in objects), "entries.c", "tables.c"], target)
        except subprocess.CalledProcessError as problem:
            raise refusal(f"the C compiler `{compiler}` cannot build an FMU for {name}:\n{problem.stderr}") from None
        return target.read_bytes()


def _compiler(chosen: Platform, *, here: bool) -> str:
    """The command of the C compiler. Raises ModelError where there is none."""
    command = os.environ.get("CC", "cc") if here else chosen.compiler
    if shutil.which(command) is None:
        raise refusal(
            f"the C compiler `{command}` that builds this FMU is not installed; a wheel of nivel with machine code needs none"
        )
    return command


def own_sources() -> dict[str, bytes]:
    """The C sources of all units by their files."""
    return {name: files(package).joinpath("sources", name).read_bytes() for package, name in SOURCES}


ENTRY_IN_C = "#include <stddef.h>\ntypedef struct { const char *name; void *code; } nivel_entry;\n"


def entries_source(table: str, symbols: Sequence[str]) -> str:
    """C source of a table of entries."""
    declared = "".join(f"extern char {symbol}[];\n" for symbol in symbols)
    rows = "".join(f'  {{"{symbol}", {symbol}}},\n' for symbol in symbols)
    return f"{ENTRY_IN_C}{declared}const nivel_entry {table}[] = {{\n{rows}  {{NULL, NULL}}}};\n"


def tables_source(tables: Mapping[str, str]) -> str:
    """C source of the list of all tables: each with the condition, in C, on the processor that it is for, the best one first."""
    lines = [ENTRY_IN_C, "typedef struct { int (*fits)(void); const nivel_entry *entries; } nivel_table;"]
    for table, condition in tables.items():
        lines.append(f"extern const nivel_entry {table}[];")
        lines.append(f"static int fits_{table}(void) {{ return {condition}; }}")
    rows = "".join(f"  {{fits_{table}, {table}}},\n" for table in tables)
    return "\n".join([*lines, f"const nivel_table nivel_tables[] = {{\n{rows}  {{NULL, NULL}}}};", ""])


def link(compiler: Sequence[str], folder: Path, parts: Sequence[str], target: Path) -> None:
    """Compile the sources in a folder and link them with other parts. Raises CalledProcessError."""
    flags = ["-O2", "-fPIC", "-fvisibility=hidden", "-shared", "-s"]
    libraries = ["-static-libgcc"] if target.suffix == ".dll" else ["-lm", "-Wl,--no-undefined"]
    command = [*compiler, *flags, "-o", str(target), "nivel_fmu.c", *parts, *libraries]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
