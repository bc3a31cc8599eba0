"""These tests run in a process of their own, with NUMBA_DISABLE_JIT=1, as `tests/all.py` starts it; elsewhere they are not collected."""

import os
import sys

import numpy as np
import pytest

if os.environ.get("NUMBA_DISABLE_JIT") == "1":
    import plain

    plain.install()
    sys.setrecursionlimit(3000)
else:
    collect_ignore_glob = ["*"]


@pytest.fixture(autouse=True)
def _divisions_as_compiled():
    """Division by zero gives infinity, without a warning."""
    with np.errstate(all="ignore"):
        yield


@pytest.fixture(autouse=True)
def _without_looking_back(monkeypatch):
    """Runs do not look for narrow features of functions: programs at thousands of places take long here."""
    monkeypatch.setattr("nivel.analysis.run.dynamics.narrow_functions", lambda machine: ())
