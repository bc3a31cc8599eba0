"""Errors of pressures, states and other numbers beside positions: what the headline says of them, and that it is no less than the truth."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np

import nivel
from nivel.judge.after.checks.quantities import group_of, means
from nivel.system.layout import Variable

FAULTS = Path(__file__).parent


def quantities(trust):
    return {each["quantity"]: each for each in trust.found["quantities"]}


def test_states_that_lag_behind_are_red_and_told_first():
    """a = cos 1000 t, b = -sin 1000 t, by rk4 with steps of 1 ms: wrong by more than their amplitude where no body moves."""
    result = nivel.load(FAULTS / "t3-states.yaml").simulate(verify=True, integrator="rk4")
    true = max(
        np.abs(result.array("state.a") - np.cos(1000.0 * result.time)).max(),
        np.abs(result.array("state.b") + np.sin(1000.0 * result.time)).max(),
    )
    stated = quantities(result.trust)["user states"]["largest"]
    assert true / 3.0 < stated < 3.0 * true
    assert result.trust.verdict == "red"
    assert result.trust.headline.startswith("user states off by up to")
    assert "bodies exact" in result.trust.headline


def test_a_red_line_takes_the_headline_its_small_number():
    """A box that passes through a plate within a step: two runs agree, the energy does not."""
    trust = nivel.load(FAULTS / "t7-plate.yaml").simulate(verify=True, integrator="rk4").trust
    assert trust.verdict == "red"
    assert trust.headline.startswith("of unknown error: ")


def test_pressures_of_a_water_hammer_are_in_the_headline():
    """At the closed end of a hose, 14.69 bar off by the reference of a finer step."""
    settings = {"integrator": "extrapolated-euler", "step": "1 ms", "output_interval": "1 ms"}
    result = nivel.load(FAULTS / "hammer-green-big.yaml").simulate(verify=True, **settings)
    stated = quantities(result.trust)["pressures"]["largest"] / 1e5
    assert 14.69 / 3.0 < stated < 3.0 * 14.69
    assert "pressures" in result.trust.headline
    assert result.trust.verdict != "green"


def test_constant_numbers_have_no_range_to_be_wrong_by():
    """A speed that stays as it is, to round-off: its own magnitude is the scale."""
    trust = nivel.load(FAULTS / "t5-gap.yaml").simulate(verify=True, duration=0.1).trust
    assert all(item.verdict == "green" for item in trust.items if item.name == "quantities")


def test_flags_that_jump_have_no_error_in_their_units():
    """`sticks` of a contact is 0 or 1, `count` of many spheres a whole number: an error of 1.39 of them says nothing."""
    for name, group in (("force.lies.sticks", ""), ("force.heap.count", ""), ("force.lies.depth", "forces")):
        assert group_of(Variable(name, ("time",), "1", name, slice(0, 1)), frozenset()) == group


def test_accelerations_of_undamped_beams_are_compared_as_means_from_frame_to_frame():
    """x = t²/2 with a vibration of whole periods between frames: its means are 1, whatever its phase; half of it is vibration."""
    time = np.linspace(0.0, 1.0, 11)

    def result(phase):
        omega = 2.0 * np.pi / 0.05
        arrays = {
            "velocity": time + np.sin(omega * time + phase) / omega,
            "acceleration": 1.0 + np.cos(omega * time + phase),
        }
        return SimpleNamespace(time=time, variables=arrays, array=arrays.__getitem__)

    beams = [SimpleNamespace(damping=0.0)]
    second = SimpleNamespace(result=result(1.0))
    run = SimpleNamespace(machine=SimpleNamespace(beams=beams), result=result(0.0), finer=second)
    found = means(run, SimpleNamespace(factor=1.0), "acceleration")
    assert found.error.max() < 1e-12
    assert found.extent.max() < 1e-12
    np.testing.assert_allclose([found.over, found.above], [0.1, np.sqrt(0.75)])
    beams[0].damping = 1e-3
    assert means(run, SimpleNamespace(factor=1.0), "acceleration") is None
