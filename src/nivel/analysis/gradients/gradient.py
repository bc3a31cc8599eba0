"""Gradients of runs: outputs, parameters, and a dataset of the slopes with their units and how far to trust them."""

import json
from collections.abc import Mapping, Sequence
from functools import partial
from math import ceil
from typing import Any

import numpy as np
import xarray

from nivel.analysis.curves.pulses import largest_pulse
from nivel.analysis.gradients.check import STEPS, Checked, Slope, check, worst
from nivel.analysis.gradients.outputs import OVER_TIME, Array, Output, Parameter, Reduced, outputs_of, parameters_of
from nivel.analysis.gradients.slopes import Slopes, find_slopes, memory_of, values_of
from nivel.analysis.plan.choice import FOR_STIFF
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, other_run, plan_run
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.memory import MachineMemory
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.attempt import FINER, TENTH, refine, with_steps
from nivel.analysis.run.dynamics import Loop, march, start_loop
from nivel.analysis.run.prepared_state import prepare
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.integrate.loop.sink import Header
from nivel.judge.before.refusals import ON_SOIL, sampled_times
from nivel.lazy import replace
from nivel.model import Model
from nivel.results.curve import RATES, TOLD, unseen_between_frames
from nivel.results.frames.contents import MemoryContents, per
from nivel.results.frames.summary import to_json
from nivel.results.frames.tabulated import data_array
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.system.layout import FrameLayout

# integrators whose steps do not carry slopes right to their end, and why
UNFOLLOWED = {
    "energy-momentum": "a force of its own keeps the energy, and stays out of derivatives; generalised-alpha has them",
    "extrapolated-euler": "its matrix has secants of restrictions in place of their tangents; ros2 or radau have them",
}
# blocks of control whose code is not that of nivel
FOREIGN = {"fmu": "FMUs", "c": "C functions"}
HEADLINES = {
    "green": "slopes agree with differences of runs, over which each parameter moves by several sizes, and with those of finer steps",
    "amber": "differences of runs do not confirm all slopes: see the `verdict` of each",
    "red": "differences of runs contradict slopes: see the `verdict` of each; something cuts them, as a contact or a branch may",
    "not checked": "slopes were not compared with differences of runs",
}


class Varied:
    """A machine and its runs with other values of parameters, by the methods and settings of one plan.

    Where the machine names no integrator, all of them have the one that its own run has. as_asked : frames are those that were asked for;
    else numbers are made from no fewer than usual.

    Steps of fixed size end at switches, contacts,
    stops and samples, as chosen ones do: what happens inside a step moves with the parameters.
    """

    def __init__(
        self, machine: Model, plan: Plan, source: str, listener: Listener | None = None, *, as_asked: bool = True
    ) -> None:
        prepared, self._given = prepare(plan.methods), machine.origin.settings_outside
        if plan.is_open:
            named = _settled(plan, prepared, listener).machine.simulation
            known = {name: getattr(named, name) for name in ("integrator", "step", "tolerance")}
            machine = machine.with_settings(known)
            plan = plan_run(machine.record, self._given)
            prepared = prepare(plan.methods)
        if not as_asked:
            plan = replace(plan, settings=plan.settings.with_usual_frames)
        self._machine, self.plan, self.prepared, self._source = machine, plan, prepared, source
        self.mean_step = plan.settings.step

    @property
    def settings(self) -> RunSettings:
        """Those of all runs."""
        return self.plan.settings

    @property
    def header(self) -> Header:
        """What is known of the run."""
        return self._header(self.plan, self.prepared)

    def _header(self, plan: Plan, prepared: Prepared) -> Header:
        attributes = run_attributes(plan.machine, self._source, prepared, plan.settings, plan.reason)
        return Header(prepared.motion.system.layout, attributes)

    def beside(self, parameter: Parameter, value: float) -> MachineMemory:
        """The numbers at the start of a run with another value of a parameter."""
        prepared = prepare(self._plan_with({parameter.path: value}).methods)
        return memory_of(start_loop(prepared, self.settings, at_switches=True))

    def start(self, settings: RunSettings) -> Loop:
        """The loop at the start of a run."""
        return start_loop(self.prepared, settings, at_switches=True)

    def run(self, values: Mapping[str, float]) -> Result:
        """The run with other values of parameters; none: the machine as it is. Raises SolveError where it fails."""
        plan = self._plan_with(values) if values else self.plan
        prepared = prepare(plan.methods) if values else self.prepared
        sink = Memory(self.settings.frames + 1)
        sink.begin(self._header(plan, prepared))
        loop = start_loop(prepared, self.settings, at_switches=True)
        finished = march(prepared, self.settings, [sink], loop=loop, shared=False)  # as their slopes are
        if not values:
            self.mean_step = self.settings.duration / max(finished.timing["steps"], 1)
        result = sink.close({"outcome": finished.outcome, "events": to_json(finished.events)})
        if finished.failure is not None:
            message, advice, at = finished.failure
            raise SolveError(message, time=at, advice=advice, result=result)
        return result

    @property
    def refined(self) -> tuple[RunSettings, float]:
        """Settings of finer steps, with the same frames; and the length of such a step, or its tolerance, as a share of the usual one."""
        settings = self.settings
        if settings.tolerance is not None:
            return refine(settings).settings, TENTH
        # where something is sampled, steps end at its times
        fine = 2 * settings.every if self._sampled else ceil(FINER * settings.every)
        share = settings.every / fine
        return with_steps(settings, share * settings.step, fine), share

    @property
    def blurred(self) -> float:
        """[s] within this time a run does not tell when something has happened: a step, or the longest time between two samples."""
        return max([self.settings.step if self.settings.steps else self.mean_step, *self._sampled])

    @property
    def _sampled(self) -> list[float]:
        return [time for _, time in sampled_times(self.plan.machine)]

    def _plan_with(self, values: Mapping[str, float]) -> Plan:
        other = self._machine.with_values(dict(values))
        return plan_run(other.record, self._given)


