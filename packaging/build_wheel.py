"""Build a wheel with the library: all entries compiled for the levels of a family of processors, linked by the system's compiler.

    python packaging/build_wheel.py [FOLDER] [--machine x86_64 | aarch64]

The wheel goes to FOLDER, `dist` by default; it is for this machine's family of processors, or for the named one, which needs the cross
compiler of that name (Debian: gcc-aarch64-linux-gnu). Building needs Numba, `cc` and pip; the wheel needs none of them. A wheel goes there
only when it has run an example of each kind of machine in an empty environment, see `check_wheel.py`.
"""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nivel
from check_wheel import UnfitWheelError, check

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "src"


def refuse_other_sources() -> None:
    """End with a sentence where the package that is compiled is not the one that is packed."""
    compiled = Path(nivel.__file__).resolve().parent
    if compiled != SOURCES / "nivel":
        print(
            f"this would compile {compiled} and pack {SOURCES / 'nivel'}, where no machine code would be: "
            f"start it with PYTHONPATH={SOURCES}, or in an environment with `pip install --editable {ROOT}`",
            file=sys.stderr,
        )
        sys.exit(2)


def pack(folder: Path, system: str) -> Path:
    """The wheel of this repository, with the libraries in it, which are for a kind of system."""
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", str(folder), str(ROOT)]
    subprocess.run(command, check=True, env={**os.environ, "NIVEL_SHIPPED_FOR": system})
    (wheel,) = folder.glob("*.whl")
    return wheel


def main() -> None:
    """Compile, link, pack, and check."""
    refuse_other_sources()
    from shipped_library import built, families  # imports nivel, which may be another one until here

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=ROOT / "dist", type=Path)
    parser.add_argument("--machine", choices=families(), default=platform.machine())
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        with built(chosen.machine) as system:
            wheel = pack(Path(folder), system)
        try:
            check(wheel)
        except UnfitWheelError as problem:
            sys.exit(f"the wheel is not fit for use and was not kept: {problem}")
        chosen.folder.mkdir(parents=True, exist_ok=True)
        print(f"built and checked: {shutil.move(wheel, chosen.folder / wheel.name)}")


if __name__ == "__main__":
    main()
