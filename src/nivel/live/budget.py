"""Budget of a machine in real time, found without operating it: ticks as fast as they go, by method and by part."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.progress.listener import Listener
from nivel.errors import ModelError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop.paced import CLOCK, DEADLINE, DONE, FROM_TAPE, HEARD, NOW, PACED, SLEEP, SPEED, TICKS, drive
from nivel.integrate.loop.run import TIME
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.output.observe import observe
from nivel.live.parts import ENTRIES, shares
from nivel.live.preparation import LiveRun, Pace, live_plan, prepared_run
from nivel.live.shared import bytes_of, live_in
from nivel.live.system_clock import clock_addresses
from nivel.live.timing import Timing, timing_of
from nivel.machine import Input, MachineRecord
from nivel.native import library

Array = NDArray[np.float64]
DURATION: Final = 2.0  # s simulated, at least so many ticks
TICKS_AT_LEAST: Final = 2000
CYCLES: Final = 2.0  # of every lever


@dataclass(frozen=True)
class Cost:
    """What a method costs.

    note : why it does not run, or what else is to be known of the run. parts : share of the computing time by part, where that is known.
    off : how far the farthest body was at the end from where steps of half the length by the method of the
    file had it [m]; NaN: not known.
    """

    integrator: str
    timing: Timing | None
    parts: Mapping[str, float]
    note: str = ""
    off: float = nan


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
    """The cost of each method, with levers moved. compiled_only : those that would have to be compiled first are left out."""
    exact, first = None, True
    for name in integrators:
        chosen = {**settings, "integrator": name}
        try:
            if compiled_only and not is_compiled(machine, chosen, tick):
                continue
            plan, pace = live_plan(machine, chosen, tick)
            build([*run_entries(plan), drive, *ENTRIES], listener)
            if first:
                exact = _exact(machine, chosen, pace)
            yield _cost(name, plan, pace, exact, at_rest=first)
            first = False
        except ModelError as error:
            yield Cost(name, None, {}, error.faults[0].message)


def swept(inputs: Sequence[Input], ticks: int, tick: float) -> Array:
    """Values (ticks, inputs) at the ends of ticks: levers that go back when they are let go are pushed to one end of their range and to the
    other, one after the other and as fast as their rates allow; other inputs rest."""
    out = np.tile([each.rest_value for each in inputs], (ticks, 1))
    levers = [k for k, each in enumerate(inputs) if not each.hold]
    cycle = CYCLES * np.arange(1, ticks + 1) / ticks
    for number, k in enumerate(levers):
        (low, high), rest = inputs[k].range, inputs[k].rest_value
        at = cycle - 0.5 * number / len(levers)
        phase = at % 1.0
        wanted = np.where(phase < 0.4, high, np.where((phase >= 0.5) & (phase < 0.9), low, rest))
        value, most = rest, (inputs[k].rate or np.inf) * tick
        for n, target in enumerate(np.where(at < 0.0, rest, wanted)):
            value += min(max(target - value, -most), most)
            out[n, k] = value
    return out


def _exact(machine: MachineRecord, settings: Mapping[str, Any], pace: Pace) -> Array | None:
    """Positions (bodies, 3) at the end by steps of half the length; None where that run ends before."""
    try:
        plan, finer = live_plan(machine, {**settings, "step": 0.5 * pace.step}, pace.tick)
        run = _Run(prepared_run(plan, finer), moved=True)
        return run.places() if run.go() == BUDGET_SPENT else None
    except ModelError:
        return None


def _cost(name: str, plan: Plan, pace: Pace, exact: Array | None, *, at_rest: bool) -> Cost:
    """at_rest : a method that does not stand moved levers is timed with levers at rest."""
    run, note, off = _Run(prepared_run(plan, pace), moved=True), "", nan
    if run.go() == BUDGET_SPENT:
        off = nan if exact is None else float(np.max(np.linalg.norm(run.places() - exact, axis=1), initial=0.0))
    else:
        note = f"with moved levers the run ends at {int(run.live.control[DONE]) * pace.tick:.4g} s"
        run = _Run(prepared_run(plan, pace), moved=False)
        if not at_rest or run.go() != BUDGET_SPENT:
            return Cost(name, None, {}, note)
        note = f"{note}: this is with levers at rest"
    timing = timing_of(run.live)
    return Cost(name, timing, shares(run.its, run.live.control, run.loop), note, off)


class _Run:
    """A live run whose deadlines have all passed."""

    def __init__(self, its: LiveRun, *, moved: bool) -> None:
        self.its = its
        self.live = live = live_in(bytearray(bytes_of(its.sizes)), its.sizes)
        self.loop = its.begin(live)
        ticks = max(TICKS_AT_LEAST, int(DURATION / its.pace.tick))
        live.address[[CLOCK, SLEEP]] = clock_addresses()
        live.address[[NOW, DEADLINE]] = live.now.ctypes.data, live.deadline.ctypes.data
        live.clock[SPEED] = 1e12
        live.control[[PACED, TICKS, FROM_TAPE]] = 1, ticks, int(moved)
        live.control[HEARD] = time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        if moved:
            live.tape[:ticks] = swept(its.plan.machine.inputs, ticks, its.pace.tick)

    def go(self) -> int:
        """Tick until the end. Returns a status."""
        return self.loop()

    def places(self) -> Array:
        """Positions (bodies, 3) where the run is now."""
        motion, run = self.its.prepared.motion, self.its.run
        at = float(run.clock[TIME])
        motion.evaluate(at, run.y)
        frame = np.zeros(motion.system.layout.width)
        observe(motion.handle.address, at, run.y, frame)
        columns = next(each.columns for each in motion.system.layout.variables if each.name == "position")
        return frame[columns].reshape(-1, 3)
