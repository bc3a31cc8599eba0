"""Driven coordinates and markers: exact kinematics, efforts by inverse dynamics in closed form, energy."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from references.one_dof import GROUND, Joint, Linkage, motion_from, reactions, scalar_equation, unit_wrenches
from simulating import G, hinge, simulate, slide, solid, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])

# --- planar slider-crank: crank R about Z, rod L, slider on X; centres half way ---
R, L = 0.12, 0.4
MASS = np.array([0.8, 1.1, 0.6])
INERTIA = np.array([[1e-3, 2e-3, 2.5e-3], [2e-3, 1.6e-2, 1.7e-2], [1e-3, 1e-3, 1e-3]])


def crank_pose(angle):
    """φ of the crank from X: slider at x = R cos φ + √(L² - R² sin² φ), rod at -asin(R sin φ/L)."""
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(s), np.ones_like(s)
    sine = -R * s / L
    cosine = np.sqrt(1 - sine**2)
    x = R * c + L * cosine

    def turned(c, s):
        return np.moveaxis(np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]]), -1, 0)

    tip = np.array([R * c, R * s, zero])
    end = np.array([x, zero, zero])
    position = np.array([tip / 2, (tip + end) / 2, end])
    return np.moveaxis(position, -1, 0), np.stack([turned(c, s), turned(cosine, sine), turned(one, zero)], axis=1)


def crank_rates(angle):
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(s), np.ones_like(s)
    sine = -R * s / L
    cosine = np.sqrt(1 - sine**2)
    turn = -R * c / (L * cosine)  # d asin(sine)/dφ
    x1 = -R * s - L * sine * turn
    tip = np.array([-R * s, R * c, zero])
    end = np.array([x1, zero, zero])
    position = np.array([tip / 2, (tip + end) / 2, end])
    angular = np.array([[zero, zero, one], [zero, zero, turn], [zero, zero, zero]])
    return np.moveaxis(position, -1, 0), np.moveaxis(angular, -1, 0)


CRANK = Linkage(
    names=("crank", "rod", "slider"),
    mass=MASS,
    inertia=INERTIA,
    gravity=np.array([0, -G, 0]),
    drive=0.0,
    driven=0,
    drive_axis=np.array([0, 0, 1.0]),
    pose=crank_pose,
    rates=crank_rates,
    joints=(
        Joint("shaft", 0, GROUND, lambda q: np.zeros((len(q), 3)), lambda q: unit_wrenches(len(q), "xyz", "xy")),
        Joint("pin", 0, 1, lambda q: 2 * crank_pose(q)[0][:, 0], lambda q: unit_wrenches(len(q), "xyz", "")),
        Joint("wrist", 1, 2, lambda q: crank_pose(q)[0][:, 2], lambda q: unit_wrenches(len(q), "xy", "xy")),
        Joint("guide", 2, GROUND, lambda q: crank_pose(q)[0][:, 2], lambda q: unit_wrenches(len(q), "yz", "xyz")),
    ),
)


def slider_crank(driver, start):
    position, _ = crank_pose(np.array([start]))
    x = position[0, 2, 0]
    lean = -np.arcsin(R * np.sin(start) / L)
    tip = [R * np.cos(start), R * np.sin(start), 0]
    about_z = [{"axis": [0, 0, 1], "angle": float(angle)} for angle in (start, lean)]
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "crank": solid(MASS[0], INERTIA[0], position=position[0, 0], orientation=about_z[0]),
            "rod": solid(MASS[1], INERTIA[1], position=position[0, 1], orientation=about_z[1]),
            "slider": solid(MASS[2], INERTIA[2], position=position[0, 2]),
        },
        "joints": {
            "shaft": {
                "type": "revolute",
                "markers": [{"body": "ground"}, {"body": "crank", "position": [-R / 2, 0, 0]}],
            },
            "pin": {"type": "spherical", "bodies": ["crank", "rod"], "point": tip},
            "wrist": {"type": "cylindrical", "bodies": ["rod", "slider"], "point": [x, 0, 0], "axis": [0, 0, 1]},
            "guide": {"type": "translational", "bodies": ["slider", "ground"], "point": [x, 0, 0], "axis": [1, 0, 0]},
        },
        "drivers": {"motor": driver},
    }


@FORMULATIONS
def test_crank_driven_through_its_dead_centres(formulation):
    """φ = 0.3 + 6 t + 0.5 sin 4t. Positions exact; effort = m(φ) φ̈ + ½ m' φ̇² - Q, of one_dof; reactions; energy."""
    driver = {"coordinate": "shaft.angle", "value": "0.3 + 6*time + 0.5*sin(4*time)"}
    r = simulate(slider_crank(driver, 0.3), duration=2.0, step=1e-3, output_interval=0.02, formulation=formulation)
    t = r.time
    angle, rate = 0.3 + 6 * t + 0.5 * np.sin(4 * t), 6 + 2 * np.cos(4 * t)
    second = -8 * np.sin(4 * t)
    position, _ = crank_pose(angle)
    np.testing.assert_allclose(r.array("position"), position, atol=1e-10)
    np.testing.assert_allclose(r.array("shaft.angle"), angle, atol=1e-10)
    np.testing.assert_allclose(r.array("shaft.angle.rate"), rate, atol=1e-9)
    reduced, derivative, force = scalar_equation(CRANK, angle)
    effort = reduced * second + 0.5 * derivative * rate**2 - force
    np.testing.assert_allclose(r.array("driver.motor.effort"), effort, atol=1e-8 * np.abs(effort).max())
    np.testing.assert_allclose(r.array("driver.motor.power"), effort * rate, atol=1e-7 * np.abs(effort).max())
    # the work is integrated: RK4 with h = 1 ms against at most 12 rad/s
    assert np.abs(r.array("energy_error")).max() < 1e-8 * r.array("kinetic_energy").max()


