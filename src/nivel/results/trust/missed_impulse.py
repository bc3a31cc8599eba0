"""Impulse of loads that the steps of a run have missed, as a line of the report."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Unseen:
    """name : of a function. share : of the integral of its magnitude, over a twentieth of the run, that was missed. At `time` [s] it
    changes by its whole range within `scale` [s], where steps are `step` [s] long. of : what it depends on, the time or a signal.
    hidden : share of the integral of its magnitude over the whole run that was missed where it has more than the steps look at: no finer
    run need see that either."""

    name: str
    share: float
    time: float
    scale: float
    step: float
    of: str = "time"
    hidden: float = 0.0
