"""Expressions and Python laws on dual numbers: slopes are derivatives, of the branch that the values are on."""

import ctypes

import numpy as np
import pytest

from nivel.kernels.record import program
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression
from nivel.native.duals import duals
from nivel.system.laws.laws import dual_address, law_address
from nivel.system.laws.program import expression_program, motion_program

TIMES = (-2.3, -1.0, -0.4, 0.0, 0.3, 1.0, 2.7)


def on_duals(address, row):
    """Value and slopes of the function at an address, for a row of dual numbers."""
    out = duals([0.0])
    ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64)(address)(
        out.ctypes.data, row.ctypes.data, row.size
    )
    return out["value"][0], out["slopes"][0]


def row_of(*arguments, before=(), behind=0):
    """A row of dual numbers: (value, slopes along the first directions) of arguments, with plain numbers before and zeros behind them."""
    out = duals([*before, *(value for value, *_ in arguments), *[0.0] * behind])
    for k, (_, *slopes) in enumerate(arguments):
        out["slopes"][len(before) + k, : len(slopes)] = slopes
    return out


def of_law(address, *arguments):
    """Value and slope along the first direction of a law."""
    value, slopes = on_duals(dual_address(address), row_of(*arguments))
    return value, slopes


def of_expression(program_row, *arguments, behind=0):
    """Value and slope along the first direction of a program, and its arguments as it left them."""
    row = row_of(*arguments, before=program_row, behind=behind)
    value, slopes = on_duals(program.run.dual_address, row)
    return value, slopes[0], row[len(program_row) :]


# on all of TIMES but at poles and corners
SMOOTH = (
    *("time^2", "time^3", "(time - 5)^3", "(time - 5)^-3", "time^1", "time^0", "2^time", "(time + 3)^time", "(time + 3)^1.5"),
    *("sqrt(time + 4)", "exp(-time)*sin(3*time)", "log(time + 4)", "tan(time/2)", "asin(time/3)", "acos(time/3)", "atan(time)"),
    *("atan2(time, 2)", "atan2(2, time)", "atan2(time, -2 - time^2)", "atan2(-1, time)", "1/(time^2 + 1)", "-cos(time)^5"),
    *("tanh(time)", "step(time, -1.3, 2, 2.6, 5)", "lookup(time, quintic, -2.6, 0, 0.3, 2, 2.6, -1)"),
)  # fmt: skip


@pytest.mark.parametrize("text", SMOOTH)
def test_expressions_on_dual_numbers_give_their_derivatives(text):
    """Against the derivative of the expression that drivers use, which is symbolic."""
    expression = Expression(text)
    row = expression_program(expression, ["time"])
    for time in TIMES:
        value, slope, _ = of_expression(row, (time, 1.0))
        assert value == pytest.approx(expression(time), rel=1e-14, abs=1e-15)
        assert slope == pytest.approx(expression.derivative(time), rel=1e-13, abs=1e-14)


CORNERS = {
    "abs(time)": np.sign,
    "abs(time)*time": lambda t: 2 * abs(t),
    "min(time, 0.5, -time)": lambda t: 1.0 if t < 0 else -1.0,
    "max(time^2, 0.5, time)": lambda t: 2 * t if t * t > 0.5 and t * t >= t else 0.0 if t < 0.5 else 1.0,
    "abs(time)^1.5": lambda t: 1.5 * np.sign(t) * abs(t) ** 0.5,
    "if(time < 0, time^2, 3*time)": lambda t: 2 * t if t < 0 else 3.0,
    "ramp(time, 0, 0, 1, 4)": lambda t: 4.0 if 0 <= t < 1 else 0.0,
    "mod(time, 0.7)": lambda t: 1.0,
    "time*(time > 0 and time < 2)": lambda t: 1.0 if 0 < t < 2 else 0.0,
    "max(time, 0)^2": lambda t: 2 * max(t, 0.0),
}


@pytest.mark.parametrize("text", CORNERS)
def test_expressions_with_corners_give_the_derivative_of_the_branch_they_are_on(text):
    row = expression_program(Expression(text), ["time"])
    for time in TIMES:
        if time not in (0.0, 1.0, -1.0):
            value, slope, _ = of_expression(row, (time, 1.0))
            assert value == pytest.approx(Expression(text)(time), abs=1e-15)
            assert slope == pytest.approx(CORNERS[text](time), abs=1e-14)


def test_motions_leave_rate_and_acceleration_with_their_derivatives():
    row = motion_program(Expression("0.3*sin(4*time)"))
    value, slope, given = of_expression(row, (0.7, 1.0), behind=2)
    assert value == pytest.approx(0.3 * np.sin(2.8))
    assert slope == pytest.approx(1.2 * np.cos(2.8))
    np.testing.assert_allclose(given["value"][1:], [1.2 * np.cos(2.8), -4.8 * np.sin(2.8)])
    np.testing.assert_allclose(given["slopes"][1:, 0], [-4.8 * np.sin(2.8), -19.2 * np.cos(2.8)])


