"""The light is that of the motion: what is not unique, and what was asked for, turns none; a wrong motion does all the same."""

from types import SimpleNamespace

import numpy as np
import pytest

import nivel
from nivel.judge.after.checks.quantities import THRESHOLD, errors_apart, least_range
from nivel.results.estimate import Estimate
from simulating import machine

GRAVITY = 9.81
DOOR = {
    "gravity": [0, -GRAVITY, 0],
    "bodies": {"door": {"position": [0.5, 0, 0], "mass": 2.0, "inertia": [0.1, 0.1, 0.1]}},
    "joints": {
        name: {"type": "revolute", "bodies": ["ground", "door"], "point": [0, 0, z], "axis": [0, 0, 1]}
        for name, z in (("upper", 0.3), ("lower", -0.3))
    },
}


def rate(angle):
    """Of the door that falls from the horizontal: J ω²/2 = m g l sin, J = 0.1 + 2 · 0.5²."""
    return np.sqrt(2.0 * 2.0 * GRAVITY * 0.5 * np.abs(np.sin(angle)) / 0.6)


@pytest.mark.parametrize(("settings", "right"), [({}, True), ({"integrator": "rk4", "step": 0.1}, False)])
def test_reactions_that_are_not_unique_turn_no_light(settings, right):
    result = machine({**DOOR, "simulation": {"duration": 2.0, **settings}}).simulate(verify=True)
    off = np.abs(np.abs(result.array("upper.angle.rate")) - rate(result.array("upper.angle"))).max()
    (line,) = [item for item in result.trust.items if item.name == "redundancy"]
    assert line.verdict == "amber"
    assert (off < 1e-5) == (result.trust.verdict == "green") == right
    assert "not unique: reactions of upper, lower" in result.trust.headline


def slide(push, **spring):
    friction = {
        "type": "friction",
        "coordinate": "rail",
        "model": "stiction",
        "coefficient": 0.4,
        "static_coefficient": 0.5,
    }
    return {
        "bodies": {"block": {"mass": 10.0, "inertia": [0.1, 0.1, 0.1]}},
        "joints": {
            "rail": {"type": "translational", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [1, 0, 0]}
        },
        "forces": {
            "rub": {**friction, "stribeck_speed": 0.01, "normal_load": 100},
            "scrape": {**friction, "stribeck_speed": 0.01, "normal_load": 60},
            "push": {"type": "force", "body": "block", "position": [0, 0, 0], "vector": [push, 0, 0]},
            **spring,
        },
    }


def test_shares_of_a_load_that_two_frictions_hold_turn_no_light():
    """They hold 60 N of 80 N at most together: nothing moves, and only their sum is known."""
    result = machine({**slide(60), "simulation": {"duration": 0.5}}).simulate(verify=True)
    together = result.array("force.rub.magnitude") + result.array("force.scrape.magnitude")
    assert np.abs(together[1:]) == pytest.approx(60.0, rel=1e-6)
    assert np.abs(result.array("rail.displacement")).max() < 1e-6
    assert result.trust.verdict == "green"
    assert "not unique: force.rub.magnitude and force.scrape.magnitude" in result.trust.headline


def test_a_wrong_motion_beside_such_shares_is_not_green():
    """A bob on a spring, ω = 1000/s, by steps of 1 ms: its amplitude is lost."""
    sections = slide(60)
    sections["bodies"]["bob"] = {"mass": 1.0, "inertia": [0.1, 0.1, 0.1], "position": [0, 1, 0]}
    sections["joints"]["way"] = {
        "type": "translational",
        "bodies": ["ground", "bob"],
        "point": [0, 1, 0],
        "axis": [1, 0, 0],
    }
    sections["forces"]["spring"] = {
        "type": "joint-spring-damper",
        "coordinate": "way",
        "stiffness": 1e6,
        "free_value": 0.01,
    }
    result = machine({**sections, "simulation": {"duration": 0.5, "integrator": "rk4", "step": 1e-3}}).simulate(
        verify=True
    )
    assert result.trust.verdict == "red"


