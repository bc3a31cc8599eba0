"""Pulses of functions that no frame meets: what a function does between two frames, beyond what the curve through these shows of it."""

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Varying, varying
from nivel.analysis.curves.missed_impulse import SAMPLES, beyond_samples
from nivel.analysis.curves.path import Path, Steps, path_of
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.curve import STENCIL, TOLD, curve
from nivel.results.result import Result
from nivel.results.trust import number

MOST_FRAMES, MOST_SAMPLES = 20_000, 200_000
ROUND_OFF = 1e-9  # of the largest value


class Pulse(Struct):
    """A function that goes `off` beyond what frames show of it, at `time` [s]; `share` of all that it does."""

    name: str
    off: float
    time: float
    share: float

    @property
    def told(self) -> str:
        """In words."""
        return f"a pulse of {self.name} between frames, {number(self.off)} beyond what frames show at t = {self.time:.6g} s"


def largest_pulse(machine: MachineRecord, result: Result) -> Pulse | None:
    """The largest of all functions, by its share; None where frames show them all."""
    begin, length = result.time[:-1], np.diff(result.time)
    frames = Steps(begin[length > 0.0], length[length > 0.0])
    if not STENCIL <= len(frames.begin) <= MOST_FRAMES:
        return None
    found = [
        _pulse_along(each, machine, result, frames) for each in (*varying(machine), *varying(machine, sampled=True))
    ]
    return max(filter(None, found), key=lambda each: each.share, default=None)


def _pulse_along(function: Varying, machine: MachineRecord, result: Result, frames: Steps) -> Pulse | None:
    """Of one function, whose signals are neither straight lines between frames nor splines: the less of what both say."""
    path = None if function.of.startswith("events.") else path_of(function, machine, result)
    found = None if path is None else _pulse(function, path, frames)
    if found is None or path is None or not path.can_curve:
        return found
    other = _pulse(function, replace(path, curved=True), frames)
    return other and min(found, other, key=lambda each: each.share)


def _pulse(function: Varying, path: Path, frames: Steps) -> Pulse | None:
    """What a function has between frames beyond the two on either side and the curve through all."""
    ends = np.append(frames.begin, frames.begin[-1] + frames.length[-1])
    sampling = function.sampling
    if sampling is None:
        at_frames, times, inside, interval = _looked_at(function, path, frames)
    elif sampling.period > 0.0:  # held from sample to sample
        count = min(int((ends[-1] - sampling.offset) / sampling.period), MOST_SAMPLES)
        times = sampling.offset + sampling.period * np.arange(count + 1, dtype=float)
        inside = np.nan_to_num(function.curve.values(path.at(times)))
        at_frames = inside[np.clip(np.searchsorted(times, ends, side="right") - 1, 0, count)]
        interval = np.clip(np.searchsorted(ends, times, side="right") - 1, 0, len(ends) - 2)
    else:
        return None
    off = _beyond(ends, at_frames, times, inside, interval)
    k = int(np.argmax(off))
    largest, extent = float(np.abs(inside).max()), max(float(np.ptp(at_frames)), float(off[k]))
    if not off[k] > max(TOLD * extent, ROUND_OFF * largest):
        return None
    return Pulse(function.name, float(off[k]), float(times[k]), float(off[k]) / extent)


def _looked_at(function: Varying, path: Path, frames: Steps) -> tuple[Array, Array, Array, NDArray[np.intp]]:
    """Values (n + 1,) at frames; times (m,) [s] of samples between them and of features that these miss, values there, and intervals."""
    share = np.arange(SAMPLES + 1)[:, None] / SAMPLES
    time = frames.begin + frames.length * share
    values = np.nan_to_num(function.curve.values(path.at(time.ravel()))).reshape(time.shape)
    places = beyond_samples(function, path, frames, values.T)
    times = np.append(time[1:-1].ravel(), places.time)
    inside = np.append(values[1:-1].ravel(), np.nan_to_num(function.curve.values(path.at(places.time))))
    interval = np.append(np.tile(np.arange(len(frames.begin)), SAMPLES - 1), places.step)
    return np.append(values[0], values[-1, -1]), times, inside, interval


def _beyond(frames: Array, at_frames: Array, times: Array, inside: Array, interval: NDArray[np.intp]) -> Array:
    """(n,) by how much values `inside` are beyond the frames about their interval, and apart from the curve beyond its doubt."""
    beside = at_frames[np.clip(interval + np.arange(-1, 3)[:, None], 0, len(at_frames) - 1)]
    beyond = np.maximum(inside - beside.max(axis=0), beside.min(axis=0) - inside)
    of = curve(frames, at_frames)
    return np.minimum(beyond, np.abs(of.at(times)[:, 0] - inside) - of.doubt_at(times)[:, 0])
