"""FMUs of a machine: unpacked, loaded and instantiated when a run starts, each run with instances of its own."""

import atexit
import ctypes
import hashlib
import platform
import shutil
import tempfile
import threading
from pathlib import Path
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError, refuse
from nivel.files.fmu_file import MOST_BYTES, UnitDescription, read_description, unknown_variables, unpack
from nivel.files.sources import read_bytes
from nivel.kernels.core.block import Handle
from nivel.kernels.signals import fmu as kernel
from nivel.kernels.signals.fmu import Fmu
from nivel.machine.control.part import FmuFacts
from nivel.system.signals.foreign import Environment, guard_exit, keeps_environment
from nivel.system.signals.unit import OwnUnit

MOST_MESSAGES = 20
# an instance that was freed, or never made
NOTHING = 0

SYSTEMS = {
    "Linux": ("linux", "linux64", ".so"),
    "Windows": ("windows", "win64", ".dll"),
    "Darwin": ("darwin", "darwin64", ".dylib"),
}
MACHINES = {"AMD64": "x86_64", "arm64": "aarch64"}

# functions by FMI 3.0 and 2.0, in the order of `nivel.kernels.signals.fmu`
CALLED = {
    3: (
        "fmi3SetFloat64",
        "fmi3GetFloat64",
        "fmi3DoStep",
        "fmi3EnterInitializationMode",
        "fmi3EnterInitializationMode",
        "fmi3ExitInitializationMode",
    ),
    2: (
        "fmi2SetReal",
        "fmi2GetReal",
        "fmi2DoStep",
        "fmi2SetupExperiment",
        "fmi2EnterInitializationMode",
        "fmi2ExitInitializationMode",
    ),
}
STATES = {
    3: (
        "fmi3GetFMUState",
        "fmi3SetFMUState",
        "fmi3FreeFMUState",
        "fmi3SerializedFMUStateSize",
        "fmi3SerializeFMUState",
        "fmi3DeserializeFMUState",
    ),
    2: (
        "fmi2GetFMUstate",
        "fmi2SetFMUstate",
        "fmi2FreeFMUstate",
        "fmi2SerializedFMUstateSize",
        "fmi2SerializeFMUstate",
        "fmi2DeSerializeFMUstate",
    ),
}
WORDS = {
    kernel.OF_START: "could not be initialised",
    kernel.OF_STEP: "reported an error in its step",
    kernel.OF_VALUES: "refused a value, or gave none",
    kernel.NO_NUMBER: "gave an output that is not a number",
    kernel.ENDS: "asked to end the simulation",
}

_LOG_3 = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)
_LOG_2 = ctypes.CFUNCTYPE(
    None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_void_p
)


class _Callbacks2(ctypes.Structure):
    _fields_ = (
        ("logger", ctypes.c_void_p),
        ("allocate", ctypes.c_void_p),
        ("release", ctypes.c_void_p),
        ("finished", ctypes.c_void_p),
        ("environment", ctypes.c_void_p),
    )


