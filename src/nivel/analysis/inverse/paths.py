"""Inverse kinematics: joint coordinates that lead a point of a machine along a wanted path.

At each place of the path the error e of position, and of orientation as a rotation vector times a length, is made least by damped steps

    min |J δ - e|² + μ |δ/range|²,  low ≤ q + δ ≤ high,  μ = ½ e·e/length² + small

(Levenberg–Marquardt with the damping of Sugihara 2011, which converges out of reach as well; limits as bounds of the least squares, not by
clipping). Freedoms that the path leaves go towards a preferred posture. Loops stay closed: J is that of the independent coordinates.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.optimize import lsq_linear
from scipy.spatial.transform import Rotation

from nivel.analysis.inverse.mechanics import Mechanics
from nivel.errors import Fault, ModelError, refuse
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Led
from nivel.lazy import Struct, replace
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.results.analyses.efforts import JointPath
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

# a place is reached where position and orientation err by less than these [machine lengths, rad]
REACHED = 1e-9
# iterations, and restarts from random postures, at most; a search stops where steps are this small
MOST, STARTS, SMALL = 60, 6, 1e-13
DAMPING = 1e-10
# share of the way towards the preferred posture in an iteration
TOWARDS = 0.3
# on the way there the point may be aside by this share of the machine's length
ASIDE = 1e-3
# shortest share of a step that is tried; singular values below this share of the largest are zero
LEAST_SHARE, RANK = 1e-4, 1e-6


class Task(Struct):
    """What is wanted: a point, its places (T, 3) [m], its orientations (T, 3, 3) or None; low, high (f,) : limits of the independent
    coordinates; posture (f,) : preferred values, not a number where there is none; weights of position and orientation."""

    point: str
    places: Array
    axes: Array | None
    low: Array
    high: Array
    posture: Array


class PathFollower:
    """Searches joint coordinates of one machine for one task."""

    def __init__(self, mechanics: Mechanics, task: Task) -> None:
        self.mechanics, self.task = mechanics, task
        self.size = mechanics.size
        known = mechanics.position_names
        # turns in space are no positions of their own, and have neither limits nor wishes
        self.measured = np.array([name in known for name in mechanics.names], dtype=bool)
        self.place = np.array([known.index(name) for name in mechanics.names if name in known], dtype=np.intp)
        span = np.where(np.isfinite(task.high - task.low), task.high - task.low, 2.0 * np.pi)
        self.range = np.where(span > 0.0, span, 1.0)
        # of lengths, random postures differ by less
        self.reach = np.where([unit == "m" for unit in mechanics.units], 0.1 * self.size, 1.0)
        self.rng = np.random.default_rng(0)

    def follow(self, time: Array) -> JointPath:
        """Joint coordinates at all places, each from the one before."""
        q = self.mechanics.start
        rows: list[Array] = []
        errors, reached, measures, active, starts = [], [], [], [], []
        for k in range(len(self.task.places)):
            q, tries = self._best(q, k)
            e = self._error(q, k)
            J = self._jacobian(q)
            size = np.linalg.svd(J, compute_uv=False)
            rows.append(q)
            errors.append([float(np.linalg.norm(e[:3])), float(np.linalg.norm(e[3:])) / self.size])
            reached.append(float(np.linalg.norm(e)) <= REACHED * self.size)
            measures.append([float(np.prod(size)), float(size[-1])])
            active.append(self._active(q))
            starts.append(tries)
        found = JointPath(
            name=self.task.point,
            time=time,
            coordinates=self.mechanics.position_names,
            independent=self.mechanics.names,
            values=np.array(rows),
            error=np.array(errors),
            reached=np.array(reached),
            manipulability=np.array(measures)[:, 0],
            smallest_singular_value=np.array(measures)[:, 1],
            limits=tuple(active),
            starts=np.array(starts),
        )
        return replace(found, trust=assess(Led(outcome="done", path=found)))

    def _best(self, q: Array, k: int) -> tuple[Array, int]:
        """The nearest posture found for place k, and from how many starts."""
        best = self._search(q, k)
        error = float(np.linalg.norm(self._error(best, k)))
        for number in range(1, STARTS):
            if error <= REACHED * self.size:
                return best, number
            at = self._values(q)
            low = np.where(np.isfinite(self.task.low), self.task.low, at - np.pi * self.reach)
            high = np.where(np.isfinite(self.task.high), self.task.high, at + np.pi * self.reach)
            try:
                found = self._search(self.mechanics.displaced(q, self.rng.uniform(low, high) - at), k)
            except ModelError:
                continue
            size = float(np.linalg.norm(self._error(found, k)))
            if size < error * (1.0 - 1e-6):
                best, error = found, size
        return best, STARTS

    def _search(self, q: Array, k: int) -> Array:
        """The posture of least error near q; first with the preferred posture in mind, then without, so that the error is the least."""
        at = self._values(q)
        q = self.mechanics.displaced(q, np.clip(at, self.task.low, self.task.high) - at)
        if np.any(np.isfinite(self.task.posture)):
            q = self._descend(self._descend(q, k, wishing=False), k, wishing=True)
        return self._descend(q, k, wishing=False)

    def _descend(self, q: Array, k: int, *, wishing: bool) -> Array:
        """Steps until they are small, or none makes the error less."""
        e = self._error(q, k)
        for _ in range(MOST):
            step = self._step(self._jacobian(q), e, q, wishing)
            allowed = max(float(np.linalg.norm(e)) * (1.0 + 1e-9), REACHED * self.size)
            allowed = max(allowed, ASIDE * self.size) if wishing else allowed
            share = 1.0
            while share >= LEAST_SHARE:
                try:
                    after = self.mechanics.displaced(q, share * step)
                    error = self._error(after, k)
                    if np.linalg.norm(error) <= allowed:
                        break
                except ModelError:
                    pass
                share *= 0.5
            else:
                return q
            q, e = after, error
            if np.max(np.abs(share * step) / self.range, initial=0.0) <= SMALL:
                break
        return q

    def _step(self, J: Array, e: Array, q: Array, wishing: bool) -> Array:
        """A damped step within the limits; wishing : what the path leaves free goes towards the preferred posture."""
        mu = np.sqrt(0.5 * float(e @ e) / self.size**2 + DAMPING)
        at = self._values(q)
        low, high = np.minimum(self.task.low - at, 0.0), np.maximum(self.task.high - at, 0.0)
        # bounds that have no room left are a hair apart for the solver
        room = 1e-14 * self.range
        scaled = np.vstack([J * self.range, mu * self.size * np.eye(len(at))])
        right = np.concatenate([e, np.zeros(len(at))])
        step = (
            lsq_linear(scaled, right, (low / self.range - room, high / self.range + room), method="bvls").x * self.range
        )
        if wishing:
            wished = np.where(np.isfinite(self.task.posture), self.task.posture - at - step, 0.0)
            _, size, every = np.linalg.svd(J * self.range)
            free = every[int(np.sum(size > RANK * size[0])) :].T
            step = step + TOWARDS * self.range * (free @ (free.T @ (wished / self.range)))
        return np.clip(step, low, high)

    def _values(self, q: Array) -> Array:
        """(f,) of the independent coordinates, zero for turns in space."""
        out = np.zeros(len(self.measured))
        out[self.measured] = q[self.place]
        return out

    def _error(self, q: Array, k: int) -> Array:
        """(3,) or (6,) [m]: wanted less present place, and turn towards the wanted axes times the machine's length."""
        place, axes = self.mechanics.pose(self.task.point, q)
        e = self.task.places[k] - place
        if self.task.axes is None:
            return e
        return np.concatenate([e, self.size * Rotation.from_matrix(self.task.axes[k] @ axes.T).as_rotvec()])

    def _jacobian(self, q: Array) -> Array:
        J = self.mechanics.jacobian(self.task.point, q)
        return J[:3] if self.task.axes is None else np.vstack([J[:3], self.size * J[3:]])

    def _active(self, q: Array) -> tuple[str, ...]:
        at, near = self._values(q), 1e-9 * self.range
        held = (at - self.task.low <= near) | (self.task.high - at <= near)
        return tuple(name for name, each in zip(self.mechanics.names, held, strict=True) if each)


