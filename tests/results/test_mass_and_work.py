"""Mass properties about markers, and work per cycle, in closed form."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from nivel.cli import main

TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def dumbbell():
    """Balls of 2 and 3 kg, the second turned and 1 m along x; a marker at (0, 0, 0.5) on the first whose z axis is global x."""
    bodies = [
        nivel.Body(name="a", mass=2.0, inertia=(0.1, 0.1, 0.1)),
        nivel.Body(
            name="b",
            mass=3.0,
            inertia=(0.2, 0.3, 0.4),
            position=(1, 0, 0),
            orientation={"matrix": tuple(tuple(row) for row in TURN)},
        ),
    ]
    eye = nivel.Marker(name="eye", body="a", position=(0, 0, 0.5), axis=(1, 0, 0), x_axis=(0, 1, 0))
    return nivel.Machine("dumbbell", bodies=bodies, markers=[eye])


def test_mass_properties_follow_the_parallel_axis_theorem_and_the_axes_of_the_marker():
    found = dumbbell().mass_properties("eye")
    # axes of the marker: x = global y, y = global z, z = global x
    axes = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    inertia = np.diag([0.1, 0.1, 0.1]) + TURN @ np.diag([0.2, 0.3, 0.4]) @ TURN.T
    for mass, place in ((2.0, np.array([0, 0, -0.5])), (3.0, np.array([1, 0, -0.5]))):
        inertia += mass * (place @ place * np.eye(3) - np.outer(place, place))
    assert found.mass == 5.0
    np.testing.assert_allclose(found.centre_of_mass, axes.T @ [0.6, 0, -0.5], atol=1e-14)
    np.testing.assert_allclose(found.inertia, axes.T @ inertia @ axes, atol=1e-14)
    np.testing.assert_allclose(np.trace(found.central_inertia), found.principal_moments.sum(), rtol=1e-12)


def test_mass_properties_of_one_body_about_its_own_frame_are_those_that_were_given():
    found = dumbbell().mass_properties("b", bodies="b")
    np.testing.assert_allclose(found.inertia, np.diag([0.2, 0.3, 0.4]), atol=1e-15)
    with pytest.raises(nivel.ModelError, match="there is no body `c`"):
        dumbbell().mass_properties(bodies=["c"])
    with pytest.raises(nivel.ModelError, match="there is no marker or body `ey`"):
        dumbbell().mass_properties("ey")


@pytest.fixture(scope="module")
def turning(tmp_path_factory):
    """A bar on a motor of 5 N m, driven evenly for two and a half turns in 2.5 s."""
    bar = nivel.Body(name="bar", mass=1.0, inertia=(0.1, 0.1, 0.1))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 0, 1))
    motor = nivel.Motor(name="motor", coordinate="hinge", effort="5 + 3*sin(2*pi*time)")
    machine = nivel.Machine("turning", bodies=[bar], joints=[hinge], forces=[motor])
    return machine.kinematics(
        drive="hinge",
        end=f"{5 * np.pi}",
        duration=2.5,
        positions=501,
        out=tmp_path_factory.mktemp("loads") / "turning.nc",
    )


def test_the_work_of_a_cycle_is_the_mean_torque_times_a_turn(turning):
    found = turning.powers(period="1 s")
    work = found["work_per_cycle"].sel(element="force.motor")
    # cubics through 200 frames a period are exact to (ω h)^4/720
    np.testing.assert_allclose(work, 10.0 * np.pi, rtol=1e-9)
    np.testing.assert_allclose(found["mean_power"].sel(element="driver.drive"), -10.0 * np.pi, rtol=1e-9)
    with pytest.raises(nivel.ModelError, match=r"up to the 2\.5 s of the result"):
        turning.powers(period=3.0)
    with pytest.raises(nivel.ModelError, match="a time"):
        turning.powers(period="2 m")


def test_the_command_prints_what_python_returns(turning):
    path = turning.path
    printed = CliRunner().invoke(
        main,
        ["loads", str(path), "--period", "1 s", "--cycles", "force.motor.magnitude", "--json"],
        catch_exceptions=False,
    )
    found = json.loads(printed.output)
    assert found["reactions"]["joint"] == ["hinge"]
    np.testing.assert_allclose(found["power and work"]["work_per_cycle"][1], 10.0 * np.pi, rtol=1e-9)
    # from 5 N m: up to 8, down to 2 and up to 8 twice, back to 5
    assert sum(found["cycles of force.motor.magnitude"]["count"]) == 3.0
    assert "peak force [N]" in CliRunner().invoke(main, ["loads", str(path)]).output
