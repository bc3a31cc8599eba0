"""A machine that stands still is judged by what it is made of: round-off is green, and what is wrong stays red."""

import json

import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.results import Memory

TIME = np.linspace(0.0, 10.0, 101)
MASS, GYRATION, WEIGHT = 1.5, 0.08, 1.5 * 9.81
SIZE = 2.0 * GYRATION
ROUND_OFF = 5e-14  # m: joints are closed to 1e-13 of a metre


def block(**facts):
    """The scene of one body whose centre of mass, origin and joint point are one."""
    body = {"name": "arm", "mass": MASS, "radius_of_gyration": GYRATION, "points": [[0.0, 0.0, 0.0]], **facts}
    return {
        "scene": json.dumps({"bodies": [body], "ground_points": [[0.0, 0.0, 0.0]]}),
        "machine_record": json.dumps({"gravity": [0.0, -9.81, 0.0]}),
    }


def resting(attributes=None, **histories):
    """The trust report of a block held against its weight, which moves by round-off."""
    still = {name: np.zeros_like(values) for name, values in pendulum.histories(TIME).items()}
    ramp = TIME / TIME[-1]
    still |= {
        "orientation": np.tile([1.0, 0.0, 0.0, 0.0], (len(TIME), 1)),
        "joint_force": np.tile([0.0, WEIGHT, 0.0], (len(TIME), 1)),
        "position": np.outer(ramp, [0.0, -ROUND_OFF, 0.0])[:, None],
        "velocity": np.tile([0.0, -ROUND_OFF / TIME[-1], 0.0], (len(TIME), 1))[:, None],
        "constraint_violation": np.outer(ramp, [0.0, ROUND_OFF, 0.0, 0.0, 0.0]),
        "constraint_rate_violation": np.full((len(TIME), 5), ROUND_OFF / TIME[-1]),
        "potential_energy": -WEIGHT * ROUND_OFF * ramp,
        "energy_error": -WEIGHT * ROUND_OFF * ramp,
    }
    memory = Memory()
    memory.begin(pendulum.header(**(block() if attributes is None else attributes)))
    memory.take(pendulum.packed(TIME, {**still, **histories}))
    return pendulum.judged(memory.result())


def item(trust, name):
    return next(each for each in trust.items if each.name == name)


def rows(value):
    return np.outer(TIME / TIME[-1], [0.0, value, 0.0, 0.0, 0.0])


def test_round_off_of_a_machine_at_rest_is_green():
    """It moves by what its joints are open by, and that is no path: the energy error is all of the energy that there is."""
    trust = resting()
    assert (trust.verdict, trust.at_rest) == ("green", True)
    assert (trust.size, trust.size_kind) == (SIZE, "largest diameter of gyration")


def test_a_point_mass_at_rest_is_compared_with_a_metre():
    """g t²/2 is what it would fall: 5e-14 m of 490 m is no path, 0.1 m is one."""
    particle = block(radius_of_gyration=0.0)
    trust = resting(particle)
    assert (trust.verdict, trust.size) == ("green", 1.0)
    path = np.outer(TIME / TIME[-1], [0.1, 0.0, 0.0])[:, None]
    assert resting(particle, position=path).size == pytest.approx(0.1)


def test_a_path_longer_than_the_body_is_its_size():
    path = np.outer(TIME / TIME[-1], [0.3, 0.4, 0.0])[:, None]
    trust = resting(position=path)
    assert trust.size_kind == "extent of its path"
    assert trust.size == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("share", "verdict"), [(0.9e-6, "green"), (1.1e-6, "amber"), (0.9e-4, "amber"), (1.1e-4, "red")]
)
def test_an_open_joint_of_a_machine_at_rest_is_seen(share, verdict):
    assert item(resting(constraint_violation=rows(share * SIZE)), "violation").verdict == verdict


@pytest.mark.parametrize(("share", "verdict"), [(0.9e-5, "green"), (1.1e-5, "amber"), (1.1e-3, "red")])
def test_parts_that_slip_in_a_machine_at_rest_are_seen(share, verdict):
    """The least speed that counts is that of travelling by 1e-3 of the size in the run."""
    slip = rows(share * 1e-3 * SIZE / TIME[-1])
    assert item(resting(constraint_rate_violation=slip), "rate_violation").verdict == verdict


@pytest.mark.parametrize("creep", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("opening", [0.0, ROUND_OFF])
def test_a_block_that_creeps_where_it_should_stick_is_red(creep, opening):
    """It loses height, and no friction took the energy."""
    lost = -WEIGHT * creep * TIME / TIME[-1]
    trust = resting(potential_energy=lost, energy_error=lost, constraint_violation=rows(opening))
    assert item(trust, "energy").verdict == "red"


def test_the_tolerance_counts_at_rest_only():
    """Where steps are chosen a machine at rest is solved to the tolerance; loads of one that moves may be impacts."""
    settings = {"settings": json.dumps({"step": 1e-3, "tolerance": 1e-6})}
    error = 1e-12 * WEIGHT * SIZE * TIME / TIME[-1]
    still = resting({**block(), **settings}, energy_error=error, constraint_violation=rows(0.0))
    assert item(still, "energy").verdict == "green"
    assert still.energy_scale == pytest.approx(2 * 1e-6 * WEIGHT * SIZE)  # the weight and the reaction
    moving = np.tile([1e-3, 0.0, 0.0], (len(TIME), 1))[:, None]
    faster = resting({**block(), **settings}, energy_error=error, velocity=moving, constraint_violation=rows(0.0))
    assert faster.energy_scale == pytest.approx(2 * 1e-9 * WEIGHT * SIZE)


def test_without_loads_travelling_is_what_counts():
    """1e-9 of m (size/T)²/2: the round-off of velocities that the assembly leaves has no energy to be compared with."""
    zeros = {name: np.zeros(len(TIME)) for name in ("potential_energy", "energy_error")}
    attributes = {**block(), "machine_record": "{}"}
    nothing = {"joint_force": np.zeros((len(TIME), 3)), **zeros}
    energy = np.full(len(TIME), 1e-34)
    trust = resting(attributes, **{**nothing, "kinetic_energy": energy, "energy_error": energy})
    assert item(trust, "energy").verdict == "green"
    assert trust.energy_scale == pytest.approx(1e-9 * 0.5 * MASS * (SIZE / TIME[-1]) ** 2)
    assert (
        item(resting(attributes, **{**nothing, "energy_error": trust.energy_scale * TIME}), "energy").verdict == "red"
    )


def test_a_wheel_about_its_own_point_moves():
    """Neither its origin nor a joint point has a speed: its rim has."""
    spinning = np.tile([0.0, 0.0, 100.0], (len(TIME), 1))[:, None]
    trust = resting(angular_velocity=spinning)
    assert not trust.at_rest
    assert trust.speed == pytest.approx(100.0 * GYRATION)
