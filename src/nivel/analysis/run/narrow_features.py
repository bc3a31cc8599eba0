"""Narrow features of functions of the motion where steps are chosen: a stretch of steps that passes one is done again, shorter there.

An estimate of the error knows a function at the places where the method looks. Bounds of the functions over the intervals of a stretch find
what lies between them: a point of a table, a pulse of an expression. Then the run goes back to the begin of the stretch, and its steps near
there are no longer than the feature, so that the estimate sees it; what it asks for then is its own. Where that would be too many steps the
run goes on as it is, and *Loads* of the trust report tells.

Stretches are counted in steps, so that the motion is the same however a run is cut into chunks.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.curves.functions import LawCurve, SideOf, Varying, varying
from nivel.analysis.curves.missed_impulse import BEYOND, beyond_samples, sampled_densely
from nivel.analysis.curves.path import Path, Steps, as_seen, path_of
from nivel.analysis.preparation.memory import arrays_of
from nivel.analysis.preparation.preparation import Prepared
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import DONE_STEPS, EVENTS, FRAMES, HORIZON, INTERVAL, TIME, Run
from nivel.integrate.loop.sink import Header
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result

# Steps of the first stretch, and of the longest one; each is twice as long as the one before. Frames of one, about.
FIRST, LONGEST, MOST_FRAMES = 8, 512, 20_000
# Places in a step that are looked at, a multiple of four; how often a stretch is done again.
SAMPLES, MOST_ROUNDS = 8, 12
# Between two frames a signal that grows from rest passes a value later by this share of their distance than a straight line does.
LATER = 0.25
# A stretch is seen at times no further apart than this share of the duration.
SEEN = 1.0 / 512.0
# Steps that features may ask for in a run; a feature shorter than this share of the duration is none that steps can meet.
MOST_STEPS, SHORTEST = 200_000, 1e-12


def remembered(run: Run, motion: MotionEquations) -> list[NDArray[Any]]:
    """Every array of the run and of the record but the buffer of frames and the addresses of machine code."""
    twin = () if motion.twin is None else arrays_of(motion.twin.record)
    own = [array for name, array in run._asdict().items() if name != "frames"]
    every = [*own, *arrays_of(motion.system.record), *twin]
    return [array for array in every if array.size and array.dtype != np.uint64]


class NarrowFeatures:
    """Looks at each stretch of a run, and keeps its frames and events until it may stand.

    functions : those that the motion depends on. impulses : of functions by name the largest integral of the magnitude over a step that
    passed a feature. hurried : names of those whose search would have taken longer than the steps.
    """

    def __init__(
        self, functions: tuple[Varying, ...], machine: MachineRecord, motion: MotionEquations, facts: IntegratorFacts
    ) -> None:
        self._functions, self._machine, self._motion, self._facts = functions, machine, motion, facts
        self._duration = machine.simulation.duration
        self._windows: list[tuple[float, float, float]] = []
        self._asked = 0.0
        self._header = Header(motion.system.layout, {})
        self._kept: list[NDArray[np.generic]] | None = None
        self._begin, self._first, self._length, self._rounds = 0.0, 0, FIRST, 0
        self._until = self._horizon = np.inf
        self._frames: list[Array] = []
        self._events: list[Array] = []
        self._every, self._count = 0, 0
        self._before = np.zeros((0, motion.system.layout.width))
        self._largest: dict[str, float] = {}
        self.impulses: dict[str, float] = {}
        self.hurried: set[str] = set()
        self._ends: list[Array] = [np.zeros(1)]

    @classmethod
    def of(cls, prepared: Prepared, ends: int) -> "NarrowFeatures | None":
        """Those of a machine; None where nothing can have any, or the run does not keep the `ends` of its steps."""
        if prepared.machine is None or not ends:
            return None
        return cls(narrow_functions(prepared.machine), prepared.machine, prepared.motion, prepared.integrator)

    def follow(self, prepared: Prepared) -> None:
        """The run goes on with another integrator, after a stretch."""
        self._motion, self._facts = prepared.motion, prepared.integrator

    def before(self, run: Run, budget: int) -> int:
        """Called before steps: the steps until a stretch is whole, `budget` at most."""
        if not self._every:
            self._every = 2 ** max(0, int(np.ceil(np.log2(run.clock[INTERVAL] / (SEEN * self._duration)))))
            run.clock[INTERVAL] /= self._every
        if self._kept is None:
            self._kept = [array.copy() for array in remembered(run, self._motion)]
            self._begin, self._first = float(run.clock[TIME]), int(run.counter[DONE_STEPS])
        self._horizon = float(run.clock[HORIZON])
        run.clock[HORIZON] = min(self._horizon, self._until)
        return min(budget, self._first + self._length - int(run.counter[DONE_STEPS]))

    def hold(self, run: Run) -> None:
        """Called after steps: take the frames and events that they gave."""
        frames, events = int(run.counter[FRAMES]), int(run.counter[EVENTS])
        self._frames.append(run.frames[:frames].copy())
        self._events.append(run.events[:events].copy())
        run.counter[FRAMES] = run.counter[EVENTS] = 0
        run.clock[HORIZON] = self._horizon

    def is_whole(self, run: Run, *, goes_on: bool) -> bool:
        """Whether a stretch has been done, or the run has ended."""
        is_done = int(run.counter[DONE_STEPS]) >= self._first + self._length or run.clock[TIME] >= self._until
        return is_done or not goes_on

    def stands(self, run: Run, *, goes_on: bool) -> bool:
        """Whether the stretch that was done may stand; if not, the run is where it began, with shorter steps in front of it."""
        if self._rounds >= MOST_ROUNDS or not self._narrowed(run, goes_on):
            self._rounds = 0
            return True
        self._rounds += 1
        assert self._kept is not None
        for array, kept in zip(remembered(run, self._motion), self._kept, strict=True):
            array[...] = kept
        self._set(run)
        self._frames, self._events = [], []
        return False

    @property
    def ends(self) -> Array:
        """(n,) [s] the start, and the ends of all steps that stand."""
        return np.concatenate(self._ends)

    def released(self, run: Run, *, goes_on: bool) -> tuple[Array, Array]:
        """The frames (n, width) that were asked for and events (m, 3) of the stretch, which is over."""
        frames = np.concatenate([self._before[:0], *self._frames])
        is_wanted = (self._count + np.arange(len(frames))) % self._every == 0
        self._count += len(frames)
        events = np.concatenate([np.zeros((0, 3)), *self._events])
        if self._kept is not None:
            share = max(1.0, len(frames) / self._length)
            longer = self._length if np.isfinite(self._until) else 2 * self._length
            self._length = max(1, min(longer, LONGEST, int(MOST_FRAMES / share)))
        if len(frames):
            self._before = frames[-1:]
            is_wanted[-1] |= not goes_on
        steps = self._steps(run)
        if steps is not None:
            self._ends.append(steps.begin + steps.length)
        self._kept, self._frames, self._events, self._until = None, [], [], np.inf
        self._windows = [each for each in self._windows if each[1] > run.clock[TIME]]
        self._set(run)
        return frames[is_wanted], events

    def _set(self, run: Run) -> None:
        run.windows[:] = np.inf
        if self._windows:
            run.windows[: len(self._windows)] = self._windows

    def _narrowed(self, run: Run, goes_on: bool) -> bool:
        """Whether the stretch has passed features unseen; steps are limited there."""
        steps, result = self._steps(run), self._seen(run, goes_on)
        if steps is None or len(result.time) < 2:
            return False
        steps = steps.until(float(result.time[-1]))
        found = []
        for function in self._functions:
            path = path_of(function, self._machine, result)
            if path is not None:
                found += self._passed(function, path, steps)
        if not found:
            return False
        # what comes later comes otherwise, as the first one changes the motion
        first = min(found)
        self._asked += (first[1] - first[0]) / first[2]
        if self._asked > MOST_STEPS or len(self._windows) == len(run.windows):
            return False
        self._windows.append(first)
        self._until = first[1]
        return True

    def _steps(self, run: Run) -> Steps | None:
        """Those of the stretch; None where there are none."""
        numbers = np.arange(self._first + 1, int(run.counter[DONE_STEPS]) + 1)
        times = np.append(self._begin, run.ends[numbers % len(run.ends)])
        return Steps(times[:-1], np.diff(times)) if len(numbers) else None

    def _seen(self, run: Run, goes_on: bool) -> Result:
        """The stretch as a result: the last frame before it, its frames, and its end."""
        frames = [self._before, *self._frames]
        t, motion = float(run.clock[TIME]), self._motion
        last = np.zeros((1, motion.system.layout.width))
        if goes_on and motion.holds(t, run.y):
            last[0, 0] = t
            observe(motion.handle.address, t, run.y, last[0])
            frames.append(last)
        every = np.concatenate(frames)
        later = np.diff(every[:, 0], prepend=-np.inf) > 0.0
        return Result(MemoryContents(self._header, every[later], {}))

    def _passed(self, function: Varying, path: Path, steps: Steps) -> list[tuple[float, float, float]]:
        """The window of time [s], with the longest steps in it [s], of the first feature of a function that steps have passed."""
        is_side = isinstance(function.curve, SideOf)
        values = _sampled(function, path, steps)
        largest = max(self._largest.get(function.name, 0.0), float(np.abs(values).max()))
        self._largest[function.name] = largest
        places = beyond_samples(function, path, steps, _known(function, values), largest)
        self.hurried |= set() if places.whole else {function.name}
        passed = places.step
        if is_side:
            passed = np.union1d(passed, np.flatnonzero(np.count_nonzero(np.diff(values, axis=1), axis=1) > 1))
        else:
            off = np.abs(values - as_seen(values, steps, self._facts)).max(axis=1)
            passed = np.union1d(passed, np.flatnonzero(off > BEYOND * largest))
        margin = LATER * float(np.diff(path.time).max())
        for k in np.unique(passed):
            step = Steps(steps.begin[k : k + 1], steps.length[k : k + 1])
            found = _feature(function, path, step, largest)
            # straight lines between frames make bumps of small differences of large terms, which a spline does not
            if found is None or (
                path.can_curve and _feature(function, replace(path, curved=True), step, largest) is None
            ):
                continue
            self.impulses[function.name] = max(self.impulses.get(function.name, 0.0), found.impulse)
            short = 0.5 * min(found.width, float(steps.length[k]))
            if short > SHORTEST * self._duration:
                return [(found.begin - margin - short, found.end + margin + short, short)]
        return []


def narrow_functions(machine: MachineRecord) -> tuple[Varying, ...]:
    """The functions of signals on which a motion depends and of which bounds are known; of events their sides."""
    return tuple(
        replace(each, curve=SideOf(each.curve)) if each.of.startswith("events.") else each
        for each in varying(machine)
        if each.curve.signals and not isinstance(each.curve, LawCurve) and not each.of.startswith("sensors.")
    )


class Feature(Struct):
    """What a function does first beyond its values at the ends of a step: begin and end [s], for which time it is there by half of that,
    `width` [s], and the impulse of the function over the step."""

    begin: float
    end: float
    width: float
    impulse: float


def _sampled(function: Varying, path: Path, steps: Steps) -> Array:
    """(n, SAMPLES + 1) values over steps."""
    time = steps.begin + steps.length * (np.arange(SAMPLES + 1)[:, None] / SAMPLES)
    return np.nan_to_num(function.curve.values(path.at(time.ravel()))).reshape(time.shape).T


def _known(function: Varying, values: Array) -> Array:
    """Those of the values that a run knows: an event is seen at the ends of steps alone."""
    return values[:, [0, -1]] if isinstance(function.curve, SideOf) else values


def _feature(function: Varying, path: Path, step: Steps, largest: float) -> Feature | None:
    """The first feature in one step; None where the function does not go beyond its values at the ends by a share of `largest`: there it
    has a corner or a jump, which the ends of the step show."""
    known = _known(function, _sampled(function, path, step))
    places = beyond_samples(function, path, step, known, largest)
    time, values = sampled_densely(function, path, float(step.begin[0]), float(step.length[0]), places.time)
    if isinstance(function.curve, SideOf):
        return _first_pass(time, values)
    low, high = min(values[0], values[-1]), max(values[0], values[-1])
    beyond = np.maximum(values - high, low - values)
    if not beyond.max() > BEYOND * largest:
        return None
    first = int(np.argmax(beyond > BEYOND * beyond.max()))
    back = beyond[first:] <= BEYOND * beyond.max()
    last = first + int(np.argmax(back)) if back.any() else len(time) - 1
    first = max(first - 1, 0)
    is_half = np.flatnonzero(beyond[first : last + 1] > 0.5 * beyond[first : last + 1].max()) + first
    width = time[min(is_half[-1] + 1, len(time) - 1)] - time[max(is_half[0] - 1, 0)]
    return Feature(float(time[first]), float(time[last]), float(width), float(np.trapezoid(np.abs(values), time)))


def _first_pass(time: Array, sides: Array) -> Feature | None:
    """What lies between the first two changes of a side; None where it changes once."""
    change = np.flatnonzero(np.diff(sides) != 0.0)
    if len(change) < 2:
        return None
    begin, end = float(time[change[0]]), float(time[change[1] + 1])
    return Feature(begin, end, end - begin, 0.0)
