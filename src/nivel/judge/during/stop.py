"""Stop of a run that failed: its status, its last accepted state, and what the equations of motion tell of it there."""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.kernels.core import status as of_kernels
from nivel.kernels.record.record import Record
from nivel.known import Beam
from nivel.lazy import Struct
from nivel.system.layout import reported
from nivel.system.system import Array, System

Told = tuple[str, str]  # message and advice
# Pivots of S below this share of their diagonal are taken for the neighbourhood of a singular position.
NEAR_SINGULAR = 1e-6
# A violation above this share of its scale is not round-off or truncation: the step was too large for the motion.
DRIFTED = 1e-2


class Status(IntEnum):
    """How a call of kernels, or a run, ended."""

    OUT_OF_REACH = -2  # steps are so short that there are too many to the end
    CRAWLS = -1  # steps have shrunk to nothing where a function jumps
    OK = of_kernels.OK
    SINGULAR = of_kernels.SINGULAR
    NOT_FINITE = of_kernels.NOT_FINITE
    BUFFER_FULL = of_kernels.BUFFER_FULL
    BUDGET_SPENT = of_kernels.BUDGET_SPENT
    DONE = of_kernels.DONE
    FRICTION_DIVERGES = of_kernels.FRICTION_DIVERGES
    BRISTLE_TOO_FAST = of_kernels.BRISTLE_TOO_FAST
    CONTRADICTION = of_kernels.CONTRADICTION
    ROTATION_SINGULAR = of_kernels.ROTATION_SINGULAR
    NOT_CONVERGED = of_kernels.NOT_CONVERGED
    STEP_TOO_SMALL = of_kernels.STEP_TOO_SMALL
    EVENT_NOT_FINITE = of_kernels.EVENT_NOT_FINITE
    MULTIPLIERS_NOT_FOUND = of_kernels.MULTIPLIERS_NOT_FOUND
    NO_MASS_LEFT = of_kernels.NO_MASS_LEFT
    NOT_ON_RAIL = of_kernels.NOT_ON_RAIL
    NOT_CLOSED = of_kernels.NOT_CLOSED
    OPEN = of_kernels.OPEN
    NO_VOLUME = of_kernels.NO_VOLUME


class Stop(Struct):
    """A run that failed in the step [s] from `time` [s], whose last accepted state is y.

    chosen_by : the integrator that chose the step, and tried ever smaller ones; empty where steps are fixed. beams : that an explicit
    method had to follow. jumping : functions that jump with the motion, in words.
    """

    motion: MotionEquations
    status: int
    time: float
    step: float
    y: Array
    chosen_by: str = ""
    beams: tuple[Beam, ...] = ()
    jumping: tuple[str, ...] = ()

    @property
    def number(self) -> int:
        """The number of what failed, as the kernel counts it."""
        return int(self.motion.system.record.control.failure[0])

    def evaluate(self) -> None:
        """Put the record into the last accepted state."""
        self.motion.evaluate(self.time, self.y)


def named_row(system: System, row: int) -> str:
    """A constraint by its name, with its joint and the coordinates of that in brackets."""
    joint = system.rows[row].split(".")[0]
    rates = [name for name in system.layout.coordinates["joint_coordinate"] if name.startswith(f"{joint}.")]
    return f"{system.rows[row]} (joint {joint}, coordinate {', '.join(rates)})" if rates else system.rows[row]


def unit_of(system: System, row: int) -> str:
    """The unit of the violation of a constraint, in words."""
    return {"m": "m", "rad": "rad"}.get(system.row_units[row], "(a cosine)")


def mass_left(record: Record, f: int) -> float:
    """The least share, over all directions, of the mass of flexible body f that its frame has without its modes, in the state last
    evaluated: the smallest eigenvalue of 1 - L⁻¹ B Bᵀ L⁻ᵀ, with the mass L Lᵀ and the coupling B of the modes."""
    own, n = record.flexible, int(np.ptp(record.flexible.mode[f]))
    B, J, (x, y, z) = own.coupling[f][:, :n], np.tril(own.inertia[f]), own.first[f]
    M = np.diag(np.repeat([float(record.bodies.mass[int(own.body[f])]), 0.0], 3))
    M[3:, :3] = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    M[3:, 3:] = J
    try:
        L = np.linalg.cholesky(M)  # the lower triangle counts
    except np.linalg.LinAlgError:
        return 1.0
    return 1.0 - float(np.linalg.norm(np.linalg.solve(L, B), 2)) ** 2


def repeated_by(motion: MotionEquations, number: int) -> NDArray[np.int64]:
    """The rows that row `number` is a combination of; none where it is independent, or no row of a joint."""
    rows, J = rows_in_use(motion)
    its, others = rows == number, rows != number
    if not np.any(its) or not np.all(np.isfinite(J)):
        return rows[:0]
    row = J[its][0]
    share, left = np.linalg.lstsq(J[others].T, row, rcond=1e-10)[0], 1e-6 * np.linalg.norm(row)
    if np.linalg.norm(J[others].T @ share - row) > left:
        return rows[:0]
    return rows[others][np.abs(share * np.linalg.norm(J[others], axis=1)) > left]


