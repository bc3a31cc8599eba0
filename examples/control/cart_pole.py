"""Reinforcement learning without a library for it: a linear policy for the cart-pole, found by random search.

pip install 'nivel[gym]'
python cart_pole.py
"""

from pathlib import Path

import numpy as np

from nivel.gym import environment

MACHINE = Path(__file__).with_name("cart-pole.yaml")


def make(**given):
    """The cart-pole whose pole starts anywhere within 3 degrees; the reward is 1 where it stands upright in the middle."""
    return environment(
        MACHINE,
        observe=["rail.displacement", "rail.displacement.rate", "hinge.angle", "hinge.angle.rate"],
        reward="1 - 4*hinge.angle^2 - 0.1*rail.displacement^2",
        every="20 ms",
        vary={"joints.hinge.start.angle": ("-3 deg", "3 deg")},
        **given,
    )


def episode(env, policy, seed):
    """Sum of the rewards of one episode."""
    observation, _ = env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        action = np.clip([policy @ observation], -1.0, 1.0)
        observation, reward, terminated, truncated, _ = env.step(action)
        total += reward
        over = terminated or truncated
    return total


def search(env, rounds=60, seed=0):
    """The best of policies that are drawn about the best so far."""
    random = np.random.default_rng(seed)
    best, most = np.zeros(4), -np.inf
    for k in range(rounds):
        policy = best + random.normal(size=4) * (4.0 if most < 450 else 0.5)
        total = np.mean([episode(env, policy, seed=3 * k + j) for j in range(3)])
        if total > most:
            best, most = policy, total
    return best, most


if __name__ == "__main__":
    env = make(record=True)
    policy, total = search(env)
    print(f"policy {policy.round(2)}: {total:.1f} of 500")
    episode(env, policy, seed=1)
    env.unwrapped.result().save("cart-pole.nc", force=True)
    print("nivel view cart-pole.nc")
