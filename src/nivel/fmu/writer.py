"""The file of a unit: a zip archive of description, numbers, binaries and licences, the same for the same machine."""

from __future__ import annotations

import hashlib
import uuid
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path

from nivel.analysis.gradients.parameters import Parameter
from nivel.c_library.exported import Exported
from nivel.c_library.writer import PLATFORMS, known_platform
from nivel.files.target import written
from nivel.fmu.binary import binary
from nivel.fmu.data import machine_data
from nivel.fmu.description import description, variables_of
from nivel.fmu.parameters import Followed, Vary, follow
from nivel.lazy import dataclass
from nivel.native import shipped

VERSIONS = (3, 2)
# of all files in the archive, so that it depends on their content alone
TIME, MODE = (1980, 1, 1, 0, 0, 0), 0o644


@dataclass(frozen=True)
class Unit:
    """An FMU that was written. outputs, inputs, parameters : names of its variables. platforms : that it runs on."""

    path: Path
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    parameters: tuple[str, ...]
    platforms: tuple[str, ...]


def write_unit(
    machine: Exported,
    path: Path,
    *,
    version: int,
    platforms: Sequence[str],
    parameters: Sequence[Parameter],
    vary: Vary,
) -> Unit:
    """Write the unit of a machine. version : of FMI. platforms : none is this one. vary : prepares the machine with other values
    of parameters.

    Raises ModelError where a parameter needs an assembly, or a compiler is missing.
    """
    chosen = tuple(dict.fromkeys(known_platform(each) for each in platforms or ("",)))
    found = follow(parameters, machine, vary) if parameters else Followed(machine)
    machine, variables = found.machine, variables_of(found)
    token = _token(found, description(machine, variables, "", version))
    content = {
        "modelDescription.xml": description(machine, variables, token, version).encode(),
        "resources/machine.bin": machine_data(found, token),
        **{f"documentation/licenses/{name}": text.encode() for name, text in licences()},
    }
    for name in chosen:
        folder = PLATFORMS[name].folders[VERSIONS.index(version)]
        content[f"binaries/{folder}/{machine.identifier}{PLATFORMS[name].suffix}"] = binary(machine, name)
    _pack(path, content)
    names = {kind: tuple(each.name for each in variables if each.causality == kind) for kind in KINDS}
    return Unit(path, names["output"], names["input"], names["parameter"], chosen)


FROM_NUMBA = "The binaries contain functions (of arrays and of mathematics) that are part of Numba, under this licence:"
KINDS = ("output", "input", "parameter")


def _token(found: Followed, text: str) -> str:
    """What a unit is known by: it follows from its content."""
    digest = hashlib.sha256(machine_data(found, "") + text.encode()).digest()
    return f"{{{uuid.UUID(bytes=digest[:16], version=4)}}}"


def licences() -> Iterator[tuple[str, str]]:
    """Licences of the code in a unit, by the names of their files: of nivel, and of Numba, of whose functions some are in it."""
    yield "license.txt", files("nivel.fmu").joinpath("sources", "LICENSE").read_text(encoding="utf-8")
    notice = shipped.FOLDER / "NOTICE"
    if notice.exists():
        yield "numba.txt", notice.read_text(encoding="utf-8")
        return
    try:
        kept = [each for each in distribution("numba").files or () if each.name.startswith("LICENSE")]
    except PackageNotFoundError:
        return
    for path in kept[:1]:
        yield "numba.txt", f"{FROM_NUMBA}\n\n{path.read_text(encoding='utf-8')}"


def _pack(path: Path, content: Mapping[str, bytes]) -> None:
    with written(path, "FMU") as draft, zipfile.ZipFile(draft, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, each in content.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr, entry.compress_type, entry.create_system = MODE << 16, zipfile.ZIP_DEFLATED, 3
            packed.writestr(entry, each)
