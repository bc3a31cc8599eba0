"""Strains, forces and moments in the sections of a beam in absolute nodal coordinates, from its nodes and their modes in a result."""

from __future__ import annotations

import numpy as np

from nivel.machine.beams.beam import Beam
from nivel.results.beams.section_resultants import Array, Felt
from nivel.system.beams.elements import gauss
from nivel.system.beams.gradient_beams import section_stiffness
from nivel.system.beams.gradient_elements import (
    BENDING_POINTS,
    STRETCH_POINTS,
    beam_strains,
    cable_strains,
    carried_over,
    gradients,
    lengths_of,
    line_at,
    twists,
    unstressed_vectors,
)
from nivel.system.beams.gradient_nodes import gradient_nodes, modes_in_gradients


def felt_by_gradients(beam: Beam, place: Array, axes: Array, modal: Array) -> Felt:
    """From places (t, N, 3), axes (t, N, 3, 3) and modal coordinates (t, N, m) of the nodes of `beam`."""
    change = np.stack([modes_in_gradients(beam, node.reduced) for node in gradient_nodes(beam)])
    own = [np.swapaxes(gradients(axes[:, k], modal[:, k], each), -1, -2) for k, each in enumerate(change)]
    v = np.concatenate([place[:, :, None], np.stack(own, axis=1)], axis=2)
    return _cable(beam, v, axes) if beam.model == "ancf-cable" else _beam(beam, v)


def _share(beam: Beam, xi: Array) -> Array:
    """(p,) of the length of the beam at xi (g,) in every element."""
    shares = beam.shares
    return np.ravel(shares[:-1, None] + np.diff(shares)[:, None] * xi)


def _beam(beam: Beam, v: Array) -> Felt:
    now, unstressed = beam_strains(beam, v), beam_strains(beam, unstressed_vectors(beam))
    strain = (now.value - unstressed.value).reshape(len(v), -1, 6)
    C = beam.properties.stiffness
    stress, weight = strain @ C, now.weight.ravel()
    energy = 0.5 * np.einsum("tpi,tpi,p->t", strain, stress, weight)
    Y, Z = v[:, :, 2], v[:, :, 3]
    squares = 0.5 * np.sum(Y * Y, axis=-1) - 0.5, 0.5 * np.sum(Z * Z, axis=-1) - 0.5, np.sum(Y * Z, axis=-1)
    for length in np.unique(lengths_of(beam)).tolist():
        of_element = np.where(lengths_of(beam) == length, 0.5 * length, 0.0)
        of_node = np.append(of_element, 0.0) + np.append(0.0, of_element)
        for share, value in zip(section_stiffness(C, length), squares, strict=True):
            energy = energy + 0.5 * share * (value**2 @ of_node)
    return Felt(_share(beam, now.share[0]), weight, strain, stress, energy)


def _cable(beam: Beam, v: Array, axes: Array) -> Felt:
    """At the points of bending. There is no shear strain; the shear force is what the change of the moment asks for."""
    C, lengths = beam.properties.stiffness, lengths_of(beam)
    (xi, weight), (full, heavy) = gauss(BENDING_POINTS), gauss(STRETCH_POINTS)
    stretch, K = cable_strains(beam, v, xi)
    line = line_at(beam, v, xi)
    square = np.sum(line.slope**2, axis=-1)[..., None]
    t = line.slope / np.sqrt(square)
    change = np.cross(line.slope, line.third) / square
    change -= 2.0 * np.sum(line.slope * line.bend, axis=-1)[..., None] / square * K
    shear = C[4, 4] * np.cross(t, change) / np.sqrt(square)
    first, last = axes[:, :-1, None], axes[:, 1:, None]
    across = (1.0 - xi[:, None]) * carried_over(first[..., 1] + 0.0 * t, first[..., 0] + 0.0 * t, t)
    across += xi[:, None] * carried_over(last[..., 1] + 0.0 * t, last[..., 0] + 0.0 * t, t)
    across /= np.linalg.norm(across, axis=-1)[..., None]
    other = np.cross(t, across)
    twist = np.broadcast_to((twists(axes) / lengths)[..., None], stretch.shape)

    def seen(vector: Array) -> tuple[Array, Array]:
        return np.sum(vector * across, axis=-1), np.sum(vector * other, axis=-1)

    strain = np.stack([stretch, 0.0 * stretch, 0.0 * stretch, twist, *seen(K)], axis=-1)
    stress = np.stack(
        [C[0, 0] * stretch, *seen(shear), C[3, 3] * twist, C[4, 4] * strain[..., 4], C[5, 5] * strain[..., 5]], axis=-1
    )
    energy = 0.5 * C[0, 0] * np.einsum("tng,g,n->t", cable_strains(beam, v, full)[0] ** 2, heavy, lengths)
    energy += 0.5 * C[4, 4] * np.einsum("tngi,g,n->t", K**2, weight, lengths)
    energy += 0.5 * C[3, 3] * np.sum(twists(axes) ** 2 / lengths, axis=-1)
    shape = (len(v), -1, 6)
    return Felt(
        _share(beam, xi), np.outer(lengths, weight).ravel(), strain.reshape(shape), stress.reshape(shape), energy
    )
