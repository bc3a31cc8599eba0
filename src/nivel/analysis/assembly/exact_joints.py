"""Which joints of a machine with redundant constraints can be freer, so that nothing is redundant and the same motions stay.

Let the columns of N span the multipliers without effect, C_qᵀ u = 0, and those of R what a change of joints gives up of the multipliers.
The rows that stay are independent where no u of that span is without a part in R: where Rᵀ N is regular. As many rows are given up as are
too many, so the rank stays, and no motion becomes free. Joints whose rows repeat each other apart from others, which N Nᵀ does not couple,
are looked at by themselves.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import chain, combinations, islice
from typing import Final, NamedTuple

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.freedoms import LARGEST
from nivel.analysis.assembly.redundancy import dependent_rows, row_lengths, scaled_jacobian
from nivel.machine.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.machine.record import GROUND
from nivel.system.system import Array

MOST: Final = 4  # joints that are changed among those that repeat each other
TRIED: Final = 3000  # combinations of changes that are decomposed
LISTED: Final = 100_000  # combinations of which the rows are counted
COUPLED: Final = 1e-9  # entries of N Nᵀ above this are not round-off
REGULAR: Final = 1e-6  # smallest singular value of Rᵀ N, as a share of the largest
POINT: Final = ("s.x", "s.y", "s.z")
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
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return ()
    _, N = dependent_rows(scaled_jacobian(motion))
    lengths = row_lengths(motion)
    proposed: list[str] = []
    for names in _groups(motion, N, [each for each in machine.joints if each.name in joints]):
        rows = np.isin(system.row_owner[: len(N)], list(names))
        U, sizes, _ = np.linalg.svd(N[rows], full_matrices=False)
        free = np.zeros((len(N), int(np.sum(sizes > 0.5))))  # the shares of a group are 1, those of others 0
        free[rows] = U[:, : free.shape[1]]
        changes = list(_changes(machine, motion, free / lengths[:, None], names))
        usual = [change for change in changes if not change.freer.startswith("point")]
        chosen = _fewest(usual, free.shape[1]) or _fewest(changes, free.shape[1])
        if not chosen:
            return ()
        proposed += [f"{each.joint} {each.freer}" for each in chosen]
    return tuple(proposed)


def _groups(motion: MotionEquations, N: Array, joints: Sequence[Joint]) -> list[set[str]]:
    """Names of joints whose rows repeat each other; joints of different groups do not."""
    from scipy.sparse.csgraph import connected_components

    names = np.array([joint.name for joint in joints])
    owner = np.array(motion.system.row_owner[: len(N)])
    share = np.abs(N @ N.T)
    own = [owner == name for name in names]
    coupled = np.array([np.max(share[rows], axis=0) for rows in own])
    coupled = np.array([np.max(coupled[:, rows], axis=1) for rows in own]) > COUPLED
    _, group = connected_components(coupled, directed=False)
    return [set(names[group == k].tolist()) for k in dict.fromkeys(group.tolist())]


def _fewest(changes: Sequence[_Change], surplus: int) -> Sequence[_Change]:
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
        sizes = np.linalg.svd(np.vstack([each.given_up for each in chosen]), compute_uv=False)
        if sizes[-1] > REGULAR * sizes[0]:
            return chosen
    return ()


class _Change(NamedTuple):
    """A joint with a freer type: how many rows less, and what it gives up of the multipliers without effect, Rᵀ N (less, surplus)."""

    joint: str
    freer: str
    less: int
    given_up: Array


def _changes(machine: MachineRecord, motion: MotionEquations, N: Array, joints: Collection[str]) -> Iterator[_Change]:
    """All changes of some joints. N (rows, surplus) : multipliers without effect, of rows as they are."""
    record = motion.system.record
    rows = {name: N[k] for k, name in enumerate(motion.system.rows[: len(N)])}
    found = []
    for k, joint in enumerate(machine.joints):
        if joint.name not in joints:
            continue
        axis = record.markers.A[int(record.joints.first_marker[k])][:, 2]
        own = {name.split(".", 1)[1]: row for name, row in rows.items() if name.startswith(f"{joint.name}.")}
        for freer, kept in _FREER.get(joint.type, {}).items():
            along = "s.axis" in kept
            given_up = [row for name, row in own.items() if name not in kept and not (along and name in POINT)]
            if along:
                given_up.append(axis @ np.vstack([own[name] for name in POINT]))
            inner = GROUND not in (joint.bodies or ())
            order = (freer.startswith("point"), not inner)
            found.append((order, _Change(joint.name, freer, len(given_up), np.vstack(given_up))))
    yield from (change for _, change in sorted(found, key=lambda each: each[0]))
