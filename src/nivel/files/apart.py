"""Foreign code apart: libraries that read and mesh what others have made run in processes of their own with limits.

A damaged file may crash such a library, or keep it busy for ever. That ends its process, and is a sentence here. A process that has
answered waits a minute for the next file.
"""

import os
import subprocess
from collections.abc import Callable
from functools import cache
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any, Final, TypeVar

from nivel.errors import ModelError
from nivel.native.workers import EndedError, Pool, Process, serve, signal_of

T = TypeVar("T")
LONGEST: Final = 600.0  # [s] of a call
ALARM: Final = 14  # signal
IDLE: Final = 60  # [s] that a process waits for the next one


def apart(function: Callable[..., T], *given: Any, failed: str, longest: float = LONGEST) -> T:
    """What a function of a module returns, called in another process, with all memory of the machine at most.

    failed : how messages begin, `crane.step cannot be read`. longest [s] : it may take. Raises ModelError as the function does, and where
    its process crashes or goes beyond a limit.
    """
    process = _pool(function.__module__).take()
    answers: SimpleQueue[tuple[bool, Any]] = SimpleQueue()
    try:
        Thread(target=_ask, args=(process, (function, given), answers), daemon=True).start()
        came, found = answers.get(timeout=longest)
    except BaseException as problem:
        process.end()
        if isinstance(problem, Empty):
            raise ModelError(f"{failed}: this took longer than {longest:g} s") from None
        raise
    if isinstance(found, EndedError):
        if found.status == -ALARM:  # its minute was over as it was asked
            return apart(function, *given, failed=failed, longest=longest)
        ending = f"exit code {found.status}" if found.status >= 0 else signal_of(found.status)
        raise ModelError(f"{failed}: the library for it crashed ({ending})")
    _pool(function.__module__).give_back(process)
    if came:
        return found
    if isinstance(found, MemoryError):
        raise ModelError(f"{failed}: this needs more than the memory of the machine")
    raise found


@cache
def _pool(_module: str) -> Pool:
    """The processes for the functions of a module: foreign libraries may not go together."""
    return Pool(__name__, lambda: {"stderr": subprocess.DEVNULL})


def _ask(process: Process, job: Any, answers: SimpleQueue[tuple[bool, Any]]) -> None:
    """Put the answer of a process, or what it raised."""
    try:
        answers.put((True, process.ask(job)))
    except Exception as problem:
        answers.put((False, problem))


def main() -> None:
    """Call the functions that come on the standard input, and write what they return on the standard output."""
    _limit()
    serve(lambda job: job[0](*job[1]), IDLE)
    os._exit(0)  # without the ends of foreign libraries


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
