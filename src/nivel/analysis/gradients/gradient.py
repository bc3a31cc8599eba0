"""Gradients of runs: outputs, parameters, and a dataset of the slopes with their units and how far to trust them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import xarray

from nivel.analysis.gradients.check import LIGHTS, Checked, check
from nivel.analysis.gradients.outputs import Array, Output, Reduced, outputs_of
from nivel.analysis.gradients.parameters import Parameter, parameters_of
from nivel.analysis.gradients.slopes import Slopes, find_slopes, values_of
from nivel.analysis.plan.choice import FOR_STIFF
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, other_run, plan_run
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.dynamics import Loop, march, start_loop
from nivel.analysis.run.preparation import prepare
from nivel.errors import Fault, ModelError, SolveError
from nivel.integrate.loop.sink import Header
from nivel.model import Model
from nivel.results.curve import TOLD
from nivel.results.frames.labelled import data_array
from nivel.results.frames.occurrence import to_json
from nivel.results.frames.row_units import per
from nivel.results.memory import Memory
from nivel.results.result import Result

# integrators whose steps do not carry slopes right to their end, and why
UNFOLLOWED = {
    "energy-momentum": "a force of its own keeps the energy, and stays out of derivatives; generalised-alpha has them",
    "extrapolated-euler": "its matrix has secants of restrictions in place of their tangents; ros2 or radau have them",
}
# blocks of control whose code is not that of nivel
FOREIGN = {"fmu": "FMUs", "c": "C functions"}
HEADLINES = {
    "green": "slopes agree with differences of runs along a direction of all parameters",
    "amber": "differences of runs do not confirm all slopes: see the `verdict` of each",
    "red": "differences of runs contradict slopes: see the `verdict` of each; something cuts them, as a contact or a branch may",
    "not checked": "slopes were not compared with differences of runs",
}


class Varied:
    """A machine and its runs with other values of parameters, by the methods and settings of one plan.

    Where the machine names no integrator, all of them have the one that its own run has. as_asked : frames are those that were asked for;
    else numbers are made from no fewer than usual.
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

    def beside(self, parameter: Parameter, value: float) -> Loop:
        """The loop at the start of a run with another value of a parameter."""
        return start_loop(prepare(self._plan_with({parameter.path: value}).methods), self.settings)

    def run(self, values: Mapping[str, float]) -> Result:
        """The run with other values of parameters; none: the machine as it is. Raises SolveError where it fails."""
        plan = self._plan_with(values) if values else self.plan
        prepared = prepare(plan.methods) if values else self.prepared
        sink = Memory(self.settings.frames + 1)
        sink.begin(self._header(plan, prepared))
        finished = march(prepared, self.settings, [sink], shared=False)  # as their slopes are
        result = sink.close({"outcome": finished.outcome, "events": to_json(finished.events)})
        if finished.failure is not None:
            message, advice, at = finished.failure
            raise SolveError(message, time=at, advice=advice, result=result)
        return result

    def moved(self, parameters: Sequence[Parameter], point: Array) -> Result:
        """The run with all parameters away from their values by as much as `point` is. What the file computes from one of them follows it,
        also where it is itself one of them."""
        given: dict[str, float] = {}
        names = [f"parameters.{name}" for name in self._machine.parameters]
        changes = {each.path: float(value - each.value) for each, value in zip(parameters, point, strict=True)}
        for path in (name for name in names if name in changes):
            given[path] = _number_at(self._machine.with_values(given), path) + changes[path]
        followed = self._machine.with_values(given)
        others = (path for path in changes if path not in given)
        return self.run(given | {path: _number_at(followed, path) + changes[path] for path in others})

    def _plan_with(self, values: Mapping[str, float]) -> Plan:
        other = self._machine.with_values(dict(values))
        return plan_run(other.record, self._given)


