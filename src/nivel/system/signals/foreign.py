"""Foreign code in this process: it may change how floating-point numbers are computed, and may call `exit`. Neither goes unnoticed."""

import atexit
import ctypes
import ctypes.util
import os
import platform
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache, wraps
from typing import Any, Final, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
WORDS: Final = 8  # of 8 bytes: more than `fenv_t` has on any system
FAILED: Final = 3  # exit code of a failed computation


@cache
def _functions() -> tuple[Any, Any] | None:
    """`fegetenv` and `fesetenv` of the mathematical library; None where there are none."""
    for name in (None, ctypes.util.find_library("m"), "ucrtbase"):
        with suppress(OSError, AttributeError, TypeError):
            library = ctypes.CDLL(name)
            return library.fegetenv, library.fesetenv
    return None


class Environment:
    """Memory of how floating-point numbers are rounded, flushed to zero and trapped."""

    def __init__(self) -> None:
        self._memory = (ctypes.c_uint64 * WORDS)()
        self._functions = _functions()

    @property
    def addresses(self) -> list[int]:
        """Of `fegetenv`, of `fesetenv` and of the memory, for kernels; zeros where there are none."""
        if self._functions is None:
            return [0, 0, 0]
        return [ctypes.cast(each, ctypes.c_void_p).value or 0 for each in (*self._functions, self._memory)]

    def __enter__(self) -> None:
        if self._functions is not None:
            self._functions[0](self._memory)

    def __exit__(self, *_: object) -> None:
        if self._functions is not None:
            self._functions[1](self._memory)


def keeps_environment(function: Callable[P, T]) -> Callable[P, T]:
    """The same function, which leaves the environment of floating-point numbers as it was."""

    @wraps(function)
    def kept(*given: P.args, **named: P.kwargs) -> T:
        with Environment():
            return function(*given, **named)

    return kept


_units: dict[str, None] = {}


def guard_exit(unit: str) -> None:
    """Where a unit in this process calls `exit`, the program ends with exit code 3 and a sentence, and not as done."""
    _units[unit] = None
    _guard()


@cache
def _guard() -> Any:
    """Handler of `exit` of C. The exit of Python takes it away before the interpreter ends."""
    if platform.libc_ver()[0] != "glibc" and sys.platform != "darwin":
        return None  # musl cannot take it away
    library, mark = ctypes.CDLL(None), ctypes.c_char()

    @ctypes.CFUNCTYPE(None, ctypes.c_void_p)
    def ended(_: int | None) -> None:
        if not armed:
            return
        armed.clear()
        said = f"the computation failed: {' or '.join(_units)} called `exit`, which ends the program"
        print(f"{said}\nWith `process: own` a unit ends its run alone.", file=sys.stderr, flush=True)
        with suppress(Exception):
            atexit._run_exitfuncs()  # closes result files
        os._exit(FAILED)

    armed = [True]
    library.__cxa_atexit(ended, None, ctypes.byref(mark))

    def disarm() -> None:
        if armed:
            armed.clear()
            library.__cxa_finalize(ctypes.byref(mark))

    atexit.register(disarm)
    return ended, mark
