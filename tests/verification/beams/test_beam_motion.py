"""Beams in motion: published and converged references, joints eliminated or kept with multipliers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from beams import flying, general, hinged
from references import hinged_beams, spin_up
from simulating import simulate

pytestmark = pytest.mark.covering

HINGED = np.array(hinged_beams.TIP)
SPIN_UP = np.array(spin_up.TIP)


def tip(result, body, start):
    return result.dataset["position"].sel(body=body).values - start


@pytest.mark.parametrize(("elements", "until", "within"), [(40, 3.0, 0.05), (8, 1.0, 0.2)])
def test_hinged_beams_with_the_joint_eliminated(elements, until, within):
    result = simulate(hinged(elements, coordinates="relative", duration=until, output_interval=0.1))
    assert result.dataset.attrs["outcome"] == "done"
    reference = HINGED[: len(result.dataset["time"])]
    assert_allclose(result.dataset["time"].values, reference[:, 0], atol=1e-12)
    apart = np.linalg.norm(tip(result, "outer.end", [10, 0, 0]) - reference[:, 1:4], axis=1)
    assert apart.max() < within


def test_hinged_beams_with_multipliers():
    result = simulate(hinged(40, coordinates="absolute", integrator="generalised-alpha", output_interval=0.1))
    apart = np.linalg.norm(tip(result, "outer.end", [10, 0, 0]) - HINGED[:, 1:4], axis=1)
    assert apart.max() < 0.05


def test_accelerations_do_not_depend_on_who_closes_the_joints():
    first = [
        simulate(hinged(8, coordinates=each, duration=0.01)).dataset.isel(time=0) for each in ("absolute", "relative")
    ]
    for name in ("acceleration", "angular_acceleration", "joint_force", "joint_torque"):
        one, other = (each[name].values for each in first)
        assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.abs(one).max(), err_msg=name)


def test_trajectories_differ_by_what_falls_as_the_step_squared():
    """The root swings smoothly: a corner would hide the order."""
    apart = []
    for step in (4e-3, 2e-3, 1e-3):
        ends = []
        for coordinates in ("absolute", "relative"):
            sections = hinged(
                8, coordinates=coordinates, duration=0.4, step=step, output_interval=0.4, integrator="generalised-alpha"
            )
            sections["drivers"]["turn"]["value"] = "0.8*(1 - cos(6*time))"
            sections["drivers"]["lift"]["value"] = "0.5*(1 - cos(5*time))"
            ends.append(simulate(sections).dataset["position"].values[-1])
        apart.append(np.abs(ends[0] - ends[1]).max())
    assert apart[2] < 1e-3
    assert apart[1] < apart[0] / 3
    assert apart[2] < apart[1] / 3


def swung_up(elements, order, step):
    t = np.linspace(0.0, 20.0, 2001)
    law = 6 / 15 * (t**2 / 2 + (15 / (2 * np.pi)) ** 2 * (np.cos(2 * np.pi * t / 15) - 1))
    angle = np.where(t < 15, law, 6 * (t - 7.5))
    result = simulate(
        {
            "name": "spin-up",
            "beams": {
                "arm": {
                    "from": [0, 0, 0],
                    "to": [10, 0, 0],
                    "section": general(2.8e7, 1e7, 1.4e4, 1.4e4, 1.2, (6e-4, 6e-4, 6e-4)),
                    "elements": elements,
                    "order": order,
                }
            },
            "joints": {
                "root": {"type": "revolute", "bodies": ["ground", "arm.start"], "point": [0, 0, 0], "axis": [0, 0, 1]}
            },
            "drivers": {
                "turn": {"coordinate": "root.angle", "value": {"times": t, "values": angle, "interpolation": "cubic"}}
            },
            "simulation": {"duration": 20.0, "step": step, "integrator": "generalised-alpha", "output_interval": 0.5},
        }
    )
    now = result.dataset["time"].values[1:]
    psi = np.interp(now, t, angle)
    x, y, _ = result.dataset["position"].sel(body="arm.end").values[1:].T
    c, s = np.cos(psi), np.sin(psi)
    return np.stack([c * x + s * y - 10.0, c * y - s * x], axis=1)


def test_spin_up_converges_to_its_reference():
    errors = [np.abs(swung_up(10, 2, step) - SPIN_UP[:, 1:]).max(axis=0) for step in (0.01, 0.005)]
    assert errors[0][1] < 1e-3  # u2, 0.57 m at most
    assert_allclose(errors[0] / errors[1], 4.0, rtol=0.15)  # order 2 in time


def test_spin_up_ends_with_the_stretch_of_the_centrifugal_force():
    steady = swung_up(10, 1, 0.01)[SPIN_UP[:, 0] > 15.0, 0].mean()
    # ω² ρA L³/(3 EA), and 1e-4 of it for what the stretched beam is longer
    assert_allclose(steady, 36 * 1.2 * 1000 / (3 * 2.8e7), rtol=2e-3)


def test_rotation_vectors_with_their_charts_and_euler_parameters_give_the_same_motion():
    """A flying beam that turns 1.7 times around, so that every node changes its chart."""
    base = {"duration": 1.0, "step": 1e-4, "integrator": "rk4", "coordinates": "absolute", "output_interval": 0.1}
    ways = ({}, {"formulation": "lagrange", "rotations": "rotation-vector"})
    one, other = (simulate({**flying(1, "lumped"), "simulation": {**base, **way}}).dataset for way in ways)
    turned = np.linalg.norm(one["angular_velocity"].values[:, 0], axis=1).mean()
    assert turned > 3.2 * np.pi  # [rad] in 1 s
    assert_allclose(other["position"].values, one["position"].values, atol=1e-7)
