"""Motion in time: advance in chunks, feed the sinks, say how it ended."""

import threading
import time as clock_of_python
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from re import sub
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.penalties import feedback, of_rows
from nivel.analysis.curves.corners import jumping_functions
from nivel.analysis.plan.compilation import build, preparation_entries
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.preparation import Prepared, sharing, with_integrator
from nivel.analysis.progress.log import Listener, Progress
from nivel.analysis.progress.pacing import Pacing, interruptible, work
from nivel.analysis.run.history import go_on_with, start_history
from nivel.analysis.run.narrow_features import LONGEST, NarrowFeatures, narrow_functions
from nivel.analysis.run.probes import Probes
from nivel.integrate.explicit.dormand_prince import STIFF
from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import Run
from nivel.integrate.loop.sink import Sink
from nivel.integrate.stabilise import STABILISATIONS, Stabilisation
from nivel.judge.during.failure import Status, Stop, failure
from nivel.judge.during.growth import GROWN, UNBOUND, Crawl, fastest_beyond, held_step, to_and_fro
from nivel.judge.during.lockup import Jam, branching_advice, branching_joints, can_be_asked, find_jam
from nivel.judge.during.stop import NO_NUMBER
from nivel.kernels.core.block import Handle
from nivel.kernels.output.observe import observe
from nivel.kernels.record.hook import FAMILIES
from nivel.lazy import Struct, field, nivel, replace
from nivel.native.entry import Entry
from nivel.results.frames.summary import Occurrence
from nivel.system.system import Array, System

# A chunk of the loop lasts about this long [s]; between chunks frames are written and Ctrl-C is looked at. Steps of one, at most.
CHUNK = 0.05
MOST_STEPS = 1_000_000_000
GOES_ON = (Status.BUDGET_SPENT, Status.BUFFER_FULL)
# What a method may end with near a position that its machine cannot pass.
BEFORE_A_JAM = (
    Status.SINGULAR,
    Status.NOT_CLOSED,
    Status.OPEN,
    Status.NOT_CONVERGED,
    Status.NOT_FINITE,
    Status.STEP_TOO_SMALL,
    Status.MULTIPLIERS_NOT_FOUND,
)
_ONE_AT_A_TIME = threading.Lock()
# What a run ends with whose steps shrink.
SHRUNK = (Status.OUT_OF_REACH, Status.CRAWLS, Status.STEP_TOO_SMALL, Status.NOT_CONVERGED)


class RunOutcome(Struct, frozen=False):
    """How a run ended. outcome: done, interrupted or failed; failure: (message, advice, time [s]).

    events : in the order of time. stopped_by : name of the event that ended the run. asked_to_stop : Ctrl-C came; also while the last
    steps were made, so that the run itself is done. pace : of `nivel.integrate.loop.run.Run`. last : (time [s], y) at the end, of a
    run that failed in the last state that was accepted. status : of the compiled loop.
    ends : (n,) [s] the start and the ends of all steps, where steps were chosen and looked at; impulses, hurried : of `NarrowFeatures`.
    went_on : the integrator that went on where the run became stiff, and from when [s].
    between_frames : of `Probes`. pulse : what a function does that no frame shows, in words, where a
    trust report was made. work : of `nivel.analysis.progress.pacing`. terrain : of `nivel.results.terrain`.
    """

    outcome: str
    events: list[Occurrence] = field(default_factory=list)
    stopped_by: str = ""
    asked_to_stop: bool = False
    timing: dict[str, float] = field(default_factory=dict)
    failure: tuple[str, str, float] | None = None
    pace: Array | None = None
    last: tuple[float, Array] | None = None
    status: int = Status.DONE
    ends: Array | None = None
    impulses: dict[str, float] = field(default_factory=dict)
    hurried: set[str] = field(default_factory=set)
    went_on: tuple[str, float] | None = None
    between_frames: dict[str, list[float]] = field(default_factory=dict)
    pulse: str = ""
    work: int = 0
    terrain: str = ""


class Loop(NamedTuple):
    """What a compiled loop works on: entries of the equations, of what puts states back and of the step, where there is one, the machine's
    record, that of the run. driver : the loop itself."""

    evaluate: Entry
    correct: Entry
    step: Entry | None
    machine: Handle
    history: Handle
    driver: Entry = advance

    @property
    def codes(self) -> list[Entry]:
        """What the loop is called with before the records."""
        return [each for each in (self.evaluate, self.correct, self.step) if each is not None]

    @property
    def addresses(self) -> tuple[int, ...]:
        """What the loop is called with."""
        return *(each.address for each in self.codes), int(self.machine.address), int(self.history.address)

    def advance(self) -> int:
        """Go on for the budget of steps in the history's counter. Returns a status."""
        return self.driver(*self.addresses)

    def entries_on(self, numbers: str) -> list[Entry]:
        """The machine code that it needs on other numbers, `whole` or `packed`, but for laws and expressions."""
        record = self.machine.record
        used = dict.fromkeys((*record.hooks.address, *record.elements.address))
        families = [FAMILIES[int(address)] for address in used if address]
        return [getattr(each, numbers) for each in (*self.codes, self.driver, *families)]


