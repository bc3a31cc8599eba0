"""Runs whose steps have become so short that their end is out of reach: where a function of the motion jumps, or it is too fast."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from nivel.analysis.failures.status import Status
from nivel.integrate.loop.run import DONE_STEPS, TAKEN, TIME, WAIT, Run
from nivel.machine.units.tree import Node
from nivel.system.system import System

# A run is looked at after so many steps. It crawls where they were this much shorter than its longest one, and so many are left at least.
LOOKED_AT, SHORT, LEFT = 10_000, 1e-5, 1e7
# The same where a switch turns to and fro: so many steps have made less way than the longest one, and a hundred times as many are left.
SHORT_TO_AND_FRO, LEFT_TO_AND_FRO = 1e-4, 1e6
# Its end is out of reach where so many steps are left, at each of so many looks.
OUT_OF_REACH, OFTEN, TIMES = 1e8, 2_000, 20
# beside a position where the motion branches after so many looks
SOON = 2


@dataclass
class Pace:
    """Steps and time [s] of a run when it was looked at last."""

    steps: int = 0
    time: float = 0.0

    def mean(self, run: Run, least: int) -> float | None:
        """The mean step [s] since then; None where there were fewer than `least`."""
        steps, time = int(run.counter[DONE_STEPS]), float(run.clock[TIME])
        if steps - self.steps < least:
            return None
        mean = (time - self.time) / (steps - self.steps)
        self.steps, self.time = steps, time
        return mean


def to_and_fro(run: Run, system: System) -> tuple[Node, ...]:
    """Functions of the switches that turn to and fro without end, so that the run has let them go."""
    watched = system.record.watched
    waits = run.event_values[WAIT, len(watched.event) + len(watched.surface) :]
    return tuple(system.switching[k] for k in np.flatnonzero(waits))


class Crawl:
    """Whether a run of this duration [s] makes next to no way any more. jumps : some function jumps with the motion. branches : whether
    the motion does, beside the state of a run. system : its equations."""

    def __init__(self, duration: float, jumps: bool, branches: Callable[[Run], bool], system: System) -> None:
        self.duration, self.jumps, self.branches, self.system = duration, jumps, branches, system
        self.since, self.often, self.count = Pace(), Pace(), 0

    def seen(self, run: Run) -> Status | None:
        """Called between chunks of steps; the status with which the run ends, None where it goes on."""
        left = self.duration - float(run.clock[TIME])
        mean = self.since.mean(run, LOOKED_AT) if self.jumps else None
        if mean is not None:
            turning = to_and_fro(run, self.system)
            short, many = (SHORT_TO_AND_FRO, LEFT_TO_AND_FRO) if turning else (SHORT, LEFT)
            if mean < short * float(run.pace[TAKEN].max()) and left > many * mean:
                return Status.CRAWLS
        mean = self.often.mean(run, OFTEN)
        if mean is not None:
            self.count = self.count + 1 if left > OUT_OF_REACH * mean else 0
            if self.count == SOON and self.branches(run):
                return Status.OUT_OF_REACH
        return Status.OUT_OF_REACH if self.count >= TIMES else None


def jump_advice(jumping: tuple[str, ...]) -> str:
    """What to do about functions that jump."""
    few = " and ".join(jumping[:3])
    return (
        f"{few} {'jumps' if len(jumping) == 1 else 'jump'}: where it brings the motion to rest it turns round in every step. "
        f"Dry friction is a force `type: friction` with `model: stiction`, which stands still. Else let it pass smoothly, "
        f"tanh(v/(1 mm/s)) in place of sign(v), or take a fixed step."
    )
