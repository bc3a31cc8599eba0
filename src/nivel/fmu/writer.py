"""The file of a unit: a zip archive of description, numbers, binaries and licences, the same for the same machine."""

import hashlib
import os
import shutil
import subprocess
import tempfile
import uuid
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path

from nivel.analysis.gradients.outputs import Parameter
from nivel.c_library.exported import Exported, refusal
from nivel.c_library.parameters import Followed, Vary, follow
from nivel.c_library.writer import PLATFORMS, Platform, known_platform, object_codes, this_platform
from nivel.files.target import written
from nivel.fmu.description import description, machine_data, variables_of
from nivel.lazy import Struct
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


VERSIONS = (3, 2)
# of all files in the archive, so that it depends on their content alone
TIME, MODE = (1980, 1, 1, 0, 0, 0), 0o644


class Unit(Struct):
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
    digest = hashlib.sha256(machine_data(found, "") + description(machine, variables, "", version).encode()).digest()
    token = f"{{{uuid.UUID(bytes=digest[:16], version=4)}}}"
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
