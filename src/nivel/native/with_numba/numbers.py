"""Numbers as a record has them: dual where all numbers of it are."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.extending import intrinsic

from nivel.native.with_numba.duals import DUAL, value_of
from nivel.native.with_numba.kinds import WHOLE
from nivel.native.with_numba.packs import PACK, TRUTHS, some_truth


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


@intrinsic
def where(typingctx: Any, truth: Any, x: Any, y: Any) -> Any:
    """x where the truth holds, else y; of packs in each lane."""
    kind = PACK if truth == TRUTHS else typingctx.unify_types(x, y)

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        one, other = (context.cast(builder, args[k], sig.args[k], kind) for k in (1, 2))
        return builder.select(args[0], one, other)

    return kind(truth, x, y), generate


@intrinsic
def some(typingctx: Any, truth: Any) -> Any:
    """Whether the truth holds; of packs whether it does in a lane that has not left."""
    if truth == TRUTHS:
        return types.boolean(truth), lambda context, builder, signature, args: some_truth(builder, args[0])
    return types.boolean(truth), lambda context, builder, signature, args: args[0]


@intrinsic
def share_of_lanes(typingctx: Any, truth: Any) -> Any:
    """1; of packs 0 in the lanes where the truth does not hold."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        number = signature.return_type
        one, nothing = (
            context.cast(builder, context.get_constant(types.float64, x), types.float64, number) for x in (1.0, 0.0)
        )
        return builder.select(args[0], one, nothing) if number == PACK else one

    return (PACK if truth == TRUTHS else types.float64)(truth), generate
