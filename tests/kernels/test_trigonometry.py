"""Cosine and sine against the C library's, whose errors are below one unit in the last place."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import njit

from nivel.kernels.algebra.trigonometry import cosine_and_sine
from nivel.native.with_numba import functions  # noqa: F401  (kernels call kernels)

ULP = 2.0**-53


@njit
def compiled(x):
    return cosine_and_sine(x)


@given(st.floats(min_value=-1e9, max_value=1e9) | st.integers(-(2**21), 2**21).map(lambda n: n * math.pi / 4))
def test_cosine_and_sine_are_those_of_the_library(x):
    np.testing.assert_allclose(compiled(x), (math.cos(x), math.sin(x)), rtol=0, atol=2.5 * ULP)


@given(st.floats(min_value=-1e-3, max_value=1e-3))
def test_small_sines_keep_their_digits(x):
    assert compiled(x)[1] == pytest.approx(math.sin(x), rel=4 * ULP, abs=0)


@pytest.mark.parametrize("quarters", [1, 2, 3, 4, 5, -1, -7, 10, 1001, 99999, 2**20 - 1])
def test_multiples_of_a_quarter_turn_lose_nothing_by_cancellation(quarters):
    x = quarters * math.pi / 2
    small = 1 if quarters % 2 == 0 else 0
    assert compiled(x)[small] == pytest.approx((math.cos(x), math.sin(x))[small], rel=1e-12, abs=0)


def test_derivatives_by_complex_step():
    for x in np.linspace(-20.0, 20.0, 101):
        c, s = compiled(complex(x, 1e-30))
        assert c.imag / 1e-30 == pytest.approx(-math.sin(x), abs=4 * ULP)
        assert s.imag / 1e-30 == pytest.approx(math.cos(x), abs=4 * ULP)


@pytest.mark.parametrize("x", [math.inf, math.nan])
def test_what_is_no_angle_has_no_cosine(x):
    assert all(math.isnan(value) for value in compiled(x))
