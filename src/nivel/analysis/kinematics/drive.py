"""A machine with one joint coordinate driven evenly over the duration of an analysis."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.plan.compilation import assembly_entries, build
from nivel.analysis.plan.plan import Methods, neutral
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.elements.joints.drivers import Driver
from nivel.elements.joints.joint import Joint
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Reach
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import KinematicsSettings
from nivel.results.analyses.mechanism import ConfigurationCurve, Range
from nivel.results.motion import rotation_matrices
from nivel.results.result import Result
from nivel.system.beam_nodes import with_nodes
from nivel.system.system import Array, System


def planned(
    record: MachineRecord, given: Mapping[str, Any], listener: Listener | None = None
) -> tuple[MachineRecord, Methods, KinematicsSettings]:
    """The machine driven by settings of kinematics, its methods, and the settings. Raises ModelError."""
    asked = nivel.machine.settings.analyses.kinematics_settings(record, given)
    refuse(nivel.judge.before.refusals.faults_of(record, nivel.judge.before.analyses.OF_KINEMATICS))
    build(assembly_entries(record), listener)
    machine, asked = driven(record, asked)
    return machine, neutral(machine, asked.coordinates)[1], asked


def driven(machine: MachineRecord, settings: KinematicsSettings) -> tuple[MachineRecord, KinematicsSettings]:
    """The machine with the driver that the settings ask for, if any, and its times; and the settings with both ends of the way.

    Raises ModelError where the coordinate is driven already, or the machine cannot be assembled.
    """
    out = machine
    if settings.drive:
        for driver in machine.drivers:
            if driver.coordinate is not None and settings.drive in (driver.coordinate, f"{driver.coordinate}.angle"):
                message = f"`{settings.drive}` is driven by {driver.name} already: leave `drive` out, or that driver"
                raise ModelError(Fault.at("kinematics.drive", message))
        start = present_value(machine, settings.drive)[0] if settings.start is None else settings.start
        end = start + 2.0 * pi if settings.end is None else settings.end
        settings = settings.replace(start=start, end=end)
        taken = {driver.name for driver in machine.drivers}
        name = next(each for each in ("drive", *(f"drive_{k}" for k in range(2, len(taken) + 3))) if each not in taken)
        value: Any = f"{start!r} + ({(end - start) / settings.duration!r})*time"
        drivers = (*machine.drivers, Driver(name=name, coordinate=settings.drive, value=value))
        out = machine.replace(joints=released(machine.joints, {settings.drive}), drivers=drivers)
    simulation = out.simulation.replace(duration=settings.duration, step=settings.step, output_interval=settings.step)
    return out.replace(simulation=simulation), settings


def released(joints: Sequence[Joint], driven: Collection[str]) -> tuple[Joint, ...]:
    """The joints without start values and rates of coordinates that are driven, which say how they start."""
    return tuple(
        joint.replace(
            start=_without(joint, joint.start, driven), start_rates=_without(joint, joint.start_rates, driven)
        )
        if joint.start is not None or joint.start_rates is not None
        else joint
        for joint in joints
    )


def _without(joint: Joint, values: Any, driven: Collection[str]) -> dict[str, float] | None:
    if values is None:
        return None
    return {name: value for name, value in values.given.items() if f"{joint.name}.{name}" not in driven} or None


def present_value(machine: MachineRecord, name: str) -> tuple[float, str, float]:
    """(value, unit, size of the machine [m]) of a joint coordinate of the machine as assembled [rad or m]."""
    machine = with_nodes(machine)
    motion = equations(machine)
    system, assembly = motion.system, assemble(machine, motion)
    motion.evaluate(0.0, assembly.y)
    frame = np.zeros(system.layout.width)
    observe(motion.handle.address, 0.0, assembly.y, frame)
    columns = next(each.columns for each in system.layout.variables if each.name == "joint_coordinate")
    k = system.layout.coordinates["joint_coordinate"].index(name)
    return float(frame[columns][k]), system.coordinate_units[k], system.size


# a coordinate that comes this near to a whole turn, and is there again, turns right round
TURN = 2.0 * pi


def range_of_motion(
    name: str,
    unit: str,
    start: float,
    reach: float,
    move: Callable[[float, float], Result],
    curve: Callable[[], ConfigurationCurve],
) -> Range:
    """The range of a coordinate that is at `start` now. reach : how far it is tried at most, each way. move(start, end) : the kinematic
    analysis of that way, which raises SolveError where it cannot go on. curve() : all positions, whose turning points are the ends found in
    another way; it raises ModelError where more than one motion is free."""
    ends, reasons, ways = [], [], []
    for way in (-reach, reach):
        end, reason = start + way, ""
        try:
            result: Result | None = move(start, end)
        except SolveError as error:
            found = error.result
            result = found if isinstance(found, Result) else None
            reason = error.message
        if result is not None:
            ways.append(result.trust)
        if result is not None and len(result.time):
            end = float(np.asarray(result.array(name))[-1])
        elif reason:
            end = start
        ends.append(end)
        reasons.append(reason)
    full = unit == "rad" and not any(reasons)
    found = Range(name, unit, ends[0], ends[1], full, reasons[0], reasons[1])
    turning = None
    if any(reasons):
        with suppress(ModelError, SolveError):  # then it cannot be told
            turning = tuple(each.value for each in curve().turning)
    return replace(found, trust=assess(Reach(outcome="done", range=found, ways=tuple(ways), turning=turning)))


# Singular positions of a driven machine on its way: where the positions may go on along more than one branch.
#
# With as many independent rows as velocities C_q is square. Its determinant changes sign where the machine passes a position in which C_q
# is singular, also between two frames; at a turning point of a driver the machine stops instead.

# positions that are looked at, at most, evenly over the frames
LOOKED_AT = 72
# rows take part with at least this share of the one that does most
TAKES_PART = 0.3


class Singularity(Struct):
    """passed : pairs of times [s] between which the determinant changes sign. least : the smallest singular value, as a share of that at
    the start, at `time` [s]; joints : whose rows depend on each other most there."""

    passed: tuple[tuple[float, float], ...]
    least: float
    time: float
    joints: tuple[str, ...]


class MovingState(Struct):
    """time [s], the state y, the accelerations v̇ (n,) of the bodies, and all joint coordinates; none where the motion has other ones."""

    time: float
    y: Array
    vdot: Array
    coordinates: Array


def moving_states(system: System, result: Result, every: int = 1) -> Iterator[MovingState]:
    """Every so many frames of a result of a machine with the same bodies. Raises ModelError where bodies differ."""
    names = list(result.coordinates.get("body", ()))
    if names != list(system.bodies):
        raise ModelError(f"the motion has the bodies {', '.join(names)}, the machine {', '.join(system.bodies)}")
    missing = [name for name in ("acceleration", "angular_acceleration", "velocity") if name not in result.variables]
    if missing:
        raise ModelError(f"the motion has no {', '.join(missing)}: give a result of a run or of kinematics")
    some = slice(None, None, every)
    position, orientation = result.array("position")[some], result.array("orientation")[some]
    rates = [
        result.array(name)[some] for name in ("velocity", "angular_velocity", "acceleration", "angular_acceleration")
    ]
    states = [
        result.array(f"state.{fact.name}")[some] if f"state.{fact.name}" in result.variables else None
        for fact in system.states
    ]
    known = list(result.coordinates.get("joint_coordinate_name", ())) == list(
        system.layout.coordinates["joint_coordinate"]
    )
    measured = known and "joint_coordinate" in result.variables
    angles = result.array("joint_coordinate")[some] if measured else np.zeros((len(position), 0))
    for k, time in enumerate(result.time[some]):
        A = rotation_matrices(orientation[k])
        velocity, omega, acceleration, alpha = (each[k] for each in rates)
        local = [np.einsum("bij,bi->bj", A, each) for each in (omega, alpha)]
        q = np.hstack([position[k], orientation[k]]).ravel()
        y = system.state(q, velocity, local[0])
        first = len(y) - len(system.start_of_states)
        for j, values in enumerate(states):
            if values is not None:
                y[first + j] = values[k]
        yield MovingState(float(time), y, np.hstack([acceleration, local[1]]).ravel(), angles[k])


def singular_positions(prepared: Prepared, result: Result) -> Singularity | None:
    """What a result of kinematics comes to; None for machines without constraints."""
    motion, rank = prepared.absolute, prepared.redundancy.rank
    system = motion.system
    if not rank or not len(result.time):
        return None
    every = max(1, -(-len(result.time) // LOOKED_AT))
    sizes, times, passed = [], [], []
    before: tuple[NDArray[np.intp], float] | None = None
    lost, least = np.zeros((0, 0)), np.inf
    for state in moving_states(system, result, every):
        motion.evaluate(state.time, state.y)
        rows = scaled_jacobian(motion)
        rows = rows[:, np.abs(rows).max(axis=0, initial=0.0) > 0.0] if system.point_masses.any() else rows
        size = float(np.linalg.svd(rows, compute_uv=False)[rank - 1])
        if before is not None and before[1] * determinant_sign(rows[before[0]]) < 0.0:
            passed.append((times[-1], state.time))
        kept = independent_rows(rows, rank)
        before = (kept, determinant_sign(rows[kept]))
        sizes.append(size)
        times.append(state.time)
        if size < least:
            least, lost = size, rows
    share = np.abs(np.linalg.svd(lost)[0][:, rank - 1])
    owners = dict.fromkeys(system.row_owner[row] for row in np.flatnonzero(share >= TAKES_PART * share.max()))
    k = int(np.argmin(sizes))
    return Singularity(tuple(passed), sizes[k] / sizes[0] if sizes[0] > 0.0 else 0.0, times[k], tuple(owners))


def independent_rows(rows: Array, rank: int) -> NDArray[np.intp]:
    """Rows that are well apart here: others may be so elsewhere, where constraints repeat each other."""
    pivoted: Any = qr(rows.T, mode="r", pivoting=True)
    return np.sort(pivoted[1][:rank])


def determinant_sign(rows: Array) -> float:
    """Of the determinant; 0 where motions are free."""
    return float(np.linalg.slogdet(rows)[0]) if rows.shape[0] == rows.shape[1] else 0.0
