"""A batch: many runs of one machine with other numbers, without trust reports, in the memory and threads of this process."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter
from typing import Final

import xarray

from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import interruptible
from nivel.analysis.sweep.outputs import usual_names
from nivel.analysis.sweep.variant import NOT_RUN, VariantRun, collected, kept_of
from nivel.analysis.sweep.variant_runs import WORTH_FORMULAS, Ran, Values, VariantRuns, formulas_for
from nivel.analysis.sweep.variants import ROW, Variants
from nivel.errors import ModelError
from nivel.lazy import nivel
from nivel.model import Model
from nivel.native.processor import lane_count
from nivel.results.result import Result

FACTS: Final = {
    "outcome": "done, stopped by an event, failed, refused, or not run",
    "reason": "why it was stopped, failed or refused",
    "end_time": "time reached",
}


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
            while left and not interrupted():
                try:
                    first = left.popleft()
                except IndexError:
                    return
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
    refused = [each.reason for each in kept if each.outcome == "refused"]
    if len(refused) == len(kept):
        raise ModelError(sorted(refused)[0])
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
    return collected(variants, kept, {}, attributes, FACTS)


def _first(base: Model, rows: Sequence[Values]) -> Result:
    """The result of the first variant that has one. Raises ModelError where none has."""
    ran = Ran("refused")
    for row in rows:
        ran = VariantRuns(base).run(row)
        if ran.result is not None:
            return ran.result
    raise ModelError(ran.reason)
