"""A whole run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass, replace
from os import PathLike
from typing import Any

import numpy as np

import nivel
from nivel.analysis.dynamics import Finished, Prepared, Progress, march, prepare
from nivel.analysis.settings import RunSettings, complete
from nivel.errors import SolveError
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import INTEGRATORS
from nivel.march.sink import Header
from nivel.results import Memory, Result, Store
from nivel.results.trust import Facts, assess
from nivel.system.scene import scene


@dataclass(frozen=True)
class Listener:
    """Who wants to know how a run goes: `stage` hears what begins, `progress` the time reached [s]."""

    stage: Any = None
    progress: Progress | None = None

    def say(self, text: str) -> None:
        """Tell what begins now."""
        if self.stage is not None:
            self.stage(text)


def simulate(
    machine: MachineRecord,
    *,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    verify: bool = False,
    listener: Listener | None = None,
) -> Result:
    """Run `machine` with its own simulation settings; the result is in memory, or streamed to the file `out`.

    verify : run again with half the step and estimate the accuracy of the positions from the difference.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails.
    """
    listener = listener or Listener()
    settings = complete(machine.simulation)
    sink = Memory() if out is None else Store(out, force)
    begin = time.perf_counter()
    listener.say("preparing")
    prepared = prepare(machine, settings.formulation)
    sink.begin(Header(prepared.motion.system.layout, _attributes(machine, source, prepared, settings)))
    prepare_seconds = time.perf_counter() - begin
    listener.say("running")
    finished = march(prepared, settings, [sink], progress=listener.progress)
    accuracy = None
    if verify and finished.outcome == "done":
        listener.say("verifying with half the step")
        accuracy = _step_halving(machine, sink.result(), settings, listener)
    return _close(sink, prepared, finished, accuracy, {"prepare_seconds": prepare_seconds})


def _close(
    sink: Memory | Store, prepared: Prepared, finished: Finished, accuracy: float | None, timing: dict[str, float]
) -> Result:
    system, redundancy = prepared.motion.system, prepared.redundancy
    facts = Facts(
        outcome=finished.outcome,
        degrees_of_freedom=redundancy.degrees_of_freedom,
        redundant_rows=redundancy.redundant_rows,
        non_unique_joints=redundancy.non_unique_joints,
        size=system.size,
        accuracy_estimate=accuracy,
    )
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "trust": assess(sink.result(), facts).to_json(),
        "timing": json.dumps({**finished.timing, **timing}),
    }
    if finished.failure is not None:
        attributes["failure"] = finished.failure[0]
        attributes["advice"] = finished.failure[1]
    result = sink.close(attributes)
    if finished.failure is not None:
        message, advice, at = finished.failure
        raise SolveError(message, time=at, advice=advice, result=result)
    return result


def _attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: RunSettings
) -> dict[str, str | float | int]:
    system, assembly = prepared.motion.system, prepared.assembly
    coordinates = system.layout.coordinates["joint_coordinate"]
    return {
        "machine": machine.name,
        "machine_record": machine.model_dump_json(by_alias=True, exclude_none=True),
        "machine_source": source,
        "scene": json.dumps(scene(machine, system)),
        "settings": json.dumps(settings.as_dict()),
        "nivel_version": nivel.__version__,
        "outcome": "running",
        "coordinate_units": json.dumps(dict(zip(coordinates, system.coordinate_units, strict=True))),
        "constraint_units": json.dumps(dict(zip(system.rows, system.row_units, strict=True))),
        "assembly": json.dumps({"gap": assembly.gap, "gap_row": assembly.gap_row, "moved": assembly.moved}),
    }


def _step_halving(machine: MachineRecord, coarse: Result, settings: RunSettings, listener: Listener) -> float:
    """Estimated largest position error [m] of `coarse`: its difference from a run with half the step over 1 - 2^-order."""
    halved = replace(settings, step=settings.step / 2, every=2 * settings.every, steps=2 * settings.steps)
    fine_sink = Memory()
    prepared = prepare(machine, settings.formulation)
    fine_sink.begin(Header(prepared.motion.system.layout, {}))
    march(prepared, halved, [fine_sink], progress=listener.progress)
    fine = fine_sink.result()
    frames = min(len(coarse.time), len(fine.time))
    difference = coarse.array("position")[:frames] - fine.array("position")[:frames]
    order = INTEGRATORS[settings.integrator].order
    return float(np.abs(difference).max(initial=0.0)) / (1.0 - 0.5**order)
