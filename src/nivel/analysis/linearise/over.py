"""Linear models over the values of a parameter, with a trust report of all of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.judge.after.report import assess
from nivel.judge.after.subject import Sweep, Variant
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.analyses.linear_sweep import LinearSweep


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
