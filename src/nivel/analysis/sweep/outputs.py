"""Outputs of a study: one number of the result of a variant."""

import json
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Final, NamedTuple

import numpy as np

from nivel.analysis.plan.settings import with_usual_frames
from nivel.errors import Fault, ModelError, retold
from nivel.lazy import Struct, field
from nivel.machine.core.vectors import Array
from nivel.machine.study import parameter
from nivel.machine.study.any_quantity import another_measure
from nivel.model import Model
from nivel.results.analyses.efforts import Efforts
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.curve import REDUCTIONS, ROUNDED, SIZES, TOLD, Curve, curve, curve_of
from nivel.results.result import Result
from nivel.results.trust import amount
from nivel.words.wording import unknown_word

Found = Result | Efforts | LinearModel
Said = str | Callable[[Any], float]
OF_MODE = {"frequency": "Hz", "damping_ratio": "1", "real": "1/s", "imaginary": "1/s"}
OF_LOOP = {"gain_margin": "1", "phase_margin": "rad", "delay_margin": "s"}


OPEN: Final = 1e-2  # of an extreme by itself, where its history has one sign: a doubt that is said


class Number(NamedTuple):
    """An output of a variant, and its SI unit. doubt : what it may be off by, as it was made from numbers at frames; 0 where that is little
    beside the range of these, and beside the magnitude over time of what is summed."""

    value: float
    units: str
    doubt: float = 0.0

    @property
    def lacks(self) -> str:
        """What is not verified of it, in words."""
        return f"may be off by {amount(self.doubt, self.units)} between frames"


class History(NamedTuple):
    """A number over time as a curve of one column."""

    curve: Curve
    units: str


class OutputFailedError(Exception):
    """A function of the user failed."""


def outputs_of(found: Found, outputs: Mapping[str, parameter.Output]) -> dict[str, Number]:
    """The numbers by output; not a number where there is none.

    Raises ModelError, with the path of the key that is at fault, OutputFailedError.
    """
    numbers: dict[str, Number] = {}
    for name, output in outputs.items():
        try:
            with retold(lambda each, name=name: Fault.at(f"outputs.{name}.{each.path or 'of'}", each.message)):
                numbers[name] = number = number_of(found, output)
                _check_limits(output, number.units)
        except OutputFailedError as error:
            raise OutputFailedError(f"output {name}: {error}") from None
    return numbers


def check_function(output: parameter.PythonOutput) -> None:
    """Raise ModelError where the text has no such function, or a limit measures something else than its number."""
    _function(output.source, output.function, output.file)
    _check_limits(output, output.units)


def number_of(found: Found, output: parameter.Output) -> Number:
    """What an output is in a result. Raises ModelError, with the path of the key that is at fault, OutputFailedError."""
    match output:
        case parameter.PythonOutput():
            return Number(_called(output, found), output.units)
        case parameter.ScalarOutput():
            return _scalar(found, output.of)
        case parameter.EventTime():
            return Number(_event_time(found, output.event), "s")
        case parameter.FinalValue():
            values, units = history_of(found, output.of)
            return Number(float(values.value[-1, 0]) if len(values.time) else np.nan, units)
        case parameter.AtTime():
            return _at(history_of(found, output.of), output.time)
        case parameter.AtEvent():
            return _at(history_of(found, output.of), _event_time(found, output.event))
    history, units = history_of(found, output.of)
    part = _window(history, output.start, output.end)
    if not len(part.time):
        return Number(np.nan, _integrated(units) if output.type == "integral" else units)
    reduced = REDUCTIONS[output.type](part)
    span = float(part.time[-1] - part.time[0]) if output.type == "integral" else 1.0
    is_told = history.is_told(reduced.doubt / (span or 1.0))[0]
    if output.type in SIZES and not is_told:
        least = ROUNDED * float(np.max(np.abs(part.value))) * (span or 1.0)
        is_told = reduced.doubt[0] > max(TOLD * float(SIZES[output.type](part).value[0]), least)
    if output.type in ("min", "max") and np.all(part.value * reduced.value > 0.0):
        # the least distance or pressure is a number by itself, however large the range
        is_told = is_told or reduced.doubt[0] > OPEN * abs(reduced.value[0])
    value, doubt = float(reduced.value[0]), float(reduced.doubt[0]) if is_told else 0.0
    return Number(value, _integrated(units) if output.type == "integral" else units, doubt)


