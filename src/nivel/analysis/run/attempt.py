"""A run with the second run beside it, and one with other elements of its beams: what a trust report looks at."""

import threading
import time as clock_of_python
from collections.abc import Callable, Iterator
from functools import cached_property
from math import ceil, gcd, inf, lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.corners import corners
from nivel.analysis.plan.plan import Plan, methods_of, with_stiff
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import Follower, Leader, interruptible
from nivel.analysis.run.dynamics import RunOutcome, march
from nivel.analysis.run.prepared_state import prepare
from nivel.errors import ModelError, SolveError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks.accuracy import factor
from nivel.judge.after.other_elements import Compared, Pair
from nivel.judge.after.subject import Run, run_of
from nivel.judge.before.refusals import sampled_times
from nivel.known import SoilUnit
from nivel.lazy import Struct, all_kept, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.results.estimate import TIMES, estimate_errors
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.system.beam_nodes import with_nodes
from nivel.system.system import Array
from nivel.words.wording import seconds

# A second run beside the first, in a thread of its own, with finer steps that fall on other times: what they are apart by is the error.

# Steps of fixed size are this much shorter in the second run: about 5/3, where one in three steps of the first ends with one of it.
FINER, LEAST_STEPS = 1.6, 3
# Where states change at given times, some of these many steps, at most, fill the time between two of them.
MOST_OF_SAMPLES = 12
# Corners meet the ends of steps where they are this near to them, as a share of the time.
NEAR = 1e-9
# Of machines with beams, whose steps are dear, they are longer: so many take as long as so many of the first run.
LONGER = (3, 5)
# Steps of the second run in one of the first where every frame is compared.
FINEST = 5
# of the tolerance, where steps are chosen
TENTH = 0.1
# A second run may do so many times the work of the first one, and at least so many evaluations: LEAST_WORK by the number of states,
# which are seconds.
MOST_TIMES, LEAST_WORK, FEW_STATES = 3.0, 2e7, 10
# [s] between two looks at a run that is waited for
LOOK = 0.02


class Refinement(Struct):
    """What a second run does otherwise.

    settings : its own, with frames at times of those of the first run. words : what it is. left : its error as a share of that of the
    first run; above 1 where its steps are longer.
    """

    settings: RunSettings
    words: str
    left: float


class Verified(Struct):
    """A second run as far as it came. until : its last frame [s]. ended : why it came to no end; empty where it did. finished, prepared,
    frames : how it ended, its machine, and what a sink has taken of it (n, width)."""

    result: Result
    refinement: Refinement
    until: float
    ended: str
    finished: RunOutcome
    prepared: Prepared
    frames: NDArray[np.float64]

    @property
    def pace(self) -> NDArray[np.float64] | None:
        """Of `nivel.integrate.loop.run.Run`."""
        return self.finished.pace


def refine(settings: RunSettings, between_samples: int = 0) -> Refinement:
    """How a second run is to differ from one with these settings.

    between_samples : whole numbers of so many fixed steps lie between times at which states are sampled, which steps have to meet; 0: none
    are.

    Half the step would look at loads where the first run does. Steps of three fifths meet the first run's in one of three, where frames
    can be compared, and what repeats itself within a step of the first run does not within one of these.
    """
    if settings.tolerance is not None:
        finer = replace(settings, tolerance=TENTH * settings.tolerance)
        return Refinement(finer, f"a tolerance of {finer.tolerance:.3g} and other, irregular steps", TENTH)
    coarse, fine = subdivision(settings, between_samples)
    finer = with_steps(settings, settings.step * coarse / fine, fine)
    words = f"steps of {seconds(finer.step)}"
    return Refinement(finer, words, (coarse / fine) ** INTEGRATORS[settings.integrator].order)


def with_steps(settings: RunSettings, step: float, every: int) -> RunSettings:
    """The same run with fixed steps [s], `every` of them between frames."""
    steps = max(1, ceil(settings.duration / step * (1.0 - 1e-12)))
    return replace(settings, step=step, every=every, steps=steps, output_interval=every * step)


