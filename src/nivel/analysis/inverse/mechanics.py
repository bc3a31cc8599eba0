"""The matrices of robotics: mass matrix, bias forces and Jacobians of a machine in independent coordinates, for trees and closed loops.

    M(q) a + h(q, v) = τ        velocities of all unknowns Z v + drift

M = Zᵀ M Z and h = Zᵀ r(v̇₀), v̇₀ the accelerations for a = 0, so that the equation is exact whatever closes the loops; h holds weight,
springs and all other forces of the machine. Velocities v (f,) belong to `names`; of machines with loops these are chosen among the
coordinates of the spanning tree, and positions of the others are closed by Newton's method.

All that is asked for takes one state, or rows of states, of which there are as many results.
"""

from collections.abc import Callable
from math import isfinite
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly import instant
from nivel.analysis.linearise.ports import Catalogue
from nivel.analysis.linearise.reduction import Ports, Reduction, velocity_names
from nivel.analysis.linearise.validity import coordinate_signs
from nivel.analysis.run.prepared_state import Moment
from nivel.errors import ModelError
from nivel.kernels.core.block import Handle
from nivel.kernels.residual.many_states import EFFORTS, FORWARD, JACOBIAN, MASS, SLOPES, States, answer_rows
from nivel.machine.core.placement import marker_frame
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