@FORMULATIONS
def test_reactions_of_the_driven_crank(formulation):
    driver = {"coordinate": "shaft", "value": "0.3 + 6*time"}
    r = simulate(slider_crank(driver, 0.3), duration=1.0, step=1e-3, output_interval=0.02, formulation=formulation)
    angle = 0.3 + 6 * r.time
    # motion_from takes φ̈ from the free equation, so the drive that makes φ̈ = 0 is put in per frame
    _, derivative, force = scalar_equation(CRANK, angle)
    for k in range(0, len(angle), 7):
        effort = float(0.5 * derivative[k] * 36 - force[k])
        driven = Linkage(**{**CRANK.__dict__, "drive": effort})
        motion = motion_from(driven, r.time[k : k + 1], angle[k : k + 1], np.array([6.0]))
        expected = reactions(driven, motion)
        for name, sign in (("shaft", -1.0), ("pin", 1.0), ("wrist", 1.0), ("guide", 1.0)):
            scale = 1e-8 * max(np.abs(expected[name][0]).max(), 10.0)
            np.testing.assert_allclose(r.array(f"{name}.force")[k], sign * expected[name][0][0], atol=scale)


PENDULUM = {"mass": 2.0, "arm": 0.5, "inertia": 0.06}  # about the centre of mass


def pendulum(driver, angle):
    m, c, J = PENDULUM.values()
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "rod": solid(
                m,
                (0.06, 1e-3, J),
                position=[c * np.sin(angle), -c * np.cos(angle), 0],
                orientation={"axis": [0, 0, 1], "angle": angle},
            )
        },
        "markers": {
            "down": {"body": "ground"},
            "tip": {"body": "rod", "position": [0, -c, 0]},
            "top": {"body": "rod", "position": [0, c, 0]},
        },
        "joints": {"pin": {"type": "revolute", "markers": ["down", "top"]}},
        "drivers": {"motor": driver},
    }


ANGLE_DRIVERS = {
    "coordinate": {"coordinate": "pin.angle", "value": "0.4*cos(5*time)"},
    "about": {"marker": "top", "about": "z", "relative_to": "down", "value": "0.4*cos(5*time)"},
    "about-ground": {"marker": "tip", "about": "z", "value": "0.4*cos(5*time)"},
}


@FORMULATIONS
@pytest.mark.parametrize("name", ANGLE_DRIVERS)
def test_driven_pendulum_needs_the_torque_of_its_motion(name, formulation):
    """τ = (J + m c²) φ̈ + m g c sin φ; power τ φ̇."""
    m, c, J = PENDULUM.values()
    r = simulate(pendulum(ANGLE_DRIVERS[name], 0.4), duration=2.0, step=1e-3, formulation=formulation)
    angle, rate, second = 0.4 * np.cos(5 * r.time), -2 * np.sin(5 * r.time), -10 * np.cos(5 * r.time)
    np.testing.assert_allclose(r.array("pin.angle"), angle, atol=1e-11)
    torque = (J + m * c**2) * second + m * G * c * np.sin(angle)
    np.testing.assert_allclose(r.array("driver.motor.effort"), torque, atol=1e-8)
    np.testing.assert_allclose(r.array("driver.motor.power"), torque * rate, atol=1e-8)
    assert np.abs(r.array("energy_error")).max() < 1e-9


