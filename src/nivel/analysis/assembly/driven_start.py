"""Bodies whose orientation is driven, turned to where it begins before the joints are closed.

The rows of a driven orientation vanish half a turn from it as well, so the assembly could close them there. From less than a right angle
it goes to the orientation that is meant.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.errors import Fault
from nivel.kernels.bodies.driven_turn import TURN_X
from nivel.machine.machine_record import MachineRecord
from nivel.machine.orientation import euler_parameters_from_matrix
from nivel.system.system import Array

# Less than this angle from its target [rad] a body stays where it is drawn.
NEAR = np.pi / 4
# y and z axes of a marker in the place of z and x, and so on round
NEXT = np.roll(np.eye(3), 1, axis=0)


def turn_to_targets(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> None:
    """Turn the bodies in the state y, in place, about their driven markers, where these are far from their orientation at time t."""
    for _, marker, rows in _driven(machine, motion):
        G = _against_target(motion, t, y, marker, rows)
        if np.trace(G) < 1.0 + 2.0 * np.cos(NEAR):
            _turn(motion, t, y, marker, G.T)


def half_turns(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> Iterator[Fault]:
    """A fault for every driver whose marker, in the closed state y, is half a turn from its orientation."""
    for name, marker, rows in _driven(machine, motion):
        if np.trace(_against_target(motion, t, y, marker, rows)) < 1.0:
            message = "the marker ends up half a turn from the orientation at the start: place the bodies that it hangs on nearer to it"
            yield Fault("", 0, 0, f"drivers.{name}.orientation", message)
    motion.evaluate(t, y)


def _driven(machine: MachineRecord, motion: MotionEquations) -> Iterator[tuple[str, int, list[int]]]:
    """Driver, marker and the three rows of every driven orientation."""
    system, record = motion.system, motion.system.record
    for driver in machine.drivers:
        if driver.orientation is not None:
            rows = [system.rows.index(f"{driver.name}.about_{axis}") for axis in "xyz"]
            combination = record.constraints.combination
            first = int(combination[combination[:, 0] == rows[0]][0, 1])
            what = record.coordinates.what[int(record.constraints.term[first, 0])]
            assert what[0] == TURN_X
            yield driver.name, int(what[2]), rows


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


def _turn(motion: MotionEquations, t: float, y: Array, marker: int, P: Array) -> None:
    """Turn the body of a marker about its point, in place, so that its axes A become A P."""
    motion.evaluate(t, y)
    markers, body = motion.system.record.markers, int(motion.system.record.markers.body[marker])
    if body >= motion.system.body_count:
        return
    A, r = markers.A[marker].copy(), markers.r[marker].copy()
    turned = A @ P @ markers.frame_b[marker].T
    y[7 * body : 7 * body + 3] = r - turned @ markers.position_b[marker]
    y[7 * body + 3 : 7 * body + 7] = euler_parameters_from_matrix(turned)
