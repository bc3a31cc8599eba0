"""Timing of ticks, their length and delay: percentiles of the histograms that the loop fills."""

from __future__ import annotations

import ctypes
import gc
import os
from collections.abc import Mapping
from typing import Final

import numpy as np

from nivel.integrate.loop.paced import (
    BIN_WIDTH,
    BINS,
    COMPUTING,
    FIRST_BIN,
    LATENESS,
    LATEST,
    LONGEST,
    OVERRUNS,
    OWN,
    STRETCHED,
    TICK,
    Live,
)
from nivel.lazy import dataclass

LEAST: Final = 0.005  # share of a part that is worth to be told
PERCENTS: Final = (50.0, 90.0, 99.0, 99.9)


@dataclass(frozen=True)
class Timing:
    """Of ticks in real time: percentiles (50, 90, 99, 99.9) and the maximum of computing time (of the thread) and of lateness [s].

    tick : simulated time of a tick [s]. overruns : ticks that ended after the next deadline, `own` of them because their own computing
    took longer than a tick; the others had to wait for the machine. stretched : by which deadlines were moved in all [s].
    """

    ticks: int
    tick: float
    computing: tuple[float, ...]
    lateness: tuple[float, ...]
    overruns: int
    own: int
    stretched: float

    @property
    def rate_held(self) -> float:
        """Ticks a second that 99.9 % of the computing times would allow."""
        return 1.0 / max(self.computing[3], 1e-9)


def timing_of(live: Live) -> Timing:
    """The timing so far."""
    control = live.control
    rows = live.histogram.reshape(2, BINS).copy()
    return Timing(
        ticks=int(rows[COMPUTING].sum()),
        tick=float(live.clock[TICK]),
        computing=_percentiles(rows[COMPUTING], 1e-9 * float(control[LONGEST])),
        lateness=_percentiles(rows[LATENESS], 1e-9 * float(control[LATEST])),
        overruns=int(control[OVERRUNS]),
        own=int(control[OWN]),
        stretched=1e-9 * float(control[STRETCHED]),
    )


def _percentiles(counts: np.ndarray, longest: float) -> tuple[float, ...]:
    """Upper ends of the bins that hold the percentiles [s]: at most 2 % too long; and the longest."""
    total = counts.sum()
    if not total:
        return (0.0,) * (len(PERCENTS) + 1)
    places = np.searchsorted(np.cumsum(counts), [np.ceil(total * percent / 100.0) for percent in PERCENTS])
    ends = (float(1e-9 * FIRST_BIN * np.exp(BIN_WIDTH * (place + 1))) for place in places)
    return *(min(end, longest) for end in ends), longest


def in_a_sentence(
    machine: str, integrator: str, timing: Timing, parts: Mapping[str, float], rate_held: float | None = None
) -> str:
    """What a tick costs, of which part what share, and what rate [Hz] that would allow; None: that of the timing."""
    held = timing.rate_held if rate_held is None else rate_held
    rate, cost, median = 1.0 / timing.tick, 1e6 * timing.computing[3], 1e6 * timing.computing[0]
    ordered = sorted(((share, name) for name, share in parts.items() if share >= LEAST), reverse=True)
    shared = ", ".join(f"{100.0 * share:.0f} % {name}" for share, name in ordered)
    return (
        f"{machine} at {rate / 1e3:.4g} kHz costs {cost:.0f} µs a tick by {integrator} ({median:.0f} µs in the median"
        f"{f', of which {shared}' if shared else ''}); it would hold {held / 1e3:.3g} kHz"
    )


def in_words(timing: Timing) -> list[str]:
    """The timing in lines for people."""
    if not timing.ticks:
        return ["timing: no tick in real time"]
    lines = [f"timing of {timing.ticks} ticks of {1e3 * timing.tick:.4g} ms ({1.0 / timing.tick:.4g} Hz), in µs:"]
    lines.append("              50 %     90 %     99 %   99.9 %  longest")
    for name, values in (("computing", timing.computing), ("lateness", timing.lateness)):
        lines.append(f"  {name:9s}" + "".join(f"{1e6 * value:9.1f}" for value in values))
    machine = timing.overruns - timing.own
    lines.append(
        f"  overruns: {timing.overruns}, {timing.own} by own computing, {machine} by the machine; "
        f"time stretched by {1e3 * timing.stretched:.4g} ms in all"
    )
    return lines


LOCK_ALL: Final = 3  # MCL_CURRENT | MCL_FUTURE
PRIORITY: Final = 10  # of SCHED_FIFO, 1 … 99


def clock_addresses() -> tuple[int, int]:
    """Addresses of clock_gettime and clock_nanosleep."""
    library = ctypes.CDLL(None)
    functions = (library.clock_gettime, library.clock_nanosleep)
    first, second = (ctypes.cast(each, ctypes.c_void_p).value or 0 for each in functions)
    return first, second


def become_urgent() -> list[str]:
    """Ask for real-time priority and locked memory, and stop collecting garbage. Returns in words what was given and what was not."""
    gc.collect()
    gc.freeze()
    gc.disable()
    return [_priority(), _locked_memory()]


def _priority() -> str:
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except (AttributeError, OSError) as problem:
        return f"no real-time priority ({getattr(problem, 'strerror', None) or 'unknown here'})"
    return f"real-time priority {PRIORITY} (SCHED_FIFO)"


def _locked_memory() -> str:
    try:
        library = ctypes.CDLL(None, use_errno=True)
        done = library.mlockall(LOCK_ALL) == 0
    except (OSError, AttributeError):
        return "memory not locked (unknown here)"
    return "memory locked" if done else f"memory not locked ({os.strerror(ctypes.get_errno())})"
