"""Lost directions: points that coincide where a joint needs the line between them, axes that are parallel where it needs their normal.

Such a joint is closed as placed, but nothing says in which direction it holds: the derivative of its row is zero, or not a number.
"""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.redundancy import row_lengths
from nivel.errors import Fault, refuse
from nivel.machine.machine_record import MachineRecord
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