def coarsened(plan: Plan) -> Refinement | None:
    """A second run with longer steps, of a machine with beams and an implicit method: it takes two thirds of the time of the first. None
    where steps have to meet given times, or would give fewer frames than estimates are kept at."""
    settings, method = plan.settings, INTEGRATORS[plan.settings.integrator]
    if not settings.steps:
        return None
    fine, coarse = LONGER
    every = settings.every * -(-coarse // settings.every)
    whole = every * fine % coarse == 0
    if not plan.machine.beams or method.needs == "evaluations" or method.multistep or _steps_to_meet(plan) or not whole:
        return None
    if not settings.steps >= TIMES * every:
        return None
    own = with_steps(settings, settings.step * coarse / fine, every * fine // coarse)
    own = replace(own, output_interval=every * settings.step)
    return Refinement(own, f"steps of {seconds(own.step)}", (coarse / fine) ** method.order)


def _steps_to_meet(plan: Plan) -> int:
    """Whole numbers of so many fixed steps lie between times that the second run's steps have to meet too; 0: there are none.

    These are samples; and corners of functions of time, where the first run's steps meet all of them and it can be had: else the second one
    has an error at them that the first has not, by which the two may agree.
    """
    step = plan.settings.step
    samples = gcd(*(round(time / step) for _, time in sampled_times(plan.machine)))
    found = [time / step for time in corners(plan.machine)] if plan.settings.steps else []
    counts = [round(each) for each in found]
    if not found or any(abs(each - count) > NEAR * count for each, count in zip(found, counts, strict=True)):
        return samples
    both = gcd(samples, *counts)
    return both if samples or steps_between(both) >= LEAST_STEPS else 0


def subdivision(settings: RunSettings, between_samples: int) -> tuple[int, int]:
    """So many steps of the first run take as long as so many of the second one; there frames of both can be compared.

    Where that gives fewer frames than estimates are kept at, errors of the first steps would be missed: then all frames are compared.
    So it is where multistep methods begin anew after every second step, since what begins them has an error of its own.
    """
    every, multistep = settings.every, INTEGRATORS[settings.integrator].multistep
    few = steps_between(between_samples, 0 if multistep else every)
    if between_samples:
        coarse = lcm(few, every)
        fine = max(few + 1, round(FINER * few)) * (coarse // few)
    else:
        coarse = ceil(LEAST_STEPS / every) * every
        fine = ceil(FINER * coarse)
    begins_anew = few < LEAST_STEPS and multistep
    if begins_anew or (coarse > every and settings.steps < TIMES * coarse):
        return every, FINEST * every
    return coarse, fine


def steps_between(samples: int, every: int = 0) -> int:
    """A part of `samples` steps of which one ends where a finer one does: the least with three steps or more, else 2 or 1. Where frames are
    `every` so many steps, it is 2 if that meets more of them."""
    if not samples:
        return LEAST_STEPS
    parts = [few for few in range(1, MOST_OF_SAMPLES + 1) if samples % few == 0]
    least = next((few for few in parts if few >= LEAST_STEPS), parts[-1])
    return 2 if 2 in parts and lcm(2, every) < lcm(least, every) else least


def most_work(first: float, states: int) -> float:
    """Work that a second run, or another choice, may do beside a first one that did so much, of a machine with so many states."""
    return max(MOST_TIMES * first, LEAST_WORK / max(states, FEW_STATES))


def _of(plan: Plan, machine: MachineRecord) -> Plan:
    methods = methods_of(machine, plan.methods.formulation, plan.methods.coordinates)
    other = replace(plan, machine=machine, methods=methods)
    return other if plan.methods.stiff is None else with_stiff(other)


def resampled(plan: Plan) -> Iterator[Plan]:
    """The plan with samples of the waves in lines at other times, farther apart or, where these are too few, closer: what a wave loses
    between two samples is an error too. None where no line is a delay."""
    machine = plan.machine
    components: tuple[Any, ...] = machine.hydraulics
    if any(each.type == "line" and each.model == "delay" for each in components):
        for share in (FINER, 1.0 / FINER):
            lines = [
                each.replace(sample_time=share * each.sample_time) if each.type == "line" else each
                for each in components
            ]
            yield _of(plan, machine.replace(hydraulics=tuple(lines)))


class SecondRun:
    """A second run of a plan in a thread; it waits for the first one to begin.

    limit [s] : how long it may go on after the first; None: up to `most_work`. beside : another second run, with finer steps; this one
    then makes the same steps as the first, of a plan that is another. prepared : the machine of the plan, not
    yet run, for this run alone; None: it is prepared in the thread.
    """

    def __init__(
        self,
        plan: Plan,
        limit: float | None,
        beside: "SecondRun | None" = None,
        words: str = "",
        prepared: Prepared | None = None,
    ) -> None:
        self._plans = [*resampled(plan)] if beside is None else []
        if beside is None:
            self.refinement = coarsened(plan) or refine(plan.settings, _steps_to_meet(plan))
            if self._plans:
                self.refinement = replace(self.refinement, words=f"{self.refinement.words} and other samples of waves")
        else:
            self.refinement = Refinement(plan.settings, words, 0.0)
        self.leader = Leader() if beside is None else beside.leader
        self._follows = beside is None
        self._plan, self._limit, self._prepared = plan, limit, None if self._plans else prepared
        self._sink = Memory()
        self._finished: RunOutcome | None = None
        self._fault: Exception | None = None
        self._stopped = threading.Event()
        self._reached = 0.0
        self._follower: Follower | None = None
        self._thread = threading.Thread(target=self._run, name="second run", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        self.leader.begun.wait()
        if self._stopped.is_set():
            return
        try:
            self._finished = self._march()
            if self._finished.outcome == "failed" and self.refinement.left > 1.0:  # longer steps are too long
                self.refinement = refine(self._plan.settings, _steps_to_meet(self._plan))
                self._sink, self._prepared = Memory(), None
                self._finished = self._march()
        except Exception as fault:  # raised where the run is waited for
            self._fault = fault

    def _march(self) -> RunOutcome:
        settings = self.refinement.settings
        prepared = self._prepared = self._prepared or self._prepare()
        self._sink.begin(Header(prepared.motion.system.layout, {}))
        chosen = settings.steps == 0 and self._follows
        self._follower = Follower(self.leader if chosen else None, settings.duration, self._stopped.is_set)
        return march(prepared, settings, [self._sink], progress=self._reach, pacing=self._follower)

    def _prepare(self) -> Prepared:
        for plan in self._plans:
            try:
                return prepare(plan.methods)
            except ModelError:  # fewer samples than a line needs, or more than are kept
                continue
        return prepare(self._plan.methods)

    def _reach(self, time: float) -> None:
        self._reached = time

    def cancel(self) -> None:
        """End it; nothing is asked of it any more."""
        self._stopped.set()
        self.leader.end()
        self._thread.join()

    def wait(self, listener: Listener) -> Verified | None:
        """What it found, when it is over, its time is spent or Ctrl-C came. None where it has no frame."""
        self.leader.end()
        listener.say(f"verifying with {self.refinement.words}", self.refinement.settings.duration)
        ended = self._watch(listener.progress)
        self._stopped.set()
        self._thread.join()
        if self._fault is not None:
            raise self._fault
        finished = self._finished
        if finished is None:
            return None
        if finished.outcome == "failed" and finished.failure is not None:
            ended = f"the second run {finished.failure[0]}"
        result = self._sink.result()
        if not len(result.time):
            return None
        if finished.outcome == "done":
            ended = self._spent()
        assert self._prepared is not None
        until, frames = float(result.time[-1]), self._sink.frames
        return Verified(result, self.refinement, until, ended, finished, self._prepared, frames)

    def _spent(self) -> str:
        """Why it is given up where its work is: the same on every computer, also where it came to its end before that was seen."""
        if self._limit is not None or self._follower is None or self._prepared is None:
            return ""
        most = most_work(self.leader.work, len(self._prepared.start))
        return f"the work for verification was spent ({most:.3g} evaluations)" if self._follower.work > most else ""

    def _watch(self, progress: Callable[[float], None] | None) -> str:
        """Wait for the thread; why it has to end before its time, where it has to."""
        begin = clock_of_python.perf_counter()
        with interruptible() as interrupted:
            while self._thread.is_alive():
                self._thread.join(LOOK)
                if progress is not None:
                    progress(self._reached)
                if interrupted():
                    return "verification was interrupted"
                if self._limit is not None and clock_of_python.perf_counter() - begin > self._limit:
                    return f"the time for verification was spent ({self._limit:.3g} s after the run)"
                if ended := self._spent():
                    return ended
        return ""


class Options(Struct):
    """source : text of the machine's file. verify, limit [s] : of the second run. listener : hears what is done. most : work
    (`nivel.analysis.progress.pacing`) beyond which the run ends as if it was interrupted."""

    source: str
    verify: bool
    limit: float | None
    listener: Listener
    most: float = inf


class Found(Struct):
    """A run with other elements as far as it came; None where it has no frame. why : it did not come to its end."""

    pair: Pair
    verified: Verified | None
    why: str

    def compared(self, machine: MachineRecord, result: Result) -> Compared:
        """What follows for a result of a machine."""
        other = self.verified.result if self.verified is not None else None
        errors = (
            nivel.judge.after.other_elements.element_errors(result, other, self.pair.factor)
            if other is not None
            else None
        )
        return Compared(pair=self.pair, result=other, errors=errors, why=self.why, drawn=_drawn(machine, result))


def _drawn(machine: MachineRecord, result: Result) -> dict[str, Array] | None:
    """Where nodes of beams stand (3,) [m] before an equilibrium at the start loads them; None where they are not placed as drawn."""
    if machine.simulation.start != "equilibrium" or any(joint.start for joint in machine.joints):
        return None
    names = result.coordinates["body"]
    return {body.name: np.array(body.position) for body in with_nodes(machine).bodies if body.name in names}


class ElementsRun(Struct):
    """The run of a `pair` in its thread."""

    pair: Pair
    run: SecondRun

    @classmethod
    def beside(cls, second: SecondRun, plan: Plan, limit: float | None) -> "ElementsRun | None":
        """Of a plan that has a second run; None where there are no beams. limit [s] : as of `SecondRun`."""
        pair = nivel.judge.after.other_elements.other_elements(plan.machine)
        if pair is None:
            return None
        return cls(pair, SecondRun(_of(plan, pair.machine), limit, second, f"{pair.words} elements of beams"))

    def wait(self, listener: Listener) -> Found:
        """What it found."""
        try:
            found = self.run.wait(listener)
        except (ModelError, SolveError) as error:
            return Found(self.pair, None, f"the run cannot start: {error}")
        why = "the run has no state" if found is None else found.ended
        return Found(self.pair, found, why)


class Attempt(Struct):
    """A run as far as it came. result, frames : as the sinks have them; frames are none where a file has them."""

    plan: Plan
    prepared: Prepared
    finished: RunOutcome
    result: Result
    frames: Array
    verified: Verified | None = None
    found: Found | None = None

    @cached_property
    def run(self) -> Run:
        """What the trust report looks at, with what follows from the second run and from the one with other elements."""
        estimate = None
        if self.verified is not None:
            estimate = estimate_errors(self.result, self.verified.result, factor(self.verified.refinement.left))
        run = run_of(self.plan, self.prepared, self.finished, self.result)
        elements = None if self.found is None else self.found.compared(self.plan.machine, self.result)
        return replace(run, second=self.verified, estimate=estimate, elements=elements)


def attempt(plan: Plan, sink: Memory | Store, options: Options, prepared: Prepared) -> Attempt:
    """Run as planned."""
    settings, listener = plan.settings, options.listener
    second = SecondRun(plan, options.limit, prepared=prepared.again()) if options.verify else None
    elements = ElementsRun.beside(second, plan, options.limit) if second is not None else None
    try:
        sink.begin(header_of(plan, prepared, options.source))
        listener.say("running", settings.duration)
        leader = Leader() if second is None else second.leader
        leader.most = options.most
        soils = [each for each in prepared.motion.system.units if isinstance(each, SoilUnit)]
        pacing = nivel.results.terrain.TerrainLog(soils, settings.output_interval, leader) if soils else leader
        finished = march(prepared, settings, [sink], progress=listener.progress, pacing=pacing, listener=listener)
        if not isinstance(pacing, Leader):
            pacing.keep(finished.last[0] if finished.last else 0.0)
            finished.terrain = pacing.attribute
        if finished.work > options.most:  # in the last chunk of steps
            finished.outcome = "interrupted"
        verified = None
        if second is not None and finished.outcome == "done" and not finished.asked_to_stop:
            verified = second.wait(listener)
        found = elements.wait(listener) if elements is not None and verified is not None else None
    finally:
        if second is not None:
            second.cancel()
        if elements is not None:
            elements.run.cancel()
    frames = sink.frames if isinstance(sink, Memory) else np.zeros((0, 0))
    return Attempt(plan, prepared, finished, sink.result(), frames, verified, found)


@all_kept()
def header_of(plan: Plan, prepared: Prepared, source: str) -> Header:
    """The header of the result of a plan."""
    attributes = run_attributes(plan.asked or plan.machine, source, prepared, plan.settings, plan.reason)
    return Header(prepared.motion.system.layout, attributes)
