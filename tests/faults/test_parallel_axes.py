"""Loops whose axes are parallel to the digits of an export: one motion in all coordinates, or one message."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from nivel.errors import ModelError
from simulating import machine

FILE = Path(__file__).parent / "tilt_loop.yaml"
METHODS = [
    *itertools.product(["newton-euler"], ["absolute", "relative", "independent"]),
    ("lagrange", "absolute"),
    *itertools.product(["augmented-lagrangian", "penalty"], ["absolute", "relative"]),
]
POINTS = {"A": (0.0, 0.0, 0.0), "B": (0.2, 0.0, 0.2), "C": (0.7, 0.0, 0.3), "D": (0.6, 0.0, 0.0)}
TURNED = 0.3  # [rad] of the crank at the end


@pytest.mark.parametrize("length", [1e-9, 1e-7, 1e-3])
def test_a_pendulum_falls_however_short_it_is(length):
    """From the side, at first with the acceleration g m l²/(J + m l²) of its centre."""
    mass, inertia = 7.85e3 * length**3, 0.1 * 7.85e3 * length**5
    body = {"position": [length, 0, 0], "mass": mass, "inertia": [inertia] * 3}
    pin = {"type": "revolute", "bodies": ["ground", "a"], "point": [0, 0, 0], "axis": [0, 0, 1]}
    duration = 1e-3 * np.sqrt(length)
    result = machine({"bodies": {"a": body}, "joints": {"pin": pin}, "gravity": [0, -9.81, 0]}).simulate(
        duration=duration, step=duration / 10, output_interval=duration, integrator="rk4", verify=False
    )
    fallen = 0.5 * 9.81 / 1.1 * duration**2
    assert result.array("position")[-1, 0, 1] == pytest.approx(-fallen, rel=1e-4)


def rocker_angle(points, turned):
    """Of the rocker of the four-bar A B C D in its plane, from where it was: circles about the ends of the crank and of the ground."""
    A, B, C, D = (complex(points[name][0], points[name][2]) for name in "ABCD")
    tip = A + (B - A) * np.exp(-1j * turned)  # about Y, Z turns to X
    span, rod, arm = D - tip, abs(C - B), abs(C - D)
    along = (abs(span) ** 2 + rod**2 - arm**2) / (2 * abs(span))
    height = np.sqrt(rod**2 - along**2)
    ends = [tip + span / abs(span) * (along + side * 1j * height) for side in (1, -1)]
    end = min(ends, key=lambda each: abs(each - C))
    return -np.angle((end - D) / (C - D))


def angles(loaded, formulation, coordinates):
    result = loaded.simulate(formulation=formulation, coordinates=coordinates, verify=False)
    return np.asarray(result.array("joint_coordinate"))[-1]


def test_the_closed_form_is_that_of_the_file():
    assert rocker_angle(POINTS, TURNED) == pytest.approx(0.12451858, abs=1e-8)


@pytest.mark.parametrize(("formulation", "coordinates"), METHODS)
@pytest.mark.parametrize("tilt", [1e-15, 1e-12, 1e-10, 1e-8, 9e-7])
def test_an_axis_that_is_parallel_to_its_digits_is_parallel(tilt, formulation, coordinates):
    loaded = nivel.load(FILE, {"joints.jd.axis": [0, 1, tilt]})
    assert angles(loaded, formulation, coordinates)[2] == pytest.approx(rocker_angle(POINTS, TURNED), abs=1e-7)


def oblique(turn, tilts):
    """The four-bar in a plane that is turned, all numbers with six digits; axes of its joints tilted by these vectors."""
    P = {name: np.round(turn.apply(point), 6).tolist() for name, point in POINTS.items()}
    axis = turn.apply([0, 1, 0])

    def bar(a, b):
        return {"shape": {"type": "box", "from": P[a], "to": P[b], "width": 0.03, "height": 0.02}, "density": 2700}

    def pin(first, second, at, tilt):
        axes = np.round(axis + tilt, 7).tolist()
        return {"type": "revolute", "bodies": [first, second], "point": P[at], "axis": axes}

    return {
        "bodies": {"a": bar("A", "B"), "b": bar("B", "C"), "c": bar("D", "C")},
        "joints": {
            "ja": pin("ground", "a", "A", tilts[0]),
            "jb": pin("a", "b", "B", tilts[1]),
            "jd": pin("ground", "c", "D", tilts[2]),
            "jc": pin("b", "c", "C", tilts[3]),
        },
        "drivers": {"d": {"coordinate": "ja.angle", "value": "time"}},
        "simulation": {"duration": TURNED},
    }


@pytest.mark.parametrize(("formulation", "coordinates"), METHODS)
def test_a_four_bar_in_an_oblique_plane_with_six_digits_runs(formulation, coordinates):
    rng = np.random.default_rng(7)
    turn, tilts = Rotation.from_rotvec([0.4, -0.7, 0.9]), rng.uniform(-2e-7, 2e-7, (4, 3))
    found = angles(machine(oblique(turn, tilts)), formulation, coordinates)
    assert found[2] == pytest.approx(rocker_angle(POINTS, TURNED), abs=1e-5)  # points have six digits


@pytest.mark.parametrize("driven", [True, False])
@pytest.mark.parametrize("tilt", [1.2e-6, 1e-5, 1e-3, 9e-3])
def test_an_axis_that_is_not_parallel_is_named_in_one_message(tilt, driven, tmp_path):
    text = FILE.read_text().replace("1e-12]", f"{tilt}]")
    text = text if driven else re.sub(r"drivers:\n.*\n", "", text)
    (tmp_path / "tilted.yaml").write_text(text)
    with pytest.raises(ModelError) as caught:
        nivel.load(tmp_path / "tilted.yaml").check()
    (fault,) = caught.value.faults
    assert fault.path == "joints.jd.axis"
    assert fault.line
    assert f"{tilt:.3g} rad" in fault.message
    assert "axes of ja, jb, jc" in fault.message


def test_the_tolerance_that_a_message_proposes_is_enough():
    tilted = {"joints.jd.axis": [0, 1, 1e-4]}
    with pytest.raises(ModelError) as caught:
        nivel.load(FILE, tilted).check()
    (value,) = re.findall(r"parallel: ([\d.e-]+) rad", str(caught.value))
    loaded = nivel.load(FILE, {**tilted, "assembly.parallel": float(value)})
    assert angles(loaded, "newton-euler", "relative")[2] == pytest.approx(rocker_angle(POINTS, TURNED), abs=1e-7)


def test_axes_that_are_meant_to_differ_are_left_alone():
    """A spatial loop that moves with its axes at an angle: the tilt takes no freedom from it, and stays."""
    tilt = 5e-3
    pins = {
        "low": {"type": "revolute", "bodies": ["ground", "arm"], "point": [0, 0, 0], "axis": [0, 1, 0]},
        "high": {"type": "revolute", "bodies": ["ground", "link"], "point": [0, 0, 0.4], "axis": [0, 1, tilt]},
        "ball": {"type": "spherical", "bodies": ["arm", "rod"], "point": [0.5, 0, 0]},
        "eye": {"type": "spherical", "bodies": ["link", "rod"], "point": [0.5, 0, 0.4]},
    }
    body = {"mass": 1, "inertia": [1, 1, 1]}
    places = {"arm": [0.2, 0, 0], "link": [0.2, 0, 0.4], "rod": [0.5, 0, 0.2]}
    facts = machine({"bodies": {name: {**body, "position": at} for name, at in places.items()}, "joints": pins}).check()
    assert facts.degrees_of_freedom == 2  # of the rod about its line, too
    axis = next(joint for joint in facts.joints if joint.name == "high").axis
    assert axis[2] == pytest.approx(tilt, rel=1e-4)


ANALYSES = {
    "run": lambda loaded: loaded.simulate(verify=False),
    "statics": lambda loaded: loaded.statics(),
    "kinematics": lambda loaded: loaded.kinematics(),
    "linearise": lambda loaded: loaded.linearise(),
    "viewer": lambda loaded: loaded.posed(),
    "mass properties": lambda loaded: loaded.mass_properties(),
}


@pytest.mark.parametrize("analysis", ANALYSES)
def test_every_analysis_names_it_in_the_same_message(analysis):
    loaded = nivel.load(FILE, {"joints.jd.axis": [0, 1, 1e-5]})
    with pytest.raises(ModelError) as caught:
        ANALYSES[analysis](loaded)
    (fault,) = caught.value.faults
    assert fault.path == "joints.jd.axis"
    assert "axes of ja, jb, jc" in fault.message