def on_numbers(used: Any, numbers: str, machine: Any, laws: Sequence[int]) -> Any:
    """`machine`, which is the record `used` on other numbers, `whole` or `packed`, with the code for these. laws : of its functions."""

    def families(addresses: NDArray[np.uint64]) -> NDArray[np.uint64]:
        found = [getattr(FAMILIES[int(each)], numbers).address if each else 0 for each in addresses]
        return np.array(found, dtype=np.uint64)

    return machine._replace(
        hooks=machine.hooks._replace(address=families(used.hooks.address)),
        elements=machine.elements._replace(address=families(used.elements.address)),
        functions=machine.functions._replace(address=np.array(laws, dtype=np.uint64)),
    )


class LoopOnNumbers:
    """A loop on other numbers, `whole` or `packed`. machine, run : its records on these."""

    def __init__(self, loop: Loop, numbers: str, machine: Any, run: Any) -> None:
        self.machine, self.run, self._advance = machine, run, getattr(loop.driver, numbers)
        self.handle, self._history = Handle(self.machine), Handle(self.run)
        codes = (getattr(each, numbers).address for each in loop.codes)
        self.addresses = *codes, int(self.handle.address), int(self._history.address)

    def advance(self) -> int:
        """Go on for the budget of steps in the counter of the run. Returns a status."""
        return self._advance(*self.addresses)


def march(
    prepared: Prepared,
    settings: RunSettings,
    sinks: Sequence[Sink],
    *,
    progress: Progress | None = None,
    chunk_steps: int | None = None,
    pacing: Pacing | None = None,
    loop: Loop | None = None,
    shared: bool = True,
    listener: Listener | None = None,
) -> RunOutcome:
    """Run `prepared` and give every frame to all `sinks` (already begun).

    progress : called with the time reached [s] after every chunk. chunk_steps : steps a chunk, instead of as many as fit into 50 ms;
    the result does not depend on it. pacing : accompanies the run from chunk to chunk. loop : at its start; by default a new one.
    shared : redundant joints share their loads. listener : hears of machine code that is compiled where the run becomes stiff.
    """
    system, loop = prepared.motion.system, loop or start_loop(prepared, settings)
    run, sinks = loop.history.record, sharing(prepared, sinks) if shared else sinks
    finished, narrow = RunOutcome("done"), NarrowFeatures.of(prepared, len(run.ends))
    probes = Probes.of(prepared.motion, run, settings.duration) if sinks else None
    sinks = sinks if probes is None else (probes, *sinks)
    wall = clock_of_python.perf_counter()
    status, loop_seconds, jam = Status.BUDGET_SPENT, 0.0, None
    crawl = None
    if settings.steps == 0:
        crawl = Crawl(settings.duration, bool(prepared.jumping), partial(_branches, prepared), system)
    while status in GOES_ON and finished.outcome == "done":
        status, spent = march_in_chunks(
            loop.advance, system, run, sinks, finished, progress, chunk_steps, pacing, crawl, narrow, probes
        )
        loop_seconds += spent
        if status == STIFF:
            prepared, loop = gone_on(prepared, settings, loop, listener)
            settings, run = replace(settings, integrator=prepared.integrator.name), loop.history.record
            finished.went_on, status = (settings.integrator, float(run.clock[of_run.TIME])), Status.BUDGET_SPENT
            if narrow is not None:
                narrow.follow(prepared)
            if probes is not None:
                probes.motion = prepared.motion
        if status in BEFORE_A_JAM:
            jam = jam_of(prepared, settings, run)
        if status == Status.OPEN and jam is None and can_be_asked(prepared):
            accept_open(prepared.motion, run)
            status = Status.BUDGET_SPENT
    if run.counter[of_run.STOPPED]:
        finished.stopped_by = system.events[run.counter[of_run.STOPPED] - 1]
    if status not in (*GOES_ON, Status.DONE):
        finished.outcome = "failed"
        finished.failure = failure_of(prepared, settings, run, status, jam)
        if status != Status.CONTRADICTION:
            keep_last(prepared.motion, run, sinks)
    if probes is not None:
        finished.between_frames = probes.close()
    failed = finished.outcome == "failed"
    finished.pace, finished.status, finished.work = run.pace, int(status), work(run)
    finished.last = (
        float(run.clock[of_run.ACCEPTED if failed else of_run.TIME]),
        (run.previous if failed else run.y).copy(),
    )
    if narrow is not None:
        finished.ends, finished.impulses, finished.hurried = narrow.ends, narrow.impulses, narrow.hurried
    finished.timing = {
        **counts_of(system, run),
        "loop_seconds": loop_seconds,
        "wall_seconds": clock_of_python.perf_counter() - wall,
    }
    return finished


