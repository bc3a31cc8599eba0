"""Slopes of a run: the curves of its result and their derivatives, by runs on dual numbers, LANES parameters at a time.

Seeds of gradients: slopes of all numbers of a record along parameters of the machine, from machines built beside it.
Every number that follows from a parameter moves with it, those that are derived too: the assembled start, the frames of bodies,
factors of inertias. Most follow laws, whose slopes are exact. A start that is assembled is smooth in the numbers of a file, and known to
round-off, or to what the assembly and an equilibrium are closed to: differences of order four over a wide step leave little of that. Where
the machine cannot be built so far away, or is not smooth there, the step is narrow.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.gradients.outputs import Array, Moving, Output, Parameter, Reduce, Reduced, value_of
from nivel.analysis.plan.compilation import build
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.memory import MachineMemory, UnlikeError, arrays_of
from nivel.analysis.preparation.parameters import Sample, Unfit, UnfitError, numbers_of
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import interruptible
from nivel.analysis.run.dynamics import GOES_ON, Loop, LoopOnNumbers, on_numbers
from nivel.errors import Fault, ModelError, NivelError, SolveError, refuse
from nivel.integrate.loop.run import BUDGET, EVENTS, FRAMES, OPEN_LIMIT, TIME
from nivel.integrate.loop.sink import Header
from nivel.kernels.core.arrays import whole_twin
from nivel.kernels.core.status import BUDGET_SPENT, DONE
from nivel.kernels.record.record import Record
from nivel.native.duals import DUAL, LANES
from nivel.results.curve import DOUBT, curve, curve_of
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.system.laws.laws import dual_address


def whole_of(used: Record) -> Record:
    """A machine's record on dual numbers, without slopes yet."""
    twin = whole_twin(used)
    # what the twin by which Newton's matrix is found shares: elements that hold sliders, whether contacts keep their side
    twin = twin._replace(
        tree=twin.tree._replace(element=used.tree.element),
        watched=twin.watched._replace(followed=used.watched.followed),
    )
    return on_numbers(used, "whole", twin, [dual_address(int(each)) if each else 0 for each in used.functions.address])


class WholeLoop(LoopOnNumbers):
    """A loop on dual numbers, without slopes yet."""

    def __init__(self, loop: Loop) -> None:
        super().__init__(loop, "whole", whole_of(loop.machine.record), whole_twin(loop.history.record))


# parameters of the machines beside are away from their own values by these shares of their scales, and twice as far: wide, narrow
WIDE, NARROW = 1e-3, 1e-5
# Differences over a step and over two are the same but for this share of the largest where a record is smooth; and what is round-off of
# them, as a share of the numbers.
SMOOTH, ROUND_OFF = 1e-2, 1e-6
TURNS = ((WIDE, ((-1.0, 1.0), (-2.0, 2.0))), (NARROW, ((-1.0, 1.0),)))

# slopes of all arrays of records, as those of a loop, in their order
Seeds = list[Array]
Beside = Callable[[Parameter, float], MachineMemory]


def seeds_of(memory: MachineMemory, parameters: Sequence[Parameter], beside: Beside) -> list[Seeds]:
    """Slopes of the numbers of records along each parameter, for a change by its scale.

    beside(parameter, value) : those of the machine with another value, built in the same way. Raises ModelError with every parameter
    with which the machine changes otherwise than in numbers.
    """
    faults, out = list[Fault](), list[Seeds]()
    for each in parameters:
        values = [
            [[each.value + side * aside * each.scale for side in turn] for turn in turns] for aside, turns in TURNS
        ]
        x = np.array([each.value])
        try:
            numbers = numbers_of(
                memory, x, [values], lambda _, value, each=each: beside(each, value), partial(_is_smooth, memory)
            )
        except UnfitError as error:
            faults += _faults(error.args[0], each)
            continue
        slopes = np.zeros(len(memory.numbers))
        slopes[numbers.places] = numbers.slopes(x)[:, 0] * each.scale
        out.append(memory.arrays_of(np.where(np.isfinite(slopes), slopes, 0.0)))
    refuse(faults)
    return out


