"""Bodies whose orientation is driven, turned to where it begins before the joints are closed.

The rows of a driven orientation vanish half a turn from it as well, so the assembly could close them there. From less than a right angle
it goes to the orientation that is meant.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.errors import Fault
from nivel.kernels.bodies.driven_turn import TURN_X
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.machine_record import MachineRecord
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array

# Less than this angle from its target [rad] a body stays where it is drawn.
NEAR = np.pi / 4
# y and z axes of a marker in the place of z and x, and so on round
NEXT = np.roll(np.eye(3), 1, axis=0)


def turn_to_targets(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> None:
    """Turn the bodies in the state y, in place, about their driven markers, where these are far from their orientation at time t; with all
    bodies that joints hold together with them, but by way of the ground, unless the reference is one of these."""
    of = motion.system.record.markers.body
    for _, reference, marker, rows in _driven(machine, motion):
        G = _against_target(motion, t, y, marker, rows)
        if np.trace(G) < 1.0 + 2.0 * np.cos(NEAR):
            together = _held_together(machine, motion, int(of[marker]))
            _turn(motion, t, y, marker, G.T, together if int(of[reference]) not in together else ())


def half_turns(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> Iterator[Fault]:
    """A fault for every driver whose marker, in the closed state y, is half a turn from its orientation."""
    for name, _, marker, rows in _driven(machine, motion):
        if np.trace(_against_target(motion, t, y, marker, rows)) < 1.0:
            message = "the marker ends up half a turn from the orientation at the start: place the bodies that it hangs on nearer to it"
            yield Fault.at(f"drivers.{name}.orientation", message)
    motion.evaluate(t, y)


def _driven(machine: MachineRecord, motion: MotionEquations) -> Iterator[tuple[str, int, int, list[int]]]:
    """Driver, marker of reference, driven marker and the three rows of every driven orientation."""
    system, record = motion.system, motion.system.record
    for driver in machine.drivers:
        if driver.orientation is not None:
            rows = [system.rows.index(f"{driver.name}.about_{axis}") for axis in "xyz"]
            combination = record.constraints.combination
            first = int(combination[combination[:, 0] == rows[0]][0, 1])
            what = record.coordinates.what[int(record.constraints.term[first, 0])]
            assert what[0] == TURN_X
            yield driver.name, int(what[1]), int(what[2]), rows


def _against_target(motion: MotionEquations, t: float, y: Array, marker: int, rows: list[int]) -> Array:
    """(3, 3) axes of the marker in those of its target. A state shows three of these cosines; the others are those of the marker with
    its axes in the place of each other."""
    G, x = np.zeros((3, 3)), np.arange(3)
    for turn in range(3):
        tried = y.copy()
        _turn(motion, t, tried, marker, np.linalg.matrix_power(NEXT, turn))
        motion.evaluate(t, tried)
        G[(x + 1) % 3, (x + 2 + turn) % 3] = -motion.system.record.constraints.C[rows]
    return G


def _turn(motion: MotionEquations, t: float, y: Array, marker: int, P: Array, others: Iterable[int] = ()) -> None:
    """Turn the body of a marker about its point, in place, so that its axes A become A P; the others with it."""
    motion.evaluate(t, y)
    record, count = motion.system.record, motion.system.body_count
    body = int(record.markers.body[marker])
    if body >= count:
        return
    A, r = record.markers.A[marker].copy(), record.markers.r[marker].copy()
    T, axes = A @ P @ A.T, record.bodies.A[:count].copy()
    for b in {body, *others}:
        place = y[7 * b : 7 * b + 3]
        place[:] = r + T @ (place - r)
        y[7 * b + 3 : 7 * b + 7] = euler_parameters_from_matrix(T @ axes[b])


def _held_together(machine: MachineRecord, motion: MotionEquations, body: int) -> set[int]:
    """The bodies that joints join to one, directly or by way of others."""
    number = {name: k for k, name in enumerate(motion.system.bodies)}
    joined = [{number[name] for name in bodies_of(machine, joint) if name in number} for joint in machine.joints]
    found, before = {body}, set[int]()
    while found != before:
        before = set(found)
        found |= set[int]().union(*(each for each in joined if each & found))
    return found
