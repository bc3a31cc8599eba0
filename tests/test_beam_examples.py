"""Examples of beams: each runs, and does what its comments say."""

import runpy
from pathlib import Path

import numpy as np
import pytest

import nivel
from needing import needs
from references import hinged_beams, spin_up

EXAMPLES = Path(__file__).parent.parent / "examples" / "beams"
# a driven corner rings for ever in Newmark's method, and its work is known to the order of the step only
ENERGY_AMBER = {"hinged-beams"}


@pytest.fixture(scope="module")
def run():
    """The result of an example, computed once."""
    results = {}

    def of(name):
        if name not in results:
            results[name] = nivel.load(EXAMPLES / f"{name}.yaml").simulate()
        return results[name]

    return of


@pytest.mark.parametrize("name", sorted(path.stem for path in EXAMPLES.glob("*.yaml")))
def test_example_runs_green(name, run):
    result = run(name)
    assert result.outcome == "done"
    for item in result.trust.items:
        expected = "amber" if item.name == "energy" and name in ENERGY_AMBER else "green"
        assert item.verdict == expected, result


def test_hinged_beams_follow_the_converged_solution():
    """Within 0.05 m, where the tip moves by up to 13 m; the script is what a reader runs."""
    script = runpy.run_path(str(EXAMPLES / "hinged_beams.py"))
    time, tip = script["tip_displacement"](20, output_interval=0.1)
    expected = np.array(hinged_beams.TIP)
    np.testing.assert_allclose(time, expected[:, 0], atol=1e-12)
    assert np.linalg.norm(tip - expected[:, 1:4], axis=1).max() < 0.05


def test_hinged_beams_are_plotted(tmp_path):
    needs("matplotlib").use("Agg")
    runpy.run_path(str(EXAMPLES / "hinged_beams.py"))["main"](str(tmp_path / "tip.png"))
    assert (tmp_path / "tip.png").stat().st_size > 10_000


def test_spin_up_follows_the_converged_solution(run):
    """u2 is 0.57 m at most."""
    result = run("spin-up")
    seen = np.stack([result.array(f"sensor.deflection.{axis}") for axis in "xy"], axis=1) - [10.0, 0.0]
    expected = np.array([row for row in spin_up.TIP if row[0] <= 15.0])
    at = np.searchsorted(result.time, expected[:, 0] - 1e-9)
    np.testing.assert_allclose(result.time[at], expected[:, 0], atol=1e-9)
    np.testing.assert_allclose(seen[at, 1], expected[:, 2], atol=1e-4)
    np.testing.assert_allclose(seen[at, 0], expected[:, 1], atol=1e-5)


def deflection(result):
    """(n,) of the middle of the rod from its chord, in the plane of motion [m]."""
    start, middle, end = (result.array(f"rod.{name}.position") for name in ("start", "middle", "end"))
    chord = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    return np.cross(chord, middle - start)[:, 2]


def test_connecting_rod_shortens_by_what_it_bends(run):
    """A half sine of height w is shorter along its chord by π² w²/(4 L)."""
    result = run("slider-crank")
    w = deflection(result)
    shorter = 0.4 - result.array("sensor.chord.distance")
    assert 1.5e-3 < w.max() < 2.5e-3
    assert w.min() == pytest.approx(-w.max(), rel=0.1)
    np.testing.assert_allclose(shorter.max(), np.pi**2 * np.abs(w).max() ** 2 / 1.6, rtol=0.05)


def test_piston_is_where_the_rigid_slider_crank_has_it_less_the_shortening(run):
    """x = r cos φ + √(L² - r² sin² φ) with the chord of the rod as L: exact, since its ends are joints."""
    result = run("slider-crank")
    angle, chord = result.array("main.angle"), result.array("sensor.chord.distance")
    expected = 0.1 * np.cos(angle) + np.sqrt(chord**2 - (0.1 * np.sin(angle)) ** 2)
    np.testing.assert_allclose(result.array("piston.position")[:, 0], expected, atol=1e-12)


def test_a_stiffer_rod_bends_less():
    """Deflections far below resonance go as 1/E; amplification of the softer one, by a few percent, and the start do not."""
    stiff = nivel.load(EXAMPLES / "slider-crank.yaml", {"beams.rod.material.youngs_modulus": "2 TPa"}).simulate()
    assert np.abs(deflection(stiff)).max() == pytest.approx(1.94e-3 * 0.105, rel=0.1)


