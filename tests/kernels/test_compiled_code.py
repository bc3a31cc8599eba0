"""Kernels cannot allocate: they are compiled without Numba's runtime, which makes an allocation a compile error."""

from importlib import import_module

import numpy as np
import pytest
from numba.core.errors import NumbaError

from nivel.kernels import cache
from nivel.kernels.compile import leaf
from nivel.kernels.observe import observe
from nivel.march.catalogue import INTEGRATORS
from nivel.march.loop import advance
from nivel.motion.catalogue import PATHS

STEPS = dict.fromkeys((facts.module, facts.function) for facts in INTEGRATORS.values())
ENTRIES = [observe, advance, *(getattr(import_module(module), function) for module, function in STEPS)]
MODULES = dict.fromkeys(facts.module for facts in PATHS.values())
ENTRIES += [getattr(import_module(module), name) for module in MODULES for name in ("evaluate", "keep")]
ENTRIES += [import_module(module).correct for module in dict.fromkeys(facts.correction for facts in PATHS.values())]


@pytest.mark.parametrize("kernel", ENTRIES, ids=lambda kernel: kernel.__module__ + "." + kernel.__name__)
def test_entries_are_compiled_without_the_runtime_that_allocates(kernel):
    assert kernel.targetoptions["_nrt"] is False
    assert kernel.targetoptions["nogil"] is True


def test_a_kernel_that_allocates_does_not_compile():
    @leaf
    def careless(n):
        return np.zeros(n)[0]

    with pytest.raises(NumbaError, match="empty"):
        careless(3)


def test_cache_directory_changes_with_the_sources(tmp_path, monkeypatch):
    before = cache._fingerprint()
    (tmp_path / "kernels").mkdir()
    (tmp_path / "kernels" / "other.py").write_text("x = 1\n")
    monkeypatch.setattr(cache, "PACKAGE", tmp_path)
    assert cache._fingerprint() != before


def test_cache_directory_changes_with_numba_flags(monkeypatch):
    before = cache._fingerprint()
    monkeypatch.setenv("NUMBA_BOUNDSCHECK", "2")
    assert cache._fingerprint() != before
