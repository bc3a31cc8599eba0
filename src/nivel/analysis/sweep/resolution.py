"""A study held against its machine: nominal values put in, and everything that does not fit told at its place in the study file."""

import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np

from nivel.analysis.plan.plan import plan_run
from nivel.analysis.sweep.outputs import check_function, outputs_of
from nivel.analysis.sweep.variants import Distribution
from nivel.errors import Fault, ModelError, gathered, refuse, retold
from nivel.files.reader import OUTSIDE
from nivel.files.sources import beside
from nivel.files.study_file import StudyFile
from nivel.integrate.loop.sink import Header
from nivel.lazy import Struct
from nivel.machine.settings.analyses import SETTINGS
from nivel.machine.settings.values import settings_of
from nivel.machine.study.any_quantity import dimension_of, si
from nivel.machine.study.parameter import AtEvent, EventTime, Output, PythonOutput, StudyParameter, Tolerance, Values
from nivel.machine.units.unit import symbol
from nivel.model import Model
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.system.build import build
from nivel.system.system import Equations
from nivel.words.wording import shown, unknown_word

# analyses whose results have the names of a run, or some of them
OF_RUNS: Final = ("run", "kinematics")


def wrong_names(study: StudyFile, machine: Model) -> Iterator[Fault]:
    """Faults of outputs, limits and histories that do not fit what runs of the machine compute. A machine that cannot be built is refused
    where its variants are."""
    record = study.record
    if record.analysis not in OF_RUNS:
        return
    try:
        result = _empty(machine)
    except ModelError:
        return
    events, faults = [each.name for each in machine.record.events], list[Fault]()
    for name, output in record.outputs.items():
        for fault in _of_output(result, name, output, events):
            yield study.fault(("outputs", name, *fault.path.split(".")), fault.message)
    for name in record.save:
        with gathered(faults, lambda fault: study.fault(("save",), fault.message)):
            result.selection(name)
    yield from faults


def _of_output(result: Result, name: str, output: Output, events: list[str]) -> Iterator[Fault]:
    """Faults with the key that is at fault as their path."""
    if isinstance(output, AtEvent | EventTime) and output.event not in events:
        yield Fault.at("event", unknown_word(output.event, events, "event"))
    try:
        if isinstance(output, PythonOutput):
            check_function(output)
        else:
            outputs_of(result, {name: output})
    except ModelError as error:
        for each in error.faults:
            yield Fault.at(each.path.removeprefix(f"outputs.{name}."), each.message)


def _empty(machine: Model) -> Result:
    """A result with the names and units of a run, without numbers. Raises ModelError."""
    plan = plan_run(machine.record)
    system = build(plan.methods.machine, Equations(6, normalisation=False))
    coordinates = system.layout.coordinates["joint_coordinate"]
    attributes: dict[str, str | float | int] = {
        "coordinate_units": json.dumps(dict(zip(coordinates, system.coordinate_units, strict=True))),
        "constraint_units": json.dumps(dict(zip(system.rows, system.row_units, strict=True))),
    }
    frames = np.zeros((2, system.layout.width))
    frames[1, 0] = plan.settings.duration
    return Result(MemoryContents(Header(system.layout, attributes), frames, attributes))


OF_FILES = ("motion", "trajectory")  # settings that name files, seen from the folder of the study


class Resolved(Struct):
    """A study with its machine.

    machine : with the values of `set`, and of a run with its settings. parameters : by path, nominal values put in. settings : of the
    analysis; of a run none, as the machine has them.
    """

    study: StudyFile
    machine: Model
    parameters: Mapping[str, Distribution]
    settings: Mapping[str, Any]


