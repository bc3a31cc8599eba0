"""A sweep: variants run here while they are quick, else in processes on all processors."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from time import perf_counter
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.progress.interrupt import interruptible
from nivel.analysis.progress.listener import Listener
from nivel.analysis.progress.log import Log
from nivel.analysis.sweep.processes import Job, run_in_processes
from nivel.analysis.sweep.variant import NOT_RUN, VariantRun, run_variant
from nivel.analysis.sweep.variants import Variants
from nivel.analysis.trust.report import assess
from nivel.analysis.trust.subject import Sweep, Variant
from nivel.errors import ModelError
from nivel.model import Model

# facts of every run: attribute of VariantRun, and what it is
FACTS = {
    "outcome": "done, stopped by an event, failed, refused, or not run",
    "reason": "why it was stopped, failed or refused",
    "end_time": "time reached",
    "verdict": "of the trust report; `not verified` in place of green where not all was verified",
    "verified": "whether a second run, and other elements of beams, estimated the error of the run",
    "headline": "how exact the run is, in a sentence",
    "estimated_error": "estimated largest error of a position",
}
UNITS = {"end_time": "s", "estimated_error": "m"}


def collected(variants: Variants, runs: Sequence[VariantRun], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """Dimensions of the variants, then time, then those of the variable; NaN where a run did not come.

    Times are those of the frames that the runs have at their output interval; a last frame beside it is left to `end_time`.
    """
    times = _common_times(runs)
    data: dict[str, Any] = {name: _fact(variants, runs, name) for name in FACTS}
    coords: dict[str, Any] = {
        name: (dim, list(values), {"long_name": f"value of {name}"})
        for name, (dim, values) in variants.coordinates.items()
    }
    if len(times):
        coords["time"] = ("time", times, {"units": "s", "long_name": "time"})
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


def _fact(variants: Variants, runs: Sequence[VariantRun], name: str) -> tuple[Any, ...]:
    values = np.array([getattr(run, name) for run in runs])
    units = {"units": UNITS[name]} if name in UNITS else {}
    return variants.dimensions, values.reshape(variants.shape), {"long_name": FACTS[name], **units}


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


# A process takes about this long to start [s]; what is done sooner is done here.
WORTH_A_PROCESS = 2.0


def sweep(
    machines: Sequence[Model],
    variants: Variants,
    save: tuple[str, ...],
    *,
    verify: bool,
    processes: int,
    listener: Listener,
) -> xarray.Dataset:
    """Run all variants. machines : one for all, with the values of each put in; or one for each, as they are. verify : a second run goes
    beside each.

    The first variant is run here, so that a name in `save` that is none is told at once. Interrupted by Ctrl-C, it returns what was
    computed; the rest is `not run`. Raises ModelError where no variant could start.
    """
    values = variants.values
    jobs: list[Job] = [
        (k, machines[0], values[k]) if len(machines) == 1 else (k, machines[k], {}) for k in range(len(values))
    ]
    runs: list[VariantRun] = [VariantRun(NOT_RUN)] * len(jobs)
    begin, done, loop = perf_counter(), 0, 0.0
    listener.say(f"running {len(jobs)} variants", float(len(jobs)))

    def keep(number: int, run: VariantRun) -> None:
        nonlocal done, loop
        runs[number], done = run, done + 1
        loop += run.loop_seconds
        if listener.progress is not None:
            listener.progress(float(done))

    with interruptible() as interrupted:
        left = _run_here(jobs, save, verify, keep, interrupted, processes)
        if left and not interrupted():
            for number, run in run_in_processes(left, save, verify, processes):
                keep(number, run)
                if interrupted():
                    break
    _refuse_if_none_started(runs)
    trust = assess(_subject(values, runs, interrupted=any(run.outcome == NOT_RUN for run in runs)))
    attributes = {
        "machine": machines[0].name,
        "seconds": perf_counter() - begin,
        "loop_seconds": loop,
        "processes": processes if left else 1,
        "outcomes": ", ".join(f"{count} {outcome}" for outcome, count in Counter(run.outcome for run in runs).items()),
        **trust.attributes(),
    }
    return collected(variants, runs, attributes)


def _subject(values: Sequence[Mapping[str, Any]], runs: Sequence[VariantRun], *, interrupted: bool) -> Sweep:
    """The runs as their trust report sees them."""
    seen = tuple(
        Variant(_named(each), run.outcome, run.reason, run.verdict, run.verified, run.headline)
        for each, run in zip(values, runs, strict=True)
    )
    return Sweep(outcome="interrupted" if interrupted else "done", variants=seen)


def _named(values: Mapping[str, Any]) -> str:
    return ", ".join(f"{path} = {value}" for path, value in values.items())


def _run_here(
    jobs: Sequence[Job],
    save: tuple[str, ...],
    verify: bool,
    keep: Callable[[int, VariantRun], None],
    interrupted: Callable[[], bool],
    processes: int,
) -> Sequence[Job]:
    """Run the first variants, all of them where they are quick. Returns those that are left for processes."""
    for at, (number, machine, values) in enumerate(jobs):
        begin = perf_counter()
        run = run_variant(machine, values, save, verify)
        if run.outcome == NOT_RUN:  # Ctrl-C came
            return ()
        keep(number, run)
        rest = (len(jobs) - at - 1) * (perf_counter() - begin)
        # the first one loads what all need
        if interrupted() or (at and processes > 1 and rest > WORTH_A_PROCESS):
            return jobs[at + 1 :]
    return ()


def _refuse_if_none_started(runs: Sequence[VariantRun]) -> None:
    """Raise ModelError with the reason, where all variants are refused."""
    reasons = {run.reason for run in runs if run.outcome == "refused"}
    if sum(run.outcome == "refused" for run in runs) == len(runs):
        raise ModelError(sorted(reasons)[0])


@contextmanager
def progress_bar(count: int) -> Iterator[Listener]:
    """Says on standard error how many variants are done: a bar, with about how long the rest takes, or plain lines in a file."""
    if not sys.stderr.isatty():
        yield Log().listener
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        task = shown.add_task("variants", total=count)
        yield Listener(None, lambda done: shown.update(task, completed=done))
