"""C functions of a machine: compiled where they are a source, and loaded when a run starts, each run with a library of its own."""

import atexit
import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.files.sources import read_bytes
from nivel.kernels.core.block import Handle
from nivel.kernels.signals import c_function as kernel
from nivel.kernels.signals.c_function import CFunction
from nivel.machine.control.part import CFacts
from nivel.native import store
from nivel.system.signals.foreign import Environment, guard_exit, keeps_environment
from nivel.system.signals.unit import OwnUnit

SOURCE = ".c"
SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
FLAGS = ("-O2", "-fPIC", "-shared")
LONGEST_MESSAGE = 2000  # characters of a compiler


class CInstance(OwnUnit[CFacts, CFunction]):
    """The function of a block. Its library is a copy for each run, so that memory of the library begins anew."""

    law = kernel.output

    def __init__(self, facts: CFacts) -> None:
        """Raises ModelError where the file cannot be read or compiled."""
        self.facts = facts
        self._library = _library_of(facts)
        self._folder: Path | None = None
        self._loaded: Any = None
        self.record = CFunction(
            address=np.zeros(kernel.ADDRESSES, dtype=np.uint64),
            number=np.zeros(kernel.NUMBERS, dtype=np.int64),
            time=np.full(1, -np.inf),
            inputs=np.zeros(len(facts.inputs)),
            state=np.array(facts.state, dtype=float),
            outputs=np.full(len(facts.outputs), np.nan),
        )
        arrays = (self.record.inputs, self.record.state, self.record.outputs)
        self.record.address[kernel.INPUTS : kernel.ENVIRONMENT] = [array.ctypes.data for array in arrays]
        self._environment = Environment()
        self.record.address[kernel.ENVIRONMENT :] = self._environment.addresses
        self.handle = Handle(self.record)

    # --- a run ---

    @keeps_environment
    def begin(self) -> None:
        """Load the function for a run. Raises ModelError where there is none of this name."""
        self.end()
        guard_exit(f"the C function {self.facts.function} of the block {self.facts.block}")
        self._folder = Path(tempfile.mkdtemp(prefix="nivel-c-"))
        atexit.register(shutil.rmtree, self._folder, ignore_errors=True)
        path = self._folder / f"unit{SUFFIX}"
        path.write_bytes(self._library)
        try:
            self._loaded = ctypes.CDLL(str(path))
        except OSError as problem:
            why = str(problem).replace(str(path), path.name)
            raise self._fault(f"the library `{self.facts.file}` cannot be loaded: {why}") from None
        try:
            function = getattr(self._loaded, self.facts.function)
        except AttributeError:
            message = f"`{self.facts.file}` has no function `{self.facts.function}`"
            raise self._fault(message, "function") from None
        record = self.record
        record.address[kernel.FUNCTION] = ctypes.cast(function, ctypes.c_void_p).value or 0
        record.number[:] = 0
        record.time[0], record.outputs[:], record.state[:] = -np.inf, np.nan, self.facts.state

    @keeps_environment
    def end(self) -> None:
        """Unload the library of the last run."""
        self.record.address[kernel.FUNCTION] = 0
        if self._loaded is not None:
            _unload(self._loaded)
            self._loaded = None
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    @property
    def failure(self) -> str:
        number = self.record.number
        if not number[kernel.FAULT]:
            return ""
        outputs = zip(self.facts.outputs, self.record.outputs, strict=True)
        which = next((name for name, value in outputs if not np.isfinite(value)), "")
        status = int(number[kernel.STATUS])
        said = {
            kernel.RETURNED: f"returned {status - (status >> 31 << 32)}",
            kernel.NO_NUMBER: f"gave an output that is not a number (`{which}`)",
            kernel.ABSENT: "was not loaded",
        }[int(number[kernel.FAULT])]
        return f"the C function {self.facts.function} of the block {self.facts.block} {said} at t = {self.record.time[0]:.6g} s"

    # --- states ---

    @property
    def arrays(self) -> list[Any]:
        """What a saved state has of it: all but memory of the library."""
        return [self.record.number, self.record.time, self.record.state, self.record.outputs]

    def state(self) -> bytes:
        """Nothing besides the arrays."""
        return b""

    def restore(self, content: bytes) -> None:
        """Nothing besides the arrays."""

    # --- without kernels ---

    def go(self, begin: float, step: float | None, inputs: bytes) -> bytes:
        """Outputs at the time `begin` [s], or a step later; the failure is set where there are none."""
        record = self.record
        time = begin if step is None else begin + step
        record.inputs[:] = np.frombuffer(inputs)
        record.time[0] = time
        address = [ctypes.c_void_p(int(each)) for each in record.address]
        function = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, *3 * [ctypes.c_void_p])(
            int(record.address[kernel.FUNCTION])
        )
        status = function(time, *address[kernel.INPUTS :])
        record.number[kernel.STATUS] = status & 0xFFFFFFFF
        if status:
            record.number[kernel.FAULT] = kernel.RETURNED
        elif not np.isfinite(record.outputs).all():
            record.number[kernel.FAULT] = kernel.NO_NUMBER
        return record.outputs.tobytes()


def _library_of(facts: CFacts) -> bytes:
    """The shared library of a block, compiled where its file is C. Raises ModelError."""
    content = read_bytes(facts.file)
    if Path(facts.file).suffix != SOURCE:
        return content
    command = os.environ.get("CC", "cc")
    compiler = shutil.which(command)
    if compiler is None:
        said = f"the C compiler `{command}` that compiles `{facts.file}` is not installed; give a shared library, `file: unit{SUFFIX}`"
        raise _fault(facts, said)
    # files that it includes may change without a change of its own
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / f"unit{SUFFIX}"
        kept = store.path_of("c_function", compiler, *FLAGS, _run(facts, [compiler, "-E", facts.file]))
        if (found := store.read(kept)) is None:
            _run(facts, [compiler, *FLAGS, "-o", str(target), facts.file, "-lm"])
            found = target.read_bytes()
            store.write(kept, found)
    return found


def _run(facts: CFacts, command: list[str]) -> str:
    try:
        done = subprocess.run(command, check=True, capture_output=True, cwd=Path(facts.file).parent)
    except (OSError, subprocess.CalledProcessError) as problem:
        said = getattr(problem, "stderr", b"") or str(problem).encode()
        text = said.decode(errors="replace").strip()[:LONGEST_MESSAGE]
        raise _fault(facts, f"`{facts.file}` cannot be compiled:\n{text}") from None
    return done.stdout.decode(errors="replace")


def _unload(library: Any) -> None:
    """Give a library back, whose functions are not called any more."""
    if sys.platform == "win32":
        from _ctypes import FreeLibrary  # type: ignore[attr-defined]

        FreeLibrary(library._handle)
    else:
        from _ctypes import dlclose  # type: ignore[attr-defined]

        dlclose(library._handle)


def _fault(facts: CFacts, message: str) -> ModelError:
    return ModelError(Fault.at(f"control.{facts.block}.file", message))
