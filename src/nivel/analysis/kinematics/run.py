"""A whole kinematic analysis: from a machine record to a result with its trust report."""

import json
import time
from importlib import import_module
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.corners import with_features
from nivel.analysis.curves.functions import ExpressionCurve, TableCurve
from nivel.analysis.kinematics.drive import singular_positions
from nivel.analysis.plan.plan import Methods
from nivel.analysis.plan.settings import RunSettings, complete
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared, sharing
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import terminable
from nivel.analysis.run.dynamics import GOES_ON, Loop, RunOutcome, keep_last, march_in_chunks
from nivel.analysis.run.history import start_history
from nivel.analysis.run.prepared_state import prepare
from nivel.analysis.run.probes import GOLDEN, Probes
from nivel.errors import SolveError, refuse
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.positions import follow_positions
from nivel.integrate.loop.run import ACCEPTED, DONE_STEPS, EVALUATIONS, REJECTED, STEP, Run
from nivel.integrate.loop.sink import Header, Sink
from nivel.integrate.stabilise import STABILISATIONS
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Positions
from nivel.judge.before.analyses import OF_KINEMATICS, free_motions
from nivel.judge.before.refusals import faults_of
from nivel.judge.during.failure import KINEMATICS, failure
from nivel.judge.during.lockup import find_jam
from nivel.judge.during.stop import Stop
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import CONTRADICTION, DONE
from nivel.lazy import Struct, replace
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import KinematicsSettings
from nivel.machine.settings.values import POSITIONS
from nivel.machine.units.tree import TIME
from nivel.results.curve import PROBED, ROUNDED, TOLD, curve
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.system.layout import FrameLayout, laid_out
from nivel.system.system import Array

# share of the least singular value at the start, below which an analysis that cannot go on has come to a singular position
STUCK = 1e-4
# positions between those that are asked for, at most
MOST_BETWEEN = 2000
# times as many positions where some do not show the motion between them; no more where there are so many
FINER, MOST_POSITIONS = 4, 64 * 360 + 1
# histories that only the integration of a motion has
INTEGRATED = frozenset({"external_work", "dissipated_energy", "energy_error"})
FACTS = IntegratorFacts("", follow_positions, order=1, numbers=1)


class _Chosen(Struct, frozen=False):
    """Frames without the columns that mean nothing here, for another sink."""

    sink: Memory | Store
    columns: NDArray[np.intp]

    def begin(self, header: Header) -> None:
        self.sink.begin(header)

    def take(self, frames: Array) -> None:
        self.sink.take(np.ascontiguousarray(frames[:, self.columns]))


