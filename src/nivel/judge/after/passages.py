"""Passages: positions of a run in which constraints depend on each other that do not elsewhere.

A pivot of a constraint row is what of the row does not depend on the rows eliminated before it, as a share of its square. S = C_q M⁻¹
C_qᵀ is factorised as in a run in absolute coordinates, and costs what one of its evaluations does. Where a row becomes a combination of
others its pivot falls to zero, with the square of the time. Rows that repeat others everywhere are left out of the factor; where it is
not known which these are, rows are chosen by pivots, and the last of these stands for all. All pivots are evaluated in frames of the
run, and one that has a minimum far below its middle value also between frames, on a parabola through three of them.
"""

from collections.abc import Callable, Collection, Iterator
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.assembly.unique_reactions import leave_out, rows_everywhere
from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation.preparation import Prepared
from nivel.judge.after.subject import Run
from nivel.kernels.core.arrays import copied
from nivel.kernels.core.status import SINGULAR
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.lazy import Struct, replace, scipy
from nivel.motion.catalogue import FLOATING
from nivel.results.scales import Readable
from nivel.system.system import Array, System

# Rows with this share of the largest part in what is lost name their joints.
PART = 0.3


class RowPivots(Struct):
    """The equations of a machine, with a record of their own, and its state as assembled. chosen : rows are chosen by pivots."""

    motion: MotionEquations
    y: Array
    rank: int
    chosen: bool

    @property
    def first_state(self) -> int:
        """Where the states of elements begin in y."""
        return len(self.y) - len(self.motion.system.start_of_states)

    def at(self, time: float, y: Array) -> Array:
        """(K,) pivots of all rows in elimination order, or (1,) the last of those that are chosen; no numbers for rows that are left out,
        and where S cannot be had."""
        system = self.motion.system
        saddle = system.record.saddle
        saddle.Dinv[:] = np.nan
        status, _ = self.motion.evaluate(time, y)
        if self.chosen:
            if not np.isfinite(saddle.Dinv).all():
                return np.full(1, np.nan)
            return np.array([0.0 if status == SINGULAR else saddle.dense[self.rank - 1, self.rank - 1] ** 2])
        with np.errstate(divide="ignore", invalid="ignore"):
            out = 1.0 / (saddle.Dinv * saddle.S[self._diagonal])
        out[~np.isfinite(out)] = np.nan
        if status == SINGULAR:
            out[saddle.row[saddle.order] == system.record.control.failure[0]] = 0.0
        return out

    def joints(self, place: int) -> tuple[str, ...]:
        """Whose rows depend on each other in the state last evaluated, where the pivot at `place` is as good as zero."""
        system = self.motion.system
        saddle = system.record.saddle
        part = np.abs(self._chosen_combination() if self.chosen else self._combination(place))
        rows = saddle.row[saddle.order[np.flatnonzero(part > PART * part.max())]]
        return tuple(dict.fromkeys(system.row_owner[row] for row in np.sort(rows)))

    @property
    def _diagonal(self) -> Any:
        return self.motion.system.record.saddle.S_start[1:].astype(np.int64) - 1

    def _combination(self, place: int) -> Array:
        """(K,) x in elimination order with Lᵀ x = e of this place, so that S x = D e: times the lengths of the rows."""
        saddle = self.motion.system.record.saddle
        x = np.zeros(len(saddle.order))
        x[place] = 1.0
        for j in range(place - 1, -1, -1):
            first, last = saddle.L_start[j : j + 2]
            below = saddle.L_row[first:last]
            inside = below <= place
            x[j] = -(saddle.L[first:last][inside] @ x[below[inside]])
        return x * np.sqrt(saddle.S[self._diagonal])

    def _chosen_combination(self) -> Array:
        """The same for the last of the chosen rows, of unit length."""
        saddle, n = self.motion.system.record.saddle, self.rank
        x, last = np.zeros(len(saddle.order)), np.zeros(n)
        last[-1] = 1.0
        x[saddle.pivot[:n]] = scipy.linalg.solve_triangular(saddle.dense[:n, :n], last, lower=True, trans=1)
        return x


def row_pivots(prepared: Prepared, methods: Methods, duration: float) -> RowPivots:
    """Of a machine that moves for `duration` [s]."""
    absolute, rank = prepared.absolute, prepared.redundancy.rank
    system, y, kernels = _unranked(absolute.system), prepared.assembly.y.copy(), absolute.kernels
    if methods.machine.is_flexible:
        system, y = FLOATING.arrange(methods.machine, system, y, rank, methods.cut)
        kernels = import_module(FLOATING.module)
    elif rank < system.machine_rows:
        left = _left_out(prepared, MotionEquations(system, kernels), duration)
        system = system.known_rank(rank)
        leave_out(system, left)
        if system.record.control.rank[LEFT_OUT]:
            saddle = system.record.saddle._replace(dense=np.zeros((0, 0)))
            system = replace(system, record=system.record._replace(saddle=saddle))
    chosen = len(system.record.saddle.dense) > 0
    return RowPivots(MotionEquations(system, kernels), y, rank, chosen)


