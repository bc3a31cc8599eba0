"""Outputs of gradients: a number, or an array of them, of the curves of a result; its value and its slopes.

crank.position            at the end of the run           crank.position at 0.5 s      then
max(…)  min(…)  peak(…)   the largest and smallest value, the largest magnitude, between frames too
rms(…)  mean(…)  integral(…)   over the time of the run
time(lift)                when the event `lift` came for the first time
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.machine.study import parameter as study
from nivel.machine.units.quantity import Quantity
from nivel.machine.units.unit import KINDS
from nivel.model import Model
from nivel.results.curve import Curve, Number, curve_of, extreme, integral_of_product, largest, smallest
from nivel.results.curve import integral as whole
from nivel.results.result import Result
from nivel.words.wording import shown


class Moving(NamedTuple):
    """A curve and its slopes along one direction: slope (n, m), at times that stay; first, last : slopes of the times of its first and last
    frame, which move where an event ends the run."""

    curve: Curve
    slope: Curve
    first: float = 0.0
    last: float = 0.0

    @property
    def thinned(self) -> "Moving":
        """With every other frame, and the last one."""
        frames = np.unique(np.append(np.arange(0, len(self.curve.time), 2), len(self.curve.time) - 1))
        return self._replace(curve=_some(self.curve, frames), slope=_some(self.slope, frames))


def _some(of: Curve, frames: NDArray[np.intp]) -> Curve:
    none = np.zeros((len(frames) - 1, of.value.shape[1]))
    return Curve(of.time[frames], of.value[frames], of.rate[frames], none, none)


class Reduced(NamedTuple):
    """Values (m,), their slopes (m,), and what these may be off by as the curve is known at frames (m,)."""

    value: Array
    slope: Array
    doubt: Array


Reduce = Callable[[Moving], Reduced]


def final(of: Moving) -> Reduced:
    """The last frame."""
    slope = of.slope.value[-1] + of.curve.rate[-1] * of.last
    return Reduced(of.curve.value[-1], slope, np.zeros_like(slope))


def _at_extreme(find: Callable[[Curve], Number]) -> Reduce:
    """An extreme: its slope is that of the curve at its time, as the rate is zero there (envelope theorem); at an end of the run that moves
    the curve has a rate too."""

    def reduce(of: Moving) -> Reduced:
        found, columns = find(of.curve), np.arange(of.curve.value.shape[1])
        slope = of.slope.at(found.time)[columns, columns]
        for end, moves in ((0, of.first), (-1, of.last)):
            slope = slope + np.where(found.time == of.curve.time[end], of.curve.rate[end] * moves, 0.0)
        return Reduced(found.value, slope, of.slope.doubt_at(found.time)[columns, columns])

    return reduce


def peak(of: Moving) -> Reduced:
    """The largest magnitude."""
    found = _at_extreme(extreme)(of)
    sign = np.where(found.value < 0.0, -1.0, 1.0)
    return found._replace(value=sign * found.value, slope=sign * found.slope)


def integral(of: Moving) -> Reduced:
    """Over time."""
    slope = whole(of.slope)
    ends = of.curve.value[-1] * of.last - of.curve.value[0] * of.first
    return Reduced(whole(of.curve).value, slope.value + ends, slope.doubt)


def mean(of: Moving) -> Reduced:
    """The integral over the time of the run, as a share of that."""
    return _mean(of, integral(of))


def _mean(of: Moving, total: Reduced) -> Reduced:
    span = float(of.curve.time[-1] - of.curve.time[0])
    value = total.value / span
    return Reduced(value, total.slope / span - value * (of.last - of.first) / span, total.doubt / span)


def rms(of: Moving) -> Reduced:
    """The root of the mean square."""
    slope, values = integral_of_product(of.curve, of.slope), of.curve.value
    ends = values[-1] ** 2 * of.last - values[0] ** 2 * of.first
    square = integral_of_product(of.curve, of.curve)
    found = _mean(of, Reduced(square.value, 2.0 * slope.value + ends, 2.0 * slope.doubt))
    root = np.sqrt(found.value)
    halves = (np.divide(0.5 * each, root, out=np.zeros_like(root), where=root > 0.0) for each in found[1:])
    return Reduced(root, *halves)


def at(t: float) -> Reduce:
    """The value at a time [s]."""
    time = np.array([t])

    def value_at(of: Moving) -> Reduced:
        return Reduced(of.curve.at(time)[0], of.slope.at(time)[0], of.slope.doubt_at(time)[0])

    return value_at


REDUCTIONS: dict[str, Reduce] = {
    "max": _at_extreme(largest),
    "min": _at_extreme(smallest),
    "peak": peak,
    "rms": rms,
    "mean": mean,
    "integral": integral,
    "final": final,
}
OVER_TIME = tuple(each for each in REDUCTIONS.values() if each is not final)  # what frames alone cannot know


class Output(Struct):
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
        with gathered(faults, lambda fault, label=label: Fault.at(label, fault.message)):
            out.append(_output(label, result, curves))
    if not labels:
        faults.append(Fault.at("outputs", "no output is given: give names of the result, ['max(rod.position)']"))
    refuse(faults)
    return tuple(out)


def _output(label: str, result: Result, curves: bool) -> Output:
    said = study.said_output(label)
    if isinstance(said, study.EventTime):
        return Output(label, said.event, is_event=True)
    name: str = getattr(said, "of", "")
    result.selection(name)
    if isinstance(said, study.Reduced):
        return Output(label, name, REDUCTIONS[said.type], by_time=said.type == "integral")
    if not isinstance(said, study.AtTime):
        return Output(label, name, None if curves else final)
    if not result.time[0] <= said.time <= result.time[-1]:
        raise ModelError(Fault.at(label, f"the run goes from {result.time[0]:g} s to {result.time[-1]:g} s"))
    return Output(label, name, at(said.time))


def value_of(output: Output, result: Result) -> Array:
    """The value in a result without slopes."""
    if output.is_event:
        return np.array(next((each.time for each in result.events if each.name == output.name), np.nan))
    values: Any = result.array(output.name)
    if output.reduce is None:
        return values
    own = curve_of(result, output.name)
    still = Curve(own.time, *(np.zeros_like(each) for each in (own.value, own.rate, own.doubt, own.hidden)))
    return output.reduce(Moving(own, still)).value.reshape(values.shape[1:])


class Parameter(Struct):
    """A number of a machine. value : in SI units. units : of it, empty where its field says none.

    scale : what its changes are measured by, |value|, or 1 where it is zero.
    """

    path: str
    value: float
    units: str

    @property
    def scale(self) -> float:
        """What its changes are measured by."""
        return abs(self.value) or 1.0


def parameters_of(machine: Model, paths: Sequence[str], of: str = "") -> tuple[Parameter, ...]:
    """The numbers at these paths. of : what has them as parameters, which may take any value there; empty of a gradient. Raises
    ModelError with every path that leads to no number of which a run depends smoothly."""
    out: list[Parameter] = []
    faults: list[Fault] = []
    whose = of or "a gradient"
    if not paths:
        faults.append(Fault.at("parameters", "no parameter is given: give paths of numbers, ['bodies.rod.mass']"))
    for path in paths:
        try:
            value = machine[path]
        except ModelError as error:
            faults += [Fault.at(path, fault.message) for fault in error.faults]
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            faults.append(Fault.at(path, f"the parameter of {whose} is a number; here is {shown(value)}"))
        elif path.split(".")[0].strip() == "simulation":
            faults.append(Fault.at(path, f"settings of a run are no parameters of {whose}: it is that of one run"))
        elif of and machine.decides(path):
            message = "it decides between pieces of an expression (`if`, `min`, `max`, `abs`, a comparison, a curve)"
            faults.append(
                Fault.at(path, f"cannot be a parameter of {of}: {message}, and no one formula follows from it")
            )
        elif path in (each.path for each in out):
            faults.append(Fault.at(path, "this parameter is given twice"))
        else:
            out.append(Parameter(path, float(value), unit_of(machine, path)))
    refuse(faults)
    return tuple(out)


def unit_of(machine: Model, path: str) -> str:
    """SI unit of the number at a path; empty where the field of a record does not say one."""
    owner, _, leaf = path.rpartition(".")
    while leaf.isdecimal():  # a place in a list has the unit of the list
        owner, _, leaf = owner.rpartition(".")
    if owner == "parameters":
        return ""
    record = machine[owner] if owner else machine.record
    fields: Any = getattr(type(record), "model_fields", {})
    field = next((each for name, each in fields.items() if leaf in (name, each.alias)), None)
    kind = None if field is None else _kind([field.annotation, *field.metadata])
    return KINDS[kind][1] if isinstance(kind, str) else ""


def _kind(parts: Sequence[Any]) -> Any:
    for part in parts:
        if isinstance(part, Quantity):
            return part.kind
        if (found := _kind([*get_args(part), *getattr(part, "__metadata__", ())])) is not None:
            return found
    return None
