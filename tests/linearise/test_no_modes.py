"""Linear models without modes: they say so, why, and what to do; with what they say to do there are modes."""

import numpy as np
import pytest

import nivel

FILLING = """\
format: 1
name: filling
hydraulics:
  supply: {type: tank, pressure: 60 bar}
  inlet: {type: orifice, ports: {A: supply, B: store}, flow: 10 L/min, pressure_drop: 10 bar}
  store: {type: volume, volume: 1 L, start: START bar}
"""
FALLING = """\
format: 1
name: falling
gravity: [0, 0, -9.81]
bodies: {mass: {mass: 1, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, mass], point: [0, 0, 0], axis: [0, 0, 1]}}
forces: {spring: {type: joint-spring-damper, coordinate: rail, stiffness: 100}}
"""


def model_of(tmp_path, text, **settings):
    path = tmp_path / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path).linearise(**settings)


@pytest.mark.parametrize(("text", "names"), [(FILLING.replace("START", "10"), "store.mass"), (FALLING, "rail")])
def test_a_machine_not_in_equilibrium_says_that_no_modes_are_given_and_what_to_do(tmp_path, text, names):
    model = model_of(tmp_path, text)
    assert not model.modes
    assert model.notes[0].startswith(
        "no modes of motion about its start are given, because the machine is not in equilibrium"
    )
    assert "`--about equilibrium`" in model.notes[0]
    assert names in model.notes[1]
    assert model.summary()["no_modes"] == model.notes[0]
    assert model.notes[0] in str(model)
    page = model.report(tmp_path / "page.html").read_text(encoding="utf-8")
    assert model.notes[0][1:] in page
    found = model_of(tmp_path, text, about="equilibrium")
    assert found.modes
    assert not found.no_modes
    assert "no_modes" in found.summary()


def test_a_circuit_that_starts_at_rest_has_modes(tmp_path):
    """The pressures are one at the start."""
    model = model_of(tmp_path, FILLING.replace("START", "60"))
    assert [mode.kind for mode in model.modes] == ["decays"]
    assert np.isfinite(model.eigenvalues).all()
