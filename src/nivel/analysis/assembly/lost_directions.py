"""Lost directions: points that coincide where a joint needs the line between them, axes that are parallel where it needs their normal.

Such a joint is closed as placed, but nothing says in which direction it holds: the derivative of its row is zero, or not a number.
"""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations, equations
from nivel.analysis.assembly.redundancy import dependent_rows, row_lengths, scaled_jacobian
from nivel.errors import Fault, ModelError, refuse
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints.parallel_axes import tilted_axes
from nivel.system.system import System

# Points that are nearer than this share of the machine's length have no line between them; rows of derivatives below LOST of their
# scale no direction.
COINCIDE, LOST = 1e-9, 1e-7


def refuse_lost_directions(machine: MachineRecord, motion: MotionEquations) -> None:
    """Refuse joints without a direction in the state last evaluated, in which they are closed.

    Raises ModelError.
    """
    system = motion.system
    if not system.machine_rows:
        return
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        lengths = row_lengths(motion)
    lost = ~(lengths > LOST * system.record.constraints.scale[: len(lengths)])
    owners = {system.row_owner[row] for row in np.flatnonzero(lost)}
    faults = []
    for k, joint in enumerate(machine.joints):
        apart = _distance(system, k)
        if "distance" in joint.held or joint.type == "revolute-spherical":
            if apart <= COINCIDE * system.size:
                key = "points" if joint.points is not None else "markers"
                message = (
                    f"its two {key} are at one place, {apart:.2g} m apart, so the line between them has no direction: move one of them, or "
                    f"write `type: spherical`"
                )
                faults.append(Fault.at(f"joints.{joint.name}.{key}", message))
        elif joint.name in owners:
            key = "axes" if joint.axes is not None else "markers"
            message = (
                f"the axes of its two markers are parallel here, and a {joint.type} joint needs them at an angle: turn one of them, e.g. "
                f"`axes: [[0, 1, 0], [0, 0, 1]]`"
            )
            faults.append(Fault.at(f"joints.{joint.name}.{key}", message))
    refuse(faults)


def _distance(system: System, k: int) -> float:
    """Between the points of the two markers of joint k [m]."""
    record = system.record
    first = int(record.joints.first_marker[k])
    return float(np.linalg.norm(record.markers.r[first + 1] - record.markers.r[first]))


# Axes that differ by more than this [rad] are meant to.
MEANT = 0.01


def refuse_tilted_axes(machine: MachineRecord, motion: MotionEquations) -> None:
    """Refuse an axis that differs from others by more than the tolerance of the machine, and by that takes a degree of freedom from it.

    Raises ModelError with one message: the joint, its axis, and the angle.
    """
    tilts = tilted_axes(machine, MEANT)
    if not tilts:
        return
    setting = machine.assembly.replace(parallel=MEANT)
    straight = equations(machine.model_copy(update={"assembly": setting}))
    if _freedoms(machine, motion) >= _freedoms(machine, straight):
        return
    first = tilts[0]
    joint = next(joint for joint in machine.joints if joint.name == first.joint)
    key = "axis" if joint.axis is not None else "markers"
    also = "".join(f"; that of {tilt.joint} by {tilt.angle:.3g} rad" for tilt in tilts[1:])
    others = ", ".join(first.others)
    message = (
        f"this axis differs by {first.angle:.3g} rad ({np.degrees(first.angle):.3g} deg) from the axes of {others}, to which it has to be "
        f"parallel, or the machine cannot move{also}; write the same axis there, or `assembly: {{parallel: {1.2 * first.angle:.2g} rad}}`, "
        f"which takes them as parallel (now {machine.assembly.parallel:.3g} rad)"
    )
    raise ModelError(Fault.at(f"joints.{first.joint}.{key}", message))


def _freedoms(machine: MachineRecord, motion: MotionEquations) -> int:
    """Degrees of freedom of velocities in the state as given, without drivers."""
    system = motion.system
    driven = {driver.name for driver in machine.drivers}
    joined = [row for row in range(system.machine_rows) if system.row_owner[row] not in driven]
    motion.evaluate(0.0, system.start)
    J = scaled_jacobian(motion)[joined]
    return system.freedoms - len(joined) + (len(dependent_rows(J)[0]) if np.all(np.isfinite(J)) else 0)
