"""How long ticks take and how late they begin: percentiles of the histograms that the loop fills."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from nivel.integrate.paced import (
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
        computing=(*_percentiles(rows[COMPUTING]), 1e-9 * float(control[LONGEST])),
        lateness=(*_percentiles(rows[LATENESS]), 1e-9 * float(control[LATEST])),
        overruns=int(control[OVERRUNS]),
        own=int(control[OWN]),
        stretched=1e-9 * float(control[STRETCHED]),
    )


def _percentiles(counts: np.ndarray) -> tuple[float, ...]:
    """Upper ends of the bins that hold the percentiles [s]: at most 2 % too long."""
    total = counts.sum()
    if not total:
        return (0.0,) * len(PERCENTS)
    places = np.searchsorted(np.cumsum(counts), [np.ceil(total * percent / 100.0) for percent in PERCENTS])
    return tuple(float(1e-9 * FIRST_BIN * np.exp(BIN_WIDTH * (place + 1))) for place in places)


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
    share = 100.0 * timing.computing[3] / timing.tick
    lines.append(
        f"  99.9 % of the ticks cost at most {1e6 * timing.computing[3]:.0f} µs, {share:.1f} % of a tick: "
        f"it would hold {timing.rate_held / 1e3:.3g} kHz"
    )
    return lines