def history_of(found: Found, name: str) -> History:
    """One number over time. Raises ModelError where there is no such name, or more than one number."""
    if isinstance(found, LinearModel):
        names = [*(f"mode.1.{each}" for each in OF_MODE), "stable"]
        raise ModelError(f"a linear model has no histories; write `type: value` and `of` as in {', '.join(names)}")
    if isinstance(found, Efforts):
        return _of_efforts(found, name)
    values = found.array(name)
    if values.ndim > 1:
        variable = found.selection(name)
        dims = found.variables[variable.variable].dims[-(values.ndim - 1) :]
        listed = [f"{name}.{each}" for each in found.coordinates.get(dims[-1], ())]
        near = ", ".join(each for each in listed[:3] if each in found)
        raise ModelError(
            f"`{name}` has {values[0].size if len(values) else 'several'} numbers; write one, as {near or name}"
        )
    return History(curve_of(found, name), found.units(name))


def _of_efforts(found: Efforts, name: str) -> History:
    """Raises ModelError."""
    columns: dict[str, tuple[Array, str]] = {"missing_share": (found.missing_share, "1")}
    for k, actuator in enumerate(found.actuators):
        columns[f"{actuator}.effort"] = (found.effort[:, k], found.units[k])
        columns[f"{actuator}.power"] = (found.power[:, k], "W")
    if name not in columns:
        raise ModelError(unknown_word(name, list(columns), "name"))
    values, units = columns[name]
    return History(curve(found.time, values), units)


def said_number(said: Said) -> Callable[[Found], float]:
    """What reads an output in words (`said_output`) from a result, or a function of the user. Raises ModelError for words that are none."""
    if callable(said):
        return lambda found: float(said(found))
    output = parameter.said_output(said)
    return lambda found: number_of(found, output).value


def event_of(said: Said) -> str:
    """The event whose time was said; empty for other outputs."""
    output = None if callable(said) else parameter.said_output(said)
    return output.event if isinstance(output, parameter.EventTime) else ""


def at_times(found: Found, name: str, times: Array) -> Array:
    """Values at times [s], between two frames by cubics, not numbers outside of the result; of a number without history, at every time."""
    if _is_scalar(found, name):
        return np.full(len(times), _scalar(found, name).value)
    of = history_of(found, name).curve
    slack = 1e-9 * abs(of.time[-1])
    out = of.at(times)[:, 0]
    out[(times < of.time[0] - slack) | (times > of.time[-1] + slack)] = np.nan
    return out


def units_of(found: Found, name: str) -> str:
    """SI unit of a history, or of a number without one. Raises ModelError."""
    return _scalar(found, name).units if _is_scalar(found, name) else history_of(found, name).units


def _is_scalar(found: Found, name: str) -> bool:
    return isinstance(found, LinearModel) or parameter.SCALAR.fullmatch(name) is not None


def _scalar(found: Found, name: str) -> Number:
    """A number without history; not a number where a mode, a buckling load or a margin is none. Raises ModelError."""
    kind, _, rest = name.partition(".")
    if isinstance(found, Result):
        if kind == "buckling" and rest.isdigit():
            loads = json.loads(str(found.attributes.get("buckling", "[]")))
            return Number(loads[int(rest) - 1]["time"] if 1 <= int(rest) <= len(loads) else np.nan, "s")
        message = "`type: value` is for linear models, and for `buckling.1` of statics"
        raise ModelError(f"{message}; for a history write `type: final`, with `of: {name}`")
    if not isinstance(found, LinearModel):
        raise ModelError(f"`{name}` is a number of linear models; inverse dynamics has histories")
    if name == "stable":
        return Number(float(found.stable), "1")
    if name == "largest_real_part":
        moving = found.eigenvalues[~found.structural]
        return Number(float(np.max(moving.real, initial=-np.inf)) if len(moving) else np.nan, "1/s")
    first, _, last = rest.rpartition(".")
    if kind == "mode" and first.isdigit() and last in OF_MODE:
        moving = [each for each in found.modes if not each.structural]
        if not 1 <= int(first) <= len(moving):
            return Number(np.nan, OF_MODE[last])
        mode = moving[int(first) - 1]
        numbers = {
            "frequency": mode.natural_frequency if mode.eigenvalue.imag else np.nan,
            "damping_ratio": mode.damping_ratio,
            "real": mode.eigenvalue.real,
            "imaginary": mode.eigenvalue.imag,
        }
        return Number(float(numbers[last]), OF_MODE[last])
    loops = {} if found.sampled is None else {each.name: each for each in found.sampled.loops}
    if kind == "loop" and first in loops and last in OF_LOOP:
        margin = float(getattr(loops[first], last))
        return Number(np.radians(margin) if last == "phase_margin" else margin, OF_LOOP[last])
    known = [*(f"mode.1.{each}" for each in OF_MODE), "stable", "largest_real_part"]
    raise ModelError(
        unknown_word(name, [*known, *(f"loop.{each}.{margin}" for each in loops for margin in OF_LOOP)], "name")
    )


