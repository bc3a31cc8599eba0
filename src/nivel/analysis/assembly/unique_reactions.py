"""Unique reactions of a machine with redundant constraints: components that follow from the equations, and those that do not.

Any u with C_qᵀ u = 0 may be added to the multipliers. A component of a joint's reaction is unique where none of these changes it
(Wojtyra 2005). How far the others may differ without any preload in the machine: as many rows as are too many may be left out in several
ways, and each way makes the machine exactly constrained, with reactions of its own. Their extremes are given.

Rows of a redundant machine that repeat others in every position: they are left out of the factor of S, which stays sparse.
That the rows are the same everywhere is shown at random positions far aside: there, too, the rows that stay are independent, and the others
depend on them. Minors of C_q are analytic in the positions, so what vanishes at one of them in general position vanishes along the motion.
Where this cannot be shown, rows are chosen by pivots in every evaluation.
"""

import re
from collections.abc import Collection, Iterator, Sequence
from itertools import chain, combinations, islice
from math import comb
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.named_freedoms import LARGEST
from nivel.analysis.assembly.redundancy import DEPENDENT, aside, dependent_rows, row_lengths, scaled_jacobian
from nivel.elements.joints import JOINTS
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.lazy import Struct, scipy
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array, System

# Joints of a machine with redundant constraints that can be freer, so that nothing is redundant and the same motions stay.
#
# Let the columns of N span the multipliers without effect, C_qᵀ u = 0, and those of R what a change of joints gives up of the
# multipliers. The rows that stay are independent where no u of that span is without a part in R: where Rᵀ N is regular. As many rows are
# given up as are too many, so the rank stays, and no motion becomes free. Joints whose rows repeat each other apart from others, which N
# Nᵀ does not couple, are looked at by themselves.

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


def _chosen(machine: MachineRecord, motion: MotionEquations, N: Array, names: Collection[str]) -> "Sequence[_Change]":
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


def _fewest(changes: "Sequence[_Change]", surplus: int, left_out: int = 0) -> "Sequence[_Change]":
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


# a component that changes by less than this share of the largest change does not: shares are 0.1 and more, or round-off
UNCHANGED: Final = 1e-6
# ways of leaving rows out that are looked at, and the least singular value of one that leaves the others well apart
MOST_WAYS: Final = 2000
# of more rows than this that are too many, fewer ways are looked at, so that the time does not grow
MANY_ROWS: Final = 20
FEWEST_WAYS: Final = 20
APART: Final = 0.02
COMPONENTS: Final = ("force x", "force y", "force z", "moment x", "moment y", "moment z")


class ReactionFacts(Struct):
    """Reaction of a joint along the axes of its first marker, on its first body: components that are unique, and the others that it
    transmits; ranges : (low, high) [N, N m] of each of these, by what is left out; empty where reactions are not known."""

    joint: str
    unique: tuple[str, ...]
    others: tuple[str, ...]
    ranges: tuple[tuple[float, float], ...] = ()

    def __str__(self) -> str:
        said = ", ".join(self.unique) if self.unique else "nothing"
        others = [f"{name}{self._range(k)}" for k, name in enumerate(self.others)]
        return f"{self.joint}: unique {'is' if len(self.unique) < 2 else 'are'} {said}; not {', '.join(others)}"

    def _range(self, k: int) -> str:
        if not self.ranges:
            return ""
        (low, high), unit = self.ranges[k], "N" if self.others[k].startswith("force") else "N m"
        return f" ({low:.4g} to {high:.4g} {unit})" if high > low else f" ({low:.4g} {unit} without preload)"


def unique_reactions(motion: MotionEquations, *, loaded: bool = False) -> tuple[ReactionFacts, ...]:
    """The joints whose reactions are not unique as a whole, in the position last evaluated; none of large machines.

    loaded : the multipliers of the record are those of this state, and ranges are wanted.
    """
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return ()
    # multipliers without any effect (K, k), lengths and moments in units of the machine's length
    free = dependent_rows(scaled_jacobian(motion))[1] / row_lengths(motion)[:, None]
    if not free.shape[1]:
        return ()
    wrenches = [_wrenches(motion, k) for k in range(len(system.joints))]
    changes = [np.linalg.norm(own @ free[slice(*rows)], axis=1) for own, rows in wrenches]
    least = UNCHANGED * max(float(change.max(initial=0.0)) for change in changes)
    ways = _multipliers_by_way(motion, free) if loaded else None
    found = []
    for name, (own, rows), change in zip(system.joints, wrenches, changes, strict=True):
        carried = np.linalg.norm(own, axis=1) > UNCHANGED * np.linalg.norm(own)
        unique = tuple(
            word for word, moves, has in zip(COMPONENTS, change > least, carried, strict=True) if has and not moves
        )
        others = tuple(word for word, moves in zip(COMPONENTS, change > least, strict=True) if moves)
        if others:
            ranges = () if ways is None else _ranges(-ways[:, slice(*rows)] @ own.T, change > least, system.size)
            found.append(ReactionFacts(name, unique, others, ranges))
    return tuple(found)


