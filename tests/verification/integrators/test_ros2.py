"""ROS2: order two on all machines, a fixed cost a step, and steps far longer than the vibration of a stiff spring."""

import numpy as np
import pytest

import machines
from nivel.errors import ModelError
from references import four_bar, slider_crank
from running import reference_run, run
from stiff_machines import driven, elastic_pendulum, rigid_pendulum
from test_tolerance import closing_angle

pytestmark = pytest.mark.covering

STEPS = 2e-3 * np.array([1, 1 / 2, 1 / 4])
COORDINATES = pytest.mark.parametrize("coordinates", ["relative", "absolute", "independent"])


def orders(errors):
    return np.log2(np.array(errors[:-1]) / errors[1:])


@COORDINATES
def test_order_two_on_the_slider_crank(coordinates):
    errors = []
    for step in STEPS:
        settings = {"duration": 0.8, "output_interval": 0.08, "coordinates": coordinates}
        result = run(machines.slider_crank(), integrator="ros2", step=step, **settings)
        errors.append(np.abs(result.position - slider_crank.solve(result.time).position).max())
        assert np.abs(result.constraint_violation).max() < 1e-12
    assert np.all(np.abs(orders(errors) - 2) < 0.1)


@COORDINATES
def test_order_two_on_the_four_bar(coordinates):
    errors = []
    for step in STEPS / 2:
        settings = {"duration": 0.8, "output_interval": 0.08, "coordinates": coordinates}
        result = run(machines.four_bar(), integrator="ros2", step=step, **settings)
        expected = four_bar.solve(result.time, crank_angle=closing_angle())
        errors.append(np.abs(result.position - expected.position).max())
    assert np.all(np.abs(orders(errors) - 2) < 0.15)


@COORDINATES
def test_order_two_with_a_motor_and_a_load_that_change_with_time(coordinates):
    """Against an explicit method of order 8."""
    settings = {"duration": 1.0, "output_interval": 0.1, "coordinates": coordinates}
    exact = reference_run(driven(200.0), integrator="dop853", tolerance=1e-11, **settings)
    for name in ("position", "velocity", "external_work"):
        errors = []
        for step in STEPS:
            result = run(driven(200.0), integrator="ros2", step=step, **settings)
            errors.append(np.abs(getattr(result, name) - getattr(exact, name)).max())
        assert np.all(np.abs(orders(errors) - 2) < 0.1), name


def test_every_step_costs_the_same():
    """Two evaluations, one of them at the state reached, and one matrix."""
    timing = run(elastic_pendulum(1e8), integrator="ros2", step=1e-3).finished.timing
    assert timing["factorisations"] == timing["steps"] == 2000
    assert timing["evaluations"] == 2 * timing["steps"] + 1
    assert timing["iterations"] == 0


@pytest.mark.parametrize("damping", [0.0, 1e-3])
def test_a_spring_of_a_hundred_times_the_frequency_of_the_step_is_rigid(damping):
    """h = 1 ms, f = 100/h: in relative coordinates, where the spring acts along one coordinate, its stiffness costs nothing."""
    step = 1e-3
    stiffness = (2 * np.pi * 100 / step) ** 2
    machine = elastic_pendulum(stiffness, damping * stiffness)
    result = run(machine, integrator="ros2", step=step, coordinates="relative")
    angle = rigid_pendulum(result.time)
    assert np.abs(result.position[:, 1, :2] - np.stack([np.cos(angle), np.sin(angle)], axis=1)).max() < 2e-5
    assert np.abs(result.energy_error).max() < 1e-4 * result.kinetic_energy.max()


def test_a_stiff_vibration_dies_out():
    """L-stable: of a start 1 mm away from rest nothing is left after a few steps, at any stiffness."""
    for ratio in (1e2, 1e4):
        machine = elastic_pendulum((ratio / 1e-3) ** 2)
        spring = machine.forces[0].replace(free_value=1e-3)
        result = run(
            machine.replace(forces=(spring,)),
            integrator="ros2",
            step=1e-3,
            duration=0.1,
            output_interval=1e-2,
            coordinates="relative",
        )
        along = np.sqrt(result.position[1:, 1, 0] ** 2 + result.position[1:, 1, 1] ** 2)
        assert np.abs(along - 1.001).max() < 1e-6


@COORDINATES
def test_chunks_change_nothing(coordinates):
    settings = {"integrator": "ros2", "duration": 0.2, "coordinates": coordinates}
    whole = run(machines.slider_crank(), **settings)
    pieces = run(machines.slider_crank(), chunk_steps=3, **settings)
    assert np.array_equal(whole.frames, pieces.frames)


def test_what_does_not_go_with_it_is_refused():
    for settings, words in (
        ({"coordinates": "independent", "formulation": "penalty"}, "there is no violation to feed back"),
        ({"coordinates": "independent", "stabilisation": "baumgarte"}, "there is no violation to feed back"),
        ({"stabilisation": "baumgarte"}, "does not iterate and has order one there"),
    ):
        with pytest.raises(ModelError, match=words):
            run(machines.slider_crank(), integrator="ros2", **settings)
