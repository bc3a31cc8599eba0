"""Functions that are compiled as parts of entries.

leaf     small arithmetic; LLVM decides about inlining.
part     as long as a pass over a tree, and called from several places of an entry: a function there, not put into these places. (A leaf is
         put into all its callers where a stage calls it, as Numba hands the order down.)
stage    a part of one evaluation; always inlined, so that what one part has read of the record serves the next (a quarter of a step).
shared   what several entries have in common: put into each of them before that is compiled. A stage would be compiled once by itself and
         again within the entry, which a body of half an evaluation makes felt; such functions may take the parts that differ as arguments.

Decorating costs nothing: Numba is imported when a function is first compiled, which happens in a worker process as part of an entry,
or here when Python calls the function by itself, as tests do.

All are compiled without Numba's runtime for reference counts (`_nrt=False`): taking a row of an array then costs nothing (with it,
two atomic operations; the step of the slider-crank took five times as long), and an allocation is an error of compilation.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, update_wrapper
from importlib import import_module
from typing import Any

from nivel.native.signature import Signature

# A product and a sum may be one instruction with one rounding; nothing else is taken as exact, and NaN stays NaN.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "_nrt": False}


class Function:
    """A Python function that Numba compiles when it is needed. targetoptions, py_func : as Numba's own compiled functions have them."""

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        self.py_func = function
        self.targetoptions = {**OPTIONS, **options}
        update_wrapper(self, function)

    @cached_property
    def compiled(self) -> Any:
        """Numba's function; made once, so that all callers share its machine code."""
        from nivel.native.with_numba.functions import compiled

        return compiled(self)

    def __call__(self, *arguments: Any) -> Any:
        return self.compiled(*arguments)


def leaf(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator, see the module."""
    return Function(function)


def part(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator, see the module."""
    return Function(function, forceinline=False)


def stage(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator, see the module."""
    return Function(function, forceinline=True)


def shared(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator, see the module."""
    return Function(function, inline="always")


class Intrinsic:
    """What Numba cannot say: code that is written instruction by instruction. make() returns Numba's intrinsic."""

    def __init__(self, make: Callable[[], Any]) -> None:
        self._make = make

    @cached_property
    def compiled(self) -> Any:
        """Numba's intrinsic."""
        return self._make()

    def __call__(self, *arguments: Any) -> Any:
        raise TypeError("only compiled functions can call this")


def written(name: str) -> Intrinsic:
    """The intrinsic `module:name` of `nivel.native.with_numba`, which is imported where one is compiled."""
    module, _, own = name.partition(":")
    return Intrinsic(lambda: getattr(import_module(f"nivel.native.with_numba.{module}"), own))


def caller(signature: Signature) -> Intrinsic:
    """`call(address, ...)` for kernels: a call of the entry of this signature at an address, about a nanosecond. Where the first argument
    is the address of a twin, or a row of dual numbers, it is that of its code on dual numbers."""

    def make() -> Any:
        from nivel.native.with_numba.calls import caller

        return caller(signature)

    return Intrinsic(make)
