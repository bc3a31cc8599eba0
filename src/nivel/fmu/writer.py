"""A unit: its description `modelDescription.xml`, with units of its variables and what it can do, and its file, a zip archive of
description, numbers, binaries and licences, the same for the same machine."""

import hashlib
import os
import shutil
import struct
import subprocess
import tempfile
import uuid
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np

import nivel
from nivel.analysis.gradients.outputs import Parameter
from nivel.c_library.exported import Exported, Output, refusal
from nivel.c_library.parameters import Followed, Vary, follow
from nivel.c_library.writer import PLATFORMS, Platform, known_platform, object_codes, this_platform
from nivel.files.target import write_file, written
from nivel.lazy import Struct
from nivel.machine.units.unit import BASES, UnknownUnitError, unit
from nivel.native import shipped, store
from nivel.native.workers import CompilationError

MAGIC = 0x324D464E
# value references: outputs have their places in a frame
INPUT, PARAMETER = 1 << 20, 2 << 20
OFFSET, PRIME = 14695981039346656037, 1099511628211


def outputs_of(machine: Exported) -> tuple[Output, ...]:
    """What a unit has as outputs, by ascending places: neither the time nor inputs, which are variables of their own."""
    own = {f"{each.name}.value" for each in machine.inputs}
    chosen = (each for each in machine.outputs if each.place and each.name not in own)
    return tuple(sorted(chosen, key=lambda each: each.place))


def machine_data(found: Followed, token: str) -> bytes:
    """The file. token : that of the unit."""
    machine = found.machine
    places = [each.place for each in outputs_of(machine)] + [each.followed for each in machine.inputs]
    numbers = {**machine.numbers, "output_count": len(places)}
    numbers["size"] = machine.size_for(len(places))
    names = [name for failure in machine.failures for name in failure.names]
    texts = [token, *machine.codes, *(failure.sentence for failure in machine.failures), *names]
    energy = machine.image.byte_of(machine.loop.machine.record.control.energy.ctypes.data)
    counts = len(machine.codes), len(names), len(found.parameters), len(found.words), energy, len(found.terms)
    rest = b"".join(
        [
            struct.pack("<6Q", *counts),
            struct.pack(f"<{len(numbers)}Q", *numbers.values()),
            *_tables(found),
            np.array(machine.image.words.nonzero()[0], dtype="<u4").tobytes(),
            np.array(places, dtype="<u4").tobytes(),
            *(text.encode() + b"\0" for text in texts),
        ]
    )
    rest += bytes(-len(rest) % 8)
    return struct.pack("<2Q", MAGIC, _sum(rest)) + rest


def _tables(found: Followed) -> Iterator[bytes]:
    machine, image = found.machine, found.machine.image
    yield image.words[image.words.nonzero()[0]].astype("<u8").tobytes()
    for each in machine.inputs:
        yield struct.pack("<2I2d", each.kind, each.value, each.low, each.high)
    if (numbers := found.numbers) is not None:
        defaults = [each.value for each in found.parameters]
        yield np.array([defaults, found.least, numbers.centres, numbers.widths], dtype="<f8").T.tobytes()
        for word, *law in zip(found.words, numbers.constants, numbers.powers, numbers.signs, strict=True):
            yield struct.pack("<Q3d", word, *law)
        for number, parameter in found.terms:
            law = *numbers.factors[number, parameter], *numbers.divisors[number, parameter]
            yield struct.pack("<2I8d", number, parameter, *law)
    for word, byte in image.inner.items():
        yield struct.pack("<2I", word, byte)
    for word, symbol in image.outer.items():
        yield struct.pack("<2I", word, machine.codes.index(symbol))
    first = 0
    for failure in machine.failures:
        yield struct.pack("<3I", failure.status, first, len(failure.names))
        first += len(failure.names)


def _sum(content: bytes) -> int:
    """The sum of Fowler, Noll and Vo over words of eight bytes."""
    out = OFFSET
    for word in np.frombuffer(content, dtype="<u8").tolist():
        out = (out ^ word) * PRIME & 0xFFFFFFFFFFFFFFFF
    return out


# what FMI calls the bases of units; it has none for turns
IN_FMI = {base: base for base in BASES if base != "cycle"}


class Variable(NamedTuple):
    """A variable of a unit. start : value before the first step; None: it is computed."""

    name: str
    reference: int
    causality: str
    units: str
    start: float | None = None
    low: float | None = None
    high: float | None = None
    description: str = ""


def variables_of(found: Followed) -> list[Variable]:
    """Outputs, inputs and parameters."""
    machine = found.machine
    outputs = [Variable(each.name, each.place, "output", each.units) for each in outputs_of(machine)]
    inputs = [
        Variable(each.name, INPUT + k, "input", each.units, each.rest, each.low, each.high, each.description)
        for k, each in enumerate(machine.inputs)
    ]
    parameters = [
        Variable(each.path, PARAMETER + k, "parameter", each.units, each.value, max(least, -1e300))
        for k, (each, least) in enumerate(zip(found.parameters, found.least, strict=True))
    ]
    return [*outputs, *inputs, *parameters]


