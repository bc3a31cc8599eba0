"""Sensors against motions in closed form."""

import numpy as np
import pytest

from references.oscillator import Oscillator
from simulating import G, hinge, simulate, slide, solid, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
OMEGA, SLIDE = 3.0, 2.0


def turntable(sensors):
    """A table turns with φ = 3 t; a block on its rail moves with s = 0.4 + 0.1 sin 2t. Both driven: all is in closed form."""
    return {
        "bodies": {
            "table": wheel(0.2, position=[1, 0, 0], angular_velocity=[0, 0, OMEGA]),
            "block": solid(0.5, 0.01, position=[1.4, 0, 0]),
        },
        "markers": {
            "hub": {"body": "table"},
            "post": {"body": "ground", "position": [1, -0.3, 0.2], "axis": [0, 1, 0], "x_axis": [0, 0, 1]},
            "pen": {"body": "block", "position": [0, 0.1, 0.2], "orientation": {"axis": [0, 0, 1], "angle": "90 deg"}},
        },
        "joints": {
            "axle": hinge("ground", "table", (1, 0, 0)),
            "rail": slide("table", "block", (1, 0, 0), point=[1.4, 0, 0]),
        },
        "drivers": {
            "turn": {"coordinate": "axle.angle", "value": "3*time"},
            "shift": {"coordinate": "rail.displacement", "value": "0.1*sin(2*time)"},
        },
        "sensors": sensors,
    }


def pen(t):
    """Place, velocity, acceleration of the pen, global: r = hub + A (s, 0.1, 0.2)."""
    s, ds, dds = 0.4 + 0.1 * np.sin(2 * t), 0.2 * np.cos(2 * t), -0.4 * np.sin(2 * t)
    z = np.exp(1j * OMEGA * t)  # the plane as complex numbers
    w = (s + 0.1j) * z
    dw = (ds + 1j * OMEGA * (s + 0.1j)) * z
    ddw = (dds + 2j * OMEGA * ds - OMEGA**2 * (s + 0.1j)) * z
    zero = np.zeros_like(t)
    place = np.stack([1 + w.real, w.imag, zero + 0.2], axis=1)
    return place, np.stack([dw.real, dw.imag, zero], axis=1), np.stack([ddw.real, ddw.imag, zero], axis=1)


def read(sections, names, **settings):
    r = simulate(sections, **({"duration": 2.0, "step": 2e-3} | settings))
    return r.time, [components(r, f"sensor.{name}") for name in names]


def components(r, name):
    """A number over time, or the three components of a vector."""
    if name in r:
        return r.array(name)
    return np.stack([r.array(f"{name}.{axis}") for axis in "xyz"], axis=1)


@FORMULATIONS
def test_motion_of_a_marker(formulation):
    sensors = {
        f"pen_{word}": {"marker": "pen", "quantity": word}
        for word in ("position", "velocity", "acceleration", "angular_velocity", "angular_acceleration")
    }
    t, found = read(turntable(sensors), sensors, formulation=formulation)
    place, velocity, acceleration = pen(t)
    np.testing.assert_allclose(found[0], place, atol=1e-10)
    np.testing.assert_allclose(found[1], velocity, atol=1e-9)
    np.testing.assert_allclose(found[2], acceleration, atol=1e-8)
    np.testing.assert_allclose(found[3], np.tile([0, 0, OMEGA], (len(t), 1)), atol=1e-9)
    np.testing.assert_allclose(found[4], 0, atol=1e-8)


@FORMULATIONS
def test_motion_of_a_marker_seen_from_another_that_turns(formulation):
    """Seen from the hub, in its axes, the pen moves along x only: (s, 0.1, 0.2), (ṡ, 0, 0), (s̈, 0, 0), without turning."""
    sensors = {
        f"seen_{word}": {"marker": "pen", "relative_to": "hub", "quantity": word}
        for word in ("position", "velocity", "acceleration", "angular_velocity", "angular_acceleration")
    }
    t, found = read(turntable(sensors), sensors, formulation=formulation)
    zero = np.zeros_like(t)
    s = 0.4 + 0.1 * np.sin(2 * t)
    np.testing.assert_allclose(found[0], np.stack([s, zero + 0.1, zero + 0.2], axis=1), atol=1e-10)
    np.testing.assert_allclose(found[1], np.stack([0.2 * np.cos(2 * t), zero, zero], axis=1), atol=1e-9)
    np.testing.assert_allclose(found[2], np.stack([-0.4 * np.sin(2 * t), zero, zero], axis=1), atol=1e-8)
    np.testing.assert_allclose(found[3], 0, atol=1e-9)
    np.testing.assert_allclose(found[4], 0, atol=1e-8)


