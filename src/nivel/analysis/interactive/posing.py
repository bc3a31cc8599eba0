"""An assembled machine that is moved by hand, one number at a time, while all joints stay closed.

The numbers are joint coordinates, and what these do not reach: three angles of a spherical joint, places and angles of bodies that nothing
holds (`handles`). Beams go along without bending.
"""

import time as clock_of_python
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.closing import Wishes, close_positions
from nivel.analysis.assembly.equations import MotionEquations, equations, moved
from nivel.analysis.assembly.named_freedoms import Freedoms, coordinate_derivatives, freedoms
from nivel.analysis.interactive.handles import Handle, Wish, further_handles, measured_handles
from nivel.analysis.plan.beam_facts import with_stiff_beams
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.system.beam_nodes import with_nodes
from nivel.system.scene import scene
from nivel.system.system import Array
from nivel.words.arguments import checked_arguments

ASIDE: Final = 0.02  # [rad, machine lengths] a little aside
STEPS: Final = 36  # to each side, in which it is found out how far a number goes: 5 degrees each
EXPLORING: Final = 1.5  # seconds that this may take
NEARER: Final = 1e-3  # among positions with the wished value the one that differs least otherwise
TIME: Final = "time"  # moves what drivers prescribe


class Movement(Struct):
    """A number (or the time, of a machine with drivers) and how far it may be moved: [low, high] in `unit`."""

    name: str
    unit: str
    value: float
    low: float
    high: float
    free: bool


class Position(Struct):
    """A position that the machine can have: state, reference of its measured angles, states of its handles."""

    y: Array
    reference: Array
    states: tuple[Array, ...]