def _event_time(found: Found, name: str) -> float:
    """Time [s] of the first coming; not a number where it did not come."""
    if not isinstance(found, Result):
        raise ModelError(Fault.at("event", "events come in runs and statics"))
    return next((each.time for each in found.events if each.name == name), np.nan)


def _at(history: History, time: float) -> Number:
    """Between two frames by a cubic; not a number outside of the result."""
    of, units = history
    if not len(of.time) or not _inside(of.time, time):
        return Number(np.nan, units)
    doubt = of.doubt_at(np.array([time]))[0]
    return Number(float(of.at(np.array([time]))[0, 0]), units, float(doubt[0]) if of.is_told(doubt)[0] else 0.0)


def _inside(times: Array, time: float) -> bool:
    near = 1e-9 * max(abs(float(times[-1])), 1e-300)
    return bool(times[0] - near <= time <= times[-1] + near)


def _window(history: Curve, start: float | None, end: float | None) -> Curve:
    """The curve from `start` to `end`; empty where it does not have them."""
    time = history.time
    if (start is None and end is None) or not len(time):
        return history
    first = float(time[0]) if start is None else max(start, float(time[0]))
    last = float(time[-1]) if end is None else min(end, float(time[-1]))
    return history.within(first, last) if first <= last else curve(time[:0], history.value[:0])


def _integrated(units: str) -> str:
    if units in ("", "1"):
        return "s"
    return units.removesuffix("/s") if units.endswith("/s") else f"{units} s"


def _check_limits(output: parameter.Output, units: str) -> None:
    """Raise ModelError where a limit measures something else than the number."""
    for key in ("at_least", "at_most"):
        limit = getattr(output, key)
        if limit is not None and (wrong := another_measure(limit, units)):
            raise ModelError(Fault.at(key, wrong))


@cache
def _function(source: str, name: str, file: str) -> Any:
    """The function of a text that the user allowed to run. Raises ModelError where there is none."""
    names: dict[str, Any] = {"__name__": "outputs"}
    try:
        exec(compile(source, file or "outputs.py", "exec"), names)
    except Exception as error:
        raise ModelError(Fault.at("python", f"{type(error).__name__}: {error}")) from None
    if not callable(names.get(name)):
        known = [key for key, value in names.items() if callable(value) and not key.startswith("_")]
        raise ModelError(Fault.at("function", unknown_word(name, known, "function")))
    return names[name]


def _called(output: parameter.PythonOutput, found: Found) -> float:
    function = _function(output.source, output.function, output.file)
    try:
        return float(function(found))
    except Exception as error:  # whatever the function of the user does
        raise OutputFailedError(f"{type(error).__name__}: {error}") from error


class Task(Struct):
    """What is done with a machine. analysis : run, statics, kinematics, linearise, inverse. settings : of the analysis; of a run none, as
    the machine has them.

    outputs : numbers of each variant. save : names of results whose history is kept; none where there are outputs, else all joint
    coordinates and sensors, or where there are none the positions of the bodies. time_limit [s] : of the computation.
    judge : each variant has a trust report. sample : values by path of some of many variants, with the bounds of all; runs are patched
    where their numbers follow from them by formulas.
    """

    machine: Model
    analysis: str = "run"
    settings: Mapping[str, Any] = field(default_factory=dict)
    outputs: Mapping[str, parameter.Output] = field(default_factory=dict)
    save: tuple[str, ...] = ()
    verify: bool = False
    time_limit: float | None = None
    judge: bool = True
    sample: tuple[Mapping[str, Any], ...] = ()

    def __post_init__(self) -> None:
        """Numbers alone are made from as many frames as usual, whatever the machine asks for."""
        if self.analysis == "run" and not self.save and only_numbers(self.outputs):
            object.__setattr__(self, "machine", with_usual_frames(self.machine))


def only_numbers(outputs: Mapping[str, parameter.Output]) -> bool:
    """Whether there are outputs, of which none is a function of the user, which sees frames."""
    return bool(outputs) and not any(isinstance(each, parameter.PythonOutput) for each in outputs.values())


def usual_names(result: Result) -> tuple[str, ...]:
    """Joint coordinates and sensors, or the positions of the bodies; of a circuit alone its pressures."""
    sensors = tuple(name for name in result.variables if name.startswith("sensor."))
    names = (*result.coordinates.get("joint_coordinate_name", ()), *sensors)
    return names or (("position",) if "position" in result.variables else pressures(result))


def pressures(result: Result) -> tuple[str, ...]:
    """Names of the pressures of a circuit."""
    return tuple(name for name in result.variables if name.startswith("hydraulics.") and name.endswith(".pressure"))