@FORMULATIONS
def test_tip_driven_along_x(formulation):
    """x = 2 c sin φ = 0.3 + 0.2 sin 3t: the force F of the driver works on x, F 2 c cos φ = (J + m c²) φ̈ + m g c sin φ."""
    m, c, J = PENDULUM.values()
    driver = {"marker": "tip", "along": "x", "value": "0.3 + 0.2*sin(3*time)"}
    r = simulate(pendulum(driver, np.arcsin(0.3)), duration=2.0, step=1e-3, formulation=formulation)
    t = r.time
    x, v, a = 0.3 + 0.2 * np.sin(3 * t), 0.6 * np.cos(3 * t), -1.8 * np.sin(3 * t)
    angle = np.arcsin(x)  # 2 c = 1 m
    rate = v / np.cos(angle)
    second = (a + np.sin(angle) * rate**2) / np.cos(angle)
    np.testing.assert_allclose(r.array("pin.angle"), angle, atol=1e-10)
    np.testing.assert_allclose(r.array("pin.angle.rate"), rate, atol=1e-9)
    force = ((J + m * c**2) * second + m * G * c * np.sin(angle)) / np.cos(angle)
    np.testing.assert_allclose(r.array("driver.motor.effort"), force, atol=1e-7)
    np.testing.assert_allclose(r.array("driver.motor.power"), force * v, atol=1e-7)


@FORMULATIONS
def test_marker_driven_along_an_axis_that_turns(formulation):
    """A block on a turning table, held at s(t) along the table's x: force m (s̈ - ω² s), the table's own torque 2 m ω s ṡ."""
    m, omega = 0.5, 3.0
    sections = {
        "bodies": {
            "table": wheel(0.2, angular_velocity=[0, 0, omega]),
            "block": solid(m, 0.01, position=[0.2, 0, 0]),
        },
        "markers": {"centre": {"body": "table"}, "middle": {"body": "block"}},
        "joints": {"hub": hinge("ground", "table"), "rail": slide("table", "block")},
        "drivers": {
            "turn": {"coordinate": "hub.angle", "value": "3*time"},
            "push": {
                "marker": "middle",
                "along": "x",
                "relative_to": "centre",
                "value": "0.2 + 0.05*sin(4*time)",
            },
        },
    }
    r = simulate(sections, duration=2.0, step=1e-3, formulation=formulation)
    t = r.time
    s, ds, dds = 0.2 + 0.05 * np.sin(4 * t), 0.2 * np.cos(4 * t), -0.8 * np.sin(4 * t)
    np.testing.assert_allclose(r.array("rail.displacement"), s - 0.2, atol=1e-10)
    np.testing.assert_allclose(r.array("driver.push.effort"), m * (dds - omega**2 * s), atol=1e-8)
    np.testing.assert_allclose(r.array("driver.turn.effort"), 2 * m * omega * s * ds, atol=1e-8)
    assert np.abs(r.array("energy_error")).max() < 1e-9


