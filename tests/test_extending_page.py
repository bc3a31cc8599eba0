"""docs/extending.md is followed: its files and lines are put in place, and do what the page says."""

import importlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj

import nivel
from lanes import tail
from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.tanks import Volume, volume_nodes
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.looks.circuit.drawing import circuit_diagram

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
FILE = re.compile(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", re.DOTALL)
EDIT = re.compile(r"<!-- (src/\S+) (after|in place of|file):? ?(.*?) ?-->\n```\w+\n(.*?)```", re.DOTALL)
FILES = dict(FILE.findall(PAGE))

COORDINATES = ("absolute", "relative", "independent")
INTEGRATORS = {"rk4": 1e-6, "generalised-alpha": 3e-4, "radau": 1e-6, "bdf": 1e-3, "ros2": 3e-4}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The files of the page."""
    folder = tmp_path_factory.mktemp("extending")
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    sys.path.insert(0, str(folder))
    yield folder
    sys.path.remove(str(folder))


@pytest.fixture(scope="module")
def cart(folder):
    """The machine of the page, with the force of the page as long as its tests last."""
    importlib.import_module("maxwell")
    yield nivel.load(folder / "cart.yaml")
    del sys.modules["maxwell"]
    # other tests speak of the package's own forces
    FORCES.withdraw("maxwell")


@pytest.fixture(scope="module")
def vessel(folder):
    """The same with the component of the page."""
    importlib.import_module("capillary")
    yield nivel.load(folder / "vessel.yaml")
    del sys.modules["capillary"]
    COMPONENTS.withdraw("capillary")


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
    result = cart.simulate(integrator=integrator, coordinates=coordinates)
    place, _, stretch = solution(result.time)
    error = INTEGRATORS[integrator]
    np.testing.assert_allclose(1.3 + np.asarray(result["rail.displacement"]), place, atol=error)
    np.testing.assert_allclose(result["state.maxwell.stretch"], stretch, atol=error)
    np.testing.assert_allclose(result["force.maxwell.magnitude"], 50.0 * (place - 1.0 - stretch), atol=50.0 * error)


def test_its_units_are_checked_and_its_state_is_shown(cart):
    assert "state.maxwell.stretch" in str(cart.simulate(duration=0.01).dataset.data_vars)
    with pytest.raises(nivel.ModelError, match="stiffness"):
        nivel.MachineRecord(name="m", forces=[{"name": "f", "type": "maxwell", "stiffness": "5 kg"}])


def test_a_word_is_taken_once(cart):
    with pytest.raises(ValueError, match="maxwell"):
        importlib.import_module("maxwell").FORCES.register(
            sys.modules["maxwell"].Kind(sys.modules["maxwell"].Maxwell, None, ())
        )


@pytest.fixture(scope="module")
def seat(folder):
    """The same with the joint of the page."""
    importlib.import_module("parallel_cranks")
    yield nivel.load(folder / "swing_seat.yaml")
    del sys.modules["parallel_cranks"]
    JOINTS.withdraw("parallel-cranks")


def test_the_joint_of_the_page_is_a_pendulum_in_all_coordinates(seat):
    # from rest at the amplitude θ₀: θ = 2 asin(k cd(ω t, k)), k = sin(θ₀/2), ω² = g/r; the angle is 0 where θ₀ = π/2
    k = np.sin(np.pi / 4)
    for coordinates, integrator, error in (
        *((coordinates, "rk4", 1e-9) for coordinates in COORDINATES),
        ("relative", "generalised-alpha", 2e-5),
        ("relative", "radau", 1e-6),
    ):
        result = seat.simulate(integrator=integrator, coordinates=coordinates)
        _, cn, dn, _ = ellipj(np.sqrt(9.81) * result.time, k**2)
        np.testing.assert_allclose(
            np.ravel(result["cranks.angle"]), 2.0 * np.arcsin(k * cn / dn) - np.pi / 2, atol=error, err_msg=integrator
        )
        np.testing.assert_allclose(result.array("orientation")[:, 0], np.tile([1.0, 0, 0, 0], (len(cn), 1)), atol=1e-9)


CARRIED = """
format: 1
name: carried
gravity: [0, -9.81, 0]
bodies:
  arm: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0.5, 0, 0], angular_velocity: [0, 3, 0]}
  seat: {mass: 2, inertia: [1, 2, 3], centre_of_mass: [0.1, 0, 0.2], position: [1, 0.5, 0]}
