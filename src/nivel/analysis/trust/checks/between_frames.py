"""Peaks between the frames of a run: how much larger forces, reactions, pressures and sensors may be than any stored number."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Run
from nivel.results.frames.loads import FEW, frames_of_a_swing, hidden_between_frames
from nivel.results.result import Result
from nivel.results.trust import Item, number

# a peak that may be larger by this share is told; below it plots and tables show it
HIDDEN = 0.05
# frames that are looked at, at most
MOST = 20_000
LOADS = ("force.", "driver.", "sensor.", "hydraulics.")


@dataclass(frozen=True)
class Hidden:
    """The number whose peak frames may hide most of, as a share of its largest stored value; or that has fewer frames from one reversal to
    the next than show peaks."""

    name: str
    share: float
    frames: float


def look(run: Run) -> Hidden | None:
    """The worst of all loads and sensors."""
    result, worst = run.result, Hidden("", HIDDEN, np.inf)
    if len(result.time) > MOST:
        return None
    few = worst
    for name, history in _histories(result):
        share, frames = hidden_between_frames(history), frames_of_a_swing(history)
        if np.isfinite(share) and share > worst.share:
            worst = Hidden(name, share, frames)
        if frames < min(FEW, few.frames):
            few = Hidden(name, share, frames)
    return few if few.name else worst if worst.name else None


def _histories(result: Result) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Names and histories (t, 1)."""
    for name in ("joint_force", "joint_torque"):
        if name in result.variables:
            size = np.linalg.norm(result.array(name), axis=2)
            floor = 1e-9 * float(np.max(size, initial=0.0))
            for joint, history in zip(result.coordinates["joint"], size.T, strict=True):
                if history.max(initial=0.0) > floor:
                    yield f"{joint}.{name.removeprefix('joint_')}", history[:, None]
    for name, variable in result.variables.items():
        # numbers without units are shares, directions and marks of what sticks
        if name.startswith(LOADS) and variable.dims == ("time",) and result.units(name) not in ("", "1"):
            history = np.asarray(result.array(name), dtype=float)
            if np.ptp(history) > 1e-9 * np.max(np.abs(history), initial=0.0):
                yield name, history[:, None]


def say(found: Hidden) -> Item:
    """The line is green: the stored numbers are right."""
    if found.frames < FEW:
        why = f"{found.name} has {number(found.frames)} frames from one reversal to the next"
    else:
        why = f"that of {found.name} may be {number(100.0 * found.share)} % larger than any stored number"
    said = f"Not examined: peaks, work and cycles between frames: {why}; a shorter output_interval shows them"
    return Item("unexamined", "green", said, row=found.name)


CHECKS = (Check("between_frames", Run, look, say, 914, (FRAMES,), "Peaks between frames", line="unexamined"),)
