"""FMU files: what stands in the archive is checked, and its description is read. Nothing of it is loaded here."""

import io
import lzma
import stat
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path, PurePosixPath
from typing import Final

from nivel.errors import Fault, ModelError
from nivel.files.target import reason_of
from nivel.files.xml_source import Document, Element
from nivel.lazy import Struct, field
from nivel.words.wording import unknown_word

MOST_FILES: Final = 10_000
LONGEST_NAME: Final = 255  # bytes
MOST_BYTES: Final = 500 * 10**6  # of all files, unpacked
DAMAGES: Final = (zipfile.BadZipFile, zlib.error, lzma.LZMAError)
DESCRIPTION: Final = "modelDescription.xml"
# what a variable that is connected is called in FMI 3.0 and 2.0
NUMBER: Final = {3: "Float64", 2: "Real"}


class UnitVariable(Struct):
    """A variable of a unit. kind : `Float64` or another. sizes : whether it is an array."""

    name: str
    reference: int
    causality: str
    kind: str
    is_array: bool = False


class UnitDescription(Struct):
    """What a unit is. version : of FMI. keeps_states : it can read, set and serialise its state. once : only one instance can be in a
    process. needs_tool : it runs only where the program that made it is installed."""

    file: str
    version: int
    identifier: str
    token: str
    keeps_states: bool
    once: bool
    needs_tool: bool
    variables: dict[str, UnitVariable] = field(repr=False)


def read_description(content: bytes, file: str) -> UnitDescription:
    """The description in an archive with this content. Raises ModelError where it is no FMU for co-simulation, or must not be unpacked."""
    with _opened(content, file) as packed:
        names = {each.filename: each for each in _checked(packed, file)}
        if DESCRIPTION not in names:
            raise _fault(file, f"this is no FMU: there is no {DESCRIPTION} in it")
        document = Document(_content(packed, names[DESCRIPTION], file), f"{file}/{DESCRIPTION}")
    return _described(document, file)


def unknown_variables(
    description: UnitDescription, inputs: Iterable[str], outputs: Iterable[str], parameters: Iterable[str]
) -> Iterator[tuple[str, str]]:
    """Key and message of every variable that is named but cannot be connected so."""
    wanted = (
        ("inputs", inputs, ("input",)),
        ("outputs", outputs, ("output", "local", "calculatedParameter")),
        ("parameters", parameters, ("parameter",)),
    )
    number = NUMBER[description.version]
    for key, names, causalities in wanted:
        known = [each.name for each in description.variables.values() if each.causality == causalities[0]]
        for name in names:
            found = description.variables.get(name)
            if found is None:
                yield key, f"{unknown_word(name, known, key[:-1])} of `{Path(description.file).name}`"
            elif found.causality not in causalities:
                given, expected = (
                    f"{'an' if each[:1] in 'aeio' else 'a'} {each}" for each in (found.causality, key[:-1])
                )
                yield key, f"`{name}` is {given} of the FMU, not {expected}"
            elif found.kind != number or found.is_array:
                what = "an array" if found.is_array else f"of the type {found.kind}"
                yield key, f"`{name}` is {what}; single variables of the type {number} are connected"


def unpack(content: bytes, file: str, folder: Path) -> None:
    """Write the files of an archive into a folder. Raises ModelError where it must not be unpacked."""
    with _opened(content, file) as packed:
        for each in _checked(packed, file):
            target = folder / each.filename
            content = b"" if each.is_dir() else _content(packed, each, file)
            try:
                (target if each.is_dir() else target.parent).mkdir(parents=True, exist_ok=True)
                if not each.is_dir():
                    target.write_bytes(content)
            except (OSError, ValueError) as problem:
                reason = reason_of(problem) if isinstance(problem, OSError) else str(problem)
                raise _fault(file, f"`{each.filename[:100]}` cannot be unpacked: {reason}") from None


def _fault(file: str, message: str) -> ModelError:
    return ModelError(Fault(file, 0, 0, "", message))


def _opened(content: bytes, file: str) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(io.BytesIO(content))
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError):
        raise _fault(file, "this is no FMU: it is not a zip archive, or it is damaged") from None