joints:
  pin: {type: universal, bodies: [ground, arm], point: [0, 0, 0], axes: [[0, 1, 0], [0, 0, 1]]}
  cranks: {type: parallel-cranks, bodies: BODIES, points: POINTS, axis: [0.1, 0, 1]}
simulation: {duration: 1, step: 1 ms, integrator: rk4}
"""


@pytest.mark.parametrize("forwards", [True, False], ids=["carries-its-second", "carries-its-first"])
def test_the_joint_of_the_page_moves_on_what_moves_as_its_constraints_say(seat, folder, forwards):
    bodies, points = ["arm", "seat"], ["[1, 0, 0]", "[1, 0.5, 0]"]
    order = 1 if forwards else -1
    text = CARRIED.replace("BODIES", f"[{', '.join(bodies[::order])}]").replace(
        "POINTS", f"[{', '.join(points[::order])}]"
    )
    (folder / "carried.yaml").write_text(text, encoding="utf-8")
    machine = nivel.load(folder / "carried.yaml")
    ours, theirs = (machine.simulate(coordinates=each) for each in ("relative", "absolute"))
    for name, error in (
        ("position", 1e-7),
        ("orientation", 1e-7),
        ("velocity", 1e-6),
        ("cranks.angle", 1e-7),
        ("joint_force", 1e-5),
    ):
        np.testing.assert_allclose(ours.array(name), theirs.array(name), atol=error, err_msg=name)
    # the zero of the angle is that of the result, also where the position of the tree is half a turn apart
    arm = machine.mechanics(coordinates="relative")
    assert arm.names[-1] == "cranks.angle"
    np.testing.assert_allclose(arm.start, [theirs.array(name)[0] for name in arm.names], atol=1e-12)
    np.testing.assert_allclose(arm.pose("seat")[0], theirs.array("seat.position")[0], atol=1e-12)
    rates = np.array([theirs.array(f"{name}.rate")[0] for name in arm.names])
    np.testing.assert_allclose(arm.jacobian("seat")[:3] @ rates, theirs.array("seat.velocity")[0], atol=1e-11)


def test_the_joint_of_the_page_has_its_sign_and_convention(seat, tmp_path):
    assert "parallel-cranks: angle: of the cranks about" in str(seat.check())
    report = seat.simulate(duration=0.01).report(tmp_path / "report.html").read_text(encoding="utf-8")
    assert 'd="M-11 7V-7H11V7"' in report


def test_a_joint_outside_the_package_is_checked(seat):
    with pytest.raises(ValueError, match="already"):
        JOINTS.register(JOINTS["parallel-cranks"])
    with pytest.raises(nivel.ModelError, match=r"needs two, one on each body|`points`"):
        nivel.Joint(name="j", type="parallel-cranks", bodies=("ground", "seat"), point=(0, 0, 0))


# 870 kg/m³ · 46 mm²/s, but for the air; the time constant is V/(K G), G = π d⁴/(128 μ L)
VISCOSITY = 870.0 * 46e-6
CONDUCTANCE = math.pi * 1e-12 / (128.0 * VISCOSITY * 0.5)
DECAY = 1e-3 / (1.5e9 * CONDUCTANCE)
CIRCUIT_INTEGRATORS = ("rk4", "generalised-alpha", "radau", "bdf", "extrapolated-euler")


@pytest.mark.parametrize("integrator", CIRCUIT_INTEGRATORS)
def test_the_vessel_empties_through_the_capillary_as_the_closed_form_says(vessel, integrator):
    result = vessel.simulate(integrator=integrator)
    fall = np.exp(-result.time / DECAY)
    assert fall[-1] < 0.05
    # 1e-4 of air at 200 bar changes density and bulk modulus by less than 2e-4, and t exp(-t) is at most 0.37
    over = np.ravel(result["hydraulics.vessel.pressure"]) - 200e5
    np.testing.assert_allclose(over, 100e5 * fall, atol=1e-4 * 100e5)
    np.testing.assert_allclose(
        np.ravel(result["hydraulics.bleed.flow"]), CONDUCTANCE * over, rtol=2e-4, atol=1e-6 * CONDUCTANCE * 100e5
    )


def test_energy_and_mass_of_the_capillary_are_balanced(vessel):
    report = vessel.simulate(integrator="radau").trust
    verdicts = {item.name: item.verdict for item in report.items}
    assert verdicts["hydraulics"] == verdicts["fluid mass"] == "green"


def test_the_capillary_is_drawn_in_report_and_viewer(vessel, tmp_path):
    result = vessel.simulate(duration=0.01)
    drawn = circuit_diagram(vessel.record.model_dump(mode="json"), {})
    for text in (drawn, result.report(tmp_path / "report.html").read_text(encoding="utf-8")):
        assert "M0 -18 V18 M-5 -11 V11 M5 -11 V11" in text
        assert "500 mm × 1 mm" in text


def test_without_its_symbol_the_capillary_is_a_box_with_its_type(vessel):
    kind = COMPONENTS["capillary"]
    COMPONENTS.withdraw("capillary")
    COMPONENTS.register(replace(kind, symbol=None))
    try:
        drawn = circuit_diagram(vessel.record.model_dump(mode="json"), {})
    finally:
        COMPONENTS.withdraw("capillary")
        COMPONENTS.register(kind)
    assert '<text text-anchor="middle" y="4">capillary</text>' in drawn


def test_check_tells_what_a_component_without_slopes_costs(vessel):
    (line,) = [line for line in str(vessel.check()).splitlines() if "derivatives" in line]
    assert "bleed (capillary)" in line
    assert "extrapolated-euler" in line


def test_the_faults_of_a_component_outside_the_package_are_told(vessel, folder):
    text = FILES["vessel.yaml"].replace("B: supply}, diameter: 1 mm", "C: supply}, diameter: 1 kg")
    (folder / "wrong.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(nivel.ModelError) as caught:
        nivel.load(folder / "wrong.yaml")
    told = str(caught.value)
    assert "wrong.yaml:11" in told
    assert "`C`" in told
    assert "diameter" in told


class Hose(Volume):
    """A volume by another word."""

    type: Literal["hose"] = "hose"  # type: ignore[assignment]


def test_a_component_outside_the_package_may_be_a_node(vessel, folder):
    COMPONENTS.register(ComponentKind(Hose, None, (), nodes=volume_nodes))
    try:
        (folder / "hose.yaml").write_text(FILES["vessel.yaml"].replace("type: volume", "type: hose"), encoding="utf-8")
        hose = nivel.load(folder / "hose.yaml")
        ours, theirs = (each.simulate(integrator="rk4")["hydraulics.vessel.pressure"] for each in (hose, vessel))
        np.testing.assert_array_equal(ours, theirs)
        drawn = (circuit_diagram(each.record.model_dump(mode="json"), {}) for each in (hose, vessel))
        assert len({*drawn}) == 1
    finally:
        COMPONENTS.withdraw("hose")


def test_nodes_that_words_name_are_made():
    with pytest.raises(ValueError, match="nodes of 'hose'"):
        ComponentKind(Hose, None, ())


def test_a_component_states_the_phase_of_its_kernels(vessel):
    kind = COMPONENTS["capillary"]
    maxwell = importlib.import_module("nivel.elements.forces.springs").resist
    with pytest.raises(ValueError, match=r"Phase\.FLOWS"):
        replace(kind, families=(maxwell,))
    with pytest.raises(ValueError, match="already"):
        COMPONENTS.register(kind)


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


def edited(folder, edits):
    """A copy of the package in `folder`, with these edits of the page."""
    # with its byte code, which is that of files as old as they are: only what is edited is translated again
    shutil.copytree(ROOT / "src" / "nivel", folder / "nivel")
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


def is_of_integrators(path):
    """Whether an edit of this file is one of the integrators."""
    return path.startswith("src/nivel/integrate/") or path == "src/nivel/methods.py"


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the package with the edits of the page, but those of integrators."""
    edits = [each for each in EDIT.findall(PAGE) if not is_of_integrators(each[0])]
    assert len(edits) == 10
    return edited(tmp_path_factory.mktemp("package"), edits)


