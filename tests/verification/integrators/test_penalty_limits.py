"""Where penalty methods reach their limits: they say so, and hold where nothing moves."""

import numpy as np
import pytest

from nivel.errors import ModelError, SolveError
from simulating import G, hinge, simulate, solid

HEAVY = {
    "gravity": [0, -G, 0],
    "bodies": {
        name: solid(mass, 0.1 * mass, position=[0.5 + k, 0, 0])
        for k, (name, mass) in enumerate(zip("abcd", (8, 1e6, 8, 8e6), strict=True))
    },
    "joints": {
        "h1": hinge("ground", "a"),
        "h2": hinge("a", "b", (1, 0, 0)),
        "h3": hinge("b", "c", (2, 0, 0)),
        "h4": hinge("c", "d", (3, 0, 0)),
    },
}
DOOR = {
    "gravity": [0, 0, -G],
    "bodies": {
        "door": solid(25.0, (8.0, 1.4, 9.4), position=[0.4, 0, 1], velocity=[0, 0.6, 0], angular_velocity=[0, 0, 1.5])
    },
    "joints": {"low": hinge("ground", "door", (0, 0, 0.2)), "high": hinge("ground", "door", (0, 0, 1.8))},
    "forces": {"wind": {"type": "force", "body": "door", "vector": [0, 20, 0]}},
}


def test_augmented_lagrangian_that_does_not_converge_stops():
    """Masses of 8 kg hold some of 1e6 kg: 30 iterations with the default factor leave the multipliers wrong by per cents."""
    given = {"duration": 0.2, "step": 1e-3, "coordinates": "absolute", "formulation": "augmented-lagrangian"}
    with pytest.raises(SolveError, match="finds no multipliers within 30 iterations"):
        simulate(HEAVY, **given)
    expected = simulate(HEAVY, **{**given, "formulation": "newton-euler"})
    found = simulate(HEAVY, **given, penalty={"factor": 1e8})
    np.testing.assert_allclose(found.array("acceleration"), expected.array("acceleration"), atol=1e-7)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("formulation", ["penalty", "augmented-lagrangian"])
def test_door_on_two_hinges(formulation, coordinates):
    """In relative coordinates no row of the second hinge can be moved at all; its multipliers are round-off and stay out of the way."""
    given = {"duration": 0.5, "step": 1e-3, "coordinates": coordinates}
    expected = simulate(DOOR, **given, formulation="newton-euler").array("position")[-1]
    found = simulate(DOOR, **given, formulation=formulation).array("position")[-1]
    np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_machine_at_rest_has_settled_multipliers(coordinates):
    still = {
        **DOOR,
        "gravity": [0, 0, 0],
        "bodies": {"door": solid(25.0, (8.0, 1.4, 9.4), position=[0.4, 0, 1])},
        "forces": {},
    }
    given = {"duration": 0.1, "step": 1e-3, "coordinates": coordinates, "formulation": "augmented-lagrangian"}
    assert np.abs(simulate(still, **given).array("velocity")).max() < 1e-12


def test_penalties_that_hold_nothing_are_refused():
    with pytest.raises(ModelError, match="α = 1e-300 does not hold"):
        simulate(
            DOOR, duration=0.1, step=1e-3, coordinates="absolute", formulation="penalty", penalty={"alpha": 1e-300}
        )
    with pytest.raises(ModelError, match="a number of at least 1 was expected"):
        simulate(DOOR, duration=0.1, step=1e-3, formulation="penalty", penalty={"factor": 1e-6})


def test_energy_constraint_is_refused_where_fixed_steps_miss_contacts():
    ball = {
        "gravity": [0, 0, -G],
        "bodies": {"ball": {"shape": {"type": "sphere", "radius": 0.03}, "mass": 1.0, "position": [0, 0, 0.5]}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"hit": {"type": "contact", "body": "ball", "plane": "floor", "stiffness": 1e5, "restitution": 0.8}},
    }
    with pytest.raises(ModelError, match="'geometric' scales all velocities"):
        simulate(ball, duration=0.1, step=1e-4, stabilisation="geometric")
    simulate(ball, duration=0.4, step=1e-3, stabilisation="geometric", integrator="dopri5")


def test_a_run_shorter_than_any_is_refused():
    with pytest.raises(ModelError, match="shorter than 1e-12 s"):
        simulate(DOOR, duration=1e-300, step=1e-301)


def test_implicit_methods_say_that_multipliers_do_not_settle():
    given = {"duration": 0.2, "step": 1e-3, "coordinates": "absolute", "integrator": "newmark"}
    with pytest.raises(SolveError, match="finds no solution") as caught:
        simulate(HEAVY, **given, formulation="augmented-lagrangian")
    assert "a greater `penalty: {factor: 1e8}`" in caught.value.advice
    expected = simulate(HEAVY, **given)
    found = simulate(HEAVY, **given, formulation="augmented-lagrangian", penalty={"factor": 1e8})
    np.testing.assert_allclose(found.array("position"), expected.array("position"), atol=1e-5)