def description(machine: Exported, variables: Sequence[Variable], token: str, version: int) -> str:
    """The text of the file. version : of FMI, 3 or 2."""
    record, settings = machine.plan.machine, machine.plan.settings
    ours = {
        "fmiVersion": f"{version}.0",
        "modelName": record.name,
        {3: "instantiationToken", 2: "guid"}[version]: token,
        "description": record.description.strip(),
        "generationTool": f"nivel {nivel.__version__}",
    }
    state = {3: "FMUState", 2: "FMUstate"}[version]
    able = {
        "modelIdentifier": machine.identifier,
        f"canGetAndSet{state}": "true",
        f"canSerialize{state}": "true",
        "canHandleVariableCommunicationStepSize": "true",
    }
    if version == 3:
        able["fixedInternalStepSize"] = repr(settings.step)
    experiment = {"startTime": "0.0", "stopTime": repr(settings.duration), "stepSize": repr(settings.step)}
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<fmiModelDescription{_attributes(ours)}>",
        f"<CoSimulation{_attributes(able)}/>",
        *_units(variables),
        "<LogCategories>",
        '<Category name="logStatusError"/>',
        "</LogCategories>",
        f"<DefaultExperiment{_attributes(experiment)}/>",
        "<ModelVariables>",
        *_variables(variables, version),
        "</ModelVariables>",
        *_structure(variables, version),
        "</fmiModelDescription>",
    ]
    return "\n".join(lines) + "\n"


def _attributes(values: Mapping[str, str]) -> str:
    return "".join(f" {name}={quoteattr(_plain(value))}" for name, value in values.items() if value)


def _plain(text: str) -> str:
    """A text without what XML cannot hold."""
    return "".join(each for each in text if each.isprintable() or each.isspace())


def _numbers(each: Variable) -> dict[str, str]:
    found = {"start": each.start, "min": each.low, "max": each.high}
    numbers = {name: repr(value) for name, value in found.items() if value is not None}
    return {"unit": "" if each.units == "1" else each.units, **numbers}


def _variables(variables: Sequence[Variable], version: int) -> Iterator[str]:
    """Version 3 says of what varies continuously nothing, and has the time as a variable."""
    if version == 3:
        yield '<Float64 name="time" valueReference="0" causality="independent" variability="continuous" unit="s"/>'
    for each in variables:
        varies = "fixed" if each.causality == "parameter" else {3: "", 2: "continuous"}[version]
        initial = {"output": "calculated", "parameter": "exact"}.get(each.causality, "")
        given = {"name": each.name, "valueReference": str(each.reference), "causality": each.causality}
        given |= {"variability": varies, "initial": initial, "description": each.description}
        if version == 3:
            yield f"<Float64{_attributes({**given, **_numbers(each)})}/>"
        else:
            yield f"<ScalarVariable{_attributes(given)}><Real{_attributes(_numbers(each))}/></ScalarVariable>"


def _structure(variables: Sequence[Variable], version: int) -> Iterator[str]:
    if version == 3:
        outputs = [each.reference for each in variables if each.causality == "output"]
        yield "<ModelStructure>"
        yield from (f'<Output valueReference="{each}"/>' for each in outputs)
        yield from (f'<InitialUnknown valueReference="{each}"/>' for each in outputs)
        yield "</ModelStructure>"
        return
    places = [k for k, each in enumerate(variables, start=1) if each.causality == "output"]
    if not places:
        yield "<ModelStructure/>"
        return
    unknowns = "".join(f'<Unknown index="{k}"/>' for k in places)
    yield "<ModelStructure>"
    yield f"<Outputs>{unknowns}</Outputs>"
    yield f"<InitialUnknowns>{unknowns}</InitialUnknowns>"
    yield "</ModelStructure>"


def _units(variables: Sequence[Variable]) -> Iterator[str]:
    used = {"s", *(each.units for each in variables)} - {"", "1"}
    yield "<UnitDefinitions>"
    for name in sorted(used):
        base = base_unit(name)
        inner = f"<BaseUnit{_attributes(base)}/>" if base is not None else ""
        yield f"<Unit name={quoteattr(name)}>{inner}</Unit>"
    yield "</UnitDefinitions>"


def base_unit(name: str) -> dict[str, str] | None:
    """A unit as results write it, `kg m^2/s`, in the words of FMI; None where FMI cannot say it, as of roots of masses."""
    exponents, factor = dict.fromkeys(BASES, 0.0), 1.0
    for k, part in enumerate(name.replace("·", " ").replace("*", " ").split("/")):
        for word in part.strip("() ").split():
            symbol, _, power = word.partition("^")
            try:
                found, each = unit(symbol) if symbol != "1" else None, float(power or 1.0) * (-1.0 if k else 1.0)
            except (UnknownUnitError, ValueError):
                return None
            if found is not None:
                factor *= found.factor**each
                for base, exponent in zip(BASES, found.dimension, strict=True):
                    exponents[base] += each * exponent
    if any(exponent % 1.0 for exponent in exponents.values()):
        return None
    base = {IN_FMI[base]: str(int(exponent)) for base, exponent in exponents.items() if exponent and base in IN_FMI}
    return base | ({"factor": repr(factor)} if factor != 1.0 else {})


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
            write_file(Path(folder) / file, "source of the FMU", content)
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
