"""Functions of time: a constant, a table, or compiled code reached through its address."""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from nivel.kernels.compile import leaf

CONSTANT, TABLE, COMPILED = 0, 1, 2


@intrinsic
def call_address(typingctx, address, t):
    """Call a C function double(double) at `address` (uint64); about 3 ns, and the caller never recompiles."""
    signature = types.float64(types.uint64, types.float64)

    def generate(context, builder, sig, args):
        double = context.get_value_type(types.float64)
        kind = ir.FunctionType(double, [double])
        pointer = builder.inttoptr(args[0], kind.as_pointer())
        return builder.call(pointer, [args[1]])

    return signature, generate


@leaf
def evaluate_function(functions, k, t):
    """Value of function k at time t [s]. Tables are linear between their points and constant outside them."""
    kind = functions.kind[k]
    if kind == CONSTANT:
        return functions.value[k]
    if kind == COMPILED:
        return call_address(functions.address[k], t)  # type: ignore[call-arg]
    low, high = functions.table[k, 0], functions.table[k, 1]
    times, values = functions.times, functions.values
    if t <= times[low]:
        return values[low]
    if t >= times[high - 1]:
        return values[high - 1]
    high -= 1
    while high - low > 1:
        middle = (low + high) // 2
        if times[middle] <= t:
            low = middle
        else:
            high = middle
    share = (t - times[low]) / (times[low + 1] - times[low])
    return values[low] + share * (values[low + 1] - values[low])
