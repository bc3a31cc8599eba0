"""A machine made ready for live operation: fixed steps, ticks, inputs as tables of two points."""

import sys
from collections.abc import Mapping, Sequence
from math import ceil
from typing import Any, Final

import numpy as np

from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import Loop, start_loop
from nivel.analysis.run.fitting import fitted
from nivel.analysis.run.prepared_state import prepare
from nivel.elements.control.units import UnitBlock
from nivel.elements.forces.hand import Hand
from nivel.errors import Fault, ModelError
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.paced import BOUND, HIGH, LOW, RATE, REST, SHOWN, SPEED, SUBSTEPS, TICK, WATCHDOG, Live, drive
from nivel.integrate.loop.run import TIME, Run
from nivel.kernels.core.block import Handle
from nivel.kernels.output.observe import observe
from nivel.known import SoilUnit
from nivel.lazy import Struct
from nivel.live.shared import Ground, Sizes, arrays_in, put_back, taken
from nivel.machine.laws.time_function import Table
from nivel.machine.laws.varying_value import Expression
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import changed
from nivel.machine.signals.input import Input

LONGEST: Final = 86400.0  # s of a live run
LONGEST_TICK: Final = 0.1  # s: beyond it nobody can operate a machine
SHORTEST_TICK: Final = 1e-3  # s: more ticks a second cost more than they tell
FRAMES_PER_SECOND: Final = 60.0
CAUGHT_UP: Final = 0.05  # s: a longer delay stretches time
SILENCE: Final = 0.5  # s after which an operator counts as lost


class Pace(Struct):
    """tick : simulated time from input to input [s]; of `substeps` steps each. every : ticks between frames."""

    step: float
    substeps: int
    every: int

    @property
    def tick(self) -> float:
        """[s]"""
        return self.step * self.substeps


def pace_of(step: float, tick: float | None) -> Pace:
    """Ticks of whole steps, of 1 ms or the step where nothing was asked for.

    Raises ModelError where the tick is no multiple of the step, or too long.
    """
    wanted = max(step, SHORTEST_TICK) if tick is None else tick
    if not wanted > 0.0:
        raise ModelError(Fault.at("tick", f"a time greater than zero was expected, got {wanted:.6g} s"))
    if wanted > LONGEST_TICK:
        problem = f"{wanted:.6g} s is longer than {LONGEST_TICK:g} s: inputs and the picture would lag behind"
        raise ModelError(Fault.at("step" if tick is None else "tick", problem))
    substeps = max(1, ceil(wanted / step - 1e-9)) if tick is None else max(1, round(wanted / step))
    if tick is not None and abs(substeps * step - tick) > 1e-9 * tick:
        raise ModelError(Fault.at("tick", f"{tick:.6g} s is not a multiple of the step {step:.6g} s"))
    return Pace(step, substeps, max(1, round(1.0 / (FRAMES_PER_SECOND * step * substeps))))


def live_plan(machine: MachineRecord, settings: Mapping[str, Any], tick: float | None) -> tuple[Plan, Pace]:
    """The run of a live machine: inputs that an operator sets, a hand, fixed steps, a frame every sixtieth of a second.

    Raises ModelError where the machine has no inputs to drive it, or its integrator chooses its steps.
    """
    if not sys.platform.startswith("linux"):
        raise ModelError("live operation needs the absolute deadlines of Linux, which this system does not have")
    machine = with_hand(machine)
    driven = [each.replace(signal=Table((0.0, 1.0), (each.rest_value, each.rest_value))) for each in machine.inputs]
    # limits hold for what an operator does; this table is at rest
    simulation = changed(machine.simulation, {**settings, "duration": LONGEST})
    pace = pace_of(simulation.step, tick)
    simulation = simulation.replace(output_interval=pace.every * pace.tick)
    plan = plan_run(machine.replace(inputs=tuple(driven), simulation=simulation), set(settings), stepwise=True)
    if plan.settings.steps == 0:
        message = f"`{plan.settings.integrator}` chooses its steps; live operation needs fixed ones, for instance of rk4 or ros2"
        raise ModelError(Fault.at("simulation.integrator", message))
    if plan.is_open:
        # the machine of the plan names what is chosen, so that a recording is replayed with it
        plan, _ = fitted(plan, prepare(plan.methods))
    return plan, pace