class FmuInstance(OwnUnit[FmuFacts, Fmu]):
    """The unit of a block as a machine in numbers has it. messages : what it has logged."""

    law = kernel.output

    def __init__(self, facts: FmuFacts) -> None:
        """Raises ModelError where the file is no FMU, or has no such variables."""
        self.facts = facts
        self.messages: list[str] = []
        self._content = read_bytes(facts.file)
        self.description: UnitDescription = read_description(self._content, facts.file)
        faults = [
            Fault.at(f"control.{facts.block}.{key}", message)
            for key, message in unknown_variables(
                self.description, facts.inputs, facts.outputs, [n for n, _ in facts.parameters]
            )
        ]
        refuse(faults)
        self._instance = NOTHING
        self._library: Any = None
        self._kept: list[Any] = []
        self.record = self._record()
        self.handle = Handle(self.record)

    def _record(self) -> Fmu:
        variables = self.description.variables
        names = (self.facts.inputs, self.facts.outputs)
        record = kernel.unloaded(self.description.version, *([variables[n].reference for n in each] for each in names))
        record.address[kernel.INPUTS : kernel.ENVIRONMENT] = [
            array.ctypes.data
            for array in (
                record.inputs,
                record.outputs,
                record.input_references,
                record.output_references,
                record.flags,
                record.last,
            )
        ]
        self._environment = Environment()
        record.address[kernel.ENVIRONMENT :] = self._environment.addresses
        return record

    # --- a run ---

    @keeps_environment
    def begin(self) -> None:
        """A new instance for a run, with the parameters of the block. Raises ModelError where it cannot be had."""
        self.end()
        self.messages.clear()
        guard_exit(f"the FMU of the block {self.facts.block}")
        folder, library = _loaded(self._content, self.description, self.facts)
        self._library = library
        self._instance = self._made(folder)
        if not self._instance:
            tool = ", and says that it needs the program that made it" if self.description.needs_tool else ""
            raise self._refusal(f"could not be instantiated{tool}")
        record, names = self.record, CALLED[self.description.version]
        record.address[: len(names)] = [
            ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0 for name in names
        ]
        record.address[kernel.INSTANCE] = self._instance
        record.number[1:] = kernel.MADE, kernel.NONE, 0
        record.time[0], record.outputs[:] = -np.inf, np.nan
        self._set_parameters()

    def _made(self, folder: Path) -> int:
        name, token = self.facts.block.encode(), self.description.token.encode()
        resources = folder / "resources"
        if self.description.version == 3:
            log = _LOG_3(lambda _e, _s, _c, text: self._log(text))
            make = self._function("fmi3InstantiateCoSimulation", ctypes.c_void_p)
            self._kept = [log]
            where = f"{resources}/".encode()
            return (
                make(name, token, where, False, False, False, False, None, ctypes.c_size_t(0), None, log, None)
                or NOTHING
            )
        log = _LOG_2(lambda _e, _n, _s, _c, text, more: self._log(_formatted(text, more)))
        libc: Any = ctypes.CDLL(None) if platform.system() != "Windows" else ctypes.cdll.msvcrt  # type: ignore[attr-defined]
        addresses = [ctypes.cast(each, ctypes.c_void_p).value for each in (log, libc.calloc, libc.free)]
        callbacks = _Callbacks2(*addresses, None, None)
        self._kept = [log, callbacks]
        make = self._function("fmi2Instantiate", ctypes.c_void_p)
        return make(name, 1, token, resources.as_uri().encode(), ctypes.byref(callbacks), 0, 0) or NOTHING

    def _log(self, text: bytes | None) -> None:
        if text and len(self.messages) < MOST_MESSAGES:
            self.messages.append(text.decode(errors="replace").strip())

    def _set_parameters(self) -> None:
        variables = self.description.variables
        references = np.array([variables[name].reference for name, _ in self.facts.parameters], dtype=np.uint32)
        if self._transfer(kernel.SET, references, np.array([float(value) for _, value in self.facts.parameters])):
            raise self._refusal("refuses its parameters")

    @keeps_environment
    def end(self) -> None:
        """Free the instance of the last run."""
        if self._instance and self._library is not None:
            self._function(f"fmi{self.description.version}FreeInstance", None)(ctypes.c_void_p(self._instance))
        self._instance = NOTHING
        self.record.number[kernel.PHASE] = kernel.ABSENT

    @property
    def failure(self) -> str:
        fault = int(self.record.number[kernel.FAULT])
        if not fault:
            return ""
        names = [
            name for name, value in zip(self.facts.outputs, self.record.outputs, strict=True) if not np.isfinite(value)
        ]
        which = f" (`{names[0]}`)" if fault == kernel.NO_NUMBER and names else ""
        said = f": {self.messages[-1]}" if self.messages else ""
        return f"the FMU of the block {self.facts.block} {WORDS[fault]}{which} at t = {self.record.time[0]:.6g} s{said}"

    # --- states ---

    @keeps_environment
    def state(self) -> bytes:
        """The state of the unit. Raises ModelError where it cannot be read."""
        if not self.description.keeps_states:
            raise self._refusal("cannot save its state, so there is no state of the simulation")
        get, _, free, sized, write, _ = STATES[self.description.version]
        kept, size = ctypes.c_void_p(), ctypes.c_size_t()
        failed = self._fails(get, ctypes.byref(kept)) or self._fails(sized, kept, ctypes.byref(size))
        if size.value > MOST_BYTES:
            raise self._refusal(f"says that its state has {size.value} bytes")
        content = ctypes.create_string_buffer(max(1, size.value))
        failed = failed or self._fails(write, kept, content, size)
        self._call(free, ctypes.byref(kept))
        if failed:
            raise self._refusal("cannot save its state")
        return content.raw[: size.value]

    @keeps_environment
    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where the unit refuses it."""
        _, put, free, _, _, read = STATES[self.description.version]
        kept = ctypes.c_void_p()
        failed = self._fails(read, content, ctypes.c_size_t(len(content)), ctypes.byref(kept)) or self._fails(put, kept)
        self._call(free, ctypes.byref(kept))
        if failed:
            raise self._refusal("refuses a saved state")

    # --- without kernels ---

    def go(self, begin: float, step: float | None, inputs: bytes) -> bytes:
        """Outputs at the time `begin` [s], where the unit begins, or a step later; the failure is set where there are none."""
        record = self.record
        record.time[0] = begin if step is None else begin + step
        record.inputs[:] = np.frombuffer(inputs)
        fault = self._initialise(begin) if step is None else self._step(begin, step)
        if fault == kernel.NONE and self._transfer(kernel.GET, record.output_references, record.outputs):
            fault = kernel.OF_VALUES
        if fault == kernel.NONE and not np.isfinite(record.outputs).all():
            fault = kernel.NO_NUMBER
        record.number[1:] = kernel.RUNNING, fault, record.number[kernel.CALLS] + 1
        return record.outputs.tobytes()

    def _initialise(self, time: float) -> int:
        version = self.description.version
        setup, enter, leave = CALLED[version][kernel.SETUP : kernel.INSTANCE]
        begin, end = ctypes.c_double(time), ctypes.c_double(0.0)
        failed = self._fails(setup, 0, ctypes.c_double(0.0), begin, 0, end)
        if failed or (version == 2 and self._fails(enter)):
            return kernel.OF_START
        if self._transfer(kernel.SET, self.record.input_references, self.record.inputs):
            return kernel.OF_VALUES
        return kernel.OF_START if self._fails(leave) else kernel.NONE

    def _step(self, begin: float, step: float) -> int:
        version, record = self.description.version, self.record
        if self._transfer(kernel.SET, record.input_references, record.inputs):
            return kernel.OF_VALUES
        more = []
        if version == 3:
            record.flags[:] = 0
            first = record.flags.ctypes.data
            more = [ctypes.c_void_p(each) for each in (first, first + 4, first + 8, record.last.ctypes.data)]
        function = CALLED[version][kernel.STEP]
        if self._fails(function, ctypes.c_double(begin), ctypes.c_double(step), 1, *more):
            return kernel.OF_STEP
        return kernel.ENDS if record.flags[1] & 255 else kernel.NONE

    def _transfer(self, function: int, references: Any, values: Any) -> bool:
        """Whether reading or writing values fails."""
        if not len(values):
            return False
        version, count = self.description.version, ctypes.c_size_t(len(values))
        sizes = (count,) if version == 3 else ()
        places = (ctypes.c_void_p(references.ctypes.data), count, ctypes.c_void_p(values.ctypes.data))
        return self._fails(CALLED[version][function], *places, *sizes)

    # --- calls ---

    def _function(self, name: str, result: Any) -> Any:
        """A function of the library that takes what it is called with."""
        function = self._library._FuncPtr((name, self._library))
        function.restype = result
        return function

    def _call(self, name: str, *arguments: Any) -> int:
        """The status; one that FMI does not know is larger than all others."""
        return self._function(name, ctypes.c_uint)(ctypes.c_void_p(self._instance), *arguments)

    def _fails(self, name: str, *arguments: Any) -> bool:
        return self._call(name, *arguments) > kernel.WARNING

    def _refusal(self, what: str) -> ModelError:
        said = f": {self.messages[-1]}" if self.messages else ""
        return self._fault(f"the FMU `{self.facts.file}` {what}{said}")


def _formatted(text: bytes | None, more: int | None) -> bytes | None:
    """A message of FMI 2.0, whose text may be the form of those that follow."""
    if text == b"%s" and more:
        return ctypes.string_at(more)
    return text


# --- libraries ---

_folders: dict[str, Path] = {}
_lock = threading.Lock()


def _loaded(content: bytes, description: UnitDescription, facts: FmuFacts) -> tuple[Path, Any]:
    """The unpacked unit and its library; a folder of its own where there can be one instance in a process only. Raises ModelError."""
    digest = hashlib.sha256(content).hexdigest()
    with _lock:
        folder = None if description.once else _folders.get(digest)
        if folder is None:
            folder = Path(tempfile.mkdtemp(prefix="nivel-fmu-"))
            atexit.register(shutil.rmtree, folder, ignore_errors=True)
            unpack(content, facts.file, folder)
            _folders[digest] = folder
    path = _binary_in(folder, description, facts)
    try:
        return folder, ctypes.CDLL(str(path))
    except OSError as problem:
        message = (
            f"the library of the FMU `{facts.file}` cannot be loaded: {str(problem).replace(str(path), path.name)}"
        )
        raise ModelError(Fault.at(f"control.{facts.block}.file", message)) from None


def _binary_in(folder: Path, description: UnitDescription, facts: FmuFacts) -> Path:
    system, old, suffix = SYSTEMS.get(platform.system(), SYSTEMS["Linux"])
    machine = MACHINES.get(platform.machine(), platform.machine())
    names = [f"{machine}-{system}", *([old] if description.version == 2 and machine == "x86_64" else [])]
    for name in reversed(names):
        path = folder / "binaries" / name / f"{description.identifier}{suffix}"
        if path.is_file():
            return path
    there = sorted(each.name for each in (folder / "binaries").glob("*")) if (folder / "binaries").is_dir() else []
    has = f"it has those of {', '.join(there)}" if there else "it has none"
    message = f"the FMU `{facts.file}` has no binary for {names[-1]}; {has}"
    raise ModelError(Fault.at(f"control.{facts.block}.file", message))
