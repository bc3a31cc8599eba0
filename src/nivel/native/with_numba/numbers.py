"""Numbers as a record has them: dual where all numbers of it are."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.extending import intrinsic

from nivel.native.with_numba.duals import DUAL, value_of
from nivel.native.with_numba.kinds import WHOLE


@intrinsic
def number_of(typingctx: Any, address: Any, x: Any) -> Any:
    """The dual number x where all numbers of the record at this address are dual, else its value."""
    if x != DUAL:
        return None
    if address == WHOLE:
        return DUAL(address, x), lambda context, builder, signature, args: args[1]
    return types.float64(address, x), lambda context, builder, signature, args: value_of(builder, args[1])


@intrinsic
def without_slopes(typingctx: Any, x: Any) -> Any:
    """The value of a dual number; any other number itself."""
    if x == DUAL:
        return types.float64(x), lambda context, builder, signature, args: value_of(builder, args[0])
    return x(x), lambda context, builder, signature, args: args[0]