TEXT = '''
"""Laws."""
import math
from math import copysign, pi

import numpy as np

KNOTS = (0.0, 0.5, 2.0)
RISES = (3.0, -1.0, 2.0)
GRID = np.array([-3.0, 0.0, 1.0, 3.0])
VALUES = np.array([1.0, 2.0, -1.0, 4.0])


def signed_square(x: float, size: float) -> float:
    """Branches, a sign, powers of negative numbers."""
    if x < 0.0 or not x < 100.0:
        return -size*x**2 + copysign(0.1*x, -1.0)
    elif 0.0 <= x < 0.5:
        return size*x**3
    return size*math.sqrt(x)


def looped(x, size):
    total = 0.0
    k = 0
    while k < 4:
        total += math.sin(k*x)/(k + 1) + (x if x > 0.0 else 2.0*x)
        k += 1
    for rise in RISES:
        total -= abs(rise*x)
    total **= 2
    return size*total


def table(x, size):
    """A table read by hand."""
    place = max(min(abs(x), 1.999), 0.0)
    k = 0
    while k < 1 and place >= KNOTS[k + 1]:
        k += 1
    return size*(RISES[k] + (RISES[k + 1] - RISES[k])*(place - KNOTS[k])/(KNOTS[k + 1] - KNOTS[k]))


def periodic(x, size):
    return size*math.cos(pi*(x % 0.75)) + math.floor(x) + math.hypot(x, 1.0) + math.atan2(x, -2.0) + helper(x) + float(int(x))


def helper(x):
    return pow(2.0 + x*x, 1.5) + np.arctan(x) + math.exp(-x*x)*math.tanh(x)


def steady(x, size):
    return 3.0


def interpolated(x, size):
    """A table read by NumPy, with a default, a comprehension of truth, and an `or`."""
    return size*np.interp(x, GRID, VALUES) + (x or 1.0) + (0.0 if not size else min(x, 2.0, size))


def told_apart(x, size):
    """What dual numbers have no slope for."""
    return size*math.gamma(2.0 + x*x)
'''
PLACES = (-2.3, -1.1, -0.4, 0.3, 0.6, 1.3, 2.7)


def slope_of(function, x, size):
    """Derivative with respect to x along one, and size along two, by extrapolated differences."""

    def central(h):
        return sum(
            w * (function(x + k * h, size + 2 * k * h) - function(x - k * h, size - 2 * k * h)) / h
            for k, w in enumerate((4 / 5, -1 / 5, 4 / 105, -1 / 280), start=1)
        )

    found = [central(1e-2 * 0.5**k) for k in range(8)]
    k = int(np.argmin(np.abs(np.diff(found))))
    return found[k + 1]


COMPILED_LONG = [pytest.param(name, marks=pytest.mark.compiles) for name in ("interpolated", "told_apart")]


@pytest.mark.parametrize("name", ["signed_square", "looped", "table", "periodic", "steady", *COMPILED_LONG])
def test_python_laws_give_the_derivative_of_the_branch_they_are_on(name):
    """Along several directions at once."""
    namespace = {}
    exec(TEXT, namespace)
    address = law_address(PythonLaw(TEXT, name, ("a.angle", "b.angle")), motion=False)
    for x in PLACES:
        value, slopes = of_law(address, (x, 1.0, 0.0, -0.5), (0.7, 2.0, 0.0, -1.0))
        assert value == pytest.approx(namespace[name](x, 0.7), rel=1e-14, abs=1e-15)
        expected = slope_of(namespace[name], x, 0.7)
        assert slopes[[0, 2]] == pytest.approx([expected, -0.5 * expected], rel=3e-11, abs=1e-11)
        assert not slopes[[1, *range(3, 7)]].any()


@pytest.mark.parametrize("name", ["signed_square", "looped", "periodic"])
def test_python_laws_are_exact_where_an_argument_is_next_to_nothing(name):
    """Steps of differences could only be guessed there."""
    address = law_address(PythonLaw(TEXT, name, ("a.angle", "b.angle")), motion=False)
    near, far = (of_law(address, (x, 1.0), (0.7, 0.0))[1][0] for x in (1e-13, 1e-5))
    assert near == pytest.approx(far, abs=1e-3)
    assert near == of_law(address, (1e-13, 2.0), (0.7, 0.0))[1][0] / 2


def test_motions_of_python_have_the_slopes_that_they_return():
    text = "import math\n\ndef swing(t):\n    return math.sin(4*t), 4*math.cos(4*t), -16*math.sin(4*t)\n"
    address = dual_address(law_address(PythonLaw(text, "swing", ("time",)), motion=True))
    row = row_of((0.3, 0.0, 1.0), behind=2)
    value, slopes = on_duals(address, row)
    assert (value, slopes[1]) == pytest.approx((np.sin(1.2), 4 * np.cos(1.2)))
    assert row["slopes"][1, 1] == pytest.approx(-16 * np.sin(1.2))
    assert not np.delete(slopes, 1).any()
