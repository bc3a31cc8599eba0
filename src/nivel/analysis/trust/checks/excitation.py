"""Excitation beyond the modes of a flexible body: loads and drivers that vibrate faster than the first mode that it does not have.

Such a load may meet a resonance that the body lacks. Functions of time are looked at through windows of some periods, in which a line of
the spectrum stands out of what surrounds it; steps and pulses have none. A force F of the frequency ω moves a body of the mass m by
F/(m ω²), times 1/2ζ at a resonance, and that counts against how far the body bends.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Curve, varying
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.checks.bending import most_bent
from nivel.analysis.trust.checks.modes import NEAR_LEFT, STRAIGHT, THRESHOLD, Basis, modal_bases
from nivel.analysis.trust.subject import Run
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME
from nivel.results.scales import Readable
from nivel.results.trust import Item, number

Array = NDArray[np.float64]
PERIODS, SAMPLES = (
    32,
    8,
)  # in a window of the frequency at which the modes end; samples in one of four times that frequency
MOST_WINDOWS = 200
LEAST_DAMPING = 0.005  # of critical: structures have no less
LINE = 3.0  # times what surrounds it: above that it is a line


@dataclass(frozen=True)
class Excited:
    """A function whose vibration of `frequency` [Hz] may move the body by the share `share` of what all of it does; the modes of the body
    end at `limit` [Hz]."""

    body: str
    function: str
    frequency: float
    share: float
    limit: float
    time: float


def look(run: Run) -> Excited | None:
    """The line of the functions of a run that goes most beyond the modes of a body."""
    if not run.machine.is_flexible or not float(run.result.time[-1]) > 0.0:
        return None
    bases = modal_bases(run.machine, run.prepared)
    found = [excited for basis in bases for excited in _of_body(run.machine, basis, run.result)]
    return max(found, key=lambda each: each.share, default=None)


def say(excited: Excited) -> Item:
    """What is excited, and what to do."""
    said = (
        f"Modes: {excited.function} vibrates with {number(excited.frequency)} Hz, above {number(excited.limit)} Hz, where the modes of "
        f"{excited.body} end: at a resonance there it would move the body by about {number(excited.share)} of what it does in all; use "
        f"more `modes`"
    )
    return THRESHOLD.item("modes", said, excited.share, excited.time, excited.body)


def _of_body(machine: MachineRecord, basis: Basis, result: Readable) -> Iterator[Excited]:
    body = basis.body
    bent = most_bent(result, body)
    if not len(basis.left.eigenvalues):
        return
    limit = NEAR_LEFT * float(np.sqrt(basis.left.eigenvalues.min())) / (2.0 * np.pi)
    amplification = 0.5 / min(max(basis.damping_ratio, LEAST_DAMPING), 0.5)
    for function in varying(machine):
        if function.curve.signals or not function.of.startswith(("force.", "driver.")):
            continue
        found = _line(function.curve, limit, float(result.time[-1]))
        if found is None:
            continue
        amplitude, frequency, time = found
        # a driver moves the body by its own amplitude, a force by that over its inertia
        slow = 1.0 if function.of.startswith("driver.") else basis.its.I1 * (2.0 * np.pi * frequency) ** 2
        moved, least = amplitude * amplification / slow, STRAIGHT * body.extent
        share = min(moved / max(bent.value * body.extent, least), 1.0)
        yield Excited(body.name, function.name, frequency, share, limit, time)


def _line(curve: Curve, limit: float, end: float) -> tuple[float, float, float] | None:
    """The amplitude of the largest line above `limit` [Hz], its frequency [Hz] and time [s]; None where there is none."""
    window = min(PERIODS / limit, end)
    count = SAMPLES * 4 * PERIODS
    windows = min(MOST_WINDOWS, max(1, int(np.ceil(end / window))))
    begin = np.linspace(0.0, end - window, windows)
    time = begin[:, None] + window * np.arange(count) / count
    values = np.asarray(curve.values({TIME: time.ravel()}), dtype=float).reshape(time.shape)
    if not np.isfinite(values).all():
        return None
    shape = np.hanning(count)
    spectrum = 4.0 / count * np.abs(np.fft.rfft((values - values.mean(axis=1, keepdims=True)) * shape, axis=1))
    frequency = np.arange(spectrum.shape[1]) / window
    above = np.flatnonzero(frequency > limit)
    best: tuple[float, int, int] = (0.0, 0, 0)
    for k in range(windows):
        j = int(above[np.argmax(spectrum[k, above])])
        around = spectrum[k, j // 2 : 2 * j]
        line = float(spectrum[k, j] - LINE * np.median(around))
        if line > best[0]:
            best = line, k, j
    if best[0] <= 0.0:
        return None
    return best[0], float(frequency[best[2]]), float(begin[best[1]])


CHECKS = (Check("excitation", Run, look, say, 304, (STEPS,), "Modes", line="modes", quiet=True),)
