"""The binary of a unit: the one that the wheel brought along for all machines, or one that is compiled for this machine."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path

from nivel.c_library.exported import Exported, refusal
from nivel.c_library.writer import PLATFORMS, Platform, object_codes, this_platform
from nivel.native import shipped, store
from nivel.native.workers import CompilationError

SOURCES = (("nivel.c_library", "nivel_machine.h"), ("nivel.fmu", "nivel_fmu.c"))


def binary(machine: Exported, name: str) -> bytes:
    """The shared library of a unit for a platform. Raises ModelError where there is no compiler for it."""
    if (found := shipped.unit_for(name, machine.used)) is not None:
        return found.read_bytes()
    here, chosen = name == this_platform(), PLATFORMS[name]
    compiler = _compiler(chosen, here=here)
    try:
        objects = object_codes(machine.used, name)
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
