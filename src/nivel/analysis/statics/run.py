"""A whole statics run: from a machine record to a result with its trust report."""

import json
import time
from collections.abc import Iterator
from contextlib import suppress
from os import PathLike

import numpy as np

from nivel.analysis.assembly.implicit import ResidualOptions
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Assembled, Prepared, SharedLoads, prepare
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import interruptible, terminable
from nivel.analysis.statics import linear
from nivel.analysis.statics.critical import CriticalPoint, critical_points, is_mechanism, softest
from nivel.analysis.statics.equations import Rest, StateError, StaticEquations
from nivel.analysis.statics.frames import Facts, FrameWriter
from nivel.analysis.statics.free_coordinates import for_statics, loaded_free
from nivel.analysis.statics.newton import EquilibriumError, Iteration
from nivel.analysis.statics.path import Point, Steps, by_arc_length, by_loads
from nivel.analysis.statics.rigid_motions import of_whole
from nivel.analysis.statics.search import direction_in_words, no_start, path_ended, settle, without_stiffness
from nivel.analysis.statics.states import depends_on_samples, growing_motions, restlessness
from nivel.errors import ModelError, SolveError, refuse
from nivel.integrate.loop.sink import Header
from nivel.judge.after.other_elements import (
    Compared,
    Stiffness,
    element_errors,
    errors_along_path,
    other_elements,
    with_elements,
)
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Equilibria
from nivel.judge.before.analyses import OF_STATICS, at_rest, beside_states
from nivel.judge.before.refusals import faults_of, rough_motions
from nivel.judge.during.stop import broken_function
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.lazy import Struct, field, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import StaticsSettings
from nivel.results.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.frames.summary import Occurrence, to_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.system.system import Array


def statics_attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: StaticsSettings
) -> dict[str, str | float | int]:
    """The attributes of the result, see `nivel.integrate.loop.sink.Header`; the coordinates are those that were taken."""
    taken = "relative" if len(prepared.motion.system.record.tree.node) else "absolute"
    shown = json.dumps({**settings.as_dict(), "coordinates": taken})
    return {**run_attributes(machine, source, prepared, settings), "settings": shown, "analysis": "statics"}


# A state whose loads are this many times what round-off makes of them, or less, has none.
UNLOADED = 10.0
# in place of the number of unstable directions: what is sampled has no rates, by which it could be told
NOT_JUDGED = -1


