"""Frames of beams: from nodes, sections and materials to a finite-element model."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from nivel.elements.beams.sections import section_of
from nivel.errors import refuse
from nivel.flexible.model.beam import Beam, end_stress, geometric_stiffness, mass_points, stiffness
from nivel.flexible.model.model import Array, FiniteElementModel, PointMass, Sparse, Whole, numbered
from nivel.flexible.model.model_file import Located
from nivel.lazy import Struct


def local_axes(along: Array, up: Array | None) -> Array:
    """(3, 3) rows x, y, z of a beam along (3,): z is as near to `up` as it can be; default z, for vertical beams x."""
    x = along / np.linalg.norm(along)
    if up is None:
        up = np.array([0.0, 0.0, 1.0]) if abs(x[2]) < 0.999 else np.array([1.0, 0.0, 0.0])
    z = up - (up @ x) * x
    z = z / np.linalg.norm(z)
    return np.array([x, np.cross(z, x), z])


def _mass(
    position: Array, freedoms: Whole, elements: BeamElements, point_masses: Mapping[int, float], lumped: bool
) -> PointMass:
    masses, places, rows, columns, values = [], [], [], [], []
    count = 0
    for e, beam in enumerate(elements.beams):
        mass, place, shape = mass_points(beam, lumped=lumped)
        R, T = elements.axes[e], elements.turning(e)
        at_global = np.einsum("ba,pbj->paj", R, shape @ T)
        masses.append(mass)
        places.append(position[elements.ends[e][0]] + place @ R)
        p, a, j = np.nonzero(at_global)
        rows.append(3 * (count + p) + a)
        columns.append(elements.columns[e][j])
        values.append(at_global[p, a, j])
        count += len(mass)
    for node, mass in point_masses.items():
        masses.append(np.array([mass]))
        places.append(position[[node]])
        rows.append(3 * count + np.arange(3))
        columns.append(freedoms[node, :3])
        values.append(np.ones(3))
        count += 1
    shape = sp.csr_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(3 * count, freedoms.size)
    )
    return PointMass(np.concatenate(places), shape, sp.csr_array(sp.diags_array(np.concatenate(masses))))


class BeamElements(Struct):
    """The beams of a frame: stress at the fibres of both ends.

    ends : nodes of each beam; axes : (e, 3, 3) local axes as rows; names : of the beams in the model file.
    Stress is in local axes; where beams meet every one has its own stations.
    """

    freedoms: Whole
    ends: tuple[tuple[int, int], ...]
    beams: tuple[Beam, ...]
    axes: Array
    names: tuple[str, ...]

    @cached_property
    def columns(self) -> list[Whole]:
        """(12,) freedoms of the nodes of each beam."""
        return [np.concatenate([self.freedoms[i], self.freedoms[j]]) for i, j in self.ends]

    def turning(self, e: int) -> Array:
        """(12, 12) local from global freedoms."""
        return np.kron(np.eye(4), self.axes[e])

    def summed(self, local: list[Array]) -> Sparse:
        """(F, F) sum of local (12, 12) matrices."""
        blocks = np.array([T.T @ block @ T for block, T in ((b, self.turning(e)) for e, b in enumerate(local))])
        columns = np.array(self.columns)
        rows = np.repeat(columns, 12, axis=1).ravel()
        count = int(self.freedoms.max()) + 1
        return sp.csr_array((blocks.ravel(), (rows, np.tile(columns, (1, 12)).ravel())), shape=(count, count))

    def station_nodes(self) -> Whole:
        return np.repeat(np.ravel(self.ends), np.repeat([len(beam.section.fibres) for beam in self.beams], 2))

    def station_labels(self) -> tuple[str, ...]:
        """``main, y 0.05 z 0.1``: the beam and the fibre."""
        return tuple(
            f"{self.names[e]}, y {y:.4g} z {z:.4g}"
            for e, beam in enumerate(self.beams)
            for _ in range(2)
            for y, z in beam.section.fibres
        )

    def stress(self, displacement: Array) -> Array:
        parts = []
        for e, beam in enumerate(self.beams):
            local = self.turning(e) @ displacement[self.columns[e]]
            parts.append((end_stress(beam) @ local).reshape(-1, 6, displacement.shape[1]))
        return np.concatenate(parts)

    def strain(self, displacement: Array) -> Array:
        parts = np.split(self.stress(displacement), np.cumsum([2 * len(beam.section.fibres) for beam in self.beams]))
        for beam, part in zip(self.beams, parts, strict=False):  # stress becomes strain
            along = part[:, 0] / beam.material.youngs_modulus
            part[:, 3:] /= beam.material.shear_modulus
            part[:, 0], part[:, 1:3] = along, -beam.material.poisson_ratio * along[:, None]
        return np.concatenate(parts)

    def geometric_stiffness(self, displacement: Array, modes: Array) -> Array:
        """Of the tension of each beam; its bending moments and torque are left out."""
        out = np.zeros((displacement.shape[1], modes.shape[1], modes.shape[1]))
        for e, beam in enumerate(self.beams):
            u, phi = (self.turning(e) @ each[self.columns[e]] for each in (displacement, modes))
            tension = beam.material.youngs_modulus * beam.section.area * (u[6] - u[0]) / beam.length
            out += tension[:, None, None] * (phi.T @ geometric_stiffness(beam) @ phi)
        return 0.5 * (out + out.transpose(0, 2, 1))


def frame_model(located: Located) -> FiniteElementModel:
    """The finite-element model of the `frame` of a model file. Every node of a frame has six freedoms.

    Raises ModelError.
    """
    record, frame = located.record, located.record.frame
    assert frame is not None
    names = {name: k for k, name in enumerate(frame.nodes)}
    places = [np.array(each, dtype=float) for each in frame.nodes.values()]
    ends: list[tuple[int, int]] = []
    beams: list[Beam] = []
    axes: list[Array] = []
    owners: list[str] = []
    faults = []
    used: set[str] = set()
    for name, beam in frame.beams.items():
        used.update(beam.nodes)
        first, last = (names[node] for node in beam.nodes)
        start, span = places[first], places[last] - places[first]
        up = None if beam.up is None else np.array(beam.up)
        if up is not None and np.linalg.norm(np.cross(up, span)) < 1e-9 * np.linalg.norm(span) * max(
            np.linalg.norm(up), 1e-300
        ):
            faults.append(located.fault(("frame", "beams", name, "up"), "`up` must not be along the beam, nor zero"))
            continue
        material = record.materials[beam.material]
        section = section_of(record.sections[beam.section], material.poisson_ratio)
        length = float(np.linalg.norm(span)) / beam.elements
        ends += pairwise([first, *range(len(places), len(places) + beam.elements - 1), last])
        places += [start + k / beam.elements * span for k in range(1, beam.elements)]
        beams += beam.elements * [Beam(length, section, material, frame.theory == "timoshenko")]
        axes += beam.elements * [local_axes(span, up)]
        owners += beam.elements * [name]
    lost = "no beam ends at this node: remove it, or join it"
    faults += [located.fault(("frame", "nodes", name), lost) for name in frame.nodes if name not in used]
    refuse(faults)
    masses: dict[int, float] = {}
    for mass in frame.masses.values():
        masses[names[mass.node]] = masses.get(names[mass.node], 0.0) + mass.mass
    position, freedoms = np.array(places), numbered(np.ones((len(places), 6), dtype=bool))
    elements = BeamElements(freedoms, tuple(ends), tuple(beams), np.array(axes), tuple(owners))
    return FiniteElementModel(
        name=record.name,
        node_ids=np.arange(1, len(position) + 1),
        position=position,
        freedoms=freedoms,
        stiffness=sp.csc_array(elements.summed([stiffness(beam) for beam in beams])),
        mass=_mass(position, freedoms, elements, masses, record.reduction.mass == "lumped"),
        expansion=sp.csr_array(sp.eye_array(freedoms.size)),
        names=names,
        elements=elements,
        lines=np.array(ends),
        volume=float(sum(beam.section.area * beam.length for beam in beams)),
    )
