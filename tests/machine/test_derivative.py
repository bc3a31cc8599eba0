"""Derivatives of expressions against the complex step, central differences and forms known from calculus."""

import cmath
import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from nivel import Expression
from nivel.machine.units.arithmetic import bind, evaluate, fold, render
from nivel.machine.units.derivative import derivative
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import Call, ExpressionError, Name, Negative, Number, Operation, Signal, Time

SMOOTH = ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log"]
COMPLEX = {"__builtins__": {}, **{name: getattr(cmath, name) for name in SMOOTH}}
STEP = 1e-30


def tree_of(text):
    return bind(parse(text), {})


def by_complex_step(tree, time):
    """Im f(t + ih)/h, exact to rounding: nothing is subtracted."""
    return eval(render(tree), COMPLEX, {"time": complex(time, STEP)}).imag / STEP


def _larger(inner):
    return st.one_of(
        st.builds(Operation, st.sampled_from("+-*/"), inner, inner),
        st.builds(Operation, st.just("**"), inner, st.sampled_from([-1.0, 0.5, 1.0, 2.0, 3.0]).map(Number)),
        st.builds(Operation, st.just("**"), st.sampled_from([0.5, math.e]).map(Number), inner),
        st.builds(Operation, st.just("**"), inner, inner),
        st.builds(Negative, inner),
        st.builds(lambda name, u: Call(name, (u,)), st.sampled_from(SMOOTH), inner),
    )


def _has_value(tree):
    """Parts without time, too, must have a value: an expression of a record is folded."""
    try:
        fold(tree)
    except ExpressionError:
        return False
    return True


trees = st.recursive(st.one_of(st.just(Time()), st.floats(0.1, 3).map(Number)), _larger, max_leaves=6).filter(
    _has_value
)


def _check(tree, slope, time):
    """`slope` is the derivative of `tree`, where both are defined and not huge."""
    try:
        value, expected, got = evaluate(tree, time), by_complex_step(tree, time), evaluate(slope, time)
    except (ExpressionError, ArithmeticError, ValueError):
        assume(False)
    assume(abs(value) < 1e4 and abs(expected) < 1e4)
    nearby = [abs(by_complex_step(tree, time + side) - expected) for side in (-1e-7, 1e-7)]
    assume(max(nearby) < 1e-2)  # not beside a pole or the end of a domain, where rounding grows without bound
    assert got == pytest.approx(expected, rel=1e-7, abs=1e-7)


@settings(max_examples=500, deadline=None)
@given(trees, st.floats(0.2, 2))
def test_agrees_with_the_complex_step(tree, time):
    _check(tree, derivative(tree), time)


@settings(max_examples=300, deadline=None)
@given(trees, st.floats(0.2, 2))
def test_second_derivative_agrees_with_the_complex_step(tree, time):
    slope = derivative(tree)
    _check(slope, derivative(slope), time)


@pytest.mark.parametrize("text", ["atan2(time, 2 - time)", "atan2(sin(time), cos(time))", "time*atan2(1, time)^2"])
def test_two_arguments_agree_with_central_differences(text):
    tree, h = tree_of(text), 1e-4
    for order in (1, 2):
        slope = derivative(tree)
        difference = (evaluate(tree, 0.7 + h) - evaluate(tree, 0.7 - h)) / (2 * h)
        assert evaluate(slope, 0.7) == pytest.approx(difference, abs=1e-6), order  # h²/6 times the third derivative
        tree = slope


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", "0.0"),
        ("sqrt(2)*pi", "0.0"),
        ("time", "1.0"),
        ("abs(-3)*time", "abs(-3.0)"),
        ("3*time^2", "3.0*(2.0*time)"),
        ("2 - time", "-1.0"),
        ("-time", "-1.0"),
        ("time/4", "0.25"),
        ("sin(time)", "cos(time)"),
        ("cos(time)", "-sin(time)"),
        ("exp(time)", "exp(time)"),
        ("log(time)", "1.0/time"),
        ("1/time", "-(1.0/time**2.0)"),
        ("time*time", "time + time"),
        ("time^1", "1.0"),
        ("time^0", "0.0"),
        ("2^time", "2.0**time*log(2.0)"),
    ],
)
def test_trivial_factors_are_dropped(text, expected):
    assert render(derivative(tree_of(text))) == expected


def test_defined_where_the_expression_is():
    for power in (1, 2, 3):
        tree = tree_of(f"time^{power}")
        assert evaluate(derivative(tree), 0.0) == (power == 1)
        assert evaluate(derivative(derivative(tree)), 0.0) == 2.0 * (power == 2)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("abs(time)", "`abs` has corners; a driver must be smooth"),
        ("3*min(1, time)", "`min` has corners"),
        ("sin(max(time, 0))", "`max` has corners"),
        ("2*hinge.angle", "`hinge.angle` is only known while the machine moves"),
        ("*".join(["time"] * 90), "too long to be differentiated"),
    ],
)
def test_refuses_with_the_reason(text, part):
    with pytest.raises(ExpressionError, match=part.replace("*", r"\*")):
        derivative(derivative(tree_of(text)))


def test_unbound_names_are_refused():
    with pytest.raises(ExpressionError, match="`k` has no value"):
        derivative(Operation("*", Name("k"), Time()))
    with pytest.raises(ExpressionError, match="`length` is only known"):
        derivative(Signal("length"))


def test_of_an_expression():
    swing = Expression("0.3*sin(2*pi*time)")
    assert swing.derivative(0.0) == pytest.approx(0.6 * math.pi)
    assert swing.derivative.derivative(0.25) == pytest.approx(-0.3 * (2 * math.pi) ** 2)
    assert swing.derivative is swing.derivative


def test_the_derivative_may_be_longer_than_what_is_read():
    long = Expression("+".join(f"sin({k}*time)^2*time^2" for k in range(1, 30)))
    h = 1e-5
    expected = (long(0.3 + h) - long(0.3 - h)) / (2 * h)
    assert long.derivative(0.3) == pytest.approx(expected, rel=1e-6)
    assert math.isfinite(long.derivative.derivative(0.3))


def test_second_derivative_of_a_smooth_ramp_stays_a_number():
    """exp(x) is one up to x = 709, exp(x)² is not from 355 on: the slope of log(1 + exp(x)) there is 1, its rate 0."""
    tree = parse("log(1 + exp(500*time))")
    first = derivative(tree)
    for time in (0.8, 1.2):
        assert evaluate(first, time) == pytest.approx(500.0, rel=1e-12)
        assert abs(evaluate(derivative(first), time)) < 1e-6
