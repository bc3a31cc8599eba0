"""Functions of expressions: steps, ramps, choices, comparisons, curves, and those that a machine file names itself."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, PchipInterpolator

from nivel import PointForce
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.arithmetic import render
from nivel.machine.units.functions import differentiated, pieces
from nivel.machine.units.tree import ExpressionError

TIMES = np.linspace(-0.5, 4.0, 91)


def of_time(text):
    expression = Expression(text)
    return np.array([expression(float(time)) for time in TIMES])


def test_a_step_is_the_quintic_between_its_levels():
    s = np.clip((TIMES - 1.0) / 2.0, 0.0, 1.0)
    assert of_time("step(time, 1, -2, 3, 5)") == pytest.approx(-2.0 + 7.0 * (10 * s**3 - 15 * s**4 + 6 * s**5))


def test_rate_and_acceleration_of_a_step_are_its_derivatives():
    step = Expression("step(2*time, 1, -2, 3, 5)")
    for time in (0.6, 0.9, 1.3):
        h = 1e-4
        first = (step(time + h) - step(time - h)) / (2 * h)
        second = (step(time + h) - 2 * step(time) + step(time - h)) / h**2
        assert step.derivative(time) == pytest.approx(first, rel=1e-6)
        assert step.derivative.derivative(time) == pytest.approx(second, rel=1e-4)


def test_a_ramp_is_a_straight_line_between_its_levels():
    assert of_time("ramp(time, 1, 4, 3, -2)") == pytest.approx(np.interp(TIMES, [1, 3], [4, -2]))


def test_a_choice_takes_one_value_and_does_not_compute_the_other():
    assert of_time("if(time > 1, sqrt(time - 1), -3)") == pytest.approx(
        np.where(TIMES > 1, np.sqrt(np.maximum(TIMES - 1, 0)), -3)
    )


def test_conditions_are_joined_by_and_or_and_not():
    inside = (TIMES > 1) & (TIMES <= 2) | ~(TIMES < 3)
    assert of_time("time > 1 and time <= 2 or not(time < 3)") == pytest.approx(inside.astype(float))


def test_sign_floor_and_mod_are_those_of_textbooks():
    assert of_time("sign(time - 1)") == pytest.approx(np.sign(TIMES - 1))
    assert of_time("floor(time)") == pytest.approx(np.floor(TIMES))
    assert of_time("mod(time, 0.7)") == pytest.approx(np.mod(TIMES, 0.7))


POINTS, VALUES = [0.0, 1.0, 1.5, 3.0], [0.0, 2.0, 2.0, -1.0]
LISTED = ", ".join(f"{x}, {y}" for x, y in zip(POINTS, VALUES, strict=True))


@pytest.mark.parametrize(
    ("kind", "curve"),
    [
        ("linear", lambda x: np.interp(x, POINTS, VALUES)),
        ("cubic", CubicSpline(POINTS, VALUES, bc_type="natural")),
        ("monotone", PchipInterpolator(POINTS, VALUES)),
    ],
)
def test_a_lookup_is_the_curve_through_its_points(kind, curve):
    assert of_time(f"lookup(time, {kind}, {LISTED})") == pytest.approx(curve(np.clip(TIMES, 0, 3)), abs=1e-13)


def test_a_monotone_curve_never_leaves_the_range_of_its_neighbours():
    values = of_time(f"lookup(time, monotone, {LISTED})")
    assert values.max() <= 2.0
    assert np.all(np.diff(values[(TIMES >= 0) & (TIMES <= 1)]) >= 0)


def test_a_quintic_curve_is_four_times_differentiable_and_at_rest_at_its_ends():
    c, h = pieces("quintic", POINTS, VALUES), np.diff(POINTS)
    at_end = np.array(
        [np.polynomial.polynomial.polyval(h, differentiated(c, order).T, tensor=False) for order in range(5)]
    )
    at_start = np.array([differentiated(c, order)[:, 0] for order in range(5)])
    assert at_end[:, :-1] == pytest.approx(at_start[:, 1:], abs=1e-10)
    assert at_start[0] == pytest.approx(VALUES[:-1])
    assert [*at_start[1:3, 0], *at_end[1:3, -1]] == pytest.approx([0.0] * 4, abs=1e-10)


def test_the_text_of_an_expression_is_read_as_the_same_expression():
    for text in (
        "step(time, 1, 0, 2, 3) + 2*ramp(time, 0, 0, 1, 1)",
        "if(hinge.angle > 1 and not(time < 2), -3, 4)*2",
        f"-lookup(2*time, quintic, {LISTED})",
        "(time > 1) + 2",
        "2*(time > 1 or time < 0)",
    ):
        expression = Expression(text)
        assert Expression(render(expression.tree)).tree == expression.tree


FILE = """\
format: 1
parameters: {top: 12 N}
functions:
  push(x): curve(x) * pulse(1, 2)
  pulse(start, width): "if(time > start and time < start + width, 1, 0)"
  curve: {points: [0, 1, 3], values: [0, 5 N, top], interpolation: monotone}