@pytest.fixture(scope="module")
def with_integrators(tmp_path_factory):
    """A copy of the package with the integrators of the page."""
    edits = [each for each in EDIT.findall(PAGE) if is_of_integrators(each[0])]
    assert len(edits) == 4
    return edited(tmp_path_factory.mktemp("integrators"), edits)


def run(folder, *command):
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    done = subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


CALCULATE = """
import numpy as np
from nivel.analysis.curves.functions import ExpressionCurve
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.kernels.record import program
from nivel.system.laws.program import expression_program
length = Expression("hypot3(time, 2*time, 2*time)")
row = np.array([*expression_program(length, ["time"]), 3.0, 0.0, 0.0])
low, high = ExpressionCurve(length).bounds({"time": np.array([1.0])}, {"time": np.array([2.0])})
print(length(3.0), program.run.code(row), length.derivative(3.0), low[0], high[0], read_quantity("hypot3(3 m, 4 m, 0)", "length", {}))
try:
    read_quantity("hypot3(3 m, 4 kg, 0)", "length", {})
except ExpressionError as error:
    print(error)
"""


def test_the_function_of_the_page_is_there(package):
    numbers, refused = run(package, "-c", CALCULATE).splitlines()
    assert list(map(float, numbers.split())) == pytest.approx([9.0, 9.0, 3.0, 3.0, 6.0, 5.0], rel=1e-14)
    assert refused == "a length (m) and a mass (kg) cannot be compared"


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


