"""Bounds of expressions on straight ways hold for every point of them, and values at many points are those of the expression."""

import numpy as np
import pytest

from nivel.analysis.curves.functions import ExpressionCurve
from nivel.machine.laws.varying_value import Expression, expression_of
from nivel.machine.units.functions import interpolated
from nivel.machine.units.tree import TIME, Lookup, Time
from nivel.system.laws.program import PlacedProgram

TEXTS = (
    *("sin(3*time) + cos(time)^2", "time^3 - 2*time", "1/(2 + time^2)", "abs(time)*exp(-time)", "min(time, 1) - max(time, -1, 0.5)"),
    *("step(time, -1, 2, 1, -3)", "step_rate(time, -1, 2, 1, -3)", "step_acceleration(time, -1, 2, 1, 3)", "ramp(time, -1, 0, 2, 1)"),
    *("if(time > 0.3, 2, time)", "time < 1", "time >= -0.5 and not(time > 1)", "time < -1 or time > 1", "sign(time)", "mod(time, 0.7)"),
    *("floor(2*time)", "tanh(4*time)", "atan2(time, 0.3)", "sqrt(time + 4)", "log(time + 4)", "asin(time/4)", "acos(time/4)"),
    *("sin(3*time)*cos(5*time) - sin(8*time)/2", "mod(2*time, 0.7)^2", "atan2(sin(time), cos(time))", "max(time, -time, 0.5*time)*time"),
    *("sqrt(abs(time))", "time^-2", "2^time", "abs(time)^0.5", "if(time > 0.3, time, time^2)*time", "tan(time)", "atan(time)/(1 + time^2)"),
)  # fmt: skip
X = np.linspace(-3.0013, 2.9987, 601)  # beside the steps of what jumps, which round-off moves


def curve_of(tree):
    """The curve of an expression with this tree."""
    return ExpressionCurve(expression_of(tree))


def assert_bounds_hold(curve, first, last):
    low, high = curve.bounds({TIME: first}, {TIME: last})
    inside = curve.values({TIME: np.linspace(first, last, 101).ravel()}).reshape(101, -1)
    least, largest = (np.where(np.isfinite(inside), inside, sign * np.inf) for sign in (1.0, -1.0))
    room = 1e-12 * (1.0 + np.abs(np.where(np.isfinite(inside), inside, 0.0)).max(axis=0))
    assert np.all(low - room <= least.min(axis=0))
    assert np.all(high + room >= largest.max(axis=0))


@pytest.mark.compiles
@pytest.mark.parametrize("text", TEXTS)
def test_bounds_hold_and_values_are_those_of_the_expression(text):
    curve = ExpressionCurve(Expression(text))
    values = curve.values({TIME: X})
    if "^-" not in text:
        np.testing.assert_allclose(values, [Expression(text)(float(x)) for x in X], rtol=1e-12, atol=1e-14)
    for width in (1, 6, 40):
        assert_bounds_hold(curve, X[:-width], X[width:])
        assert_bounds_hold(curve, X[width:], X[:-width])


@pytest.mark.compiles
def test_bounds_go_with_the_square_of_the_way_where_natural_ones_go_with_it():
    # f = sin² + cos² is constant; of f = x (1 - x) beyond its ends is left f'' h²/8 = h²/4 at most
    first = np.linspace(0.1, 0.3, 9)
    for h in (1e-1, 1e-2, 1e-3):
        low, high = ExpressionCurve(Expression("time*(1 - time)")).bounds({TIME: first}, {TIME: first + h})
        ends = first * (1 - first), (first + h) * (1 - first - h)
        np.testing.assert_allclose(low, np.minimum(*ends), rtol=1e-12)
        np.testing.assert_allclose(high, np.maximum(*ends), rtol=1e-12)  # it rises
        low, high = ExpressionCurve(Expression("sin(time)^2 + cos(time)^2")).bounds({TIME: first}, {TIME: first + h})
        assert np.all(high - low < 2.5 * h**2)


@pytest.mark.compiles
@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("kind", ["linear", "cubic", "monotone", "quintic", "periodic"])
def test_bounds_of_curves_hold(kind, order):
    last = 1.0 if kind == "periodic" else 0.2
    tree = Lookup(Time(), kind, (-2.0, -0.5, 0.0, 2.5), (1.0, -1.0, 0.5, last), order)
    expected = [interpolated(kind, tree.points, tree.values, float(x), order) for x in X]
    np.testing.assert_allclose(PlacedProgram.of(tree).values({TIME: X}), expected, rtol=1e-12, atol=1e-12)
    for width in (1, 10):
        assert_bounds_hold(curve_of(tree), X[:-width], X[width:])
