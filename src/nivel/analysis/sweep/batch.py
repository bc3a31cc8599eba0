"""A batch: many runs of one machine with other numbers, without trust reports, in the memory and threads of this process."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import interruptible
from nivel.analysis.sweep.outputs import usual_names
from nivel.analysis.sweep.variant_runs import WORTH_FORMULAS, Ran, Values, VariantRuns, formulas_for
from nivel.errors import ModelError
from nivel.lazy import dataclass, field
from nivel.model import Model
from nivel.results.result import Result

Array = NDArray[np.float64]

FACTS: Final = {
    "outcome": "done, stopped by an event, failed, refused, or not run",
    "reason": "why it was stopped, failed or refused",
    "end_time": "time reached",
}


@dataclass
class _Kept:
    """What is kept of a run."""

    outcome: str = "not run"
    reason: str = ""
    time: Array = field(default_factory=lambda: np.zeros(0))
    values: dict[str, Array] = field(default_factory=dict)
    loop_seconds: float = 0.0


def run_batch(
    base: Model, rows: Sequence[Values], save: Sequence[str], *, threads: int, listener: Listener
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
    about = {name: _About.of(first, name) for name in names}
    patches, why = formulas_for(base, rows) if len(rows) >= WORTH_FORMULAS else (None, "there are few variants")
    left, kept = deque(range(len(rows))), [_Kept() for _ in rows]
    done = [0]

    with interruptible() as interrupted:

        def work(_: int) -> None:
            runs = VariantRuns(base, patches)
            while left and not interrupted():
                try:
                    number = left.popleft()
                except IndexError:
                    return
                kept[number] = _keep(runs.run(rows[number]), names)
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
    return _dataset(base, rows, kept, about, {
        "seconds": perf_counter() - begin,
        "loop_seconds": sum(each.loop_seconds for each in kept),
        "patched": int(patches is not None),
        "prepared_because": why,
    })  # fmt: skip


def _first(base: Model, rows: Sequence[Values]) -> Result:
    """The result of the first variant that has one. Raises ModelError where none has."""
    ran = Ran("refused")
    for row in rows:
        ran = VariantRuns(base).run(row)
        if ran.result is not None:
            return ran.result
    raise ModelError(ran.reason)


@dataclass(frozen=True)
class _About:
    """Dimensions behind time with their names, units and meaning of a result."""

    dims: Mapping[str, tuple[str, ...]]
    units: str
    long_name: str

    @classmethod
    def of(cls, result: Result, name: str) -> _About:
        """Raises ModelError where the result has no such name."""
        found = result.selection(name)
        variable = result.variables[found.variable]
        where = (*found.where, *[slice(None)] * (len(variable.dims) - len(found.where)))
        dims = [dim for dim, each in zip(variable.dims[1:], where[1:], strict=True) if isinstance(each, slice)]
        return cls({dim: result.coordinates[dim] for dim in dims}, result.units(name), variable.long_name)


def _keep(ran: Ran, names: Sequence[str]) -> _Kept:
    if ran.result is None:
        return _Kept(ran.outcome, ran.reason)
    values = {name: np.array(ran.result.array(name)) for name in names}
    return _Kept(ran.outcome, ran.reason, np.array(ran.result.time), values, ran.loop_seconds)


def _dataset(
    base: Model, rows: Sequence[Values], kept: Sequence[_Kept], about: Mapping[str, _About], facts: Mapping[str, Any]
) -> xarray.Dataset:
    """One dataset; NaN where a run did not come. Times are those of the longest run."""
    times = max((each.time for each in kept), key=len)
    near = 1e-9 * max(float(times[-1]), 1e-300)
    places = []
    for each in kept:
        at = np.clip(np.searchsorted(times, each.time - near), 0, len(times) - 1)
        # a last frame beside the output interval is left to `end_time`
        fits = np.abs(times[at] - each.time) <= near
        places.append((at[fits], fits))
    data: dict[str, Any] = {
        "outcome": ("variant", np.array([each.outcome for each in kept]), {"long_name": FACTS["outcome"]}),
        "reason": ("variant", np.array([each.reason for each in kept]), {"long_name": FACTS["reason"]}),
        "end_time": (
            "variant",
            np.array([each.time[-1] if len(each.time) else np.nan for each in kept]),
            {"long_name": FACTS["end_time"], "units": "s"},
        ),
    }
    coords: dict[str, Any] = {"time": ("time", times, {"units": "s", "long_name": "time"})}
    for path in rows[0]:
        coords[path] = ("variant", [row[path] for row in rows], {"long_name": f"value of {path}"})
    for name, facts_of in about.items():
        coords |= {dim: (dim, list(labels)) for dim, labels in facts_of.dims.items()}
        shape = tuple(len(labels) for labels in facts_of.dims.values())
        values = np.full((len(rows), len(times), *shape), np.nan)
        for k, (each, (at, fits)) in enumerate(zip(kept, places, strict=True)):
            if name in each.values:
                values[k, at] = each.values[name][fits]
        said = {"units": facts_of.units, "long_name": facts_of.long_name}
        data[name] = (("variant", "time", *facts_of.dims), values, said)
    attributes = {"machine": base.name, "verdict": "", "headline": "not judged: a batch has no trust reports", **facts}
    return xarray.Dataset(data, coords=coords, attrs=attributes)
