"""Environments of Gymnasium: an independent cart-pole, the checks of Gymnasium itself, and what is refused."""

import pickle
import runpy
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import nivel
from needing import needs
from nivel.gym import environment, environments

gymnasium = needs("gymnasium")

CART_POLE = Path(__file__).parents[2] / "examples" / "control" / "cart-pole.yaml"
STATE = ["rail.displacement", "rail.displacement.rate", "hinge.angle", "hinge.angle.rate"]
UPRIGHT = {"joints.hinge.start.angle": 0.0}


@pytest.fixture(scope="module")
def machine():
    return nivel.load(CART_POLE)


def made(machine, **given):
    return environment(machine, **{"observe": STATE, "reward": "1", "every": "20 ms", **given})


def test_the_cart_pole_moves_as_that_of_gymnasium(machine):
    """Its equations are another derivation, integrated by Euler's method with 20 ms as well."""
    env = made(machine, settings={"integrator": "euler", "step": "20 ms"})
    env.reset(options={"values": {"joints.hinge.start.angle": 0.04}})
    other = needs("gymnasium.envs.classic_control.cartpole").CartPoleEnv()
    other.reset(seed=0)
    other.state = np.array([0.0, 0.0, 0.04, 0.0])
    for choice in np.random.default_rng(0).integers(2, size=30):
        found, reward, terminated, truncated, _ = env.step([2.0 * choice - 1.0])
        other.step(choice)
        assert reward == 1.0
        if terminated:  # within a step, where that of Gymnasium goes to its end
            break
        np.testing.assert_allclose(found, other.state, atol=1e-12)
    assert terminated
    assert not truncated


def test_gymnasium_finds_nothing_wrong_with_it(machine):
    checker = needs("gymnasium.utils.env_checker")
    bounds = dict.fromkeys(STATE, (-10.0, 10.0))
    env = made(machine, observe=bounds, vary={"joints.hinge.start.angle": ("-3 deg", "3 deg")})
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        checker.check_env(env)
    assert [each for each in said if "render" not in str(each.message)] == []


def test_episodes_end_by_events_by_time_and_by_steps_that_fail(machine):
    env = made(machine, duration="0.1 s")
    env.reset(options={"values": UPRIGHT})
    ends = [env.step([0.0])[2:4] for _ in range(5)]
    assert ends == [(False, False)] * 4 + [(False, True)]
    env.reset()
    falls = made(machine)
    falls.reset(options={"values": {"joints.hinge.start.angle": "11.9 deg", "joints.hinge.start_rates.angle": 1.0}})
    found, _, terminated, truncated, information = falls.step([0.0])
    assert terminated
    assert not truncated
    assert information["events"] == ["fallen_right"]
    assert found[2] == pytest.approx(np.pi / 15, abs=1e-9)  # where the event is, between two actions
    # a force without bound in the coordinate
    text = machine.to_yaml().replace("effort: push.value", "effort: push.value/(0.5 - rail.displacement)")
    broken = nivel.Machine.from_record(nivel.files.parse_machine(text))
    wild = made(broken, vary={})
    wild.reset()
    for _ in range(200):
        *_, terminated, truncated, information = wild.step([1.0])
        if terminated:
            break
    assert terminated


def test_an_episode_is_repeated_by_its_seed_and_begins_anew_without_ranges(machine):
    env = made(machine, vary={"bodies.pole.mass": (0.05, 0.2), "joints.hinge.start.angle": (-0.05, 0.05)})
    first, information = env.reset(seed=3)
    assert set(information["values"]) == {"bodies.pole.mass", "joints.hinge.start.angle"}
    moved = env.step([0.3])[0]
    assert not np.array_equal(env.reset()[0], first)
    np.testing.assert_array_equal(env.reset(seed=3)[0], first)
    np.testing.assert_array_equal(env.step([0.3])[0], moved)
    same = made(machine)
    begin, _ = same.reset()
    same.step([1.0])
    np.testing.assert_array_equal(same.reset()[0], begin)
    same.reset(options={"values": UPRIGHT})
    np.testing.assert_array_equal(same.reset()[0], begin)


def test_rewards_are_expressions_or_functions_of_the_machine(machine):
    env = made(machine, reward="10*hinge.angle + hinge.angle_rate^2 + push.value + time", scaled=False)
    env.reset()
    found, reward, *_, information = env.step([4.0])
    expected = 10 * found[2] + found[3] ** 2 + 4.0 + information["time"]
    assert reward == pytest.approx(expected, rel=1e-12)
    env = made(machine, reward=lambda sim, action: sim["kinetic_energy"] + action[0])
    env.reset()
    assert env.step(np.array([0.5]))[1] == env.simulation["kinetic_energy"] + 0.5


def test_environments_side_by_side_and_a_recorded_episode(machine):
    several = environments(3, machine, reward="1", observe=STATE, vary={"joints.hinge.start.angle": (-0.05, 0.05)})
    begin, _ = several.reset(seed=1)
    assert begin.shape == (3, 4)
    assert len(set(begin[:, 2])) == 3
    found, reward, *_ = several.step(np.zeros((3, 1), dtype=np.float32))
    assert found.shape == (3, 4)
    assert reward.tolist() == [1.0, 1.0, 1.0]
    env = made(machine, record=True)
    env.reset()
    env.step([0.0])
    env.reset()
    env.step([0.0])
    env.step([0.0])
    assert env.result().time[-1] == pytest.approx(0.04)
    again = pickle.loads(pickle.dumps(env.simulation))
    assert again.time == env.simulation.time


