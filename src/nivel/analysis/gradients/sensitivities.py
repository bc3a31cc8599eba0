"""Sensitivities of a result: curves d(x)/d(p) of all its variables x along parameters p, beside its own."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nivel.analysis.gradients.check import worst
from nivel.analysis.gradients.gradient import HEADLINES, Varied, checked_slopes, refuse_without_slopes
from nivel.analysis.gradients.outputs import Array, Parameter, outputs_of, parameters_of
from nivel.analysis.plan.plan import Plan
from nivel.analysis.progress.log import Listener
from nivel.errors import ModelError
from nivel.integrate.loop.sink import Header
from nivel.model import Model
from nivel.results.frames.contents import MemoryContents, per
from nivel.results.result import Result
from nivel.system.layout import FrameLayout

# variables whose own slopes are compared with differences of runs: all others follow from these
CHECKED = ("position", "velocity")


def check_parameters(machine: Model, plan: Plan, paths: Sequence[str]) -> None:
    """Before anything is computed: raise ModelError where a path leads to no parameter, or the methods carry no slopes."""
    refuse_without_slopes(plan)
    parameters_of(machine, paths)


def with_sensitivities(
    machine: Model,
    plan: Plan,
    result: Result,
    paths: Sequence[str],
    *,
    source: str,
    checked: bool,
    listener: Listener | None = None,
) -> Result:
    """The result of a run of this plan with its sensitivities, in memory. checked : compare a direction with differences of runs.

    Raises ModelError where a parameter has no gradient, SolveError where the run on dual numbers fails.
    """
    listener = listener or Listener()
    varied, parameters = Varied(machine, plan, source, listener), parameters_of(machine, paths)
    asked = outputs_of([name for name in CHECKED if name in result.variables], result)
    slopes, verdicts = checked_slopes(varied, parameters, asked, result, listener, checked=checked)
    if slopes.result.time.shape != result.time.shape:
        raise ModelError(
            "the run was interrupted, or ends by another frame where its steps end at switches: there are sensitivities of whole runs only"
        )
    layout = varied.header.layout
    lights = [worst([each.lights[k] for each in verdicts if each is not None]) for k in range(len(parameters))]
    told = {
        each.path: {"value": each.value, "units": each.units, "verdict": light}
        for each, light in zip(parameters, lights, strict=True)
    }
    headline = HEADLINES[worst(lights)]
    attributes = {**result.attributes, "sensitivities": json.dumps(told), "sensitivities_headline": headline}
    # for a change of each by one of its units
    along = (slopes.lanes(k) / each.scale for k, each in enumerate(slopes.parameters))
    frames = [_frames_of(result, layout), *along]
    return Result(MemoryContents(Header(_with_slopes(layout, parameters), attributes), np.hstack(frames), attributes))


def _frames_of(result: Result, layout: FrameLayout) -> Array:
    frames = np.zeros((len(result.time), layout.width))
    frames[:, 0] = result.time
    for variable in layout.variables:
        if variable.name in result.variables:
            frames[:, variable.columns] = result.array(variable.name).reshape(len(frames), -1)
    return frames


def _with_slopes(layout: FrameLayout, parameters: Sequence[Parameter]) -> FrameLayout:
    """A block of columns for each parameter behind those of the run."""
    more = [
        replace(
            variable,
            name=f"d({variable.name})/d({parameter.path})",
            # rows of which each has its own units have none together
            units=per(variable.units, parameter.units) if variable.units else "",
            long_name=f"derivative by {parameter.path}: {variable.long_name}",
            columns=slice(variable.columns.start + at * layout.width, variable.columns.stop + at * layout.width),
        )
        for at, parameter in enumerate(parameters, 1)
        for variable in layout.variables
    ]
    return replace(layout, width=layout.width * (1 + len(parameters)), variables=(*layout.variables, *more))
