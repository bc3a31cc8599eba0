"""A machine with one joint coordinate driven evenly over the duration of an analysis."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.elements.joints.drivers import Driver
from nivel.elements.joints.joint import Joint
from nivel.errors import Fault, ModelError, SolveError
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Reach
from nivel.kernels.output.observe import observe
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import KinematicsSettings
from nivel.results.analyses.configuration_curve import ConfigurationCurve
from nivel.results.analyses.mechanism import Range
from nivel.results.result import Result
from nivel.system.beam_nodes import with_nodes


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
