"""Runs in time that start from static equilibrium stay in it."""

import numpy as np
import pytest

from nivel.errors import ModelError, SolveError
from simulating import machine, simulate, slide, solid
from test_statics_closed_forms import chain, four_bar, hanging_mass, torsion_pendulum

METHODS = [
    {"coordinates": "absolute"},
    {"coordinates": "relative"},
    {"coordinates": "absolute", "formulation": "lagrange"},
    {"integrator": "generalised-alpha", "coordinates": "absolute"},
]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "sections", [hanging_mass(), torsion_pendulum(6.0), four_bar()], ids=["mass", "coil", "four-bar"]
)
def test_machine_stays_where_it_started(sections, method):
    result = simulate(sections, duration=0.2, step=1e-3, start="equilibrium", **method)
    moved = np.abs(result.array("position") - result.array("position")[0]).max()
    assert moved < 1e-9
    statics = machine(sections).statics()
    np.testing.assert_allclose(result.array("position")[0], statics.array("position")[0], atol=1e-9)
    assert np.abs(result.array("acceleration")[0]).max() < 1e-7
    assert result.settings["start"] == "equilibrium"


def test_chain_stays():
    result = simulate(chain(10), duration=0.1, step=1e-3, start="equilibrium")
    assert np.abs(result.array("position") - result.array("position")[0]).max() < 1e-8


def test_velocities_are_refused_all_at_once():
    sections = hanging_mass()
    sections["bodies"]["block"]["velocity"] = [0, 1, 0]
    with pytest.raises(ModelError, match="starts at rest"):
        simulate(sections, start="equilibrium")
    sections = hanging_mass()
    sections["drivers"] = {"d": {"coordinate": "guide.displacement", "value": "0.1*time"}}
    with pytest.raises(ModelError, match="d moves at t = 0"):
        simulate(sections, start="equilibrium")
    sections["drivers"]["d"]["value"] = "0.1*time^2"
    assert simulate(sections, start="equilibrium", duration=0.01).outcome == "done"


def test_what_has_no_equilibrium_does_not_start():
    sections = {"gravity": [0, -9.81, 0], "bodies": {"b": solid()}, "joints": {"g": slide("ground", "b", (0, 1, 0))}}
    with pytest.raises(SolveError, match="starts from equilibrium, and no equilibrium was found"):
        simulate(sections, start="equilibrium")
