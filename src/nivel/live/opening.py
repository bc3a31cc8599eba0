"""From a machine to its session."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.progress.log import Listener
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.integrate.loop.paced import drive
from nivel.live.journal import Journal, journal_of
from nivel.live.parts import ENTRIES
from nivel.live.preparation import live_plan, pace_of
from nivel.live.recording import about_run
from nivel.live.session import Session
from nivel.native import workers


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
    pace_of(machine.record.simulation.step, tick)  # a tick that is not right is no fault of the file
    try:
        plan, pace = live_plan(machine.record, settings, tick)
        with ExitStack() as undone:
            journal = None
            if record is not None:
                about = about_run(plan.machine, machine.origin.source, settings, pace)
                journal = Journal(journal_of(record), about, force=force)
                undone.callback(journal.discard)
            build([*run_entries(plan), drive, *ENTRIES], listener)
            workers.end_all()
            session = Session(plan, pace, urgent=urgent, journal=journal)
            undone.pop_all()
    except ModelError as error:
        raise ModelError(machine.origin.placed(error.faults)) from None
    try:
        yield session
    finally:
        session.close()