# positions are closed to this share of the scales of the rows, in so many iterations at most
CLOSED, MOST = 1e-13, 50
# axes of turns are numbered up to this; plain positions have none
LAST_AXIS = 2
# rows of states have so many dimensions
MANY: Final = 2
NOTHING: Final = np.zeros(0)


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
        self._address = int(moment.motion.handle.address)
        dependent = np.setdiff1d(np.arange(len(own.free)), self._selected)
        suited = not len(own.velocity_rows) and len(dependent) == own.rows
        self._states = Handle(self._rows_of_states(dependent)) if suited else None

    def _rows_of_states(self, dependent: NDArray[np.intp]) -> States:
        own, f, m, rows = self._instant, len(self._instant.free), len(self._selected), self._instant.rows
        still = self._moment.y.copy()
        still[own.positions : own.first_state] = 0.0
        Z = np.zeros((f, m))
        Z[self._selected, np.arange(m)] = 1.0
        selection = own.free, self._selected, dependent, own.place[own.place[:, 1] == 0, 0]
        shapes = 3, (f, f), (rows, f), (rows, rows), (rows, rows), max(f, rows), (max(f, 6), max(f, m)), (m, m)
        arrays: list[Any] = [
            *(each.astype(np.uint32) for each in selection),
            np.stack([self._counted, self._angles], axis=1).astype(np.uint32),
            CLOSED * own.row_scale,
            np.stack([self._place_signs, self._offsets], axis=1),
            self._velocity_signs.copy(),
            still,
            Z,
            *(np.zeros(each) for each in shapes),
            *(np.zeros(count, np.int64) for count in (1, rows, rows, m)),
        ]
        return States(*arrays)

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
        speed = (np.zeros(len(self.names)) if v is None else v) * self._velocity_signs
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
        return self._answers(MASS, self._mass_matrix, (len(self.names),) * 2, q)

    def _mass_matrix(self, q: Array, *_: Array) -> Array:
        reduction = self._at(q, None)
        M = reduction.Z.T @ reduction.by_rate.r[self._instant.free] @ reduction.Z
        return self._velocity_signs[:, None] * M * self._velocity_signs

    def bias(self, q: Array | None = None, v: Array | None = None) -> Array:
        """(f,) efforts that a = 0 asks for at q and v: weight, centrifugal forces, springs, dampers [N, N m]."""
        return self._answers(EFFORTS, self._efforts, (len(self.names),), q, v)

    def inverse_dynamics(self, q: Array, v: Array, a: Array) -> Array:
        """(f,) efforts on the independent coordinates that make the accelerations a (f,) at q and v."""
        return self._answers(EFFORTS, self._efforts, (len(self.names),), q, v, a)

    def _efforts(self, q: Array, v: Array | None, a: Array | None) -> Array:
        reduction, own = self._at(q, v), self._instant
        if a is not None:
            vdot = own.vdot.copy()
            vdot[own.free] += reduction.Z @ (a * self._velocity_signs)
            own.move_to(0.0, own.y, vdot)
        return self._velocity_signs * (reduction.Z.T @ own.value()[: own.n][own.free])

    def forward_dynamics(self, q: Array, v: Array, tau: Array) -> Array:
        """(f,) accelerations for efforts τ (f,) on the independent coordinates."""
        return self._answers(FORWARD, self._forward_dynamics, (len(self.names),), q, v, tau, "tau")

    def _forward_dynamics(self, q: Array, v: Array | None, tau: Array) -> Array:
        return np.linalg.solve(self._mass_matrix(q), tau - self._efforts(q, v, None)).astype(float, copy=False)

    def inverse_dynamics_derivatives(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """∂τ/∂q and ∂τ/∂v (f, f) of the efforts of `inverse_dynamics`, exact; columns by the independent coordinates, turns about axes of
        their bodies, loops closed. ∂τ/∂a is the mass matrix M; of the accelerations for given efforts they are -M⁻¹ ∂τ/∂q, -M⁻¹ ∂τ/∂v."""
        both = self._answers(SLOPES, _without_slopes, (2, *(len(self.names),) * 2), q, v, a)
        return both[..., 0, :, :], both[..., 1, :, :]

    def jacobian(self, point: str, q: Array | None = None) -> Array:
        """(6, f) velocity and angular velocity (global axes) of a marker, or of the frame of a body, per velocity."""
        b, position = self._point(point)
        if self._states is not None:
            asked: States = self._states.record
            asked.body[0], asked.arm[:] = b, self._arm(b, position)

        def at(q: Array, *_: Array) -> Array:
            reduction = self._at(q, None)
            rates = self._instant.along("v", lambda own: instant.point_velocity(_measured(own), b, position)).seen
            return rates @ reduction.Z * self._velocity_signs

        return self._answers(JACOBIAN, at, (6, len(self.names)), q)

    def _arm(self, b: int, position: Array) -> Array:
        """(3,) the point of body b in the axes in which the tree has the body."""
        tree = self._instant.record.tree
        return tree.own[b] + rotation_matrices(tree.own_theta[b : b + 1])[0] @ position if len(tree.node) else position

    def _answers(
        self,
        job: int,
        slow: Callable[..., Array],
        shape: tuple[int, ...],
        q: Array | None,
        v: Array | None = None,
        x: Array | None = None,
        name: str = "a",
    ) -> Array:
        """Answers for one state, or for rows of states: by compiled code; where it has none, by `slow` for the single state."""
        count = len(self.names)
        given = (
            self._checked(self.start if q is None else q, self._instant.positions, "q"),
            NOTHING if v is None else self._checked(v, count, "v"),
            NOTHING if x is None else self._checked(x, count, name),
        )
        rows = {len(each) for each in given if each.ndim == MANY}
        if len(rows) > 1:
            raise ModelError(f"rows of states must be as many in all that is given; got {sorted(rows)}")
        out = np.empty((rows.copy().pop() if rows else 1, *shape))
        done = 0
        while (done := self._answered(job, done, given, out)) < len(out):
            single = [each[done] if each.ndim == MANY else each for each in given]
            closed = self.close(single[0]), *single[1:]
            if not self._answered(job, 0, closed, out[done : done + 1]):
                out[done] = slow(*(None if each is NOTHING else each for each in closed))
            done += 1
        return out if rows else out[0]

    def _answered(self, job: int, first: int, given: tuple[Array, ...], out: Array) -> int:
        """The compiled code's answers from row `first` on. Returns the number of the row that it has none for, or of all."""
        if self._states is None or not len(out):
            return first
        flat = [each.ravel() for each in (*given, out)]
        return int(answer_rows(self._address, self._states.address, job, first, len(out), *flat))

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
        """(count,) or (rows, count) numbers, one behind the other."""
        out = np.ascontiguousarray(value, dtype=np.float64)
        flat = out.ravel()
        # squares are quicker than a question for each; they may overflow
        if out.ndim > MANY or out.shape[-1] != count or not (isfinite(flat.dot(flat)) or np.isfinite(flat).all()):
            names = self.position_names if what == "q" else self.names
            raise ModelError(
                f"`{what}` must be {count} numbers, one for each of {', '.join(names)}, or rows of these; got {out.shape}"
            )
        return out


def _without_slopes(*_: Array | None) -> Array:
    raise ModelError(
        "there are no derivatives of the efforts of machines with rolling wheels, or where loops are singular"
    )


def _measured(own: instant.Instant) -> instant.Instant:
    own.place_markers()
    return own


def _nothing(_: instant.Instant) -> instant.Lanes:
    return np.zeros((0, len(instant.NOTHING)))


def _normalised(own: instant.Instant, q: Array) -> Array:
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