def test_a_driver_that_moves_its_body_to_its_law_is_green_and_said():
    sections = slide(0)
    sections["forces"] = {}
    sections["drivers"] = {"go": {"coordinate": "rail", "value": "0.5 + 0.1*time"}}
    result = machine({**sections, "simulation": {"duration": 0.5}}).simulate(verify=True)
    assert result.array("rail.displacement") == pytest.approx(0.5 + 0.1 * result.time, abs=1e-9)
    (line,) = [item for item in result.trust.items if item.name == "start"]
    assert line.verdict == result.trust.verdict == "green"
    assert "block was moved by 0.5 m" in line.text


@pytest.mark.parametrize("verify", [True, False])
def test_the_error_of_the_balance_is_a_share_of_the_work_to_and_fro(verify):
    """A motor with the force m x₀ ω² cos ω t: its work is m (x₀ ω)²/2 sin² ω t, twice that in each of 2 ω T/2π half periods."""
    sections, omega, cycles = slide(0), 2.0 * np.pi * 2.0, 20
    sections["forces"] = {
        "shake": {"type": "motor", "coordinate": "rail", "effort": f"10*0.1*({omega!r})^2*cos({omega!r}*time)"}
    }
    run = {"duration": cycles * 0.5, "integrator": "rk4", "step": 1e-3, "output_interval": 5e-3}
    result = machine({**sections, "simulation": run}).simulate(verify=verify)
    kinetic = 0.5 * 10.0 * (0.1 * omega) ** 2
    assert result.trust.energy_scale == pytest.approx(kinetic * (4 * cycles if verify else 1), rel=1e-3)
    assert result.trust.verdict == "green"


def test_what_had_no_part_in_a_run_is_said():
    """A block that 60 N do not move, an event that is never met, an input that nothing reads."""
    sections = slide(60)
    sections["inputs"] = {"lever": {"range": [-1, 1]}, "push": {"range": [0, 1]}}
    sections["forces"]["drag"] = {"type": "motor", "coordinate": "rail", "effort": "push.value"}
    sections["events"] = {"away": {"when": "rail.displacement - 0.1", "stop": True}}
    result = machine({**sections, "simulation": {"duration": 0.5}}).simulate(verify=False)
    said = {item.name: item for item in result.trust.items}
    assert "away never came, so the run went on to its duration" in said["missed_events"].text
    assert "nothing moved by more than" in said["still"].text
    assert said["missed_events"].verdict == said["still"].verdict == "green"
    assert [item.row for item in result.trust.items if item.name == "plausible"] == ["inputs.lever"]


def test_what_comes_and_moves_is_not_said_to_be_missed():
    sections = slide(200)
    sections["events"] = {"away": {"when": "rail.displacement - 0.1", "stop": True}}
    result = machine({**sections, "simulation": {"duration": 0.5}}).simulate(verify=False)
    assert not {"missed_events", "still"} & {item.name for item in result.trust.items}
    # 80 N hold at most; sliding, 160 N of weight by 0.4 leave a = (200 - 64) / 10 once in motion
    assert result.events[0].name == "away"
    assert result.time[-1] == pytest.approx(np.sqrt(0.2 / 13.6), rel=5e-2)


class Numbers:
    """A result of one variable."""

    def __init__(self, time, values):
        self.time, self.variables, self._values = (
            np.asarray(time),
            {"x": None},
            np.asarray(values, dtype=float)[:, None],
        )

    def array(self, _):
        return self._values


def test_the_error_of_a_single_frame_is_no_scale_of_it():
    """A number that is 0 but for one frame of the first run, -2: its error is 2, and its range that of the second run."""
    time = np.linspace(0.0, 1.0, 11)
    rests, wrong = np.zeros(11), np.zeros(11)
    wrong[4] = -2.0
    assert least_range(Numbers(time, wrong), Numbers(time, rests), "x") == 0.0
    swings = np.sin(6.0 * time)
    assert least_range(Numbers(time, swings), Numbers(time, swings), "x") == pytest.approx(np.ptp(swings))
    assert (
        THRESHOLD.verdict(2.0 / max(float(least_range(Numbers(time, wrong), Numbers(time, rests), "x")[0]), 1e-3))
        == "red"
    )


