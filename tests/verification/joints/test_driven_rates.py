"""Drivers by speed and by acceleration, from expressions and from tables, against the motions in closed form."""

import numpy as np
import pytest

from nivel.errors import ModelError
from nivel.machine.laws.varying_value import Expression
from nivel.system.laws.integrated import integrated
from simulating import hinge, simulate, slide, wheel

pytestmark = pytest.mark.covering

METHODS = pytest.mark.parametrize(
    "method",
    [
        {"integrator": "rk4", "step": "1 ms"},
        {"integrator": "dopri5", "coordinates": "relative"},
        {"integrator": "generalised-alpha", "step": "1 ms"},
    ],
    ids=["explicit", "chosen", "implicit"],
)
J = 0.3
T = np.linspace(0.0, 1.0, 21)


def driven(method, **driver):
    """A wheel that is driven: (angle, rate, effort)."""
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"a": wheel(J)},
        "joints": {"p": hinge("ground", "a")},
        "drivers": {"d": {"coordinate": "p.angle", **driver}},
    }
    result = simulate(sections, **method, duration=1, output_interval="50 ms")
    return result.array("joint_coordinate")[:, 0], result.array("joint_rate")[:, 0], result.array("driver.d.effort")


@METHODS
def test_speed_as_an_expression(method):
    angle, rate, effort = driven(method, speed="3*sin(4*time) + 2 rad/s")
    assert angle == pytest.approx(2 * T + 0.75 * (1 - np.cos(4 * T)), abs=1e-8)
    assert rate == pytest.approx(3 * np.sin(4 * T) + 2, abs=1e-8)
    assert effort == pytest.approx(J * 12 * np.cos(4 * T), abs=1e-6)


@METHODS
def test_speed_as_measured_with_corners(method):
    # trapezium: the acceleration jumps, the speed does not; the way is exact
    times, speeds = [0, 0.25, 0.75, 0.8], [0, 5, 5, 1]
    angle, rate, effort = driven(method, speed={"times": times, "values": speeds})
    t = np.linspace(0, 1, 100001)
    way = np.concatenate(
        [[0], np.cumsum(0.5 * (np.interp(t[1:], times, speeds) + np.interp(t[:-1], times, speeds)) * 1e-5)]
    )
    assert angle == pytest.approx(np.interp(T, t, way), abs=1e-8)
    assert rate == pytest.approx(np.interp(T, times, speeds), abs=1e-8)
    assert effort[2] == pytest.approx(J * 20, rel=1e-6)
    assert effort[10] == pytest.approx(0.0, abs=1e-6)


@METHODS
def test_acceleration_that_jumps_with_a_start_speed(method):
    angle, rate, _ = driven(method, acceleration="if(time < 0.5, 4 rad/s^2, -8 rad/s^2)", start_speed="60 deg/s")
    v = np.pi / 3
    late = np.maximum(T - 0.5, 0)
    assert rate == pytest.approx(v + 4 * T - 12 * late, abs=1e-8)
    assert angle == pytest.approx(v * T + 2 * T**2 - 6 * late**2, abs=1e-8)


def test_a_fast_acceleration_is_evaluated_as_arrays(monkeypatch):
    """a sin ω t at ω = 500 rad/s: a/ω (t - sin(ω t)/ω). Number by number, its 50 000 pieces took ten seconds."""

    def one_by_one(*_):
        raise AssertionError

    monkeypatch.setattr("nivel.system.laws.integrated.evaluate", one_by_one)
    angle, _, _ = driven({"integrator": "rk4", "step": "10 ms"}, acceleration="100*sin(500*time)")
    assert angle == pytest.approx(0.2 * (T - np.sin(500 * T) / 500), abs=1e-9)


def test_cubic_table_of_accelerations_is_integrated_exactly():
    # natural spline through a parabola with zero curvature at its ends: its own integral, by many small steps
    from scipy.interpolate import CubicSpline

    times, values = [0, 0.2, 0.5, 1.0], [0, 3, -2, 1]
    angle, rate, _ = driven(
        {"integrator": "dopri5"}, acceleration={"times": times, "values": values, "interpolation": "cubic"}
    )
    speed = CubicSpline(times, values, bc_type="natural").antiderivative()
    assert rate == pytest.approx(speed(T), abs=1e-9)
    assert angle == pytest.approx(speed.antiderivative()(T), abs=1e-9)