def task_for(
    mechanics: Mechanics,
    point: str,
    places: Any,
    orientations: Any = None,
    limits: Mapping[str, Any] | None = None,
    posture: Mapping[str, Any] | None = None,
) -> Task:
    """The task of a path, checked. orientations : (T, 4) Euler parameters, scalar first. limits : (low, high) by coordinate, posture :
    values, in SI units or texts with units. Raises ModelError with everything that is wrong."""
    faults: list[Fault] = []
    where = _numbers("places", places, 3, faults)
    axes = None
    if orientations is not None:
        parameters = _numbers("orientations", orientations, 4, faults)
        if not faults and len(parameters) != len(where):
            faults.append(_fault("orientations", f"{len(parameters)} orientations do not fit {len(where)} places"))
        elif not faults:
            axes = rotation_matrices(parameters / np.linalg.norm(parameters, axis=1, keepdims=True))
    low, high = np.full(len(mechanics.names), -np.inf), np.full(len(mechanics.names), np.inf)
    wished = np.full(len(mechanics.names), np.nan)
    for name, pair in (limits or {}).items():
        k = _place("limits", name, mechanics.names, faults)
        if k is None:
            continue
        listed = isinstance(pair, Sequence) and not isinstance(pair, str)
        ends = [_quantity("limits", mechanics.units[k], each, faults) for each in pair] if listed else []
        if len(ends) != 2:
            faults.append(_fault("limits", f"two values, low and high, were expected for {name}, got {shown(pair)}"))
        elif not ends[0] < ends[1]:
            faults.append(_fault("limits", f"the low limit of {name} must be below the high one"))
        else:
            low[k], high[k] = ends
    for name, value in (posture or {}).items():
        k = _place("posture", name, mechanics.names, faults)
        if k is not None:
            wished[k] = _quantity("posture", mechanics.units[k], value, faults)
    refuse(faults)
    mechanics.pose(point)  # whether there is such a point
    return Task(point, where, axes, low, high, wished)