class Walk(Struct, frozen=False):
    """The equilibria of a machine from `start` on: where their frames go, and what is known of the path so far. ended : (message, advice)
    of a failure. rests : the equilibria, and the angles of joints that are followed in each."""

    equations: StaticEquations
    start: Rest
    settings: StaticsSettings
    writer: FrameWriter
    sink: Memory | Store
    points: list[Point] = field(default_factory=list)
    rests: list[tuple[Rest, Array]] = field(default_factory=list)
    counts: list[int] = field(default_factory=list)
    critical: list[CriticalPoint] = field(default_factory=list)
    iterations: int = 0
    rigid: int = 0
    free_motions: int = 0
    without_potential: bool = False
    outcome: str = "done"
    ended: tuple[str, str] | None = None
    buckling: list[tuple[float, str]] = field(default_factory=list)

    def go(self, listener: Listener) -> None:
        """Find all equilibria and store them."""
        with interruptible() as interrupted:
            for point in self._follow(listener):
                self._take(point)
                if listener.progress is not None:
                    listener.progress(point.state.t)
                if interrupted():
                    self.outcome = "interrupted"
                    break

    def _fail(self, told: tuple[str, str]) -> None:
        self.outcome, self.ended = "failed", told

    @property
    def _iteration(self) -> Iteration:
        return Iteration(self.settings.tolerance, self.settings.most_iterations, self.settings.line_search)

    def _follow(self, listener: Listener) -> Iterator[Point]:
        """The equilibria in turn; how the path ended is noted."""
        equations, settings, iteration = self.equations, self.settings, self._iteration
        listener.say("looking for the first equilibrium")
        try:
            found = settle(equations, self.start, iteration)
        except EquilibriumError as error:
            self._fail(no_start(equations, error))
            return
        loose = None if equations.states_move else softest(found.tangent)
        as_drawn = found.iterations == 0 and not settings.duration
        if loose is not None and is_mechanism(loose) and not (settings.modes and as_drawn):
            whole = of_whole(equations, found.state, found.tangent)
            if not whole.alone:
                self._fail(without_stiffness(equations, found.state, loose))
                return
            self.free_motions = whole.motions
        equations.follow(found.state)
        first = Point(found, 0.0)
        yield first
        if not settings.duration:
            return
        listener.say("following the equilibria", settings.duration)
        steps = Steps(settings.duration, settings.interval, iteration)
        try:
            yield from (by_arc_length if settings.arc_length else by_loads)(equations, first, steps)
        except EquilibriumError as error:
            self._fail(path_ended(equations, self.points[-1], steps, error, settings.arc_length))

    def _take(self, point: Point) -> None:
        """Frames of the critical points before an equilibrium, and of itself."""
        equations = self.equations
        if equations.states_move:
            held = depends_on_samples(equations, point.state)
            count = NOT_JUDGED if held else growing_motions(equations, point.state)
        else:
            count = linear.unstable_directions(point.found.tangent)
            self.without_potential |= not linear.has_potential(point.found.tangent)
        if self.points and self.counts[-1] != count and not equations.states_move:
            counts = self.counts[-1], count
            critical = critical_points(equations, self.points[-1], point, counts, self._iteration)
            self.critical += critical
            for each in critical:
                if each.found is not None:
                    self._write(Point(each.found, each.along), min(counts))
        self._write(point, count)
        self.rests.append((point.state, equations.record.coordinates.reference.copy()))
        # the first and the last are needed
        self.points[1:] = [point] if self.points else []
        self.points = self.points or [point]
        self.counts.append(count)
        self.iterations += point.found.iterations

    def _write(self, point: Point, count: int) -> None:
        equations, state, tangent = self.equations, point.state, point.found.tangent
        r, _ = equations.evaluate(state)
        loads = equations.loads(state)
        left = float(np.max(np.abs(r), initial=0.0)) * equations.energy
        restless = restlessness(equations, state) if equations.states_move else 0.0
        found = None
        if self.settings.modes:
            with suppress(linear.PivotError):
                found = linear.vibrations(tangent, self.settings.modes)
                self.rigid = max(self.rigid, found.rigid)
        rounded = equations.round_off(tangent, state)
        # loads that are round-off themselves are none
        shares = [each / loads if loads > UNLOADED * rounded else 0.0 for each in (left, rounded)]
        facts = Facts(point.along, max(shares[0], restless), shares[1], count, point.found.iterations, found)
        self.sink.take(self.writer.frame(state, facts))

    def find_buckling(self) -> None:
        """Times at which linear extrapolation of the tangents of the first and the last equilibrium loses its stiffness."""
        first, last = self.points[0].found, self.points[-1].found
        try:
            factors, directions = linear.buckling_factors(first.tangent, last.tangent, self.settings.buckling)
        except linear.PivotError:
            message = "the first equilibrium has no positive stiffness, so no buckling loads follow from it"
            self._fail((message, "Give the machine stiffness, or stabilising loads, at t = 0."))
            return
        span = last.state.t - first.state.t
        self.buckling = [
            (first.state.t + float(mu) * span, direction_in_words(self.equations, directions[:, k]))
            for k, mu in enumerate(factors)
        ]

    def stiffness(self) -> Stiffness | None:
        """The lowest one as drawn and in the last state; None where states of elements move, or nothing can."""
        if self.equations.states_move:
            return None
        try:
            last = self.points[-1].found.tangent
            drawn, loaded = (linear.lowest(each, 1, each.M)[0] for each in (self.equations.tangent(self.start), last))
        except (linear.PivotError, StateError, np.linalg.LinAlgError):
            return None
        return Stiffness(float(drawn[0]), float(loaded[0])) if len(drawn) and len(loaded) else None


