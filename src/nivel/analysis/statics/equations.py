"""The equations of static equilibrium of one machine: r(q, 0, 0, λ, t) = 0 and C(q, t) = 0, with exact derivatives, as sparse matrices.

They are the residual of implicit methods (`nivel.kernels.residual.residual`) with all velocities and accelerations zero: the speed of a
driver, which stands in Ċ alone, never enters. Positions move by tangent increments: rotations of bodies after the present one, in their
own axes.

So that units do not matter, every number is made one without: translations in lengths of the machine, forces and moments along unknowns as
energies over a scale of energy e, constraints over their own scales.
"""

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.sparse import bmat, csc_matrix

from nivel.analysis.assembly.equations import MotionEquations, Unknowns
from nivel.elements.circuits.volumes import VOLUME
from nivel.kernels.core.status import OK
from nivel.kernels.output import static_entries
from nivel.kernels.residual import tangent_entries
from nivel.lazy import Struct, replace
from nivel.system.layout import reported
from nivel.system.system import Array

Index = NDArray[np.int64]


class Block:
    """Rows and columns of a matrix whose entries stand in an array, in the order of `row` and `column`.

    rows, columns : numbers that are taken, in this order. scales : factors of all rows and columns of the whole matrix.
    """

    def __init__(self, row: Index, column: Index, rows: Index, columns: Index, scales: tuple[Array, Array]) -> None:
        self.shape = (len(rows), len(columns))
        new_row, new_column = (
            _renumbered(each, len(scale)) for each, scale in zip((rows, columns), scales, strict=True)
        )
        taken = np.flatnonzero((new_row[row] >= 0) & (new_column[column] >= 0))
        r, c = new_row[row[taken]], new_column[column[taken]]
        order = np.lexsort((r, c))
        self._taken, self._row = taken[order], r[order].astype(np.int32)
        self._start = np.searchsorted(c[order], np.arange(len(columns) + 1)).astype(np.int32)
        self._factor = scales[0][row[self._taken]] * scales[1][column[self._taken]]

    def of(self, value: Array, factor: float = 1.0) -> Any:
        """The block for entries `value`, times a factor."""
        return csc_matrix((value[self._taken] * self._factor * factor, self._row, self._start), shape=self.shape)


def _renumbered(chosen: Index, size: int) -> Index:
    """Place of each number among those chosen, or -1."""
    out = np.full(size, -1, dtype=np.int64)
    out[chosen] = np.arange(len(chosen))
    return out


Sparse = Any  # a matrix of scipy.sparse, whose stubs do not know its operators


# Units in the last place by which a place is wrong.
ROUNDINGS = 4.0


class StateError(Exception):
    """Something in a state is not a number, or its equations cannot be evaluated there."""


class Rest(Struct):
    """A machine at rest, in equilibrium or not: state y with zero velocities, multipliers λ (K,), time t [s] of all functions of time."""

    y: Array
    lam: Array
    t: float


class Change(Struct):
    """A change of a state without units: of the free unknowns (f,), of the multipliers (K,), and of time over the scale of time."""

    q: Array
    lam: Array
    t: float = 0.0

    def __mul__(self, share: float) -> "Change":
        return Change(share * self.q, share * self.lam, share * self.t)

    def __add__(self, other: "Change") -> "Change":
        return Change(self.q + other.q, self.lam + other.lam, self.t + other.t)


class Tangent(Struct):
    """Matrices at a state, without units: K (f, f) stiffness, C (K, f) constraints; M, D (f, f) of their own units, made when asked for.

    slope, opening : derivatives of r (f,) and C (K,) with respect to time over its scale.
    tie : (f, f) stiffness besides, in linear equations alone, of what holds a machine that is free as a whole in its place; or None.
    """

    K: Sparse
    C: Sparse
    slope: Array
    opening: Array
    inertia: Callable[[], Sparse]
    damping: Callable[[], Sparse]
    tie: Sparse | None = None

    @cached_property
    def M(self) -> Sparse:
        """(f, f) mass."""
        return self.inertia()

    @cached_property
    def D(self) -> Sparse:
        """(f, f) damping."""
        return self.damping()

    @cached_property
    def free_directions(self) -> Array:
        """Columns (f, ·): an orthonormal basis of the motions that all constraints allow."""
        return null_space(self.C.toarray()) if self.C.shape[0] else np.eye(self.K.shape[0])

    def saddle(self, shift: float = 0.0) -> Sparse:
        """[K + shift, Cᵀ; C, 0], K with the tie."""
        K, C = (self.K if self.tie is None else self.K + self.tie).tocoo(), self.C.tocoo()
        free = K.shape[0]
        size, every = free + C.shape[0], np.arange(free if shift else 0)
        value = np.concatenate([K.data, C.data, C.data, np.full(len(every), shift)])
        row = np.concatenate([K.row, C.row + free, C.col, every])
        column = np.concatenate([K.col, C.col, C.row + free, every])
        return csc_matrix((value, (row, column)), shape=(size, size))

    def full_saddle(self, shift: float = 0.0) -> Array:
        """The same as a full matrix (f + K, f + K)."""
        free, rows = self.K.shape[0], self.C.shape[0]
        out = np.zeros((free + rows, free + rows))
        out[:free, :free] = self.K.toarray() if self.tie is None else (self.K + self.tie).toarray()
        out[free:, :free] = self.C.toarray()
        out[:free, free:] = out[free:, :free].T
        out[np.arange(free), np.arange(free)] += shift
        return out

    def rigid(self) -> "Tangent":
        """The same constraints without any stiffness."""
        return replace(self, K=0.0 * self.K, tie=None)


