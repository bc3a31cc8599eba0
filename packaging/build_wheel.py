"""Build a wheel with the library: all entries compiled for the levels of a family of processors, linked by the system's compiler.

    python packaging/build_wheel.py [FOLDER] [--machine x86_64 | aarch64]

The wheel goes to FOLDER, `dist` by default; it is for this machine's family of processors, or for the named one, which needs the cross
compiler of that name (Debian: gcc-aarch64-linux-gnu). Building needs Numba, `cc` and pip; the wheel needs none of them.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from importlib.metadata import files
from pathlib import Path

from rich.progress import Progress

from nivel import __version__
from nivel.analysis.plan.compilation import all_entries
from nivel.native import library, shipped, store, workers
from nivel.native.entry import Entry
from nivel.native.sources import fingerprint

ROOT = Path(__file__).resolve().parent.parent


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
    with Progress() as progress:
        task = progress.add_task("compiling", total=len(jobs))
        workers.compile_all(jobs, lambda _: progress.advance(task))


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
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB")


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


def main() -> None:
    """Compile, link, and pack."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=ROOT / "dist", type=Path)
    families = sorted({level.machine for level in shipped.LEVELS.values()})
    parser.add_argument("--machine", choices=families, default=platform.machine())
    chosen = parser.parse_args()
    entries = all_entries()
    shutil.rmtree(shipped.FOLDER, ignore_errors=True)
    shipped.FOLDER.mkdir()
    try:
        with tempfile.TemporaryDirectory() as folder:
            compile_entries(entries, Path(folder), chosen.machine)
            for level in levels(chosen.machine):
                link(Path(folder), level)
        sources = {entry.name: fingerprint(entry.name.partition(":")[0]) for entry in entries}
        manifest = {"version": __version__, "levels": levels(chosen.machine), "entries": sources}
        (shipped.FOLDER / shipped.MANIFEST).write_text(json.dumps(manifest, indent=1), encoding="utf-8")
        (shipped.FOLDER / "NOTICE").write_text(notice(), encoding="utf-8")
        command = [
            sys.executable,
            "-m",
            "pip",
            "wheel",
            "--no-deps",
            "--wheel-dir",
            str(chosen.folder.resolve()),
            str(ROOT),
        ]
        subprocess.run(command, check=True, env={**os.environ, "NIVEL_SHIPPED_FOR": oldest_system(chosen.machine)})
    finally:
        shutil.rmtree(shipped.FOLDER)


if __name__ == "__main__":
    main()
