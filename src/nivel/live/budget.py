"""Budget of a machine in real time, found without operating it: ticks as fast as they go, by method and by part.

Levers are moved to and fro; then inputs are held at their ends, each alone and all together, until the machine stands still: actuators are
at their ends then, where ticks may cost a multiple.
"""

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from math import nan
from typing import Any, Final

import numpy as np

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.progress.log import Listener
from nivel.errors import ModelError
from nivel.integrate.loop import paced
from nivel.integrate.loop.run import TIME
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct
from nivel.live.preparation import HAND_INPUTS, LiveRun, Pace, live_plan, prepared_run
from nivel.live.shared import arrays_in, bytes_of, live_in, put_back, taken
from nivel.live.timing import ENTRIES, Timing, give_clocks, shares, timing_of
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.input import Input
from nivel.methods import CHOSEN, known_words
from nivel.native import library

DURATION: Final = 2.0  # s simulated, at least so many ticks
TICKS_AT_LEAST: Final = 2000
CYCLES: Final = 2.0  # of every lever
HELD: Final = 15  # s simulated, at most, that inputs are held at their ends
HELD_AT_LEAST: Final = 3  # s before a machine may be said to stand still
STILL: Final = 1e-4  # m, or as Euler parameters, by which it moves in a second then
MOST_IN_ALL: Final = 4  # levers of which all combinations of ends are held; of more, all combinations of any two
PATIENCE: Final = 20.0  # s of the processor for all combinations of a method


class Held(Struct):
    """What ticks cost while inputs are held. values : of these inputs, the others rest. ended : time at which the run ended [s]; NaN: it
    did not."""

    values: Mapping[str, float]
    timing: Timing
    ended: float = nan

    @property
    def cost(self) -> float:
        """Computing time of a tick, 99.9 % [s]."""
        return self.timing.computing[3]

    def __str__(self) -> str:
        return ", ".join(f"{name} at {value:.4g}" for name, value in self.values.items())


class Cost(Struct):
    """What a method costs.

    note : why it does not run, or what else is to be known of the run. parts : share of the computing time by part, where that is known.
    off : how far the farthest body was at the end from where steps of half the length by the method of the
    file had it [m]; NaN: not known. held : with inputs at their ends, of `combinations` in all those for which there was time.
    """

    integrator: str
    timing: Timing | None
    parts: Mapping[str, float]
    note: str = ""
    off: float = nan
    held: Sequence[Held] = ()
    combinations: int = 0

    @property
    def worst(self) -> Held | None:
        """The inputs that are dearest to hold."""
        return max(self.held, key=lambda each: each.cost, default=None)

    @property
    def rate_held(self) -> float:
        """Ticks a second that 99.9 % of the computing times allow, whatever the inputs do."""
        costs = [each.cost for each in self.held] + ([self.timing.computing[3]] if self.timing else [])
        return 1.0 / max([*costs, 1e-9])


def fixed_methods() -> list[str]:
    """Integrators that can have fixed steps."""
    return [name for name in known_words("integrator") if name not in CHOSEN]


def is_compiled(machine: MachineRecord, settings: Mapping[str, Any], tick: float | None) -> bool:
    """Whether a live run with these settings needs no compiler. Raises ModelError where there is no such run."""
    plan, _ = live_plan(machine, settings, tick)
    return not library.missing([*run_entries(plan), paced.drive])


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
            build([*run_entries(plan), paced.drive, *ENTRIES], listener)
            (listener or Listener()).say(f"measuring {name}")
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


def ends(inputs: Sequence[Input]) -> list[dict[str, float]]:
    """Values to hold inputs at, of those that do not rest: each alone at both its ends, then all levers that go back when they are let go,
    in all combinations of their ends. Of more than MOST_IN_ALL levers any two are in all their combinations (a Hadamard matrix)."""
    alone = [{each.name: end} for each in inputs for end in each.range if end != each.rest_value]
    levers = [each for each in inputs if not each.hold]
    if len(levers) < 2:
        return alone
    sides = list(product((0, 1), repeat=len(levers))) if len(levers) <= MOST_IN_ALL else _pairs(len(levers))
    together = [
        {each.name: each.range[k] for each, k in zip(levers, row, strict=True) if each.range[k] != each.rest_value}
        for row in sides
    ]
    return alone + [each for each in together if each and each not in alone]


def _pairs(count: int) -> list[tuple[int, ...]]:
    """Rows of zeros and ones of which any two columns have all four combinations."""
    order = 1 << count.bit_length()
    columns = [[(row & column).bit_count() % 2 for row in range(order)] for column in range(1, count + 1)]
    return list(zip(*columns, strict=True))


