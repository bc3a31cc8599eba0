"""Timing of ticks: percentiles of the histograms of their length and delay that the loop fills, and the share of each part in them."""

import ctypes
import gc
import os
import time
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from nivel.integrate.loop import paced
from nivel.integrate.loop.repeated import halt, repeat_evaluation, repeat_family, repeat_rows
from nivel.integrate.loop.run import BUDGET, DONE_STEPS, EVALUATIONS, EVENTS, FRAMES, TIME
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct, nivel
from nivel.live.preparation import LiveRun
from nivel.native.entry import Entry

LEAST: Final = 0.005  # share of a part that is worth to be told
PERCENTS: Final = (50.0, 90.0, 99.0, 99.9)


class Timing(Struct):
    """Of ticks in real time: percentiles (50, 90, 99, 99.9) and the maximum of computing time (of the thread) and of lateness [s].

    tick : simulated time of a tick [s]. overruns : ticks that ended after the next deadline, `own` of them because their own computing
    took longer than a tick; the others had to wait for the machine. stretched : by which deadlines were moved in all [s].
    """

    ticks: int
    tick: float
    computing: tuple[float, ...]
    lateness: tuple[float, ...]
    overruns: int
    own: int
    stretched: float

    @property
    def rate_held(self) -> float:
        """Ticks a second that 99.9 % of the computing times would allow."""
        return 1.0 / max(self.computing[3], 1e-9)


def timing_of(live: paced.Live) -> Timing:
    """The timing so far."""
    control = live.control
    rows = live.histogram.reshape(2, paced.BINS).copy()
    return Timing(
        ticks=int(rows[paced.COMPUTING].sum()),
        tick=float(live.clock[paced.TICK]),
        computing=_percentiles(rows[paced.COMPUTING], 1e-9 * float(control[paced.LONGEST])),
        lateness=_percentiles(rows[paced.LATENESS], 1e-9 * float(control[paced.LATEST])),
        overruns=int(control[paced.OVERRUNS]),
        own=int(control[paced.OWN]),
        stretched=1e-9 * float(control[paced.STRETCHED]),
    )


def _percentiles(counts: np.ndarray, longest: float) -> tuple[float, ...]:
    """Upper ends of the bins that hold the percentiles [s]: at most 2 % too long; and the longest."""
    total = counts.sum()
    if not total:
        return (0.0,) * (len(PERCENTS) + 1)
    places = np.searchsorted(np.cumsum(counts), [np.ceil(total * percent / 100.0) for percent in PERCENTS])
    ends = (float(1e-9 * paced.FIRST_BIN * np.exp(paced.BIN_WIDTH * (place + 1))) for place in places)
    return *(min(end, longest) for end in ends), longest


def in_a_sentence(
    machine: str, integrator: str, timing: Timing, parts: Mapping[str, float], rate_held: float | None = None
) -> str:
    """What a tick costs, of which part what share, and what rate [Hz] that would allow; None: that of the timing."""
    held = timing.rate_held if rate_held is None else rate_held
    rate, cost, median = 1.0 / timing.tick, 1e6 * timing.computing[3], 1e6 * timing.computing[0]
    ordered = sorted(((share, name) for name, share in parts.items() if share >= LEAST), reverse=True)
    shared = ", ".join(f"{100.0 * share:.0f} % {name}" for share, name in ordered)
    return (
        f"{machine} at {rate / 1e3:.4g} kHz costs {cost:.0f} µs a tick by {integrator} ({median:.0f} µs in the median"
        f"{f', of which {shared}' if shared else ''}); it would hold {held / 1e3:.3g} kHz"
    )


def in_words(timing: Timing) -> list[str]:
    """The timing in lines for people."""
    if not timing.ticks:
        return ["timing: no tick in real time"]
    lines = [f"timing of {timing.ticks} ticks of {1e3 * timing.tick:.4g} ms ({1.0 / timing.tick:.4g} Hz), in µs:"]
    lines.append("              50 %     90 %     99 %   99.9 %  longest")
    for name, values in (("computing", timing.computing), ("lateness", timing.lateness)):
        lines.append(f"  {name:9s}" + "".join(f"{1e6 * value:9.1f}" for value in values))
    machine = timing.overruns - timing.own
    lines.append(
        f"  overruns: {timing.overruns}, {timing.own} by own computing, {machine} by the machine; "
        f"time stretched by {1e3 * timing.stretched:.4g} ms in all"
    )
    return lines


LOCK_ALL: Final = 3  # MCL_CURRENT | MCL_FUTURE
PRIORITY: Final = 10  # of SCHED_FIFO, 1 … 99


def give_clocks(live: paced.Live) -> None:
    """Tell the loop where clock_gettime and clock_nanosleep are, and its own times."""
    library = ctypes.CDLL(None)
    functions = (library.clock_gettime, library.clock_nanosleep)
    live.address[[paced.CLOCK, paced.SLEEP]] = [ctypes.cast(each, ctypes.c_void_p).value or 0 for each in functions]
    live.address[[paced.NOW, paced.DEADLINE]] = live.now.ctypes.data, live.deadline.ctypes.data


def become_urgent() -> list[str]:
    """Ask for real-time priority and locked memory, and stop collecting garbage. Returns in words what was given and what was not."""
    gc.collect()
    gc.freeze()
    gc.disable()
    return [_priority(), _locked_memory()]


def _priority() -> str:
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except (AttributeError, OSError) as problem:
        return f"no real-time priority ({getattr(problem, 'strerror', None) or 'unknown here'})"
    return f"real-time priority {PRIORITY} (SCHED_FIFO)"


def _locked_memory() -> str:
    try:
        library = ctypes.CDLL(None, use_errno=True)
        done = library.mlockall(LOCK_ALL) == 0
    except (OSError, AttributeError):
        return "memory not locked (unknown here)"
    return "memory locked" if done else f"memory not locked ({os.strerror(ctypes.get_errno())})"


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
        control[paced.TICKS] = 0
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
    words, of_circuits = live_run.plan.machine, set[int]()
    if words.hydraulics:
        of_circuits = {each.address for each in nivel.system.circuit_elements.families_of(words)}
    for k, family in enumerate(int(each) for each in families):
        seconds = cost(lambda k=k, family=family: repeat_family(family, machine, k, at, AT_ONCE), AT_ONCE)
        circuit += seconds * (family in of_circuits)
        forces += seconds * (family not in of_circuits)
    motion.kernels.evaluate(machine, at, y, rate)
    correction = cost(lambda: live_run.loop.correct(machine, at, y))
    frame = np.zeros(motion.system.layout.width)
    output = cost(lambda: observe(machine, at, y, frame))
    evaluations = pace.substeps * float(run.counter[EVALUATIONS]) / max(float(run.counter[DONE_STEPS]), 1.0)
    its = {
        "bodies": evaluations * max(read - rows, 0.0),
        "constraints": evaluations * rows + pace.substeps * correction,
        "forces, control and inputs": evaluations * forces,
        "circuit": evaluations * circuit,
        "solve": evaluations * max(whole - read - forces - circuit, 0.0),
        "output": output / pace.every,
    }
    total = max(median - idle, sum(its.values()))
    # what is left for the method is its own: derivatives and factors of implicit ones
    return {**{name: each / total for name, each in its.items()}, "method": 1.0 - sum(its.values()) / total}


def _seconds(call: Callable[[], Any]) -> float:
    """Median computing time of a call [s]."""
    out = []
    for _ in range(REPEATED):
        begin = time.thread_time_ns()
        call()
        out.append(time.thread_time_ns() - begin)
    return 1e-9 * float(np.median(out))
