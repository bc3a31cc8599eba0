"""Searches and sweeps over statics, kinematics, linear models and inverse dynamics, against closed forms."""

import json
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine

G = 9.81
EXAMPLES = Path(__file__).parent.parent.parent / "examples"
BLOCK = """
format: 1
bodies: {block: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [0, 0, 1]}}
gravity: [0, 0, -9.81]
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 500, damping: 4, preload: 0}
simulation: {duration: 1 s, step: 1 ms}
"""
STIFFNESS, DAMPING, PRELOAD = "forces.spring.stiffness", "forces.spring.damping", "forces.spring.preload"
AT_REST = {"about": "equilibrium"}
# a bar of length L hinged at its foot with a spring k, an axial force P = t: upright it is stable up to P = k/L
COLUMN = """
format: 1
bodies: {bar: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0.5]}}
joints: {foot: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 1, 0]}}
gravity: [0, 0, 0]
forces:
  spring: {type: joint-spring-damper, coordinate: foot, stiffness: 3, damping: 0}
  load: {type: force, body: bar, position: [0, 0, 0.5], vector: [0, 0, "-1 N/s * time"]}
simulation: {duration: 1 s, step: 1 ms}
"""
# crank r, rod l in line with the guide: stroke 2 r
CRANK = """
format: 1
parameters: {r: 0.1 m, l: 0.4 m}
bodies:
  crank: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [r/2, 0, 0]}
  rod: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [r + l/2, 0, 0]}
  slider: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [r + l, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [0, 0, 1]}
  pin: {type: revolute, bodies: [crank, rod], point: [r, 0, 0], axis: [0, 0, 1]}
  wrist: {type: revolute, bodies: [rod, slider], point: [r + l, 0, 0], axis: [0, 0, 1]}
  slide: {type: translational, bodies: [ground, slider], point: [r + l, 0, 0], axis: [1, 0, 0]}
gravity: [0, 0, 0]
simulation: {duration: 1 s, step: 1 ms}
"""


def machine(text):
    return nivel.Machine.from_record(parse_machine(text))


@pytest.fixture(scope="module")
def block():
    return machine(BLOCK)


def test_a_stiffness_is_found_that_gives_a_natural_frequency_and_a_damping_that_gives_a_ratio(block):
    """k = m (2π f)², c = 2 ζ √(k m), here m = 2, f = 12 Hz, ζ = 0.05. λ has the undamped frequency as its magnitude."""
    found = block.optimise(
        "mode.1.frequency",
        {STIFFNESS: (100, 1e5), DAMPING: (1, 100)},
        outputs={"ratio": "mode.1.damping_ratio"},
        limits={"objective": (12.0, 12.0), "ratio": (0.05, 0.05)},
        analysis="linearise",
        analysis_settings=AT_REST,
    )
    k = 2.0 * (2.0 * pi * 12.0) ** 2
    assert found.kept
    assert found.values[STIFFNESS] == pytest.approx(k, rel=1e-6)
    assert found.values[DAMPING] == pytest.approx(2.0 * 0.05 * sqrt(2.0 * k), rel=1e-5)


def test_a_preload_is_found_that_holds_the_weight_at_a_height(block):
    """k z = F₀ - m g: F₀ = m g + k z for the height z = 0.01 m."""
    found = block.optimise(
        "rail.displacement",
        {PRELOAD: (-100.0, 0.0)},
        limits={"objective": (0.01, 0.01)},
        analysis="statics",
        analysis_settings={"duration": 0},
    )
    assert abs(found.values[PRELOAD]) == pytest.approx(2.0 * G + 500.0 * 0.01, rel=1e-8)


