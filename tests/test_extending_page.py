"""docs/extending.md is followed: its files and lines are put in place, and do what the page says."""

import importlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import nivel
from nivel.machine import MachineRecord
from nivel.machine.forces import FORCES as WORDS
from nivel.system.forces import FORCES

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
FILE = re.compile(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", re.DOTALL)
EDIT = re.compile(r"<!-- (src/\S+) (after|in place of|file):? ?(.*?) ?-->\n```\w+\n(.*?)```", re.DOTALL)
FILES = dict(FILE.findall(PAGE))

COORDINATES = ("absolute", "relative", "independent")
INTEGRATORS = {"rk4": 1e-6, "generalised-alpha": 3e-4, "radau": 1e-6, "bdf": 1e-3, "ros2": 3e-4}


@pytest.fixture(scope="module")
def cart(tmp_path_factory):
    """The machine of the page, with the force of the page as long as its tests last."""
    folder = tmp_path_factory.mktemp("extending")
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    sys.path.insert(0, str(folder))
    importlib.import_module("maxwell")
    yield nivel.load(folder / "cart.yaml")
    sys.path.remove(str(folder))
    del sys.modules["maxwell"]
    withdraw("maxwell")


def withdraw(word):
    """Other tests speak of the package's own forces."""
    kind = FORCES.pop(word)
    WORDS.remove(kind.words)
    MachineRecord.model_rebuild(force=True)


def solution(times):
    """Place and speed of the cart and stretch of the damper, by an independent integrator."""
    k, d, m = 50.0, 20.0, 2.0

    def rate(_, y):
        tension = k * (y[0] - 1.0 - y[2])
        return [y[1], -tension / m, tension / d]

    return solve_ivp(rate, (0.0, times[-1]), [1.3, 0.0, 0.0], t_eval=times, rtol=1e-11, atol=1e-13).y


@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_force_with_a_state_moves_as_its_equations_say(cart, integrator, coordinates):
    if integrator == "ros2" and coordinates == "independent":
        pytest.skip("ros2 has no independent coordinates")
    result = cart.simulate(integrator=integrator, coordinates=coordinates)
    place, _, stretch = solution(result.time)
    error = INTEGRATORS[integrator]
    np.testing.assert_allclose(1.3 + np.asarray(result["rail.displacement"]), place, atol=error)
    np.testing.assert_allclose(result["state.maxwell.stretch"], stretch, atol=error)
    np.testing.assert_allclose(result["force.maxwell.magnitude"], 50.0 * (place - 1.0 - stretch), atol=50.0 * error)


def test_its_units_are_checked_and_its_state_is_shown(cart):
    assert "state.maxwell.stretch" in str(cart.simulate(duration=0.01).dataset.data_vars)
    with pytest.raises(nivel.ModelError, match="stiffness"):
        nivel.machine.MachineRecord(name="m", forces=[{"name": "f", "type": "maxwell", "stiffness": "5 kg"}])


def test_a_word_is_taken_once(cart):
    with pytest.raises(ValueError, match="maxwell"):
        importlib.import_module("maxwell").register_force(
            sys.modules["maxwell"].ForceKind(sys.modules["maxwell"].Maxwell, None, ())
        )


MACHINE = """
format: 1
name: pair
bodies:
  a: {mass: 1, inertia: [1, 2, 3], position: [0, 0, 0], angular_velocity: [0.3, 0.2, 0.5], velocity: [1, 2, 2]}
  b: {mass: 1, inertia: [3, 2, 1], position: [1, 0, 0], angular_velocity: [0.1, -0.4, 0.2]}
joints:
  square: {type: perpendicular-axes, bodies: [a, b], point: [0, 0, 0], axes: [[0, 0, 1], [1, 0, 0]]}
simulation: {duration: 1, step: 1 ms, coordinates: absolute}
"""
FOLLOW = """
import numpy as np, nivel
from nivel.machine.core.orientation import matrix_from_euler_parameters as matrix
result = nivel.load("pair.yaml").simulate()
theta = result.array("orientation")
A, B = (np.array([matrix(p) for p in theta[:, k]]) for k in (0, 1))
print("open", np.abs(np.einsum("ti,ti->t", A[:, :, 2], B[:, :, 0])).max())
v = result.array("velocity")
print("speed", np.abs(result.array("speed") - np.sqrt((v * v).sum(axis=2))).max(), result.array("speed")[0, 0])
"""


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the package with the edits of the page."""
    folder = tmp_path_factory.mktemp("package")
    shutil.copytree(ROOT / "src" / "nivel", folder / "nivel", ignore=shutil.ignore_patterns("__pycache__"))
    edits = EDIT.findall(PAGE)
    assert len(edits) == 9
    for path, how, anchor, text in edits:
        file = folder / path.removeprefix("src/")
        if how == "file":
            assert not file.exists()
            file.write_text(text, encoding="utf-8")
            continue
        lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
        places = [k for k, line in enumerate(lines) if line.strip() == anchor.strip()]
        assert places, f"{path} has no line `{anchor}`"
        lines[places[0] : places[0] + 1] = [text] if how == "in place of" else [lines[places[0]], text]
        file.write_text("".join(lines), encoding="utf-8")
    (folder / "pair.yaml").write_text(MACHINE, encoding="utf-8")
    return folder


def run(folder, *command):
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    done = subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.full
def test_the_joint_and_the_result_variable_of_the_page_are_there(package):
    out = dict(line.split(" ", 1) for line in run(package, "-c", FOLLOW).splitlines())
    assert float(out["open"]) < 1e-9
    difference, first = map(float, out["speed"].split())
    assert difference == 0.0
    assert first == pytest.approx(3.0, rel=1e-9)


def test_the_command_of_the_page_is_there(package):
    assert "count" in run(package, "-m", "nivel", "--help")
    assert run(package, "-m", "nivel", "count", "pair.yaml") == "2 bodies\n"
