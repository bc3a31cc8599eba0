"""How far the kernels are from the limit of the processor: floating-point operations per evaluation, their rate, share of the dgemm peak.

    python benchmarks/flops.py

Operations are counted by running the kernels' own source as plain Python with numbers that count: additions, subtractions,
multiplications, divisions, powers and elementary functions are one each (a fused multiply-add two), comparisons and changes of sign
none. The time is that of the compiled evaluation, the peak that of numpy's product of two 1000×1000 matrices in one thread, all as
process time in this process, the least of many.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy

import math
import sys
import time
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numba.core.ccallback import CFunc
from numba.core.registry import CPUDispatcher

import nivel
from chain import chain
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.prepared_state import prepare
from part import measure

SIZE, ROUNDS = 1000, 15
EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
WAYS = ("absolute", "relative")


class Counted:
    """A number that counts what is done with it."""

    __slots__ = ("value",)
    operations = 0

    def __init__(self, value: float) -> None:
        self.value = value

    def __float__(self) -> float:
        return self.value

    def __neg__(self) -> Counted:
        return Counted(-self.value)

    def __abs__(self) -> Counted:
        return Counted(abs(self.value))

    @property
    def real(self) -> float:
        return self.value


def _count(name: str, function: Any, *, swapped: bool = False) -> None:
    """Give Counted a method of one operation."""

    def method(self: Counted, *others: Any) -> Counted:
        Counted.operations += 1
        values = (self.value, *map(float, others))
        return Counted(function(*(reversed(values) if swapped else values)))

    setattr(Counted, name, method)


def _compare(name: str) -> None:
    setattr(Counted, name, lambda self, other: getattr(float(self), name)(float(other)))


for operator in ("add", "sub", "mul", "truediv", "pow"):
    for prefix in ("", "r"):
        _count(f"__{prefix}{operator}__", getattr(float, f"__{operator}__"), swapped=prefix == "r")
for comparison in ("lt", "le", "gt", "ge", "eq", "ne"):
    _compare(f"__{comparison}__")
for elementary in ("sqrt", "sin", "cos"):
    _count(elementary, getattr(math, elementary))  # what np.sqrt of such a number calls
_count("arctan2", math.atan2)


def counted(record: Any) -> Any:
    """A copy of a record whose real numbers count."""
    if isinstance(record, tuple):
        return type(record)(*map(counted, record))  # a NamedTuple
    if record.dtype != np.float64:
        return record
    numbers = np.empty(record.shape, dtype=object)
    for index, value in np.ndenumerate(record):
        numbers[index] = Counted(float(value))
    return numbers


def interpret(record: Any) -> None:
    """From now on all kernels run as Python, and find `record` at any address."""
    modules = [module for name, module in sys.modules.items() if name.startswith("nivel.")]
    families = {}
    for module in modules:
        for name, value in list(vars(module).items()):
            if isinstance(value, CPUDispatcher):
                setattr(module, name, value.py_func)
            elif isinstance(value, CFunc):
                families[value.address] = value.__wrapped__
            elif name == "record_at":
                setattr(module, name, lambda _address: record)
    hook: Any = sys.modules["nivel.kernels.record.hook"]
    hook.call_family = lambda address, *arguments: families[int(address)](*arguments)


def operations(prepared: Prepared, expected: np.ndarray) -> int:
    """Of one evaluation at the start, which gives the rates `expected`."""
    rates = np.empty(len(prepared.start), dtype=object)
    y = counted(prepared.start)
    interpret(counted(prepared.motion.system.record))
    Counted.operations = 0
    prepared.motion.kernels.evaluate(0, 0.0, y, rates)
    count = Counted.operations
    np.testing.assert_allclose(rates.astype(float), expected, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected)))
    return count


def nanoseconds(prepared: Prepared, coordinates: str) -> tuple[float, np.ndarray]:
    """Time of the compiled evaluation at the start, and the rates that it gives."""
    y = prepared.start.copy()
    rates = np.zeros_like(y)
    repeats = max(100, 20_000 // prepared.motion.system.body_count)
    loop = import_module(f"{coordinates}_parts").evaluation
    return measure(loop, prepared.motion.handle.address, y, rates, repeats=repeats), rates


def peak() -> float:
    """Operations a second of the matrix product."""
    a, b = np.random.default_rng(0).standard_normal((2, SIZE, SIZE))
    best = math.inf
    for _ in range(ROUNDS):
        begin = time.process_time()
        np.dot(a, b)
        best = min(best, time.process_time() - begin)
    return 2 * SIZE**3 / best


def main() -> None:
    records = {
        "slider-crank": nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").record,
        "chain of 256": chain(256),
    }
    cases = [
        (name, way, prepare(methods_of(record, "newton-euler", way)))
        for name, record in records.items()
        for way in WAYS
    ]
    times = [nanoseconds(prepared, way) for _, way, prepared in cases]
    limit = peak()
    print(f"peak {limit / 1e9:.1f} GF/s")
    for (name, way, prepared), (each, rates) in zip(cases, times, strict=True):
        count = operations(prepared, rates)
        rate = count / each
        share = 1e9 * rate / limit
        print(
            f"{name:14} {way:10} {count:8d} flops {each / 1e3:8.2f} µs {rate:6.2f} GF/s {100 * share:5.1f} % of the peak"
        )


if __name__ == "__main__":
    main()
