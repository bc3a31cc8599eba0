"""Linear models as objects of python-control, where that is installed."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from needing import needs

needs("control.statesp")  # a folder `control` of examples is no library
control = needs("control")
CRANE = Path(__file__).parents[2] / "examples" / "control" / "crane-control.yaml"


@pytest.fixture(scope="module")
def model():
    return nivel.load(CRANE).linearise(about="equilibrium", inputs=["rail"], outputs=["rail", "sheave"])


def test_signals_keep_their_names_with_underscores_for_dots(model):
    system = model.control()
    assert system.input_labels == ["rail_displacement"]
    assert system.output_labels == ["rail_displacement", "sheave_angle"]
    assert system.state_labels == [name.replace(".", "_") for name in model.states]


def test_poles_and_frequency_response_are_those_of_the_model(model):
    system = model.control()
    np.testing.assert_allclose(np.sort_complex(control.poles(system)), np.sort_complex(model.eigenvalues), rtol=1e-10)
    hertz = np.array([0.1, 0.7])
    response = np.moveaxis(system(2j * np.pi * hertz), -1, 0)
    expected = model.frequency_response(hertz).values
    np.testing.assert_allclose(response.reshape(expected.shape), expected, rtol=1e-10)
