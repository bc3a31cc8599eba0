"""Linear equations of motion in independent coordinates.

With small changes δq of positions, δv of velocities, δx of first-order states and inputs u,

    δq̇ = δv + E δq        C_h δq = 0        C_q δv + W δq = 0
    [M C_qᵀ; C_q 0] [δv̇; δλ] = [F u - D δv - K δq - r_x δx;  G u - G_v δv - G_q δq]

E is -ω̃̄ on the turns of bodies, W = ∂Ċ/∂q, G_v and G_q the derivatives of C̈; C_h are the rows of C_q that hold positions: all but those of
wheels that do not slip. States are s = S_q δq, w = S_v δv and δx, where S select independent coordinates; then δq = Z_q s,
δv = Y s + Z w with constant S, so that no derivative of Z enters (Peterson, Gede, Hubbard 2015). Without wheels S_q = S_v, Z_q = Z.
The matrix K holds ∂(C_qᵀ λ)/∂q, the stiffness of the reactions.
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lstsq, qr

from nivel.analysis.assembly.instant import Instant, Reader, Slopes
from nivel.analysis.linearise.axes import TurnedAxes
from nivel.elements.control.dynamics import LinearSystem
from nivel.lazy import Struct, replace
from nivel.system.system import Array, System

# singular values of the constraints below this share of the largest are zero
RANK = 1e-9
# of the sum of the magnitudes of its terms, what is known of a number
ROUND_OFF = 1e-14


Index = NDArray[np.intp]


class Ports(Struct):
    """Inputs of a machine: force (n, p) generalised forces of each, held (K, p) what it adds to C̈, opened : rows that inputs prescribe."""

    force: Array
    held: Array
    opened: NDArray[np.intp]


class Held(Struct):
    """motions (f, h) : Z of the motions that all rows leave. by_row (f, K) : what a unit of each row asks for beside them.
    prescribed (f, k) : of rows that inputs prescribe."""

    motions: Array
    by_row: Array
    prescribed: Array


class Reduction:
    """The linear equations of a machine at an instant; reader : of its outputs. chosen : places of the independent coordinates and of the
    independent velocities; None: chosen here. axes : in which the changes of spinning bodies are resolved; all unknowns here, rows of r
    with them, are those in these axes."""

    def __init__(
        self,
        instant: Instant,
        ports: Ports,
        reader: Reader,
        chosen: tuple[Index, Index] | None = None,
        axes: TurnedAxes | None = None,
    ) -> None:
        self.instant, self.ports, self._chosen, self._reader, self._axes = instant, ports, chosen, reader, axes

    def evaluated_again(self) -> "Reduction":
        """The same equations of what the instant is now, in the same coordinates."""
        return Reduction(self.instant, self.ports, self._reader, self.chosen, self._axes)

    def _slopes(self, what: str, *, turned: bool) -> Slopes:
        """Derivatives with respect to `what`; turned : whether that is resolved in the axes."""
        found = self.instant.along(what, self._reader)
        if self._axes is None:
            return found
        T, free = self._axes.turn, self.instant.free
        r = found.r.copy()
        r[free] = T @ r[free]
        out = replace(found, r=r)
        if not turned:
            return out
        return Slopes(*(getattr(out, part) @ T.T for part in ("r", "g", "C", "Cdot", "Cddot", "seen")))

    @cached_property
    def by_q(self) -> Slopes:
        """Derivatives with respect to positions."""
        return self._slopes("q", turned=True)

    @cached_property
    def by_v(self) -> Slopes:
        """Derivatives with respect to velocities."""
        return self._slopes("v", turned=True)

    @cached_property
    def by_x(self) -> Slopes:
        """Derivatives with respect to states of elements."""
        return self._slopes("x", turned=False)

    @cached_property
    def by_rate(self) -> Slopes:
        """Derivatives with respect to accelerations."""
        return self._slopes("vdot", turned=True)

    @cached_property
    def by_force(self) -> Slopes:
        """Derivatives with respect to multipliers."""
        return self._slopes("lam", turned=False)

    @cached_property
    def J(self) -> Array:
        """(K, f) constraint rows of the free unknowns."""
        return self.by_rate.Cddot

    @cached_property
    def kept(self) -> NDArray[np.intp]:
        """Rows that no input prescribes."""
        return np.setdiff1d(np.arange(self.instant.rows), self.ports.opened)

    @cached_property
    def holding(self) -> NDArray[np.intp]:
        """Those of them that hold positions."""
        return np.setdiff1d(self.kept, self.instant.velocity_rows)

    @cached_property
    def chosen(self) -> tuple[Index, Index]:
        """Places among the free unknowns of the independent coordinates: those that move most in the motions that are left; and of them
        those whose velocities are independent."""
        if self._chosen is not None:
            return self._chosen
        positions = self._chosen_for(self.holding, np.arange(len(self.instant.free)))
        if len(self.holding) == len(self.kept):
            return positions, positions
        return positions, self._chosen_for(self.kept, positions)

    @property
    def selected(self) -> Index:
        """Of independent coordinates."""
        return self.chosen[0]

    @property
    def moving(self) -> Index:
        """Of independent velocities."""
        return self.chosen[1]

    def _chosen_for(self, kept: Index, among: Index) -> Index:
        """Independent coordinates of the motions that these rows leave, `among` those."""
        length = self.instant.length[self.instant.free]
        N = free_motions(self.J[kept] * length / self.instant.row_scale[kept, None])
        if not N.shape[1]:
            return np.zeros(0, dtype=np.intp)
        pivoted: Any = qr(N[among].T, mode="economic", pivoting=True)
        return np.sort(among[pivoted[2][: N.shape[1]]])

    @cached_property
    def inverse(self) -> Array:
        """[C_q; S_v]⁻¹ (f, K + m), least norm where rows repeat each other."""
        return self._inverse_with(self.kept, self.moving)

    def _inverse_with(self, kept: NDArray[np.intp], selected: NDArray[np.intp]) -> Array:
        f, m = len(self.instant.free), len(selected)
        length = self.instant.length[self.instant.free]
        S = np.zeros((m, f))
        S[np.arange(m), selected] = 1.0
        weight = np.concatenate([1.0 / self.instant.row_scale[kept], 1.0 / length[selected]])
        whole = weight[:, None] * np.vstack([self.J[kept], S]) * length
        if not f:
            return np.zeros((0, len(weight)))
        found: Any = lstsq(whole, np.diag(weight))
        return length[:, None] * found[0]

    @cached_property
    def Z(self) -> Array:
        """(f, m) motion of all unknowns for a unit rate of each independent one."""
        return self.inverse[:, len(self.kept) :]

    @cached_property
    def Zq(self) -> Array:
        """(f, m) change of all positions for a unit of each independent one."""
        if len(self.holding) == len(self.kept):
            return self.Z
        return self._inverse_with(self.holding, self.selected)[:, len(self.holding) :]

    @cached_property
    def Y(self) -> Array:
        """(f, m) velocities that displaced independent coordinates ask for at rest."""
        return -self.inverse[:, : len(self.kept)] @ (self.by_q.Cdot[self.kept] @ self.Zq)

    @cached_property
    def E(self) -> Array:
        """(f, f) δq̇ = δv + E δq: -ω̃̄ on the turns of bodies, else zero; in turning axes T E Tᵀ + Ṫ Tᵀ."""
        own, out = self.instant, np.zeros((self.instant.n, self.instant.n))
        for first in np.flatnonzero(own.place[:, 1] == 0):
            x, y, z = own.y[own.positions + first :][:3]
            out[first : first + 3, first : first + 3] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
        found = out[np.ix_(own.free, own.free)]
        return found if self._axes is None else self._axes.turn @ found @ self._axes.turn.T + self._axes.rate

    @property
    def force(self) -> Array:
        """(f, p) generalised forces of the inputs."""
        force = self.ports.force[self.instant.free]
        return force if self._axes is None else self._axes.turn @ force

    def shifted(self, velocities: Array) -> Array:
        """What the turning of the axes adds to accelerations in them: δv̇' = T δv̇ + Ṫ Tᵀ v'."""
        return velocities * 0.0 if self._axes is None else self._axes.rate @ velocities

    def unturned(self, changes: Array) -> Array:
        """Changes (f, k) of all unknowns as the instant has them, not in turned axes."""
        return changes if self._axes is None else self._axes.turn.T @ changes

    @property
    def positions(self) -> Array:
        """(f, m) change of all positions of the instant, not in turned axes, for a unit of each independent one."""
        return self.unturned(self.Zq)

    def state_space(self) -> LinearSystem:
        """A, B, C, D for the states (s, w, x)."""
        own, free = self.instant, self.instant.free
        m, w, S, p = len(self.selected), len(self.moving), own.state_count, self.ports.force.shape[1]
        q = np.hstack([self.Zq, np.zeros((len(free), w + S + p))])
        v = np.hstack([self.Y, self.Z, np.zeros((len(free), S + p))])
        x = np.hstack([np.zeros((S, m + w)), np.eye(S), np.zeros((S, p))])
        u = np.hstack([np.zeros((p, m + w + S)), np.eye(p)])
        rate, lam = self._accelerations(q, v, x, u)
        qdot = v + self.E @ q
        xdot = self._combined("g", q, v, x, rate, lam)
        seen = self._combined("seen", q, v, x, rate, lam)
        rate = rate + self.shifted(v)
        whole = np.vstack([qdot[self.selected], rate[self.moving], xdot])
        count = m + w + S
        return LinearSystem(whole[:, :count], whole[:, count:], seen[:, :count], seen[:, count:])

    @cached_property
    def _saddle(self) -> Array:
        """(f + K, f + K) [M C_qᵀ; C_q 0]."""
        free = self.instant.free
        f, K = len(free), self.instant.rows
        saddle = np.zeros((f + K, f + K))
        saddle[:f, :f], saddle[:f, f:], saddle[f:, :f] = self.by_rate.r[free], self.by_force.r[free], self.J
        return saddle

    @cached_property
    def held(self) -> Held:
        """Motions while all rows hold, those that inputs prescribe too."""
        every, places = np.arange(self.instant.rows), np.arange(len(self.instant.free))
        inner = self._inverse_with(every, self._chosen_for(every, places) if len(self.ports.opened) else self.moving)
        by_row = inner[:, : self.instant.rows]
        return Held(inner[:, self.instant.rows :], by_row, by_row[:, self.ports.opened])

    @cached_property
    def _saddle_inverse(self) -> Array:
        """(f + K, f + K) its inverse, in the null space of all rows: where these leave no motion, forces make none, exactly."""
        M, P, Z = self.by_rate.r[self.instant.free], self.held.by_row, self.held.motions
        reduced = Z.T @ M @ Z
        by_force = Z @ np.linalg.solve(reduced, Z.T) if Z.shape[1] else np.zeros((len(M), len(M)))
        by_row = P - by_force @ M @ P
        return np.block([[by_force, by_row], [P.T - P.T @ M @ by_force, -P.T @ M @ by_row]])

    def _accelerations(self, q: Array, v: Array, x: Array, u: Array) -> tuple[Array, Array]:
        """(δv̇, δλ) for changes of positions, velocities, states and inputs."""
        free = self.instant.free
        forces = self.force @ u - self.moved("r", q, v, x)[free]
        rows = self.ports.held @ u - self.moved("Cddot", q, v, x)
        out = self._saddle_inverse @ np.vstack([forces, rows])
        return out[: len(free)], out[len(free) :]

    def noise(self) -> Array:
        """(n, n) what round-off may leave of entries of A in which larger terms cancel."""
        own, free = self.instant, self.instant.free
        m, w, S = len(self.selected), len(self.moving), own.state_count
        q = np.hstack([np.abs(self.Zq), np.zeros((len(free), w + S))])
        v = np.hstack([np.abs(self.Y), np.abs(self.Z), np.zeros((len(free), S))])
        x = np.hstack([np.zeros((S, m + w)), np.eye(S)])

        def moved(part: str) -> Array:
            return self.size_of(part, q, v, x)

        inverse = np.abs(self._saddle_inverse)
        # an inverse is as uncertain as what it is the inverse of
        inverse = inverse + inverse @ np.abs(self._saddle) @ inverse
        unknown = inverse @ np.vstack([moved("r")[free], moved("Cddot")])
        rate, lam = unknown[: len(free)], unknown[len(free) :]
        xdot = moved("g") + np.abs(self.by_rate.g) @ rate + np.abs(self.by_force.g) @ lam
        qdot = v + np.abs(self.E) @ q
        rate = rate + np.abs(self.shifted(v))
        return ROUND_OFF * np.vstack([qdot[self.selected], rate[self.moving], xdot])

    def size_of(self, part: str, q: Array, v: Array, x: Array) -> Array:
        """Sum of the magnitudes of what changes of these sizes, none negative, add to a part of the equations."""
        terms = ((self._sizes(part), q), (np.abs(getattr(self.by_v, part)), v), (np.abs(getattr(self.by_x, part)), x))
        return sum((size @ change for size, change in terms), start=np.zeros((1, q.shape[1])))

    def _sizes(self, part: str) -> Array:
        """Magnitudes of the derivatives of a part by positions. Of a stiffness in which larger terms cancel, as of a beam that lies askew,
        those of its diagonal stand for them."""
        out = np.abs(getattr(self.by_q, part))
        if part == "r":
            free = self.instant.free
            own = np.sqrt(np.diagonal(out[free]))
            out[free] = np.maximum(out[free], np.where(out[free] > 0.0, own[:, None] * own, 0.0))
        return out

    def moved(self, part: str, q: Array, v: Array, x: Array) -> Array:
        """Change of a part of the equations with positions, velocities and states of elements."""
        return getattr(self.by_q, part) @ q + getattr(self.by_v, part) @ v + getattr(self.by_x, part) @ x

    def _combined(self, part: str, q: Array, v: Array, x: Array, rate: Array, lam: Array) -> Array:
        """Change of a part of the equations, or of the outputs."""
        more = getattr(self.by_rate, part) @ rate + getattr(self.by_force, part) @ lam
        return self.moved(part, q, v, x) + more

    def second_order(self) -> tuple[Array, Array, Array]:
        """(M, D, K), each (m, m), in the independent coordinates of a machine at rest: Zᵀ M Z, Zᵀ D Z, Zᵀ K Z."""
        free, Z = self.instant.free, self.Z
        slopes: tuple[Slopes, ...] = (self.by_rate, self.by_v, self.by_q)
        M, D, K = (Z.T @ each.r[free] @ Z for each in slopes)
        return M, D, K


def free_motions(rows: Array) -> Array:
    """(f, m) orthonormal basis of the motions that the rows allow."""
    if not rows.shape[0]:
        return np.eye(rows.shape[1])
    _, sizes, every = np.linalg.svd(rows)
    rank = int(np.sum(sizes > RANK * sizes.max(initial=0.0)))
    return every[rank:].T


UNITS = {"m": "m", "1": "rad", "kg^0.5 m": "kg^0.5 m"}


def velocity_names(system: System) -> list[tuple[str, str]]:
    """(name, unit of the position) of every velocity, e.g. `hinge.angle` or `rod.turn_x`; turns are about axes of the body. A name of a
    joint coordinate of the results stands only where its rate is the velocity, or minus that."""
    place = system.record.newton.place
    units = [UNITS.get(system.map.units[int(p)], "") for p, _ in place]
    if system.tree_names:
        return list(zip(system.tree_names, units, strict=True))
    names: list[str] = []
    for body in system.bodies:
        names += [f"{body}.{axis}" for axis in "xyz"] + [f"{body}.turn_{axis}" for axis in "xyz"]
    return list(zip([*names, *system.modes][: len(place)], units, strict=True))
