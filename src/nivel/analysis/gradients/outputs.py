"""Outputs of gradients: a number, or an array of them, of the curves of a result; its value and its slopes.

crank.position            at the end of the run           crank.position at 0.5 s      then
max(…)  min(…)  peak(…)   the largest, smallest frame, the largest magnitude
rms(…)  mean(…)  integral(…)   over the time of the run
time(lift)                when the event `lift` came for the first time
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.results.result import Result
from nivel.words.wording import unknown_word

Array = NDArray[np.float64]

_CALL = re.compile(r"^\s*(\w+)\((.+)\)\s*$")
_AT = re.compile(r"^(.+?)\s+at\s+(.+)$")


class Curve(NamedTuple):
    """A curve of a run and its slopes along one direction. time (n,), value (n, …); the slopes of both."""

    time: Array
    value: Array
    time_slope: Array
    slope: Array


Reduce = Callable[[Curve], tuple[Array, Array]]


def final(curve: Curve) -> tuple[Array, Array]:
    """The last frame."""
    return curve.value[-1], curve.slope[-1]


def largest(curve: Curve) -> tuple[Array, Array]:
    """The largest of all frames, entry by entry."""
    k = np.argmax(curve.value, axis=0)[None]
    return np.take_along_axis(curve.value, k, 0)[0], np.take_along_axis(curve.slope, k, 0)[0]


def smallest(curve: Curve) -> tuple[Array, Array]:
    """The smallest of all frames, entry by entry."""
    value, slope = largest(curve._replace(value=-curve.value, slope=-curve.slope))
    return -value, -slope


def peak(curve: Curve) -> tuple[Array, Array]:
    """The largest magnitude of all frames, entry by entry."""
    sign = np.where(curve.value < 0.0, -1.0, 1.0)
    return largest(curve._replace(value=sign * curve.value, slope=sign * curve.slope))


def integral(curve: Curve) -> tuple[Array, Array]:
    """Over time, by trapezes between frames."""
    shape = (-1, *[1] * (curve.value.ndim - 1))
    h, h_slope = (np.diff(each).reshape(shape) for each in (curve.time, curve.time_slope))
    mean, mean_slope = (0.5 * (each[1:] + each[:-1]) for each in (curve.value, curve.slope))
    return np.sum(h * mean, axis=0), np.sum(h * mean_slope + h_slope * mean, axis=0)


def mean(curve: Curve) -> tuple[Array, Array]:
    """The integral over the time of the run, as a share of that."""
    total, slope = integral(curve)
    span, span_slope = (float(each[-1] - each[0]) for each in (curve.time, curve.time_slope))
    return total / span, slope / span - total / span * (span_slope / span)


def rms(curve: Curve) -> tuple[Array, Array]:
    """The root of the mean square."""
    square, slope = mean(curve._replace(value=curve.value**2, slope=2.0 * curve.value * curve.slope))
    root = np.sqrt(square)
    return root, np.divide(0.5 * slope, root, out=np.zeros_like(root), where=root > 0.0)


def at(t: float) -> Reduce:
    """The value at a time [s], on straight lines between frames."""

    def value_at(curve: Curve) -> tuple[Array, Array]:
        k = int(np.clip(np.searchsorted(curve.time, t, side="right") - 1, 0, len(curve.time) - 2))
        h = curve.time[k + 1] - curve.time[k]
        share, rate = (t - curve.time[k]) / h, (curve.value[k + 1] - curve.value[k]) / h
        moved = (1.0 - share) * curve.time_slope[k] + share * curve.time_slope[k + 1]
        value = curve.value[k] + share * (curve.value[k + 1] - curve.value[k])
        return value, curve.slope[k] + share * (curve.slope[k + 1] - curve.slope[k]) - rate * moved

    return value_at


REDUCTIONS: dict[str, Reduce] = {
    "max": largest,
    "min": smallest,
    "peak": peak,
    "rms": rms,
    "mean": mean,
    "integral": integral,
    "final": final,
}


@dataclass(frozen=True)
class Output:
    """What is asked for. label : as it was written. name : of a curve of the result, or of an event. reduce : what of the curve; None: all
    of it, or the time of the event. is_event : whether it is the time of an event."""

    label: str
    name: str
    reduce: Reduce | None = None
    is_event: bool = False
    by_time: bool = False

    def units(self, result: Result) -> str:
        """SI units of it."""
        if self.is_event:
            return "s"
        units = result.units(self.name)
        return " ".join([*([units] if units not in ("", "1") else []), "s"]) if self.by_time else units


def outputs_of(labels: Sequence[str], result: Result, *, curves: bool = False) -> tuple[Output, ...]:
    """What these labels ask for. curves : a name alone is the whole curve. Raises ModelError with every label that says nothing."""
    out, faults = [], []
    for label in labels:
        try:
            out.append(_output(label, result, curves))
        except ModelError as error:
            faults += [Fault("", 0, 0, label, each.message) for each in error.faults]
    if not labels:
        faults.append(Fault("", 0, 0, "outputs", "no output is given: give names of the result, ['max(rod.position)']"))
    if faults:
        raise ModelError(faults)
    return tuple(out)


def _output(label: str, result: Result, curves: bool) -> Output:
    if (call := _CALL.match(label)) is not None:
        word, name = call[1], call[2].strip()
        if word == "time":
            return Output(label, name, is_event=True)
        if word not in REDUCTIONS:
            raise ModelError(Fault("", 0, 0, label, unknown_word(word, [*REDUCTIONS, "time"], "function")))
        result.selection(name)
        return Output(label, name, REDUCTIONS[word], by_time=word == "integral")
    if (when := _AT.match(label)) is not None:
        result.selection(when[1])
        return Output(label, when[1], at(_time(when[2], result)))
    result.selection(label)
    return Output(label, label, None if curves else final)


def _time(text: str, result: Result) -> float:
    try:
        t = float(read_quantity(text, "time", {}))
    except (ExpressionError, TypeError, ValueError) as problem:
        raise ModelError(Fault("", 0, 0, text, f"a time was expected, as `0.5 s`: {problem}")) from None
    if not result.time[0] <= t <= result.time[-1]:
        raise ModelError(Fault("", 0, 0, text, f"the run goes from {result.time[0]:g} s to {result.time[-1]:g} s"))
    return t


def value_of(output: Output, result: Result) -> Array:
    """The value in a result without slopes."""
    if output.is_event:
        return np.array(next((each.time for each in result.events if each.name == output.name), np.nan))
    values: Any = result.array(output.name)
    nothing = np.zeros_like(values)
    curve = Curve(result.time, values, np.zeros_like(result.time), nothing)
    return values if output.reduce is None else output.reduce(curve)[0]
