"""Pivots of the constraint rows of a machine: what of each row does not depend on the rows eliminated before it, as a share of its square.

S = C_q M⁻¹ C_qᵀ is factorised as in a run in absolute coordinates, and costs what one of its evaluations does. Where a row becomes a
combination of others its pivot falls to zero, with the square of the time. Rows that repeat others everywhere are left out of the factor;
where it is not known which these are, rows are chosen by pivots, and the last of these stands for all.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.assembly.always_dependent_rows import leave_out, rows_everywhere
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation.preparation import Prepared
from nivel.kernels.core.arrays import copied
from nivel.kernels.core.status import SINGULAR
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.motion.catalogue import FLOATING
from nivel.system.system import Array, System

# Rows with this share of the largest part in what is lost name their joints.
PART = 0.3


@dataclass(frozen=True)
class RowPivots:
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
        from scipy.linalg import solve_triangular  # takes a tenth of a second to import

        x[saddle.pivot[:n]] = solve_triangular(saddle.dense[:n, :n], last, lower=True, trans=1)
        return x


def row_pivots(prepared: Prepared, methods: Methods, duration: float) -> RowPivots:
    """Of a machine that moves for `duration` [s]."""
    absolute, rank = prepared.absolute, prepared.redundancy.rank
    system, y, kernels = _unranked(absolute.system), prepared.assembly.y.copy(), absolute.kernels
    if methods.machine.is_flexible:
        arrangement: Any = import_module(FLOATING.arrangement)
        system, y = arrangement.arrange(methods.machine, system, y, rank, methods.cut)
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
