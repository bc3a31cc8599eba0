"""From a machine to its session."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.progress.listener import Listener
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.integrate.loop.paced import drive
from nivel.live.parts import ENTRIES
from nivel.live.preparation import live_plan, pace_of
from nivel.live.session import Session
from nivel.native import workers


@contextmanager
def session_of(
    machine: Machine,
    settings: Mapping[str, Any],
    *,
    tick: float | None = None,
    urgent: bool = True,
    recorded_in: Path | None = None,
    listener: Listener | None = None,
) -> Iterator[Session]:
    """The machine, prepared in the solver's process, paused at its start. recorded_in : a folder for what is recorded.

    Raises ModelError where it cannot be.
    """
    machine = machine.with_settings(settings)
    pace_of(machine.record.simulation.step, tick)  # a tick that is not right is no fault of the file
    try:
        plan, pace = live_plan(machine.record, settings, tick)
        build([*run_entries(plan), drive, *ENTRIES], listener)
        workers.end_all()
        session = Session(plan, pace, urgent=urgent, recorded_in=recorded_in)
    except ModelError as error:
        raise ModelError(machine.origin.placed(error.faults)) from None
    try:
        yield session
    finally:
        session.close()
