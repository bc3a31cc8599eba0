"""Unit inference: of a random expression from which one unit was taken away, the answer has the value that was meant."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nivel.machine.laws.time_function import read_time_function
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.plain_factors import completed, unit_text
from nivel.machine.units.quantity import LackingUnitError, read_quantity
from nivel.machine.units.tree import ExpressionError, Number
from nivel.machine.units.unit import BASES, KINDS, NONE, dimension, known, power, product

LENGTH, SPEED, TIME = dimension(m=1), dimension(m=1, s=-1), dimension(s=1)
FORCE = KINDS["force"][2]
SIGNALS = {"tip.x": LENGTH, "rail.displacement": LENGTH, "tip.vx": SPEED}
VALUES = {"tip.x": 0.37, "rail.displacement": -0.21, "tip.vx": 1.3, "time": 0.7}
FACTORS = (LENGTH, SPEED, TIME, FORCE, dimension(kg=1), power(LENGTH, -1), power(TIME, -1))


def unit_of(its):
    return "" if its == NONE else unit_text(its)


def literals(its):
    """A number with its unit, marked so that the unit can be taken away."""
    return st.sampled_from(["37.5", "0.137", "1250", "21.7"]).map(lambda text: f"<{text}|{unit_of(its)}>")


def times(first, second):
    return product(known(first), known(second)) or NONE


def expressions(its, depth=3):
    """Texts of dimension `its`, right in every part; every number has its unit."""
    leaves = [literals(its), *(st.just(name) for name, each in SIGNALS.items() if each == its)]
    if depth == 0:
        return st.one_of(leaves)
    inner = st.deferred(lambda: expressions(its, depth - 1))
    pairs = st.sampled_from(FACTORS).flatmap(
        lambda factor: st.tuples(expressions(factor, depth - 1), expressions(times(its, power(factor, -1)), depth - 1))
    )
    shares = st.sampled_from(FACTORS[:5]).flatmap(
        lambda factor: st.tuples(expressions(times(its, factor), depth - 1), expressions(factor, depth - 1))
    )
    forms = [
        *leaves,
        st.tuples(inner, st.sampled_from([" + ", " - "]), inner).map(lambda p: f"({''.join(p)})"),
        pairs.map(lambda p: f"{p[0]}*{p[1]}"),
        shares.map(lambda p: f"{p[0]}/({p[1]})"),
        inner.map(lambda text: f"abs({text})"),
        inner.map(lambda text: f"-({text})"),
        st.tuples(st.sampled_from(["min", "max"]), inner, inner).map(lambda p: f"{p[0]}({p[1]}, {p[2]})"),
        st.tuples(st.deferred(lambda: expressions(LENGTH, depth - 1)), inner, inner).map(
            lambda p: f"if({p[0]} > <0.125|m>, {p[1]}, {p[2]})"
        ),
    ]
    if all(each % 1 == 0 for each in its):
        forms.append(
            st.deferred(lambda: expressions(power(its, 2) or NONE, depth - 1)).map(lambda text: f"sqrt({text})")
        )
    if its == NONE:
        forms.append(st.deferred(lambda: expressions(NONE, depth - 1)).map(lambda text: f"sin({text})"))
    return st.one_of(forms)


def written(text, plain=None):
    """The text with all units but that of the number `plain`."""
    out, pieces = [], text.split("<")
    for at, piece in enumerate(pieces):
        if at == 0:
            out.append(piece)
            continue
        marked, _, rest = piece.partition(">")
        number, _, unit = marked.partition("|")
        out.append((f"({number} {unit})" if unit and at - 1 != plain else number) + rest)
    return "".join(out)


def value(text):
    function = read_time_function(text, "force", {})
    if isinstance(function, Expression):
        return function(VALUES["time"], VALUES)
    return function


@settings(max_examples=300, deadline=None)
@given(expressions(FORCE), st.data())
def test_an_expression_with_one_unit_taken_away_is_read_or_answered_with_its_value(text, data):
    text = f"{text} + <0.5|N>*sin(time)"  # it varies: of constants not every unit is proposed
    whole = written(text)
    try:
        expected = value(whole)
    except LackingUnitError:
        raise
    except ExpressionError:
        return  # the root of a negative number, a division by zero
    spoilt = written(text, data.draw(st.integers(0, text.count("<") - 1)))
    try:
        found = value(spoilt)
    except LackingUnitError as problem:
        line = str(problem).rpartition("; write `")[2].rstrip("`")
        found = value(line)
    assert found == pytest.approx(expected, rel=1e-9)


@settings(max_examples=300, deadline=None)
@given(
    st.lists(
        st.sampled_from([-3.0, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0]), min_size=len(BASES), max_size=len(BASES)
    )
)
def test_the_text_of_a_unit_is_read_as_this_unit(exponents):
    exponents[BASES.index("cycle")] = 0.0
    its = tuple(exponents)
    if its == NONE:
        return
    seen = []

    def accepts(text, parameters):
        seen.append((text, parameters))

    names = {"factor": Number(2.0), "whole": Number(3.0, its)}
    answer = completed("factor*1", names, (), (its,), accepts)
    if answer is not None:  # only an angle is no unit that is asked for
        assert read_quantity(f"({answer.text})/whole", "number", names) == pytest.approx(2.0 / 3.0)
    assert np.isfinite(read_quantity(f"(4 {unit_text(its)})/whole", "number", names))


@pytest.mark.parametrize("kind", KINDS)
def test_the_unit_of_every_kind_is_written_after_a_number(kind):
    its = KINDS[kind][2]
    if its != NONE and kind != "frequency":
        assert read_quantity(f"4 {unit_text(its)}", kind, {}) == 4.0


@pytest.mark.parametrize(("text", "kind"), [("2*(3 m)", "mass"), ("12*(3 N)", "length")])
def test_no_unit_is_proposed_for_constants_where_another_mistake_is_likelier(text, kind):
    with pytest.raises(ExpressionError, match="was expected") as caught:
        read_quantity(text, kind, {})
    assert "lacks" not in str(caught.value)
