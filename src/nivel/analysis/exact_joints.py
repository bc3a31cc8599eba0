"""Which joints of a machine with redundant constraints can be freer, so that nothing is redundant and the same motions stay."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import chain, combinations, islice
from typing import Final, NamedTuple

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.analysis.freedoms import LARGEST
from nivel.analysis.redundancy import DEPENDENT, scaled_jacobian
from nivel.machine.machine_record import MachineRecord
from nivel.machine.record import GROUND
from nivel.system.system import Array

MOST: Final = 4  # joints that are changed
TRIED: Final = 3000  # combinations of changes that are decomposed
LISTED: Final = 100_000  # combinations of which the rows are counted
# freer joints in place of one, and the rows of that one that they have, by what stands behind the joint's name; "s.axis" is what is left of
# a point that may slide along the axis
_FREER: Final[dict[str, dict[str, tuple[str, ...]]]] = {
    "revolute": {
        "spherical": ("s.x", "s.y", "s.z"),
        "cylindrical": ("s.axis", "d1.xz", "d1.yz"),
        "point-on-line": ("s.axis",),
    },
    "translational": {"cylindrical": ("d1.xz", "d1.yz", "d2.x", "d2.y"), "point-on-line": ("d2.x", "d2.y")},
    "cylindrical": {"point-on-line": ("d2.x", "d2.y")},
    "universal": {"spherical": ("s.x", "s.y", "s.z")},
    "fixed": {"spherical": ("s.x", "s.y", "s.z"), "revolute": ("s.x", "s.y", "s.z", "d1.xz", "d1.yz")},
    "planar": {"point-on-plane": ("d2.z",)},
}


def exact_joints(machine: MachineRecord, motion: MotionEquations, joints: Collection[str]) -> tuple[str, ...]:
    """Fewest changes of `joints`, each in words, in the position last evaluated; empty where MOST changes do not suffice.

    A change counts where the rank of the constraints stays: no motion becomes free. Joints between two moving bodies come first, points on
    lines and planes last.
    """
    if motion.system.machine_rows * 6 * motion.system.body_count > LARGEST:
        return ()
    J = scaled_jacobian(motion)
    rows = {name: J[[k]] for k, name in enumerate(motion.system.rows[: len(J)])}
    changes = list(_changes(machine, motion, rows, joints))
    surplus = len(J) - _rank(J)
    usual = [change for change in changes if not change.freer.startswith("point")]
    chosen = _fewest(usual, rows, surplus) or _fewest(changes, rows, surplus)
    return tuple(f"{each.joint} {each.freer}" for each in chosen)


def _fewest(changes: Sequence[_Change], rows: dict[str, Array], surplus: int) -> Sequence[_Change]:
    """The first of the fewest changes that give up as many rows as are too many, with independent ones left."""
    looked_at = 0
    most = max((change.less for change in changes), default=0)
    enough = (count for count in range(1, MOST + 1) if count * most >= surplus)
    listed = islice(chain.from_iterable(combinations(changes, count) for count in enough), LISTED)
    for chosen in listed:
        if sum(each.less for each in chosen) != surplus or len({each.joint for each in chosen}) < len(chosen):
            continue
        looked_at += 1
        if looked_at > TRIED:
            return ()
        kept = _stacked(rows, chosen)
        if _rank(kept) == len(kept):
            return chosen
    return ()


class _Change(NamedTuple):
    """A joint with a freer type: how many rows less, and all its rows then."""

    joint: str
    freer: str
    less: int
    rows: Array


def _changes(
    machine: MachineRecord, motion: MotionEquations, rows: dict[str, Array], joints: Collection[str]
) -> Iterator[_Change]:
    record = motion.system.record
    found = []
    for k, joint in enumerate(machine.joints):
        if joint.name not in joints:
            continue
        axes = record.markers.A[int(record.joints.first_marker[k])]
        own = [name for name in rows if name.startswith(f"{joint.name}.")]
        for freer, kept in _FREER.get(joint.type, {}).items():
            left = [rows[name] for name in own if name.split(".", 1)[1] in kept]
            if "s.axis" in kept:
                point = np.vstack([rows[f"{joint.name}.s.{axis}"] for axis in "xyz"])
                left.append(axes[:, :2].T @ point)
            stacked = np.vstack(left)
            inner = GROUND not in (joint.bodies or ())
            order = (freer.startswith("point"), not inner)
            found.append((order, _Change(joint.name, freer, len(own) - len(stacked), stacked)))
    yield from (change for _, change in sorted(found, key=lambda each: each[0]))


def _stacked(rows: dict[str, Array], changes: Sequence[_Change]) -> Array:
    """All rows with these changes."""
    prefixes = tuple(f"{change.joint}." for change in changes)
    kept = [row for name, row in rows.items() if not name.startswith(prefixes)]
    return np.vstack([*kept, *(change.rows for change in changes)])


def _rank(J: Array) -> int:
    return int(np.sum(np.linalg.svd(J, compute_uv=False) > DEPENDENT))
