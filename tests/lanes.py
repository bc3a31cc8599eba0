"""What runs by default, and what rests for `python tests/all.py --full`: see the marker `full` in `pyproject.toml`."""

import os
from collections import Counter
from zlib import crc32

import pytest

FULL = os.environ.get("NIVEL_TESTS_FULL") == "1"


def tail(values, default):
    """Values of a parameter; those not in `default` are for the full tests."""
    return [each if each in default else pytest.param(each, marks=pytest.mark.full) for each in values]


def parts(count):
    """A grid in `count` parts, of which the first is for all tests: the number of the part."""
    return pytest.mark.parametrize("part", tail(range(count), [0]))


def thinned(items):
    """Of the tests marked `covering`, those that the default tests leave out: of every function as many stay as it takes for each value of
    each parameter to be there once. They begin at another place of each grid, so that other pairs meet in each claim."""
    grids = {}
    for item in items:
        if hasattr(item, "callspec") and item.get_closest_marker("covering") and not item.get_closest_marker("full"):
            grids.setdefault(item.nodeid.partition("[")[0], []).append(item)
    left_out = []
    for name, grid in grids.items():
        # one name for each `parametrize`, whose arguments belong together
        left_out += tail_of(grid, [set(enumerate(case.callspec._idlist)) for case in grid], crc32(name.encode()))
    return left_out


def tail_of(cases, values, first):
    """`cases` without the first few that have all `values` between them, each value about as often as others of its parameter; the search
    begins at number `first`, and goes round."""
    missing, rest = set().union(*values), [(first + k) % len(cases) for k in range(len(cases))]
    taken = Counter()
    while missing:
        best = max(rest, key=lambda k: (len(values[k] & missing), -sum(taken[value] for value in values[k])))
        missing -= values[best]
        taken.update(values[best])
        rest.remove(best)
    return [cases[k] for k in sorted(rest)]
