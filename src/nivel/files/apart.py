"""Foreign code apart: libraries that read and mesh what others have made run in processes of their own with limits.

A damaged file may crash such a library, or keep it busy for ever. That ends its process, and is a sentence here. A process that has
answered waits a minute for the next file.
"""

from __future__ import annotations

import atexit
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Lock, Thread
from typing import Any, Final, TypeVar

from nivel.errors import ModelError
from nivel.native.workers import python

T = TypeVar("T")
LONGEST: Final = 600.0  # [s] of a call
ALARM: Final = 14  # signal
IDLE: Final = 60  # [s] that a process waits for the next one


def apart(function: Callable[..., T], *given: Any, failed: str, longest: float = LONGEST) -> T:
    """What a function of a module returns, called in another process, with all memory of the machine at most.

    failed : how messages begin, `crane.step cannot be read`. longest [s] : it may take. Raises ModelError as the function does, and where
    its process crashes or goes beyond a limit.
    """
    process = _taken(function.__module__)
    answers: SimpleQueue[tuple[bool, Any] | None] = SimpleQueue()
    whole = False
    try:
        Thread(target=_ask, args=(process, (function, given), answers), daemon=True).start()
        answer = answers.get(timeout=longest)
        whole = answer is not None
    except Empty:
        raise ModelError(f"{failed}: this took longer than {longest:g} s") from None
    finally:
        if not whole:
            _end(process)
    if answer is None and process.returncode == -ALARM:  # its minute was over as it was asked
        return apart(function, *given, failed=failed, longest=longest)
    if answer is None:
        raise ModelError(f"{failed}: the library for it crashed ({_ending(process.returncode)})")
    with _lock:
        _idle.setdefault(function.__module__, []).append(process)
    came, found = answer
    if came:
        return found
    if isinstance(found, MemoryError):
        raise ModelError(f"{failed}: this needs more than the memory of the machine")
    raise ModelError(found) if isinstance(found, tuple) else found


_idle: dict[str, list[subprocess.Popen[bytes]]] = {}  # by the module whose functions they call
_lock = Lock()


def _taken(module: str) -> subprocess.Popen[bytes]:
    """A process that waits, or a new one."""
    with _lock:
        waiting = _idle.get(module, [])
        while waiting:
            if (process := waiting.pop()).poll() is None:
                return process
            _end(process)
    words = python("nivel.files.apart")
    return subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def _ask(process: subprocess.Popen[bytes], job: Any, answers: SimpleQueue[Any]) -> None:
    """Put the answer of a process, or None where it ends before it has one."""
    assert process.stdin is not None
    assert process.stdout is not None
    answer = None
    with suppress(OSError, ValueError, EOFError, pickle.UnpicklingError):
        pickle.dump(job, process.stdin)
        process.stdin.flush()
        answer = pickle.load(process.stdout)
    if answer is None:
        with suppress(subprocess.TimeoutExpired):
            process.wait(1.0)
    answers.put(answer)


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        with suppress(OSError):
            pipe.close()  # type: ignore[union-attr]


@atexit.register
def end_all() -> None:
    """End the processes that wait."""
    with _lock:
        for waiting in _idle.values():
            while waiting:
                _end(waiting.pop())


def _ending(status: int) -> str:
    if status >= 0:
        return f"exit code {status}"
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"signal {-status}"


def main() -> None:
    """Call the functions that come on the standard input, and write what they return on the standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that asked, which ends this one
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what foreign code prints is no answer
    _limit()
    answer: tuple[bool, Any]
    while True:
        if hasattr(signal, "alarm"):
            signal.alarm(IDLE)
        try:
            function, given = pickle.load(sys.stdin.buffer)
        except EOFError:
            os._exit(0)  # without the ends of foreign libraries
        if hasattr(signal, "alarm"):
            signal.alarm(0)
        try:
            answer = True, function(*given)
        except ModelError as error:
            answer = False, error.faults
        except Exception as defect:  # raised where the answer is waited for
            answer = False, defect
        pickle.dump(answer, answers, protocol=pickle.HIGHEST_PROTOCOL)
        answers.flush()


def _limit() -> None:
    """No more memory than the machine has, and no images of crashes."""
    try:
        import resource
    except ImportError:  # Windows
        return
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (memory if most == resource.RLIM_INFINITY else min(memory, most), most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
