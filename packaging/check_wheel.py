"""A check of a wheel with the library: it is whole, carries its licences, and runs an example of each kind where no Numba is.

python packaging/check_wheel.py dist/nivel-*.whl
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from email.parser import Parser
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
# what is run, in the folder of the file, by kind of machine
KINDS = {
    "rigid bodies": ["run mechanisms/slider-crank.yaml"],
    "beams": ["run beams/hinged-beams.yaml"],
    "flexible body": ["reduce flexible/pendulum-bar.yaml", "run flexible/pendulum.yaml"],
    "hydraulics": ["run hydraulics/cylinder-boom.yaml"],
    "control": ["run control/servo-axis.yaml"],
}
LIBRARIES = "nivel/native/shipped"
# licences: the end of their names, and what they speak of
LICENCES = {
    "licenses/LICENSE": "nivel",
    "view/page/NOTICE": "three",
    "shipped/NOTICE": "Numba",
}
# an FMU is written without a C compiler, and its binary can be loaded
UNIT = "export mechanisms/slider-crank.yaml"
LOADS_UNIT = (
    "import ctypes, zipfile; zipfile.ZipFile('slider-crank.fmu').extractall('unit'); "
    "from pathlib import Path; (path,) = Path('unit/binaries').rglob('*.so'); ctypes.CDLL(str(path)).fmi3GetVersion"
)
NO_NUMBA = "import importlib.util, sys; sys.exit(importlib.util.find_spec('numba') is not None)"


class UnfitWheelError(Exception):
    """What a wheel lacks, in sentences."""


def faults(wheel: Path) -> list[str]:
    """What is wrong with the content of a wheel, in sentences; nothing is run."""
    with zipfile.ZipFile(wheel) as packed:
        names = packed.namelist()
        found = []
        if f"{LIBRARIES}/manifest.json" not in names or not any(name.endswith(".so") for name in names):
            found.append("it has no machine code")
        (metadata,) = (name for name in names if name.endswith(".dist-info/METADATA"))
        needed = Parser().parsestr(packed.read(metadata).decode()).get_all("Requires-Dist", [])
        if any(re.match(r"numba\b", each) and "extra" not in each for each in needed):
            found.append("it needs Numba")
        kept = [name for name in names if ".dist-info/licenses/" in name]
        texts = {end: [packed.read(name).decode() for name in kept if name.endswith(end)] for end in LICENCES}
    found += [f"its licences lack {end}" for end, whose in LICENCES.items() if not any(whose in t for t in texts[end])]
    return found


def check(wheel: Path) -> None:
    """Install the wheel in an empty environment and run the examples there. Raises UnfitWheelError."""
    if found := faults(wheel):
        raise UnfitWheelError(f"{wheel.name}: {', and '.join(found)}")
    if not wheel.stem.endswith(platform.machine()):
        print(f"{wheel.name} is for another family of processors: it is not run here", flush=True)
        return
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        own = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "VIRTUAL_ENV"))}
        own["NIVEL_CACHE_DIR"] = str(folder / "machine-code")
        print("checking: installing into an empty environment", flush=True)
        call(f"python -m venv {folder}", [sys.executable, "-m", "venv", "env"], folder, own)
        python = folder / "env" / "bin" / "python"
        call("pip install", [python, "-m", "pip", "install", "--quiet", wheel.resolve()], folder, own)
        call("a search for Numba, which must not be there,", [python, "-c", NO_NUMBA], folder, own)
        shutil.copytree(EXAMPLES, folder / "examples", ignore=shutil.ignore_patterns("*.nc", "*.html"))
        for kind, lines in KINDS.items():
            print(f"checking: {kind}", flush=True)
            for line in lines:
                command, file = line.split()
                path = folder / "examples" / file
                call(
                    f"nivel {line}", [python, "-m", "nivel", command, path.name, "--force", "--quiet"], path.parent, own
                )
        print("checking: FMU", flush=True)
        command, file = UNIT.split()
        beside = (folder / "examples" / file).parent
        without = {**own, "CC": "no-compiler-is-needed"}
        call("nivel export --fmu", [python, "-m", "nivel", command, Path(file).name, "--fmu"], beside, without)
        call("loading the FMU", [python, "-c", LOADS_UNIT], beside, own)
        if any((folder / "machine-code").rglob("*.o")):
            raise UnfitWheelError(f"{wheel.name}: examples were compiled, not run from the library")


def call(what: str, command: list[str | Path], folder: Path, environment: dict[str, str]) -> None:
    """Run a command. Raises UnfitWheelError with what it said where it fails."""
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise UnfitWheelError(f"{what} ended with {done.returncode}: {done.stderr.strip() or done.stdout.strip()}")


def main() -> None:
    """Check the wheels that are named."""
    for wheel in sys.argv[1:]:
        try:
            check(Path(wheel))
        except UnfitWheelError as problem:
            sys.exit(str(problem))
        print(f"fit: {wheel}")


if __name__ == "__main__":
    main()
