"""The files of a C library: header, source, machine code, an example, and how they are built."""

import os
import platform
import re
import shutil
from collections.abc import Iterable, Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any, NamedTuple

import nivel
from nivel.analysis.plan.plan import Plan
from nivel.c_library.exported import Exported, export, refusal
from nivel.c_library.image import LINE
from nivel.files.target import reason_of, write_file
from nivel.lazy import Struct
from nivel.native import library
from nivel.native.entry import Entry
from nivel.native.processor import LEVELS
from nivel.native.workers import CompilationError
from nivel.words.wording import unknown_word

SOURCES = files("nivel.c_library").joinpath("sources")
RUNTIME = "nivel_machine.h"


class Files(Struct):
    """What was written. outputs : names of the numbers that the library gives after each step. inputs : names of what can be set.
    size : bytes of one machine. verified : no; a library makes single runs, whose error nothing estimates.
    """

    folder: Path
    name: str
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    size: int
    verified: bool = False


def write_c_library(plan: Plan, folder: Path, select: Sequence[str] = (), platform: str = "") -> Files:
    """Write the library of a run with a fixed step into a new folder. select : see `export`. platform : what it is for; empty: this one.

    Raises ModelError where the integrator chooses its steps, a Python law takes part, or the folder is there already.
    """
    system = known_platform(platform)
    machine = export(plan, "a C library", select)
    if folder.exists():
        raise refusal(f"{folder} is there already; name another folder")
    draft = folder.with_name(f".{folder.name}.{os.getpid()}.part")
    try:
        draft.mkdir(parents=True)
        _write(draft, machine, system)
        _write_machine_code(draft / "kernels", machine.used, system)
        draft.rename(folder)
    except OSError as error:
        raise refusal(f"the C library {folder} cannot be written: {reason_of(error)}") from None
    finally:
        shutil.rmtree(draft, ignore_errors=True)
    outputs, inputs = (tuple(each.name for each in part) for part in (machine.outputs, machine.inputs))
    return Files(folder, machine.identifier, outputs, inputs, machine.size)


def _write(folder: Path, machine: Exported, system: str) -> None:
    name, here, chosen = machine.identifier, system == this_platform(), PLATFORMS[system]
    tools = {
        "compiler": "cc" if here else chosen.compiler,
        "archiver": "ar" if here else chosen.compiler.replace("gcc", "ar"),
        "suffix": chosen.suffix,
    }
    values = {**_texts(machine), **tools, "inputs_declared": "", "inputs_defined": ""}
    if machine.inputs:
        values["inputs_declared"] = _filled("inputs.h", values)
        values["inputs_defined"] = _filled("inputs.c", values)
    for file, template in (
        (f"{name}.h", "machine.h"),
        (f"{name}.c", "machine.c"),
        ("example.c", "example.c"),
        ("Makefile", "Makefile"),
    ):
        write_file(folder / file, "file", _filled(template, values))
    write_file(folder / RUNTIME, "file", SOURCES.joinpath(RUNTIME).read_bytes())


def _filled(template: str, values: Mapping[str, Any]) -> str:
    """The text of a file in `sources` with `$name` and others put in."""
    return Template(SOURCES.joinpath(template).read_text(encoding="utf-8")).substitute(values)


