"""One variant of a sweep: its computation, and what is kept of it."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.plan.plan import plan_run
from nivel.analysis.progress.journal import Row, fingerprint, packed, unpacked
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.simulate import simulate
from nivel.analysis.sweep.outputs import Found, Number, OutputFailedError, Task, outputs_of, usual_names
from nivel.analysis.sweep.variant_runs import JudgedRuns, Ran, VariantRuns, analysed, formulas_for, tried
from nivel.analysis.sweep.variants import Variants
from nivel.errors import ModelError, retold
from nivel.lazy import Struct, field, replace
from nivel.machine.study.parameter import Output, Reduced
from nivel.native.processor import lane_count
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.curve import RATES, unseen_between_frames
from nivel.results.result import Result

FAILED, NOT_RUN = "failed", "not run"
KILLED: Final = "killed"
ENDLESS: Final = 1e9  # s that second runs may go on: how far they come may not depend on how busy a processor is


class Saved(Struct):
    """Numbers of one variable: dimensions behind time with their names, units, meaning, values (frames, …)."""

    dims: tuple[str, ...]
    names: Mapping[str, tuple[str, ...]]
    units: str
    long_name: str
    values: NDArray[np.float64]


class VariantRun(Struct):
    """What is kept of a variant. outcome : done; stopped, by an event; failed, with the `reason`; refused, before anything was computed;
    timed out; killed, with the process that computed it.

    verdict : of the trust report, `not verified` in place of green where not all of it was verified. headline : how exact it is, in a
    sentence. estimated_error [m] : of positions, not a number without a second run. loop_seconds : in the compiled loop.
    in_lanes : together with others. outputs : by name.
    """

    outcome: str
    reason: str = ""
    end_time: float = np.nan
    verdict: str = ""
    verified: bool = False
    headline: str = ""
    estimated_error: float = np.nan
    loop_seconds: float = 0.0
    in_lanes: bool = False
    time: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    saved: Mapping[str, Saved] = field(default_factory=dict)
    outputs: Mapping[str, Number] = field(default_factory=dict)


def run_variant(task: Task, values: Mapping[str, Any]) -> VariantRun:
    """The machine of the task with these values, computed. Faults and failures are kept, not raised.

    Raises ModelError where the result has no name that is saved or that an output asks for.
    """
    return _with_outputs(tried(lambda: _computed(task, values)) if task.judge else _runs_of(task).run(values), task)


def run_variants(task: Task, rows: Sequence[Mapping[str, Any]]) -> Iterator[VariantRun]:
    """Variants one after the other, as of `run_variant`; no more of them than `at_once` are computed together."""
    if task.judge or len(rows) == 1:
        yield from (run_variant(task, values) for values in rows)
        return
    for ran in _runs_of(task).run_all(rows):
        yield _with_outputs(ran, task)


def at_once(task: Task) -> int:
    """How many variants of a task are best given to `run_variants`."""
    return 1 if task.judge or task.time_limit is not None or not task.sample else lane_count()


def look_for_lanes(task: Task, seconds: float, listener: Listener) -> str:
    """Why variants do not run in lanes, in words. seconds : what single runs of all of them take, by which machine code may be worth
    compiling."""
    if at_once(task) == 1:
        return "each has a trust report" if task.judge else "they are few, or have a time limit"
    _runs_of(task).look_for_lanes(seconds, listener)
    return _runs_of(task).not_in_lanes


def _with_outputs(ran: Ran, task: Task) -> VariantRun:
    """What is kept, with the outputs unless it failed; failed where functions of the user fail, and with the others all the same. Raises
    ModelError as `run_variant`."""
    run, found = _judged(ran, task) if task.judge else kept_of(ran, _names(task, ran)), ran.result
    if found is None or run.outcome == FAILED:
        return run
    numbers, failures = dict[str, Number](), list[str]()
    for name, output in task.outputs.items():
        try:
            numbers |= outputs_of(found, {name: output})
        except OutputFailedError as error:
            failures.append(str(error))
    told: dict[str, Any] = {"outcome": FAILED, "reason": "; ".join(failures)} if failures else {}
    lacks = [f"{name}, which {number.lacks}" for name, number in numbers.items() if number.doubt]
    reduced = [output.of for name, output in task.outputs.items() if name in numbers and isinstance(output, Reduced)]
    if (
        run.verdict
        and isinstance(found, Result)
        and any(found.selection(name).variable not in RATES for name in reduced)
    ):
        lacks += unseen_between_frames(found)
    if lacks and run.verdict:
        trust = found.trust.of_derived(*lacks)
        told |= {"verdict": trust.light, "verified": trust.verified, "headline": trust.headline}
    return replace(run, outputs=numbers, **told)


class _Last:
    """Runs of the last task: all variants of a study have the same."""

    task: Task | None = None
    runs: Any = None


def _runs_of(task: Task) -> Any:
    """Runs of a task, patched where their numbers follow formulas: `VariantRuns`; with trust reports `JudgedRuns`, or None."""
    if _Last.task is not task:
        patches = formulas_for(task.machine, task.sample, judged=task.judge)[0] if task.sample else None
        _Last.runs = patches and JudgedRuns(patches) if task.judge else VariantRuns(task.machine, patches)
        _Last.task = task
    return _Last.runs


def _names(task: Task, ran: Ran) -> Sequence[str]:
    return task.save or (() if task.outputs or ran.result is None else usual_names(ran.result))


def kept_of(ran: Ran, save: Sequence[str]) -> VariantRun:
    """A run without a trust report, with the histories `save`. Raises ModelError where its result has no such name."""
    if ran.result is None:
        return VariantRun(ran.outcome, ran.reason)
    # the memory of the result is that of the next run
    saved = {name: replace(each, values=each.values.copy()) for name in save for each in [_saved(ran.result, name)]}
    time = ran.result.time.copy() if saved else np.zeros(0)
    end = _end(ran.result)
    return VariantRun(
        ran.outcome, ran.reason, end, loop_seconds=ran.loop_seconds, in_lanes=ran.in_lanes, time=time, saved=saved
    )


def _computed(task: Task, values: Mapping[str, Any]) -> Found:
    """Raises NivelError."""
    machine = task.machine.with_values(values) if values else task.machine
    if task.analysis == "run":
        patched = None if task.verify else _runs_of(task)
        if patched is not None and (found := patched.run(machine, values)) is not None:
            return found
        plan = plan_run(machine.record, machine.origin.settings_outside)
        return simulate(plan, verify=task.verify, verify_limit=ENDLESS if task.verify else None)
    settings = dict(task.settings)
    if task.analysis == "statics":
        settings["verify"] = task.verify
    return analysed(machine, task.analysis, settings)


def _judged(ran: Ran, task: Task) -> VariantRun:
    """What is kept of a variant with its trust report. Raises ModelError as `run_variant`."""
    found = ran.result
    if found is None:
        return VariantRun(ran.outcome, ran.reason, ran.end_time)
    run = VariantRun(ran.outcome, ran.reason, _end(found))
    if isinstance(found, Result):
        run = replace(kept_of(ran, _names(task, ran)), loop_seconds=float(found.timing.get("loop_seconds", 0.0)))
    elif task.save:
        raise ModelError("histories are kept of runs, statics and kinematics; take numbers with `outputs`")
    trust = found.trust
    error = np.nan if trust.accuracy_estimate is None else trust.accuracy_estimate + (trust.elements_estimate or 0.0)
    told = {"verdict": trust.light, "verified": trust.verified, "headline": trust.headline}
    return replace(run, **told, estimated_error=error)


def _end(found: Found) -> float:
    if isinstance(found, LinearModel):
        return found.time
    return float(found.time[-1]) if len(found.time) else 0.0


def _saved(result: Result, name: str) -> Saved:
    """Raises ModelError where the result has no such name."""
    with retold(lambda fault: replace(fault, path="save")):
        found = result.selection(name)
    variable = result.variables[found.variable]
    where = (*found.where, *[slice(None)] * (len(variable.dims) - len(found.where)))
    dims = tuple(dim for dim, each in zip(variable.dims[1:], where[1:], strict=True) if isinstance(each, slice))
    names = {dim: result.coordinates[dim] for dim in dims}
    return Saved(dims, names, result.units(name), variable.long_name, result.array(name))


def study_fingerprint(task: Task, variants: Variants) -> str:
    """Of a sweep."""
    outputs = {name: output.model_dump(mode="json") for name, output in task.outputs.items()}
    return fingerprint(
        task.machine,
        task.analysis,
        sorted(task.settings.items()),
        json.dumps(outputs, sort_keys=True),
        (task.save, task.verify, task.time_limit, task.judge),
        variants.values,
    )


def row_of(run: VariantRun) -> dict[str, Any]:
    """A variant of a sweep as a row."""
    out = {each.name: getattr(run, each.name) for each in fields(run)}
    out["time"] = packed(run.time)
    out["outputs"] = {name: list(number) for name, number in run.outputs.items()}
    out["saved"] = {
        name: [each.dims, dict(each.names), each.units, each.long_name, packed(each.values)]
        for name, each in run.saved.items()
    }
    return out


def run_of(row: Row) -> VariantRun:
    """The variant of a row, to the last bit."""
    outputs = {name: Number(*each) for name, each in row["outputs"].items()}
    saved = {
        name: Saved(
            tuple(dims), {dim: tuple(listed) for dim, listed in names.items()}, units, long_name, unpacked(values)
        )
        for name, (dims, names, units, long_name, values) in row["saved"].items()
    }
    return VariantRun(**{**row, "time": unpacked(row["time"]), "outputs": outputs, "saved": saved})


# facts of every run: attribute of VariantRun, and what it is
FACTS = {
    "outcome": "done, stopped by an event, failed, refused, timed out, killed, or not run",
    "reason": "why it came to no end, or was stopped",
    "end_time": "time reached",
    "verdict": "of the trust report; `not verified` in place of green where not all was verified",
    "verified": "whether a second run, and other elements of beams, estimated the error of the run",
    "headline": "how exact the run is, in a sentence",
    "estimated_error": "estimated largest error of a position",
}
UNITS = {"end_time": "s", "estimated_error": "m"}


def collected(
    variants: Variants,
    runs: Sequence[VariantRun],
    outputs: Mapping[str, Output],
    attributes: Mapping[str, Any],
    facts: Mapping[str, str] = FACTS,
) -> xarray.Dataset:
    """Dimensions of the variants, then time, then those of the variable; NaN where a run did not come. Outputs have no time. facts : of
    every run, and what they are.

    Times are those of the frames that the runs have at their output interval; a last frame beside it is left to `end_time`.
    """
    times = _common_times(runs)
    data: dict[str, Any] = {name: _fact(variants, runs, name, text) for name, text in facts.items()}
    coords: dict[str, Any] = {
        name: (dim, list(values), {"long_name": f"value of {name}"})
        for name, (dim, values) in variants.coordinates.items()
    }
    if len(times):
        coords["time"] = ("time", times, {"units": "s", "long_name": "time"})
    data |= {name: _output(variants, runs, name, each) for name, each in outputs.items()}
    kept: dict[str, VariantRun] = {}
    for run in runs:
        for name in run.saved:
            kept.setdefault(name, run)
    for name, first in kept.items():
        one = first.saved[name]
        coords |= {dim: (dim, list(names)) for dim, names in one.names.items()}
        dims = (*variants.dimensions, "time", *one.dims)
        values = np.full((len(runs), len(times), *one.values.shape[1:]), np.nan)
        for k, run in enumerate(runs):
            if name in run.saved:
                _place(values[k], times, run.time, run.saved[name].values)
        shaped = values.reshape((*variants.shape, *values.shape[1:]))
        data[name] = (dims, shaped, {"units": one.units, "long_name": one.long_name})
    return xarray.Dataset(data, coords=coords, attrs=dict(attributes))


def _fact(variants: Variants, runs: Sequence[VariantRun], name: str, text: str) -> tuple[Any, ...]:
    values = np.array([getattr(run, name) for run in runs])
    units = {"units": UNITS[name]} if name in UNITS else {}
    return variants.dimensions, values.reshape(variants.shape), {"long_name": text, **units}


def _output(variants: Variants, runs: Sequence[VariantRun], name: str, output: Output) -> tuple[Any, ...]:
    """The numbers of an output, with the limits that it has; NaN where there is none."""
    numbers = [run.outputs.get(name) for run in runs]
    values = np.array([np.nan if each is None else each.value for each in numbers])
    facts: dict[str, Any] = {"units": next((each.units for each in numbers if each is not None), "")}
    facts["long_name"] = " ".join(filter(None, (output.type, getattr(output, "of", ""))))
    facts |= {
        key: limit for key, limit in zip(("at_least", "at_most"), output.limits, strict=True) if limit is not None
    }
    return variants.dimensions, values.reshape(variants.shape), facts


def _common_times(runs: Sequence[VariantRun]) -> NDArray[np.float64]:
    """All times of frames, those of one moment once; a last one at which only an event or a failure ended is left out."""
    rows = [run.time for run in runs if len(run.time)]
    if not rows:
        return np.zeros(0)
    longest = max(rows, key=len)
    near = 1e-9 * max(float(longest[-1]), 1e-300)
    every = np.unique(np.concatenate([row[:-1] if row is not longest and len(row) > 1 else row for row in rows]))
    new = np.append(True, np.diff(every) > near)
    return every[new]


def _place(out: NDArray[np.float64], times: NDArray[np.float64], own: NDArray[np.float64], values: Any) -> None:
    """Put frames at their `own` times into `out`, at the nearest of `times`."""
    near = 1e-9 * max(float(times[-1]), 1e-300)
    at = np.clip(np.searchsorted(times, own - near), 0, len(times) - 1)
    fits = np.abs(times[at] - own) <= near
    out[at[fits]] = values[fits]