def path_times(times: Any, count: int) -> Array:
    """(T,) [s] ascending times of so many places; 0, 1, 2 … without any. Raises ModelError."""
    if times is None:
        return np.arange(float(count))
    out = np.asarray(times, dtype=float).ravel()
    if len(out) != count or np.any(np.diff(out) <= 0.0):
        raise ModelError(_fault("times", f"{count} ascending times were expected, one for each place, got {len(out)}"))
    return out


def _numbers(field: str, given: Any, width: int, faults: list[Fault]) -> Array:
    """(T, width) numbers."""
    try:
        out = np.atleast_2d(np.asarray(given, dtype=float))
    except (TypeError, ValueError):
        out = np.zeros((0, 0))
    if out.ndim != 2 or out.shape[1] != width or not len(out) or not np.isfinite(out).all():
        faults.append(_fault(field, f"rows of {width} numbers were expected, got {shown(given)[:80]}"))
        return np.zeros((1, width))
    return out


def _place(field: str, name: str, names: Sequence[str], faults: list[Fault]) -> int | None:
    found = [k for k, each in enumerate(names) if each == name or each.startswith(f"{name}.")]
    if len(found) == 1:
        return found[0]
    faults.append(_fault(field, unknown_name("independent coordinate", name, list(names))))
    return None


def _quantity(field: str, unit: str, value: Any, faults: list[Fault]) -> float:
    kind = "length" if unit == "m" else "angle"
    try:
        return float(value) if isinstance(value, int | float) else read_quantity(value, kind, {})
    except ExpressionError as problem:
        faults.append(_fault(field, expression_fault(problem, value).message()))
        return 0.0


def _fault(field: str, message: str) -> Fault:
    return Fault.at(f"inverse_kinematics.{field}", message)
