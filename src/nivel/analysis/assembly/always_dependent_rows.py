"""Rows of a redundant machine that repeat others in every position: they are left out of the factor of S, which stays sparse.

That the rows are the same everywhere is shown at random positions far aside: there, too, the rows that stay are independent, and the others
depend on them. Minors of C_q are analytic in the positions, so what vanishes at one of them in general position vanishes along the motion.
Where this cannot be shown, rows are chosen by pivots in every evaluation.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.redundancy import DEPENDENT, aside, dependent_rows, scaled_jacobian
from nivel.kernels.solve.saddle import LEFT_OUT
from nivel.system.system import Array, System

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