class Posing:
    """A machine in its present position.

    Raises ModelError where it cannot be assembled.
    """

    def __init__(self, machine: MachineRecord) -> None:
        shown, machine = with_nodes(machine), with_stiff_beams(machine)
        self.machine = machine
        self._motion: MotionEquations = equations(machine, measured=True)
        assembled = assemble(machine, self._motion)
        self._y = assembled.y.copy()
        self._reference[:] = assembled.reference
        self._time = 0.0
        self._motion.evaluate(0.0, self._y)
        measured = measured_handles(self._motion)
        is_free, rest = self._free([handle.place for handle in measured])
        further = [] if rest is None else list(further_handles(machine, self._motion, self._q, rest))
        self._handles: list[Handle] = [*measured, *further]
        self._states = tuple(each.state(self._motion, self._q, np.zeros(6)) for each in self._handles)
        self._start = self._position()
        # number and place in it of the handle that each movement belongs to
        self._found = {name: (h, k) for h, each in enumerate(self._handles) for k, name in enumerate(each.names)}
        self._seen: list[Position] = []
        self.scene: dict[str, Any] = scene(shown, self._motion.system)
        self.movements = self._movements(np.append(is_free, np.ones(len(self._found) - len(is_free), dtype=bool)))

    def pose(self) -> tuple[Array, Array]:
        """Position (B, 3) [m] and Euler parameters (B, 4) of all body frames."""
        q = self._q.reshape(-1, 7)
        return q[:, :3].copy(), q[:, 3:].copy()

    def values(self) -> list[float]:
        """Values of all movements now."""
        return [*map(float, self._values(self._states)), *([self._time] if self.machine.drivers else [])]

    @checked_arguments
    def move(self, name: str, value: float) -> str:
        """Move a number to `value`, others that are free stay where they can; why it could not be done, or an empty text."""
        movement = next((each for each in self.movements if each.name == name), None)
        if movement is None:
            return f"there is no coordinate {name}"
        span = movement.high - movement.low  # a closed loop may go a little further than was found
        if not movement.low - span <= value <= movement.high + span:
            return f"{name} cannot go there: it goes from {movement.low:.4g} to {movement.high:.4g} {movement.unit}"
        if name == TIME and self.machine.drivers:
            return self._try(value, [])
        h, k = self._found[name]
        wish = self._wish(h, k, value)
        stay = [self._handles[other].wish(self._now(other), self._states[other]) for other in self._others(h)]
        near = self._near(h, k, value)
        problem = self._try(self._time, [wish, *stay], near)
        if problem and stay:
            problem = self._try(self._time, [wish], near)
        if problem and len(self._now(h)) > 1:
            problem = self._try(self._time, [self._handles[h].single(k, value, self._states[h])], near)
        if problem and self._seen and self._time == 0.0:
            problem = self._try_from_near(h, k, value)
        return problem and f"{name} cannot go there: {problem}"

    def reset(self) -> None:
        """Back to the assembled position."""
        self._time = 0.0
        self._set(self._start)

    @property
    def _q(self) -> Array:
        """(7 B,) positions now."""
        return self._y[: self._motion.system.positions]

    @property
    def _reference(self) -> Array:
        return self._motion.system.record.coordinates.reference

    def _now(self, h: int) -> Array:
        return self._handles[h].values(self._states[h])

    def _values(self, states: Sequence[Array]) -> Array:
        """(n,) of all movements but the time."""
        return np.concatenate(
            [np.zeros(0), *(each.values(state) for each, state in zip(self._handles, states, strict=True))]
        )

    def _wish(self, h: int, k: int, value: float) -> Wish:
        """For one number of a handle, its others as they are."""
        wanted = self._now(h).copy()
        wanted[k] = value
        return self._handles[h].wish(wanted, self._states[h])

    def _near(self, h: int, k: int, value: float) -> tuple[Array, ...]:
        """States of the handles with one number as it is wished for: of angles that are one turn apart the one wished for is shown."""
        return tuple(
            each.near(state, k, value) if n == h else state
            for n, (each, state) in enumerate(zip(self._handles, self._states, strict=True))
        )

    def _try_from_near(self, h: int, k: int, value: float) -> str:
        """From a position seen before that is near: at a dead point no motion begins in the direction that is wished for."""
        before = self._position()
        now = self._values(self._states)
        values = np.array([self._values(each.states) for each in self._seen])
        wished = np.array([self._handles[h].values(each.states[h])[k] for each in self._seen])
        far = np.abs(wished - value) + NEARER * np.linalg.norm(values - now, axis=1)
        self._set(self._seen[int(np.argmin(far))])
        problem = self._try(0.0, [self._wish(h, k, value)], self._near(h, k, value))
        if problem:
            self._set(before)
        return problem

    def _explore(self, free: NDArray[np.bool_], reach: Array) -> Array:
        """(n, 2) how far each free number goes, found by moving it in steps to both sides; what takes too long is left at its reach."""
        start = self._values(self._states)
        out = np.stack([start - reach, start + reach], axis=1)
        end = clock_of_python.monotonic() + EXPLORING
        ended = np.zeros((len(start), 2), dtype=bool)
        for n, (h, k) in enumerate(self._found.values()):
            for side, sign in enumerate((-1.0, 1.0)):
                self.reset()
                for step in range(1, STEPS + 1 if free[n] else 0):
                    if clock_of_python.monotonic() > end:
                        break
                    if self._try(0.0, [self._wish(h, k, float(start[n] + sign * reach[n] * step / STEPS))]):
                        ended[n, side] = True
                        break
                    self._seen.append(self._position())
        self.reset()
        if self._seen:
            values = np.array([start, *(self._values(each.states) for each in self._seen)])
            seen = np.stack([values.min(axis=0), values.max(axis=0)], axis=1)
            out = np.where(ended, np.clip(seen, out[:, :1], out[:, 1:]), out)
        return out

    def _try(self, time: float, wishes: Sequence[Wish], near: tuple[Array, ...] | None = None) -> str:
        """Close all joints with these wishes; what was before is kept where that fails. near : states that those after it are near to."""
        before = self._position()
        record = self.machine
        wanted = Wishes(
            np.array([body.assembly_weight for body in record.bodies], dtype=float),
            np.zeros(len(record.bodies), dtype=bool),
            tuple(value for wish in wishes for value in wish.values),
            aims=tuple(aim for wish in wishes for aim in wish.aims),
        )
        with np.errstate(over="ignore", invalid="ignore"):
            closed = close_positions(self._motion, time, self._y, wanted)
        if not closed:
            self._set(before)
            return "the joints would open"
        self._time = time
        self._states = tuple(
            each.state(self._motion, self._q, state)
            for each, state in zip(self._handles, near or self._states, strict=True)
        )
        return ""

    def _position(self) -> Position:
        return Position(self._y.copy(), self._reference.copy(), self._states)

    def _set(self, position: Position) -> None:
        self._y = position.y.copy()
        self._reference[:] = position.reference
        self._states = position.states
        self._motion.evaluate(self._time, self._y)

    def _movements(self, free: NDArray[np.bool_]) -> tuple[Movement, ...]:
        units = [unit for each in self._handles for unit in each.units]
        reach = np.array([np.pi if unit == "rad" else self._motion.system.size for unit in units])
        ends = self._explore(free, reach)
        values = self._values(self._states).tolist()
        out = [
            Movement(name, unit, value, low, high, bool(moves) and high > low)
            for name, unit, value, (low, high), moves in zip(
                self._found, units, values, ends.tolist(), free, strict=True
            )
        ]
        if self.machine.drivers:
            out.append(Movement(TIME, "s", 0.0, 0.0, float(self.machine.simulation.duration), True))
        return tuple(out)

    def _free(self, places: Sequence[int]) -> tuple[NDArray[np.bool_], Freedoms | None]:
        """Which coordinates can move: here, or a little aside, since a crank's dead point hides what follows it; and what else can move."""
        here = freedoms(self._motion)
        if here is None:
            return np.ones(len(places), dtype=bool), None
        derivatives = coordinate_derivatives(self._motion, places)
        free, rest = here.movable(derivatives), here.without(derivatives)
        if not free.all() and here.directions.size:
            before = (self._y.copy(), self._reference.copy())
            share = np.cos(np.arange(1.0, 1.0 + len(here.directions)))  # some direction, the same every time
            aside = (ASIDE * share / np.linalg.norm(share)) @ here.directions
            aside.reshape(-1, 6)[:, :3] *= self._motion.system.size
            self._y[: self._motion.system.positions] = moved(self._q, aside)
            if close_positions(self._motion, 0.0, self._y) and (there := freedoms(self._motion)) is not None:
                free |= there.movable(coordinate_derivatives(self._motion, places))
            self._y, self._reference[:] = before
            self._motion.evaluate(0.0, self._y)
        return free, rest

    def _others(self, at: int) -> list[int]:
        """Handles that may keep their values while handle `at` moves: they do not follow from it, nor from each other."""
        here = freedoms(self._motion)
        numbers = [h for h in range(len(self._handles)) if h != at]
        if here is None:  # too large to find out: all, where no loop can be closed
            return numbers if len(self.machine.joints) <= len(self.machine.bodies) else []
        derivatives = [self._derivatives(h) for h in numbers]
        return [numbers[k] for k in here.keeping(self._derivatives(at), derivatives)]

    def _derivatives(self, h: int) -> Array:
        return self._handles[h].derivatives(self._motion, self._q, self._states[h])