def cam(value):
    """A follower of 0.3 kg on a vertical rail, pressed down by a spring and a damper on its coordinate."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {"follower": solid(0.3, 0.01)},
        "joints": {"rail": slide("ground", "follower", (0, 1, 0))},
        "drivers": {"cam": {"coordinate": "rail.displacement", "value": value}},
        "forces": {
            "spring": {
                "type": "joint-spring-damper",
                "coordinate": "rail.displacement",
                "stiffness": 800.0,
                "damping": 6.0,
                "free_value": -0.02,
            }
        },
    }


TIMES = [0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0]
LIFTS = [0, 0.002, 0.009, 0.012, 0.012, 0.006, 0.001, 0.0]


@FORMULATIONS
def test_cam_of_a_table_follows_the_natural_spline(formulation):
    """Effort m (s̈ + g) + k (s + 0.02) + c ṡ with the spline of SciPy."""
    table = {"times": TIMES, "values": LIFTS, "interpolation": "cubic"}
    r = simulate(cam(table), duration=1.0, step=1e-3, formulation=formulation)
    spline = CubicSpline(TIMES, LIFTS, bc_type="natural")
    s, ds, dds = spline(r.time), spline(r.time, 1), spline(r.time, 2)
    assert ds[-1] < -1e-3  # the table ends while the follower still moves: the last frame belongs to the table
    np.testing.assert_allclose(r.array("rail.displacement"), s, atol=1e-12)
    np.testing.assert_allclose(r.array("rail.displacement.rate"), ds, atol=1e-11)
    np.testing.assert_allclose(r.array("follower.acceleration.y"), dds, atol=1e-9)
    np.testing.assert_allclose(r.array("driver.cam.effort"), 0.3 * (dds + G) + 800 * (s + 0.02) + 6 * ds, atol=1e-8)


LAW = '''
import math

def lift(t, height, omega):
    """Harmonic: value, rate, acceleration."""
    a = omega*t
    return height*(1 - math.cos(a)), height*omega*math.sin(a), height*omega*omega*math.cos(a)
'''


@FORMULATIONS
def test_cam_in_python_is_the_cam_of_the_expression(formulation):
    law = {"source": LAW, "function": "lift", "arguments": ["time", 0.01, 12.0]}
    a = simulate(cam(law), duration=1.0, step=1e-3, formulation=formulation)
    b = simulate(cam("0.01*(1 - cos(12*time))"), duration=1.0, step=1e-3, formulation=formulation)
    np.testing.assert_allclose(a.array("rail.displacement"), b.array("rail.displacement"), atol=1e-12)
    np.testing.assert_allclose(a.array("driver.cam.effort"), b.array("driver.cam.effort"), atol=1e-9)
    np.testing.assert_allclose(b.array("rail.displacement"), 0.01 * (1 - np.cos(12 * b.time)), atol=1e-12)


EXPRESSIONS = {
    "polynomial": ("0.02 + 0.1*time^2 - 0.05*time^3", lambda t: 0.02 + 0.1 * t**2 - 0.05 * t**3),
    "quotient": ("0.05*time/(1 + time^2)", lambda t: 0.05 * t / (1 + t**2)),
    "exponential": ("0.01*exp(-3*time)*sin(20*time)", lambda t: 0.01 * np.exp(-3 * t) * np.sin(20 * t)),
    "roots": ("0.02*sqrt(1 + time) + 0.01*log(2 + time)", lambda t: 0.02 * np.sqrt(1 + t) + 0.01 * np.log(2 + t)),
    "arcs": (
        "(0.02*atan(4*time - 2) + 0.01*acos(time/4) + 0.01*atan2(time, 2))/(1 rad)",
        lambda t: 0.02 * np.arctan(4 * t - 2) + 0.01 * np.arccos(t / 4) + 0.01 * np.arctan2(t, 2),
    ),
    "power": ("0.02*(1 + time)^(1 + time)", lambda t: 0.02 * (1 + t) ** (1 + t)),
    "tangent": ("0.01*tan(time) + 0.01*asin(time/3)/(1 rad)", lambda t: 0.01 * np.tan(t) + 0.01 * np.arcsin(t / 3)),
}


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_driver_knows_the_derivatives_of_its_expression(name):
    """Rate and acceleration by central differences of fourth order, h = 2 ms."""
    text, value = EXPRESSIONS[name]
    r = simulate(cam(text), duration=1.0, step=5e-3)
    t, h = r.time, 2e-3
    f = {k: value(t + k * h) for k in (-2, -1, 0, 1, 2)}
    rate = (f[-2] - 8 * f[-1] + 8 * f[1] - f[2]) / (12 * h)
    second = (-f[-2] + 16 * f[-1] - 30 * f[0] + 16 * f[1] - f[2]) / (12 * h**2)
    np.testing.assert_allclose(r.array("rail.displacement"), f[0], atol=1e-12)
    np.testing.assert_allclose(r.array("rail.displacement.rate"), rate, atol=1e-6)
    np.testing.assert_allclose(r.array("follower.acceleration.y"), second, atol=1e-4)


def test_constant_driver_locks_a_joint():
    """A pendulum held at 30 degrees: effort m g c sin 30°."""
    m, c, _ = PENDULUM.values()
    driver = {"coordinate": "pin.angle", "value": "30 deg"}
    r = simulate(pendulum(driver, np.radians(30)), duration=0.5, step=1e-3)
    np.testing.assert_allclose(r.array("pin.angle"), np.radians(30), atol=1e-12)
    np.testing.assert_allclose(r.array("driver.motor.effort"), m * G * c * 0.5, atol=1e-9)


def test_assembly_brings_the_machine_to_the_start_of_the_drive():
    """Placed at 10 degrees, driven from 30 degrees at 2 rad/s."""
    sections = pendulum({"coordinate": "pin.angle", "value": "30 deg + 2 rad/s * time"}, np.radians(10))
    sections["assembly"] = {"largest_gap": 1.0}
    r = simulate(sections, duration=0.1, step=1e-3)
    np.testing.assert_allclose(r.array("pin.angle"), np.radians(30) + 2 * r.time, atol=1e-11)
    np.testing.assert_allclose(r.array("pin.angle.rate"), 2.0, atol=1e-10)
