"""A run with the second run beside it, and one with other elements of its beams: what a trust report looks at."""

from __future__ import annotations

from functools import cached_property
from math import inf

import numpy as np

from nivel.analysis.plan.plan import Plan, methods_of
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.analysis.progress.pacing import Leader
from nivel.analysis.run.dynamics import RunOutcome, march
from nivel.analysis.run.second_run import SecondRun, Verified
from nivel.errors import ModelError, SolveError
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks.accuracy import factor
from nivel.judge.after.other_elements import Compared, Pair
from nivel.judge.after.subject import Run, run_of
from nivel.lazy import dataclass, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.results.estimate import estimate_errors
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.system.beam_nodes import with_nodes
from nivel.system.system import Array


@dataclass(frozen=True)
class Options:
    """source : text of the machine's file. verify, limit [s] : of the second run. listener : hears what is done. most : work
    (`nivel.analysis.progress.pacing`) beyond which the run ends as if it was interrupted."""

    source: str
    verify: bool
    limit: float | None
    listener: Listener
    most: float = inf


@dataclass(frozen=True)
class Found:
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


@dataclass(frozen=True)
class ElementsRun:
    """The run of a `pair` in its thread."""

    pair: Pair
    run: SecondRun

    @classmethod
    def beside(cls, second: SecondRun, plan: Plan, limit: float | None) -> ElementsRun | None:
        """Of a plan that has a second run; None where there are no beams. limit [s] : as of `SecondRun`."""
        pair = nivel.judge.after.other_elements.other_elements(plan.machine)
        if pair is None:
            return None
        methods = methods_of(pair.machine, plan.methods.formulation, plan.methods.coordinates)
        other = replace(plan, machine=pair.machine, methods=methods)
        return cls(pair, SecondRun(other, limit, second, f"{pair.words} elements of beams"))

    def wait(self, listener: Listener) -> Found:
        """What it found."""
        try:
            found = self.run.wait(listener)
        except (ModelError, SolveError) as error:
            return Found(self.pair, None, f"the run cannot start: {error}")
        why = "the run has no state" if found is None else found.ended
        return Found(self.pair, found, why)


@dataclass(frozen=True)
class Attempt:
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
        finished = march(prepared, settings, [sink], progress=listener.progress, pacing=leader, listener=listener)
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


def header_of(plan: Plan, prepared: Prepared, source: str) -> Header:
    """The header of the result of a plan."""
    attributes = run_attributes(plan.asked or plan.machine, source, prepared, plan.settings, plan.reason)
    return Header(prepared.motion.system.layout, attributes)
