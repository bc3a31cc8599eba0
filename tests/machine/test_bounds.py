"""Bounds of expressions over intervals hold for every point of them, and values at many points are those of the expression."""

import numpy as np
import pytest

from nivel.machine.units.bounds import bounds_of, values_of
from nivel.machine.units.expression import Expression
from nivel.machine.units.interpolation import interpolated
from nivel.machine.units.tree import TIME, Lookup, Time

TEXTS = (
    *("sin(3*time) + cos(time)^2", "time^3 - 2*time", "1/(2 + time^2)", "abs(time)*exp(-time)", "min(time, 1) - max(time, -1, 0.5)"),
    *("step(time, -1, 2, 1, -3)", "step_rate(time, -1, 2, 1, -3)", "step_acceleration(time, -1, 2, 1, 3)", "ramp(time, -1, 0, 2, 1)"),
    *("if(time > 0.3, 2, time)", "time < 1", "time >= -0.5 and not(time > 1)", "time < -1 or time > 1", "sign(time)", "mod(time, 0.7)"),
    *("floor(2*time)", "tanh(4*time)", "atan2(time, 0.3)", "sqrt(time + 4)", "log(time + 4)", "asin(time/4)", "acos(time/4)"),
)  # fmt: skip
X = np.linspace(-3.0013, 2.9987, 601)  # beside the steps of what jumps, which round-off moves


@pytest.mark.parametrize("text", TEXTS)
def test_bounds_hold_and_values_are_those_of_the_expression(text):
    tree = Expression(text).tree
    values = values_of(tree, {TIME: X})
    np.testing.assert_allclose(values, [Expression(text)(float(x)) for x in X], rtol=1e-12, atol=1e-14)
    for width in (1, 6, 40):
        ends = np.arange(0, len(X) - width, width)
        low, high = bounds_of(tree, {TIME: (X[ends], X[ends + width])})
        for k, end in enumerate(ends):
            inside = values[end : end + width + 1]
            assert low[k] - 1e-12 <= inside.min()
            assert inside.max() <= high[k] + 1e-12


@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("kind", ["linear", "cubic", "monotone", "quintic"])
def test_bounds_of_curves_hold(kind, order):
    curve = Lookup(Time(), kind, (-2.0, -0.5, 0.0, 2.5), (1.0, -1.0, 0.5, 0.2), order)
    values = values_of(curve, {TIME: X})
    expected = [interpolated(kind, curve.points, curve.values, float(x), order) for x in X]
    np.testing.assert_allclose(values, expected, rtol=1e-12, atol=1e-12)
    low, high = bounds_of(curve, {TIME: (X[:-10], X[10:])})
    for k in range(len(low)):
        assert low[k] - 1e-12 <= values[k : k + 11].min()
        assert values[k : k + 11].max() <= high[k] + 1e-12
