"""An assembled machine that is moved by hand, one joint coordinate at a time, while all joints stay closed."""

from __future__ import annotations

import time as clock_of_python
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assemble import assemble
from nivel.analysis.closing import Wishes, close_positions
from nivel.analysis.equations import MotionEquations, equations, moved
from nivel.machine.machine_record import MachineRecord
from nivel.system.beam_nodes import with_nodes
from nivel.system.scene import scene
from nivel.system.system import Array

STILL: Final = 1e-7  # a coordinate whose derivative is below this share cannot move
DEPENDENT: Final = 1e-6  # what is left of a derivative that follows from others
RANK: Final = 1e-9  # a singular value below this share of the largest counts as zero
ASIDE: Final = 0.02  # [rad, machine lengths] a little aside
STEPS: Final = 36  # to each side, in which it is found out how far a coordinate goes: 5 degrees each
EXPLORING: Final = 1.5  # seconds that this may take
NEARER: Final = 1e-3  # among positions with the wished value the one that differs least otherwise
LARGEST: Final = 4_000_000  # entries of the Jacobian up to which free coordinates are found
TIME: Final = "time"  # moves what drivers prescribe


@dataclass(frozen=True)
class Movement:
    """A joint coordinate (or the time, of a machine with drivers) and how far it may be moved: [low, high] in `unit`."""

    name: str
    unit: str
    value: float
    low: float
    high: float
    free: bool


@dataclass(frozen=True)
class Derivatives:
    """whole (n, 6 B) : of the coordinates for (Ṙ, ω̄) of all bodies, lengths in machine lengths. directions (f, 6 B) : unit motions that
    the constraints allow."""

    whole: Array
    directions: Array

    @property
    def left(self) -> Array:
        """(n, f) what the constraints leave of the derivatives."""
        return self.whole @ self.directions.T

    def movable(self) -> NDArray[np.bool_]:
        """(n,) whether each coordinate changes in some motion that the constraints allow."""
        return np.linalg.norm(self.left, axis=1) > STILL * np.maximum(np.linalg.norm(self.whole, axis=1), 1e-300)


@dataclass(frozen=True)
class Seen:
    """A position that the machine can have: values of its joint coordinates, state, reference of its angles."""

    values: Array
    y: Array
    reference: Array