def start_loop(prepared: Prepared, settings: RunSettings, *, at_switches: bool = False) -> Loop:
    """The compiled loop at the start of a run of `prepared`. at_switches : see `nivel.analysis.run.history.start_history`."""
    stabilisation = STABILISATIONS[settings.stabilisation]
    _feed_back(prepared.motion.system, settings, stabilisation)
    kernels, facts = prepared.motion.kernels, prepared.integrator
    correct = import_module(prepared.path.correction).correct if stabilisation.corrects else kernels.normalise_state
    run = start_history(prepared, settings, facts, _kept_ends(prepared, settings), at_switches)
    run.counter[of_run.CONSERVE] = int(stabilisation.conserves)
    step = facts.step
    return Loop(kernels.evaluate, correct, step, prepared.motion.handle, Handle(run))


def gone_on(
    prepared: Prepared, settings: RunSettings, loop: Loop, listener: Listener | None = None
) -> tuple[Prepared, Loop]:
    """The machine and the loop of a run that has become stiff, with the integrator that goes on from the accepted state; compiled first
    where there is no machine code."""
    methods = None if prepared.methods is None else prepared.methods.stiff
    assert methods is not None
    with _ONE_AT_A_TIME:  # the second run does the same at about that time
        build([*preparation_entries(methods), methods.integrator.step], listener or Listener())
        other = with_integrator(prepared, methods, loop.history.record.y)
    run = go_on_with(other, settings, loop.history.record)
    return other, loop._replace(step=other.integrator.step, machine=other.motion.handle, history=Handle(run))


def _kept_ends(prepared: Prepared, settings: RunSettings) -> int:
    """Of how many steps it is kept when they ended: where they are chosen and a function may have narrow features. Units do not go back."""
    if (
        settings.steps > 0
        or prepared.motion.system.units
        or prepared.machine is None
        or not narrow_functions(prepared.machine)
    ):
        return 0
    return LONGEST + 1


def _feed_back(system: System, settings: RunSettings, stabilisation: Stabilisation) -> None:
    """Set what the stabilisation, or a penalty method, adds to the accelerations of the constraints, and what it leaves open."""
    control, own = system.record.control, settings.asked.baumgarte
    control.stabilise[:] = stabilisation.coefficients(settings.step, *(settings.baumgarte or (None, None)))
    rows = np.tile(control.stabilise[:2], (len(system.rows), 1))
    if settings.penalty is not None:
        rows = feedback(system, settings.penalty, settings.step, stabilisation.corrects)
    elif settings.stabilisation == "baumgarte" and own is not None:
        for row, each in of_rows(system, own.rows, "simulation.baumgarte").items():
            rows[row] = stabilisation.coefficients(settings.step, each.alpha, each.beta)[:2]
    same = not len(rows) or bool((rows == rows[0]).all())
    if len(rows):
        control.stabilise[:2] = rows[0] if same else 1.0
    control.feedback[:] = 1.0 if same else rows


