"""What is compiled within tests: `nivel warmup` has compiled all entries of the package, so that no test waits for one."""

from contextlib import contextmanager
from functools import wraps

import pytest

from nivel.native import workers

COMPILED = []


def _noted(compile_all):
    @wraps(compile_all)
    def noted(jobs, *more):
        jobs = list(jobs)
        COMPILED.extend(job["entry"] for job in jobs if "entry" in job and job["entry"].startswith("nivel."))
        return compile_all(jobs, *more)

    return noted


workers.compile_all = _noted(workers.compile_all)


@contextmanager
def fail_where_it_compiles(*, allowed):
    """Fail what compiles an entry of the package without being allowed to."""
    before = len(COMPILED)
    yield
    if COMPILED[before:] and not allowed:
        pytest.fail(f"compiled within the test, not by `nivel warmup`: {', '.join(COMPILED[before:])}", pytrace=False)
