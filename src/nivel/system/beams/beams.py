"""Beams in numbers: their elements as a family of forces, and the mass that their nodes share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.elements.forces.bushing import apply as bushing
from nivel.elements.states import Coupled
from nivel.kernels.forces.beam import apply as beam_family
from nivel.kernels.forces.beam import apply_elastic as elastic_beam
from nivel.kernels.record.beam_record import BeamTangent, SharedMass
from nivel.kernels.record.hook import FAMILIES as COMPILED
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE, Record
from nivel.machine.beams.beam import Beam
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import placement
from nivel.system.beams.elements import elements_of, masses_of
from nivel.system.beams.gradient_beams import FAMILIES as OF_GRADIENTS
from nivel.system.beams.gradient_beams import add_gradient_beam, family_of_gradients
from nivel.system.beams.segments import add_segments
from nivel.system.builder import GROUND, SystemBuilder
from nivel.system.tables import index_array

MOST_NODES = 4
# kernels of elements: those without damping, whose derivatives are found by hand, and all others; of springs between segments
ELASTIC, OTHER, SPRINGS = elastic_beam, beam_family, bushing
FAMILIES = (ELASTIC, OTHER, SPRINGS, *OF_GRADIENTS)


def family_of(beam: Beam) -> Family:
    """The kernel of its elements, or of the springs between its segments."""
    if beam.has_gradients:
        return family_of_gradients(beam)
    if beam.model == "segments":
        return SPRINGS
    return OTHER if beam.damping > 0.0 or beam.interpolation == "total" else ELASTIC


def add_beam(builder: SystemBuilder, beam: Beam) -> None:
    """What joins the nodes of a beam, which are bodies: its elements, or springs between segments; each couples its own nodes."""
    if beam.has_gradients:
        add_gradient_beam(builder, beam)
    elif beam.model == "segments":
        add_segments(builder, beam)
    else:
        _add_elements(builder, beam)


def _add_elements(builder: SystemBuilder, beam: Beam) -> None:
    elements, section = elements_of(beam), beam.properties
    marker = np.array([builder.frame(name) for name in beam.node_names])
    names = dict(zip(marker.tolist(), beam.node_names, strict=True))
    count, total = beam.order + 1, beam.interpolation == "total"
    for nodes, N, slope, weight, strain in zip(
        marker[elements.nodes], elements.N, elements.slope, elements.weight, elements.strain, strict=True
    ):
        points = np.zeros((3, 15))
        points[: len(weight), 0] = weight
        points[: len(weight), 1 : 1 + count] = N
        points[: len(weight), 5 : 5 + count] = slope
        points[: len(weight), 9:] = strain
        frame, slot = nodes[elements.reference], elements.reference
        if total:
            axes = matrix_from_euler_parameters(placement(builder.machine.body_named[names[frame]])[1])
            frame, slot = builder.place((GROUND, np.zeros(3), axes)), MOST_NODES
        index = [*nodes.tolist(), *[NONE] * (MOST_NODES - count), count, len(weight), slot, frame]
        number = [beam.damping, *section.stiffness.ravel().tolist(), *points.ravel().tolist(), *[0.0] * 60]
        builder.elements.add(family_of(beam), index, number)
        builder.noted.append(Coupled(frozenset(builder.markers.body[node] for node in nodes)))


def nodes_of_elements(record: Record) -> list[int]:
    """Markers that are nodes of geometrically exact beams."""
    out = set[int]()
    for address, (first, last) in zip(record.elements.address, record.elements.span.tolist(), strict=True):
        if COMPILED[int(address)] in (ELASTIC, OTHER):
            for row in record.elements.columns[first:last].tolist():
                out.update(row[: row[MOST_NODES]])
    return sorted(out)


def no_tangent() -> BeamTangent:
    """For machines whose derivatives are found otherwise: all arrays empty."""
    return empty_tangent(0, 0)


def empty_tangent(elements: int, unknowns: int) -> BeamTangent:
    """Room for so many elements, and unknowns of one at most; tables are empty."""
    empty = index_array([], 1)
    return BeamTangent(
        wrench=np.zeros((elements, 6 * MOST_NODES)),
        first=np.zeros(1, dtype=np.uint32),
        start=np.zeros(1, dtype=np.uint32),
        unknown=index_array([], 4),
        place_start=empty,
        place=empty,
        pair=index_array([], 2),
        plain=index_array([], 8),
        S=np.zeros((9, 9)),
        B=np.zeros((6, 9)),
        k=np.zeros((18, 18)),
        P=np.zeros(18),
        twist=np.zeros((unknowns, 6 * MOST_NODES)),
        change=np.zeros((MOST_NODES, 6)),
        local=np.zeros(36),
        psi=np.zeros((MOST_NODES, 3)),
    )


def shared_mass(builder: SystemBuilder, beams: Sequence[Beam]) -> SharedMass:
    """What the nodes of beams with consistent mass have in common."""
    pairs, mass, moment, turn = [], [np.zeros(0)], [np.zeros((0, 3, 3))], [np.zeros((0, 3, 3))]
    for beam in beams:
        if beam.model == "geometrically-exact" and beam.shares_mass:
            own = masses_of(beam)
            ends = np.array([(builder.body(name), builder.frame(name)) for name in beam.node_names])
            pairs += ends[own.pairs].transpose(0, 2, 1).reshape(-1, 4).tolist()
            mass.append(own.shared)
            moment.append(own.moment)
            turn.append(own.turn)
    return SharedMass(index_array(pairs, 4), np.concatenate(mass), np.concatenate(moment), np.concatenate(turn))
