"""One row of the table of functions is all that a function of expressions needs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from nivel.analysis.curves.corners import corners_of, jumping_functions
from nivel.analysis.curves.functions import ExpressionCurve
from nivel.kernels.record import program as kernel
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.functions import FUNCTIONS, SAME, Alike, FunctionKind, Units
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import TIME, Call, ExpressionError, Signal
from nivel.system.laws.program import PlacedProgram, expression_program, switching_program

RANDOM = np.random.default_rng(1).uniform(-2.0, 2.0, (100, 5))
TOYS = {
    "hypot3": FunctionKind("x y z", "length of the vector (x, y, z)", SAME, form="sqrt(x*x + y*y + z*z)"),
    "band": FunctionKind("x low high", "x within limits", SAME, form="min(max(x, low), high)"),
    "jump": FunctionKind("x", "x where it is not negative", SAME, form="x*(x >= 0)"),
    "work": FunctionKind(
        "f s", "their product", Units((Alike(1.0, (0,)), Alike(1.0, (1,)))), form="f*s", derivative="f*ds"
    ),
}


def call_of(name):
    """A call of a function of signals that have the names of its arguments."""
    return Call(name, tuple(Signal(each) for each in FUNCTIONS[name].names))


def run(row, arguments):
    with np.errstate(all="ignore"):
        return float(kernel.run.code(np.array([*row, *arguments, 0.0, 0.0])))


def random_arguments(name):
    """Values by the names of the arguments, where the function has a value; those of a step in order."""
    for numbers in RANDOM:
        values = dict(zip(FUNCTIONS[name].names, map(float, numbers), strict=False))
        if "x1" in values:
            values |= {"x0": 0.1 * values["x0"] - 1.0, "x1": 0.1 * values["x1"] + 1.0}
        try:
            yield values, evaluate(call_of(name), values=values)
        except ExpressionError:
            continue


@pytest.mark.parametrize("name", FUNCTIONS)
def test_operation_form_and_choice_give_the_value_of_the_row(name):
    kind, tree = FUNCTIONS[name], call_of(name)
    row = expression_program(SimpleNamespace(tree=tree), kind.names)
    found = [(run(row, values.values()), expected) for values, expected in random_arguments(name)]
    assert len(found) > 20
    np.testing.assert_allclose(*np.transpose(found), rtol=1e-13, atol=1e-13)
    for values, expected in random_arguments(name) if kind.choice else ():
        assert evaluate(kind.written(kind.choice, tree.arguments), values=values) == expected


@pytest.mark.parametrize("name", [name for name, kind in FUNCTIONS.items() if kind.derivative])
def test_the_derivative_agrees_with_differences(name):
    """With arguments a + b time; those without a rate in the row are constant. The error is h^4/30 times the fifth derivative."""
    h, seen = 1e-3, 0
    for values, _ in random_arguments(name):
        moves = [f"d{each}" in FUNCTIONS[name].derivative for each in values]
        texts = [
            f"{a!r} + {0.3 + k}*time" if own else repr(a)
            for k, (a, own) in enumerate(zip(values.values(), moves, strict=True))
        ]
        expression = Expression(f"{name}({', '.join(texts)})")
        try:
            a, b, c, d = (expression(k * h) for k in (-2, -1, 1, 2))
        except ExpressionError:
            continue  # beside the end of a domain
        difference = (8 * (c - b) - (d - a)) / (12 * h)
        if abs(difference) < 20.0 and max(map(abs, values.values())) < 1.9:  # not beside a pole
            assert expression.derivative(0.0) == pytest.approx(difference, rel=2e-4, abs=1e-6)
            seen += 1
    assert seen > 10


@pytest.fixture
def toys(monkeypatch):
    for name, kind in TOYS.items():
        monkeypatch.setitem(FUNCTIONS, name, kind)


@pytest.mark.usefixtures("toys")
def test_a_row_is_enough_for_values_derivatives_and_programs():
    text = "hypot3(time, 2*time, 2*sin(time))"
    expression = Expression(text)
    expected = math.hypot(0.7, 1.4, 2 * math.sin(0.7))
    assert expression(0.7) == pytest.approx(expected, rel=1e-15)
    assert run(expression_program(expression, [TIME]), [0.7]) == pytest.approx(expected, rel=1e-15)
    slope = (5 * 0.7 + 4 * math.sin(0.7) * math.cos(0.7)) / expected
    assert expression.derivative(0.7) == pytest.approx(slope, rel=1e-14)
    assert Expression("work(3, time^2)").derivative(0.5) == pytest.approx(3.0)
    with pytest.raises(ExpressionError, match="the levels of `work` vary"):
        _ = Expression("work(time, 2*time)").derivative
    with pytest.raises(ExpressionError, match="`hypot3` takes 3 arguments, got 2"):
        read_quantity("hypot3(1, 2)", "number", {})


@pytest.mark.compiles
@pytest.mark.usefixtures("toys")
@pytest.mark.parametrize("text", ["hypot3(time, 1, 2*time - 1)", "band(time, -1, time^2)", "jump(time - 0.4)"])
def test_a_row_is_enough_for_bounds(text):
    tree, x = Expression(text).tree, np.linspace(-2.0, 2.0, 401)
    values = PlacedProgram.of(tree).values({TIME: x})
    np.testing.assert_allclose(values, [evaluate(tree, float(each)) for each in x], rtol=1e-14, atol=1e-15)
    low, high = ExpressionCurve(Expression(text)).bounds({TIME: x[:-8]}, {TIME: x[8:]})
    for k in range(len(low)):
        assert low[k] - 1e-12 <= values[k : k + 9].min()
        assert values[k : k + 9].max() <= high[k] + 1e-12
    assert np.all(np.isfinite([low, high]))


@pytest.mark.usefixtures("toys")
def test_a_row_is_enough_for_units():
    assert read_quantity("hypot3(3 m, 4 m, 1200 cm)", "length", {}) == pytest.approx(13.0)
    assert read_quantity("work(2 kg, 3 m/s^2)", "force", {}) == pytest.approx(6.0)
    with pytest.raises(ExpressionError, match="cannot be compared"):
        read_quantity("hypot3(3 m, 4 kg, 0)", "length", {})
    with pytest.raises(ExpressionError, match=r"`3\.7` lacks the unit m; write"):
        read_quantity("sin(hypot3(2 m, 1 m, 0)/3.7)", "number", {})


@pytest.mark.usefixtures("toys")
def test_a_row_is_enough_for_corners_switches_and_jumps():
    assert corners_of(Expression("band(2*time, 0.5, 1.5)"), 1.0) == pytest.approx([0.25, 0.75])
    assert corners_of(Expression("hypot3(time, 1, 2)"), 1.0) == []
    program = switching_program(Expression("band(a.angle, -1, 1)"), [TIME, "a.angle"])
    assert len(program.switches) == 2
    each = SimpleNamespace(section="forces", part="f", sampling=None, function=Expression("jump(a.angle)"))
    assert len(jumping_functions(SimpleNamespace(functions=[each]))) == 1
    each.function = Expression("band(a.angle, -1, 1)")
    assert jumping_functions(SimpleNamespace(functions=[each])) == ()
    with pytest.raises(ExpressionError, match="has corners; a driver must be smooth"):
        _ = Expression("band(time, 0, 1)").derivative
