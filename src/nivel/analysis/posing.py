"""An assembled machine that is moved by hand, one joint coordinate at a time, while all joints stay closed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assemble import assemble
from nivel.analysis.closing import Wishes, close_positions
from nivel.analysis.equations import MotionEquations, equations
from nivel.machine.machine_record import MachineRecord
from nivel.system.scene import scene
from nivel.system.system import Array

STILL: Final = 1e-9  # a coordinate whose derivative is below this share cannot move
DEPENDENT: Final = 1e-6  # what is left of a derivative that follows from others
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


class Posing:
    """A machine in its present position.

    Raises ModelError where it cannot be assembled.
    """

    def __init__(self, machine: MachineRecord) -> None:
        self.machine = machine
        self._motion: MotionEquations = equations(machine)
        assembled = assemble(machine, self._motion)
        self._start = (assembled.y.copy(), assembled.reference.copy())
        self._y = assembled.y.copy()
        self._time = 0.0
        system = self._motion.system
        self._names = tuple(system.layout.coordinates["joint_coordinate"])
        self._places = [int(place) for place in system.record.joints.coordinate]
        self.scene: dict[str, Any] = scene(machine, system)
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
        return problem and f"{name} cannot go there: {problem}"

    def reset(self) -> None:
        """Back to the assembled position."""
        self._time = 0.0
        self._set(*self._start)

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
        out = []
        for k, (name, unit) in enumerate(zip(self._names, system.coordinate_units, strict=True)):
            value = float(system.record.coordinates.value[self._places[k]])
            reach = np.pi if unit == "rad" else system.size
            out.append(Movement(name, unit, value, value - reach, value + reach, bool(free[k])))
        if self.machine.drivers:
            duration = float(self.machine.simulation.duration)
            out.append(Movement(TIME, "s", 0.0, 0.0, duration, True))
        return tuple(out)

    def _free(self) -> NDArray[np.bool_]:
        derivatives = self._derivatives()
        if derivatives is None:
            return np.ones(len(self._names), dtype=bool)
        whole, left = derivatives
        return np.linalg.norm(left, axis=1) > STILL * np.maximum(np.linalg.norm(whole, axis=1), 1e-300)

    def _derivatives(self) -> tuple[Array, Array] | None:
        """Derivatives of the coordinates for (Ṙ, ω̄) of all bodies (n, 6 B), lengths in machine lengths, and what the constraints leave
        of them (n, f); None of machines too large for it."""
        system = self._motion.system
        rows, n = system.machine_rows, len(self._places)
        if (rows + n) * 6 * system.body_count > LARGEST:
            return None
        row, body, block = self._motion.jacobian_blocks(self._places)
        block = block.copy()
        block[:, :3] *= system.size
        J = np.zeros((rows + n, system.body_count, 6))
        np.add.at(J, (row, body), block)
        J = J.reshape(rows + n, -1)
        if not rows:
            return J, J
        scaled = J[:rows] / np.maximum(np.linalg.norm(J[:rows], axis=1, keepdims=True), 1e-300)
        _, size, directions = np.linalg.svd(scaled)
        rank = int(np.sum(size > 1e-9 * size[0])) if len(size) else 0
        return J[rows:], J[rows:] @ directions[rank:].T

    def _others(self, at: int) -> list[int]:
        """Coordinates that may keep their values while the coordinate `at` moves: they do not follow from it, nor from each other."""
        derivatives = self._derivatives()
        if derivatives is None:
            return []
        whole, left = derivatives
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
