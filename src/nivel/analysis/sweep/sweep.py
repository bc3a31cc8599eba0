"""A sweep: variants run here while they are quick, else in processes on all processors.

A batch: many runs of one machine with other numbers, without trust reports, in the memory and threads of this process.
"""

import sys
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager
from time import perf_counter
from typing import Any, Final

import xarray

from nivel.analysis.progress.journal import Journal
from nivel.analysis.progress.log import Listener, Log, bar_of
from nivel.analysis.progress.pacing import interruptible
from nivel.analysis.sweep import processes as engines
from nivel.analysis.sweep.outputs import Task, usual_names
from nivel.analysis.sweep.patched import WORTH_FORMULAS
from nivel.analysis.sweep.variant import NOT_RUN, VariantRun, collected, kept_of, look_for_lanes, row_of, run_of
from nivel.analysis.sweep.variant_runs import Ran, Values, VariantRuns, formulas_for
from nivel.analysis.sweep.variants import ROW, Variants
from nivel.errors import ModelError
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Sweep, Variant
from nivel.lazy import Struct, nivel, rich
from nivel.model import Model
from nivel.native.processor import lane_count
from nivel.results.result import Result

# A process takes about this long to start [s]; what is done sooner is done here.
WORTH_A_PROCESS = 2.0
Heard = Callable[[int, VariantRun], None]
FACTS_OF_BATCH: Final = {
    "outcome": "done, stopped by an event, failed, refused, or not run",
    "reason": "why it was stopped, failed or refused",
    "end_time": "time reached",
}


class Engine(Struct):
    """Where variants are computed. processes : of this machine. scheduler : address of that of a Dask cluster, instead. apart : none is
    computed in this process, which a variant may end."""

    processes: int
    scheduler: str = ""
    apart: bool = False


def sweep(
    tasks: Sequence[Task],
    variants: Variants,
    engine: Engine,
    *,
    listener: Listener,
    heard: Heard | None = None,
    journal: Journal | None = None,
) -> xarray.Dataset:
    """Compute all variants. tasks : one for all, with the values of each put in; or one for each, whose machine is as it is.

    heard : is told of each variant that is finished. journal : keeps each of them, and has those that were finished before.
    Where variants may run here, the first one does, so that a name in `save` that is none is told at once. Interrupted by Ctrl-C, it
    returns what was computed; the rest is `not run`. Raises ModelError where no variant could start.
    """
    values = variants.values
    jobs: list[engines.Job] = [
        (k, tasks[0], values[k]) if len(tasks) == 1 else (k, tasks[k], {}) for k in range(len(values))
    ]
    runs: list[VariantRun] = [VariantRun(NOT_RUN)] * len(jobs)
    before = {number: run_of(row) for number, row in journal.rows.items()} if journal is not None else {}
    for number, run in before.items():
        runs[number] = run
    jobs = [job for job in jobs if job[0] not in before]
    begin, done, loop, why = perf_counter(), len(before), 0.0, "none was run"
    listener.say(f"running {len(values)} variants", float(len(values)))

    def keep(number: int, run: VariantRun) -> None:
        nonlocal done, loop, why
        if run.outcome == NOT_RUN:
            return
        if not loop and run.loop_seconds:
            why = look_for_lanes(tasks[0], len(jobs) * run.loop_seconds, listener)
        runs[number], done = run, done + 1
        loop += run.loop_seconds
        if journal is not None:
            journal.add(row_of(run), number)
        if heard is not None:
            heard(number, run)
        if listener.progress is not None:
            listener.progress(float(done))

    processes = _compute(jobs, engine, keep)
    _refuse_if_none_started(runs)
    trust = assess(_subject(values, runs, tasks[0], interrupted=any(run.outcome == NOT_RUN for run in runs)))
    attributes = {
        "machine": tasks[0].machine.name,
        "analysis": tasks[0].analysis,
        "seconds": perf_counter() - begin,
        "loop_seconds": loop,
        "processes": processes,
        "in_lanes": sum(run.in_lanes for run in runs) / len(runs),
        "not_in_lanes": why,
        "outcomes": ", ".join(f"{count} {outcome}" for outcome, count in Counter(run.outcome for run in runs).items()),
        **trust.attributes(),
    }
    return collected(variants, runs, tasks[0].outputs, attributes)


def _compute(jobs: Sequence[engines.Job], engine: Engine, keep: Heard) -> int:
    """Compute the variants, and tell of each. Returns the number of processes that took part."""
    with ExitStack() as stack:
        client = stack.enter_context(engines.client_of(engine.scheduler)) if engine.scheduler else None
        interrupted = stack.enter_context(interruptible())
        left: Sequence[engines.Group] = engines.grouped(jobs)
        if client is None and not engine.apart:
            left = _run_here(left, keep, interrupted, engine.processes)
        if not left or interrupted():
            return 1
        found = (
            engines.run_on_cluster([job for group in left for job in group], client)
            if client is not None
            else engines.run_in_processes(left, engine.processes, here=not engine.apart)
        )
        with closing(found):
            for number, run in found:
                keep(number, run)
                if interrupted():
                    break
        return engine.processes if client is None else engines.threads_of(client)


