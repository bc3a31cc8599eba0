"""Inverse dynamics: the efforts of actuators that make a machine follow a given motion.

With the residual r₀ = M v̇ - Q of the motion without these efforts, Z the motions that the joints allow and B the actuators' generalised
forces,

    Zᵀ B τ = Zᵀ r₀

has one solution where there are as many independent actuators as freedoms; with more of them that of least weighted norm is taken, and
with fewer what no effort gives is told. The reactions of the joints do not enter, redundant or not.
"""

import csv
from collections import Counter
from collections.abc import Sequence
from math import isfinite
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from nivel.analysis.assembly.instant import Instant
from nivel.analysis.inverse.actuators import Actuation, driven_alone
from nivel.analysis.kinematics.drive import MovingState, moving_states, released
from nivel.analysis.linearise.reduction import RANK, free_motions
from nivel.analysis.plan.plan import Methods
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.prepared_state import at_start
from nivel.elements.joints.drivers import Driver
from nivel.errors import Fault, ModelError, refuse
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Actuated
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve
from nivel.results.analyses.efforts import Efforts
from nivel.results.result import Result
from nivel.system.system import Array

# Tables of numbers as CSV files.


def read_table(path: str, option: str) -> tuple[list[str], list[list[float]]]:
    """Names and columns of a table with a line of names. option : that asked for it. Raises ModelError with the line that is wrong."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ModelError(Fault.at(option, f"the table {path} cannot be read: {reason.lower()}")) from error
    names = [name.strip() for name in rows[0]] if rows else [""]
    columns: list[list[float]] = [[] for _ in names]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise ModelError(
                Fault.at(option, f"line {number} of {path} has {len(row)} columns, the first line has {len(names)}")
            )
        for column, text in zip(columns, row, strict=True):
            column.append(_number(text, option, f"line {number} of {path}"))
    return names, columns


def _number(text: str, option: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise ModelError(Fault.at(option, f"{where}: `{text}` is not a number"))
    return value


PLACE, AXES = ("time", "x", "y", "z"), ("e0", "e1", "e2", "e3")


def read_path(path: str) -> tuple[Array, Array, Array | None]:
    """Times (T,) [s], places (T, 3) [m] and Euler parameters (T, 4) or None. Raises ModelError."""
    names, columns = read_table(path, "inverse.path")
    if tuple(names) not in (PLACE, PLACE + AXES) or not columns[0]:
        wanted = f"`{','.join(PLACE)}`, with `{','.join(AXES)}` behind them or not, and then numbers"
        raise ModelError(Fault.at("inverse.path", f"{path} must begin with {wanted}; got `{','.join(names)}`"))
    values = np.array(columns)
    return values[0], values[1:4].T, values[4:].T if len(values) > len(PLACE) else None


TIME = "time"
FEWEST = 4  # points of a spline


def along_trajectory(machine: MachineRecord, path: str | PathLike[str]) -> MachineRecord:
    """The machine with its coordinates driven along the columns of a CSV file: `time` [s], then joint coordinates [rad or m], between
    which splines pass. Drivers of other coordinates stay. Raises ModelError with everything that is wrong."""
    file = fspath(path)
    names, columns = read_table(file, "inverse.trajectory")
    if names[0] != TIME or len(names) < 2:
        raise ModelError(
            _wrong_end(f"the first line of {file} must be `time,JOINT.COORDINATE,…`, got `{','.join(names)}`")
        )
    if len(columns[0]) < FEWEST or columns[0][0] != 0.0:
        raise ModelError(_wrong_end(f"{file} must have at least {FEWEST} lines of numbers, from time 0 on"))
    faults: list[Fault] = []
    drivers: list[Driver] = []
    driven: set[str] = set()
    for name, values in zip(names[1:], columns[1:], strict=True):
        try:
            joint, coordinate = resolve(name, machine.joints)
        except UnknownCoordinateError as error:
            faults.append(_wrong_end(str(error)))
            continue
        driven.add(f"{joint}.{coordinate}")
        table: Any = {"times": columns[0], "values": values, "interpolation": "cubic"}
        drivers.append(Driver(name=f"follow_{joint}_{coordinate}", coordinate=f"{joint}.{coordinate}", value=table))
    refuse(faults)
    kept = tuple(each for each in machine.drivers if each.coordinate not in driven)
    simulation = machine.simulation.replace(duration=columns[0][-1])
    joints = released(machine.joints, driven)
    return machine.replace(joints=joints, drivers=(*kept, *drivers), simulation=simulation)


def _wrong_end(message: str) -> Fault:
    return Fault.at("inverse.trajectory", message)


# singular values below this share of the largest are zero
LEAST_RANK = 1e-9
# what limits leave undone below this share of what is asked is round-off
DONE = 1e-9


class Least(Struct):
    """efforts (m,). missing (f,) : what of the generalised forces no efforts give. rank : of the matrix. limited : whether limits hold some
    back from doing what is asked."""

    efforts: Array
    missing: Array
    rank: int
    limited: bool


def least_efforts(A: Array, b: Array, weights: Array, low: Array, high: Array, reach: Array) -> Least:
    """τ with A τ = b (A (f, m)), or as near as can be, of least Σ (w τ)², low ≤ τ ≤ high (infinite where there is none).

    reach (m,) : size of the columns of A if nothing were held; what is left of one below LEAST_RANK of it is nothing.
    Without limits by the singular value decomposition; with limits as a least-distance problem (Lawson, Hanson 1974, ch. 23).
    """
    U, size, Vt = np.linalg.svd(A / weights, full_matrices=True)
    least = LEAST_RANK * max(float(np.max(reach / weights, initial=0.0)), float(np.max(size, initial=0.0)), 1e-300)
    rank = int(np.sum(size > least))
    part = Vt[:rank].T @ ((U[:, :rank].T @ b) / size[:rank])
    free = Vt[rank:].T
    tau = part / weights
    if np.any(tau < low) or np.any(tau > high):
        tau = _within(part, free, weights, low, high)
    missing = b - A @ tau
    outside = b - U[:, :rank] @ (U[:, :rank].T @ b)
    scale = max(float(np.abs(b).max(initial=0.0)), 1e-300)
    limited = bool(np.abs(missing - outside).max(initial=0.0) > DONE * scale)
    return Least(tau, missing, rank, limited)


def _within(part: Array, free: Array, weights: Array, low: Array, high: Array) -> Array:
    """Efforts part + free y (weighted) of least norm within the limits; cut off where no y keeps them."""
    rows, right = [], []
    for sign, bound in ((1.0, low), (-1.0, high)):
        for k in np.flatnonzero(np.isfinite(bound)):
            scale = weights[k]
            rows.append(sign * free[k] / scale)
            right.append(sign * (bound[k] - part[k] / scale))
    y = _least_distance(np.array(rows), np.array(right)) if free.shape[1] else None
    tau = (part + free @ y if y is not None else part) / weights
    return np.clip(tau, low, high)


def _least_distance(G: Array, h: Array) -> Array | None:
    """y of least norm with G y ≥ h; None where there is none."""
    size = np.maximum(np.linalg.norm(np.column_stack([G, h]), axis=1), 1e-300)
    E = np.vstack([(G / size[:, None]).T, h / size])
    f = np.zeros(len(E))
    f[-1] = 1.0
    u, _ = nnls(E, f)
    r = E @ u - f
    return None if np.linalg.norm(r) < 1e-10 else -r[:-1] / r[-1]


# generalised forces missing below this share of the largest are round-off
MISSING = 1e-6
# coordinates that do as much to this share are alike
ALIKE = 0.999


def without_actuators(machine: MachineRecord, actuation: Actuation) -> MachineRecord:
    """The machine without the motors that stand for actuators, and without the drivers that do not hold."""
    holding = tuple(driver for driver in machine.drivers if driver.name in actuation.hold)
    return driven_alone(machine, actuation).replace(drivers=holding)


def inverse(methods: Methods, actuation: Actuation, motion: Result, *, listener: Listener | None = None) -> Efforts:
    """Efforts at every frame of the motion. methods : of the machine `without_actuators`, in absolute coordinates.

    Raises ModelError where the motion is not one of the machine.
    """
    listener = listener or Listener()
    listener.say("finding efforts", float(motion.time[-1]) if len(motion.time) else None)
    moment = at_start(methods)
    instant = Instant(moment.motion, 0.0, moment.y)
    names = list(instant.system.layout.coordinates["joint_coordinate"])
    index, constraints = instant.record.joints.coordinate.astype(np.int64), instant.record.constraints
    places = [int(index[names.index(each.coordinate)]) for each in actuation.actuators]
    times, efforts, rates, missing, shares, worst = [], [], [], [], [], Counter[str]()
    limited, rank, freedoms, open_by = False, 0, 0, 0.0
    for state in moving_states(instant.system, motion):
        _count_turns(instant, state, index)
        found, b, speed, named = _at(instant, state, actuation, places, index, names)
        limited |= found.limited
        violation = (constraints.C / constraints.scale)[: instant.system.machine_rows]
        open_by = max(open_by, float(np.max(np.abs(violation), initial=0.0)))
        rank, freedoms = max(rank, found.rank), max(freedoms, len(b))
        times.append(state.time)
        efforts.append(found.efforts)
        rates.append(speed)
        missing.append(named[1])
        shares.append(float(np.linalg.norm(found.missing) / max(float(np.linalg.norm(b)), 1e-300)))
        if named[0] and shares[-1] > MISSING:
            worst[named[0]] += 1
        if listener.progress is not None:
            listener.progress(state.time)
    of = worst.most_common(1)[0][0] if worst else ""
    return Efforts(
        name=motion.name,
        time=np.array(times),
        actuators=tuple(each.name for each in actuation.actuators),
        coordinates=tuple(each.coordinate for each in actuation.actuators),
        units=tuple(each.unit for each in actuation.actuators),
        effort=np.array(efforts).reshape(len(times), -1),
        rate=np.array(rates).reshape(len(times), -1),
        missing=np.array(missing),
        missing_share=np.array(shares),
        missing_at=of,
        limits=actuation.limits,
        limited=limited,
        violation=open_by,
        freedoms=freedoms,
        rank=rank,
        held=tuple(
            fact.name
            for fact in instant.system.states
            if not fact.integral and f"state.{fact.name}" not in motion.variables
        ),
    )


def _at(
    instant: Instant,
    state: MovingState,
    actuation: Actuation,
    places: list[int],
    index: NDArray[np.int64],
    names: list[str],
) -> tuple[Least, Array, Array, tuple[str, float]]:
    """The efforts at a state, what they are to give, the rates of their coordinates, and where most is missing, and how much."""
    instant.move_to(state.time, state.y, state.vdot)
    free, length = instant.free, instant.length[instant.free]
    J, by_coordinate = _jacobians(instant, index)
    r0 = instant.value()[: instant.n][free]
    velocity = state.y[instant.positions : instant.first_state]
    rates = by_coordinate @ velocity
    rows = J[:, free] * length
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    Z = length[:, None] * free_motions(rows / np.where(size > 0.0, size, 1.0))
    every_coordinate = Z.T @ by_coordinate[:, free].T
    column = [int(np.flatnonzero(index == place)[0]) for place in places]
    b = Z.T @ r0
    limit = actuation.limits
    reach = np.linalg.norm(by_coordinate[:, free] * length, axis=1)[column]
    found = least_efforts(every_coordinate[:, column], b, actuation.weights, -limit, limit, reach)
    named = ("", 0.0)
    if names and np.abs(found.missing).max(initial=0.0) > MISSING * max(float(np.abs(b).max(initial=0.0)), 1e-300):
        named = _where(every_coordinate, found.missing, column, names)
    return found, b, rates[column], named


def _count_turns(instant: Instant, state: MovingState, index: NDArray[np.int64]) -> None:
    """Whole turns of all angles: of joint coordinates those of the motion, of others those nearest to the state before."""
    coordinates = instant.record.coordinates
    coordinates.reference[:] = coordinates.value
    if len(state.coordinates) == len(index):
        coordinates.reference[index] = state.coordinates


def _where(columns: Array, missing: Array, actuators: list[int], names: list[str]) -> tuple[str, float]:
    """The joint coordinate on which an effort would give most of what is missing, one with an actuator where there is a choice; that
    effort."""
    sizes = np.linalg.norm(columns, axis=0)
    given = np.abs(columns.T @ missing) / np.where(sizes > RANK * max(float(sizes.max()), 1e-300), sizes, np.inf)
    best = np.flatnonzero(given >= ALIKE * given.max())
    acting = [k for k in best if k in actuators]
    chosen = acting[0] if acting else int(best[np.argmax(sizes[best])])
    return names[chosen], float(columns[:, chosen] @ missing / sizes[chosen] ** 2)


def _jacobians(instant: Instant, index: NDArray[np.int64]) -> tuple[Array, Array]:
    """(constraint rows, rows of all joint coordinates) with respect to the velocities, at the present state."""
    motion, system = instant.motion, instant.system
    motion.evaluate(instant.t, instant.y)
    observe(motion.handle.address, instant.t, instant.y, np.zeros(system.layout.width))
    row, body, block = motion.jacobian_blocks(index.tolist())
    rows = system.machine_rows
    out = np.zeros((rows + len(index), system.body_count, 6))
    np.add.at(out, (row, body), block)
    out = out.reshape(rows + len(index), 6 * system.body_count)
    return out[:rows], out[rows:]


def with_trust(efforts: Efforts, drivers: Sequence[Driver], motion: Result, replaced: Sequence[Driver] = ()) -> Efforts:
    """The efforts with their trust report. drivers : of the machine; replaced : those whose motion another one was given in place of."""
    followed = tuple(each for each in drivers if each not in replaced)
    subject = Actuated(outcome="done", result=motion, efforts=efforts, drivers=followed, replaced=tuple(replaced))
    return replace(efforts, trust=assess(subject))
