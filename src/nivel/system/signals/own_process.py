"""Units in processes of their own: a unit that crashes or never returns ends the run, and nothing else.

The compiled loop calls functions of Python in place of those of the unit, as those of an FMU of FMI 2.0. They send the inputs to the
other process, and wait for the outputs.
"""

import ctypes
import os
import signal
import subprocess
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from nivel.errors import ModelError
from nivel.kernels.core.block import Handle
from nivel.kernels.signals import fmu as kernel
from nivel.kernels.signals.fmu import Fmu
from nivel.machine.control.part import CFacts, UnitFacts
from nivel.native.workers import python
from nivel.system.signals.unit import Unit

LONGEST_START = 60.0  # s that a process may take to begin
FAILED = 3  # status of FMI
_VALUES = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_uint64, ctypes.c_uint64, ctypes.c_int64, ctypes.c_uint64)
_SETUP = ctypes.CFUNCTYPE(
    ctypes.c_int64, ctypes.c_uint64, ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_int64, ctypes.c_double
)
_STEP = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_uint64, ctypes.c_double, ctypes.c_double, ctypes.c_int64)
_MODE = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_uint64)


class UnitProcess(Unit[UnitFacts, Fmu]):
    """The unit of a block in a process of its own, as a machine in numbers has it."""

    law = kernel.output

    def __init__(self, facts: UnitFacts) -> None:
        """Raises ModelError where the file is no unit. The process begins with a run."""
        self.facts = facts
        self._process: subprocess.Popen[bytes] | None = None
        self._link: Connection | None = None
        self._said = ""
        self._start = 0.0
        self.record = kernel.unloaded(2, [0] * len(facts.inputs), [0] * len(facts.outputs))
        self._functions = (
            _VALUES(lambda *_: 0),  # inputs and outputs stand in the record
            _VALUES(lambda *_: 0),
            _STEP(lambda _i, begin, step, _f: self._go(begin, step)),
            _SETUP(lambda _i, _t, _e, begin, _s, _end: self._remember(begin)),
            _MODE(lambda _i: 0),
            _MODE(lambda _i: self._go(self._start, None)),
        )
        addresses = [ctypes.cast(each, ctypes.c_void_p).value or 0 for each in self._functions]
        self.record.address[: len(addresses)] = addresses
        self.handle = Handle(self.record)
        self._ask_in_new_process()

    # --- a run ---

    def begin(self) -> None:
        """A new process for a run, unless one waits. Raises ModelError where the unit cannot be had."""
        if self.record.number[kernel.CALLS] or self._link is None:
            self._ask_in_new_process()
        self._said = ""
        self.record.number[1:] = kernel.MADE, kernel.NONE, 0
        self.record.time[0], self.record.outputs[:] = -np.inf, np.nan
        self._ask("begin")

    def end(self) -> None:
        """End the process."""
        if self._link is not None:
            with suppress(OSError):
                self._link.close()
            self._link = None
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None
        self.record.number[kernel.PHASE] = kernel.ABSENT

    @property
    def failure(self) -> str:
        if self._said:
            return self._said
        if not self.record.number[kernel.FAULT]:
            return ""
        return f"{self._name} gave an output that is not a number at t = {self.record.time[0]:.6g} s"

    # --- states ---

    def state(self) -> bytes:
        """The state of the unit. Raises ModelError where it cannot be read."""
        return self._ask("state")

    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where the unit refuses it."""
        self._ask("restore", content)

    # --- the other process ---

    @property
    def _name(self) -> str:
        facts = self.facts
        what = f"the C function {facts.function}" if isinstance(facts, CFacts) else "the FMU"
        return f"{what} of the block {facts.block}"

    def _ask_in_new_process(self) -> None:
        """Start the process, which reads the unit. Raises ModelError where it is none."""
        self.end()
        self._link, other = Pipe()
        place = other.fileno()
        words = python("nivel.system.signals.unit_host", str(place))
        if os.name == "posix":
            self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, pass_fds=[place])
        else:
            os.set_handle_inheritable(place, True)  # type: ignore[attr-defined]
            self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, close_fds=False)
        other.close()
        self._ask("unit", self.facts, limit=LONGEST_START)

    def _ask(self, what: str, *given: Any, limit: float | None = None) -> Any:
        """The answer to a question. Raises ModelError where the unit refuses, and where the process has ended."""
        link = self._link
        if link is None:
            raise self._fault(f"{self._name} has no process any more")
        try:
            link.send((what, *given))
            if not link.poll(limit or max(self.facts.time_limit, LONGEST_START)):
                self.end()
                raise self._fault(f"{self._name} gives no answer")
            answer = link.recv()
        except (OSError, EOFError):
            raise self._fault(f"{self._name} {self._ended()}") from None
        if isinstance(answer, ModelError):
            raise answer
        return answer

    def _remember(self, begin: float) -> int:
        self._start = begin
        return 0

    def _go(self, begin: float, step: float | None) -> int:
        """Let the unit go on. A status of FMI: functions of C cannot raise."""
        time = begin + (step or 0.0)
        try:
            link = self._link
            if link is None:
                self._said = f"{self._name} has no process any more at t = {time:.6g} s"
                return FAILED
            link.send(("go", begin, step, self.record.inputs.tobytes()))
            if not link.poll(self.facts.time_limit):
                self.end()
                self._said = f"{self._name} did not return within {self.facts.time_limit:.6g} s at t = {time:.6g} s"
                return FAILED
            said, outputs = link.recv()
            self.record.outputs[:] = np.frombuffer(outputs)
            self._said = said
        except (OSError, EOFError):
            self._said = f"{self._name} {self._ended()} at t = {time:.6g} s"
        except BaseException as problem:  # whatever it is, the loop has to learn of it
            self._said = f"{self._name} cannot be called: {problem}"
        return FAILED if self._said else 0

    def _ended(self) -> str:
        process = self._process
        code = process.wait() if process is not None else 0
        self.end()
        if code < 0 and os.name == "posix":
            return f"crashed ({signal.Signals(-code).name})"
        return f"crashed (exit code {code})"