class LiveRun(Struct, frozen=False):
    """A prepared machine, its history, and the compiled loop. drive : tick as `Live.control` says; returns a status."""

    prepared: Prepared
    plan: Plan
    pace: Pace
    loop: Loop

    @property
    def run(self) -> Run:
        """The history."""
        return self.loop.history.record

    @property
    def sizes(self) -> Sizes:
        """What the shared memory has room for."""
        soil = sum(start.size + forces for start, forces, _ in self.grounds)
        return Sizes(len(self.plan.machine.inputs), self.prepared.motion.system.layout.width, soil=soil)

    @property
    def soils(self) -> list[SoilUnit]:
        """Units of the machine that the page shows."""
        return [each for each in self.prepared.motion.system.units if isinstance(each, SoilUnit)]

    @property
    def grounds(self) -> list[Ground]:
        """Their soils as they lie before the run."""
        return [(each.record.h, each.record.volume.size, each.cell) for each in self.soils]

    def session(self, live: Live) -> Handle:
        """Fill what the loop is told; what the loop knows it by."""
        system = self.prepared.motion.system
        live.clock[TICK], live.clock[SPEED] = self.pace.tick, 1.0
        live.clock[BOUND], live.clock[WATCHDOG] = CAUGHT_UP, SILENCE
        live.control[SUBSTEPS] = self.pace.substeps
        live.function[:] = system.input_functions
        for k, each in enumerate(self.plan.machine.inputs):
            live.limit[k, [LOW, HIGH, RATE, REST]] = *each.range, each.rate or np.inf, each.rest_value
            live.target[k] = live.value[k] = each.rest_value
        # a hand that lets go stays where it is
        live.limit[HAND_PULL + 1 - HAND_INPUTS :, REST] = np.nan
        return Handle(live)

    def begin(self, live: Live) -> Any:
        """The loop: a function without arguments that returns a status."""
        loop, session = self.loop, self.session(live)
        codes = [entry.address for entry in (advance, *loop.codes)]

        def go_on() -> int:
            return drive(*codes, loop.machine.address, loop.history.address, session.address)

        return go_on

    def show(self, live: Live) -> None:
        """Put a frame of the present state into the ring, and leave no trace of it in the run."""
        arrays = arrays_in(self.records)
        before = taken(arrays, 0)
        run, motion = self.run, self.prepared.motion
        at = float(run.clock[TIME])
        motion.evaluate(at, run.y)
        frame = live.frames[int(live.control[SHOWN]) % len(live.frames)]
        frame[0] = at
        observe(motion.handle.address, at, run.y, frame)
        put_back(arrays, before)
        live.control[SHOWN] += 1

    @property
    def records(self) -> list[Any]:
        """All that the kernels remember."""
        twin, system = self.prepared.motion.twin, self.prepared.motion.system
        units = [unit.record for unit in system.units]
        return [system.record, self.run, *([twin.record] if twin is not None else []), *units]


def prepared_run(plan: Plan, pace: Pace) -> LiveRun:
    """Assemble the machine. Raises ModelError where it cannot be assembled, or has a unit, which cannot be reset here."""
    for block in plan.machine.control:
        if isinstance(block, UnitBlock):
            message = (
                f"a machine with {block.what} cannot be operated; `nivel run` and `machine.start()` in Python run it"
            )
            raise ModelError(Fault.at(f"control.{block.name}.file", message))
    prepared = prepare(plan.methods)
    return LiveRun(prepared, plan, pace, start_loop(prepared, plan.settings))


HAND_PULL, BODY, POINT, TOWARDS = 0, 1, 2, 5  # of its inputs
HAND_INPUTS: Final = 8
FARTHEST: Final = 1e4  # m
MOST_BODIES: Final = 10_000
_PARTS: Final = ("pull", "body", *(f"{what}_{axis}" for what in ("point", "towards") for axis in "xyz"))


def with_hand(machine: MachineRecord) -> MachineRecord:
    """The machine with a hand that rests."""
    name = _free_name(machine)
    inputs = [f"{name}_{part}" for part in _PARTS]
    ranges = [(0.0, 1.0), (0.0, float(MOST_BODIES)), *[(-FARTHEST, FARTHEST)] * 6]
    values = [Expression(f"{each}.value") for each in inputs]
    hand = Hand(
        name=name,
        pull=values[HAND_PULL],
        body_number=values[BODY],
        point=(values[2], values[3], values[4]),
        towards=(values[5], values[6], values[7]),
    )
    added = (Input(name=each, range=limits, hold=True) for each, limits in zip(inputs, ranges, strict=True))
    return machine.replace(inputs=(*machine.inputs, *added), forces=(*machine.forces, hand))


def _free_name(machine: MachineRecord) -> str:
    taken = {each.name for each in (*machine.forces, *machine.inputs, *machine.sensors)}
    names = ("hand", *(f"hand{k}" for k in range(2, 100)))
    return next(name for name in names if not any(each == name or each.startswith(f"{name}_") for each in taken))


def grip(present: Sequence[float], body: int, point: Sequence[float], towards: Sequence[float]) -> list[float]:
    """Wanted values of the inputs that hold a point of a body, towards a point in space. present : values at the end of the last tick.

    A hand that holds another point lets go first, and holds when it has the new one: inputs go straight from value to value.
    """
    wanted = [1.0, float(body), *point, *towards]
    if list(present[BODY:TOWARDS]) == wanted[BODY:TOWARDS]:
        return wanted
    if present[HAND_PULL] != 0.0:
        return [0.0, *present[BODY:]]
    return [0.0, *wanted[BODY:]]