SETTING = """
import inspect, sys
from pathlib import Path
import nivel
from nivel.api import Machine
from nivel.files.schema import schema
page = Path("simulation.md").read_text()
print(next(line for line in page.splitlines() if line.startswith("| `pause`")))
print(schema()["$defs"]["SimulationSettings"]["properties"]["pause"]["description"])
for function in (Machine.simulate, Machine.start, Machine.sweep):
    assert inspect.signature(function).parameters["pause"].default is None
machine = nivel.load("pair.yaml", {"simulation.pause": "1500 ms"})
print(machine.simulation.pause, machine.with_settings({"pause": 2}).simulation.pause)
for wrong in ("2 kg", -1, []):
    try:
        machine.simulate(pause=wrong)
    except nivel.ModelError as error:
        print(*(f"{fault.path}: {fault.message}" for fault in error.faults))
"""


def test_the_setting_of_the_page_is_one_field(package):
    """Command line, keywords, table and schema follow; a user's script with the keyword passes the type checker."""
    shutil.copy(ROOT / "docs" / "machine-files" / "simulation.md", package)
    before = run(package, "-m", "nivel", "run", "--help")
    run(package, str(ROOT / "packaging" / "write_settings.py"), "simulation.md")
    lines = run(package, "-m", "nivel", "run", "--help").splitlines()
    added = [line for line in lines if line not in before.splitlines()]
    assert [line.split() for line in added] == [
        *map(str.split, ["--pause TIME  Time at rest before the motion; default: none."])
    ]
    row, described, values, *refused = run(package, "-c", SETTING).splitlines()
    assert row == "| `pause` | s | none | greater than 0 | time at rest before the motion |"
    assert described == "time at rest before the motion; default: none"
    assert values == "1.5 2.0"
    assert refused == [
        "pause: `2 kg` is a mass (kg); a time (s) was expected",
        "pause: a time greater than zero was expected, got `-1`",
        "pause: a number or a text was expected, got a list",
    ]
    script = (
        "# pyright: strict\nimport nivel\nm = nivel.load('pair.yaml')\nm.simulate(pause='2 s')\nm.simulate(pause=[])\n"
    )
    (package / "script.py").write_text(script, encoding="utf-8")
    checked = subprocess.run(
        [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, "script.py"],
        cwd=package,
        env={**os.environ, "PYTHONPATH": str(package)},
        capture_output=True,
        text=True,
        check=False,
    )
    found = json.loads(checked.stdout)["generalDiagnostics"]
    assert {each["range"]["start"]["line"] + 1 for each in found} == {5}


