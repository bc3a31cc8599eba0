"""Examples of vehicles against the stability triangle, on a table and in a curve, and the linear castor."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

import nivel
from nivel.elements.forces.tyre import ACROSS, CARCASS_TIME, SLOW, SOFTER

VEHICLES = Path(__file__).parents[3] / "examples" / "vehicles"


@pytest.mark.parametrize(("hardness", "off"), [("1", 0.06), ("8", 0.015)])
def test_a_forklift_tips_over_the_side_of_its_triangle(hardness, off):
    """On rigid tyres the upper front wheel has no load where the weight passes the side of the triangle: between the front wheel
    on the lower side and the pin, at whose height the steered axle takes its share of the force across."""
    own = np.array([[2600.0, 0.55, 0.6], [300.0, 1.8, 1.4], [1200.0, 2.4, 3.0]])  # kg, x, z of truck, mast, load
    mass = own[:, 0].sum()
    x, z = own[:, 0] @ own[:, 1:] / mass
    run = nivel.load(VEHICLES / "forklift.yaml", {"parameters.hardness": hardness}).simulate(verify=False)
    assert [event.name for event in run.events] == ["tips"]
    tilt = run.array("joint_coordinate")[-1, 0]
    # locked wheels hold some of the yaw, so the share of the axle is not that of its weight alone
    pin = sum(run.array(f"force.{name}.lateral")[-1] for name in ("rl", "rr")) - 120.0 * 9.81 * math.sin(tilt)
    share = pin / (mass * 9.81 * math.sin(tilt))
    tips = math.atan(x / 1.5 * 0.95 / 2 / (z - share * 0.36))
    assert tips * (1.0 - off) < tilt < tips * (1.0 + 1e-3)


@pytest.mark.parametrize(("hardness", "step", "off"), [("1", "1 ms", 0.02), ("8", "0.5 ms", 0.01)])
def test_a_forklift_in_a_curve_tips_over_the_side_of_its_triangle(hardness, step, off):
    """About the point where it does not slide, at c ahead of the pin and ρ beside it, masses have a_x = v̇ + ω² (c - x), a_y = ω² ρ.
    Moments about the front contacts, f R ahead of the axle, give the load on the pin, those about the outer one ω²; at the pin the
    steered wheels take their share of the force across, and push along by tan δ = L/ρ of it. It leans on the outer wheel."""
    base, beside, pin, circle = 1.5, 0.95 / 2, 0.36, 6.0
    m, x, z = np.array([[2600.0, 0.55, 0.6], [300.0, 1.8, 1.4], [1200.0, 2.4, 3.0], [80.0, base, 0.34]]).T
    machine = nivel.load(VEHICLES / "forklift-in-a-curve.yaml", {"parameters.hardness": hardness})
    run = machine.simulate(step=step, verify=False)
    assert [event.name for event in run.events] == ["tips"]
    place, velocity, turning = (run.array(name)[-1] for name in ("position", "velocity", "angular_velocity"))
    ahead = (place[2] - place[0])[:2] / math.hypot(*(place[2] - place[0])[:2])
    forward, sideways, turning = (
        velocity[0, :2] @ ahead,
        velocity[0, 1] * ahead[0] - velocity[0, 0] * ahead[1],
        turning[0, 2],
    )
    radius, centre, front = forward / turning, -sideways / turning, base + 0.02 * 0.34
    across = radius * m @ (base - x) / base  # by ω², as the following
    bears = (m @ ((centre - x) * z) - across * base / circle * pin) / front
    share = (run.time[-1] - 3.0) / 15.0
    faster = 2.0 / 15.0 * 6.0 * share * (1.0 - share)
    rests = 9.81 * m.sum() - m @ (9.81 * (front - x) + faster * z) / front
    lean = rests / (float(hardness) * 2e6) / 0.95  # all of it on the outer wheel
    leans = lean * (9.81 * m @ z - pin * (9.81 * m.sum() - rests))
    tips = radius * (rests * beside - leans) / (radius * m @ z - across * pin + bears * beside)
    assert turning * forward == pytest.approx(tips, rel=off)


@pytest.mark.parametrize("speed", [3.0, 12.0])
def test_a_castor_swings_as_its_linear_model(speed):
    """Angle about the pin, its rate, stretches of the carcass across and of its turn; the tyre is linear in a swing this small."""
    load, radius, width, stiffness = 102.0 * 9.81, 0.2, 0.08, 100e3
    slope, twice = ACROSS["slope"]
    q = load / 1000.0
    length = 2.0 * math.sqrt(radius * load / stiffness)
    arm, lever = 0.1 + 0.178 * length * speed / math.hypot(speed, SLOW), (length + width) / 6.0
    c = SOFTER["across"] * stiffness
    d, a = CARCASS_TIME * c, speed / (load * (2 * slope - twice / 2 + (twice / 2 - slope) * q))
    inertia = 0.12 + 3 * 0.05**2 + 0.06 + 5 * 0.1**2

    def rate(state):
        angle, turning, across, turned = state
        u = -(-speed * angle - arm * turning + a * c * across) / (1.0 + a * d)
        w = -(lever * turning + a * c * turned) / (1.0 + a * d)
        moment = -arm * (c * across + d * u) + lever * (c * turned + d * w) - turning
        return [turning, moment / inertia, u, w]

    matrix = np.array([rate(row) for row in np.eye(4)]).T
    given = {"parameters.slow": f"{speed} m/s", "parameters.fast": f"{speed} m/s", "parameters.push": "5e-4 N*m"}
    machine = nivel.load(VEHICLES / "castor.yaml", given)
    run = machine.simulate(verify=False, duration=1, integrator="radau", tolerance=1e-10)
    pin = 2
    at = [int(np.argmin(np.abs(run.time - t))) for t in (0.6, 0.75, 0.95)]
    states = np.column_stack(
        [run.array(name)[:, pin] for name in ("joint_coordinate", "joint_rate")]
        + [run.array(f"state.tyre.{name}") for name in ("across", "bore")]
    )
    for k in at[1:]:
        expected = expm(matrix * (run.time[k] - run.time[at[0]])) @ states[at[0]]
        assert np.all(np.abs(states[k] - expected) < 3e-3 * np.abs(states[at[0] :]).max(axis=0))
    growth = np.linalg.eigvals(matrix).real.max()
    assert growth < -1.0 if speed < 6.0 else growth > 1.0


@pytest.mark.parametrize("name", ["car", "truck-and-trailer", "castor"])
def test_a_quarter_of_the_step_stays_within_the_error_that_the_run_states(name):
    """The error is stated by another run than this one, whose steps are half as long."""
    machine = nivel.load(VEHICLES / f"{name}.yaml")
    run = machine.simulate(duration=2, step="1 ms", verify=True)
    finer = machine.simulate(duration=2, step="0.25 ms", verify=False)
    assert run.trust.verdict == "green"
    away = np.linalg.norm(run.array("position") - finer.array("position"), axis=2).max()
    assert 0.0 < away <= run.trust.accuracy_estimate
    assert run.trust.accuracy_estimate < 1e-5 * run.trust.size
