"""Libraries of all entries: compiled for the levels of a family of processors, linked by the system's compiler."""

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
from nivel.cli.progress import progress_count
from nivel.native import library, shipped, store, workers
from nivel.native.entry import Entry
from nivel.native.sources import fingerprint


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
        sources = {entry.name: fingerprint(entry.name.partition(":")[0]) for entry in entries}
        manifest = {"version": __version__, "levels": levels(machine), "entries": sources}
        (shipped.FOLDER / shipped.MANIFEST).write_text(json.dumps(manifest, indent=1), encoding="utf-8")
        (shipped.FOLDER / "NOTICE").write_text(notice(), encoding="utf-8")
        yield oldest_system(machine)
    finally:
        shutil.rmtree(shipped.FOLDER)


def families() -> list[str]:
    """Families of processors that a library can be built for."""
    return sorted({level.machine for level in shipped.LEVELS.values()})


def levels(machine: str) -> list[str]:
    """Levels of a family of processors."""
    return [name for name, level in shipped.LEVELS.items() if level.machine == machine]


def tool(name: str, machine: str) -> str:
    """A command of the compiler that makes code for a family of processors."""
    if machine == platform.machine():
        return {"gcc": "cc"}.get(name, name)
    return f"{machine}-linux-gnu-{name}"


def compile_entries(entries: list[Entry], folder: Path, machine: str) -> None:
    """Object files of all entries, in a folder for each level."""
    for level in levels(machine):
        (folder / level).mkdir()
    jobs = []
    for entry in entries:
        targets = [
            (str(folder / level / f"{entry.symbol}.o"), shipped.LEVELS[level].target) for level in levels(machine)
        ]
        jobs.append(library.job_of(entry, targets))
    with progress_count("compiling", quiet=False) as tell:
        names: list[str] = []

        def done(job: dict[str, object]) -> None:
            names.append(str(job["entry"]))
            tell(len(names), len(jobs), names[-1])

        workers.compile_all(jobs, done)


def link(folder: Path, level: str) -> None:
    """The library of a level."""
    objects = []
    for path in sorted((folder / level).glob("*.o")):
        code = store.read(path)
        assert code is not None
        path.write_bytes(code)
        objects.append(str(path))
    target = shipped.FOLDER / shipped.file_of(level)
    linker = tool("gcc", shipped.LEVELS[level].machine)
    subprocess.run([linker, "-shared", "-o", target, *objects, "-Wl,--no-undefined", "-lm", "-s"], check=True)
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB", flush=True)


def oldest_system(machine: str) -> str:
    """The systems that have all that the libraries need, by the newest symbol of glibc in them."""
    tables = [
        subprocess.run([tool("objdump", machine), "-T", path], check=True, capture_output=True, text=True).stdout
        for path in shipped.FOLDER.glob("*.so")
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