def test_hook_load_is_caught_by_the_rope(run):
    """Impulse of shackle and weight is the change of momentum; the largest force stays below that by hand, of a rope without mass."""
    result = run("cable")
    rope = nivel.load(EXAMPLES / "cable.yaml").record.beams[0]
    weight, length = 500 * 9.81, rope.line.length
    force = -result.dataset["joint_force"].sel(joint="shackle").values[:, 2]  # on the hook, the second body
    fall, stiffness = length - 9.75, 6e6 / length
    by_hand = weight * (1 + np.sqrt(1 + 2 * fall * stiffness / weight))
    assert 0.85 * by_hand < force.max() < by_hand
    speed = result.array("hook.velocity")[:, 2]
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(result.time))])
    expected = 500 * speed + weight * result.time
    np.testing.assert_allclose(impulse, expected, atol=0.01 * expected.max())


def test_tension_at_the_top_is_the_reaction_of_the_eye(run):
    result = run("cable")
    tension = result.sections("rope")["force"].values[:, 0, 0]
    eye = np.linalg.norm(result.dataset["joint_force"].sel(joint="eye").values, axis=1)
    largest = eye.argmax()
    assert tension[largest] == pytest.approx(eye[largest], rel=0.02)


@pytest.mark.full
def test_telescopic_boom_is_the_same_whether_its_pads_are_kept_or_eliminated():
    """Over the first nodes that the pads pass; places differ by the error of the step."""
    boom = nivel.load(EXAMPLES / "telescopic-boom.yaml")
    kept, eliminated = (boom.simulate(coordinates=each, duration=2.0) for each in ("absolute", "relative"))
    np.testing.assert_allclose(eliminated.array("position"), kept.array("position"), atol=1e-5)
    force = kept.array("joint_force")
    np.testing.assert_allclose(eliminated.array("joint_force"), force, atol=2e-3 * np.abs(force).max())


def test_telescopic_boom_rests_on_its_pads_and_is_pushed_out(run):
    """At rest the pads carry the hook and the inner section by the lever rule, less the cosine of what the boom leans."""
    result = run("telescopic-boom")
    at = {name: k for k, name in enumerate(result.dataset["joint"].values)}
    weight, hook, length, apart = 9.81 * 7850 * (0.17 * 0.26 - 0.16 * 0.25) * 5.8, 9.81 * 800, 5.8, 5.5
    front = (hook * length + weight * length / 2) / apart
    forces = np.linalg.norm(result.array("joint_force")[0], axis=1)
    assert forces[at["front"]] == pytest.approx(front, rel=1e-3)
    assert forces[at["rear"]] == pytest.approx(hook + weight - front, rel=2e-3)
    _, reach, _, _ = result.array("joint_coordinate").T  # of foot, rear, front, rope
    np.testing.assert_allclose(reach, 0.5 + 2.0 * (1.0 - np.cos(np.pi * result.time / 5.0)), atol=1e-9)


def test_three_models_of_one_bar_swing_together(run):
    """Within half a millimetre, of 17 that they bend; and they feel the same moments to a per cent."""
    result = run("three-models")
    tips = {name: result[f"{name}.end.position"].values[:, :2] for name in ("exact", "cable", "gradients")}
    assert np.abs(tips["cable"] - tips["exact"]).max() < 1e-4
    assert np.abs(tips["gradients"] - tips["exact"]).max() < 5e-4
    beside = np.hypot(0.2, np.linalg.norm(tips["cable"] - tips["exact"], axis=1))
    np.testing.assert_allclose(result.array("sensor.cable.distance"), beside, rtol=1e-9)
    moments = [np.abs(result.sections(name)["moment"].values[:, :, 2]).max() for name in tips]
    np.testing.assert_allclose(moments, moments[0], rtol=1e-2)


def test_an_eighth_of_a_circle_bends_into_space(run):
    """Statics against Simo and Vu-Quoc 1986; the run, whose load grows slowly, ends within a hundredth of the way of the tip."""
    statics = nivel.load(EXAMPLES / "bend-45.yaml").statics(duration=60, step=15)
    tip = statics["arc.end.position"].values
    half = int(np.flatnonzero(np.isclose(statics.abscissa, 30.0))[0])  # 300 N
    np.testing.assert_allclose(tip[half], [22.33, 58.84, 40.08], rtol=5e-3)
    np.testing.assert_allclose(tip[-1], [15.79, 47.23, 53.37], rtol=5e-3)
    assert np.linalg.norm(run("bend-45")["arc.end.position"].values[-1] - tip[-1]) < 0.6
