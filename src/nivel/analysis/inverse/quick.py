"""Equations of a machine at one state after another, by few calls of compiled code: for programs that ask thousands of times.

Buffers and addresses are prepared once. Values come from the residual of implicit methods, M and C_q from its twin on dual numbers.
Machines with loops are those whose independent rows are chosen at the start; a state at which these do not suffice is left to others.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from nivel.analysis.assembly.instant import Instant
from nivel.analysis.run.prepared_state import BoundEntry
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import FAMILIES
from nivel.kernels.record.record import RESIDUAL
from nivel.native.duals import DUAL, LANES
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

Index = NDArray[np.intp]

# loops are closed to this share of the scales of their rows
CLOSED: Final = 1e-13
NO_ROWS: Final = np.zeros((0, 0))


class UnsuitedError(Exception):
    """A state that these equations cannot be solved at: an open loop, or one at a singular position."""


class Quick:
    """The equations of an instant. selected : independent ones of its free velocities; kept : independent rows.

    M, J, h and so on are those of the machine's own velocities; Z (f, m) leads to them from the independent ones.
    """

    def __init__(self, instant: Instant, selected: Index, kept: Index) -> None:
        self._instant, record = instant, instant.record
        self._n, self._S, self._K, self._P = instant.n, instant.state_count, instant.rows, instant.positions
        self._free, self._selected, self._kept = instant.free, selected, kept
        self._dependent = np.setdiff1d(np.arange(len(instant.free)), selected)
        self._row_scale = instant.row_scale
        self._whole = len(self._free) == self._n
        family = FAMILIES[int(record.hooks.address[RESIDUAL])]
        motion = instant.motion
        assert motion.twin is not None
        self._own, self._twin = record.residual, instant.twin.residual
        self._state, self._has_tree = record.tree.state, bool(len(record.tree.node))
        self._time = np.zeros(1, DUAL)
        self._of_values = BoundEntry(family.code, (int(motion.handle.address), 0), keep=motion)
        self._of_slopes = BoundEntry(family.twin, (int(motion.twin.address), 0, self._time), keep=motion)
        self._eye, self._eye_of_rows = np.eye(len(selected)), np.eye(len(kept))
        # of all velocities at once, which is quicker than one by one
        self._moving: slice | Index = slice(0, self._n) if self._whole else self._free
        self._arms: dict[tuple[int, bytes], Array] = {}
        self._cross = np.zeros((3, 3))
        self._chunks = [*_chunks(self._free, self._n)]

    @property
    def has_loops(self) -> bool:
        return self._K > 0

    def be_at(self, y: Array) -> None:
        """Be at a state y, without accelerations and multipliers."""
        own = self._own
        own.y[:] = y
        own.vdot.fill(0.0)
        if self._K:
            own.lam.fill(0.0)
        if self._has_tree:
            self._state[: self._P] = y[: self._P]

    def value(self) -> Array:
        """r (n), g (S), C, Ċ, C̈ (K each): valid until the next call."""
        if self._of_values() != OK:
            raise UnsuitedError
        return self._own.value

    def slopes(self) -> tuple[Array, Array]:
        """M (f, f) and C_q (K, f) of the free velocities at the state."""
        twin, n = self._twin, self._n
        M, J = np.empty((n, len(self._free))), np.empty((self._K, len(self._free)))
        self._load()
        for columns, lanes, seeds in self._chunks:
            twin.vdot[:] = seeds
            if self._of_slopes() != OK:
                raise UnsuitedError
            M[:, columns] = twin.value[:n, lanes]
            if self._K:
                J[:, columns] = twin.value[n + self._S + 2 * self._K :, lanes]
        return M if self._whole else M[self._free], J

    def _load(self) -> None:
        """The state on dual numbers, without accelerations."""
        twin = self._twin
        twin.y.fill(0.0)
        twin.y[:, 0] = self._own.y
        twin.vdot.fill(0.0)
        if self._K:
            twin.lam.fill(0.0)

    def is_closed(self) -> bool:
        """Whether all loops are closed at the state."""
        first = self._n + self._S
        return bool((np.abs(self.value()[first : first + self._K]) <= CLOSED * self._row_scale).all())

    def motions_here(self) -> tuple[Array, Array]:
        """`motions` at the state."""
        return self.motions(self.slopes()[1] if self._K else NO_ROWS)

    def motions(self, J: Array) -> tuple[Array, Array]:
        """Z (f, m) of the motions that the rows leave, and the inverse (d, K) of the rows over the dependent velocities."""
        if not self._K:
            return self._eye, NO_ROWS
        Z, rows = np.zeros((len(self._free), len(self._selected))), J[self._kept]
        Z[self._selected] = self._eye
        _, _, inverse, failed = lapack.dgesv(rows[:, self._dependent], self._eye_of_rows)  # type: ignore[attr-defined]
        if failed:
            raise UnsuitedError
        Z[self._dependent] = -inverse @ rows[:, self._selected]
        if not np.isfinite(Z).all():
            raise UnsuitedError
        return Z, inverse

    def move(self, Z: Array, inverse: Array, v: Array | None, a: Array | None) -> None:
        """Give the machine independent velocities v and accelerations a (none: 0) that fit its loops."""
        own, free = self._own, self._free
        velocities, first = own.y[self._P :], self._n + self._S + self._K
        if not self._K:
            if v is not None:
                velocities[self._moving] = v
            if a is not None:
                own.vdot[self._moving] = a
            return
        dependent = free[self._dependent]
        velocities[dependent] = -inverse @ self.value()[first : first + self._K][self._kept]
        if v is not None:
            velocities[self._moving] += Z @ v
        own.vdot[dependent] = -inverse @ self.value()[first + self._K :][self._kept]
        if a is not None:
            own.vdot[self._moving] += Z @ a

    def efforts(self, Z: Array) -> Array:
        """(m,) Zᵀ r at the velocities and accelerations that it has."""
        r = self.value()[: self._n][self._moving]
        return Z.T @ r if self._K else r.copy()

    def jacobian(self, Z: Array, b: int, position: Array) -> Array:
        """(6, m) velocity of a point of body b, given in its frame, and angular velocity."""
        twin, bodies, cross = self._twin, self._instant.twin.bodies, self._cross
        arm = self._arm(b, position)
        out, first = np.empty((6, len(self._free))), self._P + self._n
        self._load()
        for columns, lanes, seeds in self._chunks:
            twin.y[self._P : first, 1:] = seeds[:, 1:]
            if self._of_slopes() != OK:
                raise UnsuitedError
            x, y, z = (bodies.A[b, :, :, 0] @ arm).tolist()
            cross[0, 1], cross[0, 2], cross[1, 2] = -z, y, -x
            cross[1, 0], cross[2, 0], cross[2, 1] = z, -y, x
            omega = bodies.omega[b, :, lanes]
            out[:3, columns] = bodies.Rdot[b, :, lanes] - cross @ omega
            out[3:, columns] = omega
        return out @ Z if self._K else out

    def _arm(self, b: int, position: Array) -> Array:
        """(3,) the point of body b in the axes in which the tree has the body."""
        if not self._has_tree:
            return position
        key = b, position.tobytes()
        if key not in self._arms:
            tree = self._instant.record.tree
            self._arms[key] = tree.own[b] + rotation_matrices(tree.own_theta[b : b + 1])[0] @ position
        return self._arms[key]


def _chunks(free: Index, n: int) -> Iterator[tuple[slice, slice, Array]]:
    """Columns of free unknowns that are evaluated at once, the lanes in which they are, and unit directions (n, 1 + LANES)."""
    for first in range(0, len(free), LANES):
        places = free[first : first + LANES]
        seeds = np.zeros((n, 1 + LANES))
        seeds[places, 1 + np.arange(len(places))] = 1.0
        yield slice(first, first + len(places)), slice(1, 1 + len(places)), seeds
