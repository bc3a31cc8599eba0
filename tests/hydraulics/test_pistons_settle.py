"""Equilibria of pistons under given pressures, which move on until something else than the gas holds them."""

import pytest

import nivel

G = 9.81
MACHINE = """
format: 1
name: vented
gravity: [0, 0, -{g}]
fluids: {{air: {{type: ideal-gas, isothermal: {isothermal}}}}}
bodies: {{piston: {{mass: 20, inertia: [1, 1, 1], position: [0, 0, 0.3]}}}}
joints: {{rail: {{type: translational, bodies: [ground, piston], point: [0, 0, 0.3], axis: [0, 0, 1]}}}}
hydraulics:
  room: {{type: tank}}
  throttle: {{type: orifice, ports: {{A: room, B: jack.A}}, sonic_conductance: 2e-8, critical_ratio: 0.3}}
  jack: {{type: cylinder, bodies: [ground, piston], points: [[0, 0, -0.4], [0, 0, 0.3]], piston: 50 mm, stroke: 0.9, acting: single,
    retracted_length: 0.3, dead_volume_A: 20 cm^3, start_A: 1 bar}}
forces:
  rest: {{type: stop, coordinate: rail, lower: -0.05, stiffness: {stiffness}, exponent: 1, restitution: 0.5}}
"""


@pytest.mark.parametrize(("stiffness", "isothermal"), [(1e3, "true"), (1e4, "false"), (1e6, "true")])
def test_a_piston_whose_gas_is_vented_rests_on_its_soft_stop(tmp_path, stiffness, isothermal):
    """The gas has the pressure of the room and carries nothing: x = -0.05 m - m g/k. It took more than 200 iterations of Newton's method,
    to which the piston is held by nothing before it meets the stop."""
    path = tmp_path / "vented.yaml"
    path.write_text(MACHINE.format(g=G, stiffness=stiffness, isothermal=isothermal), encoding="utf-8")
    result = nivel.load(path).statics()
    assert result.outcome == "done"
    assert result.array("rail.displacement")[-1] == pytest.approx(-0.05 - 20.0 * G / stiffness, abs=1e-7)
    assert result.array("hydraulics.jack.pressure_A")[-1] == pytest.approx(101325.0, rel=1e-9)
    assert result.timing["iterations"] < 100
