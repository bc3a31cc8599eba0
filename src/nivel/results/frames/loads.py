"""Loads of a result: peak and RMS reactions, power and work of actuators, cycles of any signal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.flexible.body.rainflow import Cycle, rainflow
from nivel.machine.units.quantity import expression_fault, read_quantity
from nivel.machine.units.tree import ExpressionError

if TYPE_CHECKING:
    import xarray

    from nivel.results.result import Result

Array = NDArray[np.float64]
PARABOLA = 3  # frames
SEEN = 2e-3  # of the largest peak: what frames may hide of it without a word
WORK = 1e-2  # of the largest work: what the trapezoidal rule may leave open without a word
FEW = 3.0  # frames from one reversal to the next: with fewer no parabola shows a peak
SMALL = 1e-3  # of the range of a history: smaller changes are no reversals


def reactions(result: Result) -> xarray.Dataset:
    """Largest magnitude, its time and RMS over time of the force [N] and torque [N m] of every joint.

    The attributes have the trust report of the result; peaks that the frames do not show are not verified. Raises ModelError for a result
    without reactions.
    """
    import xarray

    if "joint_force" not in result.variables or not len(result.time):
        raise ModelError("the result has no reactions of joints")
    values, hidden, frames = {}, 0.0, np.inf
    for word, unit in (("force", "N"), ("torque", "N m")):
        size = np.linalg.norm(result.array(f"joint_{word}"), axis=2)
        hidden, frames = max(hidden, hidden_between_frames(size)), min(frames, frames_of_a_swing(size))
        at = np.argmax(size, axis=0)
        values[f"peak_{word}"] = (("joint",), size[at, np.arange(size.shape[1])], {"units": unit})
        values[f"peak_{word}_time"] = (("joint",), result.time[at], {"units": "s"})
        values[f"rms_{word}"] = (("joint",), _rms(size, result.time), {"units": unit})
    return xarray.Dataset(
        values, coords={"joint": list(result.coordinates["joint"])}, attrs=_trusted(result, hidden, frames)
    )


def hidden_between_frames(history: Array) -> float:
    """How much larger the peaks of histories (t, n) may be between frames, as a share of the largest peak: the top of the parabola through
    the largest number and its neighbours; nothing where that is the first or the last one."""
    largest = float(np.max(np.abs(history), initial=0.0))
    if len(history) < PARABOLA or not largest > 0.0:
        return 0.0
    first = np.argmax(np.abs(history), axis=0)
    columns = np.flatnonzero((first > 0) & (first < len(history) - 1))
    at = first[columns]
    before, peak, after = (np.abs(history[at + k, columns]) for k in (-1, 0, 1))
    bend = 2.0 * peak - before - after
    above = np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(bend), where=bend > 0.0)
    return float(np.max(above, initial=0.0)) / largest


def frames_of_a_swing(history: Array) -> float:
    """Frames from one reversal to the next, in the mean, of that one of histories (t, n) which turns most often; infinite if none does."""
    least = np.inf
    for values in history.T:
        change = np.diff(values)
        change = change[np.abs(change) > SMALL * np.ptp(values)]
        turns = np.count_nonzero(change[1:] * change[:-1] < 0.0)
        least = min(least, len(values) / turns) if turns > PARABOLA else least
    return float(least)


def open_work(history: Array, time: Array) -> float:
    """Error of the work of histories of power (t, n) that is integrated between frames, as a share of the largest work: a third of what
    the trapezoidal rule is off by with every other frame."""
    if len(time) < 2 * PARABOLA:
        return 0.0
    last = len(time) - 1 - (len(time) - 1) % 2
    work = np.trapezoid(np.abs(history[: last + 1]), time[: last + 1], axis=0)
    halved = np.trapezoid(np.abs(history[: last + 1 : 2]), time[: last + 1 : 2], axis=0)
    largest = float(np.max(work, initial=0.0))
    return float(np.max(np.abs(work - halved))) / (3.0 * largest) if largest > 0.0 else 0.0


def _trusted(result: Result, hidden: float, frames: float, work: float = 0.0) -> dict[str, str | int]:
    lacks = [f"peaks between frames, which may be {100.0 * hidden:.2g} % larger"] if hidden > SEEN else []
    if frames < FEW:
        lacks.append(f"peaks between frames, of which there are {frames:.2g} from one reversal to the next")
    if work > WORK:
        lacks.append(f"work between frames, which is open by {100.0 * work:.2g} %")
    return result.trust.of_derived(*lacks).attributes()


def powers(result: Result, period: float | str | None = None) -> xarray.Dataset:
    """Of every driver, coupling and force that reports its power: the largest magnitude [W], the work done and the work taken back [J].

    period : [s] of a cycle; then also the work of the last whole one [J], and its mean power [W]. Raises ModelError for a result without
    any power, or shorter than the period.
    """
    import xarray

    names = [name for name in result.variables if name.endswith(".power")]
    if not names or not len(result.time):
        raise ModelError("the result has no power of drivers or forces")
    history = np.column_stack([result.array(name) for name in names])
    dims = ("element",)
    values = {
        "peak_power": (dims, np.abs(history).max(axis=0), {"units": "W"}),
        "work_done": (dims, np.trapezoid(np.maximum(history, 0.0), result.time, axis=0), {"units": "J"}),
        "work_taken": (dims, np.trapezoid(np.minimum(history, 0.0), result.time, axis=0), {"units": "J"}),
    }
    if period is not None:
        period = _time(period)
        work = _work_of_cycle(history, result.time, period)
        values["work_per_cycle"] = (dims, work, {"units": "J"})
        values["mean_power"] = (dims, work / period, {"units": "W"})
    elements = [name.removesuffix(".power") for name in names]
    hidden, frames = hidden_between_frames(history), frames_of_a_swing(history)
    trusted = _trusted(result, hidden, frames, open_work(history, result.time))
    return xarray.Dataset(values, coords={"element": elements}, attrs=trusted)


def _work_of_cycle(power: Array, time: Array, period: float) -> Array:
    """(elements,) [J] work from the end of the result back over one period."""
    span = float(time[-1] - time[0])
    if not 0.0 < period <= span * (1.0 + 1e-9):
        raise ModelError(
            f"a period above zero and up to the {span:.6g} s of the result was expected, got {period:.6g} s"
        )
    steps = 0.5 * (power[1:] + power[:-1]) * np.diff(time)[:, None]
    work = np.vstack([np.zeros(power.shape[1]), np.cumsum(steps, axis=0)])
    begin = max(float(time[-1]) - period, float(time[0]))
    return np.array([column[-1] - np.interp(begin, time, column) for column in work.T])


def cycles(result: Result, name: str, *, repeating: bool = False) -> xarray.Dataset:
    """Rainflow cycles (ASTM E1049, section 5.4.4) of a signal by its name, a number at a time: range, mean and count, ranges ascending.

    repeating : the history goes on as it began, so that it starts at its largest peak and has no half cycles (section 5.4.5).
    Raises ModelError for names that the result does not have, and for vectors: take a component.
    """
    import xarray

    values = result.array(name)
    if values.ndim != 1:
        raise ModelError(f"`{name}` has several numbers at a time; take one of them, e.g. `{name}.x`")
    if not np.isfinite(values).all():
        raise ModelError(f"`{name}` is not a number at every time")
    if repeating and len(values):
        start = int(np.argmax(np.abs(values - values.mean())))
        values = np.append(np.roll(values, -start), values[start])
    found = sorted(rainflow(values))
    if repeating:
        found = _whole(found)
    columns = np.array([[each.range, each.mean, each.count] for each in found]).reshape(-1, 3)
    units = {"units": result[name].attrs.get("units", "")}
    data = {
        "range": (("cycle",), columns[:, 0], units),
        "mean": (("cycle",), columns[:, 1], units),
        "count": (("cycle",), columns[:, 2], {"units": "1"}),
    }
    column = values[:, None]
    trusted = _trusted(result, hidden_between_frames(column), frames_of_a_swing(column))
    return xarray.Dataset(data, attrs={"signal": name, **trusted})


def _whole(found: list[Cycle]) -> list[Cycle]:
    """Pairs of halves of one range as whole cycles."""
    halves = [each for each in found if each.count < 1.0]
    whole = [each for each in found if each.count == 1.0]
    whole += [Cycle(a.range, 0.5 * (a.mean + b.mean), 1.0) for a, b in zip(halves[::2], halves[1::2], strict=True)]
    return sorted(whole)


def _rms(values: Array, time: Array) -> Array:
    span = float(time[-1] - time[0])
    if span <= 0.0:
        return np.sqrt(np.mean(values**2, axis=0))
    return np.sqrt(np.trapezoid(values**2, time, axis=0) / span)


def _time(given: float | str) -> float:
    """[s] of a number or a text with a unit. Raises ModelError."""
    try:
        return read_quantity(given, "time", {})
    except ExpressionError as problem:
        raise ModelError(Fault("", 0, 0, "loads.period", expression_fault(problem, given).message())) from None
