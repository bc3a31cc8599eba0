"""Build a wheel with the library: all entries compiled for the levels of x86-64 processors, linked by the system's compiler.

    python packaging/build_wheel.py [FOLDER]

The wheel goes to FOLDER, `dist` by default. It needs Numba, `cc` and pip; the wheel needs neither.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from rich.progress import Progress

from nivel import __version__
from nivel.analysis.compilation import all_entries
from nivel.native import library, shipped, store, workers
from nivel.native.entry import Entry
from nivel.native.sources import fingerprint

ROOT = Path(__file__).resolve().parent.parent


def compile_entries(entries: list[Entry], folder: Path) -> None:
    """Object files of all entries, in a folder for each level."""
    for level in shipped.LEVELS:
        (folder / level).mkdir()
    jobs = []
    for entry in entries:
        targets = [(str(folder / level / f"{entry.symbol}.o"), (level, "")) for level in shipped.LEVELS]
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
    subprocess.run(["cc", "-shared", "-o", target, *objects, "-Wl,--no-undefined", "-lm", "-s"], check=True)
    print(f"{target.name}: {target.stat().st_size / 1e6:.1f} MB")


def platform() -> str:
    """The systems that have all that the libraries need, by the newest symbol of glibc in them."""
    tables = [
        subprocess.run(["objdump", "-T", path], check=True, capture_output=True, text=True).stdout
        for path in shipped.FOLDER.glob("*.so")
    ]
    minor = max(int(found) for table in tables for found in re.findall(r"GLIBC_2\.(\d+)", table))
    return f"manylinux_2_{minor}_x86_64"


def main() -> None:
    """Compile, link, and pack."""
    wheels = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "dist").resolve()
    entries = all_entries()
    shutil.rmtree(shipped.FOLDER, ignore_errors=True)
    shipped.FOLDER.mkdir()
    try:
        with tempfile.TemporaryDirectory() as folder:
            compile_entries(entries, Path(folder))
            for level in shipped.LEVELS:
                link(Path(folder), level)
        sources = {entry.name: fingerprint(entry.name.partition(":")[0]) for entry in entries}
        manifest = {"version": __version__, "levels": list(shipped.LEVELS), "entries": sources}
        (shipped.FOLDER / shipped.MANIFEST).write_text(json.dumps(manifest, indent=1), encoding="utf-8")
        command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", str(wheels), str(ROOT)]
        subprocess.run(command, check=True, env={**os.environ, "NIVEL_SHIPPED_FOR": platform()})
    finally:
        shutil.rmtree(shipped.FOLDER)


if __name__ == "__main__":
    main()
