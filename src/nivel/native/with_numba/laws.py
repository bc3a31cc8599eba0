"""Laws and expressions: the function `nivel_law` of the text of a module."""

from __future__ import annotations

import linecache
from types import ModuleType
from typing import Any

from numba import cfunc, njit, types
from numba.core.errors import NumbaError

from nivel.native.signature import Signature
from nivel.native.with_numba import functions  # noqa: F401 - tells Numba what kernels are
from nivel.native.with_numba.duals import DUAL
from nivel.native.with_numba.translate import NeedsNumbaError, object_code

# laws may allocate
LAW_OPTIONS: dict[str, Any] = {"error_model": "numpy"}
_REAL, _DUAL = types.CPointer(types.float64), types.CPointer(DUAL)
_kept: list[Any] = []


def object_code_of_law(text: str, file: str, signature: Signature, machine: Any) -> bytes:
    """The object file with `nivel_law`. Raises what is wrong with the text, NeedsNumbaError where it allocates arrays."""
    law = law_of(text, file)
    try:
        return object_code(law, signature, "nivel_law", machine, **LAW_OPTIONS)
    except NeedsNumbaError as problem:  # to count references to its arguments, or to allocate
        try:
            return object_code(law, signature, "nivel_law", machine)
        except NumbaError:
            raise problem from None


def law_of(text: str, file: str) -> Any:
    """The function as Python has it. file : what stands for its file where errors are told."""
    module = ModuleType("nivel_text")
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    exec(compile(text, file, "exec"), module.__dict__)
    return module.__dict__["nivel_law"]


def address_here(text: str, file: str, signature: Signature) -> int:
    """Its address, compiled in this process: for laws that call functions of Numba when they run, those that allocate arrays among them."""
    law = njit(error_model="numpy")(law_of(text, file))
    if signature.result == "dual":

        def call_dual(out, x, n):
            out[0] = law(x)

        code: Any = cfunc(types.void(_DUAL, _DUAL, types.int64), error_model="numpy")(call_dual)
    else:

        def call(x, n):
            return law(x)

        code: Any = cfunc(types.float64(_REAL, types.int64), error_model="numpy")(call)
    _kept.append(code)
    return int(code.address)
