"""A machine as an environment: actions set its inputs, observations are numbers of its results."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from gymnasium.utils.seeding import np_random
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from nivel.analysis.run.many import Simulations
from nivel.analysis.run.stepping import Simulation, Snapshot
from nivel.api import Machine
from nivel.errors import Fault, ModelError, SolveError
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.quantity import asked
from nivel.machine.units.tree import ExpressionError
from nivel.results.result import Result
from nivel.words.wording import shown, unknown_word

USUAL = ("joint_coordinate", "joint_rate")
VALUES = "values"  # of the options of `reset`
# share of a step by which a time between actions may miss whole steps
ROUND_OFF = 1e-6

Observation = NDArray[np.float64]


class MachineEnvironment(gymnasium.Env[Any, Any]):
    """A machine that a learner moves. observation_names, action_names : of the numbers of observations and actions.

    `simulation` is the machine in motion, with all its results by name.
    """

    def __init__(
        self,
        machine: Machine,
        *,
        reward: str | Callable[..., float],
        observe: Sequence[str] | Mapping[str, Sequence[float]] | None,
        actions: Sequence[str] | None,
        every: float | str | None,
        duration: float | str | None,
        vary: Mapping[str, Sequence[float | str]] | None,
        scaled: bool,
        record: bool,
        settings: Mapping[str, Any] | None,
    ) -> None:
        self.machine, self.settings, self._record = machine, dict(settings or {}), record
        self._vary = _ranges(machine, vary or {})
        self.simulation: Simulation = self.started({})
        self._begin: Snapshot = self.simulation.state
        self._reward = reward_of(reward, self.simulation)
        self.observation_names, self.observation_space = _observed(self.simulation, observe)
        self.action_names = _actions(machine, actions)
        ranges = np.array([machine.inputs[name].range for name in self.action_names], dtype=float)
        self._low, self._high, self._scaled = ranges[:, 0], ranges[:, 1], scaled
        low, high = (np.full(len(ranges), -1.0), np.full(len(ranges), 1.0)) if scaled else (self._low, self._high)
        self.action_space = Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
        step = self.simulation.step_size
        self.steps = 1 if every is None else _whole_steps(every, step)
        self.every = self.steps * step
        self.duration = machine.simulation.duration if duration is None else _time("duration", duration)
        self._nominal = True

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode, with new values of `vary`. options : `values`, of the machine by path for this episode.

        seed : of the numbers drawn from then on. Raises ModelError.
        """
        super().reset(seed=seed)
        values = self.drawn(self.np_random) | dict((options or {}).get(VALUES, {}))
        if values or not self._nominal:
            self.simulation = self.started(values)
        else:
            self.simulation.restore(self._begin)
        self._nominal = not values
        return self._observation(), {"time": self.simulation.time, "values": values}

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Set the inputs, and let the machine move until the next action.

        Terminated by an event with `stop: true` or by a step that fails, truncated by the duration. Raises ModelError where the action is
        not one of the space.
        """
        sim, information = self.simulation, {}
        before = len(sim.events)
        try:
            sim.advance(self.every, self.inputs_of(action))
        except SolveError as error:
            information["failure"] = str(error)
        information |= {"time": sim.time, "events": [each.name for each in sim.events[before:]]}
        ended = bool(sim.stopped_by) or "failure" in information
        over = sim.time > self.duration - ROUND_OFF * self.every
        return self._observation(), float(self._reward(sim, action)), ended, over and not ended, information

    def result(self) -> Result:
        """The frames of the present episode, for plots and the viewer; of environments with `record=True`."""
        return self.simulation.result()

    def started(self, values: Mapping[str, Any]) -> Simulation:
        """The machine with these values by path, at its start."""
        machine = self.machine.with_values(values) if values else self.machine
        return machine.start(record=self._record, **self.settings)

    def drawn(self, random: np.random.Generator) -> dict[str, float]:
        """New values of `vary`."""
        return {path: float(random.uniform(low, high)) for path, (low, high) in self._vary.items()}

    def inputs_of(self, action: Any) -> dict[str, Any]:
        """Values of the inputs; of actions (n, inputs) of copies n of each. Raises ModelError."""
        given = np.asarray(action, dtype=float)
        if given.shape[-1:] != self._low.shape:
            raise ModelError(Fault.at("action", f"{len(self._low)} numbers were expected, got {shown(given.tolist())}"))
        if self._scaled:
            given = self._low + 0.5 * (given + 1.0) * (self._high - self._low)
        # numbers of half the digits may pass a limit by their round-off
        slack = 1e-6 * (self._high - self._low)
        inside = (given >= self._low - slack) & (given <= self._high + slack)
        given = np.where(inside, np.clip(given, self._low, self._high), given)
        return dict(zip(self.action_names, given.T if given.ndim > 1 else given.tolist(), strict=True))

    def _observation(self) -> Observation:
        sim = self.simulation
        return np.array([sim[name] for name in self.observation_names], dtype=float)


class MachineEnvironments(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """Copies of a machine that a learner moves together, each as a `MachineEnvironment`; one whose episode is over begins anew at the next
    step.

    `simulations` are the copies in motion, of which several go by each step where they can.
    """

    def __init__(self, count: int, one: MachineEnvironment, reward: str, *, lanes: bool | None) -> None:
        """one : like which all are."""
        self.num_envs, self._one = count, one
        self.metadata = {"autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP}
        self._signals, self._reward = expression_reward(reward, one.simulation)
        self.simulations: Simulations = one.machine.start(n=count, lanes=lanes, **one.settings)
        self._begin, self._nominal = self.simulations.states[0], np.ones(count, dtype=bool)
        self.single_observation_space, self.single_action_space = one.observation_space, one.action_space
        self.observation_space, self.action_space = (
            batch_space(each, count) for each in (one.observation_space, one.action_space)
        )
        self._random = [np_random()[0] for _ in range(count)]
        self._ended = np.zeros(count, dtype=bool)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode of each. seed : of the first, those of the others count on from it; or one of each. options : as of one."""
        count = self.num_envs
        seeds = range(seed, seed + count) if isinstance(seed, int) else seed or [None] * count
        for k, each in enumerate(seeds):
            self._random[k] = self._random[k] if each is None else np_random(each)[0]
        self._ended[:] = False
        information = self._begun(range(count), dict((options or {}).get(VALUES, {})))
        return self._observation(), information | self._times()

    def step(
        self, actions: Any
    ) -> tuple[Observation, Observation, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Set the inputs of all, and let them move until the next actions. Raises ModelError as a single environment does."""
        sims, one, over = self.simulations, self._one, self._ended
        information = self._begun(np.flatnonzero(over).tolist(), {})
        before = [len(each) for each in sims.events]
        sims.go(one.steps, one.inputs_of(actions), ~over)
        events, terminated = sims.events, ~sims.alive
        came = [[each.name for each in now[count:]] for now, count in zip(events, before, strict=True)]
        for k in np.flatnonzero(terminated | np.array([bool(each) for each in came])).tolist():
            failure = {"failure": sims.reasons[k]} if terminated[k] and not came[k] else {}
            information = self._add_info(information, {"events": came[k]} | failure, k)
        values, time = sims[self._signals].tolist(), sims.time
        rewards = [0.0 if over[k] else self._reward(time[k], values[k]) for k in range(self.num_envs)]
        truncated = (time > one.duration - ROUND_OFF * one.every) & ~terminated & ~over
        self._ended = terminated | truncated
        return self._observation(), np.array(rewards), terminated, truncated, information | self._times()

    def _begun(self, which: Sequence[int], given: Mapping[str, Any]) -> dict[str, Any]:
        information: dict[str, Any] = {}
        for k in which:
            values = self._one.drawn(self._random[k]) | dict(given)
            if values or not self._nominal[k]:
                self.simulations.replace(k, self._one.started(values))
            else:
                self.simulations.restore(self._begin, [k])
            self._nominal[k] = not values
            information = self._add_info(information, {"values": values}, k)
        return information

    def _times(self) -> dict[str, Any]:
        return {"time": self.simulations.time, "_time": np.ones(self.num_envs, dtype=bool)}

    def _observation(self) -> Observation:
        return self.simulations[self._one.observation_names]


def _observed(
    sim: Simulation, given: Sequence[str] | Mapping[str, Sequence[float]] | None
) -> tuple[tuple[str, ...], Box]:
    """Names of the numbers of an observation, and their space. Raises ModelError."""
    if given is None:
        given = [name for name in USUAL if name in sim]
    names, low, high = [], [], []
    for name in [given] if isinstance(given, str) else given:
        if name not in sim:
            raise ModelError(Fault.at("observe", unknown_word(str(name), sim.names, "name")))
        bounds = given[name] if isinstance(given, Mapping) else (-np.inf, np.inf)
        if not isinstance(bounds, list | tuple) or len(bounds) != 2 or not bounds[0] < bounds[1]:
            raise ModelError(
                Fault.at(f"observe.{name}", f"the least and the greatest value were expected, got {shown(bounds)}")
            )
        own = sim.components([name])
        names += own
        low += [bounds[0]] * len(own)
        high += [bounds[1]] * len(own)
    if not names:
        raise ModelError(Fault.at("observe", "at least one name of a result was expected"))
    return tuple(names), Box(np.array(low, dtype=float), np.array(high, dtype=float), dtype=np.float64)


def _actions(machine: Machine, given: Sequence[str] | None) -> tuple[str, ...]:
    """Names of the inputs that actions set. Raises ModelError."""
    known = [*machine.inputs]
    chosen = known if given is None else [given] if isinstance(given, str) else [*given]
    for name in chosen:
        if name not in known:
            raise ModelError(Fault.at("actions", unknown_word(str(name), known, "input")))
    if not chosen:
        said = "the machine has no input that an action could set; write `inputs: {push: {range: [-10, 10], units: N}}`"
        raise ModelError(Fault.at("inputs", said))
    return tuple(chosen)


def _ranges(machine: Machine, vary: Mapping[str, Sequence[float | str]]) -> dict[str, tuple[float, float]]:
    """Least and greatest value by path, in SI units. Raises ModelError."""
    out = {}
    for path, given in vary.items():
        if not isinstance(given, list | tuple) or len(given) != 2:
            raise ModelError(
                Fault.at(f"vary.{path}", f"the least and the greatest value were expected, got {shown(given)}")
            )
        # with units as the machine reads them
        low, high = (machine.with_values({path: each})[path] for each in given)
        if isinstance(low, bool) or not isinstance(low, int | float) or not low <= high:
            raise ModelError(
                Fault.at(f"vary.{path}", f"the least and the greatest number were expected, got {shown(given)}")
            )
        out[path] = (float(low), float(high))
    return out


def _time(name: str, given: float | str) -> float:
    """A time [s] above zero. Raises ModelError."""
    value = asked(name, given, "time")
    if not 0.0 < value < np.inf:
        raise ModelError(Fault.at(name, f"a time above zero was expected, got {shown(given)}"))
    return value


def _whole_steps(every: float | str, step: float) -> int:
    """Steps between two actions. Raises ModelError."""
    value = _time("every", every)
    count = round(value / step)
    if count < 1 or abs(count * step - value) > ROUND_OFF * step:
        raise ModelError(Fault.at("every", f"{value:g} s is not a multiple of the step, {step:g} s"))
    return count


Reward = Callable[[Simulation, Any], float]


def reward_of(given: str | Callable[..., float], sim: Simulation) -> Reward:
    """The reward after each action. Raises ModelError where an expression cannot be read, or has a name that `sim` does not know."""
    if callable(given):
        return given
    signals, value = expression_reward(given, sim)
    return lambda sim, _action: value(sim.time, [float(sim[signal]) for signal in signals])


def expression_reward(given: str, sim: Simulation) -> tuple[tuple[str, ...], Callable[[float, Sequence[float]], float]]:
    """Names of the numbers that a reward depends on, and its value at a time [s] with these. Raises ModelError as `reward_of` does."""
    try:
        expression = Expression(given)
        signals, tree = expression.signals, expression.tree
    except ExpressionError as problem:
        raise ModelError(Fault.at("reward", f"`{given}`: {problem}")) from None
    for signal in signals:
        if signal not in sim or hasattr(sim[signal], "shape"):
            raise ModelError(Fault.at("reward", unknown_word(signal, [*sim.names], "number of the results")))

    def reward(time: float, values: Sequence[float]) -> float:
        try:
            return evaluate(tree, time, dict(zip(signals, values, strict=True)))
        except ExpressionError as problem:
            said = f"`{given}` has no value at t = {time:.6g} s: {problem}"
            raise ModelError(Fault.at("reward", said)) from None

    return signals, reward