FLY = """
import json, nivel
from nivel.results import Result
for speed in ("400", "300"):
    with open("flight.yaml", "w") as file:
        file.write(
            "format: 1\\nname: flight\\ngravity: [0, 0, 0]\\n"
            "bodies: {shell: {mass: 1, inertia: [1, 1, 1], velocity: [0, " + speed + ", 0]}}\\n"
            "simulation: {duration: 0.01}\\n"
        )
    trust = nivel.load("flight.yaml").simulate(verify=False, out=f"{speed}.nc").trust
    print(json.dumps([[item.name, item.verdict, item.text] for item in trust.items if item.name == "supersonic"]))
    print(json.dumps(Result.open(f"{speed}.nc").trust.found["supersonic"]))
"""


def test_the_line_of_the_trust_report_of_the_page_is_told(package):
    fast, found, slow, of_slow = map(json.loads, run(package, "-c", FLY).splitlines())
    assert slow == []
    ((name, verdict, text),) = fast
    assert (name, verdict) == ("supersonic", "amber")
    assert "shell moves at 400 m/s at t = 0 s" in text
    assert found == {"body": "shell", "speed": 400.0, "time": 0.0}
    assert of_slow["speed"] == 300.0
    assert "more than the square of the speed" in run(package, "-m", "nivel", "explain", "400.nc")


SWING = """
format: 1
name: swing
bodies:
  bob: {mass: 2, inertia: [1, 1, 1], position: [1, 0, 0]}
joints:
  rail: {type: translational, bodies: [ground, bob], point: [0, 0, 0], axis: [1, 0, 0]}
forces:
  spring:
    {type: spring-damper, bodies: [ground, bob], points: [[-1, 0, 0], [1, 0, 0]], stiffness: 18 N/m, damping: DAMPING, free_length: 1.5 m}
simulation: {duration: 1, step: 10 ms, output_interval: 100 ms}
"""


def end_of_swing(t, damping):
    """Displacement at t of a mass of 2 kg on 18 N/m from rest, 0.5 m from where the spring is free: x_0 (s_2 e^{s_1 t} - s_1 e^{s_2 t})/
    (s_2 - s_1) - x_0 with the roots of 2 s² + d s + 18 = 0."""
    first, second = np.roots([2.0, damping, 18.0])
    x = 0.5 * (second * np.exp(first * t) - first * np.exp(second * t)) / (second - first)
    return x.real - 0.5


INTEGRATE = """
import sys, nivel
machine = nivel.load("swing.yaml")
for integrator in ("midpoint", "implicit-euler"):
    for step in (0.01, 0.005):
        result = machine.simulate(integrator=integrator, step=step, coordinates=sys.argv[1])
        print(float(result["rail.displacement"][-1]))
"""


@pytest.mark.parametrize("coordinates", tail(COORDINATES, ["relative"]))
def test_the_integrators_of_the_page_converge_with_their_orders(with_integrators, coordinates):
    (with_integrators / "swing.yaml").write_text(SWING.replace("DAMPING", "4 N*s/m"), encoding="utf-8")
    places = [float(line) for line in run(with_integrators, "-c", INTEGRATE, coordinates).split()]
    errors = np.abs(np.array(places) - end_of_swing(1.0, 4.0))
    np.testing.assert_allclose(np.log2(errors[[0, 2]] / errors[[1, 3]]), [2.0, 1.0], atol=0.1)


def test_the_implicit_integrator_of_the_page_takes_steps_beyond_the_fastest_rate(with_integrators):
    # damped at 10⁴ 1/s, a hundred times the step
    (with_integrators / "swing.yaml").write_text(SWING.replace("DAMPING", "2e4 N*s/m"), encoding="utf-8")
    follow = "import nivel; r = nivel.load('swing.yaml').simulate(integrator='implicit-euler'); print(float(r['rail.displacement'][-1]))"
    assert float(run(with_integrators, "-c", follow)) == pytest.approx(end_of_swing(1.0, 2e4), rel=1e-3)


def test_the_words_of_the_integrators_of_the_page_are_listed(with_integrators):
    listed = run(with_integrators, "-m", "nivel", "run", "--help").split()
    assert {"midpoint,", "implicit-euler,"} <= {*listed}
