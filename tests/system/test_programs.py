"""Programs of expressions give what Python's arithmetic gives, and need no compiler."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from nivel.kernels.record import program as kernel
from nivel.machine.laws.varying_value import Expression, expression_of
from nivel.machine.units.tree import OPERATORS, Call, ExpressionError, Negative, Number, Operation, Signal, Time
from nivel.system.laws.program import expression_program, motion_program, switching_program

SIGNALS = ("time", "a.angle", "b.rate")


def value(expression, *arguments):
    row = np.array([*expression_program(expression, SIGNALS), *arguments, 0.0, 0.0])
    return kernel.run.code(row)


def angle(x, y):
    """atan2, but not of two zeros, where only their signs decide."""
    return Call("atan2", (x, Operation("+", y, Number(0.3))))


def trees():
    leaves = some.one_of(some.floats(-4, 4).map(Number), some.just(Time()), some.sampled_from(SIGNALS[1:]).map(Signal))

    def larger(part):
        one = some.builds(
            lambda name, x: Call(name, (x,)),
            some.sampled_from(["sin", "cos", "atan", "exp", "abs", "sqrt", "log", "asin", "acos", "tan"]),
            part,
        )
        many = some.builds(
            lambda name, parts: Call(name, tuple(parts)),
            some.sampled_from(["min", "max"]),
            some.lists(part, min_size=2, max_size=4),
        )
        two = some.builds(Operation, some.sampled_from(["+", "-", "*", "/", "**"]), part, part)
        return some.one_of(one, many, two, some.builds(Negative, part), some.builds(angle, part, part))

    return some.recursive(leaves, larger, max_leaves=12)


@given(trees(), some.tuples(*[some.floats(-3, 3)] * 3))
def test_any_expression_has_the_value_that_python_gives_it(tree, arguments):
    expression = expression_of(tree)
    try:
        expected = expression(arguments[0], dict(zip(SIGNALS[1:], arguments[1:], strict=True)))
        found = value(expression, *arguments)
    except (ExpressionError, RecursionError):
        return  # outside of a function's domain, where a run goes on with infinity or with no number
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-300)


@pytest.mark.parametrize("symbol", OPERATORS)
def test_each_operation_alone(symbol):
    text = f"a.angle {symbol} b.rate"
    for first, second in ((0.4, 0.7), (0.7, 0.4), (0.4, 0.4)):
        expected = Expression(text)(0.0, {"a.angle": first, "b.rate": second})
        assert value(Expression(text), 0.0, first, second) == pytest.approx(expected, rel=1e-14)


def test_outside_of_a_domain_there_is_no_number():
    assert math.isnan(value(Expression("sqrt(time)"), -1.0, 0.0, 0.0))
    assert math.isnan(value(Expression("max(1, log(time))"), -1.0, 0.0, 0.0))
    assert value(Expression("1/time"), 0.0, 0.0, 0.0) == math.inf


def test_a_motion_leaves_its_derivatives():
    row = np.array([*motion_program(Expression("2*time^3 - sin(5*time)")), 0.3, 0.0, 0.0])
    assert kernel.run.code(row) == pytest.approx(2 * 0.3**3 - math.sin(1.5))
    assert row[-2:] == pytest.approx([6 * 0.3**2 - 5 * math.cos(1.5), 12 * 0.3 + 25 * math.sin(1.5)])


def test_what_stands_twice_is_found_once():
    once, twice = Expression("exp(sin(3*time))"), Expression("exp(sin(3*time)) + exp(sin(3*time))")
    assert len(expression_program(twice, SIGNALS)) == len(expression_program(once, SIGNALS)) + kernel.LENGTH + 1


CORNERS = (
    "if(a.angle > b.rate, a.angle, 2)",
    "abs(a.angle - 1) + sign(b.rate)",
    "min(a.angle, b.rate, 1) - max(a.angle*b.rate, time)",
    "if(a.angle >= 1 and not(b.rate < a.angle) or b.rate, 3, -b.rate)",
    "step(a.angle, 0, 1, 1, b.rate) + ramp(b.rate, -1, 0, 1, 2)",
    "(a.angle <= 1) + (time > 0.5)*not(a.angle)",
)


def switching_value(program, held, *arguments):
    """Value with these sides of the switches, and what stands at the places of sides and differences."""
    row = np.array([*program.row, *arguments, *held, 0.0, 0.0])
    return kernel.run.code(row), [(row[side], row[difference]) for side, difference in program.switches]


@pytest.mark.parametrize("text", CORNERS)
@given(some.tuples(*[some.sampled_from([-2.0, -0.5, 0.0, 0.3, 1.0, 2.0])] * 3))
def test_switches_that_keep_no_side_change_no_value(text, arguments):
    expression = Expression(text)
    program = switching_program(expression, SIGNALS)
    found, switches = switching_value(program, [0.0] * len(program.switches), *arguments)
    assert found == pytest.approx(value(expression, *arguments), rel=1e-15)
    assert all(side == (1.0 if difference > 0.0 else -1.0) for side, difference in switches)


def test_a_side_that_is_kept_goes_on_smoothly_beyond_its_end():
    program = switching_program(Expression("if(a.angle > 2, 3*a.angle, b.rate) + abs(b.rate)"), SIGNALS)
    assert switching_value(program, [1.0, -1.0], 0.0, -5.0, 4.0)[0] == 3 * -5 + 4
    assert switching_value(program, [-1.0, 1.0], 0.0, 5.0, 4.0)[0] == 4 - 4


def test_where_a_side_has_no_value_differences_decide():
    program = switching_program(Expression("if(a.angle > 0, sqrt(a.angle), b.rate)"), SIGNALS)
    found, ((side, _),) = switching_value(program, [1.0], 0.0, -1.0, 7.0)
    assert (found, side) == (7.0, -1.0)


def test_conditions_on_time_alone_are_no_switches():
    assert switching_program(Expression("if(time > 1, a.angle, abs(time - 2))"), SIGNALS).switches == []


def test_every_switch_keeps_a_side_of_its_own():
    """Of min(max(a, -1), 1/2): max takes a where a > -1, and min its limit where the result is above."""
    program = switching_program(Expression("min(max(a.angle, -1), 0.5)"), SIGNALS)
    assert len(program.switches) == 2
    (inner, _), (outer, _) = switching_value(program, [0.0, 0.0], 0.0, 2.0, 0.0)[1]
    assert inner != outer
    for held in ([inner, -outer], [-inner, outer]):
        assert [side for side, _ in switching_value(program, held, 0.0, 2.0, 0.0)[1]] == held