def test_a_spring_is_found_that_carries_a_critical_load():
    """P = k/L: with P = t and L = 1 m the load of linearised buckling is at t = k, the first equilibrium that is lost too."""
    column = machine(COLUMN)
    found = column.optimise(
        "buckling.1",
        {STIFFNESS: (1.0, 10.0)},
        limits={"objective": (5.0, 5.0)},
        analysis="statics",
        analysis_settings={"buckling": 1, "duration": 1.0},
    )
    assert found.values[STIFFNESS] == pytest.approx(5.0, rel=1e-6)
    swept = column.sweep(
        {STIFFNESS: [0.4, 0.7]},
        analysis="statics",
        analysis_settings={"duration": 1.0, "arc_length": True},
        outputs={"lost": "time(bifurcation)"},
        processes=1,
    )
    assert swept.lost.values == pytest.approx([0.4, 0.7], rel=1e-6)


def test_extremes_of_kinematics_are_those_of_curves_and_not_of_frames(tmp_path):
    """s = r cos φ + √(l² - r² sin² φ): a stroke of 2 r; r sin φ = l sin β has its largest β = asin(r/l) at φ = 90°, between two of 14
    positions, so by the cubics through these."""
    (tmp_path / "crank.yaml").write_text(CRANK)
    crank = nivel.load(tmp_path / "crank.yaml")
    found = crank.optimise(
        lambda result: float(np.ptp(result.array("slider.position.x"))),
        {"parameters.r": (0.05, 0.2)},
        outputs={"least": "min(slider.position.x)", "most": "max(slider.position.x)"},
        limits={"objective": (0.3, 0.3)},
        analysis="kinematics",
        analysis_settings={"drive": "hinge", "positions": 33},
    )
    assert found.values["parameters.r"] == pytest.approx(0.15, rel=1e-6)
    assert found.outputs["least"] == pytest.approx(0.25, rel=1e-6)
    few = crank.sweep(
        {"parameters.r": [0.1, 0.15]},
        analysis="kinematics",
        analysis_settings={"drive": "hinge", "positions": 36},
        outputs={"rise": "max(rod.position.y)", "frame": "rod.position.y"},
        processes=1,
    )
    # the middle of the rod rises by r/2; 35 pieces h of a turn have no frame at 90°: the nearest is lower by 1e-3, a cubic by h⁴/384
    assert few.rise.values == pytest.approx([0.05, 0.075], rel=(2.0 * pi / 35) ** 4 / 384)
    assert few.frame.values == pytest.approx([0.0, 0.0], abs=1e-9)


def test_a_counterweight_is_found_by_inverse_dynamics():
    """The torque that carries m₁ at l₁ and m₂ at -l₂, at the end of the motion, is none where m₂ = m₁ l₁/l₂."""
    text = """
    format: 1
    bodies:
      beam: {mass: 1e-6, inertia: [1e-6, 1e-6, 1e-6]}
      load: {mass: 3, inertia: [1e-6, 1e-6, 1e-6], position: [0.4, 0, 0]}
      weight: {mass: 1, inertia: [1e-6, 1e-6, 1e-6], position: [-0.5, 0, 0]}
    joints:
      hinge: {type: revolute, bodies: [ground, beam], point: [0, 0, 0], axis: [0, 1, 0]}
      first: {type: fixed, bodies: [beam, load], point: [0.4, 0, 0]}
      second: {type: fixed, bodies: [beam, weight], point: [-0.5, 0, 0]}
    drivers: {turn: {coordinate: hinge, value: "0.1 rad/s * time"}}
    gravity: [0, 0, -9.81]
    simulation: {duration: 1 s, step: 1 ms}
    """
    found = machine(text).optimise(
        "hinge.angle.effort",
        {"bodies.weight.mass": (0.5, 4.0)},
        outputs={"most": "max(hinge.angle.effort)"},
        limits={"objective": (0.0, 0.0)},
        analysis="inverse",
    )
    assert found.values["bodies.weight.mass"] == pytest.approx(2.4, rel=1e-6)
    assert abs(found.outputs["most"]) < 1e-5


