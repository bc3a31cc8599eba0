"""Tilted axes: joints whose axes are nearly parallel to those of others, where the machine moves only if they are parallel."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations, equations
from nivel.analysis.assembly.redundancy import dependent_rows, scaled_jacobian
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints.parallel_axes import tilted_axes

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
