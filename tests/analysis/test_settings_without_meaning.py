"""Settings of a run that mean nothing to analyses without integration, and are no reason to refuse one."""

import numpy as np
import pytest

import nivel


def spring(**settings):
    body = nivel.Body(name="m", mass=2.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    spring = nivel.JointSpringDamper(name="s", coordinate="rail", stiffness=18.0)
    motor = nivel.Motor(name="push", coordinate="rail", effort="0 N")
    driver = nivel.Driver(name="way", coordinate="rail", value="0.1*sin(2*time)")
    machine = nivel.Machine("m", bodies=[body], joints=[rail], forces=[spring, motor], drivers=[driver])
    return machine.with_settings(settings)


SETTINGS = {
    "an interval below the step that nobody gave": {"integrator": "radau", "output_interval": 3e-4},
    "a run below that step": {"integrator": "bdf", "duration": 9.5e-4, "output_interval": 1.9e-4},
    "a step of its own": {"integrator": "rk4", "step": 0.01, "output_interval": 0.02},
}


@pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)
def test_a_valid_output_interval_is_none_of_their_business(settings):
    """18 N/m on 2 kg and a motion x = 0.1 sin 2 t: the effort is 18 x + 2 ẍ."""
    machine = spring(**settings)
    assert machine.linearise(inputs=[]).steady
    efforts = machine.inverse(actuators="push", positions=11)
    time = np.linspace(0.0, settings.get("duration", 1.0), 11)
    wanted = (18.0 - 2.0 * 4.0) * 0.1 * np.sin(2.0 * time)
    np.testing.assert_allclose(efforts.effort[:, 0], wanted, atol=1e-12)
    assert machine.mechanics().names == ()
