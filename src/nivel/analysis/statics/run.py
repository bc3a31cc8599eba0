"""A whole statics run: from a machine record to a result with its trust report."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from os import PathLike

import numpy as np

from nivel.analysis.assembly.implicit import ResidualOptions
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Assembled, Prepared, prepare
from nivel.analysis.preparation.shared_loads import SharedLoads
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import interruptible, terminable
from nivel.analysis.statics.critical import CriticalPoint, critical_points, is_mechanism, softest
from nivel.analysis.statics.ends import direction_in_words, no_start, path_ended, without_stiffness
from nivel.analysis.statics.equations import Rest, StateError, StaticEquations
from nivel.analysis.statics.frames import Facts, FrameWriter
from nivel.analysis.statics.free_coordinates import for_statics, loaded_free
from nivel.analysis.statics.linear import PivotError, has_potential, lowest, unstable_directions
from nivel.analysis.statics.newton import EquilibriumError, Iteration
from nivel.analysis.statics.path import Point, Steps, by_arc_length, by_loads
from nivel.analysis.statics.rigid_motions import of_whole
from nivel.analysis.statics.search import settle
from nivel.analysis.statics.states import depends_on_samples, growing_motions, restlessness
from nivel.analysis.statics.vibrations import buckling_factors, vibrations
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
from nivel.lazy import dataclass, field, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.statics import StaticsSettings
from nivel.results.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.frames.summary import Occurrence, to_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store


def statics_attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: StaticsSettings
) -> dict[str, str | float | int]:
    """The attributes of the result, see `nivel.integrate.loop.sink.Header`; the coordinates are those that were taken."""
    taken = "relative" if len(prepared.motion.system.record.tree.node) else "absolute"
    shown = json.dumps({**settings.as_dict(), "coordinates": taken})
    return {**run_attributes(machine, source, prepared, settings), "settings": shown, "analysis": "statics"}


# A state whose loads are this many times what round-off makes of them, or less, has none.
UNLOADED = 10.0


@dataclass
class Walk:
    """What is known of a path so far. ended : (message, advice) of a failure."""

    points: list[Point] = field(default_factory=list)
    counts: list[int] = field(default_factory=list)
    critical: list[CriticalPoint] = field(default_factory=list)
    iterations: int = 0
    rigid: int = 0
    free_motions: int = 0
    without_potential: bool = False
    outcome: str = "done"
    ended: tuple[str, str] | None = None
    buckling: list[tuple[float, str]] = field(default_factory=list)


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
    prepared, equations = prepare_statics(machine, settings)
    start = _start(equations, prepared)
    if not chosen_duration and not _depends_on_time(equations, start, settings.duration):
        settings = settings.replace(duration=0.0, arc_length=False)
    writer = FrameWriter(equations, settings.modes, SharedLoads.of(prepared))
    sink.begin(Header(writer.layout, statics_attributes(machine, source, prepared, settings)))
    seconds = {"prepare_seconds": time.perf_counter() - begin, "compile_seconds": compile_seconds}
    begin = time.perf_counter()
    walk = Walk()
    with terminable():
        _walk(equations, start, settings, walk, writer, sink, listener)
        if settings.buckling and walk.outcome == "done":
            _find_buckling(equations, walk, settings.buckling)
        seconds["loop_seconds"] = time.perf_counter() - begin
        others = None
        if settings.verify and walk.outcome == "done":
            others = _with_other_elements(machine, settings, walk, (equations, start, writer), prepared, listener)
        return _close(machine, sink, prepared, walk, settings, seconds, others)


def _walk(
    equations: StaticEquations,
    start: Rest,
    settings: StaticsSettings,
    walk: Walk,
    writer: FrameWriter,
    sink: Memory | Store,
    listener: Listener,
) -> None:
    """Find all equilibria and store them."""
    with interruptible() as interrupted:
        for point in _follow(equations, start, settings, walk, listener):
            _take(equations, writer, sink, walk, point, settings)
            if listener.progress is not None:
                listener.progress(point.state.t)
            if interrupted():
                walk.outcome = "interrupted"
                break


MOST_NODES = 400  # of all beams: more are halved in number, not doubled


def _with_other_elements(
    machine: MachineRecord,
    settings: StaticsSettings,
    walk: Walk,
    own: tuple[StaticEquations, Rest, FrameWriter],
    prepared: Prepared,
    listener: Listener,
) -> Callable[[Result], Compared] | None:
    """The same equilibria with other elements, and what follows from them for a result; None where there are no beams."""
    pair = other_elements(machine, doubles=sum(len(beam.shares) for beam in machine.beams) <= MOST_NODES)
    if pair is None:
        return None
    frame, names = Memory(), prepared.motion.system.layout.coordinates["body"]
    frame.begin(Header(own[2].layout, {}))
    frame.take(own[2].frame(own[1], Facts(0.0, 0.0, 0.0, 0, 0, None)))
    drawn = dict(zip(names, frame.result().array("position")[0], strict=True))
    loose = prepared.redundancy.non_unique_joints
    unique = tuple(each.name for each in machine.joints if each.name not in loose)
    stiffness = _stiffness(own[0], own[1], walk)
    found, sink, why, its = Walk(), Memory(), "", None
    listener.say(f"verifying with {pair.words} elements of beams")
    silent = Listener()
    try:
        other, equations = prepare_statics(pair.machine, settings)
        start = _start(equations, other)
        writer = FrameWriter(equations, settings.modes)
        sink.begin(Header(writer.layout, {}))
        _walk(equations, start, settings, found, writer, sink, silent)
        its = _stiffness(equations, start, found) if found.points else None
    except (ModelError, SolveError, PivotError) as error:
        why = str(error)
    if found.outcome == "interrupted":
        walk.outcome = "interrupted"
        return None
    why = why or (found.ended[0] if found.ended else "")
    result = None if why else sink.result()

    def compared(own_result: Result) -> Compared:
        errors = None
        if result is not None:
            errors_of = errors_along_path if settings.arc_length else element_errors
            errors = errors_of(own_result, result, pair.factor)
        return Compared(
            pair=pair,
            result=result,
            errors=errors,
            why=why,
            drawn=drawn,
            unique=unique,
            own=stiffness,
            its=its,
            by_arc=settings.arc_length,
        )

    return compared


def _stiffness(equations: StaticEquations, start: Rest, walk: Walk) -> Stiffness | None:
    """The lowest stiffness as drawn and in the last state; None where states of elements move, or nothing can."""
    if equations.states_move:
        return None
    try:
        last = walk.points[-1].found.tangent
        drawn, loaded = (lowest(each, 1, each.M)[0] for each in (equations.tangent(start), last))
    except (PivotError, StateError, np.linalg.LinAlgError):
        return None
    return Stiffness(float(drawn[0]), float(loaded[0])) if len(drawn) and len(loaded) else None


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


def _follow(
    equations: StaticEquations, start: Rest, settings: StaticsSettings, walk: Walk, listener: Listener
) -> Iterator[Point]:
    """The equilibria in turn; how the path ended is left in `walk`."""
    iteration = Iteration(settings.tolerance, settings.most_iterations, settings.line_search)
    listener.say("looking for the first equilibrium")
    try:
        found = settle(equations, start, iteration)
    except EquilibriumError as error:
        walk.outcome, walk.ended = "failed", no_start(equations, error)
        return
    loose = None if equations.states_move else softest(found.tangent)
    as_drawn = found.iterations == 0 and not settings.duration
    if loose is not None and is_mechanism(loose) and not (settings.modes and as_drawn):
        whole = of_whole(equations, found.state, found.tangent)
        if not whole.alone:
            walk.outcome, walk.ended = "failed", without_stiffness(equations, found.state, loose)
            return
        walk.free_motions = whole.motions
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
        walk.outcome, walk.ended = "failed", path_ended(equations, walk.points[-1], steps, error, settings.arc_length)


# in place of the number of unstable directions: what is sampled has no rates, by which it could be told
NOT_JUDGED = -1


def _take(
    equations: StaticEquations,
    writer: FrameWriter,
    sink: Memory | Store,
    walk: Walk,
    point: Point,
    settings: StaticsSettings,
) -> None:
    """Frames of the critical points before an equilibrium, and of itself."""
    if equations.states_move:
        held = depends_on_samples(equations, point.state)
        count = NOT_JUDGED if held else growing_motions(equations, point.state)
    else:
        count = unstable_directions(point.found.tangent)
        walk.without_potential |= not has_potential(point.found.tangent)
    if walk.points and walk.counts[-1] != count and not equations.states_move:
        iteration = Iteration(settings.tolerance, settings.most_iterations, settings.line_search)
        critical = critical_points(equations, walk.points[-1], point, (walk.counts[-1], count), iteration)
        walk.critical += critical
        for each in critical:
            if each.found is not None:
                _write(
                    equations, writer, sink, walk, Point(each.found, each.along), min(walk.counts[-1], count), settings
                )
    _write(equations, writer, sink, walk, point, count, settings)
    # the first and the last are needed
    walk.points[1:] = [point] if walk.points else []
    walk.points = walk.points or [point]
    walk.counts.append(count)
    walk.iterations += point.found.iterations


def _write(
    equations: StaticEquations,
    writer: FrameWriter,
    sink: Memory | Store,
    walk: Walk,
    point: Point,
    count: int,
    settings: StaticsSettings,
) -> None:
    state = point.state
    r, _ = equations.evaluate(state)
    loads = equations.loads(state)
    left = float(np.max(np.abs(r), initial=0.0)) * equations.energy
    restless = restlessness(equations, state) if equations.states_move else 0.0
    found = None
    if settings.modes:
        try:
            found = vibrations(point.found.tangent, settings.modes)
            walk.rigid = max(walk.rigid, found.rigid)
        except PivotError:
            found = None
    rounded = equations.round_off(point.found.tangent, state)
    # loads that are round-off themselves are none
    shares = [each / loads if loads > UNLOADED * rounded else 0.0 for each in (left, rounded)]
    facts = Facts(point.along, max(shares[0], restless), shares[1], count, point.found.iterations, found)
    sink.take(writer.frame(state, facts))


def _find_buckling(equations: StaticEquations, walk: Walk, count: int) -> None:
    """Times at which linear extrapolation of the tangents of the first and the last equilibrium loses its stiffness."""
    first, last = walk.points[0].found, walk.points[-1].found
    try:
        factors, directions = buckling_factors(first.tangent, last.tangent, count)
    except PivotError:
        walk.ended = (
            "the first equilibrium has no positive stiffness, so no buckling loads follow from it",
            "Give the machine stiffness, or stabilising loads, at t = 0.",
        )
        walk.outcome = "failed"
        return
    span = last.state.t - first.state.t
    walk.buckling = [
        (first.state.t + float(mu) * span, direction_in_words(equations, directions[:, k]))
        for k, mu in enumerate(factors)
    ]


def _close(
    machine: MachineRecord,
    sink: Memory | Store,
    prepared: Prepared,
    walk: Walk,
    settings: StaticsSettings,
    seconds: dict[str, float],
    others: Callable[[Result], Compared] | None,
) -> Result:
    result = sink.result()
    if walk.ended is None and (loaded := loaded_free(machine, result, prepared.motion.system.size)):
        walk.outcome, walk.ended = "failed", loaded
    message, advice = walk.ended or ("", "")
    elements = others(result) if others is not None and walk.ended is None else None
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
    result = sink.close(attributes)
    if walk.ended is not None:
        raise SolveError(message, time=reached, advice=advice, result=result)
    return result