def march_in_chunks(
    advance: Callable[[], int],
    system: System,
    run: Run,
    sinks: Sequence[Sink],
    finished: RunOutcome,
    progress: Progress | None,
    chunk_steps: int | None,
    pacing: Pacing | None = None,
    crawl: Crawl | None = None,
    narrow: NarrowFeatures | None = None,
    probes: Probes | None = None,
) -> tuple[int, float]:
    """The last status, and the time [s] spent in the compiled loop. Events, and an interruption, are noted in `finished`."""
    budget, loop_seconds, status = chunk_steps or 1, 0.0, Status.BUDGET_SPENT
    since = 0.0  # [s] in the loop since frames were given: a block of few frames costs sinks what one of many does
    with interruptible() as interrupted:
        while status in GOES_ON:
            if pacing is not None and not pacing.before(run):
                finished.outcome = "interrupted"
                break
            if probes is not None and narrow is None:
                probes.before(run)
            run.counter[of_run.BUDGET] = budget if narrow is None else narrow.before(run, budget)
            begin = clock_of_python.thread_time()
            status = advance()
            spent = clock_of_python.thread_time() - begin
            loop_seconds += spent
            since += spent
            cut = probes is not None and probes.is_due(run)
            if chunk_steps is None and status == Status.BUDGET_SPENT and not cut:
                budget = _next_budget(budget, spent)
            if probes is not None and narrow is None:
                probes.after(run)
            if narrow is not None:
                narrow.hold(run)
                if not narrow.is_whole(run, goes_on=status in GOES_ON) and not interrupted():
                    continue
                if not interrupted() and not narrow.stands(
                    run, goes_on=status in (Status.BUDGET_SPENT, Status.DONE, STIFF)
                ):
                    status = Status.BUDGET_SPENT
                    continue
                give_held(narrow, run, system, sinks, finished, goes_on=status in (*GOES_ON, STIFF))
            if since >= CHUNK or status != Status.BUDGET_SPENT or narrow is not None or chunk_steps is not None:
                give_frames(run, sinks)
                since = 0.0
            if probes is not None and status == Status.BUDGET_SPENT:
                probes.look(run)
            finished.events += taken_events(run, system.events)
            if progress is not None:
                progress(float(run.clock[of_run.TIME]))
            if pacing is not None:
                pacing.after(run)
            if crawl is not None and status in GOES_ON:
                status = crawl.seen(run) or status
            if status in GOES_ON and interrupted():
                finished.outcome = "interrupted"
                break
        if narrow is None:
            give_frames(run, sinks)
        finished.asked_to_stop = interrupted()
    return status, loop_seconds


