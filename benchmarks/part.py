"""How the parts of an evaluation are compiled and timed."""

from __future__ import annotations

import time

import numpy as np
from llvmlite import binding
from numba import njit, types

from nivel.native.function import OPTIONS
from nivel.native.with_numba import functions  # noqa: F401 - tells Numba what kernels are
from nivel.native.with_numba.kinds import ROW

REPEATS, ROUNDS = 20_000, 7
# address of the machine, state, its rates, repeats
SIGNATURE = types.void(types.uint64, ROW, ROW, types.int64)


def part(function):
    """Decorator: compiled like the kernels, but not cached."""
    binding.set_option("benchmark", "-unroll-runtime=false")  # as `nivel.native.with_numba.translate` has it
    return njit(SIGNATURE, **OPTIONS)(function)


def measure(function, *arguments, repeats: int = REPEATS) -> float:
    """Nanoseconds of process time of one repeat, the least of several rounds."""
    function(*arguments, 10)
    best = np.inf
    for _ in range(ROUNDS):
        begin = time.process_time()
        function(*arguments, repeats)
        best = min(best, time.process_time() - begin)
    return 1e9 * best / repeats
