"""Angles count their turns in relative coordinates as in absolute ones, however rarely frames are written."""

import numpy as np
import pytest

from simulating import simulate, solid

pytestmark = pytest.mark.covering

SPIN = 40.0  # rad/s: six turns in a second
JOINTS = {
    "revolute": ({"type": "revolute", "axis": [1, 2, 2]}, "angle"),
    "cylindrical": ({"type": "cylindrical", "axis": [0, 0, 1]}, "angle"),
    "screw": ({"type": "screw", "axis": [0, 1, 0], "pitch": 0.01}, "angle"),
    "planar": ({"type": "planar", "axis": [0, 0, 1]}, "angle"),
    "universal, first": ({"type": "universal", "axes": [[1, 0, 0], [0, 1, 0]]}, "angle_1"),
    "universal, second": ({"type": "universal", "axes": [[1, 0, 0], [0, 1, 0]]}, "angle_2"),
}


def rotor(joint, angle, bodies, start):
    """A body that spins on a joint; frames at the start and the end only. A start angle makes nivel measure it at every step."""
    mounted = {**joint, "bodies": bodies, "point": [0, 0, 0]}
    axis = np.array(joint["axis"] if "axis" in joint else joint["axes"][angle == "angle_2"], dtype=float)
    axis /= np.linalg.norm(axis)
    if start is None:
        sign = 1.0 if bodies[1] == "a" else -1.0
        spin = {"angular_velocity": (sign * SPIN * axis).tolist()}
        spin["velocity"] = (sign * SPIN * joint.get("pitch", 0.0) / (2 * np.pi) * axis).tolist()
    else:
        mounted |= {"start": {angle: start}, "start_rates": {angle: SPIN}}
        spin = {}
    return {"bodies": {"a": solid(1.0, (0.02, 0.02, 0.02), **spin)}, "joints": {"j": mounted}}


@pytest.mark.parametrize("start", [None, 9.0])
@pytest.mark.parametrize("bodies", [["ground", "a"], ["a", "ground"]], ids=["carried-second", "carried-first"])
@pytest.mark.parametrize("name", JOINTS)
def test_turns_are_counted_between_frames(name, bodies, start):
    joint, angle = JOINTS[name]
    found = {}
    for coordinates in ("absolute", "relative"):
        sections = rotor(joint, angle, bodies, start)
        r = simulate(sections, duration=1.0, step=1e-3, output_interval=1.0, coordinates=coordinates)
        found[coordinates] = r.array(f"j.{angle}")
    assert found["relative"][0] == pytest.approx(start or 0.0, abs=1e-9)
    np.testing.assert_allclose(found["relative"], found["absolute"], atol=1e-6)
    assert found["relative"][-1] - found["relative"][0] == pytest.approx(SPIN, rel=1e-6)


def test_turns_of_an_angle_that_a_sensor_measures_from_a_carrying_marker():
    """The hinge carries the rotor; the sensor's angle is between one of its markers and another of the ground."""
    found = {}
    for coordinates in ("absolute", "relative"):
        sections = {
            "bodies": {"a": solid(1.0, (0.02, 0.02, 0.02), angular_velocity=[0, 0, SPIN])},
            "markers": {
                "still": {"body": "ground", "axis": [0, 0, 1]},
                "aside": {"body": "ground", "position": [1, 0, 0], "axis": [0, 0, 1]},
                "turning": {"body": "a", "axis": [0, 0, 1]},
            },
            "joints": {"j": {"type": "revolute", "markers": ["still", "turning"]}},
            "sensors": {"seen": {"angle": ["aside", "turning"]}},
        }
        r = simulate(sections, duration=1.0, step=1e-3, output_interval=1.0, coordinates=coordinates)
        found[coordinates] = r.array("sensor.seen.angle")
    np.testing.assert_allclose(found["relative"], found["absolute"], atol=1e-6)
    assert found["relative"][-1] == pytest.approx(SPIN, rel=1e-6)