def seed(seeds: Sequence[Seeds], *records: Any) -> None:
    """Give the numbers of records their slopes, a lane for each of LANES seeds at most."""
    twins = [array for record in records for array in arrays_of(record)]
    for lane, slopes in enumerate(seeds):
        for dual, slope in zip(twins, slopes, strict=True):
            if dual.dtype == DUAL:
                dual["slopes"][..., lane] = slope


def memory_of(loop: Loop) -> MachineMemory:
    """The numbers of both records of a loop."""
    return MachineMemory(loop.machine.record, loop.history.record)


def _is_smooth(memory: MachineMemory, sample: Sample) -> bool:
    """Whether differences over a step and over two are nearly the same, of numbers that no evaluation overwrites."""
    low, high, below, above, own = sample.numbers
    with np.errstate(invalid="ignore"):
        near, far = np.nan_to_num(high - low), np.nan_to_num(0.5 * (above - below))
    kept = np.where(memory.workspace, 0.0, 1.0)
    return all(
        np.max(np.abs(a - b), initial=0.0)
        <= SMOOTH * np.max(np.abs(a), initial=0.0)
        + ROUND_OFF * 2.0 * WIDE * np.max(np.abs(base[np.isfinite(base)]), initial=0.0)
        for a, b, base in zip(*(memory.arrays_of(each) for each in (kept * near, kept * far, own)), strict=True)
    )


def _faults(unfit: Unfit, parameter: Parameter) -> list[Fault]:
    match unfit.reason:
        case ModelError() as error:
            messages = [fault.message for fault in error.faults]
        case UnlikeError(name=name):
            what = "its Python laws" if name == "functions.address" else f"the structure of its equations ({name})"
            messages = [f"a small change of it changes {what}, not only numbers"]
        case str(name):
            messages = [f"`{name}` is not smooth"]
    return [Fault.at(parameter.path, f"there is no gradient: {message}") for message in messages]


# steps of the loop between two looks at Ctrl-C
CHUNK = 1000


class Lanes(NamedTuple):
    """Frames (n, width, 1 + LANES) and events (m, 3, 1 + LANES) of a run: values, then slopes along each parameter for its scale."""

    frames: Array
    events: Array