def _settled(plan: Plan, prepared: Prepared, listener: Listener | None) -> Plan:
    """The plan of a machine that names no integrator with one that a run of it keeps to its end: slopes of another one would be those of
    the time at which it goes on, too."""
    if plan.methods.stiff is None or march(prepared, plan.settings, [], listener=listener).went_on is None:
        return plan
    stiff = other_run(plan, FOR_STIFF)
    if stiff is None:
        return plan
    build(run_entries(stiff), listener)
    return stiff


def gradient(
    machine: Model,
    plan: Plan,
    outputs: Sequence[str],
    paths: Sequence[str],
    *,
    checked: bool,
    source: str = "",
    curves: bool = False,
    listener: Listener | None = None,
) -> xarray.Dataset:
    """Derivatives of `outputs` of a run with respect to the numbers at `paths`: `nivel.api.Machine.gradient`. curves : a name alone is the
    whole curve."""
    listener = listener or Listener()
    refuse_without_slopes(plan)
    parameters = parameters_of(machine, paths)
    listener.say("preparing")
    varied = Varied(machine, plan, source, listener, as_asked=curves)
    plain = varied.run({})
    asked = outputs_of(outputs, plain, curves=curves)
    _refuse_events(asked, varied.prepared)
    slopes, verdicts = checked_slopes(varied, parameters, asked, plain, listener, checked=checked)
    found = [slopes.evaluate(output) for output in asked]
    return _dataset(slopes, plain, asked, found, verdicts, _unseen(plan, plain) if checked else "")


def _unseen(plan: Plan, plain: Result) -> str:
    """What forces, sensors and reactions do between frames that these show nothing of, in words."""
    pulse = largest_pulse(plan.machine, plain)
    return "; ".join([*([pulse.told] if pulse else []), *unseen_between_frames(plain)])


def checked_slopes(
    varied: Varied,
    parameters: Sequence[Parameter],
    outputs: Sequence[Output],
    plain: Result,
    listener: Listener,
    *,
    checked: bool,
) -> tuple[Slopes, Sequence[Checked | None]]:
    """Slopes of runs, and how far those of these outputs can be trusted. plain : the run without slopes."""
    listener.say("running on dual numbers")
    refined, share = varied.refined
    events = varied.prepared.motion.system.events
    find = partial(
        find_slopes, varied.start, varied.settings, varied.header, parameters, varied.beside, listener, events
    )
    if not checked:
        return find()[0], [None] * len(outputs)
    slopes, finer = find(refined)
    listener.say("comparing with differences of runs")
    scale = np.array([each.scale for each in parameters])
    compared = [_compared(output, plain, slopes, finer, scale, share) for output in outputs]

    def moved(k: int, change: float) -> list[Array] | None:
        parameter = parameters[k]
        try:
            return values_of(outputs, varied.run({parameter.path: parameter.value + change * parameter.scale}))
        except (ModelError, SolveError):
            return None

    with np.errstate(divide="ignore"):
        far = (STEPS * varied.blurred / slopes.time_shifts()).tolist()
    return slopes, check(compared, moved, varied.settings.tolerance, far)


