"""A whole linearisation: the linear model of a machine, with its trust report."""

from __future__ import annotations

from dataclasses import replace

from nivel.analysis.linearise.opened import Opened
from nivel.analysis.linearise.other_elements import other_vibrations
from nivel.analysis.linearise.run import linear_model
from nivel.analysis.plan.plan import Methods, Plan
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.prepared_state import run_until
from nivel.judge.after.report import assess
from nivel.machine.settings.linearise import LineariseSettings
from nivel.results.analyses.linear_model import LinearModel


def linearise(
    opened: Opened,
    methods: Methods,
    settings: LineariseSettings,
    *,
    run: Plan | None = None,
    source: str = "",
    listener: Listener | None = None,
) -> LinearModel:
    """The linear model of a machine. methods : of it with neutral settings. run : to the state that it is about, or None.

    Raises ModelError for what has no linear equations, SolveError where they cannot be evaluated.
    """
    posture = None if run is None else run_until(run, listener or Listener())
    model, subject = linear_model(opened, methods, settings, posture=posture, source=source, listener=listener)
    if settings.verify:
        subject = replace(subject, others=other_vibrations(opened, methods, settings, run))
    return replace(model, trust=assess(subject))
