"""Corners of loads in steps that are long beside the vibrations of what is stiff: nothing of these gets into the accelerations beyond."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from simulating import simulate

pytestmark = pytest.mark.covering

BLOW = {"times": [0, 1, 2, 100], "values": [0, 50, 0, 0], "interpolation": "linear"}


def right_angle(**settings):
    """The right-angle cantilever of Simo and Vu-Quoc (1988): its elbow is pushed out of its plane until 1 s and let go until 2 s. Sections
    stretch and shear with periods of milliseconds, and the steps are a hundred times as long."""
    section = {"type": "general", "stiffness": [1e6, 1e6, 1e6, 1e3, 1e3, 1e3], "mass": 1.0, "inertia": [20, 10, 10]}
    beam = {"section": section, "elements": 3, "order": 2}
    return {
        "name": "right-angle",
        "gravity": [0, 0, 0],
        "beams": {
            "leg": {"from": [0, 0, 0], "to": [10, 0, 0], **beam},
            "arm": {"from": [10, 0, 0], "to": [10, 10, 0], **beam},
        },
        "joints": {
            "root": {"type": "fixed", "bodies": ["ground", "leg.start"], "point": [0, 0, 0]},
            "elbow": {"type": "fixed", "bodies": ["leg.end", "arm.start"], "point": [10, 0, 0]},
        },
        "forces": {"blow": {"type": "force", "body": "leg.end", "position": [0, 0, 0], "vector": [0, 0, BLOW]}},
        "simulation": {"duration": 6.0, "output_interval": 6.0, **settings},
    }


@pytest.fixture(scope="module")
def reference():
    return simulate(right_angle(integrator="radau", tolerance=1e-6)).dataset["position"].values[-1]


METHODS = [
    {"integrator": "newmark"},
    {"integrator": "hht"},
    {"integrator": "generalised-alpha"},
    {"integrator": "generalised-alpha", "stabilisation": "none"},
    {"integrator": "generalised-alpha", "coordinates": "relative"},
    {"integrator": "generalised-alpha", "generalised_alpha": {"spectral_radius": 0.2}},
]


@pytest.mark.parametrize("method", METHODS, ids=lambda method: "-".join(str(word) for word in method.values()))
def test_the_order_holds_over_corners(reference, method):
    """They are within steps: at a third of one, and at two thirds."""
    errors = []
    for steps in (170, 340):
        found = simulate(right_angle(step=6.0 / steps, **method)).dataset["position"].values[-1]
        errors.append(np.abs(found - reference).max())
    assert errors[0] < 0.1
    assert_allclose(np.log2(errors[0] / errors[1]), 2.0, atol=0.3)


@pytest.mark.parametrize("step", [0.25, 0.125, 0.1, 0.075])
@pytest.mark.parametrize("integrator", ["hht", "generalised-alpha"])
def test_no_vibration_begins_at_a_corner(integrator, step):
    """The kinetic energy grew a hundredfold where accelerations began anew with the forces of stiff sections."""
    found = simulate(right_angle(step=step, integrator=integrator, output_interval=step))
    kinetic = found.dataset["kinetic_energy"].values
    assert found.dataset.attrs["outcome"] == "done"
    # the blow does 115 J of work
    assert kinetic.max() < 100.0


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9, 1e-11, 1e-13])
@pytest.mark.parametrize("at", [0.5, 0.505])
@pytest.mark.parametrize("integrator", ["hht", "generalised-alpha"])
def test_a_jump_of_a_load_between_two_points_of_its_table(integrator, at, gap):
    """A mass on a spring: m ẍ = F - k x, at rest until the jump."""
    table = {"times": [0, at, at + gap, 1], "values": [0, 0, 5, 5], "interpolation": "linear"}
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"block": {"mass": 1.0, "inertia": [1, 1, 1]}},
        "joints": {
            "rail": {"type": "translational", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [1, 0, 0]}
        },
        "forces": {
            "spring": {"type": "joint-spring-damper", "coordinate": "rail.displacement", "stiffness": 100.0},
            "push": {"type": "force", "body": "block", "position": [0, 0, 0], "vector": [table, 0, 0]},
        },
    }
    errors = []
    for step in (0.02, 0.01):
        settings = {"duration": 1.0, "step": step, "integrator": integrator, "output_interval": 0.02}
        found = simulate({**sections, "simulation": settings})
        t, x = found.dataset["time"].values, found.dataset["position"].values[:, 0, 0]
        errors.append(np.abs(x - 0.05 * (1.0 - np.cos(10.0 * np.maximum(t - at - 0.5 * gap, 0.0)))).max())
    assert errors[0] < 2e-3
    assert errors[1] < 0.3 * errors[0]
