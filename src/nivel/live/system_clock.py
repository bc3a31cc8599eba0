"""Services of the operating system for real time: clocks by address, priority, locked memory."""

from __future__ import annotations

import ctypes
import gc
import os
from typing import Final

LOCK_ALL: Final = 3  # MCL_CURRENT | MCL_FUTURE
PRIORITY: Final = 10  # of SCHED_FIFO, 1 … 99


def clock_addresses() -> tuple[int, int]:
    """Addresses of clock_gettime and clock_nanosleep."""
    library = ctypes.CDLL(None)
    functions = (library.clock_gettime, library.clock_nanosleep)
    first, second = (ctypes.cast(each, ctypes.c_void_p).value or 0 for each in functions)
    return first, second


def become_urgent() -> list[str]:
    """Ask for real-time priority and locked memory, and stop collecting garbage. Returns in words what was given and what was not."""
    gc.collect()
    gc.freeze()
    gc.disable()
    return [_priority(), _locked_memory()]


def _priority() -> str:
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except (AttributeError, OSError) as problem:
        return f"no real-time priority ({getattr(problem, 'strerror', None) or 'unknown here'})"
    return f"real-time priority {PRIORITY} (SCHED_FIFO)"


def _locked_memory() -> str:
    try:
        library = ctypes.CDLL(None, use_errno=True)
        done = library.mlockall(LOCK_ALL) == 0
    except (OSError, AttributeError):
        return "memory not locked (unknown here)"
    return "memory locked" if done else f"memory not locked ({os.strerror(ctypes.get_errno())})"