bodies:
  cart: {mass: 2, inertia: [1, 1, 1]}
forces:
  a: {type: force, body: cart, vector: ["push(3*time)", 0, 0]}
"""


def test_functions_of_a_file_use_parameters_and_each_other():
    (push,) = parse_machine(FILE, "machine.yaml").forces
    assert isinstance(push, PointForce)
    force = push.vector[0]
    assert isinstance(force, Expression)
    curve = PchipInterpolator([0, 1, 3], [0, 5, 12])
    for time in (0.5, 1.0, 1.1, 2.0, 3.5):
        assert force(time) == pytest.approx(float(curve(min(3 * time, 3))) if 1 < time < 3 else 0.0)


FAULTS = {
    "misspelt argument": ("curve(x) *", "curve(y) *", "`y` is neither a parameter nor a unit"),
    "points that do not increase": ("[0, 1, 3]", "[0, 1, 1]", "points increase"),
    "a ring": ("if(time > start", "if(push(1) > start", "depends on itself: push → pulse → push"),
    "too many arguments": ("push(3*time)", "push(3*time, 2)", "`push` takes 1 argument, got 2"),
    "a name alone": ('"push(3*time)"', "push", "`push` is a function; write `push(x)`"),
    "no arguments": ("pulse(start, width):", "pulse:", "the arguments are missing"),
    "a parameter's name": ("  push(x):", "  top(x): x\n  push(x):", "`top` is a parameter"),
    "a list": ("curve(x) * pulse(1, 2)", "[1, 2]", "an expression, or `{points: […], values: […]}` was expected"),
    "no such function": ("push(3*time)", "puch(3*time)", "did you mean `push`?"),
    "equality": ("time > start", "time == start", "write `<` or `>`"),
    "a chain": ("time > start and", "0 < time < start and", "write `a < x and x < b`"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_wrong_with_a_function_is_said_where_it_stands(name):
    old, new, answer = FAULTS[name]
    assert FILE.count(old) == 1
    with pytest.raises(ModelError) as caught:
        parse_machine(FILE.replace(old, new), "machine.yaml")
    assert any(fault.line and answer in fault.message for fault in caught.value.faults), str(caught.value)


@pytest.mark.parametrize("text", ["if(time > 1, 1, 2)", "ramp(time, 0, 0, 1, 1)", "time > 1", "floor(time)"])
def test_what_has_corners_cannot_drive(text):
    with pytest.raises(ExpressionError, match="has corners"):
        Expression(text).derivative  # noqa: B018


def test_values_of_a_choice_are_of_one_kind():
    with pytest.raises(ModelError, match="cannot be values of one `if`"):
        parse_machine(FILE.replace("push(3*time)", "if(time > 1, 2 m, 3 N)"), "machine.yaml")
