"""What runs by default, and what rests for `python tests/all.py --full`: see the marker `full` in `pyproject.toml`."""

import os

import pytest

FULL = os.environ.get("NIVEL_TESTS_FULL") == "1"


def tail(values, default):
    """Values of a parameter; those not in `default` are for the full tests."""
    return [each if each in default else pytest.param(each, marks=pytest.mark.full) for each in values]


def parts(count):
    """A grid in `count` parts, of which the first is for all tests: the number of the part."""
    return pytest.mark.parametrize("part", tail(range(count), [0]))
