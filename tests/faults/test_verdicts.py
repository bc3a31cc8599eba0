"""Verdicts of all analyses: each says whether it was verified, by what, and what not; what was not verified never looks green."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from nivel.cli import main
from nivel.results.trust import Trust

pytestmark = pytest.mark.usefixtures("verified")

FAULTS = Path(__file__).parent
EXAMPLES = FAULTS.parent.parent / "examples"


@pytest.fixture(scope="module")
def train():
    return nivel.load(FAULTS / "t6-sweep.yaml", {"simulation.integrator": "rk4"})


def test_a_sweep_without_second_runs_says_that_it_is_not_verified(train):
    """A spring at a train, which one run alone cannot tell to be wrong by half its range."""
    found = train.sweep({"train.mass": [1e5]}, processes=1)
    assert found.verdict.values.tolist() == ["not verified"]
    assert found.verified.values.tolist() == [False]
    assert (found.attrs["verdict"], found.attrs["verified"]) == ("not verified", 0)
    assert np.isnan(found.estimated_error.values).all()


def test_a_verified_sweep_tells_what_is_wrong(train):
    """x = 5 cm (1 - cos ω t), ω² = k (1/m + 1/M)."""
    found = train.sweep({"train.mass": [1e5, 2e5]}, processes=1, verify=True)
    omega = np.sqrt(1000.0 * (10.0 + 1.0 / found["train.mass"]))
    wrong = np.abs(found["slide.displacement"] - 0.05 * (1.0 - np.cos(omega * found["time"]))).max("time")
    assert wrong.min() > 0.05
    assert found.verdict.values.tolist() == ["red", "red"]
    assert found.verified.values.all()
    assert (found.estimated_error > 0.5 * wrong).all()
    assert found.attrs["verdict"] == "red"
    assert Trust.from_json(found.attrs["trust"]).verified_by == ("second runs of 2 variants",)


def test_a_sweep_that_is_verified_is_green_where_its_variants_are(train):
    found = train.sweep({"s.stiffness": [0.1]}, processes=1, verify=True, duration=0.2)
    assert found.verdict.values.tolist() == ["green"]
    assert (found.attrs["verdict"], found.attrs["verified"]) == ("green", 1)


def test_results_in_json_say_whether_they_were_verified(train):
    data = json.loads(train.simulate(duration=0.1, verify=False).trust.to_json())
    assert (data["verified"], data["light"], data["verified_by"]) == (False, "not verified", [])
    data = json.loads(train.simulate(duration=0.1, verify=True).trust.to_json())
    assert data["verified"]
    assert data["verified_by"] == ["a second run with steps of 2 ms"]


BEAM = """
format: 1
gravity: [0, 0, -9.81]
beams:
  arm: {from: [0, 0, 0], to: [1, 0, 0], up: [0, 0, 1], section: {type: circle, radius: 1 cm}, elements: 4, order: 2,
        material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}}
joints:
  clamp: {type: fixed, bodies: [ground, arm.start], point: [0, 0, 0]}
"""


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("arm") / "arm.yaml"
    path.write_text(BEAM, encoding="utf-8")
    return nivel.load(path)


def test_statics_say_what_has_examined_them(arm):
    single = arm.statics(duration=0, verify=False).trust
    assert single.verified_by == ("the balance of forces in every state",)
    assert single.not_verified == ("the elements of beams",)
    assert (single.verdict, single.light) == ("green", "not verified")
    both = arm.statics(duration=0).trust
    assert both.light == "green"
    assert "a machine with twice as many elements of beams" in both.verified_by


def test_the_command_shows_no_green_over_what_is_not_verified(arm, tmp_path):
    file, out = tmp_path / "arm.yaml", tmp_path / "arm.nc"
    file.write_text(BEAM, encoding="utf-8")
    words = ["statics", str(file), "--duration", "0", "--no-verify", "--out", str(out)]
    done = CliRunner().invoke(main, words)
    assert (
        "trust: verified in part: by the balance of forces in every state; not verified: the elements of beams"
        in done.output
    )
    page = out.with_suffix(".html").read_text(encoding="utf-8")
    assert "Yes, everything is in the green" not in page
    assert "Verified in part" in page


def test_kinematics_say_that_functions_in_python_are_not_compared():
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    coarse = machine.kinematics(drive="hinge", positions=5).trust
    assert coarse.light == "amber"
    assert "Between positions" in str(coarse)
    trust = machine.kinematics(drive="hinge", positions=73).trust
    assert (trust.light, trust.not_verified) == ("green", ())
    assert trust.verified_by == ("the closed joints", "the functions of its drivers, evaluated apart")


def test_linear_models_say_what_has_examined_them(arm):
    """A clamped beam: with other elements its slow vibrations are verified, the fastest are marked as wrong."""
    model = arm.linearise()
    assert model.trust.light == "green"
    assert model.trust.verified_by == (
        "the equilibrium of the state",
        "a machine with half as many elements of beams",
    )
    unresolved = [each.number for each in model.modes if each.unresolved]
    assert unresolved[0] > 4
    assert unresolved == list(range(unresolved[0], len(model.modes) + 1))
    assert model.to_xarray().attrs["verdict"] == "green"
    single = arm.linearise(verify=False)
    assert single.trust.not_verified == ("the elements of beams",)
    assert (single.trust.light, single.to_xarray().attrs["verified"]) == ("not verified", 0)
    assert single.summary()["trust"]["light"] == "not verified"
    assert not any(each.unresolved for each in single.modes)


def test_a_state_that_a_run_reached_is_not_verified(train):
    model = train.linearise(about="0.1 s")
    assert model.trust.not_verified == ("the run to the state at 0.1 s",)


def test_eigenvalues_over_a_parameter_are_verified_where_it_is_asked_for(tmp_path):
    file = tmp_path / "arm.yaml"
    file.write_text(
        BEAM.replace("1 cm}", "thick}").replace("format: 1", "format: 1\nparameters: {thick: 1 cm}"), encoding="utf-8"
    )
    words = [
        "linearise",
        str(file),
        "--over",
        "parameters.thick=1:2:2 cm",
        "--out",
        str(tmp_path / "over.nc"),
        "--force",
        "--json",
    ]
    plain = CliRunner().invoke(main, words)
    assert json.loads(plain.stdout)["trust"]["light"] == "not verified"
    assert "the elements of beams" in plain.stderr
    verified = CliRunner().invoke(main, [*words, "--verify"])
    assert json.loads(verified.stdout)["trust"]["light"] == "green"
    assert "trust: green, verified by the trust reports of 2 variants" in verified.stderr


WALL = """
format: 1
bodies:
  block: {mass: 1, inertia: [1, 1, 1], velocity: [1, 0, 0]}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}
