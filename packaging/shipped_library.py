"""Libraries of all entries and binaries of FMUs: compiled for the levels of a family of processors, linked by the system's compiler."""

from __future__ import annotations

import json
import platform
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import files
from pathlib import Path

from nivel import __version__
from nivel.analysis.plan.compilation import all_entries
from nivel.c_library.writer import PLATFORMS
from nivel.cli.progress import progress_count
from nivel.fmu.writer import entries_source, own_sources, tables_source
from nivel.fmu.writer import link as link_shared
from nivel.native import library, shipped, store, workers
from nivel.native.entry import Entry
from nivel.native.processor import LEVELS
from nivel.native.sources import fingerprint

# what C compilers can ask a processor for; what else a level needs comes with these
ASKED = {"avx", "avx2", "avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl", "bmi2", "fma"}


@contextmanager
def built(machine: str) -> Iterator[str]:
    """The libraries of a family of processors, in the package until the context ends. Yields the kind of system that has all they need."""
    entries = all_entries()
    shutil.rmtree(shipped.FOLDER, ignore_errors=True)
    shipped.FOLDER.mkdir()
    try:
        with tempfile.TemporaryDirectory() as folder:
            compile_entries(entries, Path(folder), machine)
            for level in levels(machine):
                link(Path(folder), level)
            for system in units(machine):
                link_unit(Path(folder), system)
        sources = {entry.name: fingerprint(entry.name) for entry in entries}
        manifest = {"version": __version__, "levels": levels(machine), "entries": sources}
        (shipped.FOLDER / shipped.MANIFEST).write_text(json.dumps(manifest, indent=1), encoding="utf-8")
        (shipped.FOLDER / "NOTICE").write_text(notice(), encoding="utf-8")
        yield oldest_system(machine)
    finally:
        shutil.rmtree(shipped.FOLDER)


def families() -> list[str]:
    """Families of processors that a library can be built for."""
    return sorted({level.machine for level in LEVELS.values()})


def levels(machine: str) -> list[str]:
    """Levels of a family of processors that a wheel has libraries for."""
    return [name for name, level in LEVELS.items() if level.machine == machine and level.comes_with_wheels]


def tool(name: str, machine: str) -> str:
    """A command of the compiler that makes code for a family of processors."""
    if machine == platform.machine():
        return {"gcc": "cc"}.get(name, name)
    return f"{machine}-linux-gnu-{name}"


def units(machine: str) -> list[str]:
    """Systems that binaries of FMUs are built for: Linux, and Windows where its cross compiler is installed."""
    windows = f"{machine}-windows"
    return [
        f"{machine}-linux",
        *([windows] if windows in PLATFORMS and shutil.which(PLATFORMS[windows].compiler) else []),
    ]


def compile_entries(entries: list[Entry], folder: Path, machine: str) -> None:
    """Object files of all entries, in a folder for each level, and for each other system."""
    targets_of = {level: LEVELS[level].target for level in levels(machine)}
    targets_of |= {system: PLATFORMS[system].target for system in units(machine) if system.endswith("windows")}
    for name in targets_of:
        (folder / name).mkdir()
    jobs = []
    for entry in entries:
        targets = [(str(folder / name / f"{entry.symbol}.o"), target) for name, target in targets_of.items()]
        jobs.append(library.job_of(entry, targets))
    with progress_count("compiling", quiet=False) as tell:
        names: list[str] = []

        def done(job: dict[str, object]) -> None:
            names.append(str(job["entry"]))
            tell(len(names), len(jobs), names[-1])

        workers.compile_all(jobs, done)
    for path in folder.rglob("*.o"):  # as linkers read them
        code = store.read(path)
        assert code is not None
        path.write_bytes(code)


def link(folder: Path, level: str) -> None:
    """The library of a level."""
    target = shipped.FOLDER / shipped.file_of(level)
    linker = tool("gcc", LEVELS[level].machine)
    objects = sorted((folder / level).glob("*.o"))
    subprocess.run([linker, "-shared", "-o", target, *objects, "-Wl,--no-undefined", "-lm", "-s"], check=True)
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB", flush=True)


def link_unit(folder: Path, system: str) -> None:
    """The binary of all FMUs for a system, with the entries of all levels of its processors, of which it takes the best that fits."""
    for name, content in own_sources().items():
        (folder / name).write_bytes(content)
    machine = system.partition("-")[0]
    if system.endswith("windows"):
        compiler, tables = PLATFORMS[system].compiler, {"entries": condition("x86-64-v3")}
        parts = sorted((folder / system).glob("*.o"))
        (folder / "entries.c").write_text(entries_source("entries", [path.stem for path in parts]), encoding="utf-8")
        parts = [*(path.relative_to(folder) for path in parts), Path("entries.c")]
    else:
        compiler, parts, tables = tool("gcc", machine), [], {}
        for level in levels(machine):
            table = f"entries_{re.sub(r'[^a-z0-9]', '_', level)}"
            parts.append(merged(folder, level, table, machine))
            tables[table] = condition(level)
    (folder / "tables.c").write_text(tables_source(tables), encoding="utf-8")
    target = folder / f"unit{PLATFORMS[system].suffix}"
    link_shared([compiler], folder, [*map(str, parts), "tables.c"], target)
    kept = shipped.FOLDER / shipped.unit_file_of(system)
    shutil.copyfile(target, kept)
    print(f"{kept.name}: {kept.stat().st_size / 1e6:.1f} MB", flush=True)


def merged(folder: Path, level: str, table: str, machine: str) -> Path:
    """One object file of all entries of a level, of which only their table is seen from outside: levels have the same symbols."""
    objects = sorted((folder / level).glob("*.o"))
    source = folder / f"{table}.c"
    source.write_text(entries_source(table, [path.stem for path in objects]), encoding="utf-8")
    compiled, out = source.with_suffix(".o"), folder / f"{table}_all.o"
    subprocess.run([tool("gcc", machine), "-O2", "-fPIC", "-c", source, "-o", compiled], check=True)
    subprocess.run([tool("ld", machine), "-r", "-o", out, compiled, *objects], check=True)
    subprocess.run([tool("objcopy", machine), f"--keep-global-symbol={table}", out], check=True)
    return out


def condition(level: str) -> str:
    """What a processor of a level can do, as C compilers for x86 ask for it."""
    if LEVELS[level].machine != "x86_64":
        return "1"
    asked = sorted({*LEVELS[level].flags} & ASKED)
    return " && ".join(f'__builtin_cpu_supports("{each}")' for each in asked)


def oldest_system(machine: str) -> str:
    """The systems that have all that the libraries need, by the newest symbol of glibc in them."""
    tables = [
        subprocess.run([tool("objdump", machine), "-T", path], check=True, capture_output=True, text=True).stdout
        for path in (*shipped.FOLDER.glob("*.so"), *shipped.FOLDER.glob("unit-*-linux.bin"))
    ]
    # a wheel cannot name a system older than the tags of wheels
    minor = max(17, *(int(found) for table in tables for found in re.findall(r"GLIBC_2\.(\d+)", table)))
    return f"manylinux_2_{minor}_{machine}"


def notice() -> str:
    """Whose code is in the libraries, beside nivel's own."""
    licences = [path for path in files("numba") or [] if path.name.startswith("LICENSE") and "dist-info" in str(path)]
    words = (
        "These libraries contain functions (of arrays and of mathematics) that are part of Numba, under this licence:"
    )
    return "\n\n".join((words, *(path.read_text(encoding="utf-8") for path in licences[:1])))
