"""Beams in absolute nodal coordinates in numbers: their elements as families of forces, and the mass that their points have in common."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.elements.states import Coupled
from nivel.kernels.forces.ancf_beam import apply as ancf_beam
from nivel.kernels.forces.ancf_cable import apply as ancf_cable
from nivel.kernels.record.beam_record import PointInertia
from nivel.kernels.record.hook import Family
from nivel.kernels.record.record import NONE
from nivel.lazy import scipy
from nivel.machine.beams.beam import Beam
from nivel.system.beams.elements import gauss
from nivel.system.beams.gradient_elements import (
    BEAM_POINTS,
    BENDING_POINTS,
    STRETCH_POINTS,
    Array,
    as_points,
    beam_strains,
    cable_strains,
    consistent_mass,
    hermite,
    lengths_of,
    lumped_mass,
    reach_of,
    unstressed_vectors,
    vectors_of_node,
)
from nivel.system.builder import SystemBuilder
from nivel.system.tables import index_array

FAMILIES = ancf_cable, ancf_beam
MOST_VECTORS = 8
VECTORS = 72  # places, rates and forces of an element


def family_of_gradients(beam: Beam) -> Family:
    """The kernel of the elements of a beam in absolute nodal coordinates."""
    return ancf_cable if beam.model == "ancf-cable" else ancf_beam


def add_gradient_beam(builder: SystemBuilder, beam: Beam) -> None:
    """The elements of a beam, whose nodes are bodies and whose gradients are points on these."""
    points, axes = _points(builder, beam), [builder.frame(name) for name in beam.node_names]
    numbers = _cable_numbers(beam) if beam.model == "ancf-cable" else _beam_numbers(beam)
    for e, own in enumerate(numbers):
        index = [*points[e], *points[e + 1]]
        if beam.model == "ancf-cable":
            index += axes[e : e + 2]
        head = [beam.damping, reach_of(beam), reach_of(beam), *[0.0] * VECTORS]
        builder.elements.add(family_of_gradients(beam), index, [*head, *own])
        builder.noted.append(Coupled(frozenset(builder.markers.body[node] for node in axes[e : e + 2])))


def _points(builder: SystemBuilder, beam: Beam) -> list[list[int]]:
    """Markers of each node and of the tips of its gradients; the same ones at every call."""
    reach, width = reach_of(beam), vectors_of_node(beam)
    with builder.within(f"beams.{beam.name}"):
        return [
            [builder.frame(name), *(builder.tip(name, axis, reach) for axis in range(width - 1))]
            for name in beam.node_names
        ]


def _cable_numbers(beam: Beam) -> list[list[float]]:
    """Columns from OWN on of `nivel.kernels.forces.ancf_cable`, an element each."""
    C = beam.properties.stiffness
    (xi, weight), (at, share) = gauss(STRETCH_POINTS), gauss(BENDING_POINTS)
    out = []
    for length in lengths_of(beam).tolist():
        slope, own, bend = hermite(xi, length, 1), hermite(at, length, 1), hermite(at, length, 2)
        stretch = np.column_stack([weight * length, slope])
        bending = np.column_stack([share * length, own, bend])
        out.append([C[0, 0], C[4, 4], C[3, 3] / length, *stretch.ravel().tolist(), *bending.ravel().tolist()])
    return out


def _beam_numbers(beam: Beam) -> list[list[float]]:
    """Columns from OWN on of `nivel.kernels.forces.ancf_beam`, an element each."""
    C = beam.properties.stiffness
    xi, _ = gauss(BEAM_POINTS)
    unstressed = beam_strains(beam, unstressed_vectors(beam))
    out = []
    for e, length in enumerate(lengths_of(beam).tolist()):
        table = np.column_stack([unstressed.weight[e], xi, hermite(xi, length, 1), unstressed.value[e]])
        section = section_stiffness(C, length)
        out.append([length, *C.ravel().tolist(), *section.tolist(), *table.ravel().tolist()])
    return out


def section_stiffness(C: Array, length: float) -> Array:
    """(3,) [N] what the deformation of a section of stiffness C costs in an element of this length [m], yy, zz and yz.

    As much as stretch and shear of the beam do, and more in elements that are shorter than the section is high. A moment M feels
    -M d·Y': where the slopes of elements lean by ±g in turn and sections stretch by ±b, they store 2 (GA g²/4 + k b²/4) a unit of length
    and M gains 2 M g b/length, so that M = ½ length √(GA k) would be a critical load that falls with every refinement. With
    k = EA + 144 EI/length² it is at least 6 √(GA EI), where fibres are strained by more than one.
    """
    stretch, shear = C[0, 0], 0.5 * (C[1, 1] + C[2, 2])
    turns = 144.0 * np.array([C[5, 5], C[4, 4], np.sqrt(C[4, 4] * C[5, 5]) * shear / stretch]) / length**2
    return np.asarray(np.array([stretch, stretch, shear]) + turns, dtype=float)


def point_inertia(builder: SystemBuilder, beams: Sequence[Beam]) -> PointInertia:
    """The mass that the points of beams in absolute nodal coordinates have in common."""
    markers, matrices = [], [np.zeros((0, MOST_VECTORS, MOST_VECTORS))]
    for beam in beams:
        if not beam.has_gradients:
            continue
        width = vectors_of_node(beam)
        T = np.kron(np.eye(2), as_points(width, reach_of(beam)))
        points = _points(builder, beam)
        for e, length in enumerate(lengths_of(beam).tolist()):
            first, second = lumped_mass(beam, length)
            rest = consistent_mass(beam, length)
            rest[:width, :width] -= first
            rest[width:, width:] -= second
            matrix = np.zeros((1, MOST_VECTORS, MOST_VECTORS))
            matrix[0, : 2 * width, : 2 * width] = T.T @ rest @ T
            matrices.append(matrix)
            own = [*points[e], *points[e + 1]]
            markers.append(own + [NONE] * (MOST_VECTORS - len(own)))
    return PointInertia(index_array(markers, MOST_VECTORS), np.concatenate(matrices))


# The highest frequency of an element, from its stiffness and mass about rest.

STEP = 1e-30  # of a complex step


def fastest_of_gradients(beam: Beam) -> float:
    """Highest frequency [Hz] of the shortest element of a beam, straight and unstressed."""
    lengths = lengths_of(beam)
    whole = beam.replace(
        from_=(0.0, 0.0, 0.0), to=(float(lengths.min()), 0.0, 0.0), via=None, through=(), twist=0.0, up=None,
        elements=1, stations={},
    )  # fmt: skip
    length = whole.line.length
    stiffness = _cable_stiffness(whole, length) if beam.model == "ancf-cable" else _beam_stiffness(whole, length)
    mass = np.kron(consistent_mass(whole, length), np.eye(3))
    fastest = float(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[-1])
    if beam.model == "ancf-cable":
        own = whole.properties
        fastest = max(fastest, 4.0 * float(own.stiffness[3, 3] / own.inertia[0, 0]) / length**2)
    return float(np.sqrt(fastest)) / (2.0 * np.pi)


def _moved(beam: Beam) -> Any:
    """(n, 2, w, 3) complex vectors of both nodes, each of the n of their numbers moved by i STEP."""
    v: Any = unstressed_vectors(beam).astype(complex)
    count = v.size
    return v + 1j * STEP * np.eye(count).reshape(count, *v.shape)


def _beam_stiffness(beam: Beam, length: float) -> Array:
    moved = _moved(beam)
    strains = beam_strains(beam, moved)
    B = strains.value[:, 0].imag / STEP
    K = np.einsum("iga,ab,jgb,g->ij", B, beam.properties.stiffness, B, strains.weight[0])
    Y, Z = moved[:, :, 2], moved[:, :, 3]
    squares = 0.5 * np.sum(Y * Y, axis=-1), 0.5 * np.sum(Z * Z, axis=-1), np.sum(Y * Z, axis=-1)
    for share, value in zip(section_stiffness(beam.properties.stiffness, length), squares, strict=True):
        b = value.imag / STEP
        K += 0.5 * length * share * b @ b.T
    return np.asarray(K, dtype=float)


def _cable_stiffness(beam: Beam, length: float) -> Array:
    C, moved = beam.properties.stiffness, _moved(beam)
    (xi, weight), (at, share) = gauss(STRETCH_POINTS), gauss(BENDING_POINTS)
    stretch = cable_strains(beam, moved, xi)[0][:, 0].imag / STEP
    bend = cable_strains(beam, moved, at)[1][:, 0].imag / STEP
    K = C[0, 0] * np.einsum("ig,jg,g->ij", stretch, stretch, weight * length)
    K += C[4, 4] * np.einsum("iga,jga,g->ij", bend, bend, share * length)
    return np.asarray(K, dtype=float)
