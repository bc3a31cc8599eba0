"""Peak and RMS reactions, work and rainflow cycles against closed forms and the published example."""

import numpy as np
import pytest

import nivel
from nivel.files import parse_machine
from nivel.results.curve import curve, largest

# ASTM E1049-85, figure 6: peaks and valleys and what they count as
HISTORY = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]
COUNTED = {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


@pytest.fixture(scope="module")
def wheel():
    """A mass on a revolute, a metre from its axis, driven at 2π rad/s for two turns; its place is a cosine."""
    body = nivel.Body(name="m", mass=3.0, inertia=(0.1, 0.1, 0.1), position=(1, 0, 0))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "m"), point=(0, 0, 0), axis=(0, 0, 1))
    return nivel.Machine("wheel", bodies=[body], joints=[hinge], gravity=(0, -9.81, 0)).kinematics(
        drive="hinge", end="4*pi", duration=2, positions=2001
    )


def test_the_reaction_of_a_whirled_mass_is_centripetal(wheel):
    """m ω² r and the weight: largest at the bottom, a mean square of (m ω² r)² + (m g)²."""
    found = wheel.reactions()
    pull, weight = 3.0 * (2.0 * np.pi) ** 2, 3.0 * 9.81
    assert float(found["peak_force"].sel(joint="hinge")) == pytest.approx(pull + weight, rel=1e-9)
    assert float(found["peak_force_time"].sel(joint="hinge")) % 1.0 == pytest.approx(0.75)
    assert float(found["rms_force"].sel(joint="hinge")) == pytest.approx(np.hypot(pull, weight), rel=1e-6)


def test_work_done_and_taken_back_is_that_of_the_weight(wheel):
    """Up two metres twice, and down again."""
    found = wheel.powers().sel(element="driver.drive")
    assert float(found["work_done"]) == pytest.approx(2 * 2.0 * 3.0 * 9.81, rel=1e-5)
    assert float(found["work_taken"]) == pytest.approx(-2 * 2.0 * 3.0 * 9.81, rel=1e-5)
    assert float(found["peak_power"]) == pytest.approx(2.0 * np.pi * 3.0 * 9.81, rel=1e-9)


def test_cycles_of_a_cosine(wheel):
    """Two turns are two cycles of range 2; as halves where the history does not repeat."""
    found = wheel.cycles("m.position.x", repeating=True)
    np.testing.assert_allclose(found["range"], [2.0, 2.0], rtol=1e-12)
    np.testing.assert_array_equal(found["count"], [1.0, 1.0])
    assert float(wheel.cycles("m.position.x")["count"].sum()) == 2.0


def test_damage_of_a_cosine(wheel):
    """Two whole cycles of the amplitude 1 m by N = 100 (0.5 m/S)³."""
    found = wheel.cycles("m.position.x", repeating=True, fatigue={"strength": "500 mm", "knee": 100, "slope": 3})
    assert found.attrs["damage"] == pytest.approx(2 * 2**3 / 100, rel=1e-11)
    assert float(found["damage"].sum()) == found.attrs["damage"]


def test_the_published_example_is_counted():
    times = tuple(float(k) for k in range(len(HISTORY)))
    body = nivel.Body(name="m", mass=1.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    table = nivel.Table(times=times, values=tuple(HISTORY))
    sensor = nivel.Sensor(name="load", value="rail.displacement")
    push = nivel.Motor(name="push", coordinate="rail", effort=table)
    hold = nivel.Driver(name="hold", coordinate="rail", value="0*time")
    machine = nivel.Machine("m", bodies=[body], joints=[rail], forces=[push], drivers=[hold], sensors=[sensor])
    found = machine.kinematics(duration=8, positions=81).cycles("force.push.magnitude")
    counted: dict[float, float] = {}
    for size, count in zip(found["range"].to_numpy(), found["count"].to_numpy(), strict=True):
        counted[round(float(size), 9)] = counted.get(round(float(size), 9), 0.0) + float(count)
    assert counted == COUNTED


def test_vectors_are_refused(wheel):
    with pytest.raises(nivel.ModelError, match=r"take one of them, e\.g\. `hinge\.force\.x`"):
        wheel.cycles("hinge.force")
    with pytest.raises(nivel.ModelError, match="did you mean"):
        wheel.cycles("hing.force.x")


@pytest.mark.parametrize(("turns", "positions", "told"), [(10, 26, True), (2, 17, True), (2, 161, False)])
def test_powers_are_right_between_frames_or_told(turns, positions, told):
    """The power of the wheel is a sine, 2π m g cos φ, with frames 2.5, 8 and 80 a turn: 4 m g of work done a turn."""
    body = nivel.Body(name="m", mass=3.0, inertia=(0.1, 0.1, 0.1), position=(1, 0, 0))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "m"), point=(0, 0, 0), axis=(0, 0, 1))
    machine = nivel.Machine("wheel", bodies=[body], joints=[hinge], gravity=(0, -9.81, 0))
    result = machine.kinematics(drive="hinge", end=2.0 * np.pi * turns, duration=turns, positions=positions)
    found = result.powers()
    headline = str(found.attrs["headline"])
    assert ("peak power of driver.drive between frames" in headline and "work of" in headline) == told
    off = float(found["work_done"][0]) / (turns * 2.0 * 3.0 * 9.81) - 1.0
    assert told or abs(off) < 2e-5


RINGING = """
format: 1
name: ringing
bodies: {a: {mass: 1, inertia: [1, 1, 1]}}
joints: {r: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0.1}}}
forces: {coil: {type: joint-spring-damper, coordinate: r, stiffness: 10000}}
simulation: {duration: 1, step: 1 ms, output_interval: 5 ms}
"""


@pytest.mark.parametrize(("interval", "told"), [("40 ms", True), ("2 ms", False)])
def test_a_run_tells_where_its_frames_hide_peaks(interval, told):
    """16 Hz: 1.6 and 31 frames a period."""
    trust = nivel.Machine.from_record(parse_machine(RINGING)).simulate(output_interval=interval, verify=False).trust
    lines = [item.text for item in trust.items if item.name == "unexamined"]
    assert len(lines) == told
    assert not told or "peaks, work and cycles between frames: that of force.coil" in lines[0]


def test_a_peak_at_an_end_of_the_history_hides_nothing():
    """Straight up to round-off from its begin on: no parabola through the first three frames has its top there."""
    time = np.arange(8.0)
    straight = largest(curve(time, 3.0 - time + np.where(time == 2.0, 1e-15, 0.0)))
    assert straight.value[0] == 3.0
    assert straight.doubt[0] == pytest.approx(0.0, abs=1e-14)
    top = largest(curve(time, np.cos(0.3 * time - 1.1)))
    assert abs(top.value[0] - 1.0) <= top.doubt[0] < 2e-3
    assert top.time[0] == pytest.approx(1.1 / 0.3, abs=1e-3)
