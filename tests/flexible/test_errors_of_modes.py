"""Errors of modes in the trust report: on the scale of what points of the body do, whatever the modes do themselves."""

import numpy as np
import pytest

import simulating
from models import bar, reduced
from nivel.flexible.body.body_file import write_body

# The turn at its hinge is given: a bar is turned softly, and its stiff modes hardly move.
TURNED = {"drivers": {"turn": {"coordinate": "hinge.angle", "value": "0.5*(1 - cos(10*time))"}}}
# Its free end is shaken, faster than the steps can follow.
SHAKEN = {"forces": {"push": {"type": "force", "marker": "tip", "vector": [0, 0, "10*sin(400*time)"]}}}


@pytest.fixture(scope="module")
def body(tmp_path_factory):
    at = tmp_path_factory.mktemp("bar") / "bar.nc"
    write_body(reduced(bar(reduction="modes: 8"))[0], at)
    return at


def run(body, loads, step, verify):
    return simulating.machine(
        {
            "bodies": {"bar": {"flexible": {"file": str(body), "damping_ratio": 0.01}}},
            "joints": {
                "hinge": {"type": "revolute", "bodies": ["ground", "bar"], "interface": "root", "axis": [0, 1, 0]}
            },
            "markers": {"tip": {"body": "bar", "interface": "tip"}},
            "sensors": {"tip": {"marker": "tip", "quantity": "acceleration"}},
            "simulation": {"duration": 0.2, "step": step, "integrator": "generalised-alpha", "output_interval": 2e-3},
            **loads,
        }
    ).simulate(verify=verify)


@pytest.mark.parametrize(("loads", "step", "verdict"), [(TURNED, 5e-4, "green"), (SHAKEN, 2e-3, "red")])
def test_errors_of_modes_are_those_of_the_acceleration_of_points(body, loads, step, verdict):
    """The acceleration of the tip beside that of a run with far shorter steps, on average, over its range."""
    result, finer = run(body, loads, step, True), run(body, loads, 5e-5, False)
    found, known = (np.stack([each.array(f"sensor.tip.{axis}") for axis in "xyz"], axis=1) for each in (result, finer))
    share = np.linalg.norm(np.mean(np.abs(found - known), axis=0)) / np.linalg.norm(np.ptp(known, axis=0))
    line = next(item for item in result.trust.items if item.text.startswith("Quantities: modes"))
    assert share / 3.0 < line.fraction < 3.0 * share
    assert line.verdict == verdict
    if verdict == "green":  # though a mode is wrong by a tenth of its own motion
        own = result.array("modal_acceleration") - finer.array("modal_acceleration")
        assert np.max(np.mean(np.abs(own), axis=0) / np.ptp(finer.array("modal_acceleration"), axis=0)) > 0.1
