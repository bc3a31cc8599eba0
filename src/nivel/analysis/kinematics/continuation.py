"""Continuation by arc length: the positions of a machine with one free motion, beyond the turning points of any coordinate.

A driver prescribes one coordinate; where that turns back, C_q of the driven machine is singular and the driver cannot go on. The
positions themselves go on: those of a machine with one free motion are a curve C(q) = 0 with the tangent τ, C_q τ = 0. A step of length h
along τ is closed again by corrections as small as possible, and the sign of τ is kept by τ·τ_before > 0 (Keller 1977).
"""

from typing import Any

import numpy as np
from scipy.optimize import brentq

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.closing import close_positions
from nivel.analysis.assembly.equations import MotionEquations, change_between, equations, moved
from nivel.analysis.assembly.named_freedoms import coordinate_derivatives, freedoms
from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.kinematics.drive import TAKES_PART, determinant_sign, independent_rows
from nivel.errors import Fault, ModelError, SolveError
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Curve
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.results.analyses.mechanism import ConfigurationCurve, Turning
from nivel.system.beam_nodes import with_nodes
from nivel.system.system import Array

# longest and shortest step, and the most of them
LONGEST, SHORTEST, MOST = 0.05, 1e-7, 2000
# cosine between tangents of neighbours, and share of a step by which closing may move it
STRAIGHT, ASIDE = 0.97, 0.3
# this near to the start, in steps, the curve may be back, after so many places at least; ways below the last are nothing
BACK, LEAST, NOTHING = 1.5, 4, 1e-12
# a rate below this share of the largest is zero
STILL = 1e-9


class _Place(Struct):
    """A position: state, unit tangent (6 B,), joint coordinates and their rates along the tangent, references of angles."""

    y: Array
    tangent: Array
    values: Array
    rates: Array
    reference: Array


class _Curve:
    """Steps along the positions of a machine."""

    def __init__(self, machine: MachineRecord) -> None:
        with_beams = with_nodes(machine)
        self.motion: MotionEquations = equations(with_beams, measured=True)
        self.system = self.motion.system
        self.coordinates = self.system.record.joints.coordinate.astype(np.int64)
        self.names = self.system.layout.coordinates["joint_coordinate"]
        self.idle = self._turns_of_points()
        y = assemble(with_beams, self.motion).y
        self.motion.evaluate(0.0, y)
        self._refuse(machine)
        self.start = self.place(y, None)

    def _turns_of_points(self) -> Array:
        """(3 k, 6 B) selects the turns of point masses, which mean nothing."""
        every = np.eye(6 * self.system.body_count).reshape(self.system.body_count, 6, -1)
        return every[self.system.point_masses, 3:].reshape(-1, 6 * self.system.body_count)

    def _refuse(self, machine: MachineRecord) -> None:
        count = len(self.directions())
        if count == 1:
            return
        chosen = freedoms(self.motion)
        free = (
            chosen.independent(coordinate_derivatives(self.motion, self.coordinates.tolist()))
            if chosen is not None
            else []
        )
        names = ", ".join(self.names[k] for k in free)
        how = f"drive all but one of {names}" if count else f"{machine.name} is driven or held: leave a driver out"
        message = (
            f"positions that follow each other are those of machines with one free motion, here are {count}: {how}"
        )
        raise ModelError(Fault.at("kinematics.through", message))

    def directions(self) -> Array:
        """(f, 6 B) free motions in the position last evaluated."""
        found = freedoms(self.motion)
        if found is None:
            raise ModelError(Fault.at("kinematics.through", "the machine is too large for its curve of positions"))
        return (found.without(self.idle) if len(self.idle) else found).directions

    def place(self, y: Array, before: Array | None) -> _Place | None:
        """The place of a closed state, last evaluated; None where it has more than one tangent."""
        directions = self.directions()
        if len(directions) != 1:
            return None
        tangent = directions[0] if before is None or directions[0] @ before > 0.0 else -directions[0]
        rates = coordinate_derivatives(self.motion, self.coordinates.tolist()) @ tangent
        lengths = np.array([unit == "m" for unit in self.system.coordinate_units])
        record = self.system.record.coordinates
        values, reference = record.value[self.coordinates].copy(), record.reference.copy()
        return _Place(y.copy(), tangent, values, np.where(lengths, rates * self.system.size, rates), reference)

    def step(self, place: _Place, h: float) -> _Place | None:
        """The place a step h further; None where it cannot be closed near the tangent."""
        change = h * place.tangent.reshape(-1, 6)
        change[:, :3] *= self.system.size
        y = place.y.copy()
        self.system.record.coordinates.reference[:] = place.reference
        y[: self.system.positions] = moved(y[: self.system.positions], change.ravel())
        if not close_positions(self.motion, 0.0, y, from_afar=False):
            return None
        found = self.place(y, place.tangent)
        if found is None or found.tangent @ place.tangent < STRAIGHT:
            return None
        return found if np.linalg.norm(self.displacement(place, found) - h * place.tangent) <= ASIDE * abs(h) else None

    def opening(self, place: _Place) -> float:
        """How far joints are open at a place at most, as a share of the scales of their rows."""
        self.motion.evaluate(0.0, place.y)
        constraints = self.system.record.constraints
        return float(np.max(np.abs(constraints.C) / constraints.scale, initial=0.0))

    def displacement(self, first: _Place, second: _Place) -> Array:
        """(6 B,) from one place to another, lengths in machine lengths."""
        n = self.system.positions
        change = change_between(first.y[:n], second.y[:n])
        change[:, :3] /= self.system.size
        if self.system.point_masses.any():
            change[self.system.point_masses, 3:] = 0.0
        return change.ravel()

    def crosses(self, first: _Place, second: _Place) -> bool:
        """Whether another curve crosses between two neighbours: the determinant of [C_q; τ] changes its sign."""
        signs, kept = [], None
        for place in (first, second):
            self.motion.evaluate(0.0, place.y)
            rows = np.vstack([scaled_jacobian(self.motion), self.idle])
            kept = independent_rows(rows, rows.shape[1] - 1) if kept is None else kept
            signs.append(determinant_sign(np.vstack([rows[kept], place.tangent])))
        return signs[0] * signs[1] < 0.0

    def turning(self, place: _Place, h: float, k: int) -> tuple[float, _Place]:
        """Where between a place and the next one, a step h further, coordinate k turns back."""

        def rate(share: float) -> float:
            found = self.step(place, share * h) if share else place
            return float(found.rates[k]) if found is not None else 0.0

        root: Any = brentq(rate, 0.0, 1.0, xtol=1e-13)
        share = float(root)
        return share * h, self.step(place, share * h) or place

    def joints_involved(self, place: _Place, k: int) -> tuple[str, ...]:
        """Joints whose rows depend on coordinate k at a turning point of it."""
        self.motion.evaluate(0.0, place.y)
        rows = scaled_jacobian(self.motion)
        row = coordinate_derivatives(self.motion, [int(self.coordinates[k])])[0]
        weights = np.abs(np.linalg.lstsq(rows.T, row / np.linalg.norm(row), rcond=None)[0])
        taking = np.flatnonzero(weights >= TAKES_PART * weights.max(initial=0.0))
        return tuple(dict.fromkeys(self.system.row_owner[j] for j in taking))

    def closure(self, found: _Place, h: float) -> tuple[float, _Place] | None:
        """The way on to the start, and the place there, if that is as near as a step h and ahead."""
        assert self.start is not None
        aside = float(np.linalg.norm(self.displacement(found, self.start)))
        rest = float(self.displacement(found, self.start) @ found.tangent)
        if aside > BACK * h or rest < 0.0 or found.tangent @ self.start.tangent < STRAIGHT:
            return None
        whole, end = 0.0, found
        while abs(rest) > NOTHING and whole < 2.0 * BACK * h:
            nearer = self.step(end, rest)
            if nearer is None:
                return None
            whole, end = whole + rest, nearer
            rest = float(self.displacement(end, self.start) @ end.tangent)
        return whole, end


