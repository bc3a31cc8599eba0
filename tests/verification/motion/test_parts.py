"""Each part of a machine is judged by its own energy, and that of the whole by what it was inside the loop, not in frames alone."""

import numpy as np
import pytest

import simulating
from simulating import G, hinge, slide, solid, wheel

ARM = 0.05  # of the pendulum [m]


def beside_a_flywheel(sections, **simulation):
    """A machine beside a flywheel of half a megajoule; the result, and its line of parts or None."""
    machine = {
        "name": "beside",
        "gravity": [0, -G, 0],
        **sections,
        "bodies": {"wheel": wheel(100.0, position=[1, 0, 0], angular_velocity=[0, 0, 100.0]), **sections["bodies"]},
        "joints": {"axle": hinge("ground", "wheel", (1, 0, 0)), **sections["joints"]},
        "simulation": {"coordinates": "relative", "duration": 4.0, "output_interval": 0.1, **simulation},
    }
    result = simulating.simulate(machine)
    return result, next((item for item in result.trust.items if item.name == "parts"), None)


PENDULUM = {"bodies": {"bob": solid(0.1, 1e-6, position=[ARM, 0, 0])}, "joints": {"pin": hinge("ground", "bob")}}


@pytest.mark.parametrize(("integrator", "step", "wrong"), [("generalised-alpha", 1e-2, True), ("rk4", 1e-3, False)])
def test_a_flywheel_hides_no_pendulum_without_a_second_run(integrator, step, wrong):
    """From the horizontal ½ J φ̇² = m g l sin(-φ): the energy that the line tells, from angles alone."""
    result, line = beside_a_flywheel(PENDULUM, integrator=integrator, step=step)
    assert next(item for item in result.trust.items if item.name == "energy").verdict == "green"
    assert (line is not None) == wrong
    if line is not None:
        angle, rate = result.array("joint_coordinate")[:, 1], result.array("joint_rate")[:, 1]
        inertia, weight = 0.1 * ARM**2 + 1e-6, 0.1 * G * ARM
        energy = 0.5 * inertia * rate**2 + weight * np.sin(angle)
        largest = max((0.5 * inertia * rate**2).max(), np.abs(weight * np.sin(angle)).max())
        assert line.row == "bob"
        assert line.fraction == pytest.approx(np.abs(energy).max() / largest, rel=1e-3)


@pytest.mark.parametrize("force", ["0.02*sin(3*time)", "if(time > 1.03, 0.02, 0)", "0.02*sin(62.8*time)"])
def test_parts_under_loads_are_not_judged_by_frames(force):
    """A cart on a damped spring, 0.7 Hz, under loads that jump or vibrate between frames of 0.1 s."""
    cart = {
        "bodies": {"cart": solid(0.1, 1e-5)},
        "joints": {"rail": slide("ground", "cart")},
        "forces": {
            "spring": {
                "type": "joint-spring-damper",
                "coordinate": "rail.displacement",
                "stiffness": 2.0,
                "damping": 0.01,
            },
            "push": {"type": "force", "body": "cart", "vector": [force, 0, 0]},
        },
    }
    _, line = beside_a_flywheel(cart, integrator="rk4", step=1e-3)
    assert line is None


def test_what_a_joint_joins_is_one_part():
    """The links of a double pendulum pass energy to and fro; alone each would seem to lose it."""
    links = {
        "bodies": {
            "upper": solid(0.1, 1e-5, position=[ARM, 0, 0]),
            "lower": solid(0.1, 1e-5, position=[2 * ARM, 0, 0]),
        },
        "joints": {"pin": hinge("ground", "upper"), "elbow": hinge("upper", "lower", (ARM, 0, 0))},
    }
    assert beside_a_flywheel(links, integrator="rk4", step=5e-4, duration=1.0)[1] is None


def test_energies_that_all_frames_meet_at_rest_are_seen_between_them():
    """A cart under F cos ωt from rest: speed F/(m ω) sin ωt, zero at every whole period, where the frames are."""
    omega = 100.0 * np.pi
    machine = {
        "name": "shaken",
        "bodies": {"cart": solid(1.0)},
        "joints": {"rail": slide("ground", "cart")},
        "forces": {"push": {"type": "force", "body": "cart", "vector": [f"cos({omega!r}*time)", 0, 0]}},
        "simulation": {"duration": 0.4, "step": 2e-4, "integrator": "rk4", "output_interval": 0.02},
    }
    result = simulating.simulate(machine)
    assert np.abs(result.array("velocity")).max() < 1e-9
    assert result.trust.energy_scale == pytest.approx(0.5 / omega**2, rel=0.02)
    assert next(item for item in result.trust.items if item.name == "energy").verdict == "green"


def test_spheres_that_touch_are_one_part():
    """Three spheres in a row: the last one is at rest until it is hit, and its energy is that of the blow."""
    ball = {"mass": 1.0, "shape": {"type": "sphere", "radius": 0.1}}
    balls = {f"ball{k}": {**ball, "position": [0.21 * k, 0, 0]} for k in range(3)}
    balls["ball0"]["velocity"] = [1.0, 0, 0]
    blow = {"type": "contacts", "between": "all", "stiffness": 1e5, "exponent": 1, "restitution": 0.5}
    machine = {"name": "row", "gravity": [0, 0, 0], "bodies": balls, "forces": {"blow": blow}}
    result = simulating.simulate(machine, duration=0.1, integrator="rk4", step=1e-4)
    assert result.array("velocity")[-1, 2, 0] == pytest.approx(0.75**2, abs=1e-3)  # (1 + e)/2 of the speed in each blow
    assert not [item for item in result.trust.items if item.name == "parts"]
