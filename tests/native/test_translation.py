"""Compiled functions give what Python gives, however they take arrays apart; large parts are in an entry once."""

import subprocess
import sys
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
import toy_arrays as toys

from nivel.kernels.core.block import Handle
from nivel.native.with_numba.translate import LARGE, large_parts

X = np.array([3.0, 4.0, 5.0, -1.0, 0.5, 2.0, 7.0, -6.0, 1.5, 8.0, -2.5, 9.0])


@pytest.mark.parametrize(("m", "n"), [(0, 1), (1, 0), (0, 0)])
def test_items_of_boxes(m, n):
    a, b = X.reshape(2, 3, 2).copy(), X.reshape(2, 3, 2).copy()
    record, python = Handle(toys.Boxes(a)), cast("Any", toys.of_boxes).py_func
    assert toys.boxes(record.address, m, n) == pytest.approx(python(b, m, n), rel=1e-13)
    np.testing.assert_allclose(record.record.value, b, rtol=1e-13)


@pytest.mark.parametrize("n", [-14, -12, -3, -1, 0, 2, 5, 12, 15])
@pytest.mark.parametrize("m", [-13, -5, 0, 3, 12])
def test_slices(m, n):
    same_as_in_python(toys.slices, m, n)


@pytest.mark.parametrize("n", [0, 2, 3, 7, 12])
@pytest.mark.parametrize("m", [0, 1, 4])
def test_variables_that_branches_and_loops_assign(m, n):
    same_as_in_python(toys.branches, m, n)


def same_as_in_python(entry, m, n):
    x, y = X.copy(), X.copy()
    assert entry(x, m, n) == pytest.approx(entry.py_func(y, m, n), rel=1e-13)
    np.testing.assert_allclose(x, y, rtol=1e-13)


def part(name, size, *calls, inlined=False) -> Any:
    return SimpleNamespace(name=name, size=size, calls=calls, inlined=inlined)


def test_large_parts_of_several_places_stay_functions():
    body = part("body", LARGE, inlined=True)
    parts = [part("first", 5, "a", "a", "b"), part("a", 5, "body"), part("b", 5, "body"), body]
    assert large_parts(parts, "first") == {"a"}  # b has one place, body is put into both


def test_places_within_what_is_put_in_count_as_often_as_that_is():
    through = part("through", 5, "a", inlined=True)
    a = part("a", LARGE + 1)
    assert large_parts([part("first", 5, "through", "through"), through, a], "first") == {"a"}
    assert large_parts([part("first", 5, "through"), through, a], "first") == set()


def test_small_parts_are_left_to_the_compiler():
    assert large_parts([part("first", 5, "a", "a"), part("a", LARGE)], "first") == set()


@pytest.mark.parametrize(("version", "module"), [("0.68.1", "nivel"), ("0.65.0", "numba"), ("1.0.0", "numba")])
def test_only_a_known_numba_is_changed(version, module):
    code = (
        f"import numba; numba.__version__ = '{version}'; from nivel.native.with_numba import translate; "
        "translate.install(); from numba.np import arrayobj; print(arrayobj.make_array.__globals__['__name__'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.partition(".")[0] == module