def test_a_share_has_an_error_where_it_is_unique():
    """Held together until 0.5 s; after that the runs differ by 3, of which an error is half."""
    time = np.linspace(0.0, 1.0, 21)
    first, second = np.where(time <= 0.5, 100.0, 3.0), np.zeros(21)
    run = SimpleNamespace(
        result=Numbers(time, first), finer=SimpleNamespace(result=Numbers(time, second)), estimate=None
    )
    off = errors_apart(run, Estimate(time, {}, {}, factor=0.5), "x", ((0.0, 0.5),))
    assert 0 < len(off) < 11
    assert off == pytest.approx(1.5)
    assert not len(errors_apart(run, Estimate(time, {}, {}, factor=0.5), "x", ((0.0, 1.0),)))


CAR = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  frame: {{position: [0, 0, 0.47], mass: 2000.0, inertia: [500, 2000, 2000]}}
{wheels}
joints:
{joints}
markers:
  road: {{body: ground, axis: [0, 0, 1]}}
forces:
{contacts}
simulation: {{duration: 1}}
"""


def car(path):
    places = [(1.5, 0.8), (1.5, -0.8), (-1.5, 0.8), (-1.5, -0.8)]
    shape = "shape: {type: cylinder, radius: 0.47, length: 0.2, along: y}, mass: 50.0, inertia: [3, 6, 3]"
    wheels = [f"  w{k}: {{position: [{x}, {y}, 0.47], {shape}}}" for k, (x, y) in enumerate(places)]
    joints = [
        f"  j{k}: {{type: revolute, bodies: [frame, w{k}], point: [{x}, {y}, 0.47], axis: [0, 1, 0]}}"
        for k, (x, y) in enumerate(places)
    ]
    law = "plane: road, stiffness: 2e5, exponent: 1, restitution: 0.3, friction: 0.9"
    contacts = [
        f"  c{k}: {{type: contact, body: w{k}, {law}}}\n  m{k}: {{type: motor, coordinate: j{k}, effort: 2}}"
        for k in range(4)
    ]
    parts = {"wheels": "\n".join(wheels), "joints": "\n".join(joints), "contacts": "\n".join(contacts)}
    path.write_text(CAR.format(**parts), encoding="utf-8")
    return nivel.load(path)


@pytest.mark.parametrize(("settings", "verdict"), [({}, "green"), ({"integrator": "rk4", "step": "20 ms"}, "red")])
def test_lateral_friction_of_wheels_is_compared_with_the_most_that_it_can_be(tmp_path, settings, verdict):
    """It is zero by symmetry, of 0.9 · 2200 kg g/4 at most; steps of 20 ms are too long for the contact, ω² = 4 · 2e5 N/m/2200 kg."""
    result = car(tmp_path / "car.yaml").simulate(verify=True, **settings)
    assert result.trust.verdict == verdict
    if verdict == "green":
        assert (
            max(np.abs(result.array(f"force.c{k}.friction_y")).max() for k in range(4))
            < 1e-2 * 0.9 * 2200 * GRAVITY / 4
        )


def belt(integrator):
    """A parcel is put on a belt at 0.8 m/s: it slides for v/(μ g) = 0.163 s and then sticks."""
    sections = {
        "gravity": [0, 0, -GRAVITY],
        "bodies": {"parcel": {"position": [0, 0, 0.05], "shape": {"type": "box", "size": [0.3, 0.2, 0.1]}, "mass": 6}},
        "forces": {
            "carry": {
                **{
                    "type": "contact",
                    "body": "parcel",
                    "plane": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]},
                },
                **{"stiffness": 1e6, "restitution": 0.2, "friction": 0.5, "surface_velocity": [0.8, 0, 0]},
            }
        },
        "simulation": {"duration": 1.0, **integrator},
    }
    return machine(sections).simulate(verify=True)


@pytest.mark.parametrize(("integrator", "right"), [({}, True), ({"integrator": "rk4", "step": 2e-3}, False)])
def test_slip_of_what_sticks_is_compared_with_the_speed_of_the_machine(integrator, right):
    result = belt(integrator)
    stuck = result.time > 0.3
    assert right == (result.trust.verdict == "green")
    if right:
        assert result.array("parcel.velocity")[stuck, 0] == pytest.approx(0.8, rel=1e-4)
        # v²/(2 μ g) less than the belt, which goes on from the start
        assert result.array("parcel.position")[-1, 0] == pytest.approx(
            0.8 * 1.0 - 0.8**2 / (2 * 0.5 * GRAVITY), rel=1e-2
        )
        assert result.array("force.carry.slip_speed")[stuck].max() < 1e-4 * 0.8
