"""The highest frequency of an element in absolute nodal coordinates, from its stiffness and mass about rest."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.lazy import scipy
from nivel.machine.beams.beam import Beam
from nivel.system.beams.elements import gauss
from nivel.system.beams.gradient_beams import section_stiffness
from nivel.system.beams.gradient_elements import (
    BENDING_POINTS,
    STRETCH_POINTS,
    Array,
    beam_strains,
    cable_strains,
    consistent_mass,
    lengths_of,
    unstressed_vectors,
)

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
