"""Settings that all tests share."""

import functools
import gc
import os
import sys

import numpy as np
import pytest
from hypothesis import settings

from lanes import thinned

# the first example of a test may compile a kernel, so there is no deadline; the same examples every time keep CI steady
settings.register_profile("nivel", deadline=None, derandomize=True)
settings.load_profile("nivel")


PLAIN = os.environ.get("NUMBA_DISABLE_JIT") == "1"


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """All that is collected stays to the end: the search for garbage would look through it again and again."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Checks of the whole code come first: they take longest. Grids marked `covering` leave their tails to the full tests. What is marked
    `plain` runs so, and compiled in the full tests."""
    items.sort(key=lambda item: item.get_closest_marker("house") is None)
    for item in thinned(items):
        item.add_marker(pytest.mark.full)
    if not PLAIN:
        for item in filter(is_plain, items):
            item.add_marker(pytest.mark.full)
        return
    others = [item for item in items if not is_plain(item) and "interpreted" not in item.path.parts]
    config.hook.pytest_deselected(items=others)
    items[:] = [item for item in items if item not in set(others)]


def is_plain(item):
    return item.get_closest_marker("plain") and not item.get_closest_marker("compiles")


if not PLAIN:  # kernels as plain Python are imported by `tests/interpreted/plain.py`
    from nivel.api import Machine

    # a second run is made by tests of it alone, which say `verify=True`: all others would take twice their time
    Machine.simulate.__wrapped__.__kwdefaults__["verify"] = False
    # and so are equilibria with other elements
    statics = Machine.statics

    @functools.wraps(statics)
    def unverified(machine, **given):
        return statics(machine, **{"verify": False, **given})

    Machine.statics = unverified

    @pytest.fixture
    def verified(monkeypatch):
        """Runs and equilibria are verified unless they say otherwise, as they are outside of the tests."""
        monkeypatch.setitem(Machine.simulate.__wrapped__.__kwdefaults__, "verify", True)
        monkeypatch.setattr(Machine, "statics", statics)


@pytest.fixture(scope="module")
def browser():
    """A browser for pages: the same for all tests of this process."""
    from browsing import chromium

    with chromium() as running:
        yield running


def pytest_sessionfinish():
    if "browsing" in sys.modules:
        sys.modules["browsing"].close()


@pytest.fixture
def rng():
    return np.random.default_rng(20031)


if os.environ.get("NIVEL_TESTS_ARE_COMPILED") == "1":
    from compiling import fail_where_it_compiles

    def may_compile(item):
        return item.get_closest_marker("compiles") or item.get_closest_marker("plain")

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_setup(item):
        with fail_where_it_compiles(allowed=may_compile(item)):
            return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(item):
        with fail_where_it_compiles(allowed=may_compile(item)):
            return (yield)
