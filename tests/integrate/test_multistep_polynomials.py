"""The polynomials of the multistep methods of variable step: what they are made to take from the past, and the textbook's constants."""

from math import factorial

import numpy as np
import pytest

from nivel.integrate.variable_order.multistep_polynomials import ADAMS, BDF, correction, monic

P = np.polynomial.polynomial
# Hairer, Nørsett, Wanner 1993, table III.1.2 and eq. III.2.7: rate at the new time of Adams–Moulton, its error constants
LEADING = [1, 1 / 2, 5 / 12, 3 / 8, 251 / 720, 95 / 288, 19087 / 60480]
MOULTON = [1 / 2, 1 / 12, 1 / 24, 19 / 720, 3 / 160, 863 / 60480]


def polynomial(family, order, xi):
    c = np.zeros(13)
    factors = correction(family, order, xi, np.zeros(16), c)
    return c[: order + 1], factors


def points(order, rng=None):
    steps = np.ones(order + 1) if rng is None else rng.uniform(0.4, 2.5, order + 1)
    steps[0] = 1.0
    return np.concatenate([[0.0], np.cumsum(steps), np.zeros(2)])


@pytest.mark.parametrize("order", range(1, 7))
def test_adams_moulton_of_equal_steps_is_the_known_one(order):
    c, (_, below, same, above) = polynomial(ADAMS, order, points(order))
    assert 1 / c[1] == pytest.approx(LEADING[order - 1], rel=1e-13)
    assert same / factorial(order + 1) == pytest.approx(MOULTON[order - 1], rel=1e-12)
    if order > 1:
        assert below / factorial(order) == pytest.approx(MOULTON[order - 2], rel=1e-12)
    if order < 6:
        assert above / factorial(order + 2) == pytest.approx(MOULTON[order], rel=1e-12)


@pytest.mark.parametrize("order", range(1, 6))
def test_bdf_of_equal_steps_is_the_known_one(order):
    """Leading coefficient Σ 1/j; error constant 1/(q + 1) over it."""
    c, (K, _, same, _) = polynomial(BDF, order, points(order))
    harmonic = sum(1 / j for j in range(1, order + 1))
    assert c[1] == pytest.approx(harmonic)
    assert same / factorial(order + 1) == pytest.approx(1 / ((order + 1) * harmonic))
    assert pytest.approx(factorial(order + 1)) == K


@pytest.mark.parametrize("order", range(1, 13))
def test_correction_leaves_the_past_alone(order, rng):
    xi = points(order, rng)
    for family in (ADAMS, BDF) if order < 6 else (ADAMS,):
        c, _ = polynomial(family, order, xi)
        assert P.polyval(0.0, c) == 1.0
        if family == BDF:
            np.testing.assert_allclose(P.polyval(-xi[1 : order + 1], c), 0.0, atol=1e-11)
        else:
            assert abs(P.polyval(-1.0, c)) < 1e-11
            size = np.abs(P.polyder(c)) @ np.abs(xi[max(order - 1, 1)]) ** np.arange(order)
            np.testing.assert_allclose(P.polyval(-xi[1:order], P.polyder(c)), 0.0, atol=1e-13 * size)


@pytest.mark.parametrize("order", range(1, 12))
def test_change_of_order_leaves_the_past_alone(order, rng):
    xi = points(order, rng)
    for family in (ADAMS, BDF) if order < 6 else (ADAMS,):
        p = np.zeros(16)
        monic(family, order, xi, p)
        p = p[: order + 1]
        assert p[order] == pytest.approx(1.0)
        assert p[0] == 0.0
        zeros = -xi[:order] if family == BDF else -xi[: order - 1]
        values = p if family == BDF else P.polyder(p)
        size = np.abs(values) @ np.abs(xi[order]) ** np.arange(len(values))
        np.testing.assert_allclose(P.polyval(zeros, values), 0.0, atol=1e-13 * size)


@pytest.mark.parametrize("order", range(1, 8))
def test_correction_and_error_are_those_of_the_next_power(order, rng):
    """For y = x^(q+1) about t_n, D_q = 1: what Adams–Bashforth and Adams–Moulton make of exact rates differs by K, and the latter misses
    y = 0 by C_q; the polynomial through past values misses it by K, and BDF by C_q."""
    xi = points(order, rng)
    degree = order + 1
    _, (K, _, same, _) = polynomial(ADAMS, order, xi)

    def from_rates(places):
        slopes = P.polyfit(places, degree * places**order, len(places) - 1)
        area = P.polyint(slopes)
        return (-1.0) ** degree - P.polyval(-1.0, area)  # y(-1) + ∫ from -1 to 0

    predicted, corrected = from_rates(-xi[1 : order + 1]), from_rates(-xi[:order])
    assert corrected - predicted == pytest.approx(K, rel=1e-8)
    assert corrected == pytest.approx(same, rel=1e-8)
    if order < 6:
        c, (K, _, same, _) = polynomial(BDF, order, xi)
        places = -xi[1 : order + 2]
        predicted = P.polyval(0.0, P.polyfit(places, places**degree, order))
        assert -predicted == pytest.approx(K, rel=1e-8)
        # the polynomial through the past and y_n has the rate 0 of y at t_n
        places = -xi[1 : order + 1]
        without = P.polyfit(np.append(0.0, places), np.append(0.0, places**degree), order)
        assert abs(without[1] / c[1]) == pytest.approx(same, rel=1e-8)