def _checked(packed: zipfile.ZipFile, file: str) -> list[zipfile.ZipInfo]:
    """The files of an archive, none of which leads out of its folder or is more than is unpacked."""
    found = packed.infolist()
    if len(found) > MOST_FILES:
        raise _fault(file, f"the archive has {len(found)} files; up to {MOST_FILES} are unpacked")
    size = sum(each.file_size for each in found)
    if size > MOST_BYTES:
        raise _fault(file, f"unpacked the archive has {size / 1e6:.0f} MB; up to {MOST_BYTES // 10**6} MB are unpacked")
    seen, plain, folders = set[str](), set[str](), set[str]()
    for each in found:
        path = PurePosixPath(each.filename)
        kind = stat.S_IFMT(each.external_attr >> 16)
        leads_out = path.is_absolute() or ".." in path.parts or "\\" in each.filename or ":" in each.filename
        if leads_out or not path.parts:
            raise _fault(file, f"`{each.filename[:100]}` in the archive leads out of its folder")
        if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
            raise _fault(file, f"`{each.filename[:100]}` in the archive is no file, but a link or a device")
        if any(len(part.encode()) > LONGEST_NAME for part in path.parts):
            raise _fault(file, f"`{each.filename[:100]}…` in the archive is longer than the name of a file can be")
        if any(str(folder) in plain for folder in path.parents) or (not each.is_dir() and str(path) in folders):
            raise _fault(file, f"`{each.filename[:100]}` in the archive is a file and a folder")
        folders.update(map(str, path.parents))
        if not each.is_dir():
            plain.add(str(path))
        if str(path) in seen:
            raise _fault(file, f"`{each.filename[:100]}` stands twice in the archive")
        seen.add(str(path))
    return found


def _content(packed: zipfile.ZipFile, each: zipfile.ZipInfo, file: str) -> bytes:
    """A file of the archive, no longer than the archive says."""
    try:
        with packed.open(each) as opened:
            return opened.read(each.file_size)
    except (*DAMAGES, ValueError, OSError, EOFError, RuntimeError) as problem:
        raise _fault(file, f"`{each.filename[:100]}` in the archive cannot be read: {problem}") from None


def _described(document: Document, file: str) -> UnitDescription:
    root = document.root
    version = root.get("fmiVersion")
    if root.tag != "fmiModelDescription" or version[:1] not in ("2", "3"):
        what = f"its version is `{version[:20]}`" if version else "it has no version of FMI"
        raise _fault(file, f"FMUs of FMI 2.0 and 3.0 are read; {what}")
    number = int(version[0])
    simulation = root.first("CoSimulation")
    if simulation is None:
        raise _fault(
            file, "the FMU offers no co-simulation; one for co-simulation was expected, which brings its solver along"
        )
    state = {2: "FMUstate", 3: "FMUState"}[number]
    keeps = [f"canGetAndSet{state}", f"canSerialize{state}"]
    variables = _variables(root, number, document)
    document.raise_faults()
    identifier = simulation.get("modelIdentifier")
    if not identifier.replace("_", "a").isalnum():
        raise _fault(file, f"`{identifier[:50]}` cannot be the name of the binaries of an FMU")
    return UnitDescription(
        file,
        number,
        identifier,
        root.get("instantiationToken") or root.get("guid"),
        all(simulation.get(each) == "true" for each in keeps),
        simulation.get("canBeInstantiatedOnlyOncePerProcess") == "true",
        simulation.get("needsExecutionTool") == "true",
        variables,
    )


def _variables(root: Element, version: int, document: Document) -> dict[str, UnitVariable]:
    out: dict[str, UnitVariable] = {}
    listed = root.first("ModelVariables")
    for each in listed.children if listed is not None else ():
        name, reference = each.get("name"), each.get("valueReference")
        if not name or name in out or not reference.isdecimal() or int(reference) >= 2**32:
            document.fault(each, "a variable needs a name of its own and a value reference, a whole number")
            continue
        kind = each.tag if version == 3 else next((child.tag for child in each.children), "")
        is_array = any(child.tag == "Dimension" for child in each.children)
        out[name] = UnitVariable(name, int(reference), each.get("causality") or "local", kind, is_array)
    return out
