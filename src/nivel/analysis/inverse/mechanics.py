"""The matrices of robotics: mass matrix, bias forces and Jacobians of a machine in independent coordinates, for trees and closed loops.

    M(q) a + h(q, v) = τ        velocities of all unknowns Z v + drift

M = Zᵀ M Z and h = Zᵀ r(v̇₀), v̇₀ the accelerations for a = 0, so that the equation is exact whatever closes the loops; h holds weight,
springs and all other forces of the machine. Velocities v (f,) belong to `names`; of machines with loops these are chosen among the
coordinates of the spanning tree, and positions of the others are closed by Newton's method.

All that is asked for takes one state, or rows of states, of which there are as many results.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.linalg import lapack

from nivel.analysis.assembly import instant
from nivel.analysis.inverse.quick import Quick, UnsuitedError
from nivel.analysis.linearise.ports import Catalogue
from nivel.analysis.linearise.reduction import Ports, Reduction, velocity_names
from nivel.analysis.linearise.validity import coordinate_signs
from nivel.analysis.run.prepared_state import Moment
from nivel.errors import ModelError
from nivel.machine.core.placement import marker_frame
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.system.system import Array

# positions are closed to this share of the scales of the rows, in so many iterations at most
CLOSED, MOST = 1e-13, 50
# axes of turns are numbered up to this; plain positions have none
LAST_AXIS = 2
# rows of states have so many dimensions
MANY: Final = 2


class Mechanics:
    """Mass matrix, bias and Jacobians of one machine.

    names : of the independent velocities v (f,), units : of their coordinates. position_names : of the positions q, all of the spanning
    tree; turns that are no joint coordinates are four Euler parameters. start : q at the start. What has the name of a joint coordinate of
    the results is that coordinate; `JOINT.x_from_second` is of a planar joint whose first body the tree carries on the second: x of the
    first marker's point along the axes of the second marker. left_out : names of contacts and frictions that have no part in it.
    """

    def __init__(self, machine: MachineRecord, moment: Moment, left_out: tuple[str, ...] = ()) -> None:
        self._machine, self._moment, self.left_out = machine, moment, left_out
        self._instant = instant.Instant(moment.motion, 0.0, moment.y)
        reduction = self._reduction()
        self._selected = reduction.selected
        named = velocity_names(self._instant.system)
        own = self._instant
        self.names, self.units = (tuple(named[own.free[k]][part] for k in self._selected) for part in (0, 1))
        self.position_names = _position_names(own, [name for name, _ in named])
        catalogue = Catalogue(machine, own)
        # joint coordinates of the results are signs times positions of the tree, and offsets: whole turns, or other zeros
        self._signs, self._offsets = np.ones(own.n), np.zeros(own.positions)
        self._signs[own.free] = coordinate_signs(catalogue, own)
        self._place_signs = self._position_signs()
        known = [name for name in self.position_names if name in catalogue.coordinates]
        places = [self.position_names.index(name) for name in known]
        values = own.read(catalogue.reader([catalogue.outputs[name] for name in known]))
        self._offsets[places] = values - self._shown(moment.y[: own.positions])[places]
        self.start: Array = self._shown(moment.y[: own.positions])
        counted = [
            (self.position_names.index(name), k)
            for name, k, unit in zip(
                catalogue.coordinates, catalogue.index.tolist(), own.system.coordinate_units, strict=True
            )
            if unit == "rad" and name in self.position_names
        ]
        self._angles, self._counted = np.array(counted, dtype=np.intp).reshape(-1, 2).T
        self._velocity_signs = self._signs[own.free[self._selected]]
        self._quick = None if len(own.velocity_rows) else Quick(own, self._selected, reduction.kept)
        self._turns = bool((own.place[:, 1] <= LAST_AXIS).any())
        self._still, self._zeros = moment.y.copy(), np.zeros(len(moment.y))
        self._still[own.positions : own.first_state] = 0.0

    def _reduction(self) -> Reduction:
        own = self._instant
        ports = Ports(np.zeros((own.n, 0)), np.zeros((own.rows, 0)), np.zeros(0, dtype=np.intp))
        chosen = getattr(self, "_selected", None)
        return Reduction(own, ports, _nothing, None if chosen is None else (chosen, chosen))

    # --- states ---

    def close(self, q: Array) -> Array:
        """Positions with all loops closed: those of the independent velocities stay. Raises ModelError where that is not possible."""
        own = self._instant
        y = self._moment.y.copy()
        y[: own.positions] = self._in_tree(self._checked(q, own.positions, "q"))
        y[own.positions : own.first_state] = 0.0
        self._count_turns(q)
        dependent = np.setdiff1d(np.arange(len(own.free)), self._selected)
        for _ in range(MOST):
            y[: own.positions] = _normalised(own, y[: own.positions])
            own.move_to(0.0, y, np.zeros(own.n))
            first = own.n + own.state_count
            C = own.value()[first : first + own.rows]
            if np.max(np.abs(C) / own.row_scale, initial=0.0) <= CLOSED:
                return self._shown(y[: own.positions])
            length = own.length[own.free][dependent]
            found = np.linalg.lstsq(
                own.J[:, dependent] * length / own.row_scale[:, None], -C / own.row_scale, rcond=1e-12
            )
            psi = np.zeros(own.n)
            psi[own.free[dependent]] = length * found[0]
            y[: own.positions] += own.position_rates(own.y, psi)
        raise ModelError(f"the loops cannot be closed with {', '.join(self.names)} where they are asked for")

    def displaced(self, q: Array, change: Array) -> Array:
        """Positions after a change (f,) of the independent coordinates, turns about axes of their bodies; loops closed again."""
        own = self._instant
        psi = np.zeros(own.n)
        psi[own.free[self._selected]] = self._velocity_signs * change
        return self.close(self._shown(own.displaced(self._in_tree(q), psi)))

    def _at(self, q: Array | None, v: Array | None) -> Reduction:
        """The equations at positions q (closed first) and velocities v, with accelerations for a = 0."""
        own = self._instant
        y, closed = self._moment.y.copy(), self.close(self.start if q is None else q)
        y[: own.positions] = self._in_tree(closed)
        self._count_turns(closed)
        y[own.positions : own.first_state] = 0.0
        own.move_to(0.0, y, np.zeros(own.n))
        reduction = self._reduction()
        rows = len(reduction.kept)
        first = own.n + own.state_count + own.rows
        drift = -reduction.inverse[:, :rows] @ own.value()[first : first + own.rows]
        speed = (
            np.zeros(len(self.names)) if v is None else self._checked(v, len(self.names), "v") * self._velocity_signs
        )
        y[own.positions + own.free] = reduction.Z @ speed + drift
        own.move_to(0.0, y, np.zeros(own.n))
        gamma = -own.value()[first + own.rows :]
        still = np.zeros(own.n)
        still[own.free] = reduction.inverse[:, :rows] @ gamma
        own.move_to(0.0, y, still)
        return reduction

    # --- what is asked ---

    def mass_matrix(self, q: Array | None = None) -> Array:
        """(f, f) mass matrix at q, the start by default [kg, kg m, kg m²]."""
        return self._for_each(self._mass_matrix, q)

    def _mass_matrix(self, q: Array | None) -> Array:
        if (quick := self._at_once(q)) is not None:
            try:
                M, J = quick.slopes()
                Z, _ = quick.motions(J)
                return self._signed(Z.T @ M @ Z if quick.has_loops else M)
            except UnsuitedError:
                pass
        reduction = self._at(q, None)
        return self._signed(reduction.Z.T @ reduction.by_rate.r[self._instant.free] @ reduction.Z)

    def _signed(self, M: Array) -> Array:
        """A symmetric matrix of the independent velocities with their signs."""
        return self._velocity_signs[:, None] * M * self._velocity_signs

    def bias(self, q: Array | None = None, v: Array | None = None) -> Array:
        """(f,) efforts that a = 0 asks for at q and v: weight, centrifugal forces, springs, dampers [N, N m]."""
        return self._for_each(self._efforts, q, v)

    def inverse_dynamics(self, q: Array, v: Array, a: Array) -> Array:
        """(f,) efforts on the independent coordinates that make the accelerations a (f,) at q and v."""
        return self._for_each(self._efforts, q, v, a)

    def _efforts(self, q: Array | None, v: Array | None, a: Array | None = None) -> Array:
        speed = None if v is None else self._checked(v, len(self.names), "v") * self._velocity_signs
        rate = None if a is None else self._checked(a, len(self.names), "a") * self._velocity_signs
        if (quick := self._at_once(q)) is not None:
            try:
                Z, inverse = quick.motions_here()
                quick.move(Z, inverse, speed, rate)
                return self._velocity_signs * quick.efforts(Z)
            except UnsuitedError:
                pass
        reduction, own = self._at(q, v), self._instant
        if rate is not None:
            vdot = own.vdot.copy()
            vdot[own.free] += reduction.Z @ rate
            own.move_to(0.0, own.y, vdot)
        return self._velocity_signs * (reduction.Z.T @ own.value()[: own.n][own.free])

    def _at_once(self, q: Array | None) -> Quick | None:
        """The quick equations at rest at positions q, which are closed first; None where they do not suit the machine."""
        quick, own, y = self._quick, self._instant, self._still
        if quick is None:
            return None
        q = self.start if q is None else self._checked(q, own.positions, "q")
        y[: own.positions] = self._in_tree(q)
        if self._turns:
            y[: own.positions] = _normalised(own, y[: own.positions])
        if len(self._angles):
            self._count_turns(q)
        quick.be_at(y)
        if quick.has_loops and not quick.is_closed():
            y[: own.positions] = self._in_tree(self.close(q))
            quick.be_at(y)
        return quick

    def _for_each(self, call: Callable[..., Array], *states: Array | None) -> Array:
        """What is asked for at one state, or at rows of states."""
        for each in states:
            if each is not None and np.ndim(each) >= MANY:
                break
        else:
            return call(*states)
        rows = max(len(each) for each in states if each is not None and np.ndim(each) == MANY)
        given = [
            [None] * rows
            if each is None
            else np.broadcast_to(np.asarray(each, dtype=float), (rows, np.shape(each)[-1]))
            for each in states
        ]
        return np.array([call(*row) for row in zip(*given, strict=True)])

    def forward_dynamics(self, q: Array, v: Array, tau: Array) -> Array:
        """(f,) accelerations for efforts τ (f,) on the independent coordinates."""
        return self._for_each(self._forward_dynamics, q, v, tau)

    def _forward_dynamics(self, q: Array | None, v: Array | None, tau: Any) -> Array:
        effort = self._checked(tau, len(self.names), "tau")
        M, h = self._mass_and_bias(q, v)
        right = effort - h
        _, found, failed = lapack.dposv(M, right)  # type: ignore[attr-defined]
        return np.asarray(np.linalg.solve(M, right) if failed else found, dtype=np.float64)

    def _mass_and_bias(self, q: Array | None, v: Array | None) -> tuple[Array, Array]:
        if (quick := self._at_once(q)) is not None:
            try:
                M, J = quick.slopes()
                Z, inverse = quick.motions(J)
                speed = None if v is None else self._checked(v, len(self.names), "v") * self._velocity_signs
                quick.move(Z, inverse, speed, None)
                return self._signed(Z.T @ M @ Z if quick.has_loops else M), self._velocity_signs * quick.efforts(Z)
            except UnsuitedError:
                pass
        return self._mass_matrix(q), self._efforts(q, v)

    def jacobian(self, point: str, q: Array | None = None) -> Array:
        """(6, f) velocity and angular velocity (global axes) of a marker, or of the frame of a body, per velocity."""
        b, position = self._point(point)

        def at(q: Array | None) -> Array:
            if (quick := self._at_once(q)) is not None:
                try:
                    return quick.jacobian(quick.motions_here()[0], b, position) * self._velocity_signs
                except UnsuitedError:
                    pass
            reduction = self._at(q, None)
            rates = self._instant.along("v", lambda own: instant.point_velocity(_measured(own), b, position)).seen
            return rates @ reduction.Z * self._velocity_signs

        return self._for_each(at, q)

    def jacobian_bias(self, point: str, q: Array | None = None, v: Array | None = None) -> Array:
        """(6,) acceleration and angular acceleration (global axes) of a marker or body for a = 0."""
        b, position = self._point(point)
        self._at(q, v)
        return self._instant.read(lambda own: instant.point_acceleration(_measured(own), b, position))

    def pose(self, point: str, q: Array | None = None) -> tuple[Array, Array]:
        """Place (3,) [m] and axes (3, 3) (columns) of a marker or the frame of a body at positions q, which are closed."""
        b, position = self._point(point)
        own = self._instant
        y = self._moment.y.copy()
        y[: own.positions] = self._in_tree(self.start if q is None else q)
        own.move_to(0.0, y, np.zeros(own.n))
        own.value()
        axes = instant.frame_axes(own, b)[..., 0]
        marker = self._machine.marker_named.get(point)
        place = instant.frame_place(own, b)[..., 0] + axes @ position
        return place, axes if marker is None else axes @ marker_frame(marker)[1]

    @property
    def size(self) -> float:
        """[m] length of the machine."""
        return self._instant.system.size

    # --- names and signs ---

    def _count_turns(self, q: Array) -> None:
        """The turn in which each angle of the tree is, for the forces that depend on it."""
        self._instant.record.coordinates.reference[self._counted] = np.asarray(q, dtype=float).ravel()[self._angles]

    def _shown(self, positions: Array) -> Array:
        """q for positions of the tree."""
        return self._place_signs * positions + self._offsets

    def _in_tree(self, q: Array) -> Array:
        """Positions of the tree for q."""
        return self._place_signs * (q - self._offsets)

    def _position_signs(self) -> Array:
        own, out = self._instant, np.ones(self._instant.positions)
        for j, (place, axis) in enumerate(own.place.tolist()):
            if axis > LAST_AXIS:
                out[place] = self._signs[j]
        return out

    def _point(self, name: str) -> tuple[int, Array]:
        bodies = list(self._instant.system.bodies)
        marker = self._machine.marker_named.get(name)
        if marker is not None and marker.body in bodies:
            return bodies.index(marker.body), np.array(marker.position, dtype=float)
        if name not in bodies:
            raise ModelError(unknown_name("marker or body", name, [*self._machine.marker_named, *bodies]))
        return bodies.index(name), np.zeros(3)

    def _checked(self, value: Array, count: int, what: str) -> Array:
        out = np.asarray(value, dtype=np.float64)
        if out.ndim != 1:
            out = out.ravel()
        # 0 times what is not finite is no number; one product is quicker than a question for each
        if len(out) != count or out.dot(self._zeros[:count]) != 0.0:
            names = self.position_names if what == "q" else self.names
            raise ModelError(f"`{what}` must be {count} numbers, one for each of {', '.join(names)}; got {len(out)}")
        return out


def _measured(own: instant.Instant) -> instant.Instant:
    own.place_markers()
    return own


def _nothing(_: instant.Instant) -> instant.Lanes:
    return np.zeros((0, len(instant.NOTHING)))


def _normalised(own: instant.Instant, q: Array) -> Array:
    """q with Euler parameters of unit length."""
    out = q.copy()
    for place, axis in own.place.tolist():
        if axis == 0:
            out[place : place + 4] /= np.linalg.norm(out[place : place + 4])
    return out


def _position_names(own: instant.Instant, names: list[str]) -> tuple[str, ...]:
    """Of every position: that of its velocity, and four parameters of every turn in space."""
    out = [""] * own.positions
    for j, (place, axis) in enumerate(own.place.tolist()):
        if axis == 0:
            owner = names[j].rpartition(".")[0]
            out[place : place + 4] = [f"{owner}.parameter_{k}" for k in range(4)]
        elif axis > LAST_AXIS:
            out[place] = names[j]
    return tuple(out)
