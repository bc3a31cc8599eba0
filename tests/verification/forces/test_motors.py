"""Motors on joint coordinates: given efforts, limits, speed control, in closed form."""

import numpy as np
import pytest

from simulating import hinge, simulate, slide, solid, turning_error, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
J = 0.02


def spindle(**motor):
    return {
        "bodies": {"rotor": wheel(J)},
        "joints": {"hub": hinge("ground", "rotor")},
        "forces": {"motor": {"type": "motor", "coordinate": "hub.angle", **motor}},
    }


@FORMULATIONS
def test_effort_of_time_spins_a_rotor_up(formulation):
    """J ω̇ = 0.3 sin 8t: ω = 0.3 (1 - cos 8t)/(8 J); power τ ω; its work is external."""
    r = simulate(spindle(effort="0.3*sin(8*time)"), duration=1.0, step=1e-3, formulation=formulation)
    t = r.time
    omega, torque = 0.3 * (1 - np.cos(8 * t)) / (8 * J), 0.3 * np.sin(8 * t)
    np.testing.assert_allclose(r.array("hub.angle.rate"), omega, atol=1e-9)
    np.testing.assert_allclose(r.array("force.motor.power"), torque * omega, atol=1e-9)
    np.testing.assert_allclose(r.array("external_work"), 0.5 * J * omega**2, atol=1e-10)


@FORMULATIONS
def test_speed_control_is_a_first_order_lag(formulation):
    """τ = g (ω_ref - ω): ω = ω_ref (1 - exp(-g t/J))."""
    r = simulate(spindle(speed=30.0, gain=0.1), duration=1.0, step=1e-3, formulation=formulation)
    np.testing.assert_allclose(r.array("hub.angle.rate"), 30 * (1 - np.exp(-0.1 / J * r.time)), atol=1e-10)


def test_speed_follows_a_ramp_with_its_lag():
    """ω_ref = a t: ω = a (t - T (1 - exp(-t/T))), T = J/g."""
    r = simulate(spindle(speed="20*time", gain=0.1), duration=1.0, step=1e-3)
    T = J / 0.1
    np.testing.assert_allclose(r.array("hub.angle.rate"), 20 * (r.time - T * (1 - np.exp(-r.time / T))), atol=1e-10)


@FORMULATIONS
def test_limited_motor_first_turns_with_constant_torque(formulation):
    """α = M/J until g (ω_ref - ω) = M at t1, then the lag. The corner costs at most α/T h²/2 of speed."""
    limit, gain, speed = 1.0, 0.1, 30.0
    r = simulate(spindle(speed=speed, gain=gain, limit=limit), duration=1.5, step=5e-4, formulation=formulation)
    corner = speed - limit / gain
    t1 = corner * J / limit
    t = r.time
    expected = np.where(t < t1, limit / J * t, speed - limit / gain * np.exp(-gain / J * (t - t1)))
    np.testing.assert_allclose(r.array("hub.angle.rate"), expected, atol=limit / J * gain / J * 2.5e-7 / 2)


def test_limit_cuts_an_effort_both_ways():
    r = simulate(spindle(effort="0.5*sin(8*time)", limit=0.2), duration=1.0, step=1e-3)
    found = J * r.array("rotor.angular_acceleration.z")
    np.testing.assert_allclose(found, np.clip(0.5 * np.sin(8 * r.time), -0.2, 0.2), atol=1e-12)


@FORMULATIONS
def test_motor_between_two_bodies_has_its_counter_torque(formulation):
    """On a hinge between two free bodies: angular momentum stays zero, the relative angle is τ t²/(2 J_r)."""
    J1, J2, torque = 0.02, 0.05, 0.4
    sections = {
        "bodies": {"stator": wheel(J1), "rotor": wheel(J2)},
        "joints": {"hub": hinge("stator", "rotor")},
        "forces": {"motor": {"type": "motor", "coordinate": "hub", "effort": torque}},
    }
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    spin = r.array("angular_velocity")[:, :, 2]
    # rates of Euler parameters keep it to (ω h/2)⁵ per radian only
    np.testing.assert_allclose(
        J1 * spin[:, 0] + J2 * spin[:, 1], 0, atol=1e-12 if formulation == "newton-euler" else 1e-9
    )
    np.testing.assert_allclose(
        r.array("hub.angle"), 0.5 * torque * (1 / J1 + 1 / J2) * r.time**2, rtol=turning_error(20, 1e-3), atol=1e-10
    )
    assert spin[-1, 1] > 0 > spin[-1, 0]


@FORMULATIONS
def test_linear_motor(formulation):
    """Force 3 N on 2 kg along a slanted rail, the second body goes along the axis."""
    axis = np.array([1, 2, 2]) / 3
    sections = {
        "bodies": {"block": solid(2.0, 0.01)},
        "joints": {"rail": slide("ground", "block", tuple(axis))},
        "forces": {"motor": {"type": "motor", "coordinate": "rail", "effort": "3 N"}},
    }
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    np.testing.assert_allclose(r.array("block.position"), 0.75 * np.outer(r.time**2, axis), atol=1e-12)
