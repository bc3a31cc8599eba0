"""Joints of a machine with redundant constraints that can be freer, so that nothing is redundant and the same motions stay.

Let the columns of N span the multipliers without effect, C_qᵀ u = 0, and those of R what a change of joints gives up of the multipliers.
The rows that stay are independent where no u of that span is without a part in R: where Rᵀ N is regular. As many rows are given up as are
too many, so the rank stays, and no motion becomes free. Joints whose rows repeat each other apart from others, which N Nᵀ does not couple,
are looked at by themselves.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from itertools import chain, combinations, islice
from typing import Final, NamedTuple

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.named_freedoms import LARGEST
from nivel.analysis.assembly.redundancy import dependent_rows, row_lengths, scaled_jacobian
from nivel.elements.joints import JOINTS
from nivel.lazy import scipy
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array

MOST: Final = 4  # joints that are changed among those that repeat each other
TRIED: Final = 3000  # combinations of changes that are decomposed
LISTED: Final = 100_000  # combinations of which the rows are counted
COUPLED: Final = 1e-9  # entries of N Nᵀ above this are not round-off
REGULAR: Final = 1e-6  # smallest singular value of Rᵀ N, as a share of the largest
POINT: Final = ("s.x", "s.y", "s.z")


def exact_joints(machine: MachineRecord, motion: MotionEquations, repeated: Collection[str]) -> tuple[str, ...]:
    """Fewest changes of joints, couplings and drivers named `repeated`, each in words, in the position last evaluated; empty where MOST
    changes do not suffice.

    A change counts where the rank of the constraints stays: no motion becomes free. Joints between two moving bodies come first, points on
    lines and planes then, and only where freer joints do not suffice are some left out, as few as can be.
    """
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return ()
    _, N = dependent_rows(scaled_jacobian(motion))
    lengths = row_lengths(motion)
    proposed: list[str] = []
    elements = (*machine.joints, *machine.couplings, *machine.drivers)
    for names in _groups(motion, N, [each.name for each in elements if each.name in repeated]):
        rows = np.isin(system.row_owner[: len(N)], list(names))
        U, sizes, _ = np.linalg.svd(N[rows], full_matrices=False)
        free = np.zeros((len(N), int(np.sum(sizes > 0.5))))  # the shares of a group are 1, those of others 0
        free[rows] = U[:, : free.shape[1]]
        chosen = _chosen(machine, motion, free / lengths[:, None], names)
        if not chosen:
            return ()
        proposed += [f"{each.joint} {each.freer}" if each.freer else f"leave out {each.joint}" for each in chosen]
    return tuple(proposed)


def _chosen(machine: MachineRecord, motion: MotionEquations, N: Array, names: Collection[str]) -> Sequence[_Change]:
    """The changes of some elements. N (rows, surplus) : multipliers without effect, of rows as they are."""
    surplus = N.shape[1]
    changes = list(_changes(machine, motion, N, names))
    used, found = _used(machine), ()
    for suited in ([each for each in changes if each.joint not in used], changes):
        usual = [change for change in suited if not change.freer.startswith("point")]
        found = found or _fewest(usual, surplus) or _fewest(suited, surplus)
    every = (*changes, *_left_out(machine, motion, N, names))
    for most in range(1, MOST + 1):
        found = found or _fewest(every, surplus, most)
    return found


def _used(machine: MachineRecord) -> set[str]:
    """Joints whose coordinates something else names, or whose start is given: a freer joint would lose these."""
    others = set(type(machine).model_fields) - {"bodies", "joints", "markers", "simulation"}
    words = set(re.findall(r"[\w-]+", machine.model_dump_json(include=others)))
    return {each.name for each in machine.joints if each.name in words or each.start is not None}


def _groups(motion: MotionEquations, N: Array, repeated: Sequence[str]) -> list[set[str]]:
    """Names of elements whose rows repeat each other; elements of different groups do not."""
    names = np.array(repeated)
    owner = np.array(motion.system.row_owner[: len(N)])
    share = np.abs(N @ N.T)
    own = [owner == name for name in names]
    coupled = np.array([np.max(share[rows], axis=0) for rows in own])
    coupled = np.array([np.max(coupled[:, rows], axis=1) for rows in own]) > COUPLED
    _, group = scipy.sparse.csgraph.connected_components(coupled, directed=False)
    return [set(names[group == k].tolist()) for k in dict.fromkeys(group.tolist())]


def _fewest(changes: Sequence[_Change], surplus: int, left_out: int = 0) -> Sequence[_Change]:
    """The first of the fewest changes that give up as many rows as are too many, with independent ones left; `left_out`: how many elements
    may be."""
    looked_at = 0
    most = max((change.less for change in changes), default=0)
    enough = (count for count in range(1, MOST + 1) if count * most >= surplus)
    listed = islice(chain.from_iterable(combinations(changes, count) for count in enough), LISTED)
    for chosen in listed:
        if sum(each.less for each in chosen) != surplus or len({each.joint for each in chosen}) < len(chosen):
            continue
        if sum(not each.freer for each in chosen) > left_out:
            continue
        looked_at += 1
        if looked_at > TRIED:
            return ()
        sizes = np.linalg.svd(np.vstack([each.given_up for each in chosen]), compute_uv=False)
        if sizes[-1] > REGULAR * sizes[0]:
            return chosen
    return ()


class _Change(NamedTuple):
    """A joint with a freer type, or (empty) an element left out: how many rows less, and what it gives up of the multipliers without
    effect, Rᵀ N (less, surplus)."""

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
        for freer, kept in JOINTS[joint.type].freer.items():
            along = "s.axis" in kept
            given_up = [row for name, row in own.items() if name not in kept and not (along and name in POINT)]
            if along:
                given_up.append(axis @ np.vstack([own[name] for name in POINT]))
            inner = GROUND not in (joint.bodies or ())
            order = (freer.startswith("point"), not inner)
            found.append((order, _Change(joint.name, freer, len(given_up), np.vstack(given_up))))
    yield from (change for _, change in sorted(found, key=lambda each: each[0]))


def _left_out(machine: MachineRecord, motion: MotionEquations, N: Array, names: Collection[str]) -> Iterator[_Change]:
    """Elements left out, the last ones first: drivers, couplings, joints."""
    owner = np.array(motion.system.row_owner[: len(N)])
    for element in reversed((*machine.joints, *machine.couplings, *machine.drivers)):
        if element.name in names:
            own = N[owner == element.name]
            yield _Change(element.name, "", len(own), own)