def _compared(output: Output, plain: Result, slopes: Slopes, finer: Slopes | None, scale: Array, share: float) -> Slope:
    """Slopes of an output for changes of the parameters by their scales, with the errors of steps. Those fall with the step at least, so
    that the ones with finer steps are apart from them by 1 - share of the error at least."""
    found = slopes.evaluate(output).slope
    by_scale = scale.reshape(-1, *[1] * (found.ndim - 1))
    other = np.full_like(found, np.nan) if finer is None else finer.evaluate(output).slope
    if other.shape != found.shape:  # of curves that end at an event
        other = np.full_like(found, np.nan)
    extent = plain.time[-1] - plain.time[0] if output.is_event else np.ptp(plain.array(output.name), axis=0).max()
    if output.by_time:
        extent *= plain.time[-1] - plain.time[0]
    return Slope(by_scale * found, by_scale * np.abs(other - found) / (1.0 - share), float(extent))


def refuse_without_slopes(plan: Plan) -> None:
    """Raise ModelError where the methods of a run carry no slopes."""
    name, faults = plan.settings.integrator, []
    if name in UNFOLLOWED:
        what = f"`integrator: {name}` has no gradients: {UNFOLLOWED[name]}"
        faults.append(Fault.at("simulation.integrator", what))
    for kind, what in FOREIGN.items():
        if any(block.type == kind for block in plan.machine.control):
            faults.append(Fault.at("control", f"{what} give no slopes, so a machine with one has no gradients"))
    refuse([*faults, *ON_SOIL.faults(plan.machine)])


def _refuse_events(outputs: Sequence[Output], prepared: Prepared) -> None:
    names = prepared.motion.system.events
    faults = [
        Fault.at(each.label, f"there is no event `{each.name}`; events are: {', '.join(names) or 'none'}")
        for each in outputs
        if each.is_event and each.name not in names
    ]
    refuse(faults)


def _dataset(
    slopes: Slopes,
    plain: Result,
    outputs: Sequence[Output],
    found: Sequence[Reduced],
    verdicts: Sequence[Checked | None],
    unseen: str,
) -> xarray.Dataset:
    data: dict[str, Any] = {}
    for output, (value, slope, doubt), verdict in zip(outputs, found, verdicts, strict=True):
        units, lights = output.units(plain), _lights(verdict, slope, doubt)
        if unseen and output.reduce in OVER_TIME and plain.selection(output.name).variable not in RATES:
            lights = tuple("amber" if light == "green" else light for light in lights)
        data[output.label] = _like(output, plain, value, {"units": units, "long_name": output.label})
        errors = np.full_like(slope, np.nan)
        if verdict is not None:
            scale = np.array([each.scale for each in slopes.parameters]).reshape(-1, *[1] * (slope.ndim - 1))
            errors = doubt + verdict.errors / scale
        for k, parameter in enumerate(slopes.parameters):
            largest = float(np.max(errors[k])) if np.size(errors[k]) else 0.0
            name, attributes = described(output.label, parameter, units, largest, lights[k])
            data[name] = _like(output, plain, slope[k], attributes)
    out = attributed(data, plain.name)
    if unseen and out.attrs["verdict"] != "green":
        out.attrs["headline"] += f"; {unseen}"
    return out


def described(label: str, parameter: Parameter, units: str, error: float, light: str) -> tuple[str, dict[str, Any]]:
    """The name of a slope, and its attributes. units : of the output."""
    return f"d({label})/d({parameter.path})", {
        "units": per(units, parameter.units),
        "long_name": f"derivative of {label} with respect to {parameter.path}",
        "output": label,
        "parameter": parameter.path,
        "parameter_value": parameter.value,
        "estimated_error": error,
        "verdict": light,
    }


def attributed(data: Mapping[str, xarray.DataArray], machine: str) -> xarray.Dataset:
    """Outputs and their slopes with the worst verdict of each output, and of all."""
    lights: dict[str, list[str]] = {}
    for each in data.values():
        if "verdict" in each.attrs:
            lights.setdefault(each.attrs["output"], []).append(each.attrs["verdict"])
    verdicts = {label: worst(own) for label, own in lights.items()}
    light = worst([*verdicts.values()])
    told = {"machine": machine, "verdict": light, "headline": HEADLINES[light], "verdicts": json.dumps(verdicts)}
    return xarray.Dataset(data, attrs=told)


