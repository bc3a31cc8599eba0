"""A machine at one instant: its equations of motion, and their exact derivatives in any direction.

    r = M v̇ + C_qᵀ λ - Q        ẋ = g        C        Ċ = C_q v + C_t        C̈ = C_q v̇ - γ

Derivatives are those of the compiled residual of implicit methods on dual numbers, so they are exact to round-off.
Positions move by tangent increments: a body turns after its present rotation, about its own axes.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lstsq
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.equations import MotionEquations, Unknowns
from nivel.errors import SolveError
from nivel.kernels.core.arrays import lanes_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import FAMILIES, SHOWN, Family
from nivel.kernels.record.record import MEASURE, RESIDUAL
from nivel.lazy import Struct
from nivel.machine.core import vectors
from nivel.native.duals import DUAL, LANES
from nivel.system.system import Array

Lanes = NDArray[np.float64]
NOTHING: Lanes = np.zeros(1 + LANES)


def product(subscripts: str, a: Lanes, b: Lanes) -> Lanes:
    """Sums of products of dual numbers, with subscripts as `np.einsum` has them."""
    factors, result = subscripts.split("->")
    first, second = factors.split(",")
    out: Lanes = np.einsum(f"{first}z,{second}->{result}z", a, b[..., 0])
    out[..., 1:] += np.einsum(f"{first},{second}z->{result}z", a[..., 0], b[..., 1:])
    return out


def cross(a: Lanes, b: Lanes) -> Lanes:
    """a × b of vectors (…, 3, 1 + LANES)."""
    a, b = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    out = vectors.cross(a, b[:1])
    out[1:] += vectors.cross(a[:1], b[1:])
    return np.moveaxis(out, 0, -1)


# share of accelerations below which they are round-off
ROUND_OFF = 1e-12
Reader = Callable[["Instant"], Lanes]


class Slopes(Struct):
    """Derivatives in several directions, one a column.

    r (n, k), g (S, k), C, Cdot, Cddot (K, k) : of the equations. seen (m, k) : of what a reader reads.
    """

    r: Array
    g: Array
    C: Array
    Cdot: Array
    Cddot: Array
    seen: Array


class Instant(Unknowns):
    """The equations of `motion`, which has a residual and its twin, at time t [s] in the state y.

    velocity_rows : rows that hold velocities alone. v̇ (n,) and λ (K,) are those of the motion.
    """

    def __init__(self, motion: MotionEquations, t: float, y: Array) -> None:
        if motion.twin is None:
            raise TypeError("the equations have no twin on dual numbers")
        super().__init__(motion)
        self.t, self.y = t, y.copy()
        self.velocity_rows = np.flatnonzero(np.isin(self.record.residual.row, list(self.system.velocity_rows)))
        self.twin: Any = lanes_of(motion.twin.record)
        self._residual = FAMILIES[int(self.record.hooks.address[RESIDUAL])].twin
        measure = int(self.record.hooks.address[MEASURE])
        self._measure = FAMILIES[measure].twin if measure else None
        self._count_turns()
        self.vdot, self.lam = self._motion()

    def move_to(self, t: float, y: Array, vdot: Array) -> None:
        """Be at another time and state, with these accelerations (n,) and no multipliers."""
        self.t, self.y, self.vdot, self.lam = t, y.copy(), vdot.copy(), np.zeros(self.rows)
        self._count_turns()

    def _count_turns(self) -> None:
        """Tell the tree which turn its angles are in."""
        if len(self.record.tree.node):
            self.record.tree.state[: self.positions] = self.y[: self.positions]

    def _motion(self) -> tuple[Array, Array]:
        """(v̇, λ) of the equations of motion, by [M C_qᵀ; C_q 0]; of redundant rows only independent ones are here."""
        self.vdot, self.lam = np.zeros(self.n), np.zeros(self.rows)
        value = self.value()
        by_rate, by_force = self.along("vdot"), self.along("lam")
        f, K = len(self.free), self.rows
        saddle = np.zeros((f + K, f + K))
        saddle[:f, :f], saddle[f:, :f] = by_rate.r[self.free], by_rate.Cddot
        saddle[:f, f:] = by_force.r[self.free]
        scale = np.concatenate([self.length[self.free], 1.0 / self.row_scale])
        right = -np.concatenate([value[: self.n][self.free], value[self.n + self.state_count + 2 * K :]])
        found: Any = lstsq(scale[:, None] * saddle * scale, scale * right, cond=1e-14)
        x = scale * found[0]
        vdot = np.zeros(self.n)
        # accelerations that are round-off of those that the forces would make alone are none
        length = self.length[self.free]
        alone: Any = lstsq(length[:, None] * by_rate.r[self.free] * length, length * value[: self.n][self.free])
        least = ROUND_OFF * float(np.max(np.abs(alone[0]), initial=0.0))
        vdot[self.free] = np.where(np.abs(x[:f]) > least * length, x[:f], 0.0)
        return vdot, x[f:]

    @property
    def row_scale(self) -> Array:
        """(K,) what violations of the rows are measured by."""
        return self.record.constraints.scale[self.record.residual.row]

    @property
    def M(self) -> Array:
        """(f, f) mass matrix of the free unknowns, without the constraints."""
        return self.along("vdot").r[self.free]

    @property
    def J(self) -> Array:
        """(K, f) constraint rows over the free unknowns."""
        return self.along("vdot").Cddot

    # --- evaluation ---

    def value(self) -> Array:
        """r (n), g (S), C, Ċ, C̈ (K each) one behind the other, for the present v̇ and λ."""
        self._load()
        self._call()
        return self.twin.residual.value[:, 0].copy()

    def read(self, reader: Reader) -> Array:
        """What a reader reads at the state itself."""
        self.value()
        return reader(self)[:, 0].copy()

    def along(self, what: str, reader: Reader | None = None) -> Slopes:
        """Derivatives with respect to `what`: q, v, vdot (columns: free unknowns), x (states), lam (multipliers) or t."""
        counts = {"q": len(self.free), "v": len(self.free), "vdot": len(self.free)}
        count = counts.get(what, {"x": self.state_count, "lam": self.rows, "t": 1}.get(what, 0))
        values: list[Array] = []
        seen: list[Array] = []
        for first in range(0, count, LANES):
            columns = min(count - first, LANES)
            self._load()
            if what != "t":
                for lane in range(columns):
                    self._move(what, first + lane, 1 + lane)
            self._call(1.0 if what == "t" else 0.0)
            values += [*self.twin.residual.value[:, 1 : 1 + columns].T.copy()]
            if reader is not None:
                seen += [*reader(self)[:, 1 : 1 + columns].T]
        if reader is not None and not count:
            return self._slopes(values, np.zeros((len(self.read(reader)), 0)))
        return self._slopes(values, np.array(seen).T if seen else np.zeros((0, count)))

    def _slopes(self, values: list[Array], seen: Array) -> Slopes:
        whole = np.array(values).T if values else np.zeros((len(self.record.residual.value), 0))
        n, S, K = self.n, self.state_count, self.rows
        starts = np.cumsum([0, n, S, K, K, K])
        parts = [whole[a:b] for a, b in pairwise(starts)]
        return Slopes(*parts, seen=seen)

    def _load(self) -> None:
        own = self.twin.residual
        for lanes, values in ((own.y, self.y), (own.vdot, self.vdot), (own.lam, self.lam)):
            lanes[:] = 0.0
            lanes[:, 0] = values

    def _move(self, what: str, k: int, lane: int) -> None:
        own = self.twin.residual
        if what == "x":
            own.y[self.first_state + k, lane] = 1.0
        elif what == "lam":
            own.lam[k, lane] = 1.0
        elif what == "v":
            own.y[self.positions + self.free[k], lane] = 1.0
        elif what == "vdot":
            own.vdot[self.free[k], lane] = 1.0
        else:
            psi = np.zeros(self.n)
            psi[self.free[k]] = 1.0
            own.y[: self.positions, lane] = self.position_rates(self.y, psi)

    def beside(self, direction: tuple[Array, Array, Array], size: float) -> tuple[Array, Array]:
        """(r, g one behind the other, their derivative along the direction) at a state that is moved by `size` times a direction, which has
        tangent increments (n,), velocities (n,) and states (S,). v̇ and λ stay what they are."""
        psi, v, x = direction
        change = np.concatenate([self.position_rates(self.y, psi), v, x])
        self._load()
        self.twin.residual.y[: len(change), 0] += size * change
        self.twin.residual.y[: len(change), 1] = change
        self._call()
        found = self.twin.residual.value[: self.n + self.state_count]
        return found[:, 0].copy(), found[:, 1].copy()

    def _time(self, slope: float = 0.0) -> NDArray[Any]:
        """The time as a dual number, with this slope along the first direction."""
        out = np.zeros(1, DUAL)
        out["value"], out["slopes"][0, 0] = self.t, slope
        return out

    def _call(self, slope_of_time: float = 0.0) -> None:
        motion = self.motion
        assert motion.twin is not None
        if self._residual(motion.twin.address, 0, self._time(slope_of_time)) != OK:
            raise SolveError(
                f"the equations of motion cannot be evaluated at t = {self.t:g} s",
                time=self.t,
                advice="Look at the laws of forces and drivers there.",
            )

    # --- what readers read: the twin's record as evaluated last, with lanes ---

    def place_markers(self) -> None:
        """All markers of the twin, from its bodies; and the accelerations of bodies."""
        bodies, markers, residual = self.twin.bodies, self.twin.markers, self.twin.residual
        b = markers.body.astype(np.int64)
        markers.u[:] = np.einsum("mijz,mj->miz", bodies.A[b], markers.position_b)
        markers.r[:] = bodies.R[b] + markers.u
        markers.A[:] = np.einsum("mijz,mjk->mikz", bodies.A[b], markers.frame_b)
        turning = cross(bodies.omega[b], markers.u)
        markers.rdot[:] = bodies.Rdot[b] + turning
        markers.bias[:] = cross(bodies.omega[b], turning)
        count = self.system.body_count
        alpha = residual.acceleration[:count, :3]
        bodies.Rddot[:count] = residual.acceleration[:count, 3:]
        bodies.alpha_b[:count] = product("bij,bi->bj", bodies.A[:count], alpha)

    def measure_coordinates(self) -> None:
        """Value and rate of all coordinates of the twin, from its markers."""
        if self._measure is not None:
            assert self.motion.twin is not None
            self._measure(self.motion.twin.address, SHOWN, self._time())

    def sense(self, sensors: Family) -> None:
        """Values of all sensors of the twin, from its markers and coordinates."""
        assert self.motion.twin is not None
        sensors.twin(self.motion.twin.address, 0, self._time())


def _offset(own: Instant, b: int) -> Lanes:
    """(3, ·) [m] from the frame of the body in the equations."""
    A, tree = own.twin.bodies.A[b], own.twin.tree
    return np.einsum("ijz,j->iz", A, tree.own[b] if len(tree.node) else np.zeros(3))


def frame_place(own: Instant, b: int) -> Lanes:
    """(3, ·) [m] place of the frame of a body as its user placed it."""
    return own.twin.bodies.R[b] + _offset(own, b)


def frame_velocity(own: Instant, b: int) -> Lanes:
    """(3, ·) [m/s] its velocity."""
    bodies = own.twin.bodies
    return bodies.Rdot[b] + cross(bodies.omega[b], _offset(own, b))


def frame_axes(own: Instant, b: int) -> Lanes:
    """(3, 3, ·) its axes, as columns."""
    bodies, tree = own.twin.bodies, own.twin.tree
    if not len(tree.node):
        return bodies.A[b]
    axes = Rotation.from_quat(tree.own_theta[b], scalar_first=True).as_matrix()
    return np.einsum("ijz,jk->ikz", bodies.A[b], axes)


def point_velocity(own: Instant, b: int, position: NDArray[np.float64]) -> Lanes:
    """(6, ·) [m/s, rad/s] velocity of a point of the body, given in its frame [m], and angular velocity."""
    omega = own.twin.bodies.omega[b]
    arm = np.einsum("ijz,j->iz", frame_axes(own, b), position)
    return np.concatenate([frame_velocity(own, b) + cross(omega, arm), omega])


def point_acceleration(own: Instant, b: int, position: NDArray[np.float64]) -> Lanes:
    """(6, ·) [m/s², rad/s²] acceleration of a point of the body and angular acceleration; the accelerations of bodies are known."""
    bodies = own.twin.bodies
    alpha, omega = product("ij,j->i", bodies.A[b], bodies.alpha_b[b]), bodies.omega[b]
    d = _offset(own, b) + np.einsum("ijz,j->iz", frame_axes(own, b), position)
    return np.concatenate([bodies.Rddot[b] + cross(alpha, d) + cross(omega, cross(omega, d)), alpha])
