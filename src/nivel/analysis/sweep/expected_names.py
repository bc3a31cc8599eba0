"""Names that the runs of a study will have: outputs and histories are held against them before anything is computed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Final

import numpy as np

from nivel.analysis.plan.plan import plan_run
from nivel.analysis.sweep.outputs import check_function, outputs_of
from nivel.errors import Fault, ModelError
from nivel.files.study_file import StudyFile
from nivel.integrate.loop.sink import Header
from nivel.machine.study import AtEvent, EventTime, Output, PythonOutput
from nivel.model import Model
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.system.build import build
from nivel.system.system import Equations
from nivel.words.wording import unknown_word

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
    events = [each.name for each in machine.record.events]
    for name, output in record.outputs.items():
        for fault in _of_output(result, name, output, events):
            yield study.fault(("outputs", name, *fault.path.split(".")), fault.message)
    for name in record.save:
        try:
            result.selection(name)
        except ModelError as error:
            yield from (study.fault(("save",), each.message) for each in error.faults)


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