@pytest.mark.compiles
@pytest.mark.parametrize("lanes", [True, False])
def test_environments_in_lanes_are_those_that_run_one_after_the_other(machine, lanes):
    """Beside Gymnasium's own vector of single environments: observations, rewards, ends, new episodes, and what is drawn for them."""
    given = {
        "observe": STATE,
        "every": "20 ms",
        "duration": "0.6 s",
        "vary": {"joints.hinge.start.angle": ("-8 deg", "8 deg"), "bodies.pole.mass": (0.05, 0.2)},
        "reward": "10*hinge.angle + hinge.angle_rate^2 + push.value + time",
    }
    several = environments(11, machine, lanes=lanes, **given)
    alone = gymnasium.vector.SyncVectorEnv([lambda: environment(machine, **given)] * 11)
    assert several.observation_space == alone.observation_space
    assert several.action_space == alone.action_space
    for seed in (4, None):
        np.testing.assert_array_equal(several.reset(seed=seed)[0], alone.reset(seed=seed)[0])
    ends, in_lanes = np.zeros(3, dtype=int), 0.0
    for k in range(60):
        actions = np.random.default_rng(k).uniform(-1.0, 1.0, (11, 1)).astype(np.float32)
        found, wanted = several.step(actions), alone.step(actions)
        for a, b in zip(found[:2], wanted[:2], strict=True):
            np.testing.assert_allclose(a, b, rtol=0.0, atol=1e-11 * np.abs(b).max())
        for a, b in zip(found[2:4], wanted[2:4], strict=True):
            np.testing.assert_array_equal(a, b)
        np.testing.assert_allclose(found[4]["time"], wanted[4]["time"], rtol=1e-12, atol=1e-15)
        for n, came in enumerate(wanted[4].get("events", [])):
            assert came is None or came == (
                found[4]["events"][n] if "events" in found[4] and found[4]["_events"][n] else []
            )
        ends += found[2].sum(), found[3].sum(), 1
        in_lanes += several.simulations.in_lanes.mean() / 60
    assert (ends > 0).all()
    assert (in_lanes > 0.5) == lanes


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"reward": "hinge.angel"}, r"reward: the number of the results `hinge.angel` is not known; did you mean"),
        ({"reward": "hinge.angle +"}, r"reward: `hinge.angle \+`"),
        ({"reward": "cart.position"}, r"reward: .*`cart.position` is not known"),
        ({"observe": ["rail.displacment"]}, r"observe: the name `rail.displacment` is not known; did you mean"),
        ({"observe": []}, r"observe: at least one name"),
        ({"observe": {"hinge.angle": (1, 0)}}, r"observe.hinge.angle: the least and the greatest value"),
        ({"actions": ["puhs"]}, r"actions: the input `puhs` is not known; did you mean `push`"),
        ({"every": "3 ms"}, r"every: 0.003 s is not a multiple of the step, 0.002 s"),
        ({"every": "3 kg"}, r"every: .*a time"),
        ({"duration": 0.0}, r"duration: a time above zero"),
        ({"vary": {"bodies.pole.mass": 3.0}}, r"vary"),
        ({"vary": {"bodies.pole.mass": (3.0, 1.0)}}, r"vary.bodies.pole.mass: the least and the greatest number"),
        ({"vary": {"bodies.pol.mass": (1.0, 3.0)}}, r"bodies.pol"),
        ({"settings": {"integrator": "dopri5"}}, r"chooses its steps"),
    ],
)
def test_what_cannot_be_an_environment_is_refused(machine, given, said):
    with pytest.raises(nivel.ModelError, match=said):
        made(machine, **given)


def test_actions_that_are_none_are_refused_and_a_machine_without_inputs(machine):
    env = made(machine)
    env.reset()
    for action, said in (
        ([0.0, 0.0], "1 numbers were expected"),
        ([2.0], "outside the range"),
        ([np.nan], "finite"),
    ):
        with pytest.raises(nivel.ModelError, match=said):
            env.step(action)
    with pytest.raises(nivel.ModelError, match="the machine has no input that an action could set"):
        environment(CART_POLE.parents[1] / "mechanisms" / "slider-crank.yaml", reward="1")


def test_without_gymnasium_it_says_what_to_install():
    """And nothing of it is loaded by nivel."""
    code = (
        "import sys; sys.modules['gymnasium'] = None; import nivel, nivel.gym\n"
        f"try: nivel.gym.environment({str(CART_POLE)!r}, reward='1')\n"
        "except nivel.ModelError as error: print(error)\n"
    )
    said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert "environments for reinforcement learning need gymnasium: pip install 'nivel[gym]'" in said


def test_the_example_keeps_its_pole_upright():
    example = runpy.run_path(str(CART_POLE.with_name("cart_pole.py")))
    env = example["make"](duration="2 s")
    assert example["episode"](env, np.array([0.75, 1.53, 5.27, 2.22]), seed=7) == pytest.approx(100, abs=1)
    assert example["episode"](env, np.zeros(4), seed=7) < 90
