"""Constraint rows: joints and couplings become basic constraints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.elements.joints.kind import (
    AXES,
    Basic,
    Coincident,
    Combination,
    Composition,
    Measured,
    PerpendicularAxes,
    PerpendicularDistance,
)
from nivel.kernels.bodies.coordinate import LAST_ANGLE
from nivel.kernels.record.record import NONE, Constraints
from nivel.known import OnBeam
from nivel.lazy import dataclass, field
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS
from nivel.system.builder import SystemBuilder
from nivel.system.joint_frames import cosine_as_placed, joint_frames, slot_frame
from nivel.system.tables import Rail, Wheel, index_array, zeros

if TYPE_CHECKING:
    from nivel.elements.joints.couplings import Curve

# cosines of axes that count as parallel differ from ±1 by less than this: 0.001 rad
PARALLEL = 5e-7
Views = dict[str, tuple[int, int | Rail | Wheel]]  # from which marker to which, or to a beam or wheel


@dataclass
class RowTable:
    """Rows of the machine, each with the parts of C_q that it has.

    owner : name of the joint, coupling or driver of each row. velocity : rows that hold velocities alone. spans : rows of each joint.
    part_marker, part_row : of each part.
    first_part : of each joint row, the part of the joint's first marker. given : offset of each combination, None: as placed.
    """

    names: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    owner: list[str] = field(default_factory=list)
    velocity: set[int] = field(default_factory=set)
    spans: list[tuple[int, int]] = field(default_factory=list)
    first_marker: list[tuple[int, int]] = field(default_factory=list)
    first_part: list[int] = field(default_factory=list)
    part_marker: list[int] = field(default_factory=list)
    part_row: list[int] = field(default_factory=list)
    s: list[tuple[int, ...]] = field(default_factory=list)
    d1: list[tuple[int, ...]] = field(default_factory=list)
    d2: list[tuple[int, ...]] = field(default_factory=list)
    combination: list[tuple[int, ...]] = field(default_factory=list)
    term: list[tuple[int, int, int]] = field(default_factory=list)
    bend: list[tuple[int, int, int]] = field(default_factory=list)
    term_part: list[int] = field(default_factory=list)
    factor: list[float] = field(default_factory=list)
    given: list[float | None] = field(default_factory=list)
    reports: list[tuple[int, int]] = field(default_factory=list)

    def row(self, owner: str, name: str, units: str) -> int:
        """Index of a new row."""
        self.owner.append(owner)
        self.names.append(f"{owner}.{name}")
        self.units.append(units)
        return len(self.names) - 1

    def part(self, row: int, marker: int) -> int:
        """Index of a new part of `row` for the velocities of `marker`."""
        self.part_row.append(row)
        self.part_marker.append(marker)
        return len(self.part_row) - 1

    def combine(
        self,
        builder: SystemBuilder,
        row: int,
        terms: list[tuple[int, float]],
        *,
        markers: tuple[int, ...] = (),
        offset: float | None = None,
        function: int = NONE,
        curve: Curve | None = None,
        report: tuple[int, int] = (NONE, 0),
    ) -> int:
        """Make `row` the combination Σ factor coordinate - offset - function - curve = 0; returns its first part.

        markers : that the first parts belong to; the rest follow from the coordinates. function : of time. curve : a function of the
        coordinates. report : as `Outputs.combination`.
        """
        value, slopes, bends = (NONE, {}, []) if curve is None else (curve.value, curve.slopes, curve.bends)
        parts = {marker: self.part(row, marker) for marker in markers}
        first_term = len(self.term)
        for coordinate, factor in terms:
            ends = builder.coordinates.markers(builder.coordinates.use(coordinate))
            for marker in ends:
                if marker not in parts:
                    parts[marker] = self.part(row, marker)
            self.term.append((coordinate, len(self.term_part), slopes.get(coordinate, NONE)))
            self.term_part += [parts[marker] for marker in ends]
            self.factor.append(factor)
        first_part = min(parts.values())
        first_bend = len(self.bend)
        self.bend += bends
        spans = (first_part, first_part + len(parts), value, first_bend, len(self.bend))
        self.combination.append((row, first_term, len(self.term), function, *spans))
        self.given.append(offset)
        self.reports.append(report)
        return first_part

    def arrays(self, scale: list[float], extra_rows: int, extra_parts: int) -> Constraints:
        """`scale` of all rows of the formulation; `extra_rows` and their parts come behind."""
        rows = len(scale)
        J = np.zeros((len(self.part_row) + extra_parts, 6))
        for *_, part in self.s:
            for axis in range(3):
                J[part + 2 * axis, axis] = -1.0
                J[part + 2 * axis + 1, axis] = 1.0
        return Constraints(
            s=index_array(self.s, 4),
            d1=index_array(self.d1, 6),
            d2=index_array(self.d2, 5),
            combination=index_array(self.combination, 9),
            term=index_array(self.term, 3),
            bend=index_array(self.bend, 3),
            term_part=index_array(self.term_part, 1),
            factor=np.array(self.factor, dtype=float),
            offset=np.array([given or 0.0 for given in self.given], dtype=float),
            motion=np.zeros(len(self.given)),
            scale=np.array(scale, dtype=float),
            **zeros("C Cdot lam", rows),
            gamma=np.zeros(rows + extra_rows),
            J=J,
        )


def add_joint(builder: SystemBuilder, rows: RowTable, joint: Joint) -> None:
    """Markers, joint coordinates and rows of a joint."""
    placed = joint_frames(builder.machine, joint)
    if JOINTS[joint.type].of(joint).parallel:
        placed = (
            builder.directions.straightened(builder.machine, placed[0]),
            builder.directions.straightened(builder.machine, placed[1]),
        )
    first, second = (builder.place(each) for each in placed)
    views: Views = {"first": (first, second), "second": (second, first)}
    if isinstance(joint, OnBeam):
        views["rail"] = first, Rail(tuple(builder.frame(node) for node in joint.nodes), joint.stations, joint.place)
    if joint.type == "rolling":
        assert joint.radius is not None  # the record was checked
        crown = joint.rim_radius or 0.0
        views["wheel"] = first, Wheel(second, joint.radius - crown, crown)
    if joint.type == "revolute-translational":
        views["slot"] = (builder.place(slot_frame(builder.machine, joint)), first)
    cosine = cosine_as_placed(builder.machine, *placed)
    kind = composition(joint, cosine)
    begin = len(rows.names)
    for coordinate in kind.coordinates:
        index = _measured(builder, coordinate.measured, views)
        builder.joint_coordinates[f"{joint.name}.{coordinate.name}"] = index
    for basic in kind.constraints:
        _add_basic(builder, rows, joint, basic, views, cosine)
    rows.spans.append((begin, len(rows.names)))
    rows.first_marker.append((first, second))


def composition(joint: Joint, cosine: float) -> Composition:
    """What the joint is made of; `cosine` is that of the angle between the z axes as placed."""
    kind = JOINTS[joint.type].of(joint)
    return kind.when_parallel if kind.when_parallel is not None and 1.0 - abs(cosine) < PARALLEL else kind


def _measured(builder: SystemBuilder, measured: Measured, views: Views) -> int:
    first, second = views[measured.seen_from]
    if isinstance(second, Rail):
        return builder.coordinates.on_rail(measured.kind, first, second)
    if isinstance(second, Wheel):
        return builder.coordinates.on_plane(measured.kind, first, second, measured.axis)
    return builder.coordinates.add(measured.kind, first, second, measured.axis)


def _add_basic(builder: SystemBuilder, rows: RowTable, joint: Joint, basic: Basic, views: Views, cosine: float) -> None:
    first, second = views["first"]
    assert isinstance(second, int)
    markers = first, second
    units = basic.units if isinstance(basic, Combination) else "1" if isinstance(basic, PerpendicularAxes) else "m"
    new = [rows.row(joint.name, name, units) for name in basic.rows]
    row = new[0]
    if isinstance(basic, Combination):
        terms = [
            (_measured(builder, measured, views), factor(joint, cosine) if callable(factor) else factor)
            for measured, factor in basic.terms
        ]
        given = getattr(joint, basic.given) if basic.given else 0.0 if basic.zero else None
        ends = () if isinstance(joint, OnBeam) else markers
        report = (NONE, 0)
        if basic.effort is not None:
            name, words = basic.effort
            report = (builder.outputs.add((f"joint.{joint.name}.{name}", "N", words)), 0)
        if basic.velocity:
            rows.velocity.add(row)
        rows.first_part.append(rows.combine(builder, row, terms, markers=ends, offset=given, report=report))
        if joint.type == "screw":
            builder.transmissions[joint.name] = row, dict(terms)
        return
    if isinstance(basic, PerpendicularDistance):
        first, second = views[basic.seen_from]
        assert isinstance(second, int)
    part = len(rows.part_row)
    for each in new:
        rows.part(each, first)
        rows.part(each, second)
        rows.first_part.append(part + 2 * (each - row) + (1 if first != markers[0] else 0))
    match basic:
        case Coincident():
            rows.s.append((first, second, row, part))
        case PerpendicularAxes(a, b):
            rows.d1.append((first, AXES[a], second, AXES[b], row, part))
        case PerpendicularDistance(a):
            rows.d2.append((first, AXES[a], second, row, part))


def units_of(builder: SystemBuilder, coordinate: int) -> str:
    """SI unit of a measured coordinate."""
    kind = builder.coordinates.what[coordinate][0]
    return "rad" if kind <= LAST_ANGLE else "m"


def coordinate_units(name: str) -> str:
    """SI unit of the joint coordinate `JOINT.COORDINATE`."""
    return "rad" if COORDINATE_KINDS[name.partition(".")[2]] == "angle" else "m"
