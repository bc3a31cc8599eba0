"""Motion in time: build, assemble, march in chunks, feed the sinks."""

from __future__ import annotations

import time as clock_of_python
from collections.abc import Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.assemble import Assembly, assemble
from nivel.analysis.equations import MotionEquations, equations
from nivel.analysis.interrupt import interruptible
from nivel.analysis.listener import Progress
from nivel.analysis.outcome import failure
from nivel.analysis.redundancy import Redundancy, analyse
from nivel.analysis.refusals import refuse_deep_starts, refuse_rough_motions, refuse_uncertain_loads
from nivel.analysis.settings import RunSettings
from nivel.errors import Fault, ModelError
from nivel.kernels.handle import Handle
from nivel.kernels.status import BUDGET_SPENT, BUFFER_FULL, DONE
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import INTEGRATORS
from nivel.march.run import (
    ALL_STEPS,
    BUDGET,
    COUNTS,
    DONE_STEPS,
    END,
    EVALUATIONS,
    EVERY,
    FRAMES,
    LAST_FRAME,
    STEP,
    TIME,
    Run,
)
from nivel.march.sink import Sink
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import FORMULATIONS

# A chunk of the loop lasts about this long [s]; between chunks frames are written and Ctrl-C is looked at.
CHUNK = 0.05
BUFFER_BYTES = 1_000_000
# Stiction stops a joint within this many steps.
STICK_STEPS = 2.0


@dataclass(frozen=True)
class Prepared:
    """A machine ready to run: its equations, its assembled state, its redundancy, the number of its drivers."""

    motion: MotionEquations
    assembly: Assembly
    redundancy: Redundancy
    drivers: int


@dataclass
class Finished:
    """How a run ended. outcome: done, interrupted or failed; failure: (message, advice, time [s])."""

    outcome: str
    timing: dict[str, float] = field(default_factory=dict)
    failure: tuple[str, str, float] | None = None


def prepare(machine: MachineRecord, formulation: str) -> Prepared:
    """Build and assemble `machine`.

    Raises ModelError where it cannot be closed, starts in a singular position, or has friction of no certain load.
    """
    motion = equations(machine, formulation)
    assembly = assemble(machine, motion)
    redundancy = analyse(motion, 0.0, assembly.y)
    if redundancy.singular_rows:
        rows = ", ".join(redundancy.singular_rows)
        message = f"the machine starts in a singular position: {rows} adds nothing here but does nearby; start it a little aside"
        raise ModelError(Fault("", 0, 0, "machine", message))
    refuse_uncertain_loads(machine, redundancy)
    refuse_rough_motions(machine)
    rank = len(motion.system.rows) - len(redundancy.redundant_rows)
    motion = MotionEquations(motion.system.known_rank(rank), motion.kernels)
    refuse_deep_starts(machine, motion, assembly.y)
    return Prepared(motion, assembly, redundancy, len(machine.drivers))


def march(
    prepared: Prepared,
    settings: RunSettings,
    sinks: Sequence[Sink],
    *,
    progress: Progress | None = None,
    chunk_steps: int | None = None,
) -> Finished:
    """Run `prepared` and give every frame to all `sinks` (already begun).

    progress : called with the time reached [s] after every chunk. chunk_steps : steps a chunk, instead of as many as fit into 50 ms;
    the result does not depend on it.
    """
    system = prepared.motion.system
    stabilisation = STABILISATIONS[settings.stabilisation]
    alpha, beta = settings.baumgarte or (None, None)
    system.record.control.stabilise[:] = stabilisation.coefficients(settings.step, alpha, beta)
    kernels, formulation = prepared.motion.kernels, FORMULATIONS[settings.formulation]
    correct = import_module(formulation.correction).correct if stabilisation.CORRECTS else kernels.keep
    facts = INTEGRATORS[settings.integrator]
    step = getattr(import_module(facts.module), facts.function)
    advance = import_module("nivel.march.loop").advance
    run = _start(prepared, settings, facts.stages)
    machine, history = prepared.motion.handle, Handle(run)
    finished = Finished("done")
    wall = clock_of_python.perf_counter()
    budget, loop_seconds, status = chunk_steps or 1, 0.0, BUDGET_SPENT
    with interruptible() as interrupted:
        while status in (BUDGET_SPENT, BUFFER_FULL):
            run.counter[BUDGET] = budget
            begin = clock_of_python.process_time()
            status = advance(kernels.evaluate, correct, step, machine.address, history.address)
            spent = clock_of_python.process_time() - begin
            loop_seconds += spent
            _give(run, sinks)
            if progress is not None:
                progress(float(run.clock[TIME]))
            if chunk_steps is None and status == BUDGET_SPENT:
                budget = (
                    max(1, min(2 * budget, int(budget * CHUNK / max(spent, 1e-9))))
                    if spent < CHUNK
                    else max(1, budget // 2)
                )
            if status in (BUDGET_SPENT, BUFFER_FULL) and interrupted():
                finished.outcome = "interrupted"
                break
    if status not in (BUDGET_SPENT, BUFFER_FULL, DONE):
        finished.outcome = "failed"
        message, advice = failure(prepared.motion, status, float(run.clock[TIME]), settings.step, run.previous)
        finished.failure = (message, advice, float(run.clock[TIME]))
    finished.timing = {
        "steps": int(run.counter[DONE_STEPS]),
        "evaluations": int(run.counter[EVALUATIONS]),
        "loop_seconds": loop_seconds,
        "wall_seconds": clock_of_python.perf_counter() - wall,
    }
    return finished


def _start(prepared: Prepared, settings: RunSettings, stages: int) -> Run:
    """History of a run at its start: energies referred to the assembled state, joint angles followed from it, nothing remembered."""
    system = prepared.motion.system
    y = prepared.assembly.y.copy()
    width = system.layout.width
    rows = max(2, min(4096, BUFFER_BYTES // (8 * width)))
    clock = np.zeros(4)
    clock[STEP], clock[END] = settings.step, settings.duration
    count = np.zeros(COUNTS, dtype=np.int64)
    count[ALL_STEPS], count[EVERY], count[LAST_FRAME] = settings.steps, settings.every, -1
    record = system.record
    record.coordinates.reference[:] = prepared.assembly.reference
    record.elements.memory[:] = 0.0
    record.elements.proposal[:] = 0.0
    record.friction.force[:] = 0.0
    record.control.stick[0] = STICK_STEPS * settings.step
    system.record.control.energy[:] = 0.0
    prepared.motion.evaluate(0.0, y)
    observe: Any = import_module("nivel.kernels.observe").observe
    observe(prepared.motion.handle.address, 0.0, y, np.zeros(width))
    energy = system.record.control.energy
    energy[2] = energy[0] + energy[1]
    return Run(
        clock=clock,
        counter=count,
        y=y,
        rate=np.zeros_like(y),
        previous=y.copy(),
        scratch=np.zeros_like(y),
        stages=np.zeros((stages, len(y))),
        frames=np.zeros((rows, width)),
    )


def _give(run: Run, sinks: Sequence[Sink]) -> None:
    filled = int(run.counter[FRAMES])
    if filled:
        for sink in sinks:
            sink.take(run.frames[:filled])
        run.counter[FRAMES] = 0
