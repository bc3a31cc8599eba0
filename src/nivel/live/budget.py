"""What a machine costs in real time, found without operating it: ticks as fast as they go, by method and by part."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from nivel.analysis.compilation import build, run_entries
from nivel.analysis.listener import Listener
from nivel.errors import ModelError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.paced import CLOCK, DEADLINE, DONE, HEARD, NOW, PACED, SLEEP, SPEED, TICKS, drive
from nivel.integrate.repeated import repeat_evaluation, repeat_family
from nivel.integrate.run import DONE_STEPS, EVALUATIONS
from nivel.kernels.observe import observe
from nivel.kernels.status import BUDGET_SPENT
from nivel.live.preparation import LiveRun, live_plan, prepared_run
from nivel.live.shared import bytes_of, live_in
from nivel.live.system_clock import clock_addresses
from nivel.live.timing import Timing, timing_of
from nivel.machine import MachineRecord
from nivel.native import library
from nivel.system.hydraulics.components import families_of

DURATION: Final = 2.0  # s simulated, at least so many ticks
TICKS_AT_LEAST: Final = 2000
REPEATED: Final = 300  # calls of a part that is timed
AT_ONCE: Final = 20  # of short ones


@dataclass(frozen=True)
class Cost:
    """What a method costs. problem : why it does not run, or empty. parts : share of the computing time by part, where that is known."""

    integrator: str
    timing: Timing | None
    parts: Mapping[str, float]
    problem: str = ""


def fixed_methods() -> list[str]:
    """Integrators that can have fixed steps."""
    return [name for name, facts in INTEGRATORS.items() if not facts.chooses_steps]


def is_compiled(machine: MachineRecord, settings: Mapping[str, Any], tick: float | None) -> bool:
    """Whether a live run with these settings needs no compiler. Raises ModelError where there is no such run."""
    plan, _ = live_plan(machine, settings, tick)
    return not library.missing([*run_entries(plan), drive])


def costs(
    machine: MachineRecord,
    settings: Mapping[str, Any],
    tick: float | None,
    integrators: Iterable[str],
    *,
    compiled_only: bool,
    listener: Listener | None = None,
) -> Iterator[Cost]:
    """The cost of each method, with inputs at rest. compiled_only : those that would have to be compiled first are left out."""
    for name in integrators:
        chosen = {**settings, "integrator": name}
        try:
            if compiled_only and not is_compiled(machine, chosen, tick):
                continue
            plan, pace = live_plan(machine, chosen, tick)
            build([*run_entries(plan), drive, repeat_evaluation, repeat_family], listener)
            yield _cost(name, prepared_run(plan, pace))
        except ModelError as error:
            yield Cost(name, None, {}, error.faults[0].message)


def _cost(name: str, live_run: LiveRun) -> Cost:
    live = live_in(bytearray(bytes_of(live_run.sizes)), live_run.sizes)
    loop = live_run.begin(live)
    live.address[[CLOCK, SLEEP]] = clock_addresses()
    live.address[[NOW, DEADLINE]] = live.now.ctypes.data, live.deadline.ctypes.data
    # every deadline has passed already
    live.clock[SPEED] = 1e12
    live.control[PACED] = 1
    live.control[TICKS] = max(TICKS_AT_LEAST, int(DURATION / live_run.pace.tick))
    live.control[HEARD] = time.clock_gettime_ns(time.CLOCK_MONOTONIC)
    status = loop()
    timing = timing_of(live)
    if status != BUDGET_SPENT:
        return Cost(name, None, {}, f"the run ends after {int(live.control[DONE])} ticks")
    idle = _seconds(lambda: _nothing(live.control, loop))
    return Cost(name, timing, {} if live_run.prepared.integrator.residual else _parts(live_run, timing, idle))


def _nothing(control: Any, loop: Any) -> None:
    control[TICKS] = 0
    loop()


def _seconds(call: Any) -> float:
    """Median computing time of a call [s]."""
    out = []
    for _ in range(REPEATED):
        begin = time.thread_time_ns()
        call()
        out.append(time.thread_time_ns() - begin)
    return 1e-9 * float(np.median(out))


def _parts(live_run: LiveRun, timing: Timing, idle: float) -> dict[str, float]:
    """Share of the median tick by part. idle : cost of a call from here."""
    run, motion, pace = live_run.run, live_run.prepared.motion, live_run.pace
    record, machine = motion.system.record, motion.handle.address
    t, y, rate = float(run.clock[0]), run.y.copy(), np.zeros_like(run.y)
    frame = np.zeros(motion.system.layout.width)

    def cost(call: Any) -> float:
        return max(_seconds(call) - idle, 0.0)

    code, families = motion.kernels.evaluate.address, [int(each) for each in record.elements.address]
    evaluate = cost(lambda: repeat_evaluation(code, machine, t, y, rate, AT_ONCE)) / AT_ONCE
    hydraulic = {each.address for each in families_of(live_run.plan.machine)}
    circuits = forces = 0.0
    for k, family in enumerate(families):
        seconds = cost(lambda k=k, family=family: repeat_family(family, machine, k, t, AT_ONCE)) / AT_ONCE
        circuits += seconds * (family in hydraulic)
        forces += seconds * (family not in hydraulic)
    beside = min(1.0, evaluate / max(forces + circuits, 1e-12))  # parts of an evaluation are no longer than it
    motion.kernels.evaluate(machine, t, y, rate)
    correct = cost(lambda: live_run.loop.correct(machine, t, y))
    show = cost(lambda: observe(machine, t, y, frame))
    calls = pace.substeps * float(run.counter[EVALUATIONS]) / max(float(run.counter[DONE_STEPS]), 1.0)
    parts = {
        "forces, control and inputs": calls * beside * forces,
        "circuit": calls * beside * circuits,
        "bodies, constraints and solve": calls * max(evaluate - forces - circuits, 0.0),
        "correction of the joints": pace.substeps * correct,
        "output": show / pace.every,
    }
    total = max(timing.computing[0], sum(parts.values()))
    return {**{name: each / total for name, each in parts.items()}, "method": 1.0 - sum(parts.values()) / total}