def test_a_cross_that_turns_steadily_has_no_angular_acceleration_seen_from_its_fork():
    """The fork turns about Z at Ω, the cross in it about its x at ω: Ω × ω seen from the ground, nothing seen from the fork."""
    fork, cross = 3.0, 2.0
    sections = {
        "bodies": {
            "fork": wheel(0.2, angular_velocity=[0, 0, fork]),
            "cross": solid(0.5, 0.01, angular_velocity=[cross, 0, fork]),
        },
        "markers": {"on_fork": {"body": "fork"}, "on_cross": {"body": "cross"}},
        "joints": {
            "axle": hinge("ground", "fork"),
            "pin": {"type": "revolute", "bodies": ["fork", "cross"], "point": [0, 0, 0], "axis": [1, 0, 0]},
        },
        "drivers": {
            "turn": {"coordinate": "axle.angle", "value": f"{fork}*time"},
            "tilt": {"coordinate": "pin.angle", "value": f"{cross}*time"},
        },
        "sensors": {
            "seen": {"marker": "on_cross", "relative_to": "on_fork", "quantity": "angular_acceleration"},
            "of_all": {"marker": "on_cross", "quantity": "angular_acceleration"},
        },
    }
    t, (seen, of_all) = read(sections, ("seen", "of_all"))
    np.testing.assert_allclose(seen, 0.0, atol=1e-8)
    expected = fork * cross * np.stack([-np.sin(fork * t), np.cos(fork * t), 0.0 * t], axis=1)
    np.testing.assert_allclose(of_all, expected, atol=1e-8)


def test_motion_of_a_marker_in_the_axes_of_a_fixed_post():
    """The post's x is Z, its z is Y, so its y is X: components (z, x, y), place from the post."""
    sensors = {word: {"marker": "pen", "relative_to": "post", "quantity": word} for word in ("position", "velocity")}
    t, found = read(turntable(sensors), sensors)
    place, velocity, _ = pen(t)
    np.testing.assert_allclose(found[0], (place - [1, -0.3, 0.2])[:, [2, 0, 1]], atol=1e-10)
    np.testing.assert_allclose(found[1], velocity[:, [2, 0, 1]], atol=1e-9)


def test_the_ground_seen_from_a_turning_table_turns_backwards():
    """The post from the hub: place A' (0, -0.3, 0.2), and it circles with -ω."""
    sensors = {
        word: {"marker": "post", "relative_to": "hub", "quantity": word}
        for word in ("position", "velocity", "acceleration", "angular_velocity")
    }
    t, found = read(turntable(sensors), sensors)
    w = -0.3j * np.exp(-1j * OMEGA * t)
    for k, rate in enumerate((1, -1j * OMEGA, -(OMEGA**2))):
        expected = np.stack([(rate * w).real, (rate * w).imag, 0 * t + (0.2 if k == 0 else 0)], axis=1)
        np.testing.assert_allclose(found[k], expected, atol=1e-8)
    np.testing.assert_allclose(found[3], np.tile([0, 0, -OMEGA], (len(t), 1)), atol=1e-9)


@FORMULATIONS
def test_joint_coordinates(formulation):
    sensors = {
        word: {"coordinate": "rail.displacement", "quantity": word} for word in ("value", "rate", "acceleration")
    } | {"angle": {"coordinate": "axle", "quantity": "value"}}
    t, found = read(turntable(sensors), sensors, formulation=formulation)
    np.testing.assert_allclose(found[0], 0.1 * np.sin(2 * t), atol=1e-10)
    np.testing.assert_allclose(found[1], 0.2 * np.cos(2 * t), atol=1e-9)
    np.testing.assert_allclose(found[2], -0.4 * np.sin(2 * t), atol=1e-8)
    np.testing.assert_allclose(found[3], OMEGA * t, atol=1e-9)


