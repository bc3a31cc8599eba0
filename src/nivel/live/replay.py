"""A recorded run again: tick by tick as it was, to the last bit, or by other methods with the same inputs."""

from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import RunOutcome, counts_of
from nivel.analysis.run.simulate import close_run
from nivel.errors import ModelError
from nivel.files.target import check_target
from nivel.integrate.loop.paced import DONE, FROM_TAPE, SHOWN, TICKS, drive
from nivel.integrate.loop.run import ACCEPTED, STEP, STOPPED
from nivel.integrate.loop.sink import Header
from nivel.judge.after.subject import run_of
from nivel.judge.during.failure import failure
from nivel.judge.during.stop import Stop
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.core.status import DONE as ENDED
from nivel.lazy import Struct, nivel, replace
from nivel.live.preparation import LiveRun, prepared_run
from nivel.live.recording import Recording, Take
from nivel.live.shared import bytes_of, live_in
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store

FRAMES_AT_ONCE: Final = 32


class Replay(Struct):
    """A run done again. compared : frames that the recording has. different : how many of them are not repeated bit by bit; first : time
    of the first such frame [s]."""

    result: Result
    compared: int
    different: int
    first: float = 0.0

    @property
    def is_identical(self) -> bool:
        """Whether every frame is what it was."""
        return self.different == 0 and self.compared > 0


class Comparison:
    """Compares frames with recorded ones of the same times, bit by bit."""

    def __init__(self, recorded: Array) -> None:
        self._recorded = recorded
        self._compared = self._different = 0
        self._first = 0.0

    def take(self, frames: Array) -> None:
        """Frames in the order of time. A recorded one before them that was not among those that came is different."""
        times = self._recorded[self._compared :, 0]
        old = self._recorded[self._compared : self._compared + int(np.searchsorted(times, frames[-1, 0], "right"))]
        places = np.minimum(np.searchsorted(frames[:, 0], old[:, 0]), len(frames) - 1)
        wrong = np.any(_bits(old) != _bits(frames[places]), axis=1)
        if wrong.any() and not self._different:
            self._first = float(old[np.argmax(wrong), 0])
        self._compared += len(old)
        self._different += int(wrong.sum())

    def replay(self, result: Result) -> Replay:
        """What was found; recorded frames that never came are different."""
        left = self._recorded[self._compared :]
        first = float(left[0, 0]) if len(left) and not self._different else self._first
        return Replay(result, len(self._recorded), self._different + len(left), first)


def _bits(frames: Array) -> NDArray[np.uint64]:
    return np.ascontiguousarray(frames).view(np.uint64)


def machine_of(recording: Recording, take: Take) -> MachineRecord:
    """The machine whose inputs do off line what they did in the take."""
    tables = recording.inputs(take)
    machine = recording.machine
    simulation = machine.simulation.replace(duration=max(take.ticks, 1) * recording.pace.tick)
    inputs = tuple(each.replace(signal=tables[each.name]) for each in machine.inputs)
    return machine.replace(inputs=inputs, simulation=simulation)


def replay(
    recording: Recording,
    take: Take,
    *,
    out: str | PathLike[str] | None = None,
    force: bool = False,
    listener: Listener | None = None,
) -> Replay:
    """The take again, by the same compiled loop from the inputs on its tape.

    Raises ModelError, and SolveError where the run fails as it did when it was recorded.
    """
    if not take.ticks:
        raise ModelError("this take has no tick: there is nothing to replay")
    if out is not None:
        check_target(Path(out), "result file", force=force)
    plan = plan_run(recording.machine, stepwise=True)
    compile_seconds = build([*run_entries(plan), drive], listener)
    again = prepared_run(plan, recording.pace)
    prepared = again.prepared
    machine = machine_of(recording, take)
    sink = Memory() if out is None else Store(out, force)
    sink.begin(
        Header(prepared.motion.system.layout, run_attributes(machine, recording.source, prepared, plan.settings))
    )
    outcome = RunOutcome("done")
    found = Comparison(take.frames)
    pace, soils = recording.pace, again.soils
    log = nivel.results.terrain.TerrainLog(soils, pace.every * pace.tick) if soils else None
    for frames in _frames_of(again, take.tape, outcome, FRAMES_AT_ONCE if log is None else 1):
        sink.take(frames)
        found.take(frames)
        if log is not None:
            log.keep(float(frames[-1, 0]))
    outcome.terrain = "" if log is None else log.attribute
    seconds = {"prepare_seconds": 0.0, "compile_seconds": compile_seconds}
    result = close_run(sink, run_of(replace(plan, machine=machine), prepared, outcome, sink.result()), seconds)
    return found.replay(result)


def _frames_of(again: LiveRun, tape: Array, outcome: RunOutcome, count: int) -> Iterator[Array]:
    """The frames of the run, in blocks of `count`; how it ended stands in `outcome` then."""
    memory = bytearray(bytes_of(again.sizes))
    live = live_in(memory, again.sizes)
    loop = again.begin(live)
    control = live.control
    control[FROM_TAPE] = 1
    status, shown, chunk = BUDGET_SPENT, 0, count * again.pace.every
    while control[DONE] < len(tape) and status == BUDGET_SPENT:
        begin = int(control[DONE])
        stop = min(begin + chunk, len(tape))
        live.tape[np.arange(begin, stop) % len(live.tape)] = tape[begin:stop]
        control[TICKS] = stop - begin
        status = loop()
        if control[SHOWN] > shown:
            yield live.frames[np.arange(shown, control[SHOWN]) % len(live.frames)]
            shown = int(control[SHOWN])
    run, events = again.run, again.prepared.motion.system.events
    if run.counter[STOPPED]:
        outcome.stopped_by = events[run.counter[STOPPED] - 1]
    outcome.pace = run.pace
    outcome.timing = {**counts_of(again.prepared.motion.system, run), "loop_seconds": 0.0, "wall_seconds": 0.0}
    if status not in (BUDGET_SPENT, ENDED):
        at = float(run.clock[ACCEPTED])
        outcome.outcome = "failed"
        message, advice = failure(Stop(again.prepared.motion, status, at, float(run.clock[STEP]), run.previous))
        outcome.failure = message, advice, at
