"""A sweep: variants run here while they are quick, else in processes on all processors."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

from nivel.analysis.progress.interrupt import interruptible
from nivel.analysis.progress.listener import Listener
from nivel.analysis.progress.log import Log
from nivel.analysis.sweep.processes import Job, run_in_processes
from nivel.analysis.sweep.variant import NOT_RUN, VariantRun, run_variant
from nivel.analysis.sweep.variants import Variants
from nivel.errors import ModelError
from nivel.model import Model

if TYPE_CHECKING:
    import xarray

# A process takes about this long to start [s]; what is done sooner is done here.
WORTH_A_PROCESS = 2.0


def sweep(
    machines: Sequence[Model],
    variants: Variants,
    save: tuple[str, ...],
    *,
    processes: int,
    listener: Listener,
) -> xarray.Dataset:
    """Run all variants. machines : one for all, with the values of each put in; or one for each, as they are.

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
        left = _run_here(jobs, save, keep, interrupted, processes)
        if left and not interrupted():
            for number, run in run_in_processes(left, save, processes):
                keep(number, run)
                if interrupted():
                    break
    _refuse_if_none_started(runs)
    from nivel.analysis.sweep.collect import collected

    attributes = {
        "machine": machines[0].name,
        "seconds": perf_counter() - begin,
        "loop_seconds": loop,
        "processes": processes if left else 1,
        "outcomes": ", ".join(f"{count} {outcome}" for outcome, count in Counter(run.outcome for run in runs).items()),
    }
    return collected(variants, runs, attributes)


def _run_here(
    jobs: Sequence[Job],
    save: tuple[str, ...],
    keep: Callable[[int, VariantRun], None],
    interrupted: Callable[[], bool],
    processes: int,
) -> Sequence[Job]:
    """Run the first variants, all of them where they are quick. Returns those that are left for processes."""
    for at, (number, machine, values) in enumerate(jobs):
        begin = perf_counter()
        run = run_variant(machine, values, save)
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
