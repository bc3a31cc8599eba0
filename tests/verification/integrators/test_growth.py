"""A step that is too long for the fastest vibration lets it grow without bound, and that is what a failed run says."""

import re

import numpy as np
import pytest

from nivel.errors import SolveError
from nivel.results.result import Result
from simulating import G, hinge, simulate, slide, solid
from test_friction import sled

STIFF = 1e8  # N/m: with a kilogram 1e4 rad/s, of which Runge-Kutta steps of a millisecond make 400 times as much


def stiff_pair():
    """Two blocks on rails, one of which rubs, with a stiff spring between them."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(1.5, 0.01, velocity=[0.3, 0, 0]), "end": solid(1.0, 0.01, position=[0.5, 0, 0])},
        "joints": {"rail": slide("ground", "block"), "guide": slide("ground", "end", point=[0.5, 0, 0])},
        "forces": {"rub": rub("rail"), "stay": stay("block", "end", [0, 0, 0], [0.5, 0, 0])},
    }


def stiff_pendulum():
    """A rubbing arm that carries a bob by a stiff spring."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {"arm": solid(position=[0.5, 0, 0]), "bob": solid(position=[1, -0.5, 0])},
        "joints": {"pin": hinge("ground", "arm")},
        "forces": {"rub": rub("pin", radius=0.05), "stay": stay("arm", "bob", [1, 0, 0], [1, -0.5, 0])},
    }


def rub(coordinate, **more):
    return {"type": "friction", "coordinate": coordinate, "coefficient": 0.3, "model": "stiction", **more}


def stay(first, second, start, end):
    return {
        "type": "spring-damper",
        "bodies": [first, second],
        "points": [start, end],
        "stiffness": STIFF,
        "free_length": 0.4999,
    }


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize(
    ("sections", "integrator"), [(stiff_pair, "rk4"), (stiff_pair, "heun"), (stiff_pendulum, "rk4")]
)
def test_the_step_is_blamed_and_no_joint(sections, integrator, coordinates):
    with pytest.raises(SolveError) as caught:
        simulate(sections(), integrator=integrator, coordinates=coordinates, duration=1.0, step=1e-3)
    assert "the motion has grown without bound" in caught.value.message
    assert (
        "A step of 0.001 s is too long for its fastest vibration, and stay is the force that is largest"
        in caught.value.message
    )
    # a step of 0.1 ms is stable: h ω < 2.8
    assert float(re.findall(r"--step ([\d.e-]+)", caught.value.advice)[0]) <= 1e-4
    assert isinstance(caught.value.result, Result)
    assert caught.value.result.trust.verdict == "red"


def test_a_step_that_follows_the_vibration_runs():
    """h ω < 2.8: 0.1 ms is stable."""
    r = simulate(stiff_pair(), integrator="rk4", duration=0.05, step=1e-4)
    assert np.abs(r.array("block.velocity")).max() < 1.0


def test_a_joint_that_jams_is_still_said_to():
    """A block whose centre of mass is h above its guide of the length l brakes: friction F loads the guide by 2 F h/l besides the weight,
    and F = μ (m g + 2 F h/l) has no solution where 2 μ h > l."""
    sections = sled({"model": "coulomb", "transition_speed": 0.01, "bearing_length": 0.1}, 0.5)
    sections["bodies"]["block"]["position"] = [0, 0.5, 0]
    with pytest.raises(
        SolveError, match="no friction rub is consistent with the reactions that it causes: the joint jams"
    ):
        simulate(sections, integrator="rk4", duration=1.0, step=1e-3)
