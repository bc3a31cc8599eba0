"""A run whose frames are kept in memory, to be measured."""

from __future__ import annotations

from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.progress.listener import Progress
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.preparation import prepare
from nivel.integrate.loop.sink import Header
from nivel.judge.after.subject import Run, run_of
from nivel.results.memory import Memory


def run_in_memory(plan: Plan, progress: Progress | None = None) -> Run:
    """Prepare and run; what its trust report would look at.

    The result holds the frames and what is known before the first of them, no trust report. Raises ModelError before anything is
    computed, KeyboardInterrupt where Ctrl-C came.
    """
    sink = Memory()
    prepared = prepare(plan.methods)
    sink.begin(Header(prepared.motion.system.layout, run_attributes(plan.machine, "", prepared, plan.settings)))
    finished = march(prepared, plan.settings, [sink], progress=progress)
    if finished.asked_to_stop:
        raise KeyboardInterrupt
    return run_of(plan, prepared, finished, sink.result())