def test_distance_and_angle_of_two_markers():
    """|pen - post|, its rate; the pen is turned 90 degrees against the table, so its angle about Z is 3 t + π/2."""
    sensors = {
        "gap": {"distance": ["post", "pen"]},
        "turn": {"angle": [{"body": "ground"}, "pen"]},
    }
    names = ("gap.distance", "gap.rate", "turn.angle", "turn.rate")
    t, found = read(turntable(sensors), names, duration=4.0)
    place, velocity, _ = pen(t)
    apart = place - [1, -0.3, 0.2]
    distance = np.linalg.norm(apart, axis=1)
    np.testing.assert_allclose(found[0], distance, atol=1e-10)
    np.testing.assert_allclose(found[1], np.sum(apart * velocity, axis=1) / distance, atol=1e-9)
    # whole turns are counted: 12 rad and more at the end
    np.testing.assert_allclose(found[2], OMEGA * t + np.pi / 2, atol=1e-9)
    np.testing.assert_allclose(found[3], OMEGA, atol=1e-9)


@FORMULATIONS
def test_outputs_of_forces(formulation):
    """A damped oscillator: tension, length, rate and power of its spring-damper."""
    one = Oscillator(1.7, 400.0, 6.0)
    sections = {
        "bodies": {"block": solid(1.7, 0.01, position=[0.1, 0, 0], velocity=[-0.4, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "markers": [{"body": "ground", "position": [-0.5, 0, 0]}, {"body": "block"}],
                "stiffness": 400.0,
                "damping": 6.0,
                "free_length": 0.5,
            }
        },
        "sensors": {word: {"force": "spring", "quantity": word} for word in ("magnitude", "length", "rate", "power")},
    }
    t, found = read(sections, sections["sensors"], step=1e-3, formulation=formulation)
    x, v = one.motion(t, 0.1, -0.4)
    tension = 400 * x + 6 * v
    np.testing.assert_allclose(found[0], tension, atol=2e-5)
    np.testing.assert_allclose(found[1], 0.5 + x, atol=2e-9)
    np.testing.assert_allclose(found[2], v, atol=5e-8)
    np.testing.assert_allclose(found[3], -tension * v, atol=2e-5)


def test_value_of_an_expression():
    """Kinetic energy of the block by its velocity, and a function of time."""
    sensors = {
        "energy": {"value": "0.25*(block.vx^2 + block.vy^2 + block.vz^2)", "units": "J"},
        "clock": {"value": "sin(5*time)"},
        "way": {"value": "1000*rail.displacement", "units": "mm"},
    }
    r = simulate(turntable(sensors), duration=2.0, step=2e-3)
    t = r.time
    s, ds = 0.4 + 0.1 * np.sin(2 * t), 0.2 * np.cos(2 * t)
    np.testing.assert_allclose(r.array("sensor.energy"), 0.25 * (ds**2 + (OMEGA * s) ** 2), atol=1e-9)
    np.testing.assert_allclose(r.array("sensor.clock"), np.sin(5 * t), atol=1e-14)
    np.testing.assert_allclose(r.array("sensor.way"), 100 * np.sin(2 * t), atol=1e-7)
    assert r.units("sensor.way") == "mm"


def test_accelerometer_on_a_pendulum_reads_its_acceleration():
    """Let go level: at the first moment the end of a rod of length 2 c falls with 2 c m g c/J_O."""
    m, c, J = 2.0, 0.5, 0.06
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"rod": solid(m, (1e-3, J, J), position=[c, 0, 0])},
        "markers": {"end": {"body": "rod", "position": [c, 0, 0]}},
        "joints": {"pin": hinge("ground", "rod")},
        "sensors": {"end": {"marker": "end", "quantity": "acceleration"}},
    }
    r = simulate(sections, duration=1e-3, step=1e-3)
    np.testing.assert_allclose(components(r, "sensor.end")[0], [0, -2 * c * m * G * c / (J + m * c * c), 0], atol=1e-10)
