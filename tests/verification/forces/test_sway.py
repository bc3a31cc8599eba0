"""Sway of a trailer against the linear model of a vehicle and its trailer in the plane, with relaxing tyres."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

import nivel
from nivel.elements.forces.tyre import ACROSS, CARCASS_TIME, SOFTER
from simulating import machine
from test_tyres import TYRE, C, P, R, W, curve

SIDE, YAW, FRONT, REAR = 1600.0, 2000.0, 1.2, -1.5  # of the vehicle: kg, kg m², m
HITCH, BEHIND, AXLE = 2.4, 3.6, 4.0  # [m] behind the centre of the vehicle; centre and axle of the trailer behind that
MASS, INERTIA = 1300.0, 4500.0  # of the trailer
NUDGE = 1e-3  # [rad/s] of the trailer at the start
EXAMPLE = Path(__file__).parents[3] / "examples" / "vehicles" / "truck-and-trailer.yaml"
SAG = P / C
ROLLING = R - (1 - 0.375) * SAG


def linear(speed):
    """A of v_y, r, θ̇, θ, and of each of three wheels the stretches across and of the bore (see `test_tyres`); θ : of the trailer.

    M u̇ = Jᵀ F - U r Σ m Jᵀ for u = (v_y, r, θ̇), as all velocities across are J u, less U θ on the trailer.
    """
    length = 2.0 * math.sqrt(R * SAG)
    c = SOFTER["across"] * C
    d, fluid = CARCASS_TIME * c, speed / curve(ACROSS)[0]
    trail, lever = 0.178 * length, (length + W) / 6.0
    body, trailer = np.array([1.0, 0.0, 0.0]), np.array([1.0, -HITCH - BEHIND, -BEHIND])
    spins = np.array([[0.0, 1.0, 0.0], [0.0, 1.0, 1.0]])
    M = SIDE * np.outer(body, body) + MASS * np.outer(trailer, trailer)
    M += YAW * np.outer(spins[0], spins[0]) + INERTIA * np.outer(spins[1], spins[1])
    A, u = np.zeros((10, 10)), np.zeros((3, 10))
    u[:, 1] = -speed * (SIDE * body + MASS * trailer)
    wheels = [(np.array([1.0, x - trail, 0.0]), spins[0], 0.0) for x in (FRONT, REAR)]
    wheels.append((np.array([1.0, -HITCH - AXLE - trail, -AXLE - trail]), spins[1], -speed))
    for k, (across, spin, turned) in enumerate(wheels):
        for row, J, by_angle in ((4 + 2 * k, across, turned), (5 + 2 * k, lever * spin, 0.0)):
            A[row, :3], A[row, 3], A[row, row] = -J, -by_angle, -fluid * c
            A[row] /= 1 + fluid * d
            force = d * A[row]
            force[row] += c
            u += np.outer(J, force)
    A[:3], A[3, 2] = np.linalg.solve(M, u), 1.0
    return A


def growth(speed):
    """[1/s] of the least damped motion, but those that are none: place across, and heading."""
    return float(np.linalg.eigvals(linear(speed)).real.max())


def towed(speed, duration):
    """Bodies that a planar joint holds on the road, each wheel under P."""
    road = [0, 0, 0.5]
    bodies = {
        "body": {"mass": SIDE, "inertia": [1500, 1500, YAW], "position": road, "velocity": [speed, 0, 0]},
        "trailer": {"mass": MASS, "inertia": [3000, 3000, INERTIA], "position": [-HITCH - BEHIND, 0, 0.5],
                    "velocity": [speed, -BEHIND * NUDGE, 0], "angular_velocity": [0, 0, NUDGE]},
    }  # fmt: skip
    joints = {"plane": {"type": "planar", "bodies": ["ground", "body"], "point": road, "axis": [0, 0, 1]},
              "hitch": {"type": "revolute", "bodies": ["body", "trailer"], "point": [-HITCH, 0, 0.5], "axis": [0, 0, 1]}}  # fmt: skip
    markers, forces = {"road": {"body": "ground", "axis": [0, 0, 1]}}, {}
    for name, x, on in (("front", FRONT, "body"), ("rear", REAR, "body"), ("last", -HITCH - AXLE, "trailer")):
        at = [x, 0.0, R - SAG]
        across = -AXLE * NUDGE if on == "trailer" else 0.0
        spin = NUDGE if on == "trailer" else 0.0
        bodies[name] = {"mass": 1e-3, "inertia": [1.0] * 3, "position": at, "velocity": [speed, across, 0],
                        "angular_velocity": [0, speed / ROLLING, spin]}  # fmt: skip
        joints[name] = {"type": "revolute", "bodies": [on, name], "point": at, "axis": [0, 1, 0]}
        markers[f"{name}_axle"] = {"body": name, "axis": [0, 1, 0]}
        forces[name] = {**TYRE, "wheel": f"{name}_axle", "rolling_resistance": 0.0}
    simulation = {"step": 1e-3, "duration": duration, "output_interval": 0.01}
    return machine({"bodies": bodies, "joints": joints, "markers": markers, "forces": forces, "simulation": simulation})


def test_a_nudged_trailer_swings_as_the_linear_model():
    run = towed(20.0, 4.0).simulate(verify=False)
    start = np.zeros(10)
    start[2] = NUDGE
    A = linear(20.0)
    expected = np.array([expm(A * t) @ start for t in run.time])
    found = run.array("hitch.angle")
    np.testing.assert_allclose(found, expected[:, 3], atol=3e-3 * np.abs(expected[:, 3]).max())
    assert np.abs(expected[:, 3]).max() > 1e-4


def swelling(run, name="hitch.angle", after=0.0):
    """[1/s] of the envelope of an angle, by its greatest and least values but the first from a time on."""
    angle, time = run.array(name), run.time
    k = 1 + np.flatnonzero(np.diff(np.sign(np.diff(angle))) != 0.0)
    k = k[time[k] > after][1:]
    return float(np.polyfit(time[k], np.log(np.abs(angle[k])), 1)[0])


def test_the_sway_speed_is_where_the_linear_model_has_no_damping():
    critical = brentq(growth, 20.0, 40.0)
    slower, faster = (
        swelling(towed(speed, 12.0).simulate(verify=False)) for speed in (0.93 * critical, 1.07 * critical)
    )
    assert slower < 0.0 < faster
    for speed, found in ((0.93 * critical, slower), (1.07 * critical, faster)):
        assert found == pytest.approx(growth(speed), abs=2e-3)
    # by a straight line between the two
    assert 0.93 * critical - slower * 0.14 * critical / (faster - slower) == pytest.approx(critical, rel=0.01)


def test_the_trailer_of_the_example_swings_longer_when_it_is_faster():
    truck = nivel.load(EXAMPLE)
    rates = []
    for speed in (20.0, 25.0):
        run = truck.with_values({"parameters.speed": f"{speed} m/s"}).simulate(verify=False)
        assert np.ptp(run.array("sensor.articulation.angle")) > math.radians(1.0)
        assert run.array("truck.position")[-1, 1] == pytest.approx(3.5, abs=0.1)
        rates.append(swelling(run, "sensor.articulation.angle", 120.0 / speed))
    assert rates[0] < 1.5 * rates[1] < 0.0