class StaticEquations(Unknowns):
    """The equations of static equilibrium of `motion`, which has the residual of implicit methods; duration : scale of time [s].

    held : forces (f,) without units that hold the machine besides all others, on the way to its first equilibrium; else zero.
    """

    def __init__(self, motion: MotionEquations, duration: float) -> None:
        super().__init__(motion)
        self.duration = duration
        self.residual, self.newton = self.record.residual, self.record.newton
        self.state_scale = np.array([fact.scale for fact in self.system.states])
        # whether rates of states are equations beside those of the forces, see `nivel.analysis.statics.states`
        self.states_move = False
        self.record.sampled.at_rest[:] = 1
        self.row_scale = self.record.constraints.scale[self.residual.row]
        self.energy = 1.0
        self.held: Array | float = 0.0

    # --- evaluation ---

    def evaluate(self, state: Rest, lam: Array | None = None) -> tuple[Array, Array]:
        """(r (f,), C (K,)) without units, for the multipliers of the state or others. The record is left evaluated."""
        self._load(state, state.lam if lam is None else lam)
        if tangent_entries.evaluate_residual(self.motion.handle.address, state.t) != OK:
            raise StateError
        value = self.residual.value
        first = self.n + self.state_count
        r, C = value[: self.n], value[first : first + self.rows]
        if not (np.isfinite(r).all() and np.isfinite(C).all()):
            raise StateError
        return (r * self.length)[self.free] / self.energy - self.held, C / self.row_scale

    def _load(self, state: Rest, lam: Array) -> None:
        own = self.residual
        own.y[:] = state.y
        own.y[self.positions : self.positions + self.n] = 0.0
        own.vdot[:] = 0.0
        own.lam[:] = lam
        tree = self.record.tree  # what frames show of relative coordinates follows from these
        if len(tree.node):
            tree.state[: self.positions] = state.y[: self.positions]

    def tangent(self, state: Rest) -> Tangent:
        """Exact derivatives at a state; those by hand of beams are of the state last evaluated."""
        self.evaluate(state)
        address = self.motion.handle.address
        if static_entries.find_parts(address, state.t) != OK:
            raise StateError
        slope = np.zeros(len(self.residual.value))
        if static_entries.find_time_slope(address, state.t, slope) != OK or not np.isfinite(slope).all():
            raise StateError
        K, D, M = (
            self._numbers(part) for part in (self.newton.shifted.K, self.newton.shifted.D, self.newton.shifted.M)
        )
        slope, n, share = slope * self.duration, self.n, 1.0 / self.energy
        inner, rows = self._blocks
        return Tangent(
            K=inner.of(K, share),
            C=rows.of(M),
            slope=(slope[:n] * self.length)[self.free] / self.energy,
            opening=slope[n + self.state_count :][: self.rows] / self.row_scale,
            inertia=lambda: inner.of(M, share),
            damping=lambda: inner.of(D, share),
        )

    @cached_property
    def _places(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Rows and columns of the entries of a derivative; unknowns are velocities, states, multipliers."""
        start = self.newton.row_start.astype(np.int64)
        size = self.n + self.state_count + self.rows
        return np.repeat(np.arange(size), np.diff(start)), self.newton.column.astype(np.int64)

    def rates(self) -> Array:
        """(S,) rates of the states, in the state last evaluated, in units."""
        return self.residual.value[self.n : self.n + self.state_count].copy()

    def whole_parts(self, state: Rest) -> tuple[Sparse, Sparse, Sparse]:
        """Derivatives of (r, -ẋ, C) in units with respect to positions, to velocities and states, to accelerations and multipliers: each
        (n + S + K, n + S + K)."""
        self.evaluate(state)
        if static_entries.find_parts(self.motion.handle.address, state.t) != OK:
            raise StateError
        row, column = self._places
        size = self.n + self.state_count + self.rows
        shifted = self.newton.shifted
        K, D, M = (
            csc_matrix((self._numbers(part), (row, column)), shape=(size, size))
            for part in (shifted.K, shifted.D, shifted.M)
        )
        return K, D, M

    def at_rest(self, K: Sparse, D: Sparse, M: Sparse) -> Sparse:
        """[K, D_x, C_qᵀ; -∂ẋ/∂q, -∂ẋ/∂x, 0; C_q, 0, 0] in units, of `whole_parts`."""
        first = self.n + self.state_count
        inner = bmat([[K[:first, : self.n], D[:first, self.n : first], M[:first, first:]]])
        below = csc_matrix((self.rows, self.state_count + self.rows))
        return csc_matrix(bmat([[inner], [bmat([[M[first:, : self.n], below]])]]))

    @cached_property
    def follows(self) -> NDArray[np.bool_]:
        """(S,) whether a state follows the way to where the machine is: the mass of fluid in a volume, the stretch of a tyre."""
        out = np.array([fact.follows for fact in self.system.states], dtype=bool)
        out[[node.state for node in self.system.nodes if node.kind == VOLUME]] = True
        return out

    @cached_property
    def _blocks(self) -> tuple[Block, Block]:
        """Forces over free unknowns, and constraints over free unknowns."""
        row, column = self._places
        none = np.zeros(self.state_count)
        by_row = np.concatenate([self.length, none, 1.0 / self.row_scale])
        by_column = np.concatenate([self.length, none, np.ones(self.rows)])
        constraints = self.n + self.state_count + np.arange(self.rows)
        inner = Block(row, column, self.free, self.free, (by_row, by_column))
        return inner, Block(row, column, constraints, self.free, (by_row, by_column))

    @staticmethod
    def _numbers(value: Array) -> Array:
        """A copy of the entries of a derivative."""
        if not np.isfinite(value).all():
            raise StateError
        return value.copy()

    def weigh(self, state: Rest) -> None:
        """Choose the scale of energy e: the largest stiffness at a state, or where there is none the largest force."""
        self.energy = 1.0
        stiffness = np.abs(self.tangent(state).K).max() if len(self.free) else 0.0
        force = np.abs(self.evaluate(state)[0]).max(initial=0.0)
        self.energy = float(stiffness or force or 1.0)

    # --- movement ---

    def moved(self, state: Rest, change: Change) -> Rest:
        """The state after a change: q ∘ exp, λ and t added."""
        psi = np.zeros(self.n)
        psi[self.free] = change.q * self.length[self.free]
        lam = state.lam + self.force_of(change.lam)
        return Rest(self.displaced(state.y, psi), lam, state.t + change.t * self.duration)

    def force_of(self, lam: Array) -> Array:
        """Multipliers [N, N m] from those without units."""
        return lam * self.energy / self.row_scale

    def follow(self, state: Rest) -> None:
        """Count the turns of angles, and keep what forces remember, at an accepted state."""
        self.evaluate(state)
        static_entries.accept_state(self.motion.handle.address, state.t)

    def loads(self, state: Rest) -> float:
        """Largest single load [N m]: weights and reactions along an unknown times the machine's length, and what springs and forces push.

        Forces that cancel each other still count: a residual is held against them.
        """
        bodies = self.record.bodies
        weight = float(np.max(bodies.mass, initial=0.0) * np.linalg.norm(bodies.gravity)) * self.system.size
        applied, _ = self.evaluate(state, np.zeros(self.rows))
        by_joints, _ = self.evaluate(state)
        pushed = self._pushed()
        reacting = float(np.max(np.abs(by_joints - applied), initial=0.0)) * self.energy
        return max(weight, reacting, pushed, float(np.max(np.abs(applied), initial=0.0)) * self.energy)

    def round_off(self, tangent: Tangent, state: Rest) -> float:
        """What round-off of the positions makes of the forces of the stiffest parts [N m]."""
        return float(np.max(self.rounded(tangent, state), initial=0.0)) * self.energy

    def rounded(self, tangent: Tangent, state: Rest) -> Array:
        """The same of every unknown (f,), without units: stiffness times the last places of positions."""
        position = state.y[self.place[self.free, 0]] / self.length[self.free]
        known = ROUNDINGS * np.finfo(float).eps * np.maximum(np.abs(position), 1.0)
        return abs(tangent.K) @ known

    def _pushed(self) -> float:
        """Largest effort that a force reports [N m]: forces times the machine's length."""
        outputs = self.record.outputs.value
        scale = {"N": self.system.size, "N m": 1.0}
        found = [
            abs(float(outputs[k])) * scale.get(each.units, 0.0)
            for k, each in enumerate(reported(self.system.layout, len(outputs)))
            if each.name.startswith("force.")
        ]
        return max(found, default=0.0)

    def start(self, y: Array) -> Rest:
        """The state y at rest at t = 0, with the multipliers that leave the least residual."""
        y = y.copy()
        y[self.positions : self.first_state] = 0.0
        state = Rest(y, np.zeros(self.rows), 0.0)
        self.weigh(state)
        return state


def with_multipliers(state: Rest, lam: Array) -> Rest:
    """The same state with other multipliers [N, N m]."""
    return replace(state, lam=lam)
