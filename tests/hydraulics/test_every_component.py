"""What holds of every component of circuits: it has a closed form among the tests, mass is kept, and none stops a run of steps of 1 ms."""

import re
from pathlib import Path

import numpy as np
import pytest

from circuits import history
from hydraulic_zoo import machine_with_circuits, machine_with_gas, machine_with_warm_oil
from nivel.elements.circuits import COMPONENTS

# tests of mistakes and of several components together are no closed forms
OTHERS = {"test_circuit_mistakes.py", "test_every_component.py", "test_circuit_tangents.py"}
ZOOS = pytest.mark.parametrize("zoo", [machine_with_circuits, machine_with_gas, machine_with_warm_oil])


@pytest.mark.parametrize("word", COMPONENTS)
def test_every_component_is_in_a_test_of_closed_forms(word):
    files = [path for path in Path(__file__).parent.glob("test_*.py") if path.name not in OTHERS]
    assert any(f'"{word}"' in path.read_text(encoding="utf-8") for path in files)


@ZOOS
@pytest.mark.parametrize("method", ["dopri5", "extrapolated-euler", "ros2"])
def test_what_tanks_gave_is_in_the_volumes_to_round_off(zoo, method):
    """Of methods that solve no equation to a tolerance."""
    settings = {"tolerance": 1e-6} if method == "dopri5" else {"step": 1e-3}
    result = zoo().simulate(integrator=method, duration=5e-3, output_interval=1e-3, verify=False, **settings)
    masses = [name for name in result.variables if re.fullmatch(r"state\.\w+\.mass(_port)?(_[AB\dMNXCYRH]+)?", name)]
    gained = sum(history(result, name) for name in masses)
    taken = history(result, "state.hydraulics.taken_in")
    assert len(masses) > 3
    assert gained - gained[0] == pytest.approx(taken - taken[0], abs=1e-11 * np.ptp(gained))


@ZOOS
def test_no_component_stops_a_run_of_steps_of_1_ms(zoo):
    result = zoo().simulate(
        integrator="extrapolated-euler", step=1e-3, duration=0.1, output_interval=0.02, verify=False
    )
    assert result.time[-1] == pytest.approx(0.1)
