"""A run whose frames are kept in memory, to be measured."""

from __future__ import annotations

from nivel.analysis.attributes import run_attributes
from nivel.analysis.dynamics import Finished, march
from nivel.analysis.listener import Progress
from nivel.analysis.preparation import prepare
from nivel.analysis.settings import RunSettings
from nivel.machine.machine_record import MachineRecord
from nivel.march.sink import Header
from nivel.results.memory import Memory
from nivel.results.result import Result


def run_in_memory(
    machine: MachineRecord, settings: RunSettings, progress: Progress | None = None
) -> tuple[Result, Finished]:
    """Prepare and run `machine`; `settings` are its own, completed.

    The result holds the frames and what is known before the first of them, no trust report. Raises ModelError before anything is
    computed, KeyboardInterrupt where Ctrl-C came.
    """
    sink = Memory()
    prepared = prepare(machine, settings.formulation, settings.coordinates)
    sink.begin(Header(prepared.motion.system.layout, run_attributes(machine, "", prepared, settings)))
    finished = march(prepared, settings, [sink], progress=progress)
    if finished.asked_to_stop:
        raise KeyboardInterrupt
    return sink.result(), finished