def _lights(verdict: Checked | None, slope: Array, doubt: Array) -> tuple[str, ...]:
    """Those of the differences; amber at most where frames leave more open than `TOLD` of the largest slope along a parameter."""
    if verdict is None:
        return ("not checked",) * len(slope)
    open_ones = (
        bool((own > TOLD * np.max(np.abs(of), initial=0.0)).any()) for of, own in zip(slope, doubt, strict=True)
    )
    return tuple(
        "amber" if light == "green" and is_open else light
        for light, is_open in zip(verdict.lights, open_ones, strict=True)
    )


def _like(output: Output, plain: Result, value: Array, attributes: dict[str, Any]) -> xarray.DataArray:
    """The value with the dimensions of its curve, time only where it is the curve."""
    if output.is_event:
        return xarray.DataArray(float(value), attrs=attributes)
    curve = data_array(plain, output.name)
    if output.reduce is not None:
        curve = curve.isel(time=-1, drop=True)
    # which body a curve is of is said by its name
    curve = curve.drop_vars([name for name, each in curve.coords.items() if each.ndim == 0])
    made = curve.copy(data=np.asarray(value, dtype=float))
    made.attrs = attributes
    made.name = None
    return made


# Sensitivities of a result: curves d(x)/d(p) of all its variables x along parameters p, beside its own.

# variables whose own slopes are compared with differences of runs: all others follow from these
CHECKED = ("position", "velocity")


def check_parameters(machine: Model, plan: Plan, paths: Sequence[str]) -> None:
    """Before anything is computed: raise ModelError where a path leads to no parameter, or the methods carry no slopes."""
    refuse_without_slopes(plan)
    parameters_of(machine, paths)


def with_sensitivities(
    machine: Model,
    plan: Plan,
    result: Result,
    paths: Sequence[str],
    *,
    source: str,
    checked: bool,
    listener: Listener | None = None,
) -> Result:
    """The result of a run of this plan with its sensitivities, in memory. checked : compare a direction with differences of runs.

    Raises ModelError where a parameter has no gradient, SolveError where the run on dual numbers fails.
    """
    listener = listener or Listener()
    varied, parameters = Varied(machine, plan, source, listener), parameters_of(machine, paths)
    asked = outputs_of([name for name in CHECKED if name in result.variables], result)
    slopes, verdicts = checked_slopes(varied, parameters, asked, result, listener, checked=checked)
    if slopes.result.time.shape != result.time.shape:
        raise ModelError(
            "the run was interrupted, or ends by another frame where its steps end at switches: there are sensitivities of whole runs only"
        )
    layout = varied.header.layout
    lights = [worst([each.lights[k] for each in verdicts if each is not None]) for k in range(len(parameters))]
    told = {
        each.path: {"value": each.value, "units": each.units, "verdict": light}
        for each, light in zip(parameters, lights, strict=True)
    }
    headline = HEADLINES[worst(lights)]
    attributes = {**result.attributes, "sensitivities": json.dumps(told), "sensitivities_headline": headline}
    # for a change of each by one of its units
    along = (slopes.lanes(k) / each.scale for k, each in enumerate(slopes.parameters))
    frames = [_frames_of(result, layout), *along]
    return Result(MemoryContents(Header(_with_slopes(layout, parameters), attributes), np.hstack(frames), attributes))


def _frames_of(result: Result, layout: FrameLayout) -> Array:
    frames = np.zeros((len(result.time), layout.width))
    frames[:, 0] = result.time
    for variable in layout.variables:
        if variable.name in result.variables:
            frames[:, variable.columns] = result.array(variable.name).reshape(len(frames), -1)
    return frames


def _with_slopes(layout: FrameLayout, parameters: Sequence[Parameter]) -> FrameLayout:
    """A block of columns for each parameter behind those of the run."""
    more = [
        replace(
            variable,
            name=f"d({variable.name})/d({parameter.path})",
            # rows of which each has its own units have none together
            units=per(variable.units, parameter.units) if variable.units else "",
            long_name=f"derivative by {parameter.path}: {variable.long_name}",
            columns=slice(variable.columns.start + at * layout.width, variable.columns.stop + at * layout.width),
        )
        for at, parameter in enumerate(parameters, 1)
        for variable in layout.variables
    ]
    return replace(layout, width=layout.width * (1 + len(parameters)), variables=(*layout.variables, *more))
