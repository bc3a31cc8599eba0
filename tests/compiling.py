"""How long Numba compiles, and what: `nivel warmup` has compiled all that tests use, so that no test waits for it."""

import time
from collections import Counter
from contextlib import contextmanager

import pytest
from numba.core import event

MOST = 5.0  # seconds of the processor: laws and single functions that a test calls take tenths, entries at least ten


class Compiling(event.Listener):
    """Seconds of the processor spent in the compiler, by the name of the function that was asked for."""

    def __init__(self):
        self.seconds = Counter()
        self._depth, self._began = 0, 0.0

    def on_start(self, event):
        if self._depth == 0:
            self._began = time.thread_time()
        self._depth += 1

    def on_end(self, event):
        self._depth -= 1
        if self._depth == 0:
            self.seconds[_name(event.data)] += time.thread_time() - self._began


def _name(data):
    dispatcher = data.get("dispatcher")
    return dispatcher.py_func.__qualname__ if dispatcher is not None else data.get("qualname", "?")


COMPILING = Compiling()
for kind in ("numba:compile", "numba:run_pass"):
    event.register(kind, COMPILING)


@contextmanager
def fail_where_it_compiles(*, allowed):
    """Fail what compiles for more than `MOST` seconds without being allowed to."""
    before = COMPILING.seconds.copy()
    yield
    spent = COMPILING.seconds - before
    if spent.total() > MOST and not allowed:
        names = ", ".join(f"{name} {seconds:.1f} s" for name, seconds in spent.most_common(5))
        pytest.fail(f"compiled within the test, not by `nivel warmup`: {names}", pytrace=False)
