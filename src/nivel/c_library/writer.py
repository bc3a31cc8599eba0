"""The files of a C library: header, source, machine code, an example, and how they are built."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nivel
from nivel.analysis.plan.compilation import run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import Loop, start_loop
from nivel.analysis.run.preparation import prepare
from nivel.c_library.image import LINE, WORD, Image, UnknownAddressError
from nivel.c_library.templates import EXAMPLE, HEADER, INPUTS, INPUTS_DECLARED, MAKEFILE, SOURCE
from nivel.errors import Fault, ModelError
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import ALL_STEPS, BUDGET, END, EVENTS, EVERY, FRAMES, RESTART, TIME
from nivel.integrate.loop.sink import Header
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.record.function import CONSTANT
from nivel.machine import Input
from nivel.native import library
from nivel.native.entry import Entry
from nivel.native.workers import CompilationError
from nivel.results.frames.csv_table import columns
from nivel.results.memory import Memory

# as many frames as a step may leave: its own, and that of the start
FRAMES_KEPT = 2
# steps without end, in which times are still exact products of the step
ENDLESS = 2**52


@dataclass(frozen=True)
class Files:
    """What was written. outputs : names of the numbers that the library gives after each step. inputs : names of what can be set.
    size : bytes of one machine.
    """

    folder: Path
    name: str
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    size: int


def write_c_library(plan: Plan, folder: Path) -> Files:
    """Write the library of a run with a fixed step into a new folder.

    Raises ModelError where the integrator chooses its steps, or a Python law takes part.
    """
    if plan.settings.steps == 0:
        raise _fault(
            f"a C library takes steps of one length, and {plan.settings.integrator} chooses them; "
            "take --integrator rk4, or --step-control fixed"
        )
    prepared = prepare(plan.methods)
    loop = _endless(start_loop(prepared, plan.settings))
    entries = [*dict.fromkeys(run_entries(plan))]
    symbols = {entry.address: entry.symbol for entry in entries}
    twins = [prepared.motion.twin] if prepared.motion.twin is not None else []
    try:
        image = Image([loop.machine, *twins, loop.history], symbols)
    except UnknownAddressError:
        raise _fault("Python laws cannot go into a C library; write them as expressions") from None
    name = re.sub(r"\W", "_", plan.machine.name.lower())
    outputs = output_names(plan, prepared)
    inputs = [*zip(plan.machine.inputs, prepared.motion.system.input_functions, strict=True)]
    _write(folder, name, image, loop, outputs, inputs, plan.settings.step)
    _write_machine_code(folder / "kernels", [each for each in entries if each.symbol in _used(image, loop)])
    names = tuple(each.name for each in plan.machine.inputs)
    return Files(folder, name, outputs, names, image.words.nbytes + WORD * (1 + len(inputs)))


def _fault(message: str) -> ModelError:
    return ModelError(Fault("", 0, 0, "", message))


def _endless(loop: Loop) -> Loop:
    """The loop with a frame after each step and room for no more than that, and without an end."""
    run = loop.history.record
    run.counter[EVERY], run.counter[ALL_STEPS], run.clock[END] = 1, ENDLESS, 1e300
    kept = run._replace(frames=run.frames[:FRAMES_KEPT].copy())
    return loop._replace(history=Handle(kept))


def output_names(plan: Plan, prepared: Prepared) -> tuple[str, ...]:
    """Names of the numbers of a frame, as results have them: `time`, `crank.position.x`, `kinetic_energy`."""
    sink = Memory()
    attributes = run_attributes(plan.machine, "", prepared, plan.settings)
    sink.begin(Header(prepared.motion.system.layout, attributes))
    return ("time", *columns(sink.result()))


def _used(image: Image, loop: Loop) -> set[str]:
    """Symbols that the library reaches. Families of forces call no entries but by addresses in the image."""
    return {*image.outer.values(), advance.symbol, loop.evaluate.symbol, loop.correct.symbol, loop.step.symbol}


def _write(
    folder: Path,
    name: str,
    image: Image,
    loop: Loop,
    outputs: Sequence[str],
    inputs: Sequence[tuple[Input, int]],
    step: float,
) -> None:
    """inputs : each with the number of its function."""
    try:
        folder.mkdir(parents=True)
    except FileExistsError:
        raise _fault(f"{folder} is there already; name another folder") from None
    run = loop.history.record
    words = image.words.nonzero()[0]
    values: dict[str, Any] = {
        "name": name,
        "NAME": name.upper(),
        "version": nivel.__version__,
        "size": -(-(image.words.nbytes + WORD * (1 + len(inputs))) // LINE)
        * LINE,  # `aligned_alloc` wants multiples of it
        "step": repr(step),
        "width": len(outputs),
        "count": len(words),
        "inner_count": len(image.inner),
        "outer_count": len(image.outer),
        "output_names": _lines(f'"{each}"' for each in outputs),
        "enumeration": _lines(f"{name.upper()}_{re.sub(r'[^A-Za-z0-9]', '_', each).upper()}" for each in outputs),
        "places": _lines(map(str, words.tolist())),
        "words": _lines(f"0x{each:x}u" for each in image.words[words].tolist()),
        "inner": _lines(f"{{{word},{byte}}}" for word, byte in image.inner.items()),
        "outer": _lines(f"{{{word},{symbol}}}" for word, symbol in image.outer.items()),
        "declarations": "\n".join(
            f"extern char {symbol}[];" for symbol in sorted(_used(image, loop) - {advance.symbol})
        ),
        "advance": advance.symbol,
        "evaluate": loop.evaluate.symbol,
        "correct": loop.correct.symbol,
        "take_step": loop.step.symbol,
        "machine": image.byte_of(int(loop.machine.address)),
        "history": image.byte_of(int(loop.history.address)),
        "budget": image.byte_of(run.counter.ctypes.data) + WORD * BUDGET,
        "frame_count": image.byte_of(run.counter.ctypes.data) + WORD * FRAMES,
        "event_count": image.byte_of(run.counter.ctypes.data) + WORD * EVENTS,
        "time": image.byte_of(run.clock.ctypes.data) + WORD * TIME,
        "frames": image.byte_of(run.frames.ctypes.data),
        "spent": BUDGET_SPENT,
        "step_body": "return go_on(machine, 1);",
        "inputs_declared": "",
        "inputs_defined": "",
    }
    if inputs:
        values |= _input_values(name, image, loop, inputs)
        values["inputs_declared"] = INPUTS_DECLARED.substitute(values)
        values["inputs_defined"] = INPUTS.substitute(values)
        values["step_body"] = "int failure = read_inputs(machine); return failure ? failure : go_on(machine, 1);"
    for file, template in (
        (f"{name}.h", HEADER),
        (f"{name}.c", SOURCE),
        ("example.c", EXAMPLE),
        ("Makefile", MAKEFILE),
    ):
        (folder / file).write_text(template.substitute(values), encoding="utf-8")


def _input_values(name: str, image: Image, loop: Loop, inputs: Sequence[tuple[Input, int]]) -> dict[str, Any]:
    """What the templates say of inputs. The words behind the image: whether any was changed since the last step, and which were set."""
    run, functions = loop.history.record, loop.machine.record.functions
    kinds, numbers = (image.byte_of(each.ctypes.data) for each in (functions.kind, functions.value))
    places = [(kinds + functions.kind.itemsize * k, numbers + WORD * k) for _, k in inputs]
    ranges = [each.range for each, _ in inputs]
    return {
        "input_enumeration": _lines(
            f"{name.upper()}_INPUT_{re.sub(r'[^A-Za-z0-9]', '_', each.name).upper()}" for each, _ in inputs
        ),
        "input_names": _lines(f'"{each.name}"' for each, _ in inputs),
        "input_ranges": _lines(f"{{{low!r}, {high!r}}}" for low, high in ranges),
        "input_places": _lines(f"{{{kind}, {number}}}" for kind, number in places),
        "touched": image.words.nbytes,
        "constant": CONSTANT,
        "restart": image.byte_of(run.counter.ctypes.data) + WORD * RESTART,
        "y": image.byte_of(run.y.ctypes.data),
        "rate": image.byte_of(run.rate.ctypes.data),
        "y_size": len(run.y),
    }


def _lines(parts: Iterable[str], wide: int = 12) -> str:
    """Parts with commas between them, some on each line."""
    listed = list(parts)
    return ",\n".join(", ".join(listed[k : k + wide]) for k in range(0, len(listed), wide))


def _write_machine_code(folder: Path, entries: Sequence[Entry]) -> None:
    folder.mkdir()
    try:
        for entry in entries:
            (folder / f"{entry.symbol}.o").write_bytes(library.object_code(entry))
    except CompilationError as problem:
        shutil.rmtree(folder.parent)
        raise _fault(f"a C library is made of object files, and {problem}") from None
