"""Environments of Gymnasium for reinforcement learning: machines with inputs as actions.

    from nivel.gym import environment

    env = environment("cart-pole.yaml", reward="1 - hinge.angle^2", every="20 ms")

Gymnasium is loaded when an environment is made: `pip install 'nivel[gym]'`.
"""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

from nivel.api import Machine, load
from nivel.errors import Fault, ModelError
from nivel.extras import require
from nivel.lazy import gymnasium, nivel
from nivel.words.arguments import checked_arguments

__all__ = ["environment", "environments"]

Names = Sequence[str] | Mapping[str, Sequence[float]]


@checked_arguments
def environment(
    machine: Machine | str | PathLike[str],
    *,
    reward: str | Callable[..., float],
    observe: Names | None = None,
    actions: Sequence[str] | None = None,
    every: float | str | None = None,
    duration: float | str | None = None,
    vary: Mapping[str, Sequence[float | str]] | None = None,
    scaled: bool = True,
    record: bool = False,
    settings: Mapping[str, Any] | None = None,
) -> "gymnasium.Env[Any, Any]":
    """A machine with inputs as an environment of Gymnasium.

    machine : or its file. reward : an expression of names of results, inputs and `time` in SI units, "1 - hinge.angle^2", or a function of
    the simulation and the action, called after each. observe : names of results; with their bounds as a mapping
    ``{"rail.displacement": (-2.4, 2.4)}``; default all joint coordinates and their rates. actions : names of inputs, default all.
    every [s] : time between actions, a whole number of steps; default one step. duration [s] : after which an episode is truncated; default
    that of the machine. vary : ranges by path, ``{"joints.hinge.start.angle": ("-3 deg", "3 deg")}``, drawn anew for each episode.
    scaled : actions are from -1 to 1 in place of the range of each input. record : keep frames for ``env.unwrapped.result()``.
    settings : of the run, as of `machine.start`.

    An event with `stop: true` terminates an episode, as does a step that fails, with `failure` in the information. Raises ModelError.
    """
    given = {name: each for name, each in locals().items() if name != "machine"}
    require("environments for reinforcement learning need", "gymnasium")
    made = machine if isinstance(machine, Machine) else load(machine)
    return nivel.gym.machine_environment.MachineEnvironment(made, **given)


@checked_arguments
def environments(
    count: int,
    machine: Machine | str | PathLike[str],
    *,
    reward: str | Callable[..., float],
    lanes: bool | None = None,
    **given: Any,
) -> "gymnasium.vector.VectorEnv[Any, Any, Any]":
    """So many environments side by side as a vector environment of Gymnasium; what is given is that of `environment`.

    With a reward that is an expression, several go by each step where they can; lanes : as of `machine.start`.
    """
    require("environments for reinforcement learning need", "gymnasium")
    if count < 1:
        raise ModelError(Fault.at("count", f"at least one environment was expected, got {count}"))
    same = machine if isinstance(machine, Machine) else load(machine)
    if isinstance(reward, str) and not given.get("record"):
        one: Any = environment(same, reward=reward, **given)
        return nivel.gym.machine_environment.MachineEnvironments(count, one, reward, lanes=lanes)
    return gymnasium.vector.SyncVectorEnv([lambda: environment(same, reward=reward, **given)] * count)
