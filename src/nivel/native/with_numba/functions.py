"""Functions and intrinsics of `nivel.native.function`, as Numba finds them in the globals of what it compiles."""

from __future__ import annotations

from typing import Any

from numba import njit, types
from numba.core.registry import cpu_target
from numba.core.typing.typeof import typeof_impl

from nivel.native.entry import Entry
from nivel.native.function import OPTIONS, Function, Intrinsic
from nivel.native.with_numba import calls, duals, views  # noqa: F401 - they tell Numba of their types

_njit: Any = njit  # its stubs do not know all options
# more options for all functions, of processes that only translate
MORE: dict[str, Any] = {}


def compiled(function: Function | Entry) -> Any:
    """Numba's function."""
    options = function.targetoptions if isinstance(function, Function) else OPTIONS
    return _njit(**options, **MORE)(function.py_func)


@typeof_impl.register(Function)
@typeof_impl.register(Entry)
def _type_of_function(function: Function | Entry, _: Any) -> types.Type:
    return types.Dispatcher(function.compiled)


@typeof_impl.register(Intrinsic)
def _type_of_intrinsic(intrinsic: Intrinsic, _: Any) -> types.Type:
    made = intrinsic.compiled
    context: Any = cpu_target.typing_context
    context.refresh()  # of intrinsics made since a compilation began it does not know
    found = context.resolve_value_type(made)
    assert found is not None
    return found
