"""The share of the computing time of a tick by part: each part again and again, in the state that a run is in."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from nivel.integrate.loop.paced import TICKS
from nivel.integrate.loop.repeated import halt, repeat_evaluation, repeat_family, repeat_rows
from nivel.integrate.loop.run import BUDGET, DONE_STEPS, EVALUATIONS, EVENTS, FRAMES, TIME
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.output.observe import observe
from nivel.lazy import nivel
from nivel.live.preparation import LiveRun
from nivel.native.entry import Entry

REPEATED: Final = 100  # calls of a part, of which the median counts
AT_ONCE: Final = 20  # of short ones
ENTRIES: Final[tuple[Entry, ...]] = (halt.code, repeat_evaluation, repeat_family, repeat_rows)


def shares(live_run: LiveRun, control: Any, loop: Callable[[], int]) -> dict[str, float]:
    """Share of the computing time of a tick by part. Empty of methods that do not evaluate ẏ, and where the run does not go on.

    control, loop : of the live run, which goes some ticks further. What no part has used is that of the method.

    An evaluation is split as it is computed: bodies, with markers, measured coordinates and, apart, the rows of the constraints, is what
    it takes until its first force; then come the forces, by families; the rest are masses, multipliers and accelerations.
    """
    if live_run.prepared.integrator.residual:
        return {}
    run, motion, pace = live_run.run, live_run.prepared.motion, live_run.pace
    record, machine = motion.system.record, motion.handle.address
    states: list[int] = []

    def tick() -> None:
        run.counter[BUDGET], run.counter[FRAMES], run.counter[EVENTS] = pace.substeps, 0, 0
        states.append(live_run.loop.advance())

    median = _seconds(tick)
    if any(each != BUDGET_SPENT for each in states):
        return {}
    at, y, rate = float(run.clock[TIME]), run.y.copy(), np.zeros_like(run.y)

    def begin() -> int:
        control[TICKS] = 0
        return loop()

    idle = _seconds(begin)  # of a call from here

    def cost(call: Callable[[], Any], times: int = 1) -> float:
        return max(_seconds(call) - idle, 0.0) / times

    def evaluation() -> float:
        return cost(lambda: repeat_evaluation(motion.kernels.evaluate.address, machine, at, y, rate, AT_ONCE), AT_ONCE)

    whole = evaluation()
    rows = cost(lambda: repeat_rows(machine, AT_ONCE), AT_ONCE)
    families = record.elements.address
    first, families[0] = int(families[0]), halt.address
    read = evaluation()
    families[0] = first
    forces = circuit = 0.0
    words = live_run.plan.machine
    of_circuits = (
        {each.address for each in nivel.system.circuit_elements.families_of(words)} if words.hydraulics else ()
    )
    for k, family in enumerate(int(each) for each in families):
        seconds = cost(lambda k=k, family=family: repeat_family(family, machine, k, at, AT_ONCE), AT_ONCE)
        circuit += seconds * (family in of_circuits)
        forces += seconds * (family not in of_circuits)
    motion.kernels.evaluate(machine, at, y, rate)
    correction = cost(lambda: live_run.loop.correct(machine, at, y))
    frame = np.zeros(motion.system.layout.width)
    output = cost(lambda: observe(machine, at, y, frame))
    evaluations = pace.substeps * float(run.counter[EVALUATIONS]) / max(float(run.counter[DONE_STEPS]), 1.0)
    return _shared_out(
        {
            "bodies": evaluations * max(read - rows, 0.0),
            "constraints": evaluations * rows + pace.substeps * correction,
            "forces, control and inputs": evaluations * forces,
            "circuit": evaluations * circuit,
            "solve": evaluations * max(whole - read - forces - circuit, 0.0),
            "output": output / pace.every,
        },
        max(median - idle, 0.0),
    )


def _shared_out(seconds: Mapping[str, float], median: float) -> dict[str, float]:
    """What is left for the method is its own: derivatives and factors of implicit ones."""
    total = max(median, sum(seconds.values()))
    return {**{name: each / total for name, each in seconds.items()}, "method": 1.0 - sum(seconds.values()) / total}


def _seconds(call: Callable[[], Any]) -> float:
    """Median computing time of a call [s]."""
    out = []
    for _ in range(REPEATED):
        begin = time.thread_time_ns()
        call()
        out.append(time.thread_time_ns() - begin)
    return 1e-9 * float(np.median(out))
