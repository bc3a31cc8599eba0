"""Degrees of freedom in the present position, and the numbers of the state that may be chosen independently."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.lazy import dataclass
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array, System

STILL: Final = 1e-7  # a number whose derivative is below this share cannot move
DEPENDENT: Final = 1e-6  # what is left of a derivative that follows from others
RANK: Final = 1e-9  # a singular value below this share of the largest counts as zero
LARGEST: Final = 1_000_000  # entries of the Jacobian up to which free motions are found


@dataclass(frozen=True)
class Freedoms:
    """Motions (Ṙ, ω̄) of all bodies, lengths in machine lengths. directions (f, 6 B) : unit motions that the constraints allow."""

    directions: Array

    def left(self, derivatives: Array) -> Array:
        """(n, f) what the constraints leave of the derivatives (n, 6 B) of some numbers."""
        return derivatives @ self.directions.T

    def movable(self, derivatives: Array) -> NDArray[np.bool_]:
        """(n,) whether each number changes in some motion that the constraints allow."""
        size = np.maximum(np.linalg.norm(derivatives, axis=1), 1e-300)
        return np.linalg.norm(self.left(derivatives), axis=1) > STILL * size

    def without(self, derivatives: Array) -> Freedoms:
        """The motions in which these numbers stay."""
        left = self.left(derivatives)
        if not left.size:
            return self
        _, size, every = np.linalg.svd(left)
        rank = int(np.sum(size > DEPENDENT * max(float(np.linalg.norm(derivatives, axis=1).max()), 1e-300)))
        return Freedoms(every[rank:] @ self.directions)

    def independent(self, derivatives: Array) -> list[int]:
        """Those of some numbers that can be chosen apart from each other, taken in the order of how much they move."""
        left = self.left(derivatives)
        least = DEPENDENT * float(np.linalg.norm(derivatives, axis=1).max(initial=0.0))
        chosen: list[int] = []
        while left.size:
            size = np.linalg.norm(left, axis=1)
            best = int(np.argmax(size > 0.999 * size.max()))  # of equal ones the first
            if size[best] <= max(least, 1e-12):
                break
            chosen.append(best)
            along = left[best] / size[best]
            left = left - np.outer(left @ along, along)
        return sorted(chosen)

    def keeping(self, wished: Array, others: Sequence[Array]) -> list[int]:
        """Which of `others`, each (k, 6 B), may stay while the `wished` (n, 6 B) changes: none follows from it, nor from those before."""
        basis: list[Array] = []
        for row in self.left(wished):
            _extend(basis, row, 1e-12)
        chosen = []
        for k, rows in enumerate(others):
            longer = list(basis)
            sizes = DEPENDENT * np.linalg.norm(rows, axis=1)
            if all(_extend(longer, row, max(size, 1e-12)) for row, size in zip(self.left(rows), sizes, strict=True)):
                basis = longer
                chosen.append(k)
        return chosen


def _extend(basis: list[Array], row: Array, least: float) -> bool:
    """Add to an orthonormal basis what is left of a row, and whether that is more than `least`."""
    rest = row.copy()
    for direction in basis:
        rest -= (rest @ direction) * direction
    length = float(np.linalg.norm(rest))
    if length > least:
        basis.append(rest / length)
    return length > least


def freedoms(motion: MotionEquations) -> Freedoms | None:
    """In the position last evaluated; None of machines that are too large for it."""
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return None
    directions = np.eye(6 * system.body_count)
    if system.machine_rows:
        J = motion.jacobian_in_lengths()
        _, size, every = np.linalg.svd(J / np.maximum(np.linalg.norm(J, axis=1, keepdims=True), 1e-300))
        directions = every[int(np.sum(size > RANK * size[0])) :]
    return Freedoms(directions)


def coordinate_derivatives(motion: MotionEquations, places: Sequence[int]) -> Array:
    """(n, 6 B) derivatives of joint coordinates, lengths in machine lengths."""
    system = motion.system
    row, body, block = motion.jacobian_blocks(places)
    own = row >= system.machine_rows
    block = block[own].copy()
    block[:, :3] *= system.size
    J = np.zeros((len(places), system.body_count, 6))
    np.add.at(J, (row[own] - system.machine_rows, body[own]), block)
    return J.reshape(len(places), 6 * system.body_count)


def touches_ground(machine: MachineRecord, system: System) -> bool:
    """Whether a joint, a driver of a marker or a force joins a body to the ground."""
    joined = {body for joint in machine.joints for body in bodies_of(machine, joint)}
    for driver in machine.drivers:
        if driver.marker is not None:
            seen = driver.reference
            joined |= {machine.marker_named[name].body for name in (driver.marker, seen) if name is not None}
            joined |= {GROUND} if seen is None else set()
    return GROUND in joined or any(system.body_count in each.bodies for each in system.coupled)
