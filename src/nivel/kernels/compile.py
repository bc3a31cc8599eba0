"""The five ways a function of nivel is compiled.

leaf     small arithmetic; LLVM decides about inlining.
stage    a part of one evaluation; always inlined, so that what one part has read of the record serves the next (a quarter of a step).
shared   what several entries have in common: put into each of them before that is compiled. A stage would be compiled once by itself and
         again within the entry, which a body of half an evaluation makes felt; such functions may take the parts that differ as arguments.
entry    what Python or another entry calls: an explicit signature, cached on disk, without the interpreter lock.
family   what is called by its address: forces, and hooks that only some machines have.

All are compiled without Numba's runtime for reference counts (`_nrt=False`): taking a row of an array then costs nothing (with it,
two atomic operations; the step of the slider-crank took five times as long), and an allocation is an error of compilation.

An entry is compiled (or loaded from the cache) when its module is imported, so a module is imported by the path that needs it.

LLVM's unrolling of loops with a count known at run time only is off: most of ours run three times or less, and eight copies of their
bodies, never entered, push the rest of an evaluation out of the processor's cache of instructions (a tenth of a step).
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import binding
from numba import cfunc, njit, types

_compile: Any = njit  # its stubs do not know all options
_compile_address: Any = cfunc
# A product and a sum may be one instruction with one rounding; nothing else is taken as exact, and NaN stays NaN.
OPTIONS = {"error_model": "numpy", "fastmath": {"contract"}, "_nrt": False}


def _distinct(compiler: Callable[..., Any]) -> Callable[..., Any]:
    """`compiler`, with names of functions made within others that tell what they are made of.

    Numba names a function in machine code by its qualified name and by how many this process has compiled before. Of two entries from the
    cache, compiled in different processes, functions made with different parts may have the same name, and one is taken for the other.
    """

    def compiled(function: Callable[..., Any]) -> Any:
        cells = [cell.cell_contents for cell in function.__closure__ or ()]
        if cells:
            parts = [f"{x.__module__}.{x.__qualname__}" if hasattr(x, "__qualname__") else repr(x) for x in cells]
            function.__qualname__ += "_" + hashlib.sha256("\n".join(parts).encode()).hexdigest()[:8]
        return compiler(function)

    return compiled


leaf: Callable[..., Any] = _distinct(_compile(**OPTIONS))
stage: Callable[..., Any] = _distinct(_compile(forceinline=True, **OPTIONS))
shared: Callable[..., Any] = _compile(inline="always", **OPTIONS)


def entry(signature: types.abstract.Type | Any) -> Callable[..., Any]:
    """Decorator: compile now for `signature`, keep the machine code in the cache."""
    return _now(_compile(signature, nogil=True, cache=True, **OPTIONS))


def address(signature: types.abstract.Type | Any) -> Callable[..., Any]:
    """Decorator: as `entry`, but to something with an `address` that other kernels call."""
    return _now(_compile_address(signature, cache=True, **OPTIONS))


def _now(compiler: Callable[..., Any]) -> Callable[..., Any]:
    def compiled(function: Callable[..., Any]) -> Any:
        with loops_as_written():
            return compiler(function)

    return compiled


@contextmanager
def loops_as_written() -> Iterator[None]:
    """No unrolling of loops whose count is not known; the option is the process's, so it is put back for everybody else's code."""
    binding.set_option("nivel", "-unroll-runtime=false")
    try:
        yield
    finally:
        binding.set_option("nivel", "-unroll-runtime=true")
