"""One variant of a sweep: its run, and what is kept of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.simulate import simulate
from nivel.errors import ModelError, NivelError, SolveError
from nivel.model import Model
from nivel.results.result import Result

DONE, STOPPED, FAILED, REFUSED, NOT_RUN = "done", "stopped", "failed", "refused", "not run"


@dataclass(frozen=True)
class Saved:
    """Numbers of one variable: dimensions behind time with their names, units, meaning, values (frames, …)."""

    dims: tuple[str, ...]
    names: Mapping[str, tuple[str, ...]]
    units: str
    long_name: str
    values: NDArray[np.float64]


@dataclass(frozen=True)
class VariantRun:
    """What is kept of a run. outcome : done; stopped, by an event; failed, with the `reason`; refused, before anything was computed.

    verdict : of the trust report, `not verified` in place of green where not all of it was verified. headline : how exact it is, in a
    sentence. estimated_error [m] : of positions, not a number without a second run. loop_seconds : in the compiled loop.
    """

    outcome: str
    reason: str = ""
    end_time: float = np.nan
    verdict: str = ""
    verified: bool = False
    headline: str = ""
    estimated_error: float = np.nan
    loop_seconds: float = 0.0
    time: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    saved: Mapping[str, Saved] = field(default_factory=dict)


def run_variant(base: Model, values: Mapping[str, Any], save: tuple[str, ...], verify: bool) -> VariantRun:
    """The machine with these values, run by its own settings. Faults and failures are kept, not raised.

    save : names of results; none: all joint coordinates and sensors, or where there are none, the positions of the bodies. verify : a
    second run goes beside it.
    Raises ModelError where the result has no such name.
    """
    machine = base
    try:
        machine = base.with_values(values) if values else base
        result = simulate(plan_run(machine.record, machine.origin.settings_outside), verify=verify)
    except SolveError as error:
        if not isinstance(error.result, Result):
            return VariantRun(FAILED, str(error), error.time)
        result, reason = error.result, str(error)
    except ModelError as error:
        return VariantRun(REFUSED, str(error))
    except NivelError as error:
        return VariantRun(FAILED, str(error))
    else:
        reason = f"event {result.stopped_by}" if result.stopped_by else ""
    if result.outcome == "interrupted":
        return VariantRun(NOT_RUN)
    outcome = FAILED if result.outcome == "failed" else STOPPED if result.stopped_by else DONE
    return _kept(result, outcome, reason, save or _usual(result))


def _usual(result: Result) -> tuple[str, ...]:
    """Joint coordinates and sensors, or the positions of the bodies."""
    sensors = tuple(name for name in result.variables if name.startswith("sensor."))
    names = (*result.coordinates.get("joint_coordinate_name", ()), *sensors)
    return names or ("position",)


def _kept(result: Result, outcome: str, reason: str, save: tuple[str, ...]) -> VariantRun:
    time, loop = result.time, float(result.timing.get("loop_seconds", 0.0))
    saved = {name: _saved(result, name) for name in save}
    end = float(time[-1]) if len(time) else 0.0
    trust = result.trust
    error = np.nan if trust.accuracy_estimate is None else trust.accuracy_estimate + (trust.elements_estimate or 0.0)
    return VariantRun(outcome, reason, end, trust.light, trust.verified, trust.headline, error, loop, time, saved)


def _saved(result: Result, name: str) -> Saved:
    """Raises ModelError where the result has no such name."""
    found = result.selection(name)
    variable = result.variables[found.variable]
    where = (*found.where, *[slice(None)] * (len(variable.dims) - len(found.where)))
    dims = tuple(dim for dim, each in zip(variable.dims[1:], where[1:], strict=True) if isinstance(each, slice))
    names = {dim: result.coordinates[dim] for dim in dims}
    return Saved(dims, names, result.units(name), variable.long_name, result.array(name))
