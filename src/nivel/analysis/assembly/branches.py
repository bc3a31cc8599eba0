"""Both assemblies of a machine that is drawn in a singular position, where two motions meet: a linkage that is folded exactly.

There C_q has lost rank, and one free motion more is possible at first order than on either side. Where that makes two, positions a little
aside in all directions of their plane are closed again; each comes to one of the motions that are really possible.
"""

import numpy as np

from nivel.analysis.assembly.closing import Index, close_positions
from nivel.analysis.assembly.equations import MotionEquations, change_between, equations, moved
from nivel.analysis.assembly.redundancy import DEPENDENT, scaled_jacobian
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array

# Directions that are looked at; how far aside, in radians and machine lengths; motions that differ by less are one [rad].
LOOKED_AT, FAR, SAME = 24, 0.02, 0.1
# A coordinate moves with at least this share of the one that moves most; named are at most so many.
MOVES, MOST = 0.02, 3


class _Motion(Struct):
    """A motion that is possible: its direction in the plane of free motions [rad], and changes of joint coordinates along it."""

    direction: float
    changes: Array


def both_assemblies(machine: MachineRecord, y: Array) -> str:
    """The two motions that meet in the singular state y (absolute coordinates), and what to write for each; empty where it is not two.
    Where drivers hold a machine there, the two are those that it has without them."""
    told = _both(machine, y)
    return told or (_both(machine.replace(drivers=()), y) if machine.drivers else "")


def _both(machine: MachineRecord, y: Array) -> str:
    motion = equations(machine, measured=True)
    coordinates = motion.system.record.joints.coordinate.astype(np.int64)
    names = motion.system.layout.coordinates["joint_coordinate"]
    found = _motions(motion, y, coordinates)
    if len(found) != 2 or not len(names):
        return ""
    one, other = (each.changes for each in found)
    common = np.minimum(np.abs(one), np.abs(other))
    leading = int(np.argmax(common))
    if common[leading] <= MOVES * max(np.abs(one).max(), np.abs(other).max()):
        return ""
    units = motion.system.coordinate_units
    one, other = one / one[leading], other / other[leading]
    differ = [k for k in np.argsort(-np.abs(one - other), kind="stable").tolist() if abs(one[k] - other[k]) > MOVES]
    shown = differ[:MOST]
    if not shown:
        return ""

    def told(changes: Array) -> str:
        return ", ".join(f"{names[k]} by {_change(float(changes[k]), units[k], units[leading])}" for k in shown)

    step = "1°" if units[leading] == "rad" else "1 mm"
    return (
        f"Two assemblies meet there: as {names[leading]} grows by {step}, {told(one)} in one, and {told(other)} in the other; place the "
        f"bodies a little aside, as in the one that is meant"
    )


def _change(share: float, unit: str, leading: str) -> str:
    """The change of a coordinate for a degree, or a millimetre, of the leading one."""
    own = share * (np.pi / 180.0 if leading == "rad" else 1e-3)
    return f"{np.degrees(own):+.3g}°" if unit == "rad" else f"{1e3 * own:+.3g} mm"


def _motions(motion: MotionEquations, y: Array, coordinates: Index) -> list[_Motion]:
    """The motions that are possible from y, where there are two free motions at first order."""
    motion.evaluate(0.0, y)
    system, values = motion.system, motion.system.record.coordinates.value
    start = values[coordinates].copy()
    _, sizes, directions = np.linalg.svd(scaled_jacobian(motion))
    plane = directions[int(np.sum(sizes > DEPENDENT)) :]
    if len(plane) != 2:
        return []
    found: list[_Motion] = []
    for angle in np.arange(LOOKED_AT) * 2.0 * np.pi / LOOKED_AT + 0.01:
        change = (FAR * (np.cos(angle) * plane[0] + np.sin(angle) * plane[1])).reshape(-1, 6)
        change[:, :3] *= system.size
        beside = y.copy()
        beside[: system.positions] = moved(y[: system.positions], change.ravel())
        if not close_positions(motion, 0.0, beside):
            continue
        reached = change_between(y[: system.positions], beside[: system.positions])
        reached[:, :3] /= system.size
        a, b = plane @ reached.ravel()
        if not 0.3 * FAR < np.hypot(a, b) < 2.0 * FAR:
            continue
        direction = float(np.arctan2(b, a)) % np.pi
        apart = [abs((direction - each.direction + 0.5 * np.pi) % np.pi - 0.5 * np.pi) for each in found]
        if all(each > SAME for each in apart):
            found.append(_Motion(direction, values[coordinates] - start))
    return found
