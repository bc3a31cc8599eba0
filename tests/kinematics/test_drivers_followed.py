"""Positions of kinematics are compared with the drivers' own functions of time, evaluated apart from the equations."""

from types import SimpleNamespace

import numpy as np
import pytest

import nivel
from nivel.judge.after.checks import efforts


def turned(value, **more):
    body = nivel.Body(name="arm", mass=1.0, inertia=(1, 1, 1), position=(1, 0, 0))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "arm"), point=(0, 0, 0), axis=(0, 0, 1))
    driver = nivel.Driver(name="turn", coordinate="hinge", value=value, **more)
    return nivel.Machine("arm", bodies=[body], joints=[hinge], drivers=[driver])


def line(result):
    return next(each for each in result.trust.items if each.name == "followed")


@pytest.mark.parametrize(
    "value", ["100*time", "3*sin(20*time) + 1", 0.4, nivel.Table((0.0, 0.5, 1.0), (0.0, 7.0, -9.0), "cubic")]
)
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_driver_is_followed_through_many_turns(value, coordinates):
    assert line(turned(value).kinematics(duration=1, positions=7, coordinates=coordinates)).verdict == "green"


def test_a_driver_from_the_start_is_followed():
    assert line(turned("2*time + 5", from_start=True).kinematics(duration=1, positions=7)).verdict == "green"


@pytest.mark.parametrize(("off", "verdict"), [(1e-11, "green"), (1e-8, "amber"), (1e-3, "red"), (2 * np.pi, "red")])
def test_a_driver_that_is_not_followed_is_told(off, verdict):
    """The positions of another driver, which turns further by `off` in a second; a whole turn more is another position too."""
    made = turned(f"(2 + {off!r})*time").kinematics(duration=1, positions=5)
    subject = SimpleNamespace(
        result=made,
        drivers=turned("2*time").record.drivers,
        joint_coordinates={"hinge.angle": "rad"},
        scales=SimpleNamespace(size=1.0, size_kind="size"),
    )
    found = efforts.look_at_drivers(subject)
    assert found.missed == pytest.approx(off, rel=1e-3, abs=1e-13)
    assert efforts.say_drivers(found).verdict == verdict


@pytest.mark.parametrize(
    ("asked", "way"),
    [
        ({"speed": "3*cos(2*time)"}, lambda t: 1.5 * np.sin(2 * t)),
        ({"acceleration": "6*time", "start_speed": 2.0}, lambda t: 2 * t + t**3),
        ({"speed": nivel.Table((0.0, 0.5), (0.0, 1.0))}, lambda t: np.where(t < 0.5, t**2, t - 0.25)),
    ],
)
@pytest.mark.parametrize(("off", "verdict"), [(0.0, "green"), (1e-3, "red")])
def test_drivers_by_speed_and_acceleration_are_compared_with_their_way(asked, way, off, verdict):
    """The way in closed form, and another one that is longer by `off` in a second; both begin elsewhere than at zero."""
    time = np.linspace(0.0, 1.0, 5)
    place = way(time) + off * time + 0.7
    subject = SimpleNamespace(
        result=SimpleNamespace(time=time, array=lambda _: place[:, None]),
        drivers=turned(None, **asked).record.drivers,
        joint_coordinates={"hinge.angle": "rad"},
        scales=SimpleNamespace(size=1.0, size_kind="size"),
    )
    assert efforts.say_drivers(efforts.look_at_drivers(subject)).verdict == verdict
    assert efforts.not_compared(subject) == []


def test_efforts_compare_their_motion_with_drivers_that_hold():
    """The motion of another driver: where the driver holds, the motion contradicts it; where the actuator takes its place, it is said."""
    made = turned("2.01*time").kinematics(duration=1, positions=5)
    machine = turned("2*time")
    held = machine.inverse(actuators="hinge", motion=made, hold="turn").trust
    assert held.found["followed"]["missed"] == pytest.approx(0.01)
    assert held.verdict == "red"
    freed = machine.inverse(actuators="hinge", motion=made)
    assert freed.trust.verdict == "green"
    assert "off by up to 0.01 rad" in freed.statements()[0]


def test_efforts_compare_the_motion_of_the_drivers_with_their_functions():
    trust = turned("2*time").inverse(positions=5).trust
    assert line(SimpleNamespace(trust=trust)).verdict == "green"
    assert trust.verified_by == (
        "the balance of forces at every time",
        "the functions of its drivers, evaluated apart",
    )
    assert trust.light == "green"