def _next_budget(budget: int, spent: float) -> int:
    """Steps of the next chunk, after one of `budget` steps took `spent` [s]: as many as last for CHUNK, at most twice as many."""
    if spent < CHUNK:
        return max(1, int(min(2 * budget, budget * CHUNK / max(spent, 1e-9), MOST_STEPS)))
    return max(1, budget // 2)


def jam_of(prepared: Prepared, settings: RunSettings, run: Run) -> Jam | None:
    """The jam in or beside the step after the last accepted state."""
    time = float(run.clock[of_run.ACCEPTED])
    step = max(float(run.clock[of_run.STEP]), float(run.clock[of_run.TIME]) - time)
    return find_jam(prepared, time, step, settings.step, settings.duration, run.previous)


def _branches(prepared: Prepared, run: Run) -> bool:
    return bool(branching_joints(prepared, float(run.clock[of_run.ACCEPTED]), run.previous))


def accept_open(motion: MotionEquations, run: Run) -> None:
    """Let the run go on with joints that are open, as they can be closed: they have drifted. Looked at again when that has doubled."""
    motion.evaluate(float(run.clock[of_run.TIME]), run.y)
    constraints = motion.system.record.constraints
    share = float(np.max(np.abs(constraints.C) / constraints.scale))
    run.clock[of_run.OPEN_LIMIT] = 2.0 * max(share, run.clock[of_run.OPEN_LIMIT]) if np.isfinite(share) else np.inf


def failure_of(
    prepared: Prepared, settings: RunSettings, run: Run, status: int, jam: Jam | None
) -> tuple[str, str, float]:
    """(message, advice, time [s]) of a run that failed."""
    facts, time = prepared.integrator, float(run.clock[of_run.ACCEPTED])
    if jam is not None:
        return f"stopped at t = {time:.6g} s: {jam.message}", jam.advice, time
    explicit = settings.steps > 0 and facts.kind == "explicit"
    stop = Stop(
        prepared.motion,
        status,
        time,
        float(run.clock[of_run.STEP]),
        run.previous,
        chosen_by=settings.integrator if settings.steps == 0 else "",
        beams=prepared.beams if explicit else (),
        jumping=_jumping(prepared, run),
    )
    message, advice = failure(stop)
    if status == Status.NO_VOLUME and prepared.machine is not None:  # for what `nivel check` says of the circuit
        said = [
            str(remark.fault).removeprefix("hydraulics.")
            for remark in nivel.judge.before.circuits.circuit_remarks(prepared.machine.hydraulics)
        ]
        advice = ". ".join(said) if said else advice
    if status in SHRUNK and stop.chosen_by and (joints := branching_joints(prepared, time, run.previous)):
        message, advice = branching_advice(joints, stop.step)
        message = f"stopped at t = {time:.6g} s: {message}"
    return (*(_with_fastest(prepared, settings, run, message, advice) if explicit else (message, advice)), time)


def _jumping(prepared: Prepared, run: Run) -> tuple[str, ...]:
    """Functions that jump: those that turn to and fro, where there are any."""
    turning = to_and_fro(run, prepared.motion.system)
    few = jumping_functions(prepared.machine, turning) if prepared.machine is not None and turning else ()
    return few or prepared.jumping


def _with_fastest(prepared: Prepared, settings: RunSettings, run: Run, message: str, advice: str) -> tuple[str, str]:
    """Message and advice, led by the part that is too fast for the step where there is one. Where it is so from the start, and the state
    has grown without bound, a function that has no value in the end only shows that."""
    time = float(run.clock[of_run.ACCEPTED])
    found = fastest_beyond(prepared, settings.integrator, settings.step, time, run.previous)
    if found is None:
        return message, advice
    of = f", of {found.part}" if found.part else ""
    step = held_step(settings.integrator, found.rate)
    cause = (
        f"The fastest rate here is {found.rate:.2g}/s{of}: {settings.integrator} holds it with steps below {step:.2g} s, "
        f"`integrator: radau` with any."
    )
    start, last = (float(np.max(np.abs(y), initial=0.0)) for y in (prepared.start, run.previous))
    if NO_NUMBER in message and found.time == 0.0 and not last < GROWN * max(start, prepared.motion.system.size):
        return f"stopped at t = {time:.6g} s: {UNBOUND}; a step of {settings.step:.3g} s is too long for it", cause
    return message, f"{cause} {_no_longer_than(step, advice)}"


def _no_longer_than(step: float, advice: str) -> str:
    """The advice, with a proposed step that is longer than this one [s] in place of it."""
    return sub(r"--step ([\d.e-]+\d)", lambda given: f"--step {min(float(given[1]), 0.5 * step):.2g}", advice)


def counts_of(system: System, run: Run) -> dict[str, float]:
    """What the run did how often; of partitions, how often independent coordinates were chosen anew."""
    return {
        "steps": int(run.counter[of_run.DONE_STEPS]),
        "evaluations": int(run.counter[of_run.EVALUATIONS]),
        "iterations": int(run.counter[of_run.ITERATIONS]) + int(system.record.control.iterations[1]),
        "factorisations": int(run.counter[of_run.FACTORISATIONS]),
        "rejected": int(run.counter[of_run.REJECTED]),
        "unconserved": int(run.counter[of_run.UNCONSERVED]),
        "guarded": int(system.record.circuit.guard[0]),
        "pressure_difference": float(system.record.circuit.guard[1]),
        "partitions": max(0, int(system.record.partition.choices.sum()) - 1),
    }


def keep_last(motion: MotionEquations, run: Run, sinks: Sequence[Sink]) -> None:
    """Give the last accepted state before a failure, where it lies after the last frame and its accelerations are numbers."""
    t, feedback = float(run.clock[of_run.ACCEPTED]), motion.system.record.control.stabilise[:2]
    if not t > run.clock[of_run.SHOWN] or not np.isfinite(run.previous).all():
        return
    kept = feedback.copy()
    # as in all frames, accelerations are those without Baumgarte's feedback
    feedback[:] = 0.0
    if motion.holds(t, run.previous):
        frame = np.zeros((1, motion.system.layout.width))
        frame[0, 0] = t
        observe(motion.handle.address, t, run.previous, frame[0])
        if np.isfinite(frame).all():
            for sink in sinks:
                sink.take(frame)
    feedback[:] = kept


def give_frames(run: Run, sinks: Sequence[Sink]) -> None:
    filled = int(run.counter[of_run.FRAMES])
    if filled:
        for sink in sinks:
            sink.take(run.frames[:filled])
        run.counter[of_run.FRAMES] = 0


def give_held(
    narrow: NarrowFeatures, run: Run, system: System, sinks: Sequence[Sink], finished: RunOutcome, *, goes_on: bool
) -> None:
    """Give the frames and events of a stretch that may stand."""
    frames, events = narrow.released(run, goes_on=goes_on)
    if len(frames):
        for sink in sinks:
            sink.take(frames)
    finished.events += occurrences(events, system.events)


def taken_events(run: Run, names: tuple[str, ...]) -> list[Occurrence]:
    """Events of the buffer, which is empty then."""
    filled = int(run.counter[of_run.EVENTS])
    run.counter[of_run.EVENTS] = 0
    return occurrences(run.events[:filled], names)


def occurrences(events: Array, names: tuple[str, ...]) -> list[Occurrence]:
    """Events (n, 3) of a run: time [s], number, direction."""
    return [
        Occurrence(names[int(number)], float(time), "rising" if direction > 0.0 else "falling")
        for time, number, direction in events
    ]