def test_speed_that_jumps_is_refused_where_it_stands():
    with pytest.raises(ModelError, match=r"drivers.d.speed: the speed jumps at t = 0\.3.* give it a ramp"):
        driven({}, speed="if(time < 0.3, 1 rad/s, 2 rad/s)")


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"speed": "1/time"}, r"drivers\.d\.speed: there is no value at t = 0 s: division by zero"),
        ({"acceleration": "sqrt(time - 0.5)"}, r"drivers\.d\.acceleration: there is no value at t = 0 s: outside"),
    ],
)
def test_what_has_no_value_is_refused_where_it_stands(keys, said):
    with pytest.raises(ModelError, match=said):
        driven({}, **keys)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"speed": 1, "value": 2}, "`speed` stands in place of `value`"),
        ({"speed": "p.angle"}, "only known while the machine moves"),
        ({"speed": 1, "from_start": True}, "the coordinate begins where it is placed"),
        ({"speed": 1, "start_speed": 2}, "belongs to an `acceleration`"),
    ],
)
def test_what_does_not_go_together_is_said(keys, said):
    with pytest.raises(ModelError, match=said):
        driven({}, **keys)


def test_a_periodic_table_drives_without_end():
    # a cam of one turn a second: the spline through its points, with two continuous derivatives at the seam
    from scipy.interpolate import CubicSpline

    times = np.linspace(0, 0.3, 7)
    lift = [0, 1, 3, 4, 2, 1, 0]
    angle, rate, effort = driven(
        {"integrator": "dopri5"}, value={"times": list(times), "values": lift, "interpolation": "periodic"}
    )
    curve = CubicSpline(times, lift, bc_type="periodic")
    assert angle == pytest.approx(curve(T), abs=1e-8)
    assert rate == pytest.approx(curve(T, 1), abs=1e-6)
    assert effort == pytest.approx(J * curve(T, 2), abs=1e-5 * J * np.abs(curve(times, 2)).max())


def test_a_cam_follows_a_periodic_curve_over_turns():
    from scipy.interpolate import CubicSpline

    angles = np.linspace(0, 2 * np.pi, 13)
    lift = 0.02 * (1 - np.cos(angles))
    lift[-1] = lift[0]
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"a": wheel(J, angular_velocity=[0, 0, 20.0]), "f": {"mass": 2, "inertia": [1, 1, 1]}},
        "joints": {"p": hinge("ground", "a"), "l": slide("ground", "f", (0, 1, 0))},
        "couplings": {"cam": {"type": "function", "coordinate": "l",
                              "value": {"of": "p.angle", "points": list(angles), "values": list(lift), "interpolation": "periodic"}}},
    }  # fmt: skip
    result = simulate(sections, integrator="dopri5", duration=1)
    angle, height = result.array("joint_coordinate").T
    assert angle[-1] > 6 * np.pi
    assert height == pytest.approx(CubicSpline(angles, lift, bc_type="periodic")(angle), abs=1e-9)
    assert np.abs(result.array("energy_error")).max() < 1e-5 * result.array("kinetic_energy")[0]


def test_a_periodic_table_that_does_not_close_is_refused():
    with pytest.raises(ModelError, match="ends with the value with which it begins; got 0 and 3"):
        driven({}, value={"times": [0, 1, 2, 3], "values": [0, 1, 2, 3], "interpolation": "periodic"})


@pytest.mark.parametrize(
    ("speed", "way"),
    [
        # a trapezium with rounded flanks: 0.03 s up, 0.04 s at 1 rad/s, 0.03 s down; a triangle; ∫ exp(-(t/b)²) dt = b √π
        ("step(time, 50.03, 0, 50.06, 1) - step(time, 50.10, 0, 50.13, 1)", 0.07),
        ("lookup(time, linear, 0, 0, 50.03, 0, 50.05, 1, 50.07, 0)", 0.02),
        ("exp(-((time - 50.03)/0.02)^2)", 0.02 * np.sqrt(np.pi)),
    ],
    ids=["steps", "curve", "bell"],
)
def test_a_short_pulse_of_speed_in_a_long_run_counts(speed, way):
    """Of nine places in every sixteenth of the run none lay in a pulse of 0.1 s in 100 s."""
    points, pieces = integrated(Expression(speed), 1, 100.0)
    at = np.searchsorted(points, 60.0) - 1
    assert np.polyval(pieces[at][::-1], 60.0 - points[at]) == pytest.approx(way, abs=1e-11)


def test_at_a_corner_the_effort_is_that_beyond_it():
    # J α + no load, α = 2, from 0.5 s on -6 rad/s²; between the pieces it was anything between both
    _, _, effort = driven({"integrator": "rk4", "step": "1 ms"}, acceleration="if(time < 0.5, 2, -6)")
    assert effort == pytest.approx(J * np.where(T < 0.5, 2.0, -6.0), abs=1e-9)


def test_a_speed_that_is_too_fast_for_the_run_is_refused():
    with pytest.raises(ModelError, match="varies too fast to be integrated"):
        integrated(Expression("sin(1e6*time)"), 1, 1000.0)


def test_a_speed_that_jumps_between_two_levels_is_refused_where_it_jumps():
    with pytest.raises(ModelError, match=r"jumps at t = 50\.03 s"):
        integrated(Expression("if(time > 50.03 and time < 50.04, 1, 0)"), 1, 100.0)