def _number_at(machine: Model, path: str) -> float:
    return float(cast("float", machine[path]))


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
    refuse(plan)
    parameters = parameters_of(machine, paths)
    listener.say("preparing")
    varied = Varied(machine, plan, source, listener, as_asked=curves)
    plain = varied.run({})
    asked = outputs_of(outputs, plain, curves=curves)
    _refuse_events(asked, varied.prepared)
    listener.say("running on dual numbers")
    slopes = find_slopes(varied.prepared, varied.settings, varied.header, parameters, varied.beside, listener)
    found = [slopes.evaluate(output) for output in asked]
    verdicts: Sequence[Checked | None] = [None] * len(asked)
    if checked:
        listener.say("comparing with differences of runs")

        def values_at(point: Array) -> list[Array]:
            return values_of(asked, varied.moved(parameters, point))

        verdicts = check([each.slope for each in found], parameters, values_at, varied.settings.tolerance)
    return _dataset(slopes, plain, asked, found, verdicts)


def refuse(plan: Plan) -> None:
    """Raise ModelError where the methods of a run carry no slopes."""
    name, faults = plan.settings.integrator, []
    if name in UNFOLLOWED:
        what = f"`integrator: {name}` has no gradients: {UNFOLLOWED[name]}"
        faults.append(Fault("", 0, 0, "simulation.integrator", what))
    for kind, what in FOREIGN.items():
        if any(block.type == kind for block in plan.machine.control):
            faults.append(Fault("", 0, 0, "control", f"{what} give no slopes, so a machine with one has no gradients"))
    if faults:
        raise ModelError(faults)


def _refuse_events(outputs: Sequence[Output], prepared: Prepared) -> None:
    names = prepared.motion.system.events
    faults = [
        Fault("", 0, 0, each.label, f"there is no event `{each.name}`; events are: {', '.join(names) or 'none'}")
        for each in outputs
        if each.is_event and each.name not in names
    ]
    if faults:
        raise ModelError(faults)


def _dataset(
    slopes: Slopes,
    plain: Result,
    outputs: Sequence[Output],
    found: Sequence[Reduced],
    verdicts: Sequence[Checked | None],
) -> xarray.Dataset:
    data: dict[str, Any] = {}
    lights: dict[str, str] = {}
    for output, (value, slope, doubt), verdict in zip(outputs, found, verdicts, strict=True):
        units = output.units(plain)
        lights[output.label] = _light(verdict, slope, doubt)
        data[output.label] = _like(output, plain, value, {"units": units, "long_name": output.label})
        errors = verdict.errors() + doubt if verdict is not None else np.full_like(slope, np.nan)
        for k, parameter in enumerate(slopes.parameters):
            name = f"d({output.label})/d({parameter.path})"
            worst = float(np.max(errors[k])) if np.size(errors[k]) else 0.0
            attributes = {
                "units": per(units, parameter.units),
                "long_name": f"derivative of {output.label} with respect to {parameter.path}",
                "output": output.label,
                "parameter": parameter.path,
                "parameter_value": parameter.value,
                "estimated_error": worst,
                "verdict": lights[output.label],
            }
            data[name] = _like(output, plain, slope[k], attributes)
    known = [each for each in lights.values() if each in LIGHTS]
    light = max(known, key=LIGHTS.index) if known else "not checked"
    attributes = {"machine": plain.name, "verdict": light, "headline": HEADLINES[light], "verdicts": json.dumps(lights)}
    return xarray.Dataset(data, attrs=attributes)


def _light(verdict: Checked | None, slope: Array, doubt: Array) -> str:
    """That of the differences; amber at most where frames leave more open than `TOLD` of the largest slope along a parameter."""
    if verdict is None:
        return "not checked"
    size = np.max(np.abs(slope), axis=tuple(range(1, slope.ndim)), keepdims=True, initial=0.0)
    return "amber" if verdict.light == "green" and bool((doubt > TOLD * size).any()) else verdict.light


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
