"""Beams in numbers: their elements as a family of forces, and the mass that their nodes share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.kernels.beam_record import SharedMass
from nivel.kernels.record import NONE
from nivel.machine.beam import Beam
from nivel.system.beam_elements import elements_of, masses_of
from nivel.system.draft import Draft
from nivel.system.tables import index_array

FAMILY = "beam"
MOST_NODES = 4


def add_beam(draft: Draft, beam: Beam) -> None:
    """The elements of a beam, whose nodes are bodies; each couples its own nodes."""
    elements, section = elements_of(beam), beam.properties
    marker = np.array([draft.frame(name) for name in beam.node_names])
    count = beam.order + 1
    for nodes, N, slope, weight, strain in zip(
        marker[elements.nodes], elements.N, elements.slope, elements.weight, elements.strain, strict=True
    ):
        points = np.zeros((3, 15))
        points[: len(weight), 0] = weight
        points[: len(weight), 1 : 1 + count] = N
        points[: len(weight), 5 : 5 + count] = slope
        points[: len(weight), 9:] = strain
        index = [*nodes.tolist(), *[NONE] * (MOST_NODES - count), count, len(weight), elements.reference]
        number = [beam.damping, *section.stiffness.ravel().tolist(), *points.ravel().tolist(), *[0.0] * 48]
        draft.elements.add(FAMILY, index, number)
        draft.noted.append(frozenset(draft.markers.body[node] for node in nodes))


def shared_mass(draft: Draft, beams: Sequence[Beam]) -> SharedMass:
    """What the nodes of beams with consistent mass have in common."""
    pairs, mass, moment, turn = [], [np.zeros(0)], [np.zeros((0, 3, 3))], [np.zeros((0, 3, 3))]
    for beam in beams:
        if beam.mass == "consistent":
            own = masses_of(beam)
            ends = np.array([(draft.body(name), draft.frame(name)) for name in beam.node_names])
            pairs += ends[own.pairs].transpose(0, 2, 1).reshape(-1, 4).tolist()
            mass.append(own.shared)
            moment.append(own.moment)
            turn.append(own.turn)
    return SharedMass(index_array(pairs, 4), np.concatenate(mass), np.concatenate(moment), np.concatenate(turn))
