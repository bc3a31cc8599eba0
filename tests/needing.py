"""Libraries and programs that some tests need: a test without them is skipped with the reason, and fails where CI asks for all."""

import os
from importlib import import_module
from typing import NoReturn

import pytest

# where all is tested, what could not be installed is a failure, not a test less
MUST_RUN = bool(os.environ.get("CI"))


def needs(*modules):
    """Skip the test or its file where a module is not installed, or cannot be loaded: gmsh needs libraries of the system (libGLU and
    others). `.[test]` has what the kernels, files and pages of nivel need, `.[dev]` everything. The last module."""
    module = None
    for name in modules:
        try:
            module = import_module(name)
        except (ImportError, OSError) as error:
            miss(f"{name}, which `pip install --editable '.[dev]'` installs: {error}")
    return module


def miss(reason) -> NoReturn:
    """Skip, or fail in CI."""
    if MUST_RUN:
        pytest.fail(reason, pytrace=False)
    pytest.skip(reason, allow_module_level=True)