def prepare_statics(
    machine: MachineRecord, settings: StaticsSettings, given: Assembled | None = None
) -> tuple[Prepared, StaticEquations]:
    """The machine assembled, and its equations of static equilibrium; given : as built and assembled for a run. Raises ModelError."""
    refuse(faults_of(machine, OF_STATICS))
    refuse(beside_states(machine, settings))
    neutral, coordinates = for_statics(machine, settings)
    refuse(rough_motions(neutral))
    # drivers that hold what is free are not in what was built, and friction of contacts is not in what is at rest
    others = len(neutral.drivers) > len(machine.drivers) or neutral.forces != machine.forces
    methods = methods_of(neutral, "newton-euler", coordinates)
    prepared = prepare(methods, None if others else given, ResidualOptions(shifted=True))
    motion = prepared.motion
    motion.system.record.coordinates.reference[:] = prepared.assembly.reference
    # multipliers of equilibria are those of the residual, and S in the record is of another state
    motion.system.record.control.rank[LEFT_OUT] = 0
    return prepared, StaticEquations(motion, settings.duration or 1.0)


def begun(
    machine: MachineRecord,
    settings: StaticsSettings,
    sink: Memory | Store,
    *,
    chosen_duration: bool,
    source: str = "",
    shared: bool = False,
) -> tuple[Walk, Prepared]:
    """A walk along the equilibria, not gone yet, whose sink has begun. shared : redundant joints share their loads. See `statics`."""
    prepared, equations = prepare_statics(machine, settings)
    start = _start(equations, prepared)
    if not chosen_duration and not _depends_on_time(equations, start, settings.duration):
        settings = settings.replace(duration=0.0, arc_length=False)
    writer = FrameWriter(equations, settings.modes, SharedLoads.of(prepared) if shared else None)
    sink.begin(Header(writer.layout, statics_attributes(machine, source, prepared, settings)))
    return Walk(equations, start, settings, writer, sink), prepared


