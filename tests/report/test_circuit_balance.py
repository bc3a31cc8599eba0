"""The balance of components in the report: together they lose what the circuit loses, and a restriction its flow times its drop."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR, between, circuit
from nivel.looks.circuit.power_flow import LOSS, power_diagram
from nivel.report.element_panels import circuit_power
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


@pytest.mark.parametrize(
    ("file", "duration"),
    [("harvester-crane.yaml", 2.0), ("pick-and-place.yaml", 1.5), ("two-pump-excavator.yaml", 2.0)],
)
def test_the_power_flow_balances_with_the_energies_of_the_circuit(file, duration):
    """What comes in is what goes out; the sum is that of the exact energies of the run."""
    machine = nivel.load(FOLDER / file)
    result = machine.simulate(duration=duration, verify=False)
    balances = component_balances(result, record_of(machine))
    flow = circuit_power(result, record_of(machine), balances)
    assert flow is not None
    assert sum(each.energy for each in flow.sinks) == pytest.approx(flow.whole, rel=1e-9)
    supplied, lost = (float(np.ravel(result.array(f"state.hydraulics.{each}"))[-1]) for each in ("supplied", "lost"))
    back = sum(each.energy for each in flow.sources if each.name.endswith("from bodies") or each.name == "stored")
    tanks = sum(each.energy for each in flow.sinks if each.name == "supplies and tanks")
    assert flow.whole - back - tanks == pytest.approx(supplied, rel=1e-6)
    losses = sum(each.energy for each in flow.sinks if each.kind == LOSS) - tanks
    pistons = [each.name for each in balances if each.type == "cylinder"]
    rubbed = sum(
        np.trapezoid(*(np.ravel(result.array(f"hydraulics.{name}.{each}")) for each in ("friction", "position")))
        for name in pistons
    )
    assert losses == pytest.approx(lost + rubbed, rel=0.01)
    drawn = power_diagram(flow)
    assert drawn.count("<rect") >= 6
    assert ET.fromstring(drawn).tag.endswith("svg")


def test_gas_loses_its_available_energy_in_a_valve():
    """ṁ R T₀ ln(p_a/p_b) at one temperature: p_N Q ln(p_a/p_b)."""
    valve = {"type": "orifice", "sonic_conductance": 1e-8}
    machine = circuit(between(valve, A=6 * BAR, B=1 * BAR), fluids={"air": {"type": "ideal-gas"}})
    result = machine.simulate(duration=1.0, step=0.1, integrator="rk4")
    (found,) = component_balances(result, record_of(machine))
    lost = float(np.ravel(result.array("state.hydraulics.lost"))[-1])
    assert found.lost == pytest.approx(1e5 * 6e-3 * np.log(6.0), rel=1e-6)
    assert found.lost == pytest.approx(lost, rel=1e-6)