def configuration_curve(machine: MachineRecord, coordinate: str) -> ConfigurationCurve:
    """All positions from the assembled one on, until it is reached again; turning points of `coordinate`, a full name.

    Raises ModelError for machines that do not have just one free motion, SolveError where the positions cannot be followed.
    """
    curve = _Curve(machine)
    if curve.start is None:
        raise ModelError(Fault.at("kinematics.through", "the machine starts in a singular position"))
    k = list(curve.names).index(coordinate)
    places, arcs, turning, crossed, h, closed = [curve.start], [0.0], [], [], LONGEST, False

    def add(found: _Place, way: float) -> None:
        last = places[-1]
        if last.rates[k] * found.rates[k] < 0.0:
            part, at = curve.turning(last, way, k)
            turning.append(Turning(arcs[-1] + part, float(at.values[k]), curve.joints_involved(at, k)))
        if curve.crosses(last, found):
            crossed.append(arcs[-1] + 0.5 * way)
        places.append(found)
        arcs.append(arcs[-1] + way)

    while len(places) < MOST and not closed:
        found = curve.step(places[-1], h)
        if found is None:
            h *= 0.5
            if h < SHORTEST:
                message = f"the positions cannot be followed beyond {coordinate} = {places[-1].values[k]:.6g}"
                raise SolveError(
                    message, time=0.0, advice="Curves of positions meet there: start on the other side of it."
                )
            continue
        add(found, h)
        end = curve.closure(found, h) if len(places) > LEAST else None
        if end is not None:
            closed = True
            if end[0] > 0.0:
                add(end[1], end[0])
        h = min(LONGEST, 2.0 * h)
    rates = np.array([place.rates[k] for place in places])
    if closed and abs(rates[0]) <= STILL * np.abs(rates).max() and rates[1] * rates[-2] < 0.0:
        turning.insert(0, Turning(0.0, float(curve.start.values[k]), curve.joints_involved(curve.start, k)))
    found = ConfigurationCurve(
        machine=machine.name,
        coordinate=coordinate,
        names=tuple(curve.names),
        units=tuple(curve.system.coordinate_units),
        arc=np.array(arcs),
        values=np.array([place.values for place in places]),
        closed=closed,
        turning=tuple(turning),
        crossed=tuple(crossed),
    )
    opening = max(curve.opening(place) for place in places)
    return replace(found, trust=assess(Curve(outcome="done", curve=found, opening=opening)))
