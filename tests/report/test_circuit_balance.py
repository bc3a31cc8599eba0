"""The balance of components in the report: together they lose what the circuit loses, and a restriction its flow times its drop."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR, between, circuit
from nivel.results.frames.circuit_balance import component_balances

FOLDER = Path(__file__).parents[2] / "examples" / "hydraulics"


def record_of(machine):
    return machine.record.model_dump(mode="json")


def test_a_restriction_loses_its_flow_times_its_drop():
    machine = circuit(
        between({"type": "orifice", "flow": "40 L/min", "pressure_drop": "7 bar"}, A=28 * BAR, B=0 * BAR + 1)
    )
    (valve,) = component_balances(machine.simulate(duration=1.0, step=0.1, integrator="rk4"), record_of(machine))
    flow = 40e-3 / 60 * 2
    assert valve.flow == pytest.approx(flow, rel=1e-3)
    assert valve.difference == pytest.approx(28 * BAR, rel=1e-5)
    assert valve.lost == pytest.approx(flow * 28 * BAR, rel=1e-3)


@pytest.mark.parametrize(("file", "duration"), [("harvester-crane.yaml", 3.0), ("cylinder-boom.yaml", 1.5)])
def test_components_lose_together_what_the_circuit_loses(file, duration):
    machine = nivel.load(FOLDER / file)
    result = machine.simulate(duration=duration)
    found = component_balances(result, record_of(machine))
    lost = float(np.ravel(result.array("state.hydraulics.lost"))[-1])
    supplied = float(np.ravel(result.array("state.hydraulics.supplied"))[-1])
    assert sum(each.lost for each in found) == pytest.approx(lost, rel=0.02)
    assert sum(each.supplied for each in found) == pytest.approx(supplied, rel=0.03)
    assert {each.type for each in found} >= {"pump", "relief-valve", "cylinder"}
    assert [each.lost for each in found] == sorted((each.lost for each in found), reverse=True)


def test_a_piston_takes_its_area_times_its_speed():
    machine = nivel.load(FOLDER / "cylinder-boom.yaml")
    result = machine.simulate(duration=1.0)
    (lift,) = (each for each in component_balances(result, record_of(machine)) if each.type == "cylinder")
    speed, a, b = (np.ravel(result.array(f"hydraulics.lift.{name}")) for name in ("speed", "pressure_A", "pressure_B"))
    assert lift.flow == pytest.approx(np.max(np.abs(speed)) * np.pi / 4 * 0.1**2)
    assert lift.difference == pytest.approx(np.max(np.abs(a - b)))
