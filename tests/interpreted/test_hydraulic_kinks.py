"""Exact derivatives of the smooth laws of circuits at their kinks."""

import numpy as np
import pytest

from nivel.elements.circuits.line_friction import loss
from nivel.elements.circuits.restrictions import reduced_flow
from nivel.elements.circuits.smooth import clipped, maximum_within, ramp, root_flow, step

KINKS = [0.0, 1e-9, -1e-9, 0.5, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 2.0, -3.0]


@pytest.mark.parametrize("x", KINKS)
@pytest.mark.parametrize(
    "law",
    [
        lambda x: ramp(x, 1.0),
        step,
        lambda x: root_flow(x * 1e5, 0.5e5, 0),
        lambda x: maximum_within(x, 1.0, 0.1),
        lambda x: loss(np.array([1.0, 1.0, 1.0, 1.0]), 1.0, 1.0, x),
        lambda x: reduced_flow(np.array([0.0, 0.3]), 1.0, 1.0 - 0.7 * (x + 0.1), 0),
    ],
    ids=["ramp", "step", "root", "maximum", "pipe", "gas"],
)
def test_derivatives_at_kinks_are_those_of_the_functions(x, law):
    """By complex step against differences over 1e-6, and no NaN; slopes may bend within that distance."""
    exact = law(complex(x, 1e-30)).imag / 1e-30
    difference = (law(x + 1e-6) - law(x - 1e-6)) / 2e-6
    assert exact == pytest.approx(difference, rel=1e-4, abs=1e-5 * (1 + abs(difference)))


def test_what_is_beyond_the_stroke_of_a_valve_has_no_effect():
    assert [clipped(x, -1.0) for x in (-2.0, -1.0, 0.3, 1.0, 2.0)] == [-1.0, -1.0, 0.3, 1.0, 1.0]
    assert clipped(complex(1.5, 1e-30), -1.0).imag == 0.0