def test_measured_frequencies_update_a_model(block):
    """Modal model updating: f and ζ of a block on a spring give k = m (2π f)² and c = 2 ζ √(k m)."""
    k = 2.0 * (2.0 * pi * 3.0) ** 2
    found = block.identify(
        {"mode.1.frequency": [2.99, 3.01], "mode.1.damping_ratio": [0.1, 0.1]},
        {STIFFNESS: (100, 5000), DAMPING: (0.1, 50)},
        analysis="linearise",
        analysis_settings=AT_REST,
    )
    assert found.values[STIFFNESS] == pytest.approx(k, rel=1e-4)  # the mean of f has the least squares: f² has another
    assert found.values[DAMPING] == pytest.approx(2.0 * 0.1 * sqrt(2.0 * k), rel=1e-4)


def test_a_study_file_searches_any_analysis_and_takes_outputs_in_words(tmp_path):
    (tmp_path / "block.yaml").write_text(BLOCK)
    (tmp_path / "study.yaml").write_text(
        """
format: 1
machine: block.yaml
parameters: {spring.stiffness: {type: range, from: 100 N/m, to: 20 kN/m}}
analysis: linearise
settings: {about: equilibrium}
outputs:
  frequency: mode.1.frequency
  damping: {type: value, of: mode.1.damping_ratio, at_least: 0.02}
optimise: {output: frequency, maximise: true}
"""
    )
    found = nivel.load_study(tmp_path / "study.yaml").optimise(out=tmp_path / "found.nc")
    k = (4.0 / (2.0 * 0.02)) ** 2 / 2.0  # ζ = c/(2 √(k m))
    assert found.values["spring.stiffness"] == pytest.approx(k, rel=1e-5)
    assert found.dataset.attrs["computed"] == "linearise"
    assert found.dataset.frequency.attrs["units"] == "Hz"
    assert json.loads(found.dataset.attrs["trust"])


def test_mounts_of_the_example_sag_as_far_as_they_may():
    """f = √(g/δ)/(2π), k = m g/(4 δ)."""
    found = nivel.load_study(EXAMPLES / "studies" / "pump-mounts.yaml").optimise()
    assert found.values["parameters.stiffness"] == pytest.approx(80.0 * G / (4.0 * 0.008), rel=1e-6)
    assert found.outputs["frequency"] == pytest.approx(sqrt(G / 0.008) / (2.0 * pi), rel=1e-6)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"analysis": "modal"}, "analysis"),
        ({"analysis": "statics", "time_limit": 1.0}, "belongs to runs"),
        ({"analysis_settings": {"duration": 1}}, "settings of runs"),
        ({"analysis": "linearise"}, "not in equilibrium"),
    ],
)
def test_what_does_not_go_with_an_analysis_is_refused(block, given, message):
    with pytest.raises(ModelError, match=message):
        block.optimise("mode.1.frequency", {STIFFNESS: (100, 200)}, **given)


def test_a_mode_that_does_not_vibrate_has_no_frequency(tmp_path):
    """A pendulum upside down grows with √(m g l/(J + m l²)), which is no frequency; hanging it vibrates by that."""
    path = tmp_path / "pendulum.yaml"
    path.write_text("""
format: 1
gravity: [0, -9.81, 0]
parameters: {angle: 0}
bodies: {bob: {mass: 1, inertia: [0.01, 0.01, 0.01], position: [0, -1, 0]}}
joints: {hinge: {type: revolute, bodies: [ground, bob], point: [0, 0, 0], axis: [0, 0, 1], start: {angle: angle}}}
""")
    found = nivel.load(path).sweep(
        {"parameters.angle": [0, pi]},
        outputs={"f": "mode.1.frequency", "growth": "largest_real_part"},
        analysis="linearise",
    )
    rate = sqrt(9.81 / 1.01)
    assert found.f.values == pytest.approx([rate / (2 * pi), np.nan], nan_ok=True)
    assert found.growth.values[1] == pytest.approx(rate)
