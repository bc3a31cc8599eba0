"""Path of a run: its steps, and the signals of its functions along them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Varying, is_local
from nivel.errors import ModelError
from nivel.integrate.loop.run import LEAST, PARTS
from nivel.machine.control.part import VALUE
from nivel.machine.core.vectors import cross
from nivel.machine.laws.symbols import Symbol, UnknownSymbolError, find_symbol
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME
from nivel.results.result import Result
from nivel.results.scales import rotated

Array = NDArray[np.float64]
AXES = {"x": 0, "y": 1, "z": 2}
# Steps that are looked at; of more, blocks all along the run.
MOST_STEPS = 200_000
# and in one part of the duration, where steps are chosen
MOST_IN_PART = 2_000
# frames that a spline needs
LEAST_FRAMES = 4


@dataclass(frozen=True)
class Steps:
    """Begins (n,) [s] of steps and their lengths (n,) [s], ascending: all of the run, or of very many some."""

    begin: Array
    length: Array

    def until(self, end: float) -> Steps:
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
    grid = [np.linspace(k * part, (k + 1) * part, count[k], endpoint=False) for k in range(PARTS)]
    times, last = [], 0.0
    for k, inside in enumerate(grid):
        if count[k] > 1:
            times.append(inside)
            last = inside[-1]
        elif not times or inside[0] >= last + taken[k] * (1.0 - 1e-9):
            times.append(inside)
            last = inside[0]
    ends = np.unique(np.concatenate([*times, [t for t in corners if t < duration], [duration]]))
    stride = -(-len(ends) // MOST_STEPS)
    return Steps(ends[:-1][::stride], np.diff(ends)[::stride])


def steps_between(ends: Array) -> Steps:
    """The steps between times (n + 1,) [s]."""
    stride = -(-(len(ends) - 1) // MOST_STEPS)
    return Steps(ends[:-1][::stride], np.diff(ends)[::stride])


@dataclass(frozen=True)
class Path:
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
        from scipy.interpolate import CubicSpline  # takes a quarter of a second to import

        return {name: CubicSpline(self.time, values) for name, values in self.signals.items()}

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
