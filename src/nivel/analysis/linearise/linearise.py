"""A whole linearisation: the linear model of a machine, with its trust report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nivel.analysis.linearise.ports import Opened
from nivel.analysis.linearise.run import linear_model
from nivel.analysis.plan.plan import Methods, Plan, methods_of
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.prepared_state import run_until
from nivel.errors import ModelError, SolveError
from nivel.judge.after.other_elements import other_elements
from nivel.judge.after.report import assess
from nivel.judge.after.subject import OtherVibrations, Sweep, Variant
from nivel.machine.settings.analyses import LineariseSettings
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.analyses.linear_sweep import LinearSweep


def other_vibrations(
    opened: Opened, methods: Methods, settings: LineariseSettings, run: Plan | None
) -> OtherVibrations | None:
    """What the trust report compares the vibrations with; None where there are no beams. run : to the state, or None."""
    pair = other_elements(opened.machine)
    if pair is None:
        return None
    try:
        posture = None
        if run is not None:
            its = other_elements(run.machine)
            assert its is not None  # it has the same beams
            at = methods_of(its.machine, run.methods.formulation, run.methods.coordinates)
            posture = run_until(replace(run, machine=its.machine, methods=at), Listener())
        its_methods = methods_of(pair.machine, methods.formulation, methods.coordinates)
        model, _ = linear_model(replace(opened, machine=pair.machine), its_methods, settings, posture=posture)
    except (ModelError, SolveError) as error:
        return OtherVibrations(pair, np.zeros(0, dtype=np.complex128), str(error))
    return OtherVibrations(pair, model.eigenvalues)


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


def over(parameter: str, unit: str, values: Sequence[float], models: Sequence[LinearModel]) -> LinearSweep:
    """The models at ascending values of a parameter. Raises ModelError where their states differ, or values do not ascend."""
    seen = tuple(
        Variant(
            f"{parameter} = {value:g} {unit}".rstrip(),
            "done",
            "",
            model.trust.light,
            model.trust.verified,
            _worst(model),
        )
        for value, model in zip(values, models, strict=True)
    )
    without = models[0].trust.headline if models else ""
    trust = assess(Sweep(outcome="done", variants=seen, by="the trust reports", without=f"each model is {without}"))
    return LinearSweep(parameter, unit, np.array(values), tuple(models), trust)


def _worst(model: LinearModel) -> str:
    """The first line that is not green, or the headline."""
    return next((item.text for item in model.trust.items if item.verdict != "green"), model.trust.headline)
