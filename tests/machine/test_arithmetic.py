"""The expression parser against Python's own arithmetic, and its refusals."""

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nivel.machine.units.arithmetic import bind, evaluate, fold, render
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import ExpressionError, Number, Signal, names, signals, varies

PYTHON = {
    "__builtins__": {},
    **{name: kind.value for name, kind in FUNCTIONS.items()},
    "pi": math.pi,
    "e": math.e,
}


def value(text, time=0.0):
    return evaluate(bind(parse(text), {}), time)


numbers = st.one_of(
    st.integers(0, 999).map(str),
    st.floats(0, 1e6, allow_nan=False).map(repr),
    st.sampled_from(["1e3", "2.", ".5", "1e-3", "1.5E+2", "pi", "e", "time"]),
)


def _larger(inner):
    return st.one_of(
        st.tuples(inner, st.sampled_from([" + ", "-", "*", " / ", "**"]), inner).map("".join),
        inner.map(lambda text: f"({text})"),
        inner.map(lambda text: f"-{text}"),
        inner.map(lambda text: f"+ {text}"),
        st.tuples(st.sampled_from(["sin", "cos", "sqrt", "exp", "log", "abs", "atan"]), inner).map(
            lambda p: f"{p[0]}({p[1]})"
        ),
        st.tuples(st.sampled_from(["min", "max", "atan2"]), inner, inner).map(lambda p: f"{p[0]}({p[1]}, {p[2]})"),
    )


expressions = st.recursive(numbers, _larger, max_leaves=12)


def _by_python(text, time):
    """The value by Python, or None where there is none."""
    try:
        result = eval(text, PYTHON, {"time": time})
    except (ArithmeticError, ValueError):
        return None
    return float(result) if not isinstance(result, complex) and math.isfinite(result) else None


def _as_floats(text):
    """Python computes integers exactly and without end; the machine file has floats only."""
    return re.sub(r"(?<!\w)(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", lambda number: repr(float(number[0])), text)


@settings(max_examples=400, deadline=None)
@given(expressions, st.floats(-10, 10))
def test_agrees_with_python(text, time):
    expected = _by_python(_as_floats(text), time)
    if expected is None:
        with pytest.raises(ExpressionError):
            value(text, time)
    else:
        assert value(text, time) == expected