class Posing:
    """A machine in its present position.

    Raises ModelError where it cannot be assembled.
    """

    def __init__(self, machine: MachineRecord) -> None:
        machine = with_nodes(machine)
        self.machine = machine
        self._motion: MotionEquations = equations(machine, measured=True)
        assembled = assemble(machine, self._motion)
        self._start = (assembled.y.copy(), assembled.reference.copy())
        self._y = assembled.y.copy()
        self._time = 0.0
        system = self._motion.system
        self._names = tuple(system.layout.coordinates["joint_coordinate"])
        self._places = [int(place) for place in system.record.joints.coordinate]
        self.scene: dict[str, Any] = scene(machine, system)
        self._seen: list[Seen] = []
        self.movements = self._movements()

    def pose(self) -> tuple[Array, Array]:
        """Position (B, 3) [m] and Euler parameters (B, 4) of all body frames."""
        q = self._y[: self._motion.system.positions].reshape(-1, 7)
        return q[:, :3].copy(), q[:, 3:].copy()

    def values(self) -> list[float]:
        """Values of all movements now."""
        measured = self._motion.system.record.coordinates.value[self._places]
        return [*map(float, measured), *([self._time] if self.machine.drivers else [])]

    def move(self, name: str, value: float) -> str:
        """Move a coordinate to `value`, others that are free stay where they can; why it could not be done, or an empty text."""
        if name == TIME and self.machine.drivers:
            return self._try(value, [])
        if name not in self._names:
            return f"there is no coordinate {name}"
        at = self._names.index(name)
        held = [(self._names[k], self._places[k], self.values()[k]) for k in self._others(at)]
        wished = (name, self._places[at], value)
        problem = self._try(self._time, [wished, *held])
        if problem and held:
            problem = self._try(self._time, [wished])
        if problem and self._seen and self._time == 0.0:
            problem = self._try_from_near(at, wished)
        return problem and f"{name} cannot go there: {problem}"

    def reset(self) -> None:
        """Back to the assembled position."""
        self._time = 0.0
        self._set(*self._start)

    def _try_from_near(self, at: int, wished: tuple[str, int, float]) -> str:
        """From a position seen before that is near: at a dead point no motion begins in the direction that is wished for."""
        before = (self._y.copy(), self._motion.system.record.coordinates.reference.copy())
        now = np.array(self.values()[: len(self._names)])
        values = np.array([each.values for each in self._seen])
        far = np.abs(values[:, at] - wished[2]) + NEARER * np.linalg.norm(values - now, axis=1)
        near = self._seen[int(np.argmin(far))]
        self._set(near.y, near.reference)
        problem = self._try(0.0, [wished])
        if problem:
            self._set(*before)
        return problem

    def _explore(self, free: NDArray[np.bool_], reach: Array) -> Array:
        """(n, 2) how far each free coordinate goes, found by moving it in steps to both sides; what takes too long is left at its reach."""
        start = np.array(self.values()[: len(self._names)])
        out = np.stack([start - reach, start + reach], axis=1)
        end = clock_of_python.monotonic() + EXPLORING
        ended = np.zeros((len(start), 2), dtype=bool)
        for k in np.flatnonzero(free):
            for side, sign in enumerate((-1.0, 1.0)):
                self.reset()
                for step in range(1, STEPS + 1):
                    target = start[k] + sign * reach[k] * step / STEPS
                    if clock_of_python.monotonic() > end:
                        break
                    if self._try(0.0, [(self._names[k], self._places[k], float(target))]):
                        ended[k, side] = True
                        break
                    reference = self._motion.system.record.coordinates.reference.copy()
                    self._seen.append(Seen(np.array(self.values()[: len(start)]), self._y.copy(), reference))
        self.reset()
        if self._seen:
            values = np.array([start, *(each.values for each in self._seen)])
            seen = np.stack([values.min(axis=0), values.max(axis=0)], axis=1)
            out = np.where(ended, np.clip(seen, out[:, :1], out[:, 1:]), out)
        return out

    def _try(self, time: float, values: list[tuple[str, int, float]]) -> str:
        """Close all joints with these values; what was before is kept where that fails."""
        motion = self._motion
        before = (self._y.copy(), motion.system.record.coordinates.reference.copy())
        record = self.machine
        wishes = Wishes(
            np.array([body.assembly_weight for body in record.bodies], dtype=float),
            np.zeros(len(record.bodies), dtype=bool),
            tuple(values),
        )
        with np.errstate(over="ignore", invalid="ignore"):
            closed = close_positions(motion, time, self._y, wishes)
        if not closed:
            self._set(*before)
            return "the joints would open"
        self._time = time
        return ""

    def _set(self, y: Array, reference: Array) -> None:
        self._y = y.copy()
        self._motion.system.record.coordinates.reference[:] = reference
        self._motion.evaluate(self._time, self._y)

    def _movements(self) -> tuple[Movement, ...]:
        self._motion.evaluate(0.0, self._y)
        system, free = self._motion.system, self._free()
        units = system.coordinate_units
        reach = np.array([np.pi if unit == "rad" else system.size for unit in units])
        ends = self._explore(free, reach)
        out = []
        for k, (name, unit, (low, high)) in enumerate(zip(self._names, units, ends.tolist(), strict=True)):
            value = float(system.record.coordinates.value[self._places[k]])
            out.append(Movement(name, unit, value, low, high, bool(free[k]) and high > low))
        if self.machine.drivers:
            duration = float(self.machine.simulation.duration)
            out.append(Movement(TIME, "s", 0.0, 0.0, duration, True))
        return tuple(out)

    def _free(self) -> NDArray[np.bool_]:
        """Which coordinates can move: here, or a little aside, since a crank's dead point hides what follows it."""
        here = self._derivatives()
        if here is None:
            return np.ones(len(self._names), dtype=bool)
        free = here.movable()
        if not free.all() and here.directions.size:
            before = (self._y.copy(), self._motion.system.record.coordinates.reference.copy())
            share = np.cos(np.arange(1.0, 1.0 + len(here.directions)))  # some direction, the same every time
            aside = (ASIDE * share / np.linalg.norm(share)) @ here.directions
            aside.reshape(-1, 6)[:, :3] *= self._motion.system.size
            positions = slice(0, self._motion.system.positions)
            self._y[positions] = moved(self._y[positions], aside)
            if close_positions(self._motion, 0.0, self._y) and (there := self._derivatives()) is not None:
                free |= there.movable()
            self._set(*before)
        return free

    def _derivatives(self) -> Derivatives | None:
        """Here; None of machines that are too large for it."""
        system = self._motion.system
        rows, n = system.machine_rows, len(self._places)
        if (rows + n) * 6 * system.body_count > LARGEST:
            return None
        row, body, block = self._motion.jacobian_blocks(self._places)
        block = block.copy()
        block[:, :3] *= system.size
        J = np.zeros((rows + n, system.body_count, 6))
        np.add.at(J, (row, body), block)
        J = J.reshape(rows + n, 6 * system.body_count)
        directions = np.eye(6 * system.body_count)
        if rows:
            scaled = J[:rows] / np.maximum(np.linalg.norm(J[:rows], axis=1, keepdims=True), 1e-300)
            _, size, every = np.linalg.svd(scaled)
            directions = every[int(np.sum(size > RANK * size[0])) :]
        return Derivatives(J[rows:], directions)

    def _others(self, at: int) -> list[int]:
        """Coordinates that may keep their values while the coordinate `at` moves: they do not follow from it, nor from each other."""
        derivatives = self._derivatives()
        if derivatives is None:
            return []
        whole, left = derivatives.whole, derivatives.left
        basis = [left[at] / max(float(np.linalg.norm(left[at])), 1e-300)]
        chosen = []
        for k in range(len(left)):
            rest = left[k].copy()
            for direction in basis:
                rest -= (rest @ direction) * direction
            length = float(np.linalg.norm(rest))
            if k != at and length > max(DEPENDENT * float(np.linalg.norm(whole[k])), 1e-12):
                basis.append(rest / length)
                chosen.append(k)
        return chosen