def statics(
    machine: MachineRecord,
    settings: StaticsSettings,
    *,
    chosen_duration: bool,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    listener: Listener | None = None,
    compile_seconds: float = 0.0,
) -> Result:
    """The equilibria of `machine`; the result is in memory, or in the file `out`.

    chosen_duration : the duration was asked for; otherwise a machine on which time has no influence has one equilibrium, at t = 0.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails, SystemExit where SIGTERM
    came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory() if out is None else Store(out, force)
    begin = time.perf_counter()
    listener.say("preparing")
    walk, prepared = begun(machine, settings, sink, chosen_duration=chosen_duration, source=source, shared=True)
    settings = walk.settings
    seconds = {"prepare_seconds": time.perf_counter() - begin, "compile_seconds": compile_seconds}
    begin = time.perf_counter()
    with terminable():
        walk.go(listener)
        if settings.buckling and walk.outcome == "done":
            walk.find_buckling()
        seconds["loop_seconds"] = time.perf_counter() - begin
        result, elements = sink.result(), None
        if settings.verify and walk.outcome == "done":
            elements = _with_other_elements(machine, walk, prepared, result, listener)
        return _close(machine, prepared, walk, result, seconds, elements)


MOST_NODES = 400  # of all beams: more are halved in number, not doubled


def _with_other_elements(
    machine: MachineRecord, walk: Walk, prepared: Prepared, result: Result, listener: Listener
) -> Compared | None:
    """The same equilibria with other elements, and what follows from them for the result; None where there are no beams."""
    settings = walk.settings
    pair = other_elements(machine, doubles=sum(len(each.shares) for each in machine.beams) <= MOST_NODES)
    if pair is None:
        return None
    frame, names = Memory(), prepared.motion.system.layout.coordinates["body"]
    frame.begin(Header(walk.writer.layout, {}))
    frame.take(walk.writer.frame(walk.start, Facts(0.0, 0.0, 0.0, 0, 0, None)))
    drawn = dict(zip(names, frame.result().array("position")[0], strict=True))
    loose = prepared.redundancy.non_unique_joints
    own, its, other, why = walk.stiffness(), None, None, ""
    listener.say(f"verifying with {pair.words} elements of beams")
    try:
        other, _ = begun(pair.machine, settings, Memory(), chosen_duration=True)
        other.go(Listener())
        its = other.stiffness() if other.points else None
    except (ModelError, SolveError, linear.PivotError) as error:
        why = str(error)
    if other is not None and other.outcome == "interrupted":
        walk.outcome = "interrupted"
        return None
    why = why or (other.ended[0] if other is not None and other.ended else "")
    found = None if why or other is None else other.sink.result()
    errors_of = errors_along_path if settings.arc_length else element_errors
    return Compared(
        pair=pair,
        result=found,
        errors=None if found is None else errors_of(result, found, pair.factor),
        why=why,
        drawn=drawn,
        unique=tuple(each.name for each in machine.joints if each.name not in loose),
        own=own,
        its=its,
        by_arc=settings.arc_length,
    )


def _start(equations: StaticEquations, prepared: Prepared) -> Rest:
    """The assembled machine at rest. Raises SolveError where its forces are not numbers."""
    try:
        return equations.start(prepared.start)
    except StateError:
        broken = broken_function(prepared.motion, 0.0, 0.0, prepared.start)
        message, advice = broken or ("the forces at t = 0 are not numbers", "Look at their laws.")
        raise SolveError(message, time=0.0, advice=advice) from None


def _depends_on_time(equations: StaticEquations, state: Rest, duration: float) -> bool:
    """Whether any force or driver changes over the duration, in this state."""
    try:
        first = np.concatenate(equations.evaluate(state))
        return any(
            not np.array_equal(np.concatenate(equations.evaluate(replace(state, t=t))), first)
            for t in np.linspace(0.0, duration, 32)
        )
    except StateError:
        return True


def _close(
    machine: MachineRecord,
    prepared: Prepared,
    walk: Walk,
    result: Result,
    seconds: dict[str, float],
    elements: Compared | None,
) -> Result:
    if walk.ended is None and (loaded := loaded_free(machine, result, prepared.motion.system.size)):
        walk.outcome, walk.ended = "failed", loaded
    message, advice = walk.ended or ("", "")
    elements = elements if walk.ended is None else None
    equilibria = Equilibria(
        result=result,
        outcome=walk.outcome,
        failure=message,
        machine=machine,
        prepared=prepared,
        critical=tuple((each.kind, each.t, None if each.found is not None else each.between) for each in walk.critical),
        at_rest=at_rest(machine),
        rigid=walk.rigid,
        free_motions=walk.free_motions,
        without_potential=walk.without_potential,
        elements=elements,
    )
    critical = [
        {
            "kind": each.kind,
            "time": each.t,
            "path": each.along,
            "exact": each.found is not None,
            "between": each.between,
        }
        for each in walk.critical
    ]
    attributes: dict[str, str | float | int] = {
        "outcome": walk.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json([Occurrence(each.kind, each.t, "") for each in walk.critical]),
        "stopped_by": "",
        "critical_points": json.dumps(critical),
        "buckling": json.dumps([{"time": t, "moves": words} for t, words in walk.buckling]),
        "trust": assess(equilibria).to_json(),
        "timing": json.dumps({"steps": len(walk.counts), "iterations": walk.iterations, **seconds}),
    }
    errors = elements.errors if elements is not None else None
    if errors is not None and np.all(np.diff(errors.time) > 0.0):
        attributes[ESTIMATES] = with_elements(None, errors).to_json()
    reached = float(result.time[-1]) if len(result.time) else 0.0
    result = walk.sink.close(attributes)
    if walk.ended is not None:
        raise SolveError(message, time=reached, advice=advice, result=result)
    return result