def _ranges(reactions: Array, wanted: NDArray[np.bool_], size: float) -> tuple[tuple[float, float], ...]:
    """Extremes of the wanted components of reactions (ways, 6), with moments over `size`; round-off is nothing."""
    nothing = UNCHANGED * np.abs(reactions).max(initial=0.0)
    values = np.where(np.abs(reactions) > nothing, reactions, 0.0) * np.repeat([1.0, size], 3)
    return tuple((float(values[:, k].min()), float(values[:, k].max())) for k in np.flatnonzero(wanted))


def _multipliers_by_way(motion: MotionEquations, free: Array) -> Array | None:
    """(ways, K) multipliers where as many rows as are too many, free.shape[1], are left out; some ways of many. None without a way."""
    lam = motion.system.record.constraints.lam[: len(free)]
    if not np.isfinite(lam).all():
        return None
    basis, _ = np.linalg.qr(free)
    loose = np.flatnonzero(np.linalg.norm(basis, axis=1) > UNCHANGED)
    count = free.shape[1]
    if comb(len(loose), count) <= MOST_WAYS:
        ways = np.array(list(combinations(loose.tolist(), count)))
    else:
        rng = np.random.default_rng(0)
        tried = max(FEWEST_WAYS, int(MOST_WAYS * min(1.0, (MANY_ROWS / count) ** 3)))
        ways = np.array([rng.choice(loose, count, replace=False) for _ in range(tried)])
    apart = np.linalg.svd(basis[ways], compute_uv=False)[:, -1]
    ways = ways[apart > APART]
    if not len(ways):
        return None
    given = np.linalg.solve(free[ways], lam[ways][:, :, None])[:, :, 0]
    return lam - given @ free.T


def _wrenches(motion: MotionEquations, k: int) -> tuple[Array, tuple[int, int]]:
    """(6, n) reaction of joint k for a unit of each of its multipliers, moments over the machine's length; its rows."""
    record = motion.system.record
    first, last = record.joints.rows[k].tolist()
    parts = record.constraints.J[record.joints.part[first:last].astype(int)]
    A = record.markers.A[int(record.joints.first_marker[k])]
    forces, moments = A.T @ parts[:, :3].T, A.T @ parts[:, 3:].T
    return np.vstack([forces, moments / motion.system.size]), (first, last)


# Positions aside, as shares of the length of the machine (radians): the first that can be closed is taken.
FAR = (0.3, 0.1, 0.03)
POSITIONS = 2
# A bound of pivots that none reaches.
LEAST = 1e-300
# The rows that stay are independent where their smallest singular value is above this share of a row.
INDEPENDENT = 1e-5


def rows_everywhere(motion: MotionEquations, y: Array, end: float, staying: Collection[int] = ()) -> tuple[int, ...]:
    """Rows that depend on those before them at the state y, assembled and in absolute coordinates, and everywhere else; none where that
    cannot be shown. The record is left evaluated at y at t = 0.

    staying : rows that are put before all others. end : of the run [s], for machines that drivers move.
    """
    rows = motion.system.machine_rows
    order = np.array([*staying, *(row for row in range(rows) if row not in set(staying))], dtype=np.int64)
    reference = motion.system.record.coordinates.reference
    kept = reference.copy()
    Js = []
    for t, state in _positions(motion, y, end):
        reference[:] = kept
        motion.evaluate(t, state)
        Js.append(scaled_jacobian(motion))
    reference[:] = kept
    motion.evaluate(0.0, y)
    if not Js:
        return ()
    found = tuple(sorted(int(order[k]) for k in dependent_rows(Js[0][order])[0]))
    return found if all(_repeats(J, found) for J in Js) else ()


def _positions(motion: MotionEquations, y: Array, end: float) -> list[tuple[float, Array]]:
    """Times and states aside in general position; then the start. Of machines that cannot move, the start alone."""
    found = []
    for k in range(POSITIONS):
        for far in FAR:
            # drivers may leave no other freedom than time
            t = end * (0.1 + 0.2 * k) * far
            state = aside(motion, t, y, far, seed=k + 1)
            if state is not None:
                found.append((t, state))
                break
    return [*found, (0.0, y)] if len(found) == POSITIONS else []


def _repeats(J: Array, left_out: Collection[int]) -> bool:
    """Whether these rows of J depend on the others, which are independent."""
    kept = np.ones(len(J), dtype=bool)
    kept[list(left_out)] = False
    Q, R = np.linalg.qr(J[kept].T)
    if R.shape[0] < R.shape[1] or not np.min(np.abs(np.diag(R)), initial=1.0) > INDEPENDENT:
        return False
    rest = J[~kept].T
    rest = rest - Q @ (Q.T @ rest)
    return bool(np.max(np.linalg.norm(rest, axis=0), initial=0.0) < DEPENDENT)


def leave_out(system: System, rows: Collection[int]) -> None:
    """Leave these rows of the constraints out of the factor of S, as far as the system has them, if that makes the others independent."""
    saddle, control = system.record.saddle, system.record.control
    places = np.isin(saddle.row[saddle.order], np.array(sorted(rows), dtype=np.int64))
    if int(places.sum()) == len(saddle.row) - int(control.rank[0]):
        saddle.least[:] = np.where(places, -1.0, 1.0) * np.maximum(saddle.least, LEAST)
        control.rank[LEFT_OUT] = places.sum()
