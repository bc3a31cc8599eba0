"""The runs of a sweep as one xarray dataset. Only this file imports xarray."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.sweep.variant import VariantRun
from nivel.analysis.sweep.variants import Variants

# facts of every run: attribute of VariantRun, and what it is
FACTS = {
    "outcome": "done, stopped by an event, failed, refused, or not run",
    "reason": "why it was stopped, failed or refused",
    "end_time": "time reached",
    "verdict": "of the trust report",
}


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
    units = {"units": "s"} if name == "end_time" else {}
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