def _exact(machine: MachineRecord, settings: Mapping[str, Any], pace: Pace) -> Array | None:
    """Positions (bodies, 3) at the end by steps of half the length; None where that run ends before."""
    try:
        plan, finer = live_plan(machine, {**settings, "step": 0.5 * pace.step}, pace.tick)
        run = _Run(prepared_run(plan, finer), moved=True)
        return run.places() if run.loop() == BUDGET_SPENT else None
    except ModelError:
        return None


def _cost(name: str, plan: Plan, pace: Pace, exact: Array | None, *, at_rest: bool) -> Cost:
    """at_rest : a method that does not stand moved levers is timed with levers at rest."""
    run, note, off = _Run(prepared_run(plan, pace), moved=True), "", nan
    if run.loop() == BUDGET_SPENT:
        off = nan if exact is None else float(np.max(np.linalg.norm(run.places() - exact, axis=1), initial=0.0))
    else:
        note = f"with moved levers the run ends at {int(run.live.control[paced.DONE]) * pace.tick:.4g} s"
        run = _Run(prepared_run(plan, pace), moved=False)
        if not at_rest or run.loop() != BUDGET_SPENT:
            return Cost(name, None, {}, note)
        note = f"{note}: this is with levers at rest"
    timing = timing_of(run.live)
    parts = shares(run.its, run.live.control, run.loop)
    wanted = ends(plan.machine.inputs[:-HAND_INPUTS])
    held, begin = [], time.thread_time()
    run = _Run(prepared_run(plan, pace), moved=False)
    for values in wanted:
        if time.thread_time() - begin > PATIENCE:
            break
        held.append(run.hold(values))
    return Cost(name, timing, parts, note, off, held, len(wanted))


class _Run:
    """A live run whose deadlines have all passed."""

    def __init__(self, its: LiveRun, *, moved: bool) -> None:
        self.its = its
        self.live = live = live_in(bytearray(bytes_of(its.sizes)), its.sizes)
        self.loop = its.begin(live)
        ticks = max(TICKS_AT_LEAST, int(DURATION / its.pace.tick))
        give_clocks(live)
        live.clock[paced.SPEED] = 1e12
        live.control[[paced.PACED, paced.TICKS, paced.FROM_TAPE]] = 1, ticks, int(moved)
        live.control[paced.HEARD] = time.clock_gettime_ns(time.CLOCK_MONOTONIC)
        self._arrays = arrays_in([*its.records, (live.value,)])
        self._start = taken(self._arrays, 0)
        if moved:
            live.tape[:ticks] = swept(its.plan.machine.inputs, ticks, its.pace.tick)

    def hold(self, values: Mapping[str, float]) -> Held:
        """From the start, with inputs going to these values and the others at rest, until the machine stands still."""
        live, control, pace = self.live, self.live.control, self.its.pace
        put_back(self._arrays, self._start)
        live.target[:] = [values.get(each.name, each.rest_value) for each in self.its.plan.machine.inputs]
        live.histogram[:] = 0
        control[[paced.DONE, paced.LONGEST, paced.LATEST, paced.FROM_TAPE]] = 0
        control[paced.TICKS], control[paced.HEARD] = max(1, round(1.0 / pace.tick)), np.iinfo(np.int64).max // 2
        before, status = None, BUDGET_SPENT
        for second in range(1, HELD + 1):
            status = self.loop()
            after = self.pose()
            still = before is not None and np.abs(after - before).max(initial=0.0) < STILL
            before = after
            if status != BUDGET_SPENT or (still and second >= HELD_AT_LEAST):
                break
        return Held(values, timing_of(live), nan if status == BUDGET_SPENT else int(control[paced.DONE]) * pace.tick)

    def pose(self) -> Array:
        """Positions [m] and Euler parameters of all bodies in the newest frame."""
        newest = self.live.frames[int(self.live.control[paced.SHOWN] - 1) % len(self.live.frames)]
        layout = self.its.prepared.motion.system.layout.variables
        return np.concatenate([newest[each.columns] for each in layout if each.name in ("position", "orientation")])

    def places(self) -> Array:
        """Positions (bodies, 3) where the run is now."""
        motion, run = self.its.prepared.motion, self.its.run
        at = float(run.clock[TIME])
        motion.evaluate(at, run.y)
        frame = np.zeros(motion.system.layout.width)
        observe(motion.handle.address, at, run.y, frame)
        columns = next(each.columns for each in motion.system.layout.variables if each.name == "position")
        return frame[columns].reshape(-1, 3)