def _unranked(absolute: System) -> System:
    """The system with a record of its own, without what runs in these coordinates have set for their formulation and their rank."""
    record = copied(absolute.record)
    record.saddle.least[:] = 0.0
    record.saddle.shift[:] = 0.0
    record.control.rank[:] = 0
    record.control.iterations[0] = 0
    saddle = record.saddle._replace(dense=np.zeros((0, 0)))
    return replace(absolute, record=record._replace(saddle=saddle)).known_rank(absolute.machine_rows)


def _left_out(prepared: Prepared, motion: MotionEquations, duration: float) -> Collection[int]:
    """Rows that repeat others everywhere: those that the run leaves out; none where that is not known."""
    saddle = prepared.motion.system.record.saddle
    if prepared.motion.system.record.control.rank[LEFT_OUT]:
        return saddle.row[saddle.order[saddle.least < 0.0]].tolist()
    return rows_everywhere(motion, prepared.assembly.y, duration)


# Frames that are evaluated: one for so many evaluations of the run, between these numbers; fewer of machines that then have more pivots.
EVALUATIONS, FEWEST, MOST, PIVOTS = 20, 300, 3000, 3_000_000
LEAST_FRAMES = 3
# Of the middle value: below the first share a minimum is examined closely, and below the second it is a passage. Pivots are the squares.
LOW, PASSED = 0.3, 2e-4
# Where rows are left out that repeat others, all together have lost one too: their smallest singular value is below this.
LOST = 1e-3
# A parabola through three pivots about a zero has its least value at this share of the largest of them or below.
NEAR_ZERO, CLOSER = 0.2, 12
GOLDEN = 0.381966


class Passage(Struct):
    """A position passed at `time` [s] in which rows of `joints` depend on each other; left : of their independence, as a share."""

    time: float
    joints: tuple[str, ...]
    left: float


class Track(Struct):
    """The positions of a run. q : (n, ·) positions of bodies in absolute coordinates, modal coordinates behind them. states : (n, ·)."""

    time: Array
    q: Array
    states: Array
    pivots: RowPivots

    @classmethod
    def of(cls, result: Readable, pivots: RowPivots) -> "Track":
        """Of a result with all bodies."""
        system = pivots.motion.system
        n = len(result.time)
        places = [result.array("position"), _continuous(result.array("orientation"))]
        modes = [result.array("modal_coordinate")] if system.modes else []
        names = [f"state.{fact.name}" for fact in system.states]
        states = (
            [result.array(name)[:, None] for name in names] if all(map(result.variables.__contains__, names)) else []
        )
        q = np.hstack([np.concatenate(places, axis=2).reshape(n, -1), *modes])
        return cls(result.time, q, np.hstack([np.zeros((n, 0)), *states]), pivots)

    @cached_property
    def _y(self) -> Array:
        y = self.pivots.y.copy()
        y[self.q.shape[1] : self.pivots.first_state] = 0.0  # at rest: velocities change no pivot
        return y

    def at(self, place: float, beside: int | None = None) -> tuple[float, Array]:
        """Time and pivots at a frame, or on the parabola through the three next to a place between frames, or about the frame `beside`."""
        k, y = round(place), self._y
        if k == place:
            time, y[: self.q.shape[1]] = self.time[k], self.q[k]
        else:
            k = min(max(k, 1), len(self.time) - 2) if beside is None else beside
            s, near = place - k, slice(k - 1, k + 2)
            weights = np.array([0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)])
            time, y[: self.q.shape[1]] = weights @ self.time[near], weights @ self.q[near]
        y[self.pivots.first_state :][: self.states.shape[1]] = self.states[k]
        return float(time), self.pivots.at(float(time), y)

    def least(self, beside: int, between: tuple[int, int], middle: Array) -> tuple[float, int, float]:
        """Where a pivot is least as a share of its middle value, on the parabola about a frame between two places; which, and that
        share."""
        places = np.linspace(*between, 5)
        found = np.stack([self.at(float(place), beside)[1] for place in places]) / middle
        found = np.nan_to_num(found, nan=np.inf)
        row = int(np.argmin(found.min(axis=0)))
        k = min(max(int(np.argmin(found[:, row])), 1), len(places) - 2)
        near = slice(k - 1, k + 2)
        place, value = _least(
            lambda at: float(self.at(at, beside)[1][row] / middle[row]), places[near], found[near, row]
        )
        return place, row, value


