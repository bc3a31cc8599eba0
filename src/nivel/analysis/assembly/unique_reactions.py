"""Unique reactions of a machine with redundant constraints: components that follow from the equations, and those that do not.

Any u with C_qᵀ u = 0 may be added to the multipliers. A component of a joint's reaction is unique where none of these changes it
(Wojtyra 2005). How far the others may differ without any preload in the machine: as many rows as are too many may be left out in several
ways, and each way makes the machine exactly constrained, with reactions of its own. Their extremes are given.

Rows of a redundant machine that repeat others in every position: they are left out of the factor of S, which stays sparse.
That the rows are the same everywhere is shown at random positions far aside: there, too, the rows that stay are independent, and the others
depend on them. Minors of C_q are analytic in the positions, so what vanishes at one of them in general position vanishes along the motion.
Where this cannot be shown, rows are chosen by pivots in every evaluation.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import combinations
from math import comb
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.named_freedoms import LARGEST
from nivel.analysis.assembly.redundancy import DEPENDENT, aside, dependent_rows, row_lengths, scaled_jacobian
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.lazy import dataclass
from nivel.system.system import Array, System

# a component that changes by less than this share of the largest change does not: shares are 0.1 and more, or round-off
UNCHANGED: Final = 1e-6
# ways of leaving rows out that are looked at, and the least singular value of one that leaves the others well apart
MOST_WAYS: Final = 2000
# of more rows than this that are too many, fewer ways are looked at, so that the time does not grow
MANY_ROWS: Final = 20
FEWEST_WAYS: Final = 20
APART: Final = 0.02
COMPONENTS: Final = ("force x", "force y", "force z", "moment x", "moment y", "moment z")


@dataclass(frozen=True)
class ReactionFacts:
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
    free = _free_multipliers(motion)
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


def _free_multipliers(motion: MotionEquations) -> Array:
    """(K, k) multipliers without any effect, lengths and moments in units of the machine's length."""
    _, N = dependent_rows(scaled_jacobian(motion))
    return N / row_lengths(motion)[:, None]


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