class Slopes:
    """The curves of a run and their slopes. result : their values."""

    def __init__(
        self, header: Header, parameters: Sequence[Parameter], passes: Sequence[Lanes], events: Sequence[str]
    ) -> None:
        self.parameters, self._passes, self._events = parameters, passes, events
        self._header = header
        self.result = self._result(passes[0].frames[..., 0])

    def evaluate(self, output: Output) -> Reduced:
        """The value of an output, its slopes for a change of each parameter by one of its units, and their doubts, parameters first."""
        found = [self._along(output, k) for k in range(len(self.parameters))]
        scale = np.array([each.scale for each in self.parameters]).reshape(-1, *[1] * np.ndim(found[0].value))
        slopes, doubts = (np.array([each[n] for each in found]) / scale for n in (1, 2))
        return Reduced(found[0].value, slopes, doubts)

    def time_shifts(self) -> Array:
        """(parameters,) [s] by how much a change of each by its scale moves the motion in time: the median of all columns of the frames, of
        their slopes over their rates, in the mean of the run."""
        frames, out = self._passes[0].frames[..., 0], []
        h = np.diff(frames[:, 0])
        rates = _root_mean_square(np.diff(frames[:, 1:], axis=0)[h > 0.0] / h[h > 0.0, None])
        for k in range(len(self.parameters)):
            slopes = _root_mean_square(self.lanes(k)[:, 1:])
            moves = (slopes > 0.0) & (rates > 0.0)
            out.append(float(np.median(slopes[moves] / rates[moves])) if moves.any() else 0.0)
        return np.array(out)

    def lanes(self, k: int) -> Array:
        """Slopes (n, width) of all columns of the frames along parameter k, for a change by its scale."""
        return self._passes[k // LANES].frames[..., 1 + k % LANES]

    def _along(self, output: Output, k: int) -> Reduced:
        lanes, lane = self._passes[k // LANES], 1 + k % LANES
        if output.is_event:
            number = self._events.index(output.name)
            came = np.flatnonzero(lanes.events[:, 1, 0] == number)
            if not len(came):
                return Reduced(*[np.array(np.nan)] * 3)
            return Reduced(lanes.events[came[0], 0, 0], lanes.events[came[0], 0, lane], np.array(0.0))
        slopes = self.lanes(k).copy()
        moves, slopes[:, 0] = slopes[:, 0].copy(), self.result.time
        slope = self._result(slopes)
        values = self.result.array(output.name)
        if output.reduce is None:
            return Reduced(values, slope.array(output.name), np.zeros_like(values))
        found = _with_doubt(output.reduce, self._moving(output.name, slope, moves))
        return Reduced(*(each.reshape(values.shape[1:]) for each in found))

    def _moving(self, name: str, slope: Result, moves: Array) -> Moving:
        """A curve with its slopes at times that stay. moves (n,) : slopes of the times of frames."""
        own, along = curve_of(self.result, name), curve_of(slope, name)
        if moves.any():
            along = curve(own.time, along.value - own.rate * moves[:, None])
        return Moving(own, along, float(moves[0]), float(moves[-1]))

    def _result(self, frames: NDArray[np.float64]) -> Result:
        return Result(MemoryContents(self._header, frames, self._header.attributes))


def _with_doubt(reduce: Reduce, moving: Moving) -> Reduced:
    """The slope by all frames, and what every other frame makes otherwise, if that is more than its doubt: the time of an extreme is wrong
    too."""
    found = reduce(moving)
    return found._replace(doubt=np.maximum(found.doubt, DOUBT * np.abs(found.slope - reduce(moving.thinned).slope)))


def _root_mean_square(columns: Array) -> Array:
    return np.sqrt(np.mean(np.nan_to_num(columns) ** 2, axis=0))


def find_slopes(
    start: Callable[[RunSettings], Loop],
    settings: RunSettings,
    header: Header,
    parameters: Sequence[Parameter],
    beside: Beside,
    listener: Listener,
    events: Sequence[str] = (),
    finer: RunSettings | None = None,
) -> tuple[Slopes, Slopes | None]:
    """A loop on dual numbers, and the same with finer steps where that can be done. start : the loop by its settings. beside : see
    `seeds_of`. events : their names.

    Raises ModelError where a parameter has no gradient, SolveError where the run fails.
    """
    build(start(settings).entries_on("whole"), listener)
    passes: list[Lanes] = []
    finer_passes: list[Lanes] = []
    for first in range(0, len(parameters), LANES):
        loop = start(settings)
        seeds = seeds_of(memory_of(loop), parameters[first : first + LANES], beside)
        passes.append(_run_seeded(loop, seeds))
        if finer is not None:
            with suppress(SolveError):
                finer_passes.append(_run_seeded(start(finer), seeds))
    slopes = Slopes(header, parameters, passes, events)
    return slopes, Slopes(header, parameters, finer_passes, events) if len(finer_passes) == len(passes) else None


def _run_seeded(loop: Loop, seeds: Sequence[Seeds]) -> Lanes:
    whole = WholeLoop(loop)
    seed(seeds, whole.machine, whole.run)
    return run_whole(whole)


def run_whole(whole: WholeLoop) -> Lanes:
    """The run to its end. Raises SolveError where it fails."""
    run = whole.run
    run.clock["value"][OPEN_LIMIT] = np.inf  # the run without slopes has judged that
    frames, events = [], []
    status = BUDGET_SPENT
    with interruptible() as interrupted:
        while status in GOES_ON:
            run.counter[BUDGET] = CHUNK
            status = whole.advance()
            frames.append(_taken(run.frames, int(run.counter[FRAMES])))
            events.append(_taken(run.events, int(run.counter[EVENTS])))
            run.counter[FRAMES], run.counter[EVENTS] = 0, 0
            if interrupted():
                raise NivelError("interrupted while a gradient was computed")
    if status != DONE:
        time = float(run.clock["value"][TIME])
        message = f"the run on dual numbers stopped at t = {time:.6g} s (status {status})"
        raise SolveError(message, time=time, advice="check that the machine runs with these settings")
    return Lanes(np.concatenate(frames), np.concatenate(events))


def _taken(rows: Any, count: int) -> Array:
    return rows.view(np.float64).reshape(*rows.shape, 1 + LANES)[:count].copy()


def values_of(outputs: Sequence[Output], result: Result) -> list[Array]:
    """Values of the outputs in a result without slopes."""
    return [value_of(output, result) for output in outputs]
