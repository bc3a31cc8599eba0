"""Probes of an analysis: its numbers at irregular times that are no frames, against the curves between its frames.

A vibration with whole periods between two frames looks like rest in all of them. No number of periods fits the times of probes.
"""

from collections.abc import Iterable, Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.integrate.loop.run import EVERY, HORIZON, SHOWN, TIME, Run
from nivel.integrate.loop.sink import Header
from nivel.kernels.output.observe import observe
from nivel.machine.core.vectors import Array
from nivel.results.curve import RATES, ROUNDED, STENCIL, TOLD, Curve, curve, hermite
from nivel.system.layout import FrameLayout

# Probes of a run, and frames about each that make its curve.
PROBES, NEAR = 32, 10
GOLDEN = 0.5 * (sqrt(5.0) - 1.0)
# Numbers that frames have otherwise than the state last evaluated, or with another sign.
APART = ("orientation", "constraint_", "energy_error")
SHARED = ("joint_force", "joint_torque")


class Probes:
    """A sink that keeps the last frames, and holds probes against the curves through them.

    off (width,) : by how much numbers were apart from their curves between frames, beyond the doubt of these; low, high (width,) : bounds
    of all frames.
    """

    def __init__(self, motion: MotionEquations, times: Iterable[float], taken: Sequence[Array] = ()) -> None:
        """times : of probes [s], ascending. taken : frames at other times, which are probes."""
        self.motion, self._layout = motion, motion.system.layout
        layout = self._layout
        self._frames, self._waiting = np.zeros((0, layout.width)), list(taken)
        self.off = np.zeros(layout.width)
        self.low, self.high = np.full(layout.width, np.inf), np.full(layout.width, -np.inf)
        self._times = iter([*times, np.inf])
        self._next, self._horizon = next(self._times), np.inf
        self._known, self._rate = _rates(layout)

    @classmethod
    def of(cls, motion: MotionEquations, run: Run, duration: float) -> "Probes | None":
        """Those of a run; None where every step is a frame, or what frames show is not what steps evaluate."""
        steered = bool(np.any(motion.system.record.control.stabilise[:2]))
        times = np.sort(duration * np.modf(GOLDEN * np.arange(1, PROBES + 1))[0])
        return None if run.counter[EVERY] == 1 or steered else cls(motion, times.tolist())

    def begin(self, header: Header) -> None:
        """The layout is known."""

    def is_due(self, run: Run) -> bool:
        """Whether the run has come to the time of the next probe."""
        return bool(run.clock[TIME] >= self._next)

    def before(self, run: Run) -> None:
        """Called before steps: they end at the time of the next probe."""
        self._horizon = float(run.clock[HORIZON])
        run.clock[HORIZON] = min(self._horizon, self._next)

    def after(self, run: Run) -> None:
        """Called after steps."""
        run.clock[HORIZON] = self._horizon

    def look(self, run: Run) -> None:
        """Take a probe of the accepted state, which is the one last evaluated, if it is due and not a frame."""
        t = float(run.clock[TIME])
        if not self.is_due(run):
            return
        while self._next <= t:
            self._next = next(self._times)
        if t != run.clock[SHOWN]:
            frame = np.zeros(self._layout.width)
            frame[0] = t
            observe(self.motion.handle.address, t, run.y, frame)
            self._waiting.append(frame)

    def take(self, frames: Array) -> None:
        """Frames, in the order of time."""
        self.low = np.minimum(self.low, frames.min(axis=0))
        self.high = np.maximum(self.high, frames.max(axis=0))
        self._frames = np.concatenate([self._frames, frames])
        self._compare(NEAR // 2)
        kept = len(self._frames) - NEAR
        if self._waiting:
            kept = min(kept, int(np.searchsorted(self._frames[:, 0], self._waiting[0][0])) - NEAR // 2)
        self._frames = self._frames[max(kept, 0) :].copy()

    @np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is no warning
    def close(self) -> dict[str, list[float]]:
        """By variable what its numbers were apart from their curves, beyond what is little beside their range, and round-off."""
        self._compare(1)
        off = np.where(self.off > np.maximum(TOLD * (self.high - self.low), self._round_off()), self.off, 0.0)
        return {
            each.name: off[each.columns].tolist()
            for each in self._layout.variables
            if not each.name.startswith(APART) and off[each.columns].any()
        }

    def _round_off(self) -> Array:
        """(width,) that of numbers beside the largest in the same units, and what the machine would do in the time of the run."""
        system, sizes = self.motion.system, np.maximum(np.abs(self.low), np.abs(self.high))
        size, mass, time = system.size, float(system.record.bodies.mass.sum()), max(float(self.high[0]), 1e-100)
        largest = {
            "m": size,
            "m/s": size / time,
            "rad/s": 1.0 / time,
            "m/s^2": size / time**2,
            "rad/s^2": 1.0 / time**2,
        }
        force = mass * size / time**2
        largest |= {"N": force, "N m": force * size, "J": force * size, "W": force * size / time}
        for each in self._layout.variables:
            most = float(np.max(sizes[each.columns], initial=0.0, where=np.isfinite(sizes[each.columns])))
            largest[each.units] = max(largest.get(each.units, 0.0), most)
        out = np.zeros(self._layout.width)
        for each in self._layout.variables:
            out[each.columns] = ROUNDED * largest[each.units]
        return out

    def _compare(self, later: int) -> None:
        """Compare the probes that have so many frames behind them."""
        time, ready = self._frames[:, 0], list[Array]()
        while self._waiting and np.searchsorted(time, self._waiting[0][0]) + later <= len(time):
            ready.append(self._waiting.pop(0))
        if not ready:
            return
        probes = np.array(ready)
        place = np.searchsorted(time, probes[:, 0])
        if place[-1] - place[0] <= NEAR * len(ready):
            self._hold(self._frames[max(0, place[0] - NEAR // 2) : place[-1] + NEAR // 2], probes)
            return
        # pieces about each probe, those that are whole and without a jump together
        pieces = place + np.arange(-NEAR // 2, NEAR // 2)[:, None]
        whole = (pieces[0] >= 0) & (pieces[-1] < len(time))
        whole[whole] = np.all(np.diff(time[pieces[:, whole]], axis=0) > 0.0, axis=0)
        if whole.any():
            self._hold(self._frames[pieces[:, whole]], probes[whole])
        for k in np.flatnonzero(~whole):
            self._hold(self._frames[max(0, place[k] - NEAR // 2) : place[k] + NEAR // 2], probes[k : k + 1])

    @np.errstate(over="ignore", invalid="ignore")
    def _hold(self, near: Array, probes: Array) -> None:
        """Compare some (k, width) with a curve through frames (n, width), or each in the middle of its own (n, k, width). What is between
        the four frames next to one is no more than a jump."""
        time, together = probes[:, 0], near.ndim == 2
        place = np.searchsorted(near[:, 0], time) if together else np.full(len(time), NEAR // 2)
        inside = (place > 0) & (place < len(near))
        where = np.clip(place + np.arange(-2, 2)[:, None], 0, len(near) - 1)
        beside = near[where] if together else near[where[:, 0]]
        beyond = np.maximum(probes - beside.max(axis=0), beside.min(axis=0) - probes)
        for columns, rate in ((self._known, near[..., self._rate]), (~self._known, None)):
            of = curve(near[..., 0], near[..., columns], rate)
            value, doubt = (of.at(time), of.doubt_at(time)) if together else _in_the_middle(of, time)
            # the doubt of so few frames that no polynomial goes through them is none that is known better than by probes
            doubt = doubt if len(near) >= STENCIL else 0.0
            off = np.minimum(np.abs(value - probes[:, columns]) - doubt, beyond[:, columns])
            off = np.max(np.nan_to_num(off[inside]), axis=0, initial=0.0)
            self.off[columns] = np.maximum(self.off[columns], off)


def _in_the_middle(of: Curve, time: Array) -> tuple[Array, Array]:
    """Value and doubt (k, m) at one time in the middle interval of each of k pieces."""
    k = NEAR // 2 - 1
    step = of.time[k + 1] - of.time[k]
    share = ((time - of.time[k]) / step)[:, None]
    value = hermite(share, step[:, None], *(each[k] for each in of.corners))
    return value, np.where((share > 0.0) & (share < 1.0), of.doubt[k], 0.0)


def _rates(layout: FrameLayout) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Which columns of a frame have rates, and the columns of these."""
    known, place = np.zeros(layout.width, dtype=bool), np.zeros(layout.width, dtype=np.intp)
    columns = {each.name: each.columns for each in layout.variables}
    for name, rate in RATES.items():
        if name in columns and rate in columns:
            known[columns[name]] = True
            place[columns[name]] = np.arange(columns[rate].start, columns[rate].stop)
    return known, place[known]
