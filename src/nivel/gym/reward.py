"""Rewards as functions of a simulation: of Python, or expressions of its results."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nivel.analysis.run.stepping import Simulation
from nivel.errors import Fault, ModelError
from nivel.machine.units.expression import Expression
from nivel.machine.units.tree import ExpressionError
from nivel.words.wording import unknown_word

RATE = "_rate"

Reward = Callable[[Simulation, Any], float]


def reward_of(given: str | Callable[..., float], sim: Simulation) -> Reward:
    """The reward after each action. Raises ModelError where an expression cannot be read, or has a name that `sim` does not know."""
    if callable(given):
        return given
    try:
        expression = Expression(given)
        signals = expression.signals
    except ExpressionError as problem:
        raise ModelError(Fault.at("reward", f"`{given}`: {problem}")) from None
    names = {signal: _result(signal, sim) for signal in signals}

    def reward(sim: Simulation, _action: Any) -> float:
        values = {signal: float(sim[name]) for signal, name in names.items()}
        try:
            return float(expression(sim.time, values))
        except ExpressionError as problem:
            said = f"`{given}` has no value at t = {sim.time:.6g} s: {problem}"
            raise ModelError(Fault.at("reward", said)) from None

    return reward


def _result(signal: str, sim: Simulation) -> str:
    """The name of a result that a signal is: `hinge.angle_rate` of machine files is `hinge.angle.rate`."""
    tried = (signal, f"{signal.removesuffix(RATE)}.rate") if signal.endswith(RATE) else (signal,)
    for name in tried:
        if name in sim and not hasattr(sim[name], "shape"):
            return name
    raise ModelError(Fault.at("reward", unknown_word(signal, [*sim.names], "number of the results")))