def kinematics(
    machine: MachineRecord,
    methods: Methods,
    settings: KinematicsSettings,
    *,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    listener: Listener | None = None,
    compile_seconds: float = 0.0,
) -> Result:
    """Positions, velocities, accelerations and reactions of `machine`, driven as it is; the result is in memory, or in the file `out`.

    methods : of the machine with neutral settings, its duration and step. Raises ModelError before anything is computed, SolveError (with
    the positions so far) where it cannot go on, SystemExit where SIGTERM came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory() if out is None else Store(out, force)
    begin = time.perf_counter()
    listener.say("preparing")
    refuse(faults_of(machine, OF_KINEMATICS))
    prepared = replace(prepare(methods), integrator=FACTS)
    refuse(free_motions(machine, prepared))
    steps = complete(methods.machine.simulation, methods.coordinates)
    chosen = _without_histories(prepared.motion.system.layout, sink)
    seconds = {"prepare_seconds": time.perf_counter() - begin, "compile_seconds": compile_seconds}
    listener.say("finding positions", settings.duration)
    with terminable():
        if settings.positions is None:
            settings, steps = resolved(machine, prepared, settings, steps)
        chosen[0].begin(Header(chosen[1], _attributes(machine, source, prepared, settings)))
        finished, run = follow(prepared, steps, chosen[0], listener, between(prepared, steps))
        finished.timing |= seconds
        finished.between_frames |= hidden(machine, prepared, steps)
        return _close(sink, machine, prepared, finished, run)


def _attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: KinematicsSettings
) -> dict[str, str | float | int]:
    """The attributes of the result; that drivers give the bodies other velocities than the file is no news."""
    attributes = run_attributes(machine, source, prepared, settings)
    assembly = {**json.loads(str(attributes["assembly"])), "velocity_change": (), "followed": ()}
    return {**attributes, "assembly": json.dumps(assembly), "analysis": "kinematics"}


def _unnamed(prepared: Prepared) -> Memory:
    """A sink for positions beside those that are asked for."""
    sink = Memory()
    sink.begin(Header(prepared.motion.system.layout, {}))
    return sink


def between(prepared: Prepared, settings: RunSettings) -> Probes:
    """Positions at other times, no multiple of which fits those that are asked for, as probes of the curves through these."""
    count, taken = max(1, settings.steps), _unnamed(prepared)
    step = settings.step * GOLDEN * max(1.0, count / MOST_BETWEEN)
    steps = max(1, int(settings.duration / step))
    follow(prepared, replace(settings, step=step, steps=steps, every=1, output_interval=step), taken, Listener())
    return Probes(prepared.motion, (), list(taken.frames))


def hidden(machine: MachineRecord, prepared: Prepared, steps: RunSettings) -> dict[str, list[float]]:
    """By variable what drivers' functions of time do between positions, beyond the curve through these: bounds of the functions find it,
    however short it is."""
    time = np.linspace(0.0, steps.duration, steps.steps + 1)
    names = prepared.motion.system.layout.coordinates["joint_coordinate"]
    out: dict[str, list[float]] = {}
    for driver in machine.drivers:
        named = [k for k, name in enumerate(names) if f"{name}.".startswith(f"{driver.coordinate}.")]
        law = driver.speed if driver.value is None else driver.value
        if len(named) != 1 or not isinstance(law, Expression | Table) or law.signals:
            continue
        if isinstance(law, Expression):
            variable, of = "joint_rate", ExpressionCurve(law if driver.value is None else law.derivative)
        else:
            variable, of = "joint_rate" if driver.value is None else "joint_coordinate", TableCurve(law)
        values = of.values({TIME: time})
        at, right = with_features(of, time, values, TOLD)
        between, inside = curve(time, values), time[:-1] + GOLDEN * np.diff(time)
        place = np.clip(np.searchsorted(time, at)[:, None] + np.arange(-2, 2), 0, len(time) - 1)
        near = values[place]
        peak = np.minimum(
            np.maximum(right - near.max(axis=1), near.min(axis=1) - right), np.abs(between.at(at)[:, 0] - right)
        )
        off = np.abs(between.at(inside)[:, 0] - of.values({TIME: inside}))
        if max(peak.max(), off.mean()) > max(TOLD * np.ptp(right), ROUNDED * np.abs(right).max(initial=0.0)):
            found = out.setdefault(variable, [0.0] * len(names))
            found[named[0]] = max(float(peak.max()), float(off.max()))
    return out


def resolved(
    machine: MachineRecord, prepared: Prepared, settings: KinematicsSettings, steps: RunSettings
) -> tuple[KinematicsSettings, RunSettings]:
    """Settings with as many positions, four times as many each time, as show the motion between them, if `MOST_POSITIONS` do."""
    count = POSITIONS
    while True:
        settings = settings.replace(positions=count)
        steps = replace(steps, step=settings.step, steps=count - 1, output_interval=settings.step)
        finished, _ = follow(prepared, steps, _unnamed(prepared), Listener(), between(prepared, steps))
        is_seen = not (finished.between_frames or hidden(machine, prepared, steps))
        if finished.outcome != "done" or is_seen or count >= MOST_POSITIONS:
            return settings, steps
        count = FINER * (count - 1) + 1


def position_loop(prepared: Prepared, settings: RunSettings) -> Loop:
    """The compiled loop over the positions, at the start."""
    control, kernels = prepared.motion.system.record.control, prepared.motion.kernels
    control.stabilise[:] = STABILISATIONS["direct"].coefficients(settings.step, None, None)
    correct, history = import_module(prepared.path.correction).correct, start_history(prepared, settings, FACTS)
    return Loop(kernels.evaluate, correct, None, prepared.motion.handle, Handle(history), follow_positions)


def follow(
    prepared: Prepared, settings: RunSettings, sink: Sink, listener: Listener, probes: Probes | None = None
) -> tuple[RunOutcome, Run]:
    """Give every position to the sink (already begun). Returns how it ended, and the history."""
    system, loop = prepared.motion.system, position_loop(prepared, settings)
    run, finished, sinks = loop.history.record, RunOutcome("done"), sharing(prepared, [sink])
    sinks = sinks if probes is None else (probes, *sinks)
    begin = time.perf_counter()
    status, loop_seconds = march_in_chunks(loop.advance, system, run, sinks, finished, listener.progress, None)
    if status not in (*GOES_ON, DONE):
        finished.outcome = "failed"
        finished.failure = _failure(prepared, settings, run, status)
        if status != CONTRADICTION:
            keep_last(prepared.motion, run, sinks)
    if probes is not None:
        finished.between_frames = probes.close()
    finished.timing = {
        "steps": int(run.counter[DONE_STEPS]),
        "evaluations": int(run.counter[EVALUATIONS]),
        "rejected": int(run.counter[REJECTED]),
        "loop_seconds": loop_seconds,
        "wall_seconds": time.perf_counter() - begin,
    }
    return finished, run


def _failure(prepared: Prepared, settings: RunSettings, run: Run, status: int) -> tuple[str, str, float]:
    """(message, advice, time [s]) of an analysis that cannot go on."""
    t = float(run.clock[ACCEPTED])
    jam = find_jam(prepared, t, float(run.clock[STEP]), settings.step, settings.duration, run.previous)
    if jam is not None:
        return jam.message, jam.advice, t
    message, advice = failure(
        Stop(prepared.motion, status, t, float(run.clock[STEP]), run.previous, chosen_by=KINEMATICS)
    )
    return message, advice, t


def _without_histories(layout: FrameLayout, sink: Memory | Store) -> tuple[_Chosen, FrameLayout]:
    """The sink behind a choice of columns, and the layout that it sees."""
    kept = [each for each in layout.variables if each.name not in INTEGRATED]
    columns = [0] + [k for each in kept for k in range(each.columns.start, each.columns.stop)]
    entries = [(each.name, each.dims, each.units, each.long_name) for each in kept]
    return _Chosen(sink, np.array(columns, dtype=np.intp)), laid_out(entries, dict(layout.coordinates))


def _close(sink: Memory | Store, machine: MachineRecord, prepared: Prepared, finished: RunOutcome, run: Run) -> Result:
    message, advice, at = finished.failure or ("", "", 0.0)
    near = singular_positions(prepared, sink.result())
    jammed = finished.failure is not None and "jams" in message
    if finished.failure is not None and not jammed and near is not None and near.least < STUCK:
        message = f"a position at t = {near.time:.6g} s is singular: the rows of {', '.join(near.joints)} depend on each other there"
        advice = "Branches of positions meet in it. Take another number of positions, so that none falls on it: it is then stepped over."
    positions = Positions(
        result=sink.result(),
        outcome=finished.outcome,
        failure=message,
        machine=machine,
        prepared=prepared,
        halved=int(run.counter[REJECTED]),
        near=near,
        between_frames=finished.between_frames,
        # a machine that jams has come to the singular position, not past it
        passed=tuple(pair for pair in near.passed if not jammed or pair[1] < at) if near is not None else (),
    )
    result = sink.close(
        {
            "outcome": finished.outcome,
            "failure": message,
            "advice": advice,
            "events": "[]",
            "stopped_by": "",
            "trust": assess(positions).to_json(),
            "timing": json.dumps(finished.timing),
            PROBED: json.dumps(finished.between_frames),
        }
    )
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=result)
    return result
