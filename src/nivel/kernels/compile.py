"""The three ways a function of nivel is compiled.

leaf     small arithmetic; LLVM decides about inlining.
stage    a part of one evaluation; always inlined, because a call would copy the descriptors of every array of the record.
entry    what Python or another entry calls: an explicit signature, cached on disk, without the interpreter lock.

All are compiled without Numba's runtime for reference counts (`_nrt=False`): taking a row of an array then costs nothing (with it,
two atomic operations; the step of the slider-crank took five times as long), and an allocation is an error of compilation.

An entry is compiled (or loaded from the cache) when its module is imported, so a module is imported by the path that needs it.

LLVM's unrolling of loops with a count known at run time only is off: most of ours run three times or less, and eight copies of their
bodies, never entered, push the rest of an evaluation out of the processor's cache of instructions (a tenth of a step).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import binding
from numba import njit, types

_compile: Any = njit  # its stubs do not know all options

leaf: Callable[..., Any] = _compile(error_model="numpy", fastmath={"contract"}, _nrt=False)
stage: Callable[..., Any] = _compile(error_model="numpy", fastmath={"contract"}, forceinline=True, _nrt=False)


def entry(signature: types.abstract.Type | Any) -> Callable[..., Any]:
    """Decorator: compile now for `signature`, keep the machine code in the cache."""
    compiler = _compile(signature, error_model="numpy", fastmath={"contract"}, nogil=True, cache=True, _nrt=False)

    def compiled(function: Callable[..., Any]) -> Any:
        with _loops_as_written():
            return compiler(function)

    return compiled


@contextmanager
def _loops_as_written() -> Iterator[None]:
    """No unrolling of loops whose count is not known; the option is the process's, so it is put back for everybody else's code."""
    binding.set_option("nivel", "-unroll-runtime=false")
    try:
        yield
    finally:
        binding.set_option("nivel", "-unroll-runtime=true")
