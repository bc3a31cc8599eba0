"""Path of a run: its steps, the signals of its functions along them, switches of these, and what a method takes a function for in a step.

Runge–Kutta methods look inside a step: here at places evenly spaced, as many as have the integral of the order of the method. Methods
of several steps look at the ends of steps, and their curve passes through those of earlier steps too: a cubic spline has about the same
integral, where the function has a corner a straight line.
"""

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import ExpressionCurve, Varying, is_local
from nivel.errors import ModelError
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import LEAST, PARTS
from nivel.lazy import Struct, replace, scipy
from nivel.machine.control.part import VALUE
from nivel.machine.core.vectors import Array, cross
from nivel.machine.laws.functions import functions_of
from nivel.machine.laws.symbols import Symbol, UnknownSymbolError, find_symbol
from nivel.machine.laws.varying_value import Expression
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.sides import sides
from nivel.machine.units.tree import TIME, Node, Operation, signals
from nivel.results.result import Result
from nivel.results.scales import rotated
from nivel.system.laws.program import PlacedProgram

AXES = {"x": 0, "y": 1, "z": 2}
# Steps that are looked at; of more, blocks all along the run.
MOST_STEPS = 200_000
# and in one part of the duration, where steps are chosen
MOST_IN_PART = 2_000
# frames that a spline needs
LEAST_FRAMES = 4


class Steps(Struct):
    """Begins (n,) [s] of steps and their lengths (n,) [s], ascending: all of the run, or of very many some."""

    begin: Array
    length: Array

    def until(self, end: float) -> "Steps":
        """Those that begin before `end` [s]."""
        count = max(1, int(np.searchsorted(self.begin, end)))
        return Steps(self.begin[:count], self.length[:count])


