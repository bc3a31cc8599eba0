"""From a machine to its session."""

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Unpack

from nivel.analysis.gradients.outputs import parameters_of
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.progress.log import Listener
from nivel.api import Machine
from nivel.c_library.exported import Exported, export
from nivel.c_library.parameters import follow
from nivel.errors import retold
from nivel.files.target import check_target
from nivel.integrate.loop.paced import drive
from nivel.live.journal import Journal, journal_of
from nivel.live.page import LivePage, write_live_page
from nivel.live.preparation import Pace, live_plan, pace_of
from nivel.live.recording import about_run
from nivel.live.session import Session
from nivel.live.timing import ENTRIES
from nivel.native import workers
from nivel.settings import StepSettingsDict
from nivel.words.arguments import checked_arguments


@contextmanager
def session_of(
    machine: Machine,
    settings: Mapping[str, Any],
    *,
    tick: float | None = None,
    urgent: bool = True,
    record: Path | None = None,
    force: bool = False,
    listener: Listener | None = None,
) -> Iterator[Session]:
    """The machine, prepared in the solver's process, paused at its start.

    record : the recording that it is to become; its journal stands beside it until `Recorder.complete` puts the recording in its place.
    force : an older journal is written over. Raises ModelError where it cannot be.
    """
    machine = machine.with_settings(settings)
    with _planned(machine, settings, tick) as (plan, pace), ExitStack() as undone:
        journal = None
        if record is not None:
            about = about_run(plan.machine, machine.origin.source, settings, pace)
            journal = Journal(journal_of(record), about, force=force)
            undone.callback(journal.discard)
        build([*run_entries(plan), drive, *ENTRIES], listener)
        workers.COMPILERS.end_all()
        session = Session(plan, pace, urgent=urgent, journal=journal)
        undone.pop_all()
    try:
        yield session
    finally:
        session.close()


@checked_arguments
def export_page(
    machine: Machine,
    path: str | os.PathLike[str],
    *,
    tick: float | None = None,
    parameters: Sequence[str] | str = (),
    force: bool = False,
    listener: Listener | None = None,
    **settings: Unpack[StepSettingsDict],
) -> LivePage:
    """Write one HTML file in which the machine lives, to be operated as in `nivel live`, without Python, a server or a network.

    tick : time between two readings of the inputs [s], a whole number of steps; by default 1 ms, or a longer step. parameters : numbers of
    the machine by path, which the page changes by sliders, as of `Machine.export_fmu`. force : replace an existing file. settings : of the
    run, as in `Machine.start`.
    Raises ModelError where the integrator chooses its steps, a Python law or foreign code takes part, a parameter cannot be varied, or the
    file is there already.
    """
    target = Path(os.fspath(path))
    check_target(target, "page", force=force, sources=machine.origin.files)
    with _planned(machine := machine.with_settings(settings), settings, tick) as (plan, pace):
        build([*run_entries(plan), drive], listener)
        if not parameters:
            return write_live_page(plan, pace, target)
        given = parameters_of(machine, [parameters] if isinstance(parameters, str) else parameters, "a page")
        same = {**settings, "integrator": plan.settings.integrator}

        def varied(changes: Mapping[str, float]) -> Exported:
            return export(live_plan(machine.with_values(changes).record, same, tick)[0], "a page")

        return write_live_page(plan, pace, target, follow(given, export(plan, "a page"), varied))


@contextmanager
def _planned(machine: Machine, settings: Mapping[str, Any], tick: float | None) -> Iterator[tuple[Plan, Pace]]:
    """The live run of a machine, whose faults are placed in its file."""
    pace_of(machine.record.simulation.step, tick)  # a tick that is not right is no fault of the file
    with retold(machine.origin.placed):
        yield live_plan(machine.record, settings, tick)
