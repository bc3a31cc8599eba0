"""Static friction of what came to rest: μ_s holds it from then on, although only μ_d braked it, for every speed of Stribeck's curve.

Everywhere the load lies between kinetic and static friction, so that whatever loses the latter slides away. A stop is known to
a step: from there the speed dies out within τ = 2 h.
"""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import nivel
from nivel.errors import ModelError
from references import stick_slip
from simulating import G, hinge, simulate, slide, solid, wheel
from test_friction import DRAWN, MASS, sled

pytestmark = pytest.mark.covering

FAULT = Path(__file__).parents[2] / "faults" / "d_static_lost.yaml"
METHODS = pytest.mark.parametrize(
    ("integrator", "coordinates"),
    [
        ("rk4", "absolute"),
        ("rk4", "relative"),
        ("abm4", "independent"),
        ("dopri5", "relative"),
        ("generalised-alpha", "absolute"),
        ("generalised-alpha", "independent"),
        ("hht", "relative"),
        ("radau", "relative"),
        ("bdf", "absolute"),
        ("ros2", "relative"),
    ],
)
FEW = pytest.mark.parametrize(
    ("integrator", "coordinates"),
    [("rk4", "relative"), ("dopri5", "relative"), ("generalised-alpha", "absolute"), ("radau", "relative")],
)
KINETIC, STATIC, STEP = 0.3, 0.4, 1e-3
RUB = {"model": "stiction", "coefficient": KINETIC, "static_coefficient": STATIC, "stribeck_speed": 0}
SLOPE = np.radians(20.0)
INCLINE = {"gravity": (G * np.sin(SLOPE), -G * np.cos(SLOPE), 0)}


def stays(history, since):
    """Whether nothing moves from the frame `since` on, to round-off of chosen steps."""
    return np.abs(history[since:] - history[-1]).max() < 1e-8


@METHODS
@pytest.mark.parametrize("stribeck", [0.0, 1e-9, 1e-3])
def test_a_block_thrown_up_an_incline_stays_where_it_came_to_rest(integrator, coordinates, stribeck):
    """tan 20° lies between μ_d and μ_s. It rises v0²/(2 g (sin α + μ_d cos α)) = 0.0817 m."""
    machine = nivel.load(FAULT, {"forces.f.stribeck_speed": stribeck})
    r = machine.simulate(integrator=integrator, coordinates=coordinates, step=STEP)
    rises = 1.0 / (2 * G * (np.sin(SLOPE) + KINETIC * np.cos(SLOPE)))
    place = r.array("s.displacement")
    assert abs(place[-1] + rises) < 3 * G * STEP**2
    assert stays(place, 3)  # from 0.3 s on: it stops at 0.163 s
    assert abs(r.array("force.f.magnitude")[-1]) == pytest.approx(3 * G * np.sin(SLOPE), rel=1e-6)


@pytest.mark.parametrize(("integrator", "tau"), [("ab3", 2.5), ("ab4", 1 / 0.24), ("ab5", 1 / 0.128)])
def test_methods_that_hold_little_take_as_long_to_stop_as_they_need(integrator, tau):
    """exp(-t/τ) with τ of two steps grows with these methods. The way of the stop is off by a multiple of g τ²."""
    r = nivel.load(FAULT).simulate(integrator=integrator, coordinates="relative", step=STEP, verify=False)
    rises = 1.0 / (2 * G * (np.sin(SLOPE) + KINETIC * np.cos(SLOPE)))
    place = r.array("s.displacement")
    assert abs(place[-1] + rises) < G * (tau * STEP) ** 2
    assert np.abs(place[8:] - place[-1]).max() < 1e-10


def test_the_report_of_a_block_that_rests_is_green():
    trust = nivel.load(FAULT).simulate(verify=True).trust
    assert trust.verdict == "green"