def steps_of(pace: Array, duration: float, step: float | None, corners: tuple[float, ...] = ()) -> Steps:
    """The steps of a run up to `duration` [s]. step [s] : a fixed one. Steps end at `corners` [s] too. pace : of `Run`, for
    steps that were chosen; they are as long as the shortest one at that time: a method that goes so far down has seen what there is."""
    if step is not None:
        count = max(1, int(np.ceil(duration / step * (1.0 - 1e-12))))
        stride = -(-count // MOST_STEPS)
        begin = step * np.arange(0, count, stride, dtype=np.float64)
        if corners and stride == 1:
            ends = np.unique(np.append(begin, [t for t in corners if t < duration]))
            return Steps(ends, np.diff(ends, append=count * step))
        return Steps(begin, np.full(len(begin), step))
    part = duration / PARTS
    taken = np.where(np.isfinite(pace[LEAST]), pace[LEAST], part)
    count = np.clip(np.ceil(part / taken), 1, MOST_IN_PART).astype(int)
    # a step longer than a part begins where the one before it ends
    kept, last = list[int](), -np.inf
    for k, (many, least) in enumerate(zip(count.tolist(), taken.tolist(), strict=True)):
        if many > 1 or k * part >= last + least * (1.0 - 1e-9):
            kept.append(k)
            last = (k + (many - 1) / many) * part
    within = [np.arange(many) / many for many in count[kept].tolist()]
    times = (np.repeat(kept, count[kept]) + np.concatenate(within)) * part
    return steps_between(np.unique(np.concatenate([times, [t for t in corners if t < duration], [duration]])))


def steps_between(ends: Array) -> Steps:
    """The steps between times (n + 1,) [s]."""
    stride = -(-(len(ends) - 1) // MOST_STEPS)
    return Steps(ends[:-1][::stride], np.diff(ends)[::stride])


class Path(Struct):
    """The signals of one function along a run, at the times of its frames.

    curved : between frames they are cubic splines, else straight lines.
    """

    time: Array
    signals: Mapping[str, Array]
    curved: bool = False

    def at(self, time: Array) -> dict[str, Array]:
        """The time and all signals at times (n,) [s]."""
        if not self.curved:
            return {TIME: time, **{name: np.interp(time, self.time, values) for name, values in self.signals.items()}}
        return {TIME: time, **{name: np.asarray(spline(time)) for name, spline in self._splines.items()}}

    @cached_property
    def _splines(self) -> Mapping[str, Any]:
        return {name: scipy.interpolate.CubicSpline(self.time, values) for name, values in self.signals.items()}

    @property
    def can_curve(self) -> bool:
        """Whether splines can be laid through its frames; two at one time are a jump."""
        finite = all(np.isfinite(values).all() for values in self.signals.values())
        return (
            bool(self.signals) and len(self.time) > LEAST_FRAMES and bool(np.all(np.diff(self.time) > 0.0)) and finite
        )


def path_of(function: Varying, machine: MachineRecord, result: Result) -> Path | None:
    """The signals of a function; None where the result does not have one of them."""
    try:
        signals = {name: _signal(name, function, machine, result) for name in function.curve.signals}
    except (ModelError, UnknownSymbolError):
        return None
    return Path(result.time, signals)


def _signal(name: str, function: Varying, machine: MachineRecord, result: Result) -> Array:
    if is_local(name):
        return result.array(f"{function.of}.{name}")
    symbol = find_symbol(name, machine)
    match symbol.section:
        case "joints":
            coordinate = symbol.quantity.removesuffix("_rate")
            rate = ".rate" if coordinate != symbol.quantity else ""
            return result.array(f"{symbol.name}.{coordinate}{rate}")
        case "inputs":
            return result.array(f"{symbol.name}.value")
        case "states":
            return result.array(f"state.{symbol.name}")
        case "forces":
            is_state = f"state.{name}" in result.variables
            return result.array(f"state.{name}" if is_state else f"force.{name}")
        case "hydraulics":
            return result.array(f"hydraulics.{name}")
        case "control":
            return result.array(f"control.{symbol.name}" if symbol.quantity == VALUE else f"control.{name}")
        case "sensors":
            return result.array(f"sensor.{name}")
        case "markers":
            marker = next(each for each in machine.markers if each.name == symbol.name)
            return _of_point(symbol, marker.body, np.array(marker.position, dtype=float), result)
        case "bodies":
            return _of_point(symbol, symbol.name, np.zeros(3), result)
    raise UnknownSymbolError(name)


def _of_point(symbol: Symbol, body: str, place: Array, result: Result) -> Array:
    """Place, velocity or angular velocity of a point at `place` [m] in its body."""
    axis = AXES[symbol.quantity[-1]]
    if symbol.quantity.startswith("w"):
        return result.array(f"{body}.angular_velocity")[:, axis]
    arm = rotated(result.array(f"{body}.orientation"), place)
    if symbol.quantity.startswith("v"):
        turning = cross(result.array(f"{body}.angular_velocity"), arm)
        return (result.array(f"{body}.velocity") + turning)[:, axis]
    return (result.array(f"{body}.position") + arm)[:, axis]


# Halvings of the time between two frames, and the share of it that is left out around a switch: on either side the function is smooth.
HALVINGS, LEFT_OUT = 40, 1e-10


def has_switches(machine: MachineRecord) -> bool:
    """Whether a function has corners or jumps with signals. Those of blocks, which have laws of their own, are taken to."""
    return bool(machine.control) or any(
        isinstance(each.function, Expression) and any(_switches(each.function)) for each in functions_of(machine)
    )


def _switches(expression: Expression) -> Iterator[tuple[Node, Node | None]]:
    """Pairs of expressions whose order decides. Corners of curves are no switches."""
    return sides(expression.tree, lambda *nodes: any(map(signals, nodes)), curves=False)


def cut_at_switches(function: Varying, path: Path, steps: Steps) -> Steps:
    """The steps, each in parts where it contains a switch of the function. A jump at the end of a step is of the next one."""
    gap = LEFT_OUT * float(np.diff(path.time).min())
    ending = replace(steps, length=np.maximum(steps.length - gap, 0.5 * steps.length))
    if not isinstance(function.curve, ExpressionCurve) or function.motion:
        return ending
    found = [_changes(first, second, path) for first, second in _switches(function.curve.expression)]
    times = np.unique(np.concatenate([*found, []]))
    times = times[(times > steps.begin[0]) & (times < steps.begin[-1] + steps.length[-1])]
    if not len(times):
        return ending
    begin = np.concatenate([steps.begin, times + gap])
    end = np.concatenate([steps.begin + steps.length, times - gap])
    begin, end = np.sort(begin), np.sort(end)
    longer = end > begin
    return Steps(begin[longer], (end - begin)[longer])


def _changes(first: Node, second: Node | None, path: Path) -> Array:
    """Times [s] at which the order of two expressions changes, one at most between two frames."""

    difference = PlacedProgram.of(first if second is None else Operation("-", first, second))

    def is_above(time: Array) -> NDArray[np.bool_]:
        return difference.values(path.at(time)) > 0.0

    above = is_above(path.time)
    at = np.flatnonzero(above[1:] != above[:-1])
    low, high, before = path.time[at], path.time[at + 1], above[at]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = is_above(middle) == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high


# steps that a spline needs
LEAST_STEPS = 4
ENDS, SIMPSON, BOOLE = 2, 3, 5


def as_seen(values: Array, steps: Steps, facts: IntegratorFacts) -> Array:
    """Values (n, samples) of a function at places evenly spaced over each step, begin and end among them; returns what the method takes
    them for (n, samples). The number of samples less one is a multiple of four."""
    if facts.order <= 2:
        return _through(values, ENDS)
    if facts.multistep:
        return _over_steps(values, steps)
    return _through(values, SIMPSON if facts.order <= 4 else BOOLE)


def _through(values: Array, count: int) -> Array:
    """The polynomial through `count` of the samples, evenly spaced."""
    share = np.linspace(0.0, 1.0, values.shape[1])
    at = np.linspace(0.0, 1.0, count)
    places = np.linspace(0, values.shape[1] - 1, count).astype(int)
    weights = np.ones((count, len(share)))
    for j in range(count):
        for k in range(count):
            if k != j:
                weights[j] *= (share - at[k]) / (at[j] - at[k])
    return (weights.T @ values[:, places].T).T  # in the order of `values`, whose columns stand side by side


def _over_steps(values: Array, steps: Steps) -> Array:
    """A spline through the ends of all steps, straight lines where these miss less of the integral."""
    straight = _through(values, ENDS)
    follow = np.allclose(steps.begin[1:], steps.begin[:-1] + steps.length[:-1], rtol=1e-9, atol=0.0)
    if len(steps.begin) < LEAST_STEPS or not follow:
        return straight
    ends = np.append(steps.begin, steps.begin[-1] + steps.length[-1])
    share = np.linspace(0.0, 1.0, values.shape[1])
    curve = scipy.interpolate.CubicSpline(ends, np.append(values[:, 0], values[-1, -1]))
    smooth = curve(steps.begin[:, None] + steps.length[:, None] * share)
    closer = np.abs((values - smooth).mean(axis=1)) < np.abs((values - straight).mean(axis=1))
    return np.where(closer[:, None], smooth, straight)
