"""Parameters that decide between pieces of an expression: a few values of one show one formula, and others follow another."""

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError

MACHINE = """
format: 1
parameters: {p: 2, twice: "2*p", other: 3, c: 1}
functions: {"least(x)": "max(x, 30)"}
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start_rates: {displacement: 1}}}
inputs: {push: {range: [-1, 1]}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: "STIFFNESS"}
  push: {type: motor, coordinate: rail, effort: "push.value + EFFORT"}
simulation: {duration: 0.5, integrator: rk4, step: 1 ms}
"""
DECIDING = [
    ("if(p > 20.5 and p < 23.5, 100, 10)", "0"),
    ("if(twice > 41 and twice < 47, 100, 10)", "0"),
    ("10", "-if(p > 4.5 and p < 7.5, 100, 1)*rail.displacement"),
    ("10 + least(p)", "0"),
    ("10 + 90*max(0, 1 - abs(p - 22))", "0"),
    ("10 + 5*floor(p/30)", "0"),
    ("lookup(p, linear, 0, 10, 20, 10, 22, 100, 24, 10)", "0"),
    ("10 + 5*mod(p, 30)", "0"),
]


def machine(tmp_path, stiffness, effort):
    path = tmp_path / "block.yaml"
    path.write_text(MACHINE.replace("STIFFNESS", stiffness).replace("EFFORT", effort), encoding="utf-8")
    return nivel.load(path)


@pytest.mark.parametrize(("stiffness", "effort"), DECIDING)
def test_variants_of_a_parameter_that_decides_are_those_of_machines_of_their_own(tmp_path, stiffness, effort):
    """By the closed form x = sin(√k t)/√k, where the force is that of a spring."""
    values = np.linspace(1, 40, 40)
    own = machine(tmp_path, stiffness, effort)
    found = own.batch({"parameters.p": list(values)}, save="rail.displacement")
    assert found.attrs["patched"] == 0
    assert "decides between pieces" in found.attrs["prepared_because"]
    pieces = {
        0: lambda p: np.where((p > 20.5) & (p < 23.5), 100, 10),
        1: lambda p: np.where((p > 20.5) & (p < 23.5), 100, 10),
        2: lambda p: 10 + np.where((p > 4.5) & (p < 7.5), 100, 1),
        3: lambda p: 10 + np.maximum(p, 30),
        4: lambda p: 10 + 90 * np.maximum(0, 1 - abs(p - 22)),
        5: lambda p: 10 + 5 * np.floor(p / 30),
        6: lambda p: np.interp(p, [0, 20, 22, 24], [10, 10, 100, 10]),
        7: lambda p: 10 + 5 * np.mod(p, 30),
    }
    rate = np.sqrt(pieces[DECIDING.index((stiffness, effort))](values))
    # at the step h of rk4 the phase is off by (ω h)⁵/120 a step
    assert np.asarray(found["rail.displacement"])[:, -1] == pytest.approx(np.sin(0.5 * rate) / rate, rel=1e-8, abs=1e-9)
    with pytest.raises(ModelError, match="decides between pieces"):
        own.export_fmu(tmp_path / "block.fmu", parameters="parameters.p")


@pytest.mark.parametrize(
    ("stiffness", "effort"),
    [("p^2 + max(other, 30)", "0"), ("10*p", "if(time > 0.01*p, 1, 0)"), ("10 + p", "step(time, 0, 0, 0.1*p, 1)")],
)
def test_what_decides_while_the_machine_runs_is_patched(tmp_path, stiffness, effort):
    own = machine(tmp_path, stiffness, effort)
    found = own.batch({"parameters.p": list(np.linspace(1, 40, 40))}, save="rail.displacement")
    assert found.attrs["patched"] == 1, found.attrs["prepared_because"]