@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
def test_the_place_of_the_stop_is_of_order_two(integrator):
    rises = 1.0 / (2 * G * (np.sin(SLOPE) + KINETIC * np.cos(SLOPE)))
    steps, errors = [1e-2, 5e-3, 2e-3], []
    for step in steps:
        r = nivel.load(FAULT, {"forces.f.stribeck_speed": 0}).simulate(integrator=integrator, step=step)
        errors.append(abs(r.array("s.displacement")[-1] + rises))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 1.6, errors


@FEW
def test_a_wheel_under_a_torque_stays_where_it_came_to_rest(integrator, coordinates):
    """J φ̈ = T + μ_d r N from -ω0: it turns ω0² J/(2 (T + μ_d r N)) and is held, as T < μ_s r N."""
    J, radius, load, speed = 0.02, 0.05, 40.0, 10.0
    torque = 0.5 * (KINETIC + STATIC) * radius * load
    sections = {
        "bodies": {"disk": wheel(J, angular_velocity=[0, 0, -speed])},
        "joints": {"pin": hinge("ground", "disk")},
        "forces": {
            "drive": {"type": "torque", "body": "disk", "vector": [0, 0, torque]},
            "rub": {"type": "friction", "coordinate": "pin", "radius": radius, "normal_load": load, **RUB},
        },
    }
    r = simulate(sections, integrator=integrator, coordinates=coordinates, duration=0.5, step=STEP, output_interval=0.1)
    braking = (torque + KINETIC * radius * load) / J
    assert abs(r.array("pin.angle")[-1] + speed**2 / (2 * braking)) < 3 * braking * STEP**2
    assert stays(r.array("pin.angle"), 3)


def stop_of_pendulum(start, weight, rub, most):
    """Angle where a pendulum with the moment `weight` sin φ and the moment `rub` of its bearing rests, let go at `start`: its energy falls
    by rub |Δφ| from turn to turn, until a turn where weight |sin φ| <= `most`."""
    angle = start
    while weight * abs(np.sin(angle)) > most:
        side = np.sign(angle)

        def missing(other, angle=angle, side=side):
            return weight * (np.cos(other) - np.cos(angle)) - rub * side * (angle - other)

        angle = brentq(missing, -side * abs(angle), angle - side * 1e-6)
    return angle


@FEW
def test_a_pendulum_rests_at_the_first_turn_that_static_friction_holds(integrator, coordinates):
    """There kinetic friction would not hold it: it would swing on. Each turn is known to a step of its acceleration."""
    mass, arm, radius, load, start = 2.0, 0.4, 0.1, 20.0, 1.2
    weight, kinetic, static = mass * G * arm, KINETIC * radius * load, 1.5 * radius * load
    expected = stop_of_pendulum(start, weight, kinetic, static)
    assert kinetic < weight * abs(np.sin(expected)) < 0.95 * static
    bar = solid(
        mass,
        (0.02, 1e-3, 0.02),
        position=[arm * np.sin(start), -arm * np.cos(start), 0],
        orientation={"axis": [0, 0, 1], "angle": start},
    )
    pin = {"type": "revolute", "markers": [{"body": "ground"}, {"body": "bar", "position": [0, arm, 0]}]}
    rub = {"type": "friction", "coordinate": "pin", "radius": radius, "normal_load": load, **RUB}
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"bar": bar},
        "joints": {"pin": pin},
        "forces": {"rub": {**rub, "static_coefficient": 1.5}},
    }
    r = simulate(sections, integrator=integrator, coordinates=coordinates, duration=8.0, step=STEP, output_interval=0.1)
    assert abs(r.array("pin.angle")[-1] - expected) < 2e-3
    assert stays(r.array("pin.angle"), -5)