def resolve(study: StudyFile, machine: Model) -> Resolved:
    """The study of this `machine`, as its file has it. Raises ModelError with everything that does not fit."""
    faults: list[Fault] = []
    record = study.record
    machine = _with_fixed(study, machine, faults)
    parameters: dict[str, Distribution] = {}
    for path, parameter in record.parameters.items():
        with gathered(faults):
            known = _with_nominal(study, machine, path, parameter)
            _check(study, machine, path, known)
            parameters[path] = known
    settings = {
        name: beside(study.file, value) if name in OF_FILES and isinstance(value, str) else value
        for name, value in record.settings.items()
    }
    with gathered(faults, partial(_of_settings, study)):
        if record.analysis == "run":
            machine, settings = machine.with_settings(settings), {}
        else:
            _check_settings(machine, record.analysis, settings)
    faults += wrong_names(study, machine)
    refuse(faults)
    return Resolved(study, machine, parameters, settings)


def _with_fixed(study: StudyFile, machine: Model, faults: list[Fault]) -> Model:
    """The machine with the values of `set`."""
    values = study.record.values
    if not values:
        return machine

    def told(fault: Fault) -> Fault:
        near = next((path for path in values if fault.path.endswith(path) or path.endswith(fault.path)), None)
        return study.fault(("set",) if near is None else ("set", near), _said(fault))

    with gathered(faults, told):
        return machine.with_values(values)
    return machine


def _with_nominal(study: StudyFile, machine: Model, path: str, parameter: StudyParameter) -> StudyParameter:
    if isinstance(parameter, Values) or not parameter.needs_nominal:
        return parameter
    place = ("parameters", path)
    with retold(lambda fault: study.fault(place, fault.message, at_key=True)):
        value = machine[path]
    if isinstance(value, bool) or not isinstance(value, int | float):
        key = "mean" if "mean" in type(parameter).model_fields else "nominal"
        message = f"the machine file has no number there, but {shown(value)}; write `{key}`"
        raise ModelError(study.fault(place, message))
    return parameter.with_nominal(float(value))


def _check(study: StudyFile, machine: Model, path: str, parameter: StudyParameter) -> None:
    """Raise ModelError where the machine has no such path, or it measures something else."""
    place = ("parameters", path)
    if isinstance(parameter, Tolerance) and parameter.is_lost:
        message = f"{shown(parameter.tolerance)} is less than the last digit of the nominal value {si(parameter.nominal):g}: nothing varies"
        raise ModelError([study.fault((*place, "tolerance"), message)])
    probe = Probe("values", parameter.values[0]) if isinstance(parameter, Values) else _probe(parameter)
    at = (*place, probe.key) if (*place, probe.key) in study.tree.places else place
    with retold(lambda fault: study.fault(at, _said(fault).replace(f"`{probe.value}`", f"`{probe.written}`"))):
        machine.with_values({path: probe.value})


class Probe(NamedTuple):
    """A value inside the bounds, in the unit that a quantity is written with, and that quantity with its key."""

    key: str
    value: Any
    written: Any = ""


def _probe(parameter: Any) -> Probe:
    value = _inside(parameter)
    for name, given in parameter.given.items():
        if (its := dimension_of(given)) is not None:
            field = type(parameter).model_fields.get(name)
            key = "tolerance" if field is None else field.alias or name
            return Probe(key, given if si(given) == value else f"{value!r} {symbol(its)}", given)
    return Probe("type", value)


def _inside(parameter: Any) -> float:
    for name in ("nominal", "mean", "low"):
        if getattr(parameter, name, None) is not None:
            return si(getattr(parameter, name))
    return parameter.bounds[0]


def _check_settings(machine: Model, analysis: str, settings: Mapping[str, Any]) -> None:
    own = {"duration": machine.simulation.duration} if analysis == "statics" else {}
    settings_of(SETTINGS[analysis], "settings", {**own, **settings})


def _of_settings(study: StudyFile, fault: Fault) -> Fault:
    name = fault.path.removeprefix("settings.").removeprefix("simulation.").split(".")[0]
    return study.fault(("settings", name) if name in study.record.settings else ("settings",), _said(fault))


def _said(fault: Fault) -> str:
    """The message without the remark that its value does not stand in the machine file."""
    return fault.message.removesuffix(OUTSIDE)
