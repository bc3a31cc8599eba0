"""A beam as rigid segments joined by springs of six directions: `model: segments`.

Every node is the frame of a rigid segment, which reaches half the way to its neighbours. Where two segments meet stand a marker of each,
on one spot and with the axes of the section while the beam is unstressed. Between these acts a bushing with the stiffness C/l of the piece
of beam from node to node, l its length, so that the deflection of the bushing is l times the strains (Γ, Κ) there. Small motions have the
energy of linear elements with one point of integration: errors fall with l².
"""

from itertools import pairwise

import numpy as np

from nivel.elements.beams.exact import Array, gauss, relative_turns
from nivel.elements.facts import Coupled
from nivel.elements.forces.bushing import BushingRow
from nivel.elements.forces.bushing import apply as bushing
from nivel.kernels.record.record import NONE
from nivel.known import Beam, SystemBuilder
from nivel.lazy import Struct

# points of integration over half of a segment: exact for straight beams, to round-off for arcs of a few degrees
POINTS = 8


class Segments(Struct):
    """mass : (N,) [kg], centre : (N, 3) [m] of mass and inertia : (N, 3, 3) [kg m²] about it, in the axes of the nodes."""

    mass: Array
    centre: Array
    inertia: Array


def boundaries(beam: Beam) -> Array:
    """(N - 1,) shares of the length at which segments meet."""
    return 0.5 * (beam.shares[:-1] + beam.shares[1:])


def segments_of(beam: Beam) -> Segments:
    """The rigid segments of a beam."""
    section, shares, length = beam.properties, beam.shares, beam.line.length
    place, axes = beam.frames(shares)
    xi, weight = gauss(POINTS)
    count = len(shares)
    mass, centre, inertia = np.zeros(count), np.zeros((count, 3)), np.zeros((count, 3, 3))
    ends = np.concatenate([[0.0], boundaries(beam), [1.0]])
    for k, (low, high) in enumerate(pairwise(ends.tolist())):
        halves = [(a, b) for a, b in ((low, shares[k]), (shares[k], high)) if b > a]
        at = np.concatenate([a + (b - a) * xi for a, b in halves])
        part = section.mass * length * np.concatenate([(b - a) * weight for a, b in halves])
        points, turned = beam.frames(at)
        own = axes[k].T @ turned
        r = (points - place[k]) @ axes[k] + own @ section.mass_centre
        mass[k] = part.sum()
        centre[k] = part @ r / mass[k]
        lever = r - centre[k]
        square = np.einsum("gi,gi->g", lever, lever)
        inertia[k] = np.einsum(
            "g,gij->ij", part, square[:, None, None] * np.eye(3) - lever[:, :, None] * lever[:, None]
        )
        inertia[k] += np.einsum("g,gij,jk,glk->il", part / section.mass, own, section.inertia, own)
    return Segments(mass, centre, 0.5 * (inertia + np.swapaxes(inertia, 1, 2)))


def add_segments(builder: SystemBuilder, beam: Beam) -> None:
    """The springs between the segments of a beam, whose frames are bodies; they report nothing."""
    K, (place, axes) = beam.properties.stiffness, beam.frames(beam.shares)
    meeting, turned = beam.frames(boundaries(beam))
    lengths = beam.line.length * np.diff(beam.shares)
    for k, names in enumerate(pairwise(beam.node_names)):
        ends = [
            builder.place((name, axes[n].T @ (meeting[k] - place[n]), axes[n].T @ turned[k]))
            for n, name in zip((k, k + 1), names, strict=True)
        ]
        stiffness = (K / lengths[k]).ravel()
        damping = beam.damping * stiffness
        row = BushingRow(
            output=NONE, first=ends[0], second=ends[1], stiffness=stiffness.tolist(), damping=damping.tolist()
        )
        builder.add(bushing, row)
        builder.noted.append(Coupled(frozenset(builder.markers.body[end] for end in ends)))


def deflections(beam: Beam, place: Array, axes: Array) -> Array:
    """(t, N - 1, 6) displacements [m] and turns [rad] of the springs, axes of the sections, from places (t, N, 3) and axes (t, N, 3, 3) of
    the nodes."""
    start, unturned = beam.frames(beam.shares)
    meeting, turned = beam.frames(boundaries(beam))
    points, frames = [], []
    for own in (slice(None, -1), slice(1, None)):
        arm = np.einsum("nji,nj->ni", unturned[own], meeting - start[own])
        points.append(place[:, own] + np.einsum("tnij,nj->tni", axes[:, own], arm))
        frames.append(axes[:, own] @ (np.swapaxes(unturned[own], 1, 2) @ turned))
    moved = np.einsum("tnji,tnj->tni", frames[0], points[1] - points[0])
    pairs = np.stack(frames, axis=2).reshape(-1, 2, 3, 3)
    return np.concatenate([moved, relative_turns(pairs, 0)[:, 1].reshape(moved.shape)], axis=2)