@FEW
def test_stick_slip_on_a_belt(integrator, coordinates):
    """A block on a belt that runs at V, held by a spring: seen from the belt it is drawn by a spring whose end moves at V. It sticks from
    the start and between slips, to μ_s N, and slips with μ_d N at any speed."""
    sharp = stick_slip.Drawn(**{**DRAWN.__dict__, "stribeck": 0.0})
    rub = {**RUB, "coefficient": sharp.kinetic, "static_coefficient": sharp.static, "normal_load": sharp.load}
    sections = {
        "bodies": {
            "belt": solid(5.0, velocity=[sharp.speed, 0, 0]),
            "block": solid(MASS, velocity=[sharp.speed, 0, 0]),
        },
        "joints": {
            "track": slide("ground", "belt"),
            "rail": slide("belt", "block"),
        },
        "drivers": {"drum": {"coordinate": "track.displacement", "value": f"{sharp.speed}*time"}},
        "forces": {
            "rub": {"type": "friction", "coordinate": "rail.displacement", **rub},
            "spring": {
                "type": "spring-damper",
                "markers": [{"body": "ground", "position": [-1.0, 0, 0]}, {"body": "block"}],
                "stiffness": sharp.stiffness,
                "free_length": 1.0,
            },
        },
    }
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 2.5e-4, "output_interval": 0.01}
    r = simulate(sections, duration=1.0, **settings)
    assert sharp.first_slip + 2 * sharp.slip_duration + sharp.stick_duration < 1.0
    expected = sharp.speed * r.time - sharp.closed_form(r.time)
    np.testing.assert_allclose(r.array("block.position.x"), expected, atol=2e-4)
    # what sticks goes with the belt, without creep
    sticks = (r.time > 0.02) & (r.time < sharp.first_slip - 0.01)
    np.testing.assert_allclose(r.array("block.position.x")[sticks], sharp.speed * r.time[sticks], atol=2e-8)


@FEW
def test_two_frictions_hold_together_what_came_to_rest(integrator, coordinates):
    """Neither could alone, and with one kinetic coefficient they could not either."""
    second = {
        "type": "friction",
        "coordinate": "rail.displacement",
        **RUB,
        "normal_load": 0.4 * MASS * G * np.cos(SLOPE),
    }
    own = {**RUB, "normal_load": 0.6 * MASS * G * np.cos(SLOPE)}
    sections = sled(own, -1.0, forces={"second": second}, **INCLINE)
    r = simulate(sections, integrator=integrator, coordinates=coordinates, duration=1.0, step=STEP, output_interval=0.1)
    rises = 1.0 / (2 * G * (np.sin(SLOPE) + KINETIC * np.cos(SLOPE)))
    assert abs(r.array("rail.displacement")[-1] + rises) < 4 * G * STEP**2
    assert stays(r.array("rail.displacement"), 3)


@FEW
def test_a_load_above_static_friction_for_a_moment_sets_it_going(integrator, coordinates):
    """A pulse of 1.2 μ_s N for 50 ms under a load of 1.1 μ_d N: what has broken away slides on at m v̇ = 0.1 μ_d N."""
    load, begin, end = MASS * G, 0.3, 0.35
    high, low = 1.2 * STATIC * load, 1.1 * KINETIC * load
    pull = {"type": "force", "body": "block", "vector": [f"if(time >= {begin} and time < {end}, {high}, {low})", 0, 0]}
    sections = sled(RUB, forces={"pull": pull})
    r = simulate(
        sections, integrator=integrator, coordinates=coordinates, duration=1.0, step=STEP, output_interval=0.01
    )
    pulse = (high - KINETIC * load) / MASS * (end - begin)
    after = r.time > end + 0.01
    expected = pulse + 0.1 * KINETIC * G * (r.time[after] - end)
    np.testing.assert_allclose(r.array("rail.displacement.rate")[after], expected, atol=2 * high / MASS * STEP)
    before = r.time < begin - 0.01
    assert np.abs(r.array("rail.displacement")[before]).max() < 1e-9


@pytest.mark.parametrize(
    "other", [{"model": "coulomb", "transition_speed": 1e-3}, {"model": "lugre", "bristle_stiffness": 1e4}]
)
def test_only_stiction_has_static_friction_without_a_curve(other):
    with pytest.raises(ModelError, match="would never have static friction"):
        simulate(sled({**RUB, **other}), duration=0.1, step=STEP)
