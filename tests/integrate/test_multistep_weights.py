"""The coefficients of the multistep methods, from the polynomials that define them, in exact fractions."""

from fractions import Fraction

import numpy as np
import pytest

from nivel.integrate.multistep.multistep import (
    BACKWARD,
    BASHFORTH,
    EXTRAPOLATED,
    GAMMA,
    MATRIX,
    MOULTON,
    NODES,
    RATE_WEIGHT,
)


def product(p, q):
    """Polynomials as lists of coefficients, lowest first."""
    out = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def lagrange(nodes):
    """The polynomials that are one at one node and zero at the others."""
    out = []
    for at in nodes:
        p = [Fraction(1)]
        for other in nodes:
            if other != at:
                p = product(p, [Fraction(-other, at - other), Fraction(1, at - other)])
        out.append(p)
    return out


def integral(p):
    """∫ p from 0 to 1."""
    return sum(c / (k + 1) for k, c in enumerate(p))


def value(p, s):
    return sum(c * s**k for k, c in enumerate(p))


def slope_at(p, s):
    return sum(k * c * s ** (k - 1) for k, c in enumerate(p) if k)


def same(weights, exact):
    assert np.all(weights[len(exact) :] == 0)
    np.testing.assert_allclose(weights[: len(exact)], [float(each) for each in exact], rtol=1e-15)


@pytest.mark.parametrize("order", range(1, 6))
def test_bashforth_integrates_the_polynomial_through_the_last_rates(order):
    same(BASHFORTH[order], [integral(p) for p in lagrange([-j for j in range(order)])])


@pytest.mark.parametrize("order", range(1, 6))
def test_moulton_integrates_the_polynomial_through_the_new_rate_and_the_last_ones(order):
    same(MOULTON[order], [integral(p) for p in lagrange([1 - j for j in range(order)])])


@pytest.mark.parametrize("order", range(1, 5))
def test_gear_gives_the_polynomial_through_the_states_its_slope(order):
    """Σ y_{n+1-j} l_j'(1) = h f_{n+1}, solved for y_{n+1}."""
    new, *old = [slope_at(p, 1) for p in lagrange([1 - j for j in range(order + 1)])]
    same(BACKWARD[order], [-each / new for each in old])
    assert RATE_WEIGHT[order] == pytest.approx(float(1 / new), rel=1e-15)


@pytest.mark.parametrize("order", range(1, 5))
def test_prediction_of_gear_is_the_polynomial_through_the_last_states(order):
    same(EXTRAPOLATED[order], [value(p, 1) for p in lagrange([-j for j in range(order)])])


def test_diagonal_method_has_order_four_and_forgets_what_is_infinitely_stiff():
    """All eight conditions of order four (Hairer, Nørsett, Wanner 1993, table II.2.1); the last stage is the new state, so R(∞) = 0."""
    A = np.zeros((5, 5))
    A[:, :4] = MATRIX
    A += GAMMA * np.eye(5)
    b, c = A[-1], A.sum(axis=1)
    np.testing.assert_allclose(c, NODES, atol=1e-15)
    sums = [b @ c, b @ c**2, b @ A @ c, b @ c**3, b @ (c * (A @ c)), b @ A @ c**2, b @ A @ A @ c]
    np.testing.assert_allclose(sums, [1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24], rtol=1e-13)
    assert 1 - b @ np.linalg.solve(A, np.ones(5)) == pytest.approx(0, abs=1e-13)
