"""Slopes of a run: the curves of its result and their derivatives, by runs on dual numbers, LANES parameters at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.gradients.outputs import Array, Curve, Output, value_of
from nivel.analysis.gradients.parameters import Parameter
from nivel.analysis.gradients.seeds import seed
from nivel.analysis.gradients.whole_loop import WholeLoop, whole_entries
from nivel.analysis.plan.compilation import build
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.interrupt import interruptible
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.dynamics import GOES_ON, Loop, start_loop
from nivel.errors import NivelError, SolveError
from nivel.integrate.loop.run import BUDGET, EVENTS, FRAMES, OPEN_LIMIT, TIME
from nivel.integrate.loop.sink import Header
from nivel.kernels.core.status import BUDGET_SPENT, DONE
from nivel.native.duals import LANES
from nivel.results.memory import MemoryContents
from nivel.results.result import Result

# steps of the loop between two looks at Ctrl-C
CHUNK = 1000


class Lanes(NamedTuple):
    """Frames (n, width, 1 + LANES) and events (m, 3, 1 + LANES) of a run: values, then slopes along each parameter for its scale."""

    frames: Array
    events: Array


class Slopes:
    """The curves of a run and their slopes. result : their values. evaluate(output) gives the value of an output, and slopes along all
    parameters, for a change of each by one of its units."""

    def __init__(
        self, header: Header, parameters: Sequence[Parameter], passes: Sequence[Lanes], events: Sequence[str]
    ) -> None:
        self.parameters, self._passes, self._events = parameters, passes, events
        self._header = header
        self.result = self._result(passes[0].frames[..., 0])

    def evaluate(self, output: Output) -> tuple[Array, Array]:
        """(value, slopes): slopes have the parameters as their first axis."""
        found = [self._along(output, k) for k in range(len(self.parameters))]
        scale = np.array([each.scale for each in self.parameters])
        slopes = np.array([slope for _, slope in found])
        return found[0][0], slopes / scale.reshape(-1, *[1] * (slopes.ndim - 1))

    def lanes(self, k: int) -> Array:
        """Slopes (n, width) of all columns of the frames along parameter k, for a change by its scale."""
        return self._passes[k // LANES].frames[..., 1 + k % LANES]

    def _along(self, output: Output, k: int) -> tuple[Array, Array]:
        lanes, lane = self._passes[k // LANES], 1 + k % LANES
        if output.is_event:
            number = self._events.index(output.name)
            came = np.flatnonzero(lanes.events[:, 1, 0] == number)
            if not len(came):
                return np.array(np.nan), np.array(np.nan)
            return lanes.events[came[0], 0, 0], lanes.events[came[0], 0, lane]
        slope = self._result(self.lanes(k))
        curve = Curve(self.result.time, self.result.array(output.name), slope.time, slope.array(output.name))
        return (curve.value, curve.slope) if output.reduce is None else output.reduce(curve)

    def _result(self, frames: NDArray[np.float64]) -> Result:
        return Result(MemoryContents(self._header, frames, self._header.attributes))


def find_slopes(
    prepared: Prepared,
    settings: RunSettings,
    header: Header,
    parameters: Sequence[Parameter],
    beside: Callable[[Parameter, float], Loop],
    listener: Listener,
) -> Slopes:
    """The run on dual numbers. beside : see `nivel.analysis.gradients.seeds.seed`.

    Raises ModelError where a parameter has no gradient, SolveError where the run fails.
    """
    build(whole_entries(start_loop(prepared, settings)), listener)
    passes = []
    for first in range(0, len(parameters), LANES):
        loop = start_loop(prepared, settings)
        whole = WholeLoop(loop)
        seed(whole, loop, parameters[first : first + LANES], beside)
        passes.append(run_whole(whole))
    return Slopes(header, parameters, passes, prepared.motion.system.events)


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