def rows_in_use(motion: MotionEquations) -> tuple[NDArray[np.int64], Array]:
    """Numbers (n,) of the constraint rows that the equations hold, and these rows of C_q in coordinates that do not change which of
    them depend on each other."""
    record, system = motion.system.record, motion.system
    saddle, width = record.saddle, record.saddle.W.shape[1]
    if not len(record.tree.node):
        return np.arange(system.machine_rows), motion.jacobian()
    block = saddle.block[: int(saddle.blocks[0])].astype(np.int64)
    W = np.zeros((len(saddle.row), len(saddle.z), width))
    np.add.at(W, (block[:, 0], block[:, 3]), saddle.W[: len(block)])
    return saddle.row.astype(np.int64), W.reshape(len(W), -1)


def broken_signals(motion: MotionEquations) -> list[str]:
    """Signals of the control that are no numbers in the state last evaluated."""
    values = motion.system.record.outputs.value
    names = [variable.name for variable in reported(motion.system.layout, len(values))]
    broken = [name for name, value in zip(names, values, strict=True) if not np.isfinite(value)]
    return [name for name in broken if name.startswith("control.")][:3]


def has_drifted(motion: MotionEquations) -> bool:
    """Whether the state last evaluated has left its constraints."""
    constraints = motion.system.record.constraints
    return bool(np.max(np.abs(constraints.C) / constraints.scale, initial=0.0) > DRIFTED)


def is_far_from_singular(motion: MotionEquations) -> bool:
    """Whether all constraints are well independent in the state last evaluated."""
    saddle, partition = motion.system.record.saddle, motion.system.record.partition
    if len(partition.unit) and not len(motion.system.frictions):
        return bool(partition.quality[1] ** 2 > NEAR_SINGULAR)
    if len(saddle.dense):
        return True
    diagonal = saddle.S[saddle.S_start[1:].astype(int) - 1]
    return bool(np.all(saddle.Dinv * diagonal < 1.0 / NEAR_SINGULAR))


def worst_row(motion: MotionEquations) -> str:
    """The constraint with the largest violation in the state last evaluated; without joints the body with the largest acceleration."""
    system, record = motion.system, motion.system.record
    violation = np.abs(record.constraints.C)
    if len(violation) and np.any(np.isfinite(violation)):
        row = int(np.nanargmax(violation / record.constraints.scale))
        return f"the largest violation before it is {violation[row]:.3g} {unit_of(system, row)} at {named_row(system, row)}"
    if not system.body_count:
        return "there are no bodies: look at the components of the circuit"
    accelerations = np.nan_to_num(np.linalg.norm(record.bodies.Rddot[: system.body_count], axis=1), nan=np.inf)
    body = int(np.argmax(accelerations))
    return f"the body with the largest acceleration before it is {system.bodies[body]}"


# What is said of a function that has no value
NO_NUMBER = "is not a number at t ="
# Where a step became too small, it is asked how forces are so far ahead along the motion, as shares of the time.
AHEAD = (1e-9, 1e-7, 1e-5, 1e-3)


def owner_of(row: str) -> str:
    return row.split(".", maxsplit=1)[0]


def broken_function(motion: MotionEquations, time: float, step: float, y: Array) -> tuple[str, str] | None:
    """The first force or driver that is not a finite number at a time that the step from `time` looks at, in the state y or where it
    is going."""
    system, record = motion.system, motion.system.record
    outputs, constraints = record.outputs.value, record.constraints
    names = [variable.name for variable in reported(system.layout, len(outputs))]
    magnitudes = [(k, name.split(".")[1]) for k, name in enumerate(names) if name.endswith(".magnitude")]
    rows = constraints.combination[:, 0].astype(int)
    rate = motion.evaluate(time, y)[1]
    ahead = [0.5 * step, step, *(share * max(time, step) for share in AHEAD if share * time > step)]
    for by, moves in [(0.0, False), *((by, moves) for by in ahead for moves in (False, True))]:
        at, aside = time + by, y + by * rate if moves else y
        if not np.isfinite(aside).all():
            continue
        motion.evaluate(at, aside)
        broken = [f"the force {name}" for k, name in magnitudes if not np.isfinite(outputs[k])]
        known = np.isfinite([constraints.C[rows], constraints.Cdot[rows], constraints.gamma[rows]]).all(axis=0)
        broken += [f"the motion of {owner_of(system.rows[row])}" for row in rows[~known]]
        if broken:
            name = broken[0].split()[-1]
            advice = f"Look at the law of {name}: a division by zero, or a root or logarithm of a negative number, or their derivatives?"
            if f"force.{name}.stretch" in names:
                advice = (
                    f"Has an end of {name} come into one of its wheels, or a wheel into another? The rope has no way there: "
                    "end the run before, by an event, or hold the bodies apart by a stop."
                )
            return f"{broken[0]} {NO_NUMBER} {at:.6g} s", advice
    return None