@settings(max_examples=200, deadline=None)
@given(expressions, st.floats(-10, 10))
def test_folded_and_rendered_text_means_the_same_here_and_in_python(text, time):
    tree = bind(parse(text), {})
    try:
        expected = evaluate(tree, time)
        rendered = render(fold(tree))
    except ExpressionError:
        return  # also where a part without time has no value, e.g. 0*log(0)
    assert value(rendered, time) == expected
    assert _by_python(rendered, time) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("8/2/2", 2.0),
        ("2 - 3 - 4", -5.0),
        ("--3", 3.0),
        ("2 pi", 2 * math.pi),
        ("3/8 in", 0.375 * 0.0254),
        ("pi/2 rad", math.pi / 2),
        ("90 deg", math.pi / 2),
        ("90°", math.pi / 2),
        ("10cm", 0.1),
        ("(1/2) ft", 0.1524),
        ("5 kg*m^2", 5.0),
        ("7.85 g/cm^3", 7850.0),
        ("10 N m", 10.0),
        ("(2 m)/(4 s)", 0.5),
        ("60 rpm", 2 * math.pi),
        ("1 t", 1000.0),
        ("2 kN/mm", 2e6),
    ],
)
def test_reads_as_people_mean_it(text, expected):
    assert value(text) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "got nothing"),
        ("   ", "got nothing"),
        ("2 +", "ends too early"),
        ("(1", "`)` was expected"),
        ("1)", "`)` was not expected"),
        ("1 2", "`2` was not expected"),
        ("2 m / 4 s", "unclear"),
        ("2 sin(1)", "`*` is missing before `sin`"),
        ("sine(1)", "did you mean `sin`"),
        ("xyzzy(1)", "there are sin, cos"),
        ("sin(1, 2)", "takes 1 argument, got 2"),
        ("min(1)", "at least 2 arguments"),
        ("sin()", "`)` was not expected"),
        ("1/0", "division by zero"),
        ("0^-1", "division by zero"),
        ("1e999", "too large"),
        ("10^400", "too large"),
        ("1e200*1e200", "too large"),
        ("exp(1000)", "too large"),
        ("sqrt(-1)", "outside the domain"),
        ("log(0)", "outside the domain"),
        ("(-8)^(1/3)", "not a real number"),
        ("1 $ 2", "`$` is not understood"),
        ("__import__('os')", "`'` is not understood"),
        ("a.b", "`a.b` is only known while the machine moves"),
        ("a.b.c", "`a.b.c` has more than one dot"),
        ("a .b", "`.` is not understood"),
        ("2 a.b", "`*` is missing before `a.b`"),
        ("a.b(2)", "there is no function `a.b`"),
        ("2 + left-hinge.angle", "rename it to `left_hinge`"),
        ("left*hinge.angle", "`left` is neither a parameter nor a unit"),
        ("if 2", "`2` was not expected"),
        ("lenght", "neither a parameter nor a unit"),
        ("5 kgs", "did you mean `kg`"),
        ("20 degC", "neither a parameter nor a unit"),
        ("(" * 80 + "1" + ")" * 80, "nested too deeply"),
        ("-" * 100 + "1", "nested too deeply"),
        ("2^" * 150 + "1", "nested too deeply"),
        ("+".join(["1"] * 1000), "too long"),
    ],
)
def test_refuses_with_the_reason(text, part):
    with pytest.raises(ExpressionError) as caught:
        value(text)
    assert part in str(caught.value)


def test_the_longest_expression_that_is_read_is_also_computed():
    assert value("+".join(["1"] * 200)) == 200.0


def test_dotted_names_are_signals():
    tree = parse("-20*hinge.angle_rate + spring.length^2*hinge.angle_rate - k*time")
    assert signals(tree) == ("hinge.angle_rate", "spring.length")
    assert names(tree) == {"k"}
    bound = bind(tree, {"k": Number(3.0), "hinge": Number(7.0)})
    assert evaluate(bound, 2.0, {"hinge.angle_rate": 0.5, "spring.length": 2.0}) == -10 + 2 - 6
    assert render(bound) == "-20.0*hinge.angle_rate + spring.length**2.0*hinge.angle_rate - 3.0*time"
    assert parse(render(bound)) == bound


@pytest.mark.parametrize(("text", "expected"), [("2*pi", False), ("k", False), ("sin(time)", True), ("1 - a.x", True)])
def test_varies_with_time_and_signals(text, expected):
    assert varies(parse(text)) is expected


def test_local_symbols_are_signals_only_where_they_are_allowed():
    assert bind(parse("length"), {}, ("length", "rate")) == Signal("length")
    assert bind(parse("length"), {"length": Number(2.0)}) == Number(2.0)
    with pytest.raises(ExpressionError, match="`length` is a parameter and has a meaning of its own here"):
        bind(parse("2*length"), {"length": Number(2.0)}, ("length", "rate"))
    with pytest.raises(ExpressionError, match="did you mean `length`"):
        bind(parse("lenght"), {}, ("length", "rate"))


def test_what_varies_is_not_folded():
    assert render(fold(bind(parse("2*3*tip.x + 4^2"), {}))) == "6.0*tip.x + 16.0"


dotted = st.sampled_from(["hinge.angle", "tip.vx", "a_1.x"])


@settings(max_examples=100, deadline=None)
@given(st.recursive(st.one_of(numbers, dotted), _larger, max_leaves=12))
def test_rendered_signals_are_read_back(text):
    tree = bind(parse(text), {})
    assert bind(parse(render(tree)), {}) == tree
