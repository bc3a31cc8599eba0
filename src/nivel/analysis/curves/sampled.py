"""Functions of time that are looked at in samples only: what they do in between, and no sample sees.

That is no error of a run, as the model itself samples; it is told because hardly anybody means it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Varying, varying
from nivel.analysis.curves.missed_impulse import Unseen
from nivel.analysis.curves.step_limits import with_features
from nivel.machine.laws.functions import Sampling
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME

Array = NDArray[np.float64]
# Places between two samples that are looked at, and samples at most.
PLACES, MOST_SAMPLES = 16, 20_000


def between_samples(machine: MachineRecord, end: float) -> Iterator[Unseen]:
    """Of each sampled function of time alone up to `end` [s]: by how much of its range it goes beyond two samples between them, at most."""
    for function in varying(machine, sampled=True):
        if function.sampling is not None and function.sampling.period > 0.0 and not function.curve.signals:
            found = _beyond(function, function.sampling, end)
            if found is not None:
                yield found


def _beyond(function: Varying, sampling: Sampling, end: float) -> Unseen | None:
    count = min(int((end - sampling.offset) / sampling.period), MOST_SAMPLES)
    if count < 1:
        return None
    samples: Array = sampling.offset + sampling.period * np.arange(count + 1, dtype=np.float64)
    share = np.arange(PLACES) / PLACES
    time = np.append((samples[:-1, None] + sampling.period * share).ravel(), samples[-1])
    time, values = with_features(function.curve, time, np.nan_to_num(function.curve.values({TIME: time})))
    interval = np.clip(np.searchsorted(samples, time, side="right") - 1, 0, count - 1)
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, interval, values)
    np.maximum.at(high, interval, values)
    at_samples = np.nan_to_num(function.curve.values({TIME: samples}))
    beyond = np.maximum(
        high - np.maximum(at_samples[:-1], at_samples[1:]), np.minimum(at_samples[:-1], at_samples[1:]) - low
    )
    span, k = float(np.ptp(values)), int(np.argmax(beyond))
    if not span > 0.0:
        return None
    inside = np.flatnonzero(interval == k)
    slope = float(np.max(np.abs(np.diff(values[inside])) / np.maximum(np.diff(time[inside]), 1e-300), initial=0.0))
    scale = span / slope if slope > 0.0 else sampling.period
    return Unseen(function.name, float(beyond[k]) / span, float(samples[k]), scale, sampling.period)
