"""A step of a vector environment of Gymnasium: copies of the cart-pole in lanes, singly, and in MuJoCo.

    python benchmarks/environments.py [--copies 16]

Between two actions there are ten steps of 2 ms of `rk4`, or of MuJoCo's RK4; an observation has four numbers, and episodes that are over
begin anew. MuJoCo gets the machine as `nivel export --mjcf` writes it, in an environment of a few lines. Rounds take turns in one thread;
the least of processor time. Needs `nivel[gym,robots]`.
"""

import argparse
from pathlib import Path
from time import process_time

import gymnasium
import mujoco
import numpy as np

import nivel
from against_mujoco import exported
from nivel.gym import environment, environments

MACHINE = Path(__file__).parent.parent / "examples" / "control" / "cart-pole.yaml"
STATE = ("rail.displacement", "rail.displacement.rate", "hinge.angle", "hinge.angle.rate")
ACTIONS, ROUNDS = 500, 6


class MuJoCoPole(gymnasium.Env):
    """The machine in MuJoCo."""

    observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (4,), np.float64)
    action_space = gymnasium.spaces.Box(-1.0, 1.0, (1,), np.float32)

    def __init__(self) -> None:
        self.model = exported(nivel.load(MACHINE))
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
        self.data = mujoco.MjData(self.model)

    def reset(self, *, seed=None, options=None):
        """Back to the start."""
        super().reset(seed=seed)
        mujoco.mj_resetData(self.model, self.data)
        return self.observation(), {}

    def step(self, action):
        """Ten steps."""
        self.data.ctrl[0] = 10.0 * action[0]
        mujoco.mj_step(self.model, self.data, 10)
        x, _, angle, _ = found = self.observation()
        return found, 1.0 - angle * angle, bool(abs(x) > 2.4 or abs(angle) > 0.2094), bool(self.data.time >= 10.0), {}

    def observation(self):
        """Places and rates."""
        data = self.data
        return np.array([data.qpos[0], data.qvel[0], data.qpos[1], data.qvel[1]])


def main() -> None:
    """Print microseconds a step and copy."""
    parser = argparse.ArgumentParser(description="Vector environments.")
    parser.add_argument("--copies", type=int, default=16)
    count = parser.parse_args().copies
    machine = nivel.load(MACHINE)
    given = {
        "observe": STATE,
        "reward": "1 - hinge.angle^2",
        "every": "20 ms",
        "settings": {"integrator": "rk4", "step": "2 ms"},
    }
    vectors = {
        "nivel, in lanes": environments(count, machine, lanes=True, **given),
        "nivel, singly": environments(count, machine, lanes=False, **given),
        "nivel, single environments": gymnasium.vector.SyncVectorEnv([lambda: environment(machine, **given)] * count),
        "MuJoCo, single environments": gymnasium.vector.SyncVectorEnv([MuJoCoPole] * count),
    }
    best = dict.fromkeys(vectors, np.inf)
    actions = np.random.default_rng(0).uniform(-0.3, 0.3, (ACTIONS, count, 1)).astype(np.float32)
    for _ in range(ROUNDS):
        for name, vector in vectors.items():
            vector.reset(seed=0)
            begin = process_time()
            for each in actions:
                vector.step(each)
            best[name] = min(best[name], process_time() - begin)
    for name, least in best.items():
        print(f"{name:28} {1e6 * least / ACTIONS / count:6.1f} us a step and copy")


if __name__ == "__main__":
    main()