def _texts(machine: Exported) -> dict[str, Any]:
    name, image = machine.identifier, machine.image
    words = image.words.nonzero()[0]
    names = [each for failure in machine.failures for each in failure.names]
    return {
        "name": name,
        "NAME": name.upper(),
        "version": nivel.__version__,
        "size": machine.size,
        "alignment": LINE,
        "step": repr(machine.plan.settings.step),
        "failures": "\n".join(
            f"  {name.upper()}_{failure.status.name} = {failure.status.value}, "
            f"/* {failure.sentence.replace('{}', '...')} */"
            for failure in machine.failures
        ),
        "enumeration": "\n".join(
            f"  {name.upper()}_{_in_capitals(each.name)}, /* {each.units} */" for each in machine.outputs
        ),
        "declarations": "\n".join(f"extern char {symbol}[];" for symbol in machine.codes),
        "codes": _lines(machine.codes, 4),
        "places": _lines(map(str, words.tolist())),
        "words": _lines(f"0x{each:x}u" for each in image.words[words].tolist()),
        "inner": _lines(f"{{{word},{byte}}}" for word, byte in image.inner.items()),
        "outer": _lines(f"{{{word},{machine.codes.index(symbol)}}}" for word, symbol in image.outer.items()),
        "output_places": _lines(str(each.place) for each in machine.outputs),
        "input_places": _lines(f"{{{each.kind}, {each.value}, {each.low!r}, {each.high!r}}}" for each in machine.inputs)
        or "{0, 0, 0, 0}",
        "names": _lines(map(_quoted, names)) or '""',
        "failure_table": _lines(_failure_rows(machine), 1),
        "numbers": _lines((f"  {value} /* {key} */" for key, value in machine.numbers.items()), 1),
        "output_names": _lines(_quoted(each.name) for each in machine.outputs),
        "output_units": _lines(_quoted(each.units) for each in machine.outputs),
        "input_enumeration": "\n".join(
            f"  {name.upper()}_INPUT_{_in_capitals(each.name)}, /* {_remark(each.units, each.description)} */"
            for each in machine.inputs
        ),
        "input_names": _lines(_quoted(each.name) for each in machine.inputs),
        "input_ranges": _lines(f"{{{each.low!r}, {each.high!r}}}" for each in machine.inputs),
    }


def _failure_rows(machine: Exported) -> Iterable[str]:
    """Each with the first of its names, and how many it has."""
    first = 0
    for status, sentence, names in machine.failures:
        yield f"{{{status.value}, {first}, {len(names)}, {_quoted(sentence)}}}"
        first += len(names)


def _in_capitals(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]", "_", name).upper()


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _remark(*parts: str) -> str:
    """Texts for a remark, which nothing in them ends."""
    return ": ".join(" ".join(part.split()).replace("*/", "* /") for part in parts if part) or "no units"


def _lines(parts: Iterable[str], wide: int = 12) -> str:
    """Parts with commas between them, some on each line."""
    listed = list(parts)
    return ",\n".join(", ".join(listed[k : k + wide]) for k in range(0, len(listed), wide))


def _write_machine_code(folder: Path, entries: Sequence[Entry], system: str) -> None:
    folder.mkdir()
    try:
        for symbol, code in object_codes(entries, system).items():
            write_file(folder / f"{symbol}.o", "object file", code)
    except CompilationError as problem:
        raise refusal(f"a C library is made of object files, and {problem}") from None


class Platform(NamedTuple):
    """What a binary is for. folders : its names in FMI 3.0 and 2.0. target : what LLVM compiles for; compiler : command of the C compiler,
    where that is not the one of this system.
    """

    folders: tuple[str, str]
    suffix: str
    target: tuple[str, str, str]
    compiler: str


PLATFORMS = {
    "x86_64-linux": Platform(
        ("x86_64-linux", "linux64"), ".so", ("x86-64-v3", "", "x86_64-unknown-linux-gnu"), "x86_64-linux-gnu-gcc"
    ),
    "x86_64-windows": Platform(
        ("x86_64-windows", "win64"), ".dll", ("x86-64-v3", "", "x86_64-w64-windows-gnu"), "x86_64-w64-mingw32-gcc"
    ),
    "aarch64-linux": Platform(
        ("aarch64-linux", "aarch64-linux"), ".so", LEVELS["armv8-a"].target, "aarch64-linux-gnu-gcc"
    ),
}
HERE = {"Linux": "linux", "Windows": "windows"}


def this_platform() -> str:
    """The name of the platform on which this runs, as FMI has it; one that is not in PLATFORMS has no units."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    return f"{machine}-{HERE.get(platform.system(), platform.system().lower())}"


def known_platform(name: str) -> str:
    """The name of a platform; empty: of this one. Raises ModelError where machines are not exported for it."""
    chosen = name or this_platform()
    if chosen not in PLATFORMS:
        raise refusal(unknown_word(chosen, list(PLATFORMS), "platform"))
    return chosen


def object_codes(entries: Sequence[Entry], name: str) -> dict[str, bytes]:
    """Object files by symbol for a platform; for this one they are those of runs. Raises CompilationError."""
    if name == this_platform():
        return {entry.symbol: library.object_code(entry) for entry in entries}
    return library.object_codes_for(entries, PLATFORMS[name].target)