def can_be_singular(run: Run) -> bool:
    """Whether the machine has constraints that may depend on each other: those of joints that carry the bodies of a tree never do."""
    return run.prepared.redundancy.rank > 0 and len(run.prepared.motion.system.record.saddle.row) > 0


def why_not(run: Run) -> str:
    """Why passages of a run cannot be found, in words; empty where they can."""
    if len(run.result.time) < LEAST_FRAMES:
        return f"the result has fewer than {LEAST_FRAMES} frames"
    if len(run.result.coordinates.get("body", ())) != run.prepared.absolute.system.body_count:
        return "the result has not all bodies"
    return ""


def passages(run: Run) -> Iterator[Passage]:
    """The passages of a run, in the order of time."""
    if why_not(run) or not can_be_singular(run):
        return
    pivots = row_pivots(run.prepared, run.plan.methods, run.plan.settings.duration)
    track = Track.of(run.result, pivots)
    frames = np.arange(0, len(track.time), _stride(run, len(pivots.motion.system.record.saddle.row)))
    found = np.stack([track.at(int(k))[1] for k in frames])
    middle = np.median(np.nan_to_num(found, nan=np.inf), axis=0)
    before = -1.0
    for k, row in _minima(found, middle):
        place, least = _least(
            lambda at, row=row: float(track.at(at)[1][row]), frames[k - 1 : k + 2], found[k - 1 : k + 2, row]
        )
        if place == before or not least < PASSED**2 * middle[row]:
            continue
        time, _ = track.at(place)
        if run.prepared.redundancy.redundant_rows and not _has_lost(pivots):
            continue
        before = place
        yield Passage(time, pivots.joints(row), float(np.sqrt(max(least, 0.0) / middle[row])))


def _stride(run: Run, rows: int) -> int:
    """Every so many frames are evaluated."""
    most = max(FEWEST, min(MOST, int(run.finished.timing["evaluations"]) // EVALUATIONS, PIVOTS // rows))
    return -(-len(run.result.time) // most)


def _minima(found: Array, middle: Array) -> Iterator[tuple[int, int]]:
    """Place among the frames and row of the minima of pivots (n, K) that may be zero between frames, of a few at one place the least."""
    left, here, right = found[:-2], found[1:-1], found[2:]
    bent = left + right - 2.0 * here
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = here - (right - left) ** 2 / (8.0 * bent)
        near = (
            (here <= left) & (here < right) & (here < LOW**2 * middle) & (vertex < NEAR_ZERO * np.maximum(left, right))
        )
    for k in np.flatnonzero(near.any(axis=1)):
        share = np.where(near[k], here[k] / middle, np.inf)
        yield int(k) + 1, int(np.argmin(share))


def _least(value: Callable[[float], float], places: NDArray[Any], values: Array) -> tuple[float, float]:
    """The place in the middle of three where a smooth function that is nowhere negative is least, and its value there."""
    (a, b, c), (fa, fb, fc) = map(float, places), map(float, values)
    for _ in range(CLOSER):
        slope, other = (b - a) * (fb - fc), (b - c) * (fb - fa)
        down = slope - other
        at = b - 0.5 * ((b - a) * slope - (b - c) * other) / down if down != 0.0 else b
        if not a < at < c or abs(at - b) < 1e-9 * (c - a):
            at = b + GOLDEN * (c - b if c - b > b - a else a - b)
        f = value(at)
        if f < fb:
            (a, fa), (c, fc) = ((b, fb), (c, fc)) if at > b else ((a, fa), (b, fb))
            b, fb = at, f
        elif at > b:
            c, fc = at, f
        else:
            a, fa = at, f
        if c - a < 1e-6:
            break
    return b, fb


def _has_lost(pivots: RowPivots) -> bool:
    """Whether all rows together have fewer independent ones, in the state last evaluated."""
    return bool(np.linalg.svd(scaled_jacobian(pivots.motion), compute_uv=False)[pivots.rank - 1] < LOST)


def _continuous(theta: Array) -> Array:
    """Euler parameters (n, B, 4) with signs such that each is near the one before."""
    turned = np.sum(theta[1:] * theta[:-1], axis=2) < 0.0
    sign = np.cumprod(np.where(turned, -1.0, 1.0), axis=0)
    out = theta.copy()
    out[1:] *= sign[:, :, None]
    return out
