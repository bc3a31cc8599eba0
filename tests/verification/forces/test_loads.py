"""Point forces and torques against closed forms, and their work against the energy."""

import numpy as np
import pytest

from nivel import Body, Expression, Joint, MachineRecord, PointForce, SimulationSettings, Table, Torque
from running import run


def free_block(*forces, **settings):
    return MachineRecord(
        name="block",
        bodies=(Body(name="block", mass=2.0, inertia=(0.1, 0.2, 0.25), centre_of_mass=(0.3, 0, 0)),),
        forces=forces,
        simulation=SimulationSettings(**({"duration": 1.0, "step": 1e-3, "output_interval": 0.1} | settings)),
    )


def centre(result):
    from scipy.spatial.transform import Rotation

    A = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
    return result.position[:, 0] + A @ np.array([0.3, 0, 0])


def test_force_through_the_centre_of_mass_accelerates_without_turning():
    result = run(free_block(PointForce(name="push", body="block", position=(0.3, 0, 0), vector=(0, 4, 0))))
    np.testing.assert_allclose(centre(result)[:, 1], 0.5 * 2.0 * result.time**2, atol=1e-12)
    np.testing.assert_allclose(result.angular_velocity, 0, atol=1e-14)
    np.testing.assert_allclose(result.external_work, 4 * 0.5 * 2.0 * result.time**2, atol=1e-12)


def test_expression_of_time_is_integrated():
    """F = 6 t N on 2 kg: x = t³/2."""
    push = PointForce(name="push", body="block", position=(0.3, 0, 0), vector=("6*time", 0, 0))
    assert isinstance(push.vector[0], Expression)
    np.testing.assert_allclose(centre(run(free_block(push)))[:, 0] - 0.3, 0.5 * np.linspace(0, 1, 11) ** 3, atol=1e-13)


def test_expression_functions_agree_with_numpy():
    text = "sin(2*pi*time) + 0.5*exp(-time)*max(time, 0.25) - abs(cos(time)) + sqrt(time + 1)**3/(atan2(1 + time, 2)/(1 rad))"
    push = PointForce(name="push", body="block", vector=(text, 0, 0))
    result = run(free_block(push), step=0.01, output_interval=0.01)
    t = result.time
    expected = np.sin(2 * np.pi * t) + 0.5 * np.exp(-t) * np.maximum(t, 0.25) - np.abs(np.cos(t))
    expected += np.sqrt(t + 1) ** 3 / np.arctan2(1 + t, 2)
    np.testing.assert_allclose(getattr(result, "force.push.magnitude"), np.abs(expected), atol=1e-14)


def test_table_is_linear_between_its_points_and_held_outside():
    table = Table(times=(0.2, 0.4, 0.8), values=(1.0, 5.0, -3.0))
    push = PointForce(name="push", body="block", vector=(0, table, 0))
    result = run(free_block(push), step=0.01, output_interval=0.01)
    expected = np.interp(result.time, table.times, table.values)
    np.testing.assert_allclose(getattr(result, "force.push.magnitude"), np.abs(expected), atol=1e-13)


def test_torque_in_body_axes_turns_with_the_body():
    """About a principal body axis of a body whose frame is turned 30 degrees: α = τ/J about that axis."""
    body = Body(name="rotor", mass=1, inertia=(0.1, 0.2, 0.25), orientation={"axis": [1, 2, 3], "angle": "30 deg"})
    machine = MachineRecord(
        name="rotor",
        bodies=(body,),
        forces=(Torque(name="motor", body="rotor", vector=(0, 0, 0.5), axes="body"),),
        simulation=SimulationSettings(duration=1, step=1e-3, output_interval=0.1),
    )
    result = run(machine)
    from scipy.spatial.transform import Rotation

    axis = Rotation.from_quat(result.orientation[0, 0], scalar_first=True).as_matrix()[:, 2]
    np.testing.assert_allclose(result.angular_velocity[:, 0], np.outer(0.5 / 0.25 * result.time, axis), atol=1e-12)


@pytest.mark.parametrize("axes", ["global", "body"])
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_work_of_an_eccentric_force_is_the_energy_it_brings(axes, formulation):
    push = PointForce(name="push", body="block", position=(0.1, -0.2, 0.4), vector=(3, "5*cos(7*time)", -2), axes=axes)
    errors = [
        np.abs(run(free_block(push), step=h, output_interval=0.1, formulation=formulation).energy_error).max()
        for h in (0.02, 0.01, 0.005)
    ]
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 3.5), errors


def test_reaction_of_a_hanging_weight():
    """m g in the pin and no moment; first body ground: the weight pulls the ground down."""
    machine = MachineRecord(
        name="weight",
        gravity=(0, 0, -9.81),
        bodies=(Body(name="weight", mass=3, inertia=(1, 1, 1), position=(0, 0, -1)),),
        joints=(Joint(name="pin", type="fixed", bodies=("ground", "weight"), point=(0.5, 0, 0)),),
    )
    result = run(machine, duration=0.01)
    np.testing.assert_allclose(result.joint_force[-1, 0], (0, 0, -3 * 9.81), atol=1e-11)
    # about the pin, half a metre aside
    np.testing.assert_allclose(result.joint_torque[-1, 0], (0, -0.5 * 3 * 9.81, 0), atol=1e-11)