forces:
  wall: {type: motor, coordinate: rail, effort: "-1e7*exp(-((rail.displacement - 0.45678)/1e-6)^2)"}
simulation: {duration: 1 s, step: 5 ms}
"""


def test_references_turn_back_at_a_wall_that_fixed_steps_pass(tmp_path):
    """A wall of 17.7 J, 2 µm wide: a block of 0.5 J turns back at it."""
    file = tmp_path / "wall.yaml"
    file.write_text(WALL, encoding="utf-8")
    comparison = nivel.load(file).compare(integrators=["rk4"], repeat=1)
    assert comparison.rows[0].motion_error > 0.1
    chosen, fixed = comparison.references
    assert not chosen.blind
    assert "their steps miss wall" in fixed.blind


def test_a_comparison_whose_references_share_a_blind_spot_says_so(tmp_path, monkeypatch):
    """The same, where steps do not go back for narrow features: both references step over the wall and agree."""
    monkeypatch.setattr("nivel.analysis.run.dynamics.narrow_functions", lambda machine: ())
    file = tmp_path / "wall.yaml"
    file.write_text(WALL, encoding="utf-8")
    comparison = nivel.load(file).compare(integrators=["rk4"], repeat=1)
    assert len(comparison.references) == 2
    assert comparison.rows[0].motion_error < 1e-9
    assert all("their steps miss" in each.blind for each in comparison.references)
    assert (comparison.trust.verdict, comparison.trust.verified) == ("amber", False)
    assert "may have the same error as the runs: their steps miss wall" in str(comparison)
    assert type(comparison).from_json(comparison.to_json()).trust == comparison.trust


def test_a_comparison_whose_references_check_each_other_is_green(train):
    comparison = train.compare(steps=[1e-3], duration=0.05, repeat=1)
    assert comparison.trust.light == "green"
    assert len(comparison.trust.verified_by) == 2


def test_loads_carry_the_verdict_of_their_result(train, tmp_path):
    result = train.simulate(duration=0.2, verify=False, out=tmp_path / "train.nc")
    assert result.reactions().attrs["verdict"] == "not verified"
    done = CliRunner().invoke(main, ["loads", str(tmp_path / "train.nc"), "--json"])
    assert json.loads(done.stdout)["trust"]["reactions"] == {
        "verdict": "not verified",
        "verified": 0,
        "headline": result.reactions().attrs["headline"],
    }
    said = CliRunner().invoke(main, ["loads", str(tmp_path / "train.nc")]).stdout
    assert "trust: not verified" in said
    verified = train.simulate(duration=0.2, verify=True, step="0.1 ms", output_interval="0.1 ms")
    assert verified.cycles("slide.displacement").attrs["verdict"] == "green"


def test_loads_say_what_frames_may_hide(train):
    """x = 5 cm (1 - cos 100 t) with 6.3 frames in a period: the highest frame is at 1 - cos 3, 0.5 % below the peak."""
    result = train.simulate(duration=0.2, verify=True, step="0.1 ms", output_interval="10 ms")
    cycles = result.cycles("slide.displacement")
    assert cycles.attrs["verdict"] == "not verified"
    assert "slide.displacement between frames" in cycles.attrs["headline"]


def test_steps_and_libraries_say_that_they_are_not_verified(train, tmp_path):
    sim = train.start(record=True)
    sim.step()
    assert not sim.verified
    assert repr(sim).endswith("not verified>")
    assert not sim.result().trust.verified
    written = train.export_c(tmp_path / "c")
    assert not written.verified
    assert (
        "Not verified: the library makes single runs with steps of 0.01 s"
        in (written.folder / f"{written.name}.h").read_text()
    )


def test_a_disc_whose_velocity_has_the_wrong_sign_is_not_steady_in_words(tmp_path):
    """A disc in a steady circle; the file has v = -ω × r, which the joint changes into another motion. With the right sign it is judged."""
    wrong = nivel.load(FAULTS / "disc.yaml").linearise()
    assert not wrong.steady
    said = " ".join(wrong.notes)
    assert "it does not move steadily, disc.y accelerates most, by " in said
    assert "the given velocity of disc was changed by 0.415 m/s and 0.083 rad/s" in said
    assert (wrong.trust.verdict, wrong.trust.verified) == ("amber", False)
    file = tmp_path / "disc.yaml"
    file.write_text((FAULTS / "disc.yaml").read_text().replace("velocity: [0.2", "velocity: [-0.2"), encoding="utf-8")
    right = nivel.load(file).linearise()
    assert right.steady
    assert (right.trust.light, int(right.structural.sum())) == ("green", 4)