def _subject(
    values: Sequence[Mapping[str, Any]], runs: Sequence[VariantRun], task: Task, *, interrupted: bool
) -> Sweep:
    names = (", ".join(f"{path} = {value}" for path, value in each.items()) for each in values)
    seen = tuple(
        Variant(name, run.outcome, run.reason, run.verdict, run.verified, run.headline)
        for name, run in zip(names, runs, strict=True)
    )
    outcome = "interrupted" if interrupted else "done"
    if not task.judge:
        return Sweep(outcome=outcome, variants=seen, without="no trust report was made of any variant")
    if task.analysis in ("run", "statics"):
        return Sweep(outcome=outcome, variants=seen)
    return Sweep(outcome=outcome, variants=seen, by="checks of each", without="not all of them were checked")


def _run_here(
    groups: Sequence[engines.Group], keep: Heard, interrupted: Callable[[], bool], processes: int
) -> Sequence[engines.Group]:
    """Run the first variants, all of them where they are quick. Returns those that are left for processes."""
    for at, group in enumerate(groups):
        begin = perf_counter()
        for number, run in engines.run_group(group):
            if run.outcome == NOT_RUN:  # Ctrl-C came
                return ()
            keep(number, run)
        rest = (len(groups) - at - 1) * (perf_counter() - begin)
        # the first one loads what all need
        if interrupted() or (at and processes > 1 and rest > WORTH_A_PROCESS):
            return groups[at + 1 :]
    return ()


def _refuse_if_none_started(runs: Sequence[VariantRun]) -> None:
    """Raise ModelError with the reason, where all variants are refused."""
    reasons = {run.reason for run in runs if run.outcome == "refused"}
    if sum(run.outcome == "refused" for run in runs) == len(runs):
        raise ModelError(sorted(reasons)[0])


def run_batch(
    base: Model, rows: Sequence[Values], save: Sequence[str], *, threads: int | None, listener: Listener
) -> xarray.Dataset:
    """All variants, along the dimension `variant`. rows : values by path of each. save : names of results; none: joint coordinates and
    sensors.

    The first variant is run apart, so that a name in `save` that is none is told at once. Interrupted by Ctrl-C, it returns what was
    computed. Raises ModelError where no variant can be run.
    """
    begin = perf_counter()
    listener.say(f"running {len(rows)} variants", float(len(rows)))
    first = _first(base, rows)
    names = tuple(save) or usual_names(first)
    for name in names:
        first.selection(name)
    patches, why = formulas_for(base, rows) if len(rows) >= WORTH_FORMULAS else (None, "there are few variants")
    runs = VariantRuns(base, patches)
    runs.look_for_lanes(len(rows) * float(first.timing.get("loop_seconds", 0.0)), listener)
    threads = threads or nivel.native.workers.processors()
    left, kept = deque(range(0, len(rows), lane_count())), [VariantRun(NOT_RUN)] * len(rows)
    done = [0]

    with interruptible() as interrupted:

        def work(_: int) -> None:
            runs = VariantRuns(base, patches)
            while not interrupted() and (first := engines.next_of(left)) is not None:
                for number, ran in enumerate(runs.run_all(rows[first : first + lane_count()]), first):
                    kept[number] = kept_of(ran, names)
                    done[0] += 1
                    if listener.progress is not None:
                        listener.progress(float(done[0]))

        if threads == 1 or patches is None:
            work(0)
        else:
            with ThreadPoolExecutor(threads) as pool:
                list(pool.map(work, range(threads)))
    _refuse_if_none_started(kept)
    variants = Variants(
        tuple(rows), (ROW,), (len(rows),), {path: (ROW, tuple(row[path] for row in rows)) for path in rows[0]}
    )
    attributes = {
        "machine": base.name,
        "verdict": "",
        "headline": "not judged: a batch has no trust reports",
        "seconds": perf_counter() - begin,
        "loop_seconds": sum(each.loop_seconds for each in kept),
        "patched": int(patches is not None),
        "in_lanes": sum(each.in_lanes for each in kept) / len(kept),
        "not_in_lanes": runs.not_in_lanes,
        "prepared_because": why,
    }
    return collected(variants, kept, {}, attributes, FACTS_OF_BATCH)


def _first(base: Model, rows: Sequence[Values]) -> Result:
    """The result of the first variant that has one. Raises ModelError where none has."""
    ran = Ran("refused")
    for row in rows:
        ran = VariantRuns(base).run(row)
        if ran.result is not None:
            return ran.result
    raise ModelError(ran.reason)


@contextmanager
def progress_bar(count: int) -> Iterator[Listener]:
    """Says on standard error how many variants are done: a bar, with about how long the rest takes, or plain lines in a file."""
    if not sys.stderr.isatty():
        yield Log().listener
        return
    with bar_of(rich.progress.MofNCompleteColumn(), rich.progress.TimeRemainingColumn()) as shown:
        task = shown.add_task("variants", total=count)
        yield Listener(None, lambda done: shown.update(task, completed=done))
