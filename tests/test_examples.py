"""Every example runs, green, and shows what it is meant to show."""

import csv
import runpy

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from example_files import EXAMPLES, RIGID
from references import andrews, four_bar, heavy_top, pendulum, slider_crank

# four revolutes with parallel axes are redundant, jaws and stand hold a box with more patches than needed: the examples say so
AMBER = {("redundancy", "four-bar-revolutes"), ("shared_friction", "gripper")}


@pytest.mark.parametrize(
    ("path", "formulation"),
    [
        # as they are, and by default a twelfth of them in the other formulation as well
        pytest.param(
            path, each, id=f"{path.stem}-{each}", marks=[pytest.mark.full] if each == "lagrange" and k % 12 else []
        )
        for k, path in enumerate(RIGID)
        for each in ("newton-euler", "lagrange")
    ],
)
def test_example_runs_green(path, formulation):
    result = nivel.load(path, allow_code=True).simulate(formulation=formulation)
    assert result.outcome == "done"
    for item in result.trust.items:
        expected = "amber" if (item.name, path.stem) in AMBER else "green"
        assert item.verdict == expected, result


def test_slider_crank_passes_its_first_top_dead_centre_at_the_known_time():
    """1.307 s (rigid.md), and the motion of the one-degree-of-freedom solution."""
    result = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").simulate(output_interval="1 ms", duration=2)
    height = result.array("crank.position")[:, 1]  # gravity is along -Y
    assert result.time[np.argmax(height[:1500])] == pytest.approx(1.307, abs=2e-3)
    expected = slider_crank.solve(result.time)
    np.testing.assert_allclose(result.array("position"), expected.position, atol=1e-6)


def test_four_bar_follows_its_one_degree_of_freedom_solution():
    result = nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").simulate(output_interval="50 ms")
    x, y, _ = result.array("position")[0, 0]
    expected = four_bar.solve(result.time, crank_angle=np.arctan2(y, x))
    np.testing.assert_allclose(result.array("position"), expected.position, atol=1e-6)


def test_heavy_top_follows_the_reference():
    result = nivel.load(EXAMPLES / "mechanisms" / "heavy-top.yaml").simulate(step="0.05 ms", output_interval="20 ms")
    expected = heavy_top.solve(result.time)
    axes = Rotation.from_quat(result.array("orientation")[:, 0], scalar_first=True).as_matrix()
    np.testing.assert_allclose(axes, expected.rotation, atol=1e-5)


def test_andrews_squeezer_follows_its_seven_angles():
    """Frames away from the centres of mass, three loops, a spring; the reference meets the published end values."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "andrews-squeezer.yaml")
    result = machine.simulate()
    expected = andrews.solve(result.time, spring=True)
    A = (
        Rotation.from_quat(result.array("orientation").reshape(-1, 4), scalar_first=True)
        .as_matrix()
        .reshape(-1, 7, 3, 3)
    )
    offsets = np.array([body.centre_of_mass for body in machine.record.bodies])
    centres = result.array("position") + np.einsum("nbij,bj->nbi", A, offsets)
    np.testing.assert_allclose(centres[:, :, :2], expected.centres, atol=1e-10)
    np.testing.assert_allclose(A[:, :, 0, 0], np.cos(expected.angles), atol=1e-8)


def test_simple_pendulum_meets_the_benchmark():
    result = nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml").simulate()
    expected = pendulum.solve(result.time, pendulum.IFTOMM_A01)
    np.testing.assert_allclose(result.array("bob.position"), expected.position, atol=1e-5)
    assert np.abs(result.array("energy_error")).max() < 5e-5


def test_machine_written_in_python_runs_and_round_trips(tmp_path):
    machine = runpy.run_path(str(EXAMPLES / "mechanisms" / "double_pendulum.py"))["machine"]
    result = machine.simulate(duration=1)
    assert result.trust.verdict == "green"
    machine.save(tmp_path / "double.yaml")
    again = nivel.load(tmp_path / "double.yaml").simulate(duration=1)
    np.testing.assert_array_equal(again.array("position"), result.array("position"))


@pytest.mark.compiles
def test_the_rod_that_is_found_puts_the_slider_there():
    example = runpy.run_path(str(EXAMPLES / "mechanisms" / "slider_place.py"))
    rod = example["machine"].with_values({example["LENGTH"]: example["find_length"]()})
    place = rod.simulate().array(example["PLACE"])[-1]
    assert place == pytest.approx(example["WANTED"], abs=1e-9)


def test_double_pendulum_matches_its_two_equations():
    """Lagrange's equations of two bars, relative to the vertical, written here; DOP853 at 1e-12."""
    from scipy.integrate import solve_ivp

    machine = runpy.run_path(str(EXAMPLES / "mechanisms" / "double_pendulum.py"))["machine"]
    result = machine.simulate(duration=2)
    L, width, g = 0.5, 0.04, 9.81
    # a bar's mass cancels; J about its centre, the box L by width in the plane of motion
    J = (L**2 + width**2) / 12

    def rates(_t, s):
        a, b, da, db = s
        M = np.array([[J + L**2 / 4 + L**2, L**2 / 2 * np.cos(a - b)], [L**2 / 2 * np.cos(a - b), J + L**2 / 4]])
        Q = np.array(
            [
                -(L**2) / 2 * np.sin(a - b) * db**2 - 1.5 * g * L * np.cos(a),
                L**2 / 2 * np.sin(a - b) * da**2 - 0.5 * g * L * np.cos(b),
            ]
        )
        return [da, db, *np.linalg.solve(M, Q)]

    expected = solve_ivp(rates, (0, 2), [0, 0, 0, 0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=result.time)
    np.testing.assert_allclose(result.array("shoulder.angle"), expected.y[0], atol=1e-6)
    np.testing.assert_allclose(result.array("elbow.angle"), expected.y[1] - expected.y[0], atol=2e-6)


def test_csv_of_a_result_is_read_back(tmp_path):
    result = nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml").simulate(duration=0.1)
    result.export_csv(tmp_path / "pendulum.csv", select=["bob.position"])
    rows = list(csv.reader((tmp_path / "pendulum.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) > len(result.time)


def test_result_is_never_written_over_its_own_machine(tmp_path):
    path = tmp_path / "machine.yaml"
    text = (EXAMPLES / "mechanisms" / "simple-pendulum.yaml").read_text(encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    with pytest.raises(nivel.ModelError, match="made from"):
        nivel.load(path).simulate(out=path, force=True, duration=0.01)
    assert path.read_text(encoding="utf-8") == text
